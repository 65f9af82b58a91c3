# SPDX-License-Identifier: Apache-2.0
"""Bakes of lightmaps are bakes like those of probes, and show what they have so far."""
import json
import os
import random
import sqlite3
import time
import unittest

from service import COURTYARD, read
from test_bakes import BakeTest

COARSE = {"texels_per_meter": 1, "page_size": 256, "samples": 32}
OPTIONS = ("--texels-per-meter", "1", "--page-size", "256", "--samples", "32")
# Some seconds of work.
SLOW = {"texels_per_meter": 1, "page_size": 256, "samples": 2048}
SLOW_OPTIONS = ("--texels-per-meter", "1", "--page-size", "256", "--samples", "2048")
# More than any test waits for.
ENDLESS = {"texels_per_meter": 1, "page_size": 64, "target_error": 0.0001, "max_samples": 1 << 24}


class LightmapBakeTest(BakeTest):
    def begin_maps(self, server, **members):
        return self.begin(server, "/v1/lightmap-bakes", **members)

    def maps_by_command(self, *options):
        path = os.path.join(self.folder, "expected.lightmaps")
        self.command("lightmap", COURTYARD, "-o", path, *options)
        return read(path)

    def maps_of(self, server, bake):
        answer = server.wait_for(bake)
        self.assertEqual(answer["state"], "done", answer)
        return server.get(f"/v1/lightmaps/{answer['lightmaps']}/file").body

    def wait_for_preview(self, server, bake):
        answer = {}

        def has_preview():
            answer.update(server.get("/v1/bakes/" + bake).json())
            self.assertIn(answer["state"], ("queued", "running"), answer)
            return answer["preview"] is not None
        self.assertTrue(self.eventually(has_preview, 120), answer)
        return answer


class LightmapBakes(LightmapBakeTest):
    def test_the_bytes_are_those_of_the_command(self):
        server = self.start()
        bake = self.begin_maps(server, **COARSE, layers=["sky"], name="court")
        expected = self.maps_by_command(*OPTIONS, "--layers", "sky")
        self.assertEqual(self.maps_of(server, bake), expected)
        self.assertEqual(server.get("/v1/lightmaps/court/file").body, expected)
        answer = server.get("/v1/bakes/" + bake).json()
        self.assertEqual(answer["kind"], "lightmaps")
        self.assertEqual(answer["texels_done"], answer["texel_count"])
        self.assertEqual(answer["report"]["baked"], answer["texel_count"])
        self.assertNotIn("volume", answer)
        facts = server.get("/v1/lightmaps/court").json()["facts"]
        self.assertEqual(facts["pages"], answer["report"]["pages"])
        self.wait_for_no_folders()
        server.kill()
        self.assertEqual(self.start().get("/v1/bakes/" + bake).json(), answer)

    def test_wrong_orders_are_refused_at_once_and_name_the_member(self):
        server = self.start()
        for members, status, code, field in (
                ({}, 400, "missing_value", "scene"),
                ({"scene": self.scene, "samples": 0}, 400, "invalid_value", "samples"),
                ({"scene": self.scene, "texels_per_meter": -1}, 400, "invalid_value", "texels_per_meter"),
                ({"scene": self.scene, "uvs": "none"}, 400, "invalid_value", "uvs"),
                ({"scene": self.scene, "priority": 1e9}, 400, "invalid_value", "priority"),
                ({"scene": self.scene, "groups": []}, 400, "unknown_member", "groups"),
                ({"scene": self.scene, "preview": "/etc/passwd"}, 400, "unknown_member", "preview"),
                ({"scene": self.scene, "output": "/etc/passwd"}, 400, "unknown_member", "output"),
                ({"scene": self.scene, "max_samples": 5}, 400, "invalid_value", "max_samples"),
                ({"scene": self.scene, "sky": "none"}, 404, "not_found", "sky"),
                ({"scene": "none"}, 404, "not_found", "scene"),
                ({"scene": self.scene, "layers": ["transfer"]}, 422, "bad_data", "layers[0]"),
                ({"scene": self.scene, "only": ["nothing"]}, 422, "bad_data", "only[0]")):
            with self.subTest(members=members):
                problem = self.assert_problem(server.post("/v1/lightmap-bakes", members), status, code)
                self.assertEqual(problem["field"], field)
        self.assertEqual(server.get("/v1/bakes").json()["bakes"], [])

    def test_an_object_that_fits_in_no_page_fails_the_bake_with_the_reason(self):
        server = self.start()
        answer = server.wait_for(self.begin_maps(server, page_size=64))
        self.assertEqual(answer["state"], "failed")
        self.assertIn('object "', answer["error"])

    def test_killed_at_any_moment_it_ends_with_the_same_bytes(self):
        expected = self.maps_by_command(*SLOW_OPTIONS)
        generator = random.Random(int(os.environ.get("TETRALIGHT_SEED", "0")))
        server = self.start()
        bake = self.begin_maps(server, **SLOW)
        kept = 0
        for _ in range(3):
            self.wait_for_chunks(bake, kept + 1)
            kept = len(os.listdir(self.chunk_folder(bake)))
            time.sleep(generator.uniform(0, 0.3))
            server.kill()
            server = self.start()
        self.assertEqual(self.maps_of(server, bake), expected)

    def test_volumes_and_lightmaps_share_a_queue(self):
        server = self.start()
        running = self.begin_maps(server, **ENDLESS)
        probes = self.begin(server, samples=16)
        maps = self.begin_maps(server, **COARSE, priority=1)
        listed = server.get("/v1/bakes").json()["bakes"]
        self.assertEqual([bake["kind"] for bake in listed], ["lightmaps", "volumes", "lightmaps"])
        self.assertEqual([bake["state"] for bake in listed[:2]], ["queued", "queued"])
        self.assertEqual(server.post(f"/v1/bakes/{running}/cancel").json()["state"], "cancelled")
        first, second = server.wait_for(maps), server.wait_for(probes)
        self.assertLess(first["ended"], second["ended"])
        self.assertEqual((first["state"], second["state"]), ("done", "done"))
        self.assertEqual(second["kind"], "volumes")
        self.assertEqual(server.request("DELETE", "/v1/bakes/" + running).status, 204)

    def test_an_older_database_has_bakes_of_volumes(self):
        server = self.start()
        bake = self.begin(server, samples=16)
        server.wait_for(bake)
        server.stop()
        with sqlite3.connect(os.path.join(self.data, "tetralight.db")) as database:
            database.execute("ALTER TABLE bakes DROP COLUMN kind")
            database.execute("PRAGMA user_version = 6")  # the version before the column
        answer = self.start().get("/v1/bakes/" + bake).json()
        self.assertEqual((answer["kind"], answer["state"]), ("volumes", "done"))


