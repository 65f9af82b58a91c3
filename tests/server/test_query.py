# SPDX-License-Identifier: Apache-2.0
"""Queries give what the command gives, in every form."""
import json
import math
import os
import random
import re
import shutil
import struct
import subprocess
import tempfile
import threading
import unittest

from service import BINARY, COMMAND, COURTYARD, ServiceTest, lattice, write_groups

FLOATS, PACKED, HALVES = 1, 2, 3
OCCLUSION, CELLS = 1, 2


def binary_query(positions, sh=FLOATS, wants=0, outside=0, precision=0, fade=0.0, magic=b"TLQ1",
                 count=None):
    header = magic + struct.pack("<IBBBBf", len(positions) if count is None else count, sh, wants,
                                 outside, precision, fade)
    return header + struct.pack(f"<{3 * len(positions)}f", *(x for p in positions for x in p))


class Query(ServiceTest):
    @classmethod
    def setUpClass(cls):
        generator = random.Random(1)
        cls.positions = [[struct.unpack("<f", struct.pack("<f", generator.uniform(-12, 12)))[0]
                          for _ in range(3)] for _ in range(500)]
        cls.folder_of_all = tempfile.mkdtemp(prefix="tetralight_server_")
        cls.path = os.path.join(cls.folder_of_all, "court.probes")
        subprocess.run([COMMAND, "bake", COURTYARD, "-o", cls.path, "--samples", "16", "-b", "1",
                        "--quiet"], check=True)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder_of_all)

    def setUp(self):
        super().setUp()
        self.server = self.start()
        self.volume = self.upload(self.server, "volumes", self.path, "court")

    def expected(self, *options):
        lines = subprocess.run(
            [COMMAND, "query", self.path, "--json", *options], check=True, capture_output=True,
            text=True, input="\n".join(" ".join(map(repr, p)) for p in self.positions)).stdout
        return [json.loads(line) for line in lines.splitlines()]

    def query(self, **members):
        answer = self.server.post("/v1/volumes/court/query", members)
        self.assertEqual(answer.status, 200, answer.body)
        return answer.json()["answers"]

    def binary(self, *arguments, **options):
        return self.server.post("/v1/volumes/court/query", binary_query(*arguments, **options),
                                BINARY)

    def test_json_is_what_the_command_prints(self):
        # Walks begin elsewhere, so that weights may differ in their last bits.
        for options, members in (((), {}), (("--outside", "clamp"), {"outside": "clamp"}),
                                 (("--walls", "ignore"), {"walls": "ignore"}),
                                 (("--outside", "ambient", "--fade", "3"),
                                  {"outside": "ambient", "fade": 3})):
            for ours, theirs in zip(self.query(positions=self.positions, **members),
                                    self.expected(*options), strict=True):
                self.assertEqual(list(ours), list(theirs))
                self.assertEqual(ours["position"], theirs["position"])
                for a, b in zip(ours["irradiance_sh"], theirs["irradiance_sh"], strict=True):
                    for x, y in zip(a, b, strict=True):
                        self.assertAlmostEqual(x, y, delta=1e-4 * (1 + abs(y)))

    def test_what_is_lit_is_what_the_command_says(self):
        groups = os.path.join(self.folder, "groups.json")
        layered = os.path.join(self.folder, "layers.probes")
        with open(groups, "w", encoding="utf-8") as file:
            json.dump({"groups": [
                {"name": str(layer), "rendering_layers": [layer],
                 "positions": [[x, y, z + 0.5 * (layer > 0)] for x in (-2, 1, 4) for y in (0.5, 2)
                               for z in (-3, 0, 3)]} for layer in (0, 3)]}, file)
        self.command("bake", COURTYARD, "-g", groups, "--only-given-groups", "--invalid-probes",
                     "keep", "--samples", "16", "-b", "1", "-o", layered)
        self.upload(self.server, "volumes", layered, "layers")
        generator = random.Random(3)
        places = [[generator.uniform(-2, 4), generator.uniform(0.5, 2), generator.uniform(-3, 3)]
                  for _ in range(100)]
        normals = [[generator.uniform(-1, 1) for _ in range(3)] for _ in places]

        def command(*options):
            lines = subprocess.run(
                [COMMAND, "query", layered, "--json", *options], check=True, capture_output=True,
                text=True, input="\n".join(
                    " ".join(map(repr, p + (n if "--normals" in options else [])))
                    for p, n in zip(places, normals, strict=True))).stdout
            return [json.loads(line) for line in lines.splitlines()]

        def ask(**members):
            answer = self.server.post("/v1/volumes/layers/query", {"positions": places, **members})
            self.assertEqual(answer.status, 200, answer.body)
            return answer.json()["answers"]

        plain = ask()
        for options, members in (
                (("--rendering-layers", "3"), {"rendering_layers": [3]}),
                (("--radius", "0.5"), {"radius": 0.5}),
                (("--normals",), {"normals": normals}),
                (("--normals", "--normal-offset", "0.3", "--rendering-layers", "0,7"),
                 {"rendering_layers": [0, 7], "normal_offset": 0.3, "normals": normals})):
            ours = ask(**members)
            self.assertNotEqual(ours, plain)
            for a, b in zip(ours, command(*options), strict=True):
                self.assertEqual(a["position"], b["position"])
                for x, y in zip(a["irradiance_sh"], b["irradiance_sh"], strict=True):
                    for u, v in zip(x, y, strict=True):
                        self.assertAlmostEqual(u, v, delta=1e-4 * (1 + abs(v)))
                for x, y in zip(a["probes"], b["probes"], strict=True):
                    self.assertEqual(x["probe"], y["probe"])
                    self.assertAlmostEqual(x["weight"], y["weight"], delta=1e-5)
        self.assertEqual(ask(rendering_layers=[0, 3]), plain)
        self.assertEqual(ask(radius=0, normals=None, rendering_layers=None), plain)
        many = ask(positions=places * 20, normals=normals * 20, rendering_layers=[3], radius=0.5)
        self.assertEqual(many, ask(normals=normals, rendering_layers=[3], radius=0.5) * 20)

    def test_what_is_lit_is_checked(self):
        two = {"positions": [[0, 1, 0], [1, 1, 0]]}
        up = [0, 1, 0]
        for members, field in (
                ({"rendering_layers": []}, "rendering_layers"),
                ({"rendering_layers": [32]}, "rendering_layers"),
                ({"rendering_layers": [-1]}, "rendering_layers"),
                ({"rendering_layers": [0.5]}, "rendering_layers"),
                ({"rendering_layers": 3}, "rendering_layers"), ({"radius": -1}, "radius"),
                ({"normals": [up]}, "normals"), ({"normals": []}, "normals"),
                ({"normals": 3}, "normals"), ({"normals": [up, up, up]}, "normals"),
                ({"normals": [up, [0, 0, 0]]}, "normals[1]"),
                ({"normals": [up, [0, 1]]}, "normals[1]"),
                ({"normals": [[0, 1e39, 0], up]}, "normals[0]"),
                ({"normals": [up, [0, 1, "z"]]}, "normals[1]"),
                ({"normal_offset": 0.2}, "normal_offset"),
                ({"normals": [up, up], "normal_offset": -1}, "normal_offset")):
            answer = self.server.post("/v1/volumes/court/query", {**two, **members})
            self.assertEqual((answer.status, answer.json().get("field")), (400, field), members)

    def test_binary_is_what_json_says(self):
        answers = self.query(positions=self.positions)
        count = len(self.positions)
        body = self.binary(self.positions, wants=OCCLUSION | CELLS).body
        self.assertEqual(body[:4], b"TLA1")
        self.assertEqual(len(body), 16 + count * (108 + 16 + 24))
        sh = struct.unpack_from(f"<{27 * count}f", body, 16)
        occlusion = struct.unpack_from(f"<{4 * count}f", body, 16 + 108 * count)
        for i, answer in enumerate(answers):
            flat = [x for coefficient in answer["irradiance_sh"] for x in coefficient]
            for x, y in zip(sh[27 * i:27 * i + 27], flat, strict=True):
                self.assertAlmostEqual(x, y, delta=1e-5 * (1 + abs(y)))
            self.assertEqual(list(occlusion[4 * i:4 * i + 4]), answer["occlusion"])
            cell = struct.unpack_from("<I", body, 16 + 124 * count + 24 * i)[0]
            self.assertEqual(cell, answer["cell"])

    def test_json_reads_back_to_the_floats_of_binary(self):
        count = len(self.positions)
        body = self.binary(self.positions, wants=OCCLUSION | CELLS).body
        sh = struct.unpack_from(f"<{27 * count}I", body, 16)
        occlusion = struct.unpack_from(f"<{4 * count}I", body, 16 + 108 * count)
        cells = [struct.unpack_from("<5I", body, 16 + 124 * count + 24 * i + 4) for i in range(count)]

        def bits(numbers):
            return struct.unpack(f"<{len(numbers)}I", struct.pack(f"<{len(numbers)}f", *numbers))

        for i, answer in enumerate(self.query(positions=self.positions)):
            flat = [x for coefficient in answer["irradiance_sh"] for x in coefficient]
            self.assertEqual(bits(flat), sh[27 * i:27 * i + 27])
            self.assertEqual(bits(answer["occlusion"]), occlusion[4 * i:4 * i + 4])
            weights = [probe["weight"] for probe in answer["probes"]]
            self.assertEqual(bits([answer["ambient"]] + weights), cells[i][:1 + len(weights)])
            self.assertEqual(bits(answer["position"]), bits(self.positions[i]))

    def test_json_has_the_shortest_numbers(self):
        answer = self.server.post("/v1/volumes/court/query", {"positions": self.positions[:50]})
        for number in re.findall(rb"-?[0-9][0-9.e+-]*", answer.body):
            self.assertLessEqual(len(number.strip(b"-").split(b"e")[0].strip(b"0.")), 10, number)

    def test_outputs_do_not_change_each_other(self):
        count = len(self.positions)
        whole = self.binary(self.positions, wants=OCCLUSION | CELLS).body
        self.assertEqual(self.binary(self.positions).body[16:], whole[16:16 + 108 * count])
        occlusion = self.binary(self.positions, 0, OCCLUSION).body
        self.assertEqual(occlusion[16:], whole[16 + 108 * count:16 + 124 * count])
        self.assertEqual(self.binary(self.positions, 0, CELLS).body[16:], whole[16 + 124 * count:])

    def test_order_and_number_of_positions_do_not_matter(self):
        order = list(range(len(self.positions)))
        random.Random(2).shuffle(order)
        plain = self.query(positions=self.positions)
        self.assertEqual(self.query(positions=[self.positions[i] for i in order]),
                         [plain[i] for i in order])
        many = self.query(positions=self.positions * 5)  # more than are answered at a time
        self.assertEqual(many, plain * 5)
        for i in range(0, len(order), 50):
            self.assertEqual(self.query(positions=[self.positions[i]]), [plain[i]])

    def test_spellings_of_json(self):
        plain = self.query(positions=[[1.5, -2, 30]], outside="clamp")
        for text in ('{"positions":[[1.5,-2,30]],"outside":"clamp"}',
                     '{"outside": "clamp", "fade": null, "positions": [[1.5e0, -20E-1, 3.0e+1]]}',
                     ' \n{\t"outside":"clamp","positions"\r:\n[ [ 1.50 ,-2.000, 30 ] ] } ',
                     '{"p\\u006fsitions":[[1.5,-2,30]],"outside":"clamp"}',
                     '{"outside":"cl\\u0061mp","positions":[[1.5,-2,30]]}'):
            answer = self.server.post("/v1/volumes/court/query", text, "application/json")
            self.assertEqual((answer.status, answer.json()["answers"] if answer.status == 200 else
                              answer.body), (200, plain), text)

    def test_positions_that_json_does_not_allow(self):
        for positions in ("[[1,2,03]]", "[[1,2,3.]]", "[[1,2,.3]]", "[[1,2,+3]]", "[[1,2,3e]]",
                          "[[1,2,-]]", "[[1,2,0x3]]", "[[1,2,3],]", "[[1,2,3]", "[[1,2,3]]]",
                          "[,[1,2,3]]", "[[1 2,3]]", "[[1,2,3,4]]", "[[1,2,[3]]]", "[[1,2,inf]]",
                          "[[1,2,true]]", "[[1,2,1e39]]", "[[1,2,3]] [[1,2,3]]",
                          "[" + "{}," * 100000 + "{}]"):
            answer = self.server.post("/v1/volumes/court/query", f'{{"positions":{positions}}}',
                                      "application/json")
            self.assertEqual(answer.status, 400, positions[:99])
        twice = '{"positions":[[1,2,3]],"positions":[[1,2,3]]}'
        answer = self.server.post("/v1/volumes/court/query", twice, "application/json")
        self.assert_problem(answer, 422, "duplicate_member")

    def test_forms_of_sh(self):
        count = len(self.positions)
        floats = struct.unpack_from(f"<{27 * count}f", self.binary(self.positions).body, 16)
        halves = struct.unpack_from(f"<{27 * count}e", self.binary(self.positions, HALVES).body, 16)
        nearest = struct.unpack(f"<{27 * count}e", struct.pack(f"<{27 * count}e", *floats))
        self.assertEqual(halves, nearest)
        packed = struct.unpack_from(f"<{28 * count}f", self.binary(self.positions, PACKED).body, 16)
        # SHAr.w = (k_0 L_0 - k_6 L_6), with E_0 = pi L_0 and E_6 = pi / 4 L_6.
        for i in range(count):
            l0, l6 = floats[27 * i] / math.pi, floats[27 * i + 18] / (math.pi / 4)
            expected = 0.28209479 * l0 - 0.07884789 * l6
            self.assertAlmostEqual(packed[28 * i + 3], expected, delta=1e-4 * (1 + abs(expected)))
        only_cells = self.binary(self.positions, 0, CELLS).body
        self.assertEqual(len(only_cells), 16 + 24 * count)

    def test_no_position_at_all(self):
        self.assertEqual(self.query(positions=[]), [])
        self.assertEqual(len(self.binary([]).body), 16)

    def test_positions_that_are_not_finite(self):
        for bad in (math.nan, math.inf, -math.inf):
            problem = self.assert_problem(self.binary([[0, 0, 0], [0, bad, 0]]), 400, "not_finite")
            self.assertEqual(problem["field"], "positions[1]")
        for text in ('{"positions":[[NaN,0,0]]}', '{"positions":[[1e999,0,0]]}'):
            answer = self.server.post("/v1/volumes/court/query", text, "application/json")
            self.assertEqual(answer.status, 400)

    def test_values_that_are_none(self):
        for members, field in (({"positions": [[1, 2]]}, "positions[0]"), ({"positions": 3}, "positions"),
                               ({"positions": [["a", 1, 2]]}, "positions[0]"),
                               ({"positions": [], "outside": "x"}, "outside"),
                               ({"positions": [], "fade": -1}, "fade"),
                               ({"positions": [], "more": 1}, "more"), ({}, "positions")):
            answer = self.server.post("/v1/volumes/court/query", members)
            self.assertEqual(answer.status, 400)
            self.assertEqual(answer.json()["field"], field)

    def test_headers_that_are_none(self):
        good = [[0, 0, 0]]
        for body in (b"", b"TLQ1", binary_query(good, magic=b"TLQ2"), binary_query(good, sh=4),
                     binary_query(good, wants=8), binary_query(good, sh=0), binary_query(good, sh=0, wants=4),
                     binary_query(good, outside=3), binary_query(good, precision=2),
                     binary_query(good, fade=math.nan), binary_query(good, count=2),
                     binary_query(good, count=0xffffffff), binary_query(good)[:-1]):
            answer = self.server.post("/v1/volumes/court/query", body, BINARY)
            self.assert_problem(answer, 400, "invalid_header")

    def test_headers_name_what_is_at_fault(self):
        for body, field, value, detail in (
                (binary_query([], fade=-1.0), "fade", "-1", ""),
                (binary_query([], fade=math.nan), "fade", "nan", ""),
                (binary_query([], fade=1e10), "fade", "1e+10", ""),
                (binary_query([], sh=7), "sh", "7", ""),
                (binary_query([], wants=9), "wants", "9", ""),
                (binary_query([[0, 0, 0]], count=2), "count", "2", "28 bytes where 40 are expected"),
                (b"TLQ1", "body", "4 bytes", "16 bytes")):
            answer = self.server.post("/v1/volumes/court/query", body, BINARY)
            problem = self.assert_problem(answer, 400, "invalid_header")
            self.assertEqual((problem["field"], problem["value"]), (field, value))
            self.assertIn(detail, problem["detail"])

    def test_fade_0_is_the_default_in_both_forms(self):
        far = [[100, 0, 0]]
        json_0, json_10 = (self.query(positions=far, outside="ambient", fade=fade)[0]["ambient"]
                           for fade in (0, 10))
        self.assertEqual(json_0, json_10)
        self.assertEqual(self.binary(far, outside=2).body[16:],
                         self.binary(far, outside=2, fade=10.0).body[16:])

    def test_parameters_of_the_type_do_not_matter(self):
        body = binary_query([[0, 0, 0]])
        plain = self.server.post("/v1/volumes/court/query", body, BINARY)
        for type in ("Application/Octet-Stream", "application/octet-stream; charset=x"):
            answer = self.server.post("/v1/volumes/court/query", body, type)
            self.assertEqual((answer.status, answer.body), (200, plain.body))

    def test_too_many_positions(self):
        self.server.stop()
        self.server = self.start("--max-positions", "10")
        self.assertEqual(self.binary([[0, 0, 0]] * 10).status, 200)
        self.assert_problem(self.binary([[0, 0, 0]] * 11), 413, "too_large")

    def test_a_volume_is_deleted_and_replaced_while_it_is_queried(self):
        other = os.path.join(self.folder, "other.probes")
        groups = os.path.join(self.folder, "groups.json")
        write_groups(groups, lattice(2))
        self.command("tetrahedralize", groups, "-o", other)
        whole = {self.binary(self.positions).body}
        first = self.volume
        second = self.upload(self.server, "volumes", other, "court")
        whole.add(self.binary(self.positions).body)
        is_over = threading.Event()
        answers = []

        def ask():
            while not is_over.is_set():
                answers.append(self.binary(self.positions))
                is_over.wait(0.005)

        askers = [threading.Thread(target=ask) for _ in range(4)]
        for asker in askers:
            asker.start()
        for _ in range(4):
            for id, path in ((first, self.path), (second, other)):
                self.upload(self.server, "volumes", path, "court")
                # Two clients delete it at once.
                deleters = [threading.Thread(target=self.server.request,
                                             args=("DELETE", "/v1/volumes/" + id)) for _ in range(2)]
                if id == first:
                    for deleter in deleters:
                        deleter.start()
                    for deleter in deleters:
                        deleter.join()
        is_over.set()
        for asker in askers:
            asker.join()
        for answer in answers:
            self.assertIn(answer.status, (200, 404))
            if answer.status == 200:
                self.assertIn(answer.body, whole)
        self.assertIn(200, {answer.status for answer in answers})


if __name__ == "__main__":
    unittest.main()
