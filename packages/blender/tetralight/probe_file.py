# SPDX-License-Identifier: Apache-2.0
"""Reads positions and light of the probes of a .probes file. Needs NumPy, and no Blender.

The format is described byte by byte in docs/file_format.md of Tetralight.
"""
import struct

import numpy

HEADER = struct.Struct("<8sIIQ")
HEADER_SIZE = 64
ENTRY = struct.Struct("<24sQQQ")
ENTRY_SIZE = 64
INFO_SIZE = 208
SCALE_OFFSET = 204  # of the compact probes, in `info`
MOST_SECTIONS = 1024


class Probes:
    """The probes of a volume: glTF's axes (Y up), metres."""

    def __init__(self, positions, coefficients):
        self.positions = positions  # n × 3, world
        self.coefficients = coefficients  # n × 9 × 3: of irradiance, RGB

    def __len__(self):
        return len(self.positions)

    def irradiance(self, normals):
        """RGB irradiance of each probe on surfaces with these unit normals: n × m × 3."""
        return numpy.einsum("nic,mi->nmc", self.coefficients, basis(normals))


def basis(normals):
    """The nine spherical harmonics of m unit vectors: m × 9."""
    x, y, z = numpy.asarray(normals, dtype=float).T
    return numpy.stack(
        [
            numpy.full_like(x, 0.28209479177387814),
            0.4886025119029199 * y,
            0.4886025119029199 * z,
            0.4886025119029199 * x,
            1.0925484305920792 * x * y,
            1.0925484305920792 * y * z,
            0.31539156525252005 * (3 * z * z - 1),
            1.0925484305920792 * x * z,
            0.5462742152960396 * (x * x - y * y),
        ],
        axis=1,
    )


def read_probes(path):
    """Reads a .probes file. Raises ValueError if it is damaged or not one, OSError if it cannot be read."""
    data = path.read_bytes()
    try:
        return _probes_of(_read_sections(data))
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def _read_sections(data):
    if len(data) < HEADER_SIZE or data[:8] != b"TETRAPV\n":
        raise ValueError("this is not a probe volume")
    _, version, count, size = HEADER.unpack_from(data)
    if version != 1:
        raise ValueError(f"the version of the probe volume is {version}; this add-on reads version 1")
    if size != len(data) or count > MOST_SECTIONS or HEADER_SIZE + ENTRY_SIZE * count > size:
        raise ValueError(f"the file has {len(data)} bytes, and its header says {size}: it was cut off or changed")
    sections = {}
    for i in range(count):
        name, offset, elements, element_size = ENTRY.unpack_from(data, HEADER_SIZE + ENTRY_SIZE * i)
        end = offset + elements * element_size
        name = name.rstrip(b"\0").decode("ascii", "replace")
        if end > size:
            raise ValueError(f"section {name} ends at byte {end} of {size}")
        sections[name] = (data[offset:end], element_size)
    return sections


def _numbers(sections, name, kind, columns):
    """The elements of a section as rows of numbers; None if there is no such section."""
    if name not in sections:
        return None
    data, element_size = sections[name]
    if element_size != columns * numpy.dtype(kind).itemsize:
        raise ValueError(f"section {name} has elements of {element_size} bytes")
    return numpy.frombuffer(data, dtype=kind).reshape(-1, columns)


def _probes_of(sections):
    info, info_size = sections.get("info", (b"", 0))
    if info_size != INFO_SIZE or len(info) != INFO_SIZE:
        raise ValueError(f"section info has {len(info)} bytes, not {INFO_SIZE}")
    positions = _numbers(sections, "positions", "<f4", 3)
    if positions is None:
        positions = numpy.zeros((0, 3))
    coefficients = _coefficients(sections, info, len(positions))
    if len(coefficients) != len(positions):
        raise ValueError(f"there is light of {len(coefficients)} probes, and there are {len(positions)}")
    if not (numpy.isfinite(positions).all() and numpy.isfinite(coefficients).all()):
        raise ValueError("numbers of probes are not finite")
    return Probes(positions + numpy.frombuffer(info, dtype="<f8", count=3), coefficients)


def _coefficients(sections, info, probe_count):
    """Of full precision if the file has them, else of the compact probes; 0 if the volume has no light."""
    full = _numbers(sections, "irradiance", "<f4", 27)
    if full is not None:
        return full.reshape(-1, 9, 3).astype(float)
    compact = _numbers(sections, "compact", "<f2", 32)
    if compact is None:
        return numpy.zeros((probe_count, 9, 3))
    scale, = struct.unpack_from("<f", info, SCALE_OFFSET)
    return compact[:, :27].reshape(-1, 9, 3).astype(float) * scale