class Previews(LightmapBakeTest):
    def test_a_bake_shows_its_pages_its_scene_and_texels_at_the_target(self):
        server = self.start()
        bake = self.begin_maps(server, **ENDLESS)
        self.assertEqual(server.get(f"/v1/bakes/{bake}").json()["preview"], None)
        problem = self.assert_problem(server.get(f"/v1/bakes/{bake}/preview"), 404, "not_found")
        self.assertIn("no preview yet", problem["detail"])
        answer = self.wait_for_preview(server, bake)
        self.assertEqual(answer["preview"], 1)
        self.assertGreater(answer["texel_count"], 5000)
        self.assertLessEqual(answer["at_target"], answer["texel_count"])
        self.assertAlmostEqual(answer["share_at_target"], answer["at_target"] / answer["texel_count"], 3)
        for page in ("", "?page=0", "?page=1"):  # 64 x 64 texels are not enough for one page
            picture = server.get(f"/v1/bakes/{bake}/preview{page}")
            self.assertEqual((picture.status, picture.headers["Content-Type"]), (200, "image/png"))
            self.assertEqual(picture.body[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(picture.body[16:24], (64).to_bytes(4, "big") * 2)
        beyond = self.assert_problem(server.get(f"/v1/bakes/{bake}/preview?page=99"), 404, "not_found")
        problem = self.assert_problem(server.get(f"/v1/bakes/{bake}/preview?page=x"), 400, "invalid_value")
        self.assertEqual(problem["field"], "page")
        path = os.path.join(self.folder, "now.lightmaps")
        with open(path, "wb") as file:
            file.write(server.get(f"/v1/bakes/{bake}/preview/file").body)
        facts = json.loads(self.command("info", path, "--json"))
        self.assertEqual((beyond["field"], beyond["value"]), ("page", "99"))
        self.assertEqual(beyond["detail"],
                         f"page: there is no page 99; the preview has {facts['pages']} pages, from 0 on")
        self.assertEqual((facts["page_size"], facts["has_directions"]), (64, False))
        self.assertGreater(facts["covered_texels"], answer["texel_count"])
        scene = server.get(f"/v1/bakes/{bake}/preview/scene").body
        self.assertEqual(scene[:4], b"glTF")
        document = json.loads(scene[20:20 + int.from_bytes(scene[12:16], "little")])
        places = [node["extras"]["lightmap_rectangle"] for node in document["nodes"]
                  if "lightmap_rectangle" in node.get("extras", {})]
        self.assertEqual(len(places), facts["objects"])
        self.assertLess(max(place["page"] for place in places), facts["pages"])
        server.post(f"/v1/bakes/{bake}/cancel")
        for path in ("preview", "preview/file", "preview/scene"):
            problem = self.assert_problem(server.get(f"/v1/bakes/{bake}/{path}"), 404, "not_found")
            self.assertIn("the bake has ended: cancelled", problem["detail"])
        self.wait_for_no_folders()

    def test_events_name_the_newest_preview(self):
        server = self.start()
        bake = self.begin_maps(server, **ENDLESS)
        connection = server.connect()
        connection.request("GET", f"/v1/bakes/{bake}/events")
        response = connection.getresponse()
        newest = None
        while newest is None:
            line = response.readline().decode()
            self.assertTrue(line)
            if line.startswith("data: "):
                newest = json.loads(line[6:])["preview"]
        connection.close()
        self.assertEqual(newest, 1)
        self.assertEqual(server.get(f"/v1/bakes/{bake}/preview").status, 200)

    def test_a_bake_of_probes_shows_the_volume_so_far(self):
        server = self.start()
        bake = self.begin(server, target_error=0.0001, max_samples=1 << 24, layers=["sky"])
        self.assertIn("no preview yet", self.assert_problem(
            server.get(f"/v1/bakes/{bake}/preview/file"), 404, "not_found")["detail"])
        answer = self.wait_for_preview(server, bake)
        path = os.path.join(self.folder, "now.probes")
        with open(path, "wb") as file:
            file.write(server.get(f"/v1/bakes/{bake}/preview/file").body)
        facts = json.loads(self.command("info", path, "--json"))
        self.assertEqual(facts["probes"], answer["probe_count"])
        self.assertEqual([layer["name"] for layer in facts["layers"]], ["sky", "rest"])
        self.assertTrue(facts["is_baked"], facts)
        for name in ("preview", "preview/scene"):
            problem = self.assert_problem(server.get(f"/v1/bakes/{bake}/{name}"), 404, "not_found")
            self.assertIn("only bakes of lightmaps have pages", problem["detail"])
        server.post(f"/v1/bakes/{bake}/cancel")
        problem = self.assert_problem(server.get(f"/v1/bakes/{bake}/preview/file"), 404, "not_found")
        self.assertIn("the bake has ended: cancelled", problem["detail"])
        self.assert_problem(server.get("/v1/bakes/none/preview/file"), 404, "not_found")
        self.wait_for_no_folders()

    def test_links_that_a_program_leaves_are_not_followed(self):
        server = self.start()
        bake = self.begin_maps(server, **ENDLESS)
        results = os.path.join(self.data, "bakes", bake, "results")
        # The picture of a single page: this bake has several, and does not write it.
        path = os.path.join(results, "preview.png")
        for make, remove in ((lambda: os.symlink(COURTYARD, path), os.remove),
                             (lambda: os.mkfifo(path), os.remove), (lambda: os.mkdir(path), os.rmdir)):
            make()
            answer = server.get(f"/v1/bakes/{bake}/preview")
            self.assertIn(answer.status, (200, 404))
            self.assertNotEqual(answer.body, read(COURTYARD))
            remove(path)
        os.symlink(COURTYARD, os.path.join(results, "preview_7.png"))
        self.assert_problem(server.get(f"/v1/bakes/{bake}/preview?page=7"), 404, "not_found")


class Exports(LightmapBakeTest):
    def test_the_bytes_are_those_of_the_command(self):
        server = self.start()
        path = os.path.join(self.folder, "court.lightmaps")
        self.command("lightmap", COURTYARD, "-o", path, *OPTIONS)
        self.upload(server, "lightmaps", path, "court")
        for order, kind, options in (({"scene": self.scene}, "model/gltf-binary", ("--scene", COURTYARD)),
                                     ({"as": "ktx2"}, "image/ktx2", ())):
            name = "out.glb" if options else "out.ktx2"
            self.command("export", path, "-o", name, *options)
            answer = server.post("/v1/lightmaps/court/export", order)
            self.assertEqual((answer.status, answer.headers["Content-Type"]), (200, kind), answer.body[:200])
            self.assertEqual(answer.body, read(os.path.join(self.folder, name)))
            self.assertGreaterEqual(json.loads(answer.headers["X-Tetralight-Report"])["pages"], 1)

    def test_what_it_cannot_export_is_refused(self):
        server = self.start()
        maps = self.upload(server, "lightmaps", self.lightmap_file(), "floor")
        path = f"/v1/lightmaps/{maps}/export"
        for order, status, code, field in (({}, 400, "invalid_value", "scene"),
                                           ({"as": "png"}, 400, "invalid_value", "as"),
                                           ({"as": "ktx2", "mark": ["a"]}, 400, "unknown_member", "mark"),
                                           ({"scene": "none"}, 404, "not_found", "scene"),
                                           ({"scene": self.scene}, 422, "bad_data", "scene")):
            with self.subTest(order=order):
                problem = self.assert_problem(server.post(path, order), status, code)
                self.assertEqual(problem["field"], field)
        self.assert_problem(server.post("/v1/lightmaps/none/export", {"as": "ktx2"}), 404, "not_found")


if __name__ == "__main__":
    unittest.main()
