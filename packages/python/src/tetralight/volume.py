# SPDX-License-Identifier: Apache-2.0
"""A probe volume: baked probes joined by tetrahedra that together fill space."""
from __future__ import annotations

import ctypes
import os
import threading
from typing import Any, Callable, TypeVar

import numpy as np

from tetralight import _arrays
from tetralight import _declarations as c
from tetralight import _query, mesh
from tetralight import lppv as proxy
from tetralight._arguments import finite_numbers, number, path_text
from tetralight._arrays import AnyArray, FloatArray, three, unit_vector
from tetralight._contents import Contents
from tetralight._gate import Gate
from tetralight._library import Handle, NotCopied, Source, call, library, opened_file
from tetralight.errors import BadValue, Closed, NotThere
from tetralight.irradiance import ProbeIrradiance, of_probes
from tetralight.light import Light
from tetralight.lppv import Lppv
from tetralight.picture import Pixels, png, probes_from_above, tone_mapped
from tetralight.scene_light import SceneLight, scene_light
from tetralight.sh import LARGEST_LIGHT, mean_irradiance, sky_coefficients

Result = TypeVar("Result")

DIMENSIONS = ("no probes", "one probe", "a line", "a plane", "space")


class Volume(NotCopied):
    """`tetralight.open` makes it. All calls may run in several threads at once: those that change the
    light (`recombine`, `relight`) wait for the others."""

    def __init__(self, handle: Handle, name: str) -> None:
        self._gate = Gate()
        self._changes = threading.Lock()  # of callers that change the light
        self.name = name
        info = c.Info()
        call(library.tetralight_get_info, handle.pointer, ctypes.byref(info))
        self.probe_count: int = info.probe_count
        self.cell_count: int = info.cell_count
        self.inner_cell_count: int = info.inner_cell_count
        """Cells with this index or a higher one lie outside the hull of the probes."""
        self.dimension: int = info.dimension
        """0 no probes, 1 one probe, 2 probes on a line, 3 in a plane, 4 in space."""
        self.has_light = bool(info.has_light)
        self.has_occlusion = bool(info.has_occlusion)
        self._layer_count: int = info.layer_count
        details = c.Details()
        call(library.tetralight_get_details, handle.pointer, ctypes.byref(details))
        self.low: FloatArray = np.array(details.low)
        """The box of the probes."""
        self.high: FloatArray = np.array(details.high)
        self.knows_walls = bool(details.knows_walls)
        """True if the volume knows which walls hide its probes."""
        self.can_relight_sky = bool(details.can_relight_sky)
        self.can_relight_sun = bool(details.can_relight_sun)
        self._light_count: int = details.light_count
        self._contents: Contents | None = Contents(handle, self.probe_count, tuple(details.world_origin))

    # Opening and closing

    def close(self) -> None:
        """Calls fail with `Closed` from now on. Arrays that show the volume stay valid: the memory is
        freed with the last of them."""
        self._contents = None

    @property
    def is_closed(self) -> bool:
        return self._contents is None

    def __enter__(self) -> Volume:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _open_contents(self) -> Contents:
        contents = self._contents
        if contents is None:
            raise Closed(f"{self.name}: the volume is closed")
        return contents

    def __len__(self) -> int:
        return self.probe_count

    def __bool__(self) -> bool:
        return True

    def __repr__(self) -> str:
        if self.is_closed:
            return f"<tetralight.Volume {self.name!r}, closed>"
        return (
            f"<tetralight.Volume {self.name!r}: {self.probe_count} probes in {DIMENSIONS[self.dimension]}, "
            f"{self.inner_cell_count} cells{'' if self.has_light else ', not baked'}>"
        )

    # Arrays, which never change

    def _read(self, read: Callable[[Contents], Result]) -> Result:
        """Calls a function that may run beside others that read."""
        contents = self._open_contents()
        return self._gate.run(lambda: read(contents))

    @property
    def positions(self) -> AnyArray:
        """(probe, 3): world positions, doubles; a read-only view."""
        return self._read(lambda contents: contents.positions)

    @property
    def cells(self) -> AnyArray:
        """(cell, 4): the probes of each cell, NO_CELL in unused places: first the cells inside the hull of
        the probes, then those outside; a read-only view."""
        return self._read(lambda contents: contents.cells)

    @property
    def neighbors(self) -> AnyArray:
        """(cell, 4): the cell opposite each of its probes, NO_CELL for none; a read-only view."""
        return self._read(lambda contents: contents.neighbors)

    @property
    def irradiance(self) -> ProbeIrradiance:
        """(probe, 9, 3): irradiance coefficients, E(n) = sum of E_i Y_i(n); read-only, and a view while the
        light is that of the file. `volume.irradiance(positions, normals)` is the light between the
        probes."""
        return of_probes(self._read(lambda contents: contents.irradiance()), self)

    @property
    def validity(self) -> AnyArray:
        """(probe): the fraction of its rays that hit no back face; a read-only view."""
        return self._read(lambda contents: contents.validity)

    @property
    def standard_error(self) -> AnyArray:
        """(probe): the relative standard error of its irradiance, 0 = not known; a read-only view."""
        return self._read(lambda contents: contents.standard_error)

    @property
    def ambient(self) -> FloatArray:
        """(9, 3): the light of positions without a probe, irradiance coefficients."""
        return self._read(lambda contents: contents.ambient())

    @property
    def metadata(self) -> dict[str, Any]:
        """How the volume was made."""
        return self._read(lambda contents: contents.metadata())

    # Queries

    def query(
        self,
        positions: Any,
        hints: AnyArray | None = None,
        out: Light | AnyArray | None = None,
        *,
        format: str = "coefficients",
        outside: str = "extrapolate",
        fade_distance: float = 1.0,
        walls: str = "hide",
        rendering_layers: Any = None,
        radii: Any = None,
        normals: Any = None,
        normal_offset: float = c.NORMAL_OFFSET,
        threads: int | None = None,
    ) -> Light:
        """The light at positions (…, 3), on all cores, without the interpreter lock.

        hints: uint32 (…), the cells where searches start; receives the cells found.
        out: an answer of the same shape, or an array for its `sh`, whose memory is used again.
        format: "coefficients", "packed" (for shaders) or "half".
        outside: the light outside the hull of the probes: "extrapolate", "clamp", or "ambient", which
            fades to the ambient light over `fade_distance` metres.
        walls: "hide" probes that walls of the scene hide, or "ignore" walls.
        rendering_layers: uint32, bit i: what is lit is on layer i; one number or one for each position.
        radii: metres over which light of probes behind a wall fades; one number or one for each position.
        normals: unit normals of surfaces on which the positions lie; they are pushed off along them by the
            share `normal_offset` of the mean distance to the probes.
        threads: at most this many; by default all processors.
        """
        points = _arrays.vectors("positions", positions)
        options = _query.Options(
            format, outside, fade_distance, walls, rendering_layers, radii, normals, normal_offset, threads
        )
        light = _query.outputs(points.shape[:-1], hints, out, format)
        return self._read(lambda contents: _query.answer(contents.handle.pointer, points, light, options))

    def lppv(
        self,
        low: Any,
        high: Any,
        resolution: Any,
        *,
        world_from_box: Any = None,
        quality: str = "full",
        placement: str = "cell_centers",
        layout: str = "seven_slabs",
        format: str = "float",
    ) -> Lppv:
        """The texture of a proxy volume: a grid of light in a box around a large object.

        low, high: the box in the object's space; world_from_box: its transform (4, 4), by default none.
        resolution: grid points along X, Y and Z, 1 to 256.
        quality: which bands of the light vary in the box: "low", "normal" or "full".
        placement: grid points at "cell_centers" or "cell_corners".
        layout: "four_slabs" or "seven_slabs"; format: "half" or "float".
        """
        box = proxy.box_of(low, high, resolution, world_from_box, quality, placement, layout, format)
        return self._read(lambda contents: proxy.fill(contents.handle.pointer, box, layout, format))

    # Lights and layers

    @property
    def lights(self) -> list[SceneLight]:
        """The lights of the scene. Of mixed lights the probes hold the bounces: the caller adds the direct
        light."""
        return self._read(
            lambda contents: [scene_light(contents.handle.pointer, index) for index in range(self._light_count)]
        )

    @property
    def layers(self) -> dict[str, float]:
        """The layers of light, such as "sky" or "light:lamp", and their weights; 1 = as baked."""
        return self._read(lambda contents: contents.layers(self._layer_count))

    def recombine(self, weights: Any = None, /, **by_name: float) -> None:
        """Replaces the light by the sum of the layers times weights >= 0: an array with one weight for
        each layer, or a dictionary or keywords by name, in which a layer that is not named keeps its
        weight. Arrays from before keep the light that they show."""
        with self._changes:
            array = self._weights_of(weights, by_name)
            self._change([(library.tetralight_recombine, array.ctypes.data, len(array))])

    def _weights_of(self, weights: Any, by_name: dict[str, float]) -> FloatArray:
        """One weight for each layer."""
        if weights is not None and not hasattr(weights, "keys"):
            if by_name:
                raise BadValue("weights: expected an array or names, given both")
            return finite_numbers("weights", weights, (self._layer_count,), 0).astype(np.float32)
        current = self.layers
        chosen = {**dict(weights or {}), **by_name}
        for name, weight in chosen.items():
            if name not in current:
                raise NotThere(f"{self.name}: there is no layer {name!r}; layers: {', '.join(current) or 'none'}")
            current[name] = number(f"weights[{name!r}]", weight, 0, expected="a finite number >= 0")
        return np.array(list(current.values()), np.float32)

    def relight(self, *, sky: Any = None, sun_direction: Any = None, sun_irradiance: Any = None) -> None:
        """Replaces the light of the sky and the sun, in a volume that was baked with transfer.

        sky: its radiance: one number, RGB, or (16, 3) coefficients of bands 0 to 3.
        sun_direction: the vector along which the sun shines; sun_irradiance: RGB, on a surface that faces
            it. Of a mixed sun the volume holds only the bounces.
        If one of them is refused, neither changes.
        Arrays from before keep the light that they show.
        """
        if (sun_direction is None) != (sun_irradiance is None):
            raise BadValue("sun_irradiance: expected sun_direction and sun_irradiance, given only one of them")
        changes: list[tuple[bool, Any]] = []
        if sky is not None:
            radiance = sky_coefficients(sky)
            changes.append((self.can_relight_sky, (library.tetralight_relight_sky, radiance.ctypes.data)))
        if sun_direction is not None:
            direction = unit_vector("sun_direction", sun_direction)
            light = three("sun_irradiance", sun_irradiance, 0, LARGEST_LIGHT)
            sun = library.tetralight_relight_sun, direction.ctypes.data, light.ctypes.data
            changes.append((self.can_relight_sun, sun))
        # A change that the volume refuses comes first: nothing has changed then.
        changes.sort(key=lambda change: change[0])
        with self._changes:
            self._change([call_of for _, call_of in changes])

    def _change(self, calls: list[Any]) -> None:
        """Calls functions of the library that must run alone on the volume. No query runs between them."""
        contents = self._open_contents()

        def change() -> None:
            contents.prepare_change()
            for function, *arguments in calls:
                call(function, contents.handle.pointer, *arguments)

        self._gate.run_alone(change)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the volume with its present light to a .probes file."""
        name = path_text("path", path)
        name = "./-" if name == "-" else name  # which is standard output for the library
        self._read(lambda contents: call(library.tetralight_save, contents.handle.pointer, os.fsencode(name)))

    # Pictures and files

    def picture(self, width: int = 640) -> Pixels:
        """uint8 (height, width, 3): the probes from above, colored by their mean irradiance. X points
        right, Z down; higher probes hide lower ones."""
        if self.has_light:
            colors = tone_mapped(mean_irradiance(np.asarray(self.irradiance)))
        else:
            colors = np.full((self.probe_count, 3), 160, np.uint8)
        return probes_from_above(self.positions, colors, width)

    def _repr_png_(self) -> bytes | None:
        return None if self.is_closed else png(self.picture())

    def to_vtu(self, path: str | os.PathLike[str]) -> None:
        """Writes probes and cells as a .vtu file for ParaView and PyVista."""
        mesh.write_vtu(self, path)

    def to_meshio(self) -> Any:
        """Probes and cells as a `meshio.Mesh`; needs meshio."""
        return mesh.meshio_mesh(self)


def open(source: Source) -> Volume:
    """Opens a .probes file, or its bytes, and verifies all of it. Bytes are copied."""
    files = library.tetralight_open, library.tetralight_open_memory
    return Volume(*opened_file(*files, library.tetralight_close, source))
