#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the colours of an RGBM image and its multipliers as two opaque images: split_rgbm.py IN.png RGB.png A.png"""
import struct
import sys
import zlib


def chunks(data):
    at = 8
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        yield kind, data[at + 8:at + 8 + size]
        at += 12 + size


def paeth(a, b, c):
    p = a + b - c
    return min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]


def read_rows(data):
    """The rows of an RGBA PNG of 8 bits, not interlaced."""
    found = list(chunks(data))
    width, height, depth, color = struct.unpack_from(">IIBB", found[0][1])
    assert (depth, color) == (8, 6), "not an RGBA PNG of 8 bits"
    packed = zlib.decompress(b"".join(content for kind, content in found if kind == b"IDAT"))
    above, rows = bytearray(4 * width), []
    for y in range(height):
        start = y * (4 * width + 1)
        kind, row = packed[start], bytearray(packed[start + 1:start + 1 + 4 * width])
        for i, value in enumerate(row):
            left, diagonal = (row[i - 4], above[i - 4]) if i >= 4 else (0, 0)
            predicted = (0, left, above[i], (left + above[i]) // 2, paeth(left, above[i], diagonal))[kind]
            row[i] = (value + predicted) & 255
        rows.append(row)
        above = row
    return rows


def write_rgb(path, rows):
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + row for row in rows))
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


def main():
    source, colors, multipliers = sys.argv[1:]
    with open(source, "rb") as file:
        rows = read_rows(file.read())
    write_rgb(colors, [bytes(value for i, value in enumerate(row) if i % 4 != 3) for row in rows])
    write_rgb(multipliers, [bytes(value for value in row[3::4] for _ in range(3)) for row in rows])


if __name__ == "__main__":
    main()
