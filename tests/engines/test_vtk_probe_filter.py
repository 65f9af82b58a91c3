# SPDX-License-Identifier: Apache-2.0
"""`export --as vtu`: VTK's probe filter has the light that `query` answers without walls, at random places."""
import bisect
import os
import random
import sys
import tempfile
import unittest
from array import array
from pathlib import Path

from volumes import bake_courtyard, irradiance, normals, read_json, skip, tetralight

SYSTEM_PYTHON = "/usr/bin/python3"  # Debian's VTK is for this one
PLACE_COUNT = 10_000


def import_vtk():
    """Goes on in Debian's Python if this one has no VTK."""
    try:
        from vtkmodules import vtkCommonCore, vtkCommonDataModel, vtkFiltersCore, vtkIOXML
        return vtkCommonCore, vtkCommonDataModel, vtkFiltersCore, vtkIOXML
    except ImportError:
        if os.path.realpath(sys.executable) == os.path.realpath(SYSTEM_PYTHON) or not os.path.exists(SYSTEM_PYTHON):
            skip("there is no VTK for Python (Debian package python3-vtk9)")
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def cell_volume(corners):
    a, b, c = ([corners[i][k] - corners[0][k] for k in range(3)] for i in (1, 2, 3))
    return abs(sum(x * y for x, y in zip(a, cross(b, c)))) / 6


def random_places(probes):
    """Evenly random in the cells; rounded to floats, which `query` reads."""
    cells = [[probes["positions"][v] for v in cell] for cell in probes["cells"]]
    sums = []
    for cell in cells:
        sums.append((sums[-1] if sums else 0) + cell_volume(cell))
    chance = random.Random(1)
    places = array("f")
    for _ in range(PLACE_COUNT):
        cell = cells[bisect.bisect(sums, chance.random() * sums[-1])]
        weights = [chance.expovariate(1) for _ in range(4)]
        places.extend(sum(w * corner[k] for w, corner in zip(weights, cell)) / sum(weights) for k in range(3))
    return places


def vtk_light(path, places, locator):
    """27 numbers a place; None where VTK finds no cell. `locator`: the class that finds cells; None: VTK's default."""
    core, data, filters, io = import_vtk()
    reader = io.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    points = core.vtkPoints()
    points.SetDataTypeToDouble()
    for i in range(PLACE_COUNT):
        points.InsertNextPoint(*places[3 * i:3 * i + 3])
    asked = data.vtkPolyData()
    asked.SetPoints(points)
    probe = filters.vtkProbeFilter()
    probe.SetInputData(asked)
    probe.SetSourceConnection(reader.GetOutputPort())
    if locator:
        probe.SetCellLocatorPrototype(getattr(data, locator)())
    probe.Update()
    found = probe.GetOutput().GetPointData()
    light, is_valid = found.GetArray("irradiance_sh"), found.GetArray("vtkValidPointMask")
    return [light.GetTuple(i) if is_valid.GetTuple1(i) else None for i in range(PLACE_COUNT)]


def query_light(folder, walls):
    tetralight("query", folder / "c.probes", folder / "places.f32", "--walls", walls, "-o", folder / "light.f32", "-q")
    records = array("f", (folder / "light.f32").read_bytes())
    return [records[32 * i:32 * i + 27] for i in range(PLACE_COUNT)]


def quantiles(values):
    ordered = sorted(values)
    return {"p50": ordered[len(ordered) // 2], "p99": ordered[len(ordered) * 99 // 100],
            "p99.9": ordered[len(ordered) * 999 // 1000], "worst": ordered[-1]}


class VtkProbeFilter(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            bake_courtyard(folder / "c.probes")
            tetralight("export", folder / "c.probes", "--as", "json", "-o", folder / "c.json")
            tetralight("export", folder / "c.probes", "-o", folder / "c.vtu")
            probes = read_json(folder / "c.json")
            places = random_places(probes)
            (folder / "places.f32").write_bytes(places.tobytes())
            cls.found = vtk_light(folder / "c.vtu", places, "vtkStaticCellLocator")
            cls.found_by_default = vtk_light(folder / "c.vtu", places, None)
            cls.answers = {walls: query_light(folder, walls) for walls in ("ignore", "hide")}
        cls.largest = max(max(irradiance(sh, n)) for sh in probes["irradiance_sh"] for n in normals())

    def difference(self, title, found, walls):
        """Quantiles of the largest difference of all channels and normals, of the largest irradiance; prints them."""
        values = quantiles(
            max(abs(e) for n in normals() for e in irradiance([a - b for a, b in zip(light, expected)], n)) / self.largest
            for light, expected in zip(found, self.answers[walls]) if light is not None)
        missing = sum(light is None for light in found)
        print(f"{title}, --walls {walls}:", {name: float(f"{value:.3g}") for name, value in values.items()},
              f"without a cell: {missing} of {len(found)}")
        return values

    def test_agrees_with_queries_without_walls(self):
        self.assertGreater(self.largest, 0)
        self.assertNotIn(None, self.found)
        values = self.difference("vtkStaticCellLocator", self.found, "ignore")
        self.assertLessEqual(values["p99.9"], 1e-3)
        self.assertLessEqual(values["worst"], 5e-3)

    def test_the_default_locator_mistakes_few_places(self):
        """It takes places near slivers for those of a neighbor, and loses some at the hull."""
        values = self.difference("default locator", self.found_by_default, "ignore")
        self.assertLessEqual(values["p99.9"], 1e-3)
        self.assertLess(self.found_by_default.count(None), PLACE_COUNT / 100)

    def test_prints_what_walls_change(self):
        values = self.difference("vtkStaticCellLocator", self.found, "hide")
        self.assertGreater(values["worst"], 0)


if __name__ == "__main__":
    import_vtk()
    unittest.main()
