# SPDX-License-Identifier: Apache-2.0
"""What the command makes of a volume, over HTTP."""
import json
import os
import shutil
import socket
import unittest

from service import COMMAND, COURTYARD, ServiceTest, read


class Tools(ServiceTest):
    def setUp(self):
        super().setUp()
        self.server = self.start()
        self.scene = self.upload(self.server, "scenes", COURTYARD, "court")
        self.path = os.path.join(self.folder, "court.probes")

    def bake(self, *options):
        self.command("bake", COURTYARD, "-o", self.path, "--samples", "16", "-b", "1", *options)
        return self.upload(self.server, "volumes", self.path)

    def written(self, name, *arguments):
        """What the command writes to a file of that name."""
        path = os.path.join(self.folder, name)
        self.command(*arguments, "-o", path)
        return read(path)

    def test_they_run_although_another_program_was_installed_meanwhile(self):
        program = os.path.join(self.folder, "tetralight")
        shutil.copy(COMMAND, program)
        server = self.start(program=program, data=os.path.join(self.folder, "other"))
        os.remove(program)
        with open(program, "w", encoding="utf-8") as file:
            file.write("of another version")
        scene = self.upload(server, "scenes", COURTYARD)
        answer = server.post("/v1/grid", {"scene": scene, "spacing": 8})
        self.assertEqual(answer.status, 201, answer.body)

    def test_grid_and_tetrahedralize(self):
        answer = self.server.post("/v1/grid", {"scene": "court", "spacing": 4, "name": "grid"})
        self.assertEqual(answer.status, 201, answer.body)
        expected = self.written("grid.json", "grid", COURTYARD, "--spacing", "4", "--name", "grid")
        self.assertEqual(self.server.get("/v1/groups/grid/file").body, expected)
        self.assertGreater(answer.json()["report"]["probes"], 10)
        volume = self.server.post("/v1/tetrahedralize", {"groups": ["grid"], "name": "bare"})
        self.assertEqual(volume.status, 201, volume.body)
        bare = self.written("bare.probes", "tetrahedralize", os.path.join(self.folder, "grid.json"))
        self.assertEqual(self.server.get("/v1/volumes/bare/file").body, bare)

    def test_errors_name_their_member(self):
        volume = self.bake()
        for path, members, status, field, value in (
                ("grid", {"scene": "court"}, 400, "spacing", None),
                ("grid", {"scene": "court", "spacing": -1}, 400, "spacing", "-1"),
                ("grid", {"scene": "court", "spacing": 1, "mode": "x"}, 400, "mode", "x"),
                ("grid", {"scene": "court", "spacing": [1, 2]}, 400, "spacing", "[1,2]"),
                ("grid", {"scene": "court", "spacing": 1, "min": [0, 0, 0]}, 400, "min", "[0,0,0]"),
                ("grid", {"scene": "none", "spacing": 1}, 404, "scene", "none"),
                ("bakes", {"scene": "court", "samples": 0}, 400, "samples", "0"),
                ("bakes", {"scene": "court", "sky": "none"}, 404, "sky", "none"),
                ("bakes", {"scene": "court", "groups": ["none"]}, 404, "groups[0]", "none"),
                ("bakes", {"scene": "court", "priority": 101}, 400, "priority", "101"),
                ("bakes", {"scene": "court", "priority": 1.5}, 400, "priority", "1.5"),
                ("lppv", {"volume": volume, "object": "beam_long"}, 400, "object", "beam_long"),
                ("lppv", {"volume": volume, "scene": "court", "object": "x"}, 422, "object", "x"),
                ("render", {"volume": volume, "scene": "court", "camera": "x"}, 422, "camera", "x"),
                ("relight", {"volume": volume, "weights": {"x": 1}}, 422, "weights.x", "1"),
                ("relight", {"volume": volume, "weights": {"x": "y"}}, 400, "weights.x", "y"),
                ("relight", {"volume": volume, "blend": "none"}, 404, "blend", "none"),
                ("relight", {"volume": volume, "sky": [1, 1, 1]}, 422, "volume", volume)):
            with self.subTest(path=path, members=members):
                answer = self.server.post("/v1/" + path, members)
                self.assertEqual(answer.status, status, answer.body)
                problem = answer.json()
                self.assertEqual((problem["field"], problem.get("value")), (field, value), problem)
                self.assertTrue(problem["request_id"])
                self.assertNotRegex(problem["detail"], r"--|\.glb|\.probes|\.hdr|\.json")

    def test_words_of_the_user_are_data(self):
        for layer in ("light:No space left", "light:my scene.glb --sky-rotation",
                      "light:cancelled", "light:is damaged"):
            with self.subTest(layer=layer):
                order = {"scene": "court", "samples": 16, "layers": [layer]}
                problem = self.assert_problem(self.server.post("/v1/bakes", order), 422, "bad_data")
                self.assertIn(layer.removeprefix("light:"), problem["detail"])
                self.assertTrue(problem["field"].startswith("layers"), problem)

    def test_errors_in_an_upload_are_of_its_body(self):
        bad = {"groups": [{"name": "g", "positions": [[0, 0, "x"]]}]}
        problem = self.assert_problem(self.server.post("/v1/groups", bad), 422, "bad_data")
        self.assertEqual(problem["field"], "body")
        self.assertTrue(problem["detail"].startswith('body: group "g": '), problem)

    def test_validate(self):
        volume = self.bake()
        answer = self.server.post(f"/v1/volumes/{volume}/validate").json()
        self.assertEqual((answer["is_valid"], answer["problems"]), (True, []))

    def test_relight(self):
        self.bake("--layers", "sun,sky,transfer")
        volume = self.server.get("/v1/volumes").json()["volumes"][0]["id"]
        answer = self.server.post("/v1/relight", {
            "volume": volume, "weights": {"sun": 0.5}, "sky": [0.2, 0.3, 0.4], "name": "dusk"})
        self.assertEqual(answer.status, 201, answer.body)
        expected = self.written("dusk.probes", "relight", self.path, "--weights", "sun=0.5", "--sky",
                                "0.2,0.3,0.4")
        self.assertEqual(self.server.get("/v1/volumes/dusk/file").body, expected)
        wrong = self.server.post("/v1/relight", {"volume": volume, "weights": {"none": 1}})
        self.assert_problem(wrong, 422, "bad_data")

    def test_lppv_in_every_format(self):
        volume = self.bake()
        for format, magic in (("exr", b"\x76\x2f\x31\x01"), ("dds", b"DDS "), ("ktx2", b"\xabKTX 20"),
                              ("vdb", b" BDV"), ("nvdb", b"NanoVDB")):
            answer = self.server.post("/v1/lppv", {"volume": volume, "scene": "court",
                                                   "object": "beam_long", "format": format})
            if answer.status == 422 and b"without OpenVDB" in answer.body:
                continue
            self.assertEqual(answer.status, 200, answer.body)
            self.assertEqual(answer.body[:len(magic)], magic)
            report = json.loads(answer.headers["X-Tetralight-Report"])
            self.assertEqual(report["bytes"], len(answer.body))
        self.assert_problem(self.server.post("/v1/lppv", {"volume": volume, "format": "/etc/x"}), 400,
                            "invalid_value")

    def test_render(self):
        volume = self.bake()
        size = {"width": 64, "height": 36, "antialias": 1}
        answer = self.server.post("/v1/render", {"scene": "court", "volume": volume,
                                                 "camera": "camera", **size})
        self.assertEqual(answer.headers["Content-Type"], "image/png")
        expected = self.written("court.png", "render", COURTYARD, self.path, "--camera", "camera",
                                "--width", "64", "--height", "36", "--antialias", "1")
        self.assertEqual(answer.body, expected)
        wrong = self.server.post("/v1/render", {"scene": "court", "volume": volume, "camera": "none"})
        problem = self.assert_problem(wrong, 422, "bad_data")
        self.assertNotIn(self.folder, problem["detail"])

    def test_check_leaks(self):
        volume = self.bake()
        order = {"scene": "court", "volume": volume, "places": 40, "samples": 16}
        report = self.server.post("/v1/check-leaks", {**order, "all_places": True}).json()
        expected = json.loads(self.command("check-leaks", self.path, "--scene", COURTYARD, "--places", "40", "-s", "16",
                                           "--all-places", "--json"))
        for member in ("file", "files"):
            expected.pop(member, None)
        self.assertEqual(report, expected)
        places = report["all_places"]
        self.assertEqual(len(places), report["places"])
        mean = sum(place["traced"] for place in places) / len(places)
        self.assertAlmostEqual(mean / report["mean_light"], 1, places=5)
        leak = sum(place["through_walls"] for place in places) / len(places) / mean
        self.assertAlmostEqual(leak, report["through_walls"]["mean"], places=6)
        self.assertNotIn("all_places", self.server.post("/v1/check-leaks", order).json())
        self.assert_problem(self.server.post("/v1/check-leaks", {**order, "places": 0}), 400, "invalid_value")
        self.assert_problem(self.server.post("/v1/check-leaks", {**order, "scene": "none"}), 404, "not_found")
        self.assert_problem(self.server.post("/v1/check-leaks", {**order, "max_leak": 1}), 400, "unknown_member")

    def test_a_tool_that_nobody_waits_for_is_ended(self):
        order = json.dumps(self.order_of_hours(self.server)).encode()
        with socket.create_connection(("127.0.0.1", self.server.port)) as client:
            client.sendall(b"POST /v1/render HTTP/1.1\r\nHost: localhost\r\n"
                           b"Content-Length: %d\r\n\r\n" % len(order) + order)
            self.assertTrue(self.eventually(self.server.children))
        self.assertTrue(self.eventually(lambda: not self.server.children()))
        self.assertTrue(self.eventually(
            lambda: 499 in [line.get("status") for line in self.server.logged()]))
        self.assertEqual(os.listdir(os.path.join(self.data, "work")), [])

    def test_a_tool_that_takes_too_long_is_ended(self):
        volume = self.bake()
        self.server.stop()
        self.server = self.start("--tool-seconds", "0.5")
        answer = self.server.post("/v1/render", {"scene": "court", "volume": volume, "width": 8000,
                                                 "height": 8000, "antialias": 16})
        self.assert_problem(answer, 504, "too_slow")
        self.assertEqual(os.listdir(os.path.join(self.data, "work")), [])

    def test_a_stored_sky(self):
        # The smallest Radiance image: two flat pixels of (1, 1, 1).
        sky = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + b"\x80\x80\x80\x81" * 2
        path = os.path.join(self.folder, "sky.hdr")
        open(path, "wb").write(sky)
        self.upload(self.server, "skies", path, "white")
        answer = self.server.post("/v1/bakes", {"scene": "court", "sky": "white", "samples": 16,
                                                "bounces": 1})
        bake = self.server.wait_for(answer.json()["id"])
        expected = self.written("white.probes", "bake", COURTYARD, "--sky", path, "--samples", "16",
                                "-b", "1")
        self.assertEqual(self.server.get(f"/v1/volumes/{bake['volume']}/file").body, expected)


if __name__ == "__main__":
    unittest.main()
