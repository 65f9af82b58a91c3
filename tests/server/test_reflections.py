# SPDX-License-Identifier: Apache-2.0
"""Reflection probes are stored, served and baked like lightmaps."""
import contextlib
import hashlib
import json
import os
import re
import sqlite3
import subprocess
import tarfile
import unittest

from service import BINARY, COURTYARD, read, room_scene, triangle_scene, write_groups
from test_backup import DataFolder

SMALL = {"cube_size": 8, "samples": 4, "sky": 2}
OPTIONS = ("--cube-size", "8", "--samples", "4", "--sky", "2")
# More than any test waits for.
ENDLESS = {"cube_size": 256, "samples": 1 << 14, "sky": 2}


class ReflectionTest(DataFolder):
    def stored_cubes(self, cubes):
        return os.path.join(self.data, "reflections", cubes + ".ktx2")

    def room_file(self):
        path = os.path.join(self.folder, "room.glb")
        with open(path, "wb") as file:
            file.write(room_scene())
        return path


class Upload(ReflectionTest):
    def test_they_come_back_byte_for_byte_with_the_facts_of_info(self):
        server = self.start()
        path = self.reflection_file()
        answer = server.post("/v1/reflections?name=room", read(path), BINARY)
        cubes = answer.json()["id"]
        self.assertEqual((answer.status, cubes), (201, hashlib.sha256(read(path)).hexdigest()))
        self.assertEqual(answer.headers["Location"], "/v1/reflections/" + cubes)
        self.assertEqual(server.post("/v1/reflections", read(path), BINARY).status, 200)
        listed = server.get("/v1/reflections").json()["reflections"]
        self.assertEqual([(file["id"], file["names"]) for file in listed], [(cubes, ["room"])])
        facts = server.get("/v1/reflections/room").json()["facts"]
        self.assertEqual({**facts, "file": path}, json.loads(self.command("info", path, "--json")))
        self.assertEqual([probe["name"] for probe in facts["probes"]], ["room", "sky"])
        download = server.get("/v1/reflections/room/file")
        self.assertEqual((download.body, download.headers["Content-Type"]), (read(path), "image/ktx2"))
        self.assertIn(f'filename="{cubes}.ktx2"', download.headers["Content-Disposition"])
        self.assertEqual(download.headers["ETag"], f'"{cubes}"')
        part = server.get("/v1/reflections/room/file", Range="bytes=1-6")
        self.assertEqual((part.status, part.body), (206, b"KTX 20"))
        self.assertIn("tetralight_reflections 1\n", server.get("/metrics").body.decode())

    def test_names_move_and_the_last_one_takes_the_file(self):
        server = self.start()
        first = self.upload(server, "reflections", self.reflection_file(1), "room")
        second = self.upload(server, "reflections", self.reflection_file(2), "room")
        self.assertNotEqual(first, second)
        self.assertEqual(server.get("/v1/reflections/room").json()["id"], second)
        answer = server.request("PATCH", "/v1/reflections/" + first, {"name": "room"})
        self.assertEqual((answer.status, answer.json()["names"]), (200, ["room"]))
        for reference in (second, "room"):
            self.assertEqual(server.request("DELETE", "/v1/reflections/" + reference).status, 204)
            problem = self.assert_problem(server.get("/v1/reflections/" + reference), 404, "not_found")
            self.assertEqual(problem["detail"], "there are no such reflections")
        self.assertEqual(os.listdir(os.path.join(self.data, "reflections")), [])

    def test_damaged_files_are_refused_with_the_reason_that_info_gives(self):
        server = self.start()
        good = read(self.reflection_file())
        path = os.path.join(self.folder, "bad.ktx2")
        key = good.index(b"tetralightReflections")
        for bad in (good[:-8], good[:80],
                    good[:-8] + b"\xff" * 8,                           # no numbers
                    good[:key] + b"anotherapp" + good[key + 10:],      # a texture of others
                    good[:12] + b"\x25" + good[13:]):                  # of another format
            with self.subTest(bytes=len(bad)):
                with open(path, "wb") as file:
                    file.write(bad)
                code, report = self.run_command("info", path)
                self.assertNotEqual(code, 0)
                reason = report["error"]["message"].removeprefix(path + ": ")
                self.assertIn(reason, self.refuse(server, "reflections", bad))
        self.assert_problem(server.post("/v1/reflections", b"", BINARY), 400, "missing_value")

    def test_files_of_another_kind_are_refused(self):
        server = self.start()
        cubes = read(self.reflection_file())
        for other in (read(self.lightmap_file()), read(COURTYARD), b"#?RADIANCE\n", cubes[:11]):
            self.assertIn("is not a file of reflection probes", self.refuse(server, "reflections", other))
        self.assertIn("/v1/reflections", self.refuse(server, "volumes", cubes))
        self.assertIn("is not a lightmap file", self.refuse(server, "lightmaps", cubes))


