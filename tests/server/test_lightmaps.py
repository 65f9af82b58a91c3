# SPDX-License-Identifier: Apache-2.0
"""Lightmaps are stored and served like volumes."""
import hashlib
import json
import os
import shutil
import struct
import tarfile
import unittest

from service import BINARY, COURTYARD, lattice, read, write_groups
from test_backup import DataFolder


def sections_of(data):
    """Offset, size and name of each section (docs/file_format.md)."""
    count = struct.unpack_from("<I", data, 12)[0]
    for i in range(count):
        name, offset, elements, size = struct.unpack_from("<24sQQQ", data, 64 + 64 * i)
        yield name.rstrip(b"\0").decode(), offset, elements * size


class LightmapTest(DataFolder):
    def stored_maps(self, maps):
        return os.path.join(self.data, "lightmaps", maps + ".lightmaps")

    def written(self, name, *arguments):
        """What the command writes to a file of that name."""
        path = os.path.join(self.folder, name)
        self.command(*arguments, "-o", path)
        return read(path)


class Upload(LightmapTest):
    def test_they_come_back_byte_for_byte_with_the_facts_of_info(self):
        server = self.start()
        path = self.lightmap_file()
        answer = server.post("/v1/lightmaps?name=floor", read(path), BINARY)
        maps = answer.json()["id"]
        self.assertEqual((answer.status, maps), (201, hashlib.sha256(read(path)).hexdigest()))
        self.assertEqual(answer.headers["Location"], "/v1/lightmaps/" + maps)
        self.assertEqual(server.post("/v1/lightmaps", read(path), BINARY).status, 200)
        listed = server.get("/v1/lightmaps").json()["lightmaps"]
        self.assertEqual([(file["id"], file["names"]) for file in listed], [(maps, ["floor"])])
        facts = server.get("/v1/lightmaps/floor").json()["facts"]
        info = json.loads(self.command("info", path, "--json"))
        self.assertEqual({**facts, "file": path}, info)
        self.assertEqual((facts["pages"], facts["page_size"], facts["texels"]), (1, 32, 32 * 32))
        download = server.get("/v1/lightmaps/floor/file")
        self.assertEqual(download.body, read(path))
        self.assertIn(f'filename="{maps}.lightmaps"', download.headers["Content-Disposition"])
        self.assertIn("tetralight_lightmaps 1\n", server.get("/metrics").body.decode())

    def test_names_move_and_the_last_one_takes_the_file(self):
        server = self.start()
        first = self.upload(server, "lightmaps", self.lightmap_file(1), "floor")
        second = self.upload(server, "lightmaps", self.lightmap_file(2), "floor")
        self.assertEqual(server.get("/v1/lightmaps/floor").json()["id"], second)
        answer = server.request("PATCH", "/v1/lightmaps/" + first, {"name": "floor"})
        self.assertEqual((answer.status, answer.json()["names"]), (200, ["floor"]))
        for reference in (second, "floor"):
            self.assertEqual(server.request("DELETE", "/v1/lightmaps/" + reference).status, 204)
            self.assert_problem(server.get("/v1/lightmaps/" + reference), 404, "not_found")
        self.assertEqual(os.listdir(os.path.join(self.data, "lightmaps")), [])

    def test_volumes_and_lightmaps_of_one_name_are_two_files(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(2), "court")
        maps = self.upload(server, "lightmaps", self.lightmap_file(), "court")
        self.assertEqual(server.get("/v1/volumes/court").json()["id"], volume)
        self.assertEqual(server.get("/v1/lightmaps/court").json()["id"], maps)
        self.assert_problem(server.get("/v1/volumes/" + maps), 404, "not_found")

    def test_a_damaged_section_is_refused_by_its_name(self):
        server = self.start()
        good = read(self.lightmap_file())
        for name, offset, size in sections_of(good):
            with self.subTest(section=name):
                bad = bytearray(good)
                bad[offset + size // 2] ^= 0x55
                self.assertIn(f'"{name}"', self.refuse(server, "lightmaps", bytes(bad)))

    def test_a_cut_file_and_a_damaged_head_are_refused(self):
        server = self.start()
        good = read(self.lightmap_file())
        for size in (1, 8, 63, 64, 200, len(good) // 2, len(good) - 1):
            self.refuse(server, "lightmaps", good[:size])
        for place in (0, 12, 24, 64, 96):
            self.refuse(server, "lightmaps", good[:place] + bytes([good[place] ^ 0x55]) + good[place + 1:])
        self.assert_problem(server.post("/v1/lightmaps", b"", BINARY), 400, "missing_value")

    def test_files_of_another_kind_are_refused(self):
        server = self.start()
        for other in (read(self.volume_file(2)), read(COURTYARD), b"#?RADIANCE\n"):
            self.assertIn("is not a lightmap file", self.refuse(server, "lightmaps", other))
        self.assertIn("/v1/lightmaps", self.refuse(server, "volumes", read(self.lightmap_file())))

    def test_parts_of_bakes_are_refused(self):
        server = self.start()
        self.lightmap_file()
        settings = ("--texels-per-meter", "2", "--page-size", "32", "--samples", "16", "--sky", "1")
        part = self.written("some.part", "lightmap", "triangle.glb", *settings, "--texels", "0..1")
        self.assertIn("merge its parts first", self.refuse(server, "lightmaps", part))
        write_groups(os.path.join(self.folder, "groups.json"), lattice(2))
        part = self.written("few.part", "bake", "triangle.glb", "--groups", "groups.json",
                            "--samples", "16", "--probes", "0..1")
        self.assertIn("merge its parts first", self.refuse(server, "volumes", part))


class Download(LightmapTest):
    def setUp(self):
        super().setUp()
        self.server = self.start()
        self.path = self.lightmap_file()
        self.data_of_file = read(self.path)
        self.maps = self.upload(self.server, "lightmaps", self.path, "floor")

    def test_ranges_and_tags(self):
        whole, size = self.data_of_file, len(self.data_of_file)
        file = "/v1/lightmaps/floor/file"
        self.assertEqual(self.server.get(file).headers["ETag"], f'"{self.maps}"')
        for asked, begin, end in (("bytes=0-9", 0, 10), ("bytes=100-", 100, size), ("bytes=-7", size - 7, size)):
            part = self.server.get(file, Range=asked)
            self.assertEqual((part.status, part.body), (206, whole[begin:end]))
            self.assertEqual(part.headers["Content-Range"], f"bytes {begin}-{end - 1}/{size}")
        self.assert_problem(self.server.get(file, Range=f"bytes={size}-"), 416, "invalid_range")
        self.assertEqual(self.server.get(file, If_None_Match=f'"{self.maps}"').status, 304)
        by_id = self.server.get(f"/v1/lightmaps/{self.maps}/file")
        self.assertIn("immutable", by_id.headers["Cache-Control"])

    def test_sections_are_what_the_file_holds(self):
        names = []
        for name, offset, size in sections_of(self.data_of_file):
            answer = self.server.get("/v1/lightmaps/floor/sections/" + name)
            self.assertEqual(answer.body, self.data_of_file[offset:offset + size], name)
            part = self.server.get("/v1/lightmaps/floor/sections/" + name, Range="bytes=0-0")
            self.assertEqual((part.status, part.body), (206, answer.body[:1]), name)
            names.append(name)
        self.assertLessEqual({"info", "irradiance", "light", "rectangles"}, set(names))
        problem = self.assert_problem(self.server.get("/v1/lightmaps/floor/sections/none"), 404, "not_found")
        self.assertIn(json.dumps(names, separators=(",", ":")), problem["detail"])

    def test_sections_of_a_damaged_file_are_not_sent(self):
        section = "/v1/lightmaps/floor/sections/irradiance"
        self.assertEqual(self.server.get(section).status, 200)
        self.damage(self.stored_maps(self.maps))
        problem = self.assert_problem(self.server.get(section), 410, "quarantined")
        self.assertIn("the lightmaps are damaged", problem["detail"])
        name = f"lightmaps-{self.maps}.lightmaps"
        entries = self.server.get("/v1/quarantine").json()["quarantine"]
        self.assertEqual([(e["name"], e["kind"], e["id"]) for e in entries], [(name, "lightmaps", self.maps)])
        self.assert_problem(self.server.post(f"/v1/quarantine/{name}/restore"), 422, "bad_data")
        shutil.copy(self.path, os.path.join(self.data, "quarantine", name))
        answer = self.server.post(f"/v1/quarantine/{name}/restore")
        self.assertEqual((answer.status, answer.json()["names"]), (200, ["floor"]))
        self.assertEqual(self.server.get(section).status, 200)

    def test_a_reader_serves_them(self):
        reader = self.start("--read-only")
        self.assertEqual(reader.get("/v1/lightmaps/floor/file").body, self.data_of_file)
        self.assertEqual(reader.get("/v1/lightmaps/floor/sections/info").status, 200)
        self.assert_problem(reader.request("DELETE", "/v1/lightmaps/floor"), 403, "read_only")


class Use(LightmapTest):
    def setUp(self):
        super().setUp()
        self.server = self.start()
        self.path = self.lightmap_file()
        self.maps = self.upload(self.server, "lightmaps", self.path, "floor")

    def test_validate(self):
        answer = self.server.post("/v1/lightmaps/floor/validate").json()
        self.assertEqual((answer["is_valid"], answer["problems"]), (True, []))
        self.assert_problem(self.server.post("/v1/lightmaps/none/validate"), 404, "not_found")

    def test_relight(self):
        answer = self.server.post("/v1/lightmaps/floor/relight", {"weights": {"sky": 0.5}, "name": "dusk"})
        self.assertEqual(answer.status, 201, answer.body)
        expected = self.written("dusk.lightmaps", "relight", self.path, "--weights", "sky=0.5")
        self.assertEqual(self.server.get("/v1/lightmaps/dusk/file").body, expected)
        layers = self.server.get("/v1/lightmaps/dusk").json()["facts"]["layers"]
        self.assertIn({"name": "sky", "weight": 0.5}, layers)
        answer = self.server.post("/v1/lightmaps/floor/relight", {"blend": "dusk", "blend_share": 0.25})
        self.assertEqual(answer.status, 201, answer.body)
        expected = self.written("late.lightmaps", "relight", self.path, "--blend",
                                os.path.join(self.folder, "dusk.lightmaps"), "--blend-share", "0.25")
        self.assertEqual(self.server.get(answer.headers["Location"] + "/file").body, expected)

    def test_errors_of_relighting_name_their_member(self):
        volume = self.upload(self.server, "volumes", self.volume_file(2))
        for reference, order, status, field in (
                ("floor", {"weights": {"none": 1}}, 422, "weights.none"),
                ("floor", {"weights": {"sky": "x"}}, 400, "weights.sky"),
                ("floor", {"blend": volume}, 404, "blend"), ("floor", {"sky": [1, 1, 1]}, 400, "sky"),
                ("floor", {"volume": volume}, 400, "volume"), (volume, {}, 404, "volume")):
            with self.subTest(order=order):
                answer = self.server.post(f"/v1/lightmaps/{reference}/relight", order)
                self.assertEqual((answer.status, answer.json()["field"]), (status, field), answer.body)
        problem = self.server.post("/v1/relight", {"volume": self.maps, "weights": {"sky": 1}})
        self.assert_problem(problem, 404, "not_found")

    def test_pictures_take_light_from_them(self):
        self.upload(self.server, "scenes", COURTYARD, "court")
        volume = self.volume_file(2)
        self.upload(self.server, "volumes", volume, "dark")
        path = os.path.join(self.folder, "court.lightmaps")
        self.command("lightmap", COURTYARD, "-o", path, "--texels-per-meter", "0.5", "--page-size", "256",
                     "--samples", "4", "--bounces", "1")
        self.upload(self.server, "lightmaps", path, "court")
        order = {"scene": "court", "volume": "dark", "camera": "camera", "width": 64, "height": 36, "antialias": 1}
        picture = self.server.post("/v1/render", {**order, "lightmaps": "court"})
        self.assertEqual(picture.status, 200, picture.body)
        expected = self.written("court.png", "render", COURTYARD, volume, "--lightmaps", path, "--camera", "camera",
                                "--width", "64", "--height", "36", "--antialias", "1")
        self.assertEqual(picture.body, expected)
        self.assertNotEqual(self.server.post("/v1/render", order).body, expected)
        problem = self.server.post("/v1/render", {**order, "lightmaps": "none"})
        self.assertEqual(self.assert_problem(problem, 404, "not_found")["field"], "lightmaps")


class Folder(LightmapTest):
    def test_fsck_finds_damage_and_changes_nothing(self):
        server = self.start()
        maps = [self.upload(server, "lightmaps", self.lightmap_file(n)) for n in (1, 2, 3)]
        code, report = self.run_command("fsck", self.data)
        self.assertEqual((code, report["files"]), (0, 3))
        server.stop()
        self.damage(self.stored_maps(maps[0]))
        os.remove(self.stored_maps(maps[1]))
        with open(os.path.join(self.data, "lightmaps", "notes"), "w") as file:
            file.write("mine")
        code, report = self.run_command("fsck", self.data)
        self.assertEqual((code, {(f["kind"], f["path"]) for f in report["findings"]}),
                         (1, {("damaged", f"lightmaps/{maps[0]}.lightmaps"),
                              ("missing", f"lightmaps/{maps[1]}.lightmaps"), ("unknown", "lightmaps/notes")}))
        self.assertEqual(os.listdir(os.path.join(self.data, "quarantine")), [])

    def test_a_backup_brings_them_back(self):
        server = self.start()
        path = self.lightmap_file()
        maps = self.upload(server, "lightmaps", path, "floor")
        archive, copy = (os.path.join(self.folder, name) for name in ("backup.tar", "copy"))
        self.assertEqual(self.run_command("backup", self.data, "-o", archive)[0], 0)
        with tarfile.open(archive) as tar:
            self.assertIn(f"lightmaps/{maps}.lightmaps", tar.getnames())
        self.assertEqual(self.run_command("restore", archive, "-o", copy)[0], 0)
        self.assertEqual(self.run_command("fsck", copy)[1]["findings"], [])
        other = self.start(data=copy)
        self.assertEqual(other.get("/v1/lightmaps/floor/file").body, read(path))
        self.assertEqual(other.get("/v1/lightmaps/floor").json()["facts"],
                         server.get("/v1/lightmaps/floor").json()["facts"])

    def test_damaged_ones_of_a_backup_are_told_and_put_aside(self):
        server = self.start()
        maps = self.upload(server, "lightmaps", self.lightmap_file())
        self.damage(self.stored_maps(maps))
        archive, copy = (os.path.join(self.folder, name) for name in ("backup.tar", "copy"))
        for command in (("backup", self.data, "-o", archive), ("restore", archive, "-o", copy)):
            code, report = self.run_command(*command)
            self.assertEqual((code, len(report["damaged"])), (1, 1), command)
            self.assertIn(maps, report["damaged"][0])
        self.assertEqual(os.listdir(os.path.join(copy, "quarantine")), [f"lightmaps-{maps}.lightmaps"])

    def test_unknown_ones_are_taken_in_or_put_aside(self):
        self.start().stop()
        path = self.lightmap_file()
        junk = b"TETRALM\n of another program"
        whole, broken = (hashlib.sha256(data).hexdigest() for data in (read(path), junk))
        shutil.copy(path, self.stored_maps(whole))
        for name, data in ((broken, junk), ("0" * 64, b"other bytes")):
            with open(self.stored_maps(name), "wb") as file:
                file.write(data)
        server = self.start()
        self.assertEqual(server.get(f"/v1/lightmaps/{whole}/file").body, read(path))
        self.assertEqual(os.listdir(os.path.join(self.data, "quarantine")),
                         [f"unknown-lightmaps-{'0' * 64}.lightmaps"])
        # Its bytes have its id, so that only its use shows that they are no lightmaps.
        self.assert_problem(server.get(f"/v1/lightmaps/{broken}/sections/info"), 410, "quarantined")
        self.assertEqual(server.get("/v1/lightmaps/" + broken).json()["state"], "quarantined")

    def test_a_folder_of_a_server_without_lightmaps(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(2), "level")
        server.stop()
        os.rmdir(os.path.join(self.data, "lightmaps"))
        reader = self.start("--read-only")
        self.assertEqual(reader.get("/readyz").status, 200)
        self.assertEqual(reader.get("/v1/lightmaps").json()["lightmaps"], [])
        reader.stop()
        self.assertEqual(self.run_command("fsck", self.data)[0], 0)
        for name in ("tetralight.db", "index.json"):
            os.remove(os.path.join(self.data, name))
        code, report = self.run_command("fsck", self.data)
        self.assertEqual((code, {f["kind"] for f in report["findings"]}, report["files"]), (1, {"missing"}, 1))
        server = self.start()
        self.assertEqual(server.get("/v1/volumes/" + volume).json()["state"], "ready")
        self.upload(server, "lightmaps", self.lightmap_file())


if __name__ == "__main__":
    unittest.main()
