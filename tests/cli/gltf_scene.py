# SPDX-License-Identifier: Apache-2.0
"""One plain scene in glTF, and what its variants are made of."""
import base64
import json
import math
import struct
import zlib
from pathlib import Path

FOLDER = Path(__file__).resolve().parent

BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
CODES = {BYTE: "b", UBYTE: "B", SHORT: "h", USHORT: "H", UINT: "I", FLOAT: "f"}
PAINT = (200, 120, 60)  # sRGB, of the box
OTHER = (40, 90, 210)  # what it would be if a texture were read wrongly
PLACE = {"translation": [0.3, 0.4, -0.2], "rotation": [0, math.sin(0.3), 0, math.cos(0.3)]}  # of the box
HALF = (0.6, 0.4, 0.3)  # its half size


# --- Numbers --------------------------------------------------------------------------------------------------------
def linear(color):
    """Linear RGB of an sRGB colour of 0 to 255."""
    return [c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in color]


def multiply(a, b):
    """The product of two matrices of 16 numbers, column by column."""
    return [sum(a[4 * k + row] * b[4 * column + k] for k in range(4)) for column in range(4) for row in range(4)]


def matrix(translation=(0, 0, 0), rotation=(0, 0, 0, 1), scale=(1, 1, 1)):
    x, y, z, w = rotation
    axes = [(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
            (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
            (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))]
    return [c * s for axis, s in zip(axes, scale) for c in (*axis, 0)] + [*translation, 1]


def transformed(m, points, w=1):
    return [[sum(m[4 * k + row] * value for k, value in enumerate((*p, w))) for row in range(3)] for p in points]


def turn(axis, degrees):
    half = math.radians(degrees) / 2
    return [*(math.sin(half) * c for c in axis), math.cos(half)]


# --- Files ----------------------------------------------------------------------------------------------------------
class Gltf:
    """A glTF document and its one buffer."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": []}
        self.binary = bytearray()

    def add(self, kind, element):
        self.json.setdefault(kind, []).append(element)
        return len(self.json[kind]) - 1

    def extension(self, name, element=None, value=None, required=False):
        """Uses an extension, in an element or in the file."""
        if element is not None:
            element.setdefault("extensions", {})[name] = value if value is not None else {}
        for names in ("extensionsUsed", *(["extensionsRequired"] if required else [])):
            if name not in self.json.setdefault(names, []):
                self.json[names].append(name)

    def view(self, data, **members):
        self.binary += bytes(-len(self.binary) % 4)
        self.binary += data
        offset = len(self.binary) - len(data)
        return self.add("bufferViews", {"buffer": 0, "byteOffset": offset, "byteLength": len(data), **members})

    def accessor(self, values, component=FLOAT, view=None, **members):
        """Numbers, or lists of them, in a view of their own."""
        values = [list(v) if hasattr(v, "__len__") else [v] for v in values]
        kind = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}[len(values[0])]
        if view is None:
            view = self.view(packed(values, component))
        bounds = {"min": [min(c) for c in zip(*values)], "max": [max(c) for c in zip(*values)]}
        return self.add("accessors", {"bufferView": view, "componentType": component, "count": len(values),
                                      "type": kind, **bounds, **members})

    def node(self, name):
        return next(node for node in self.json["nodes"] if node["name"] == name)

    def index(self, name):
        return self.json["nodes"].index(self.node(name))

    @property
    def box(self):
        return self.json["meshes"][1]["primitives"][0]

    @property
    def paint(self):
        return self.json["materials"][1]

    def texture(self, image, mime="image/png", sampler=None, **members):
        source = self.add("images", {"bufferView": self.view(image), "mimeType": mime})
        texture = {"source": source, **members}
        if sampler is not None:
            texture["sampler"] = self.add("samplers", sampler)
        return self.add("textures", texture)

    def document(self):
        """Of a file with a buffer 0, unless it has buffers of its own."""
        if "buffers" in self.json:
            return self.json
        return {**self.json, "buffers": [{"byteLength": len(self.binary)}]}

    def glb(self):
        document = json.dumps(self.document()).encode()
        return glb((b"JSON", document + b" " * (-len(document) % 4)),
                   (b"BIN\0", bytes(self.binary) + bytes(-len(self.binary) % 4)))


def glb(*chunks):
    body = b"".join(struct.pack("<I4s", len(data), kind) + data for kind, data in chunks)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def packed(values, component=FLOAT):
    return b"".join(struct.pack(f"<{len(v)}{CODES[component]}", *v) for v in values)


def files_of(scene):
    """Names and bytes; the scene's own file is the first."""
    return scene if isinstance(scene, dict) else {"scene.glb": scene.glb()}


# --- The plain scene ------------------------------------------------------------------------------------------------
def box_mesh(half=HALF):
    """Positions, normals, texture coordinates and indices of a box."""
    positions, normals, uvs, indices = [], [], [], []
    for axis in range(3):
        for side in (-1, 1):
            normal = [side * (i == axis) for i in range(3)]
            u = [int(i == (axis + 1) % 3) for i in range(3)]
            v = [side * int(i == (axis + 2) % 3) for i in range(3)]
            first = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                positions.append([(normal[i] + a * u[i] + b * v[i]) * half[i] for i in range(3)])
                normals.append(normal)
                uvs.append([(a + 1) / 2, (b + 1) / 2])
            indices += [first, first + 1, first + 2, first, first + 2, first + 3]
    return positions, normals, uvs, indices


ROOM = [([-3, 0, 3], [3, 0, 3], [3, 0, -3], [-3, 0, -3]),
        ([-3, 0, -3], [3, 0, -3], [3, 3, -3], [-3, 3, -3]),
        ([-3, 0, 3], [-3, 0, -3], [-3, 3, -3], [-3, 3, 3])]
PROBES = [[1.1, 0.5, 0], [-0.7, 0.5, -0.3], [0.2, 0.4, 0.7], [0.4, 0.3, -1.0], [0.3, 1.1, -0.2]]


def material(name, color):
    return {"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0}}


def plain(positions=None, color=None):
    """A box in the corner of a room, a sun and a lamp, and five probes around the box."""
    gltf = Gltf()
    gltf.json["materials"] = [material("plaster", [0.7, 0.7, 0.65]), material("paint", color or linear(PAINT))]
    corners = [corner for wall in ROOM for corner in wall]
    indices = [4 * wall + i for wall in range(len(ROOM)) for i in (0, 1, 2, 0, 2, 3)]
    box = box_mesh()
    gltf.json["meshes"] = [
        {"name": "room", "primitives": [{"attributes": {"POSITION": gltf.accessor(corners)},
                                         "indices": gltf.accessor(indices, USHORT), "material": 0}]},
        {"name": "box", "primitives": [{"attributes": {"POSITION": gltf.accessor(positions or box[0]),
                                                       "NORMAL": gltf.accessor(box[1]),
                                                       "TEXCOORD_0": gltf.accessor(box[2])},
                                        "indices": gltf.accessor(box[3], USHORT), "material": 1}]}]
    gltf.json["extensions"] = {"KHR_lights_punctual": {"lights": [
        {"name": "sun", "type": "directional", "intensity": 3},
        {"name": "lamp", "type": "point", "intensity": 4, "color": [1, 0.8, 0.6]}]}}
    gltf.extension("KHR_lights_punctual")
    gltf.json["nodes"] = [
        {"name": "room", "mesh": 0}, {"name": "box", "mesh": 1, **PLACE},
        {"name": "sun", "rotation": turn((0.8, 0.6, 0), -60), "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"name": "lamp", "translation": [1.5, 1.5, 1.5], "extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"name": "probes", "children": [5, 6, 7, 8, 9], "extras": {"light_probe_group": True}},
        *({"name": f"probe {i}", "translation": place} for i, place in enumerate(PROBES))]
    gltf.json["scenes"] = [{"name": "first", "nodes": [0, 1, 2, 3, 4]}]
    gltf.json["scene"] = 0
    return gltf


def reversed_box():
    """The box inside out: black from outside."""
    gltf = plain()
    indices = box_mesh()[3]
    gltf.box["indices"] = gltf.accessor([i for t in range(0, 36, 3) for i in indices[t:t + 3][::-1]], USHORT)
    return gltf


def no_box():
    gltf = plain()
    del gltf.node("box")["mesh"]
    return gltf


def painted(color):
    return lambda: plain(color=linear(color))


def moved_box(m=None, **place):
    """The box with another transform in its place."""
    gltf = plain()
    node = gltf.node("box")
    for member in ("translation", "rotation"):
        del node[member]
    node.update({"matrix": m} if m else place)
    return gltf


def deformed_box(change):
    return plain(positions=[change(p) for p in box_mesh()[0]])


# --- Images ---------------------------------------------------------------------------------------------------------
def png(width, rows, depth, kind, chunks=(), interlaced=False):
    """A PNG image of rows of packed pixels. `chunks` are (name, data) before the pixels."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    header = struct.pack(">IIBBBBB", width, width, depth, kind, 0, 0, int(interlaced))
    pixels = zlib.compress(b"".join(b"\0" + row for row in rows))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + b"".join(chunk(*c) for c in chunks) +
            chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


def flat_png(pixel=bytes(PAINT), depth=8, kind=2, chunks=()):
    """8 x 8 pixels of the same bytes. Of less than 8 bits, `pixel` is what fills a byte."""
    count = 8 if depth >= 8 else depth
    return png(8, [pixel * count] * 8, depth, kind, chunks)


def half_png(left=PAINT, right=OTHER):
    """The left half of one colour, the right half of another."""
    return png(8, [bytes(left) * 4 + bytes(right) * 4] * 8, 8, 2)


def top_png(top=PAINT, bottom=OTHER):
    return png(8, [bytes(top) * 8] * 4 + [bytes(bottom) * 8] * 4, 8, 2)


def interlaced_png():
    passes = [(8, 8), (8, 8), (4, 8), (4, 4), (2, 4), (2, 2), (1, 2)]  # steps in x and y of Adam7
    starts = [(0, 0), (4, 0), (0, 4), (2, 0), (0, 2), (1, 0), (0, 1)]
    rows = []
    for (step_x, step_y), (x, y) in zip(passes, starts):
        columns = range(x, 8, step_x)
        rows += [b"".join(bytes(PAINT if c < 4 else OTHER) for c in columns) for _ in range(y, 8, step_y)]
    return png(8, rows, 8, 2, interlaced=True)


def textured(image, area=(0, 0, 1, 1), mime="image/png", sampler=None, **use):
    """The box with an image. `area` is where in the image its faces are: u, v, u, v."""
    gltf = plain(color=[1, 1, 1])
    set_uvs(gltf, area)
    gltf.paint["pbrMetallicRoughness"]["baseColorTexture"] = {"index": gltf.texture(image, mime, sampler), **use}
    return gltf


def uvs_in(area):
    u0, v0, u1, v1 = area
    return [[u0 + u * (u1 - u0), v0 + v * (v1 - v0)] for u, v in box_mesh()[2]]


def set_uvs(gltf, area, name="TEXCOORD_0", component=FLOAT, **members):
    uvs = uvs_in(area)
    if component != FLOAT:
        largest = 255 if component == UBYTE else 65535
        uvs = [[round(c * largest) for c in uv] for uv in uvs]
        members["normalized"] = True
        if component == UBYTE:
            view = gltf.view(b"".join(bytes(uv) + b"\0\0" for uv in uvs), byteStride=4)
            members["view"] = view
    gltf.box["attributes"][name] = gltf.accessor(uvs, component, **members)


LEFT, RIGHT = (0.125, 0.1, 0.375, 0.9), (0.625, 0.1, 0.875, 0.9)


def blob(name):
    with open(FOLDER / "gltf_blobs.json", encoding="utf-8") as file:
        return json.load(file)[name]


def blob_bytes(name):
    return base64.b64decode(blob(name))