class Use(ReflectionTest):
    def test_validate(self):
        server = self.start()
        self.upload(server, "reflections", self.reflection_file(), "room")
        answer = server.post("/v1/reflections/room/validate").json()
        self.assertEqual((answer["is_valid"], answer["problems"]), (True, []))
        self.assert_problem(server.post("/v1/reflections/none/validate"), 404, "not_found")

    def test_pictures_mirror_them(self):
        server = self.start()
        scene, cubes = self.room_file(), self.reflection_file()
        groups, volume = (os.path.join(self.folder, name) for name in ("room.json", "room.probes"))
        write_groups(groups, [[x, y, z] for x in (-1, 3) for y in (-1, 2) for z in (-1, 3)])
        self.command("bake", scene, "-o", volume, "--groups", groups, "--samples", "16", "--sky", "1")
        for kind, path in (("scenes", scene), ("volumes", volume), ("reflections", cubes)):
            self.upload(server, kind, path, "room")
        order = {"scene": "room", "volume": "room", "eye": [1, -2, 1.5], "target": [1, 0, 1],
                 "width": 32, "height": 32, "antialias": 1}
        picture = server.post("/v1/render", {**order, "reflections": "room"})
        self.assertEqual(picture.status, 200, picture.body)
        path = os.path.join(self.folder, "room.png")
        self.command("render", scene, volume, "--reflections", cubes, "--eye", "1,-2,1.5", "--target", "1,0,1",
                     "--width", "32", "--height", "32", "--antialias", "1", "-o", path)
        self.assertEqual(picture.body, read(path))
        self.assertNotEqual(server.post("/v1/render", order).body, picture.body)
        problem = server.post("/v1/render", {**order, "reflections": "none"})
        self.assertEqual(self.assert_problem(problem, 404, "not_found")["field"], "reflections")


