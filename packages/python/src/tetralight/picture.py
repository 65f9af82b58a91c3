# SPDX-License-Identifier: Apache-2.0
"""Pictures of probes, and PNG files without another library."""
from __future__ import annotations

import os
from typing import Any

import numpy as np

from tetralight._arguments import integer, numbers
from tetralight._arrays import AnyArray, FloatArray, vectors
from tetralight._files import write_file
from tetralight.errors import BadValue

Pixels = np.ndarray[Any, np.dtype[np.uint8]]

BACKGROUND = 28
_LUMINANCE = np.array((0.2126, 0.7152, 0.0722), np.float32)


def png(pixels: Any) -> bytes:
    """The bytes of a PNG file: uint8 (height, width), (height, width, 3) or (height, width, 4), sRGB."""
    import struct
    import zlib

    image = numbers("pixels", pixels, "uint8 (height, width[, 3 or 4])")
    channels = image.shape[2] if image.ndim == 3 else 1
    if image.dtype != np.uint8 or image.ndim not in (2, 3) or channels not in (1, 3, 4) or image.size == 0:
        raise BadValue(f"pixels: expected uint8 (height, width[, 3 or 4]), given {image.dtype} {image.shape}")
    height, width = image.shape[:2]
    color_type = {1: 0, 3: 2, 4: 6}[channels]
    # Each row begins with the number of its filter: 0, none.
    rows = np.zeros((height, 1 + width * channels), np.uint8)
    rows[:, 1:] = image.reshape(height, -1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0)
    parts = (chunk(b"IHDR", head), chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)), chunk(b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def write_png(path: str | os.PathLike[str], pixels: Any) -> None:
    """Writes a picture; see `png`."""
    write_file(path, png(pixels))


def tone_mapped(light: AnyArray) -> Pixels:
    """sRGB colors of linear light (…, 3), as bright as the brighter parts of it allow."""
    values = np.maximum(np.nan_to_num(vectors("light", light)), 0)
    luminance = values @ _LUMINANCE
    bright = float(np.percentile(luminance, 90)) if luminance.size else 0.0
    linear = np.clip(values * (0.7 / bright if bright > 0 else 1.0), 0, 1)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.asarray(np.rint(encoded * 255), np.uint8)


def _disc(radius: float) -> tuple[AnyArray, AnyArray, AnyArray]:
    """Offsets of the pixels of a disc, and how bright they are: as a ball seen from above."""
    reach = int(radius)
    y, x = (axis.ravel() for axis in np.mgrid[-reach : reach + 1, -reach : reach + 1])
    square = (x * x + y * y) / max(radius * radius, 1e-6)
    inside = square <= 1
    return x[inside], y[inside], 1 - 0.45 * square[inside]


def probes_from_above(positions: AnyArray, colors: Pixels, width: int = 640) -> Pixels:
    """(height, width, 3): a ball for each position; X points right, Z down, and higher balls hide lower
    ones."""
    width = integer("width", width, 16, 65536)
    if len(positions) == 0:
        return np.full((width // 2, width, 3), BACKGROUND, np.uint8)
    plane = np.asarray(positions, np.float64)[:, (0, 2)]
    low, size = plane.min(0), np.ptp(plane, axis=0)
    margin = 0.06 * width
    scale = (width - 2 * margin) / max(float(size[0]), float(size[1]) / 1.5, 1e-9)
    height = max(16, int(np.ceil(size[1] * scale + 2 * margin)))
    radius = float(np.clip(0.32 * np.sqrt(width * height / len(plane)), 1, 0.8 * margin))
    x_offset, y_offset, shade = _disc(radius)
    order = np.argsort(positions[:, 1], kind="stable")
    center = np.array((width, height)) / 2
    at = np.rint((plane[order] - low - size / 2) * scale + center).astype(np.int64)
    x, y = at[:, :1] + x_offset, at[:, 1:] + y_offset
    seen = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    pixels = np.full((height, width, 3), BACKGROUND, np.uint8)
    shaded = (colors[order][:, None, :] * shade[None, :, None]).astype(np.uint8)
    pixels[y[seen], x[seen]] = shaded[seen]
    return pixels
