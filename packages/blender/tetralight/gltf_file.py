# SPDX-License-Identifier: Apache-2.0
"""Reads and writes the JSON of binary glTF files. Needs no Blender."""
import json
import struct

HEADER = struct.Struct("<4sII")
CHUNK = struct.Struct("<I4s")


def read_glb(path):
    """The JSON document of a .glb file, and the bytes of the chunks after it."""
    data = path.read_bytes()
    magic, version, size = HEADER.unpack_from(data) if len(data) >= HEADER.size else (b"", 0, 0)
    if magic != b"glTF" or version != 2 or size != len(data):
        raise ValueError(f"{path} is not a binary glTF 2.0 file")
    length, kind = CHUNK.unpack_from(data, HEADER.size)
    begin = HEADER.size + CHUNK.size
    if kind != b"JSON" or begin + length > size:
        raise ValueError(f"{path} has no JSON")
    return json.loads(data[begin : begin + length]), data[begin + length :]


def write_glb(path, document, chunks):
    """Writes what `read_glb` has read."""
    text = json.dumps(document, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    size = HEADER.size + CHUNK.size + len(text) + len(chunks)
    path.write_bytes(HEADER.pack(b"glTF", 2, size) + CHUNK.pack(len(text), b"JSON") + text + chunks)