class Bakes(ReflectionTest):
    def setUp(self):
        super().setUp()
        self.server = self.start()
        self.upload(self.server, "scenes", self.room_file(), "room")

    def begin(self, **members):
        answer = self.server.post("/v1/reflection-bakes", {"scene": "room", **members})
        self.assertEqual(answer.status, 202, answer.body)
        self.assertEqual(answer.headers["Location"], "/v1/bakes/" + answer.json()["id"])
        return answer.json()["id"]

    def by_command(self, *options):
        path = os.path.join(self.folder, "expected.ktx2")
        self.command("reflect", self.room_file(), "-o", path, *options)
        return read(path)

    def cubes_of(self, bake):
        answer = self.server.wait_for(bake)
        self.assertEqual(answer["state"], "done", answer)
        return self.server.get(f"/v1/reflections/{answer['reflections']}/file").body

    def has_no_folders(self):
        return os.listdir(os.path.join(self.data, "bakes")) == []

    def wait_for_row(self, bake):
        """Some rows are baked, and not all."""
        answer = {}

        def is_under_way():
            answer.update(self.server.get("/v1/bakes/" + bake).json())
            self.assertIn(answer["state"], ("queued", "running"), answer)
            return answer["row_count"] > 0
        self.assertTrue(self.eventually(is_under_way, 60), answer)
        self.assertLess(answer["rows_done"], answer["row_count"])
        return answer

    def test_the_bytes_are_those_of_the_command(self):
        bake = self.begin(**SMALL, name="cubes")
        expected = self.by_command(*OPTIONS)
        self.assertEqual(self.cubes_of(bake), expected)
        self.assertEqual(self.server.get("/v1/reflections/cubes/file").body, expected)
        answer = self.server.get("/v1/bakes/" + bake).json()
        self.assertEqual(answer["kind"], "reflections")
        # Eight rows on each of the six faces of the room's cube.
        self.assertEqual((answer["rows_done"], answer["row_count"]), (48, 48))
        self.assertEqual([probe["name"] for probe in answer["report"]["probes"]], ["room", "sky"])
        self.assertFalse(answer.keys() & {"volume", "lightmaps", "preview", "probes_done", "texels_done"})
        facts = self.server.get("/v1/reflections/cubes").json()["facts"]
        self.assertEqual(facts["cube_size"], answer["report"]["cube_size"])
        self.assert_problem(self.server.get(f"/v1/bakes/{bake}/preview"), 404, "not_found")
        self.assertTrue(self.eventually(self.has_no_folders))
        self.server.kill()
        self.assertEqual(self.start().get("/v1/bakes/" + bake).json(), answer)

    def test_one_box_instead_of_the_probes_of_the_scene(self):
        box = [0, 0.5, 0, 2, 2, 2]
        bake = self.begin(**SMALL, box=box, position=[1, 1, 1.5], blend_distance=0.25, no_sky=True)
        self.assertEqual(self.cubes_of(bake), self.by_command(
            *OPTIONS, "--box=0,0.5,0,2,2,2", "--position", "1,1,1.5", "--blend-distance", "0.25", "--no-sky"))

    def test_wrong_orders_are_refused_at_once_and_name_the_member(self):
        for members, status, code, field in (
                ({}, 400, "missing_value", "scene"),
                ({"scene": "room", "samples": 0}, 400, "invalid_value", "samples"),
                ({"scene": "room", "cube_size": 7}, 400, "invalid_value", "cube_size"),
                ({"scene": "room", "cube_size": 24}, 400, "invalid_value", "cube_size"),
                ({"scene": "room", "box": [1, 2, 3]}, 400, "invalid_value", "box"),
                ({"scene": "room", "box": [1, 0, 0, 0, 1, 1]}, 400, "invalid_value", "box"),
                ({"scene": "room", "priority": 1e9}, 400, "invalid_value", "priority"),
                ({"scene": "room", "places": "/etc/passwd"}, 400, "unknown_member", "places"),
                ({"scene": "room", "output": "/etc/passwd"}, 400, "unknown_member", "output"),
                ({"scene": "room", "progress_file": "a"}, 400, "unknown_member", "progress_file"),
                ({"scene": "room", "explain": True}, 400, "unknown_member", "explain"),
                ({"scene": "room", "sky": "none"}, 404, "not_found", "sky"),
                ({"scene": "none"}, 404, "not_found", "scene"),
                ({"scene": "room", "probe": ["hall"]}, 422, "bad_data", "probe[0]")):
            with self.subTest(members=members):
                problem = self.assert_problem(self.server.post("/v1/reflection-bakes", members), status, code)
                self.assertEqual(problem["field"], field)
        self.assertEqual(self.server.get("/v1/bakes").json()["bakes"], [])

    def test_a_scene_with_nothing_to_reflect_is_refused(self):
        path = os.path.join(self.folder, "triangle.glb")
        with open(path, "wb") as file:
            file.write(triangle_scene())
        self.upload(self.server, "scenes", path, "bare")
        answer = self.server.post("/v1/reflection-bakes", {"scene": "bare"})
        problem = self.assert_problem(answer, 422, "bad_data")
        with self.assertRaises(subprocess.CalledProcessError) as failed:
            self.command("reflect", path, "-o", "bare.ktx2")
        reason = failed.exception.stderr.strip().split(path + ": ")[1]
        self.assertIn(reason, problem["detail"])
        self.assertEqual(self.server.get("/v1/bakes").json()["bakes"], [])

    def test_a_cancelled_bake_ends_and_leaves_nothing(self):
        bake = self.begin(**ENDLESS)
        answer = self.wait_for_row(bake)
        self.assertEqual(answer["row_count"], 6 * 256)
        self.assert_problem(self.server.request("DELETE", "/v1/bakes/" + bake), 409, "not_over")
        self.assertEqual(self.server.post(f"/v1/bakes/{bake}/cancel").json()["state"], "cancelled")
        self.assertTrue(self.eventually(lambda: self.server.children() == [] and self.has_no_folders()))
        self.assertEqual(self.server.get("/v1/reflections").json()["reflections"], [])
        self.assertEqual(self.server.request("DELETE", "/v1/bakes/" + bake).status, 204)
        self.assert_problem(self.server.get("/v1/bakes/" + bake), 404, "not_found")

    def test_after_a_restart_it_begins_again_and_gives_the_same_bytes(self):
        endless = self.begin(**ENDLESS)
        bake = self.begin(**SMALL)
        self.wait_for_row(endless)
        self.server.kill()
        self.server = self.start()
        self.wait_for_row(endless)
        self.server.post(f"/v1/bakes/{endless}/cancel")
        self.assertEqual(self.cubes_of(bake), self.by_command(*OPTIONS))


