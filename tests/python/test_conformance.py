# SPDX-License-Identifier: Apache-2.0
"""Queries through the package against the conformance vectors (docs/how_to_query.md)."""
import json
import unittest

import numpy as np

import tetralight
from support import VECTORS

LIGHT_TOLERANCE = 1e-5  # of the largest light
OCCLUSION_TOLERANCE = 2e-5

# Members of the options of a case, and what they are called here.
NAMES = {"rendering_layers": "rendering_layers", "radius": "radii", "normal_offset": "normal_offset"}


def query_options(options, answers):
    chosen = {NAMES.get(name, name): value for name, value in options.items() if name != "layer_weights"}
    if "normal_offset" in options:
        chosen["normals"] = [answer["normal"] for answer in answers]
    return chosen


def numbers(rows):
    return np.array([[float(x) for x in row] for row in rows], np.float32)


class Conformance(unittest.TestCase):
    def check(self, volume, text, options, answers):
        positions = numbers([answer["position"] for answer in answers])
        light = volume.query(positions, **query_options(options, answers))
        tolerance = LIGHT_TOLERANCE * text["largest_light"]
        for i, answer in enumerate(answers):
            where = f"{text['volume']} at {answer['position']} ({answer['kind']}), {options}"
            self.assertEqual(light.cells[i] == tetralight.NO_CELL, answer["cell"] is None, where)
            np.testing.assert_allclose(light.sh[i], answer["irradiance_sh"], 0, tolerance, err_msg=where)
            np.testing.assert_allclose(light.occlusion[i], answer["occlusion"], 0, OCCLUSION_TOLERANCE, err_msg=where)
        for k, normal in enumerate(text["normals"]):
            expected = numbers([answer["irradiance"][k] for answer in answers])
            np.testing.assert_allclose(light.irradiance(normal), expected, 0, tolerance)
            each = np.tile(np.float32(normal), (len(answers), 1))
            np.testing.assert_allclose(light.irradiance(each), expected, 0, tolerance)

    def test_answers(self):
        checked = 0
        for path in sorted(VECTORS.glob("*.json")):
            text = json.loads(path.read_text())
            for case in text["cases"]:
                options = dict(case["options"])
                if options.pop("precision", "half") != "half":
                    continue  # the library reads the probes in half precision where there are any
                with self.subTest(volume=text["volume"], options=options):
                    volume = tetralight.open(VECTORS / text["volume"])
                    if "layer_weights" in options:
                        volume.recombine(options["layer_weights"])
                    self.check(volume, text, options, case["answers"])
                    checked += len(case["answers"])
        self.assertGreater(checked, 300)
