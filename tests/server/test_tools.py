# SPDX-License-Identifier: Apache-2.0
"""What the command makes of a volume, over HTTP."""
import json
import os
import unittest

from service import COURTYARD, ServiceTest, read


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

    def test_grid_errors_name_their_member(self):
        for members, status, field in (({"scene": "court"}, 400, "spacing"),
                                       ({"scene": "court", "spacing": -1}, 400, "spacing"),
                                       ({"scene": "court", "spacing": 1, "mode": "x"}, 400, "mode"),
                                       ({"scene": "court", "spacing": [1, 2]}, 400, "spacing")):
            answer = self.server.post("/v1/grid", members)
            self.assertEqual(answer.status, status, answer.body)
            self.assertIn(field, answer.json()["detail"])

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