class Folder(ReflectionTest):
    def test_fsck_finds_damage_and_changes_nothing(self):
        server = self.start()
        cubes = [self.upload(server, "reflections", self.reflection_file(sky)) for sky in (1, 2)]
        code, report = self.run_command("fsck", self.data)
        self.assertEqual((code, report["files"]), (0, 2))
        server.stop()
        self.damage(self.stored_cubes(cubes[0]))
        os.remove(self.stored_cubes(cubes[1]))
        code, report = self.run_command("fsck", self.data)
        self.assertEqual((code, {(f["kind"], f["path"]) for f in report["findings"]}),
                         (1, {("damaged", f"reflections/{cubes[0]}.ktx2"),
                              ("missing", f"reflections/{cubes[1]}.ktx2")}))

    def test_a_backup_brings_them_back(self):
        server = self.start()
        path = self.reflection_file()
        cubes = self.upload(server, "reflections", path, "room")
        archive, copy = (os.path.join(self.folder, name) for name in ("backup.tar", "copy"))
        self.assertEqual(self.run_command("backup", self.data, "-o", archive)[0], 0)
        with tarfile.open(archive) as tar:
            self.assertIn(f"reflections/{cubes}.ktx2", tar.getnames())
        self.assertEqual(self.run_command("restore", archive, "-o", copy)[0], 0)
        self.assertEqual(self.run_command("fsck", copy)[1]["findings"], [])
        self.assertEqual(self.start(data=copy).get("/v1/reflections/room/file").body, read(path))

    def test_a_folder_of_an_earlier_version_keeps_its_files_and_takes_them(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(2), "level")
        maps = self.upload(server, "lightmaps", self.lightmap_file(), "level")
        server.stop()
        os.rmdir(os.path.join(self.data, "reflections"))
        with contextlib.closing(sqlite3.connect(os.path.join(self.data, "tetralight.db"))) as database:
            table = database.execute("SELECT sql FROM sqlite_schema WHERE name = 'files'").fetchone()[0]
            old = re.sub(r",\s*'reflections'", "", table)
            self.assertNotEqual(old, table)
            database.execute("PRAGMA writable_schema = ON")
            database.execute("UPDATE sqlite_schema SET sql = ? WHERE name = 'files'", (old,))
            database.execute("PRAGMA user_version = 7")
            database.commit()
        code, report = self.run_command("fsck", self.data)
        self.assertEqual((code, report["findings"]), (0, []))
        server = self.start()
        cubes = self.upload(server, "reflections", self.reflection_file(), "level")
        for kind, id in (("volumes", volume), ("lightmaps", maps), ("reflections", cubes)):
            self.assertEqual(server.get(f"/v1/{kind}/level").json()["id"], id)


if __name__ == "__main__":
    unittest.main()
