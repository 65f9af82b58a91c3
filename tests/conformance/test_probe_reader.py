# SPDX-License-Identifier: Apache-2.0
"""Holds the Python reader, which was written from docs/how_to_query.md, against the conformance vectors."""
import json
import math
import unittest
from pathlib import Path

from probe_reader import NONE, Options, ProbeVolume, to_floats

VECTORS = Path(__file__).resolve().parent / "vectors"
LIGHT_TOLERANCE = 1e-5  # of the largest light
WEIGHT_TOLERANCE = 2e-5


def vectors():
    """Each text of the folder with its volume."""
    for path in sorted(VECTORS.glob("*.json")):
        text = json.loads(path.read_text())
        yield text, ProbeVolume((VECTORS / text["volume"]).read_bytes())


def floats(numbers):
    """The floats of a JSON array, in which strings stand for numbers that JSON does not have."""
    return to_floats(float(x) for x in numbers)


def options_of(members):
    members = dict(members)
    if "layer_weights" in members:
        members["layer_weights"] = tuple(members["layer_weights"])
    return Options(**members)


def by_probe(probes, weights):
    return {probe: weight for probe, weight in zip(probes, weights) if weight != 0}


def largest_difference(a, b):
    """Of two sequences, or of two dictionaries whose absent values are 0."""
    if isinstance(a, dict):
        return max((abs(a.get(key, 0) - b.get(key, 0)) for key in a.keys() | b.keys()), default=0)
    if len(a) != len(b):
        return math.inf
    return max((abs(x - y) for x, y in zip(a, b)), default=0)


def flat(rows):
    return [x for row in rows for x in row]


class ConformanceVectors(unittest.TestCase):
    def check(self, text, volume, options, expected):
        """One answer; returns the differences of light, in units of the largest light, and of weights."""
        position = floats(expected["position"])
        answer = volume.query(position, options, expected.get("normal"))
        where = f"{text['volume']} at {position} ({expected['kind']}), {options}"

        self.assertEqual(answer.location.cell is None, expected["cell"] is None, where)
        weights = 0
        for name, ours in (("barycentric", answer.location.weights), ("weights", answer.weights)):
            difference = largest_difference(
                by_probe(answer.probes, ours), by_probe(expected["probes"], expected[name])
            )
            self.assertLessEqual(difference, WEIGHT_TOLERANCE, f"{name} of {where}")
            weights = max(weights, difference)
        for name, ours, theirs in (
            ("ambient", [answer.location.ambient], [expected["ambient"]]),
            ("occlusion", answer.occlusion, expected["occlusion"]),
        ):
            difference = largest_difference(ours, theirs)
            self.assertLessEqual(difference, WEIGHT_TOLERANCE, f"{name} of {where}")
            weights = max(weights, difference)

        light = 0
        irradiance = [answer.irradiance(floats(normal)) for normal in text["normals"]]
        for name, ours, theirs in (
            ("irradiance_sh", answer.coefficients, expected["irradiance_sh"]),
            ("irradiance", irradiance, expected["irradiance"]),
        ):
            difference = largest_difference(flat(ours), flat(theirs)) / text["largest_light"]
            self.assertLessEqual(difference, LIGHT_TOLERANCE, f"{name} of {where}")
            light = max(light, difference)
        return light, weights

    def test_answers(self):
        checked, light, weights = 0, 0, 0
        for text, volume in vectors():
            for case in text["cases"]:
                options = options_of(case["options"])
                for expected in case["answers"]:
                    with self.subTest(volume=text["volume"], kind=expected["kind"], position=expected["position"]):
                        differences = self.check(text, volume, options, expected)
                        light, weights = max(light, differences[0]), max(weights, differences[1])
                        checked += 1
        print(f"{checked} answers; largest differences: light {light:.1e} of the largest, weights {weights:.1e}")
        self.assertGreater(checked, 0)

    def test_each_walk_ends_in_the_same_light(self):
        for text, volume in vectors():
            for expected in text["cases"][0]["answers"]:
                position = floats(expected["position"])
                if expected["cell"] is None:
                    continue
                q = volume.to_local(position)
                cells = [volume.find_cell(q, start)[0] for start in range(0, len(volume.cells), 7)]
                for cell in {*cells, volume.search_all(q)[0]}:
                    location = volume.locate(position, cell)
                    with self.subTest(volume=text["volume"], position=position, cell=cell):
                        self.assertLessEqual(
                            largest_difference(
                                by_probe(volume.probes_of(location), location.weights),
                                by_probe(expected["probes"], expected["barycentric"]),
                            ),
                            WEIGHT_TOLERANCE,
                        )


class Walks(unittest.TestCase):
    def test_find_cells_without_a_search(self):
        walks, searches = 0, []
        for text, volume in vectors():
            volume.search_all = lambda q, name=text["volume"]: searches.append(name) or (None, None)
            for expected in text["cases"][0]["answers"]:
                if expected["cell"] is None:
                    continue
                q = volume.to_local(floats(expected["position"]))
                for start in range(len(volume.cells)):
                    volume.find_cell(q, start)
                    walks += 1
        # Only tetrahedra without volume send walks in circles.
        self.assertLessEqual(set(searches), {"slivers.probes"})
        self.assertLess(len(searches), 0.01 * walks)


class Seeds(unittest.TestCase):
    def test_are_the_curve_places_of_vertices(self):
        volumes = [volume for _, volume in vectors() if volume.seeds]
        self.assertTrue(volumes)
        for volume in volumes:
            indices = [index for index, _, _ in volume.seeds]
            self.assertEqual(indices, sorted(indices))
            for index, cell, _ in volume.seeds:
                self.assertIn(index, [volume.hilbert_index(p) for p in volume.corners(cell)])


class Cells(unittest.TestCase):
    def test_neighbors_lack_the_vertex_that_they_are_opposite_of(self):
        for text, volume in vectors():
            if volume.dimension < 2:
                continue
            for i, (vertices, neighbors) in enumerate(volume.cells):
                for place, neighbor in enumerate(neighbors):
                    if neighbor == NONE:
                        continue
                    face = {v for v in vertices if v != NONE}
                    if i < volume.inner_count or place < 3:
                        face.remove(vertices[place])
                    self.assertLessEqual(face, set(volume.cells[neighbor][0]), f"{text['volume']}: cell {i}")


class Opening(unittest.TestCase):
    def test_rejects_every_beginning_of_a_file(self):
        data = (VECTORS / "plane.probes").read_bytes()
        for size in range(len(data)):
            with self.assertRaises(ValueError):
                ProbeVolume(data[:size])

    def test_rejects_another_version(self):
        data = bytearray((VECTORS / "point.probes").read_bytes())
        data[8] = 2
        with self.assertRaisesRegex(ValueError, "version of the file is 2"):
            ProbeVolume(bytes(data))

    def test_rejects_vertices_out_of_range(self):
        data = (VECTORS / "plane.probes").read_bytes()
        volume = ProbeVolume(data)
        cell = b"".join(v.to_bytes(4, "little") for v in volume.cells[0][0] + volume.cells[0][1])
        wrong = len(volume.positions).to_bytes(4, "little") + cell[4:]
        self.assertEqual(data.count(cell), 1)
        with self.assertRaisesRegex(ValueError, "section cells: element 0"):
            ProbeVolume(data.replace(cell, wrong))


if __name__ == "__main__":
    unittest.main()
