# SPDX-License-Identifier: Apache-2.0
import importlib.util
import unittest

import numpy as np

import tetralight
from support import temporary_path, vector_path


class Vtu(unittest.TestCase):
    def read(self, volume):
        if importlib.util.find_spec("vtkmodules") is None:
            self.skipTest("VTK is missing")
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

        path = temporary_path("volume.vtu")
        volume.to_vtu(path)
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        reader.Update()
        return reader.GetOutput(), vtk_to_numpy

    def test_vtk_reads_probes_and_cells(self):
        volume = tetralight.open(vector_path("space"))
        grid, to_numpy = self.read(volume)
        np.testing.assert_array_equal(to_numpy(grid.GetPoints().GetData()), volume.positions)
        self.assertEqual(grid.GetNumberOfCells(), volume.inner_cell_count)
        corners = to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
        np.testing.assert_array_equal(corners, volume.cells[: volume.inner_cell_count])
        sh = to_numpy(grid.GetPointData().GetArray("irradiance_sh"))
        np.testing.assert_array_equal(sh, volume.irradiance.reshape(-1, 27))

    def test_cells_follow_the_dimension(self):
        for name, vtk_type in (("point", 1), ("line", 3), ("plane", 5), ("space", 10)):
            with self.subTest(name):
                grid, _ = self.read(tetralight.open(vector_path(name)))
                self.assertEqual(grid.GetCellType(0), vtk_type)

    def test_an_empty_volume(self):
        grid, _ = self.read(tetralight.open(vector_path("empty")))
        self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (0, 0))


class Meshio(unittest.TestCase):
    def test_mesh(self):
        if importlib.util.find_spec("meshio") is None:
            self.skipTest("meshio is missing")
        volume = tetralight.open(vector_path("space"))
        mesh = volume.to_meshio()
        np.testing.assert_array_equal(mesh.points, volume.positions)
        np.testing.assert_array_equal(mesh.cells_dict["tetra"], volume.cells[: volume.inner_cell_count])
        self.assertEqual(mesh.point_data["mean_irradiance"].shape, (volume.probe_count, 3))
