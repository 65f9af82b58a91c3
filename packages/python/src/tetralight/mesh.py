# SPDX-License-Identifier: Apache-2.0
"""Probes and cells as an unstructured grid, for ParaView, PyVista and meshio."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from tetralight import sh as harmonics
from tetralight._arrays import AnyArray
from tetralight._files import write_file

if TYPE_CHECKING:
    from tetralight.volume import Volume

# By the number of vertices of a cell: VTK's number, meshio's name.
CELL_TYPES = {1: (1, "vertex"), 2: (3, "line"), 3: (5, "triangle"), 4: (10, "tetra")}

VTK_TYPES = {"f4": "Float32", "f8": "Float64", "i8": "Int64", "u1": "UInt8"}


def inner_cells(volume: Volume) -> AnyArray:
    """(cell, vertices): the probes of each cell inside the hull."""
    return volume.cells[: volume.inner_cell_count, : max(volume.dimension, 1)]


def point_data(volume: Volume) -> dict[str, AnyArray]:
    """Arrays with one element for each probe, as `tetralight export` names them."""
    data: dict[str, AnyArray] = {}
    if volume.has_light:
        sh = np.asarray(volume.irradiance)
        data["mean_irradiance"] = harmonics.mean_irradiance(sh)
        data["irradiance_sh"] = sh.reshape(-1, 27)
    data["validity"] = volume.validity
    if len(volume.standard_error):
        data["standard_error"] = volume.standard_error
    return data


class _VtuFile:
    """The elements of a file in VTK's XML format, and the appended data to which they refer."""

    def __init__(self) -> None:
        self.elements: list[str] = []
        self.data: list[bytes] = []
        self.size = 0

    def array(self, name: str, values: AnyArray) -> None:
        array = np.ascontiguousarray(values)
        kind = VTK_TYPES[array.dtype.str[1:]]
        components = array.shape[1] if array.ndim == 2 else 1
        self.elements.append(
            f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" '
            f'format="appended" offset="{self.size}"/>'
        )
        content = array.astype(array.dtype.newbyteorder("<"), copy=False).tobytes()
        self.data += [len(content).to_bytes(8, "little"), content]
        self.size += 8 + len(content)


def write_vtu(volume: Volume, path: str | os.PathLike[str]) -> None:
    file = _VtuFile()
    cells = inner_cells(volume)
    corners = cells.shape[1]
    file.elements.append(f'<Piece NumberOfPoints="{volume.probe_count}" NumberOfCells="{len(cells)}"><PointData>')
    for name, values in point_data(volume).items():
        file.array(name, values)
    file.elements.append("</PointData><Points>")
    file.array("Points", volume.positions)
    file.elements.append("</Points><Cells>")
    file.array("connectivity", cells.astype(np.int64).ravel())
    file.array("offsets", np.arange(1, len(cells) + 1, dtype=np.int64) * corners)
    file.array("types", np.full(len(cells), CELL_TYPES[corners][0], np.uint8))
    file.elements.append("</Cells></Piece>")
    head = (
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
        'header_type="UInt64">\n<UnstructuredGrid>\n' + "\n".join(file.elements) + "\n</UnstructuredGrid>\n"
        '<AppendedData encoding="raw">\n_'
    )
    write_file(path, head.encode(), *file.data, b"\n</AppendedData>\n</VTKFile>\n")


def meshio_mesh(volume: Volume) -> Any:
    import meshio

    cells = inner_cells(volume)
    name = CELL_TYPES[cells.shape[1]][1]
    data = {name: np.asarray(values) for name, values in point_data(volume).items()}
    return meshio.Mesh(np.asarray(volume.positions), [(name, cells.astype(np.int64))], point_data=data)
