# SPDX-License-Identifier: Apache-2.0
"""One plain scene, and variants of it with one feature of glTF each.

    python3 gltf_variants.py FOLDER      writes all of them
    python3 gltf_variants.py --table     how the program TETRALIGHT_COMMAND reads each

A variant is `right` if its light is that of its twin, a scene that says the same in the plainest way; `told` if
messages name what is left out or approximated; `refused` if the error says what to do. None may be silent.
`wrong` is what a reader sees that misses the feature: its light must differ, or the variant would prove nothing.
"""
import base64
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import zlib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
CODES = {BYTE: "b", UBYTE: "B", SHORT: "h", USHORT: "H", UINT: "I", FLOAT: "f"}
SIZES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
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
        text = json.dumps(self.document()).encode()
        return glb((b"JSON", text + b" " * (-len(text) % 4)),
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


# --- Variants -------------------------------------------------------------------------------------------------------
@dataclass
class Variant:
    name: str
    make: object
    twin: object
    wrong: object
    expected: str  # right, told or refused
    says: str  # a part of the message that tells or refuses
    tolerance: float
    options: tuple


VARIANTS = []


def variant(name, twin=plain, wrong=None, told=None, refused=None, tolerance=1e-4, options=()):
    def add(make):
        expected = "told" if told else "refused" if refused else "right"
        VARIANTS.append(Variant(name, make, twin, wrong, expected, told or refused or "", tolerance, options))
        return make
    return add


def variants(values, name, **members):
    """A variant for each of some values; `name` has {} for its words, `wrong` and `twin` may be functions of them."""
    def add(make):
        for words, value in values.items():
            variant(name.format(words), **members)(lambda value=value: make(value))
        return make
    return add


# Accessors
def replaced(name="POSITION", **view):
    gltf = plain()
    del gltf.box["attributes"][name]
    return gltf


def squeezed(count):
    """The box with its first vertices in its centre."""
    return lambda: plain(positions=[[0, 0, 0]] * count + box_mesh()[0][count:])


@variant("sparse positions", wrong=squeezed(6))
def _():
    gltf, positions = plain(positions=[[0, 0, 0]] * 6 + box_mesh()[0][6:]), box_mesh()[0]
    gltf.json["accessors"][gltf.box["attributes"]["POSITION"]]["sparse"] = {
        "count": 6, "indices": {"bufferView": gltf.view(bytes(range(6))), "componentType": UBYTE},
        "values": {"bufferView": gltf.view(packed(positions[:6]))}}
    return gltf


@variant("sparse positions of a target without a view", twin=lambda: deformed_box(lambda p: [p[0], p[1] * 2.5, p[2]]),
         wrong=plain)
def _():
    gltf, positions = plain(), box_mesh()[0]
    high = [i for i, p in enumerate(positions)]
    target = gltf.add("accessors", {
        "componentType": FLOAT, "count": 24, "type": "VEC3", "sparse": {
            "count": 24, "indices": {"bufferView": gltf.view(packed([[i] for i in high], USHORT)),
                                     "componentType": USHORT},
            "values": {"bufferView": gltf.view(packed([[0, p[1] * 1.5, 0] for p in positions]))}}})
    gltf.box["targets"] = [{"POSITION": target}]
    gltf.json["meshes"][1]["weights"] = [1]
    return gltf


@variant("sparse indices", wrong=no_box)
def _():
    gltf, indices = plain(), box_mesh()[3]
    accessor = gltf.accessor([0] * 36, UBYTE)
    gltf.json["accessors"][accessor]["sparse"] = {
        "count": 36, "indices": {"bufferView": gltf.view(packed([[i] for i in range(36)], UINT)),
                                 "componentType": UINT},
        "values": {"bufferView": gltf.view(bytes(indices))}}
    gltf.box["indices"] = accessor
    return gltf


@variant("interleaved attributes", wrong=lambda: plain(positions=squash(box_mesh()[0])))
def _():
    gltf, (positions, normals, uvs, _) = plain(), box_mesh()
    view = gltf.view(b"".join(packed([p, n, uv]) for p, n, uv in zip(positions, normals, uvs)), byteStride=32)
    for name, values, offset in (("POSITION", positions, 0), ("NORMAL", normals, 12), ("TEXCOORD_0", uvs, 24)):
        gltf.box["attributes"][name] = gltf.accessor(values, view=view, byteOffset=offset)
    return gltf


def squash(positions):
    return [p if i < 8 else [0, 0, 0] for i, p in enumerate(positions)]


@variant("byteStride and byteOffset", wrong=lambda: plain(positions=squash(box_mesh()[0])))
def _():
    gltf, positions = plain(), box_mesh()[0]
    view = gltf.view(bytes(8) + b"".join(packed([p]) + b"\xff" * 12 for p in positions), byteStride=24)
    gltf.box["attributes"]["POSITION"] = gltf.accessor(positions, view=view, byteOffset=8)
    return gltf


@variants({"u8": UBYTE, "u16": USHORT, "u32": UINT}, "{} indices", wrong=no_box)
def _(component):
    gltf = plain()
    gltf.box["indices"] = gltf.accessor(box_mesh()[3], component)
    return gltf


@variant("no indices", wrong=no_box)
def _():
    gltf, (positions, _, _, indices) = plain(), box_mesh()
    gltf.box["attributes"] = {"POSITION": gltf.accessor([positions[i] for i in indices])}
    del gltf.box["indices"]
    return gltf


def primitives(mode, corner_order):
    """The box as one primitive of each face."""
    gltf = plain()
    mesh = gltf.json["meshes"][1]
    template = {key: value for key, value in gltf.box.items() if key != "indices"}
    mesh["primitives"] = [{**template, "mode": mode,
                           "indices": gltf.accessor([4 * face + i for i in corner_order], USHORT)}
                          for face in range(6)]
    return gltf


@variant("strips", wrong=no_box)
def _():
    return primitives(5, (0, 1, 3, 2))


@variant("fans", wrong=no_box)
def _():
    return primitives(6, (0, 1, 2, 3))


@variant("one strip with triangles without area", wrong=no_box)
def _():
    gltf, order = plain(), []
    for face in range(6):
        corners = [4 * face + i for i in (0, 1, 3, 2)]
        order += ([order[-1], corners[0]] if order else []) + corners
    gltf.box.update(mode=5, indices=gltf.accessor(order, USHORT))
    return gltf


@variant("points and lines", told="lines")
def _():
    gltf = plain()
    for mode in (0, 1, 2, 3):
        gltf.json["meshes"][1]["primitives"].append({**gltf.box, "mode": mode})
    return gltf


@variant("no normals")
def _():
    gltf = plain()
    del gltf.box["attributes"]["NORMAL"]
    return gltf


@variant("default material", twin=lambda: white_box(), wrong=plain)
def _():
    gltf = plain()
    del gltf.box["material"]
    return gltf


def white_box():
    gltf = plain(color=[1, 1, 1])
    gltf.paint["pbrMetallicRoughness"].update(metallicFactor=1, roughnessFactor=1)
    return gltf


@variants({"u8": UBYTE, "u16": USHORT}, "normalized {} texture coordinates", wrong=painted(OTHER))
def _(component):
    gltf = textured(half_png())
    set_uvs(gltf, LEFT, component=component)
    return gltf


@variants({"u8 RGB": (UBYTE, 3), "u8 RGBA": (UBYTE, 4), "u16 RGB": (USHORT, 3), "u16 RGBA": (USHORT, 4),
           "float RGB": (FLOAT, 3), "float RGBA": (FLOAT, 4)}, "vertex colours: {}",
          twin=lambda: plain(color=[0.8, 0.4, 0.2]), wrong=lambda: plain(color=[1, 1, 1]))
def _(kind):
    component, size = kind
    largest = {UBYTE: 255, USHORT: 65535, FLOAT: 1}[component]
    color = [c * largest for c in (0.8, 0.4, 0.2, 1)[:size]]
    color = color if component == FLOAT else [round(c) for c in color]
    gltf = plain(color=[1, 1, 1])
    stride = -(-size * struct.calcsize(CODES[component]) // 4) * 4
    one = packed([color], component)
    view = gltf.view((one + bytes(stride - len(one))) * 24, byteStride=stride)
    gltf.box["attributes"]["COLOR_0"] = gltf.accessor([color] * 24, component, view=view,
                                                      **({} if component == FLOAT else {"normalized": True}))
    return gltf


@variant("a second set of vertex colours", told="COLOR_1")
def _():
    gltf = plain()
    gltf.box["attributes"]["COLOR_1"] = gltf.accessor([[0, 0, 1]] * 24)
    return gltf


@variant("an attribute of a program", told="_BATCHID")
def _():
    gltf = plain()
    gltf.box["attributes"]["_BATCHID"] = gltf.accessor([1] * 24)
    return gltf


# Quantization and compression
@variants({"u8": (UBYTE, 240, False), "u16": (USHORT, 48000, False), "i8": (BYTE, 120, False),
           "i16": (SHORT, 30000, False), "normalized i16": (SHORT, 32767, True),
           "normalized u8": (UBYTE, 255, True)}, "quantized positions: {}", wrong=no_box, tolerance=1e-3)
def _(kind):
    component, largest, normalized = kind
    is_signed = component in (BYTE, SHORT)
    gltf = plain()
    steps = [[round((c / h if is_signed else (c / h + 1) / 2) * largest) for c, h in zip(p, HALF)]
             for p in box_mesh()[0]]
    code_size = struct.calcsize(CODES[component])
    stride = -(-3 * code_size // 4) * 4
    view = gltf.view(b"".join(packed([s], component) + bytes(stride - 3 * code_size) for s in steps), byteStride=stride)
    gltf.box["attributes"] = {"POSITION": gltf.accessor(steps, component, view=view,
                                                        **({"normalized": True} if normalized else {}))}
    one = 1 if normalized else largest
    scale = [h / one * (1 if is_signed else 2) for h in HALF]
    gltf.node("box").update(mesh=1)
    inner = gltf.add("nodes", {"name": "quantized", "mesh": 1, "scale": scale,
                               "translation": [0, 0, 0] if is_signed else [-h for h in HALF]})
    del gltf.node("box")["mesh"]
    gltf.node("box")["children"] = [inner]
    gltf.extension("KHR_mesh_quantization", required=True)
    return gltf


def draco(name, attributes, **change):
    gltf, encoded = plain(), blob(name)
    view = gltf.view(base64.b64decode(encoded["data"]))
    primitive = gltf.box
    primitive["attributes"] = {key: primitive["attributes"][key] for key in attributes}
    for accessor in (primitive["indices"], *primitive["attributes"].values()):
        gltf.json["accessors"][accessor].pop("bufferView")
    gltf.extension("KHR_draco_mesh_compression", primitive,
                   {"bufferView": view, "attributes": {key: encoded["attributes"][key] for key in attributes}},
                   required=True)
    return gltf


@variants({"edgebreaker": "draco_edgebreaker", "sequential": "draco_sequential"}, "Draco, {}", wrong=no_box,
          tolerance=2e-3)
def _(name):
    return draco(name, ("POSITION", "NORMAL", "TEXCOORD_0"))


@variant("Draco with texture coordinates", wrong=painted(OTHER), tolerance=2e-3)
def _():
    gltf = draco("draco_edgebreaker", ("POSITION", "NORMAL", "TEXCOORD_0"))
    texture = gltf.texture(half_png(OTHER, PAINT))
    gltf.extension("KHR_texture_transform")
    gltf.paint["pbrMetallicRoughness"] = {"metallicFactor": 0, "baseColorTexture": {
        "index": texture, "extensions": {"KHR_texture_transform": {"scale": [0.25, 1], "offset": [0.625, 0]}}}}
    return gltf


@variant("Draco with a plain fallback", tolerance=2e-3, wrong=no_box)
def _():
    gltf, encoded = plain(), blob("draco_positions")
    gltf.box["attributes"].pop("NORMAL")
    gltf.box["attributes"].pop("TEXCOORD_0")
    gltf.extension("KHR_draco_mesh_compression", gltf.box,
                   {"bufferView": gltf.view(base64.b64decode(encoded["data"])), "attributes": encoded["attributes"]})
    return gltf


def meshopt(target, name, count, stride, mode, filter=None, extension="EXT_meshopt_compression", fallback=True):
    """Replaces the view of an accessor."""
    def change(gltf):
        data = blob_bytes(name)
        offset = gltf.json["bufferViews"][gltf.view(data)]["byteOffset"]
        buffers = gltf.json.setdefault("buffers", [{}, {"byteLength": 0, "extensions": {extension: {"fallback": True}}}])
        begin = buffers[1]["byteLength"]
        buffers[1]["byteLength"] += count * stride + (-count * stride) % 4
        view = {"buffer": 1, "byteOffset": begin, "byteLength": count * stride, "extensions": {extension: {
            "buffer": 0, "byteOffset": offset, "byteLength": len(data), "byteStride": stride, "count": count,
            "mode": mode, **({"filter": filter} if filter else {})}}}
        accessor = gltf.json["accessors"][target(gltf)]
        accessor["bufferView"] = gltf.add("bufferViews", view)
        gltf.extension(extension, required=True)
        buffers[0]["byteLength"] = len(gltf.binary)
        return accessor
    return change


def of_positions(gltf):
    return gltf.box["attributes"]["POSITION"]


def of_indices(gltf):
    return gltf.box["indices"]


MESHOPT = {"positions": meshopt(of_positions, "meshopt_positions_v0", 24, 12, "ATTRIBUTES"),
           "exponential filter": meshopt(of_positions, "meshopt_exponential", 24, 12, "ATTRIBUTES", "EXPONENTIAL"),
           "triangles": meshopt(of_indices, "meshopt_triangles", 36, 2, "TRIANGLES"),
           "indices": meshopt(of_indices, "meshopt_indices", 36, 2, "INDICES")}


@variants(MESHOPT, "meshopt: {}", wrong=no_box, tolerance=2e-3)
def _(change):
    gltf = plain()
    change(gltf)
    return gltf


@variant("meshopt: 32-bit triangles", wrong=no_box, tolerance=2e-3)
def _():
    gltf = plain()
    accessor = meshopt(of_indices, "meshopt_triangles_32", 36, 4, "TRIANGLES")(gltf)
    accessor["componentType"] = UINT
    return gltf


@variant("meshopt: octahedral normals")
def _():
    gltf = plain()
    accessor = meshopt(lambda g: g.box["attributes"]["NORMAL"], "meshopt_octahedral", 24, 4, "ATTRIBUTES",
                       "OCTAHEDRAL")(gltf)
    accessor.update(componentType=BYTE, normalized=True, min=[-1] * 3, max=[1] * 3)
    gltf.extension("KHR_mesh_quantization", required=True)
    return gltf


@variant("meshopt: a later version of the encoder", refused="gltfpack -c")
def _():
    gltf = plain()
    meshopt(of_positions, "meshopt_positions_v1", 24, 12, "ATTRIBUTES")(gltf)
    return gltf


@variant("KHR_meshopt_compression, required", refused="EXT_meshopt_compression")
def _():
    gltf = plain()
    meshopt(of_positions, "meshopt_positions_v0", 24, 12, "ATTRIBUTES", extension="KHR_meshopt_compression")(gltf)
    return gltf


# Images
SRGB = struct.pack(">I", 45455)
GRAY = (150, 150, 150)


def gray16(value):
    return bytes([value, value])


PALETTE = (b"PLTE", bytes(PAINT) * 2)
PNGS = {"8 bits": flat_png(), "16 bits": flat_png(b"".join(gray16(c) for c in PAINT), 16),
        "alpha": flat_png(bytes(PAINT) + b"\x33", 8, 6),
        "16 bits with alpha": flat_png(b"".join(gray16(c) for c in PAINT) + b"\x33\x33", 16, 6),
        "palette of 8 bits": flat_png(b"\1", 8, 3, [PALETTE]), "palette of 4 bits": flat_png(b"\x11", 4, 3, [PALETTE]),
        "palette of 2 bits": flat_png(b"\x55", 2, 3, [PALETTE]), "palette of 1 bit": flat_png(b"\xff", 1, 3, [PALETTE]),
        "palette with alpha": flat_png(b"\1", 8, 3, [PALETTE, (b"tRNS", b"\xff\x33")]),
        "a transparent colour": flat_png(chunks=[(b"tRNS", b"".join(struct.pack(">H", c) for c in PAINT))]),
        "gamma of 1.0, which glTF ignores": flat_png(chunks=[(b"gAMA", struct.pack(">I", 100000))]),
        "an sRGB chunk": flat_png(chunks=[(b"sRGB", b"\0")]),
        "1 x 1": png(1, [bytes(PAINT)], 8, 2), "7 x 7": png(7, [bytes(PAINT) * 7] * 7, 8, 2)}


@variants(PNGS, "PNG: {}", wrong=white_box)
def _(image):
    return textured(image)


GRAYS = {"gray": flat_png(b"\x96", 8, 0), "gray of 16 bits": flat_png(b"\x96\x96", 16, 0),
         "gray with alpha": flat_png(b"\x96\x33", 8, 4)}


@variants(GRAYS, "PNG: {}", twin=painted(GRAY), wrong=white_box)
def _(image):
    return textured(image)


@variant("PNG: gray of 4 bits", twin=painted((153, 153, 153)), wrong=white_box)
def _():
    return textured(flat_png(b"\x99", 4, 0))


@variant("PNG: interlaced", wrong=painted(OTHER))
def _():
    return textured(interlaced_png(), LEFT)


@variants({"baseline": "jpeg", "progressive": "jpeg_progressive", "4:2:0": "jpeg_420"}, "JPEG: {}", wrong=white_box,
          tolerance=0.02)
def _(name):
    return textured(blob_bytes(name), mime="image/jpeg")


@variant("JPEG: gray", twin=painted((200, 200, 200)), wrong=plain, tolerance=0.02)
def _():
    return textured(blob_bytes("jpeg_gray"), mime="image/jpeg")


@variant("JPEG: CMYK", wrong=white_box, tolerance=0.05)
def _():
    return textured(blob_bytes("jpeg_cmyk"), mime="image/jpeg")


@variant("PNG with the type of a JPEG", wrong=white_box)
def _():
    return textured(flat_png(), mime="image/jpeg")


def webp(name, fallback=None):
    gltf = textured(fallback or flat_png())
    image = gltf.add("images", {"bufferView": gltf.view(blob_bytes(name)), "mimeType": "image/webp"})
    if fallback is None:
        gltf.json["textures"][0].pop("source")
    gltf.extension("EXT_texture_webp", gltf.json["textures"][0], {"source": image}, required=fallback is None)
    return gltf


@variants({"lossless": "webp_lossless", "lossy": "webp_lossy", "alpha": "webp_alpha"}, "WebP: {}", wrong=white_box,
          tolerance=0.02)
def _(name):
    return webp(name)


@variant("WebP with a PNG beside it", wrong=white_box)
def _():
    return webp("webp_lossless", fallback=flat_png())


def basisu(has_fallback):
    gltf = textured(flat_png())
    ktx = gltf.add("images", {"bufferView": gltf.view(b"\xabKTX 20\xbb\r\n\x1a\n" + bytes(68)),
                              "mimeType": "image/ktx2"})
    if not has_fallback:
        gltf.json["textures"][0].pop("source")
    gltf.extension("KHR_texture_basisu", gltf.json["textures"][0], {"source": ktx}, required=not has_fallback)
    return gltf


@variant("Basis Universal with a PNG beside it", wrong=white_box)
def _():
    return basisu(True)


@variant("Basis Universal alone", refused="ktxdecompress")
def _():
    return basisu(False)


def other_image(extension, image, mime, has_fallback):
    gltf = textured(flat_png())
    source = gltf.add("images", {"bufferView": gltf.view(image), "mimeType": mime})
    if not has_fallback:
        gltf.json["textures"][0].pop("source")
    gltf.extension(extension, gltf.json["textures"][0], {"source": source}, required=not has_fallback)
    return gltf


@variant("AVIF with a PNG beside it", wrong=white_box)
def _():
    return other_image("EXT_texture_avif", blob_bytes("avif"), "image/avif", True)


@variant("AVIF alone", refused="AVIF")
def _():
    return other_image("EXT_texture_avif", blob_bytes("avif"), "image/avif", False)


@variant("AVIF alone, not required", told="texture 0")
def _():
    gltf = other_image("EXT_texture_avif", blob_bytes("avif"), "image/avif", False)
    del gltf.json["extensionsRequired"]
    return gltf


@variant("DDS with a PNG beside it", wrong=white_box)
def _():
    return other_image("MSFT_texture_dds", b"DDS " + bytes(124), "image/vnd-ms.dds", True)


# Texture coordinates
@variant("a texture's origin at the top", wrong=painted(OTHER))
def _():
    return textured(top_png(), (0.1, 0.125, 0.9, 0.375))


@variant("the second set of texture coordinates", wrong=painted(OTHER))
def _():
    gltf = textured(half_png(), RIGHT, texCoord=1)
    set_uvs(gltf, LEFT, "TEXCOORD_1")
    return gltf


@variant("the third set of texture coordinates", refused="texCoord 2")
def _():
    gltf = textured(half_png(), RIGHT, texCoord=2)
    set_uvs(gltf, RIGHT, "TEXCOORD_1")
    set_uvs(gltf, LEFT, "TEXCOORD_2")
    return gltf


def texture_transform(area, image=None, texCoord=0, **values):
    gltf = textured(image or half_png(), area, texCoord=texCoord)
    use = gltf.paint["pbrMetallicRoughness"]["baseColorTexture"]
    gltf.extension("KHR_texture_transform", use, values, required=True)
    return gltf


@variant("KHR_texture_transform: offset", wrong=painted(OTHER))
def _():
    return texture_transform(RIGHT, offset=[-0.5, 0])


@variant("KHR_texture_transform: scale", wrong=painted(OTHER))
def _():
    return texture_transform(RIGHT, scale=[0.4, 1])


@variant("KHR_texture_transform: rotation", wrong=painted(OTHER))
def _():  # u' = u cos r + v sin r: right of the middle becomes left of it
    return texture_transform((0.625, -0.875, 0.875, -0.625), rotation=math.radians(60),
                             image=half_png(OTHER, PAINT), offset=[1.0, 0])


@variant("KHR_texture_transform: its set of coordinates", wrong=painted(OTHER))
def _():
    gltf = texture_transform(RIGHT, texCoord=1)
    use = gltf.paint["pbrMetallicRoughness"]["baseColorTexture"]
    use["texCoord"] = 0
    use["extensions"]["KHR_texture_transform"] = {"texCoord": 1}
    set_uvs(gltf, LEFT, "TEXCOORD_1")
    return gltf


REPEAT, CLAMP, MIRROR = 10497, 33071, 33648


@variants({"repeat": ((2.125, 0.1, 2.375, 0.9), REPEAT), "repeat by default": ((2.125, 0.1, 2.375, 0.9), None),
           "mirror": ((-0.875, 0.1, -0.625, 0.9), None)}, "wrap in u: {}", wrong=painted(OTHER))
def _(use):
    area, mode = use
    gltf = textured(half_png(), area, sampler={"wrapS": mode} if mode else {})
    return gltf


VARIANTS.pop()  # "mirror" of the last list has its own below


@variant("wrap in u: mirror", wrong=painted(OTHER))
def _():  # 1.75 is 0.25 mirrored, and 0.75 repeated; clamped it is the right edge
    return textured(half_png(), (1.625, 0.1, 1.875, 0.9), sampler={"wrapS": MIRROR})


@variant("wrap in u: clamp", wrong=painted(OTHER))
def _():
    return textured(half_png(OTHER, PAINT), (2.125, 0.1, 2.375, 0.9), sampler={"wrapS": CLAMP})


@variant("wrap in v: mirror", wrong=painted(OTHER))
def _():
    return textured(top_png(), (0.1, 1.625, 0.9, 1.875), sampler={"wrapT": MIRROR})


@variant("wrap in v: clamp", wrong=painted(OTHER))
def _():
    return textured(top_png(OTHER, PAINT), (0.1, 2.125, 0.9, 2.375), sampler={"wrapT": CLAMP})


@variant("nearest filter", told="NEAREST")
def _():
    return textured(half_png(), LEFT, sampler={"magFilter": 9728, "minFilter": 9728})


# Materials
def changed(change, make=plain):
    def build():
        gltf = make()
        change(gltf)
        return gltf
    return build


def glowing(radiance):
    def change(gltf):
        gltf.paint["emissiveFactor"] = radiance
    return changed(change)


@variant("emissive strength", twin=glowing([2, 1, 0.5]), wrong=glowing([1, 0.5, 0.25]))
def _():
    gltf = glowing([1, 0.5, 0.25])()
    gltf.extension("KHR_materials_emissive_strength", gltf.paint, {"emissiveStrength": 2})
    return gltf


@variant("emissive texture", twin=glowing(linear(PAINT)), wrong=glowing([1, 1, 1]), tolerance=2e-3)
def _():
    gltf = glowing([1, 1, 1])()
    gltf.paint["emissiveTexture"] = {"index": gltf.texture(flat_png())}
    return gltf


@variant("unlit", twin=lambda: unlit_twin(), wrong=plain)
def _():
    gltf = plain()
    gltf.extension("KHR_materials_unlit", gltf.paint)
    return gltf


def unlit_twin():
    gltf = plain(color=[0, 0, 0])
    gltf.paint["pbrMetallicRoughness"].update(metallicFactor=1)
    gltf.paint["emissiveFactor"] = linear(PAINT)
    return gltf


@variant("metallic-roughness texture", twin=lambda: metal(), wrong=plain, tolerance=2e-3)
def _():
    gltf = plain()
    gltf.paint["pbrMetallicRoughness"].update(metallicFactor=1, roughnessFactor=1)
    texture = gltf.texture(flat_png(bytes([0, 51, 255])))  # roughness 0.2, metallic 1
    gltf.paint["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {"index": texture}
    return gltf


def metal():
    gltf = plain()
    gltf.paint["pbrMetallicRoughness"].update(metallicFactor=1, roughnessFactor=0.2)
    return gltf


@variant("occlusion texture", told="occlusion")
def _():
    gltf = plain()
    gltf.paint["occlusionTexture"] = {"index": gltf.texture(flat_png(bytes([60, 0, 0])))}
    return gltf


@variant("normal map", wrong=no_box)
def _():
    gltf = plain()
    gltf.paint["normalTexture"] = {"index": gltf.texture(flat_png(bytes([128, 128, 255])))}
    return gltf


def alpha(mode, value, cutoff=None, vertex=None, image=None):
    def make():
        gltf = textured(image) if image else plain()
        gltf.paint["alphaMode"] = mode
        if not image:
            gltf.paint["pbrMetallicRoughness"]["baseColorFactor"][3] = value
        if cutoff is not None:
            gltf.paint["alphaCutoff"] = cutoff
        if vertex is not None:
            gltf.box["attributes"]["COLOR_0"] = gltf.accessor([[1, 1, 1, vertex]] * 24)
        return gltf
    return make


variant("MASK: cut away", twin=no_box, wrong=plain)(alpha("MASK", 0.45))
variant("MASK: kept", wrong=no_box)(alpha("MASK", 0.55))
variant("MASK: kept by its own cutoff", wrong=no_box)(alpha("MASK", 0.35, 0.3))
variant("MASK: cut away by its own cutoff", twin=no_box, wrong=plain)(alpha("MASK", 0.6, 0.7))
variant("MASK: alpha of vertices", twin=no_box, wrong=plain)(alpha("MASK", 0.6, vertex=0.6))
variant("MASK: alpha of a texture", twin=no_box, wrong=plain)(
    alpha("MASK", 1, image=flat_png(bytes(PAINT) + b"\x33", 8, 6)))
variant("BLEND: clear", twin=no_box, wrong=plain)(alpha("BLEND", 0))
variant("BLEND: opaque", wrong=no_box)(alpha("BLEND", 1))
variant("OPAQUE: alpha does not count", wrong=no_box)(alpha("OPAQUE", 0.1))


@variant("double-sided", wrong=reversed_box)
def _():
    gltf = reversed_box()
    gltf.paint["doubleSided"] = True
    return gltf


def with_extension(name, value, required=False):
    def make():
        gltf = plain()
        gltf.extension(name, gltf.paint, value, required)
        return gltf
    return make


SHINY = {"KHR_materials_ior": {"ior": 2.4}, "KHR_materials_sheen": {"sheenColorFactor": [0.9, 0.9, 0.9]},
         "KHR_materials_clearcoat": {"clearcoatFactor": 1}, "KHR_materials_iridescence": {"iridescenceFactor": 1},
         "KHR_materials_specular": {"specularFactor": 0.2}, "KHR_materials_anisotropy": {"anisotropyStrength": 0.7},
         "KHR_materials_dispersion": {"dispersion": 0.4}}
for extension_name, extension_value in SHINY.items():
    variant(extension_name, told=extension_name)(with_extension(extension_name, extension_value))
    variant(f"{extension_name}, required", told=extension_name)(with_extension(extension_name, extension_value, True))

GLASS = {"KHR_materials_transmission": {"transmissionFactor": 0.9},
         "KHR_materials_volume": {"thicknessFactor": 0.5, "attenuationColor": [1, 0, 0], "attenuationDistance": 0.1},
         "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.8}}
for extension_name, extension_value in GLASS.items():
    variant(extension_name, told=extension_name)(with_extension(extension_name, extension_value))


@variant("specular-glossiness", told="KHR_materials_pbrSpecularGlossiness")
def _():
    gltf = plain()
    del gltf.paint["pbrMetallicRoughness"]
    gltf.extension("KHR_materials_pbrSpecularGlossiness", gltf.paint, {"diffuseFactor": [*linear(PAINT), 1]})
    return gltf


@variant("variants of materials", told="KHR_materials_variants")
def _():
    gltf = plain()
    gltf.json["extensions"]["KHR_materials_variants"] = {"variants": [{"name": "plain"}, {"name": "white"}]}
    gltf.extension("KHR_materials_variants", gltf.box, {"mappings": [{"material": 0, "variants": [1]}]})
    return gltf


# Nodes and scenes
@variant("a matrix", wrong=lambda: moved_box())
def _():
    return moved_box(matrix(**PLACE))


MIRRORED = [[-p[0], p[1], p[2]] for p in box_mesh()[0]]


@variant("a mirrored node", wrong=reversed_box)
def _():
    gltf, indices = plain(positions=MIRRORED), box_mesh()[3]
    gltf.box["attributes"].pop("NORMAL")
    gltf.box["indices"] = gltf.accessor([i for t in range(0, 36, 3) for i in indices[t:t + 3][::-1]], USHORT)
    gltf.node("box")["scale"] = [-1, 1, 1]
    return gltf


SHEAR = [1, 0, 0, 0, 0.4, 1, 0, 0, 0, 0.2, 1, 0, 0, 0, 0, 1]


@variant("a sheared node", twin=lambda: plain(positions=transformed(SHEAR, box_mesh()[0])), wrong=plain)
def _():
    return moved_box(multiply(matrix(**PLACE), SHEAR))


@variant("a deep hierarchy", wrong=lambda: moved_box())
def _():
    gltf = plain()
    node = gltf.node("box")
    steps, place = 50, node.pop("translation")
    rotation = node.pop("rotation")
    node.pop("mesh")
    for step in range(steps):
        child = gltf.add("nodes", {"name": f"step {step}", "translation": [c / steps for c in place]})
        node["children"] = [child]
        node = gltf.json["nodes"][child]
    node.update(rotation=rotation, mesh=1)
    return gltf


@variant("a scaled parent", wrong=lambda: no_scale())
def _():
    gltf = no_scale()
    gltf.node("parent")["scale"] = [0.5, 0.5, 0.5]
    return gltf


def no_scale():
    """The box of twice its size, below a node that halves it in the variant."""
    gltf = plain(positions=[[2 * c for c in p] for p in box_mesh()[0]])
    node = gltf.node("box")
    parent = gltf.add("nodes", {"name": "parent", "children": [gltf.index("box")]})
    node["translation"] = [2 * c for c in node["translation"]]
    gltf.json["scenes"][0]["nodes"][1] = parent
    return gltf


@variant("a mesh of two nodes", twin=lambda: two_boxes(), wrong=plain)
def _():
    return two_boxes_as_nodes()


SECOND = {"translation": [1.2, 0.4, 0.5], "rotation": turn((0, 1, 0), 20), "scale": [0.5, 1, 0.5]}


def two_boxes_as_nodes():
    gltf = plain()
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "second", "mesh": 1, **SECOND}))
    return gltf


def two_boxes():
    gltf = plain()
    mesh = gltf.add("meshes", {"name": "moved", "primitives": [{
        "attributes": {"POSITION": gltf.accessor(transformed(matrix(**SECOND), box_mesh()[0]))},
        "indices": gltf.accessor(box_mesh()[3], USHORT), "material": 1}]})
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "second", "mesh": mesh}))
    return gltf


def instanced(component=FLOAT, names=("TRANSLATION", "ROTATION", "SCALE"), **more):
    gltf = plain()
    node = gltf.node("box")
    values = {"TRANSLATION": [PLACE["translation"], SECOND["translation"]],
              "ROTATION": [PLACE["rotation"], SECOND["rotation"]], "SCALE": [[1, 1, 1], SECOND["scale"]]}
    for member in ("translation", "rotation"):
        del node[member]
    attributes = {}
    for name in names:
        if component != FLOAT and name == "ROTATION":
            steps = [[round(32767 * c) for c in v] for v in values[name]]
            attributes[name] = gltf.accessor(steps, SHORT, normalized=True)
        else:
            attributes[name] = gltf.accessor(values[name])
    gltf.extension("EXT_mesh_gpu_instancing", node, {"attributes": attributes}, required=True)
    return gltf


@variant("instances", twin=two_boxes, wrong=plain)
def _():
    return instanced()


@variant("instances with rotations of 16 bits", twin=two_boxes, wrong=plain, tolerance=2e-3)
def _():
    return instanced(SHORT)


@variant("instances with an attribute of a program", twin=two_boxes, wrong=plain)
def _():
    gltf = instanced()
    attributes = gltf.node("box")["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
    attributes["_ID"] = gltf.accessor([1, 2])
    return gltf


def extra_box(**members):
    """Another large box above the probes, in a node with these members."""
    gltf = plain()
    node = gltf.add("nodes", {"name": "hidden", "mesh": 1, "translation": [0, 1.8, 0], **members})
    return gltf, node


def visible_extra_box():
    gltf, node = extra_box(scale=[2, 0.3, 4])
    gltf.json["scenes"][0]["nodes"].append(node)
    return gltf


@variant("a hidden node", wrong=visible_extra_box)
def _():
    gltf = visible_extra_box()
    gltf.extension("KHR_node_visibility", gltf.node("hidden"), {"visible": False})
    return gltf


@variant("a visible child of a hidden node", wrong=visible_extra_box)
def _():
    gltf, node = extra_box(scale=[2, 0.3, 4])
    gltf.extension("KHR_node_visibility", gltf.json["nodes"][node], {"visible": True})
    parent = gltf.add("nodes", {"name": "parent", "children": [node]})
    gltf.extension("KHR_node_visibility", gltf.json["nodes"][parent], {"visible": False})
    gltf.json["scenes"][0]["nodes"].append(parent)
    return gltf


@variant("a hidden light", twin=lambda: no_lamp(), wrong=plain)
def _():
    gltf = plain()
    gltf.extension("KHR_node_visibility", gltf.node("lamp"), {"visible": False})
    return gltf


def no_lamp():
    gltf = plain()
    gltf.node("lamp").pop("extensions")
    return gltf


def two_scenes():
    gltf, node = extra_box(scale=[2, 0.3, 4])
    gltf.add("scenes", {"name": "second", "nodes": [0, 1, 2, 3, 4, node]})
    return gltf


@variant("several scenes: the first is the default", wrong=visible_extra_box)
def _():
    return two_scenes()


@variant("several scenes: the second is the default", twin=visible_extra_box, wrong=plain)
def _():
    gltf = two_scenes()
    gltf.json["scene"] = 1
    return gltf


@variant("several scenes without a default", told="other scenes")
def _():
    gltf = two_scenes()
    del gltf.json["scene"]
    return gltf


@variant("one scene without a default")
def _():
    gltf = plain()
    del gltf.json["scene"]
    return gltf


@variant("several scenes: one by its name", twin=visible_extra_box, wrong=plain, options=("--scene-name", "second"))
def _():
    return two_scenes()


@variant("no scenes")
def _():
    gltf = plain()
    del gltf.json["scene"]
    del gltf.json["scenes"]
    return gltf


@variant("nodes outside of the scene", told="nodes outside of the scene")
def _():
    return extra_box(scale=[2, 0.3, 4])[0]


@variant("MSFT_lod", told="MSFT_lod")
def _():
    gltf, node = extra_box(scale=[2, 0.3, 4])
    gltf.extension("MSFT_lod", gltf.node("box"), {"ids": [node]})
    return gltf


# Deformation and animation
def stretch(p):
    return [p[0] * 1.2, p[1] * 2, p[2] * 0.8]


def morphed(weight_of):
    gltf, positions = plain(), box_mesh()[0]
    offsets = [[2 * (b - a) for a, b in zip(p, stretch(p))] for p in positions]
    gltf.box["targets"] = [{"POSITION": gltf.accessor(offsets)}, {"POSITION": gltf.accessor([[5, 0, 0]] * 24)}]
    weight_of(gltf)
    return gltf


def stretched():
    return deformed_box(stretch)


@variant("morph weights of a mesh", twin=stretched, wrong=plain)
def _():
    return morphed(lambda gltf: gltf.json["meshes"][1].update(weights=[0.5, 0]))


@variant("morph weights of a node", twin=stretched, wrong=plain)
def _():
    def weights(gltf):
        gltf.json["meshes"][1].update(weights=[0, 1])
        gltf.node("box")["weights"] = [0.5, 0]
    return morphed(weights)


@variant("quantized morph targets", twin=lambda: deformed_box(lambda p: [p[0], p[1] * 1.5, p[2]]), wrong=plain,
         tolerance=1e-3)
def _():
    gltf, positions = plain(), box_mesh()[0]
    steps = [[0, 127 if p[1] > 0 else -127, 0, 0] for p in positions]
    view = gltf.view(packed(steps, BYTE), byteStride=4)
    target = gltf.accessor([s[:3] for s in steps], BYTE, view=view, normalized=True)
    gltf.box["targets"] = [{"POSITION": target}]
    gltf.json["meshes"][1]["weights"] = [HALF[1] / 2]
    gltf.extension("KHR_mesh_quantization", required=True)
    return gltf


@variant("morphed colours", told="morphed COLOR_0")
def _():
    gltf = morphed(lambda g: g.json["meshes"][1].update(weights=[0, 0]))
    gltf.box["attributes"]["COLOR_0"] = gltf.accessor([[1, 1, 1]] * 24)
    for target in gltf.box["targets"]:
        target["COLOR_0"] = gltf.accessor([[-1, 0, 0]] * 24)
    return gltf


def skinned(weights=(1,), component=FLOAT, place=True):
    """The box moved by a joint; the transform of its own node does not count."""
    gltf, positions = plain(), box_mesh()[0]
    node = gltf.node("box")
    node.update(translation=[5, 5, 5], skin=0)
    joints = [gltf.add("nodes", {"name": f"joint {i}", **(PLACE if i == 0 else {"translation": [9, 9, 9]})})
              for i in range(2)]
    joints[0:1] = [joints[0]]
    gltf.json["nodes"][joints[0]]["translation"] = [PLACE["translation"][0], PLACE["translation"][1] + 1,
                                                    PLACE["translation"][2]]
    gltf.json["scenes"][0]["nodes"] += joints
    gltf.json["skins"] = [{"joints": joints, "inverseBindMatrices":
                           gltf.accessor([matrix((0, -1, 0)), matrix()])}]
    gltf.box["attributes"]["JOINTS_0"] = gltf.accessor([[0, 1, 0, 0]] * len(positions), UBYTE)
    if component == FLOAT:
        gltf.box["attributes"]["WEIGHTS_0"] = gltf.accessor([[1, 0, 0, 0]] * len(positions))
    else:
        largest = 255 if component == UBYTE else 65535
        gltf.box["attributes"]["WEIGHTS_0"] = gltf.accessor([[largest, 0, 0, 0]] * len(positions), component,
                                                            normalized=True)
    return gltf


@variants({"float": FLOAT, "u8": UBYTE, "u16": USHORT}, "a skin with weights of {}", wrong=no_box)
def _(component):
    return skinned(component=component)


@variant("a skin with weights that are not normal", wrong=no_box)
def _():
    gltf = skinned()
    gltf.box["attributes"]["WEIGHTS_0"] = gltf.accessor([[0.5, 0, 0, 0]] * 24)
    return gltf


@variant("a skin with a second set of joints", wrong=no_box)
def _():
    gltf = skinned()
    gltf.box["attributes"]["WEIGHTS_0"] = gltf.accessor([[0, 0, 0, 0]] * 24)
    gltf.box["attributes"]["JOINTS_1"] = gltf.accessor([[0, 0, 0, 0]] * 24, UBYTE)
    gltf.box["attributes"]["WEIGHTS_1"] = gltf.accessor([[1, 0, 0, 0]] * 24)
    return gltf


@variant("a third set of joints", told="JOINTS_2")
def _():
    gltf = skinned()
    gltf.box["attributes"]["JOINTS_2"] = gltf.accessor([[0, 0, 0, 0]] * 24, UBYTE)
    gltf.box["attributes"]["WEIGHTS_2"] = gltf.accessor([[0, 0, 0, 0]] * 24)
    return gltf


@variant("a skin of a mesh without joints", told="skin is left out")
def _():
    gltf = plain()
    gltf.json["skins"] = [{"joints": [0]}]
    gltf.node("box")["skin"] = 0
    return gltf


RAISED = {**PLACE, "translation": [0.3, 1.0, -0.2]}


def raised():
    return moved_box(**RAISED)


def animated(path, values, times=(0, 2), mode="LINEAR", node="box", make=plain):
    gltf = make()
    gltf.json["animations"] = [{"name": "move", "samplers": [
        {"input": gltf.accessor(list(times)), "output": gltf.accessor(values), "interpolation": mode}],
        "channels": [{"sampler": 0, "target": {"node": gltf.index(node), "path": path}}]}]
    return gltf


PATH = [PLACE["translation"], [0.3, 1.6, -0.2]]
AT_ONE = ("--time", "1")


@variant("an animation without a time", told="animation")
def _():
    return animated("translation", PATH)


@variant("an animation: LINEAR", twin=raised, wrong=plain, options=AT_ONE)
def _():
    return animated("translation", PATH)


@variant("an animation: STEP", wrong=raised, options=AT_ONE)
def _():
    return animated("translation", PATH, mode="STEP")


@variant("an animation: CUBICSPLINE", twin=raised, wrong=plain, options=AT_ONE)
def _():  # without tangents, the middle of both values
    still = [0, 0, 0]
    return animated("translation", [still, PATH[0], still, still, PATH[1], still], mode="CUBICSPLINE")


@variant("an animation: rotation", twin=lambda: moved_box(translation=PLACE["translation"],
                                                           rotation=turn((0, 1, 0), 45)),
         wrong=plain, options=AT_ONE)
def _():
    return animated("rotation", [turn((0, 1, 0), 0), turn((0, 1, 0), 90)])


@variant("an animation: scale", twin=lambda: moved_box(scale=[1, 1.5, 1], **PLACE), wrong=plain, options=AT_ONE)
def _():
    return animated("scale", [[1, 1, 1], [1, 2, 1]])


@variant("an animation: weights", twin=stretched, wrong=plain, options=AT_ONE)
def _():
    return animated("weights", [0, 0, 1, 0], make=lambda: morphed(lambda gltf: None))


@variant("an animation of a light", twin=lambda: moved_lamp(), wrong=plain, options=AT_ONE)
def _():
    return animated("translation", [[1.5, 1.5, 1.5], [1.5, 1.5, -1.5]], node="lamp")


def moved_lamp():
    gltf = plain()
    gltf.node("lamp")["translation"] = [1.5, 1.5, 0]
    return gltf


@variant("KHR_animation_pointer", told="KHR_animation_pointer", options=AT_ONE)
def _():
    gltf = animated("translation", [[1, 1, 1, 1], [0, 0, 1, 1]])
    channel = gltf.json["animations"][0]["channels"][0]
    channel["target"] = {"path": "pointer"}
    gltf.extension("KHR_animation_pointer", channel["target"],
                   {"pointer": "/materials/1/pbrMetallicRoughness/baseColorFactor"})
    return gltf


# Lights and cameras
def lit(**light):
    gltf = plain()
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"][1].update(light)
    return gltf


@variant("a light's defaults", twin=lambda: lit(intensity=1, color=[1, 1, 1]), wrong=plain)
def _():
    gltf = plain()
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"][1] = {"type": "point"}
    return gltf


@variant("a light in a scaled node", wrong=lambda: lit(intensity=16))
def _():
    gltf = plain()
    gltf.node("lamp")["scale"] = [2, 2, 2]
    return gltf


@variant("a spot light with a wide cone", twin=lambda: spot_twin(), wrong=no_lamp, tolerance=1e-3)
def _():
    gltf = lit(type="spot", spot={"innerConeAngle": math.pi / 2 - 0.001, "outerConeAngle": math.pi / 2})
    gltf.node("lamp")["rotation"] = turn((1, 0, 0), -90)  # down
    return gltf


def spot_twin():
    return plain()


@variant("a spot light that looks away", twin=no_lamp, wrong=plain)
def _():
    gltf = lit(type="spot", spot={"outerConeAngle": 0.3})
    gltf.node("lamp")["rotation"] = turn((1, 0, 0), 90)  # up
    return gltf


@variant("a light of an unknown type", told="type")
def _():
    return lit(type="area")


@variant("a profile of a light", told="EXT_lights_ies")
def _():
    gltf = plain()
    gltf.json["extensions"]["EXT_lights_ies"] = {"lights": [{"uri": "lamp.ies"}]}
    gltf.extension("EXT_lights_ies", gltf.node("lamp"), {"light": 0})
    return gltf


@variant("an image-based light", told="EXT_lights_image_based")
def _():
    gltf = plain()
    image = gltf.add("images", {"bufferView": gltf.view(flat_png()), "mimeType": "image/png"})
    gltf.json["extensions"]["EXT_lights_image_based"] = {"lights": [{
        "irradianceCoefficients": [[0.5, 0.5, 0.5]] + [[0, 0, 0]] * 8, "specularImageSize": 8,
        "specularImages": [[image] * 6]}]}
    gltf.extension("EXT_lights_image_based", gltf.json["scenes"][0], {"light": 0})
    return gltf


@variant("an area light of EXT_lights_area", told="EXT_lights_area")
def _():
    gltf = plain()
    gltf.json["extensions"]["EXT_lights_area"] = {"lights": [{"type": "rect", "intensity": 5, "size": 1}]}
    gltf.extension("EXT_lights_area", gltf.node("lamp"), {"light": 0})
    return gltf


@variant("a perspective camera")
def _():
    gltf = plain()
    gltf.add("cameras", {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}})
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "camera", "camera": 0}))
    return gltf


@variant("an orthographic camera", told="camera")
def _():
    gltf = plain()
    gltf.add("cameras", {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 0.1, "zfar": 10}})
    gltf.json["scenes"][0]["nodes"].append(gltf.add("nodes", {"name": "camera", "camera": 0}))
    return gltf


# Extensions and extras
def unknown(required):
    gltf = plain()
    gltf.extension("EXT_of_the_future", gltf.paint, {"glow": 5}, required)
    return gltf


@variant("an unknown extension", told="EXT_of_the_future")
def _():
    return unknown(False)


@variant("an unknown extension, required", refused="EXT_of_the_future")
def _():
    return unknown(True)


@variant("KHR_xmp_json_ld", told="KHR_xmp_json_ld")
def _():
    gltf = plain()
    gltf.json["extensions"]["KHR_xmp_json_ld"] = {"packets": [{"dc:title": "box"}]}
    gltf.extension("KHR_xmp_json_ld", gltf.json["asset"], {"packet": 0})
    return gltf


@variants({"contributes_gi": ("box", "contributes_gi"), "contributeGI": ("box", "contributeGI"),
           "fall-off": ("lamp", "fall-off")}, "misspelt extras: {}", told="did you mean")
def _(extras):
    node, name = extras
    gltf = plain()
    gltf.node(node)["extras"] = {name: False}
    return gltf


@variant("extras in a wrong place", told="move it")
def _():
    gltf = plain()
    gltf.paint["extras"] = {"contribute_gi": False}
    return gltf


@variant("extras of another program", told="other extras")
def _():
    gltf = plain()
    gltf.node("box")["extras"] = {"blender_id": 7}
    return gltf


@variant("a member that glTF does not have", told="baseColourFactor")
def _():
    gltf = plain()
    gltf.paint["pbrMetallicRoughness"]["baseColourFactor"] = [0, 0, 1, 1]
    return gltf


@variant("a member in the wrong object", told="emissiveFactor")
def _():
    gltf = plain()
    gltf.paint["pbrMetallicRoughness"]["emissiveFactor"] = [1, 1, 1]
    return gltf


@variant("an extension beside `extensions`", told="KHR_materials_emissive_strength")
def _():
    gltf = glowing([1, 1, 1])()
    gltf.paint["KHR_materials_emissive_strength"] = {"emissiveStrength": 9}
    gltf.extension("KHR_materials_emissive_strength")
    return gltf


@variant("a later minor version", wrong=no_box)
def _():
    gltf = plain()
    gltf.json["asset"]["version"] = "2.1"
    return gltf


@variant("a minimum version that is too new", refused="2.1")
def _():
    gltf = plain()
    gltf.json["asset"].update(version="2.1", minVersion="2.1")
    return gltf


@variant("glTF 1.0", refused="1.0")
def _():
    gltf = plain()
    gltf.json["asset"]["version"] = "1.0"
    return gltf


def in_centimetres():
    gltf = plain()
    parent = gltf.add("nodes", {"name": "centimetres", "scale": [100, 100, 100],
                                "children": gltf.json["scenes"][0]["nodes"]})
    gltf.json["scenes"][0]["nodes"] = [parent]
    return gltf


@variant("centimetres", told="units of length")
def _():
    gltf = in_centimetres()
    second = gltf.add("nodes", {"name": "second", "mesh": 1, "translation": [2, 0.4, 0]})
    gltf.node("centimetres")["children"] = [*gltf.node("centimetres")["children"], second]
    return gltf


@variant("lights in lumens of watts", told="--light-unit watt")
def _():
    gltf = glowing([1, 1, 1])()
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 3 * 683
    return gltf


@variant("lights in watts", options=("--light-unit", "watt"), wrong=lambda: lit(intensity=4 * 683))
def _():
    gltf = plain()
    for light in gltf.json["extensions"]["KHR_lights_punctual"]["lights"]:
        light["intensity"] *= 683
    return gltf


# Containers
def text(document):
    return json.dumps(document).encode()


def data_uri(data, mime="application/octet-stream"):
    return f"data:{mime};base64," + base64.b64encode(data).decode()


def external(uri, file=None, make=plain):
    gltf = make()
    gltf.json["buffers"] = [{"byteLength": len(gltf.binary), "uri": uri}]
    return {"scene.gltf": text(gltf.json), **({file: bytes(gltf.binary)} if file else {})}


@variant(".gltf with an external buffer")
def _():
    return external("scene.bin", "scene.bin")


@variant("a buffer in a folder")
def _():
    return external("data/scene.bin", "data/scene.bin")


@variant("a percent-encoded URI")
def _():
    return external("my%20b%C3%BCffer%23.bin", "my büffer#.bin")


@variant("a URI with Unicode")
def _():
    return external("my büffer.bin", "my büffer.bin")


@variant("a missing buffer", refused="gone.bin")
def _():
    return external("gone.bin")


@variants({"octet-stream": "application/octet-stream", "gltf-buffer": "application/gltf-buffer"},
          "a data URI: {}")
def _(mime):
    gltf = plain()
    return external(data_uri(bytes(gltf.binary), mime))


@variant("a buffer longer than said")
def _():
    files = external("scene.bin", "scene.bin")
    return {**files, "scene.bin": files["scene.bin"] + b"more"}


@variant("a buffer shorter than said", refused="scene.bin")
def _():
    files = external("scene.bin", "scene.bin")
    return {**files, "scene.bin": files["scene.bin"][:-40]}


@variant("an image in a file", wrong=white_box)
def _():
    gltf = textured(flat_png())
    gltf.json["images"] = [{"uri": "paint%20and%20more.png"}]
    return {"scene.glb": gltf.glb(), "paint and more.png": flat_png()}


@variant("an image in a data URI", wrong=white_box)
def _():
    gltf = textured(flat_png())
    gltf.json["images"] = [{"uri": data_uri(flat_png(), "image/png")}]
    return gltf


@variant("a missing image", refused="gone.png")
def _():
    gltf = textured(flat_png())
    gltf.json["images"] = [{"uri": "gone.png"}]
    return gltf


@variant("a .glb with a second buffer")
def _():
    gltf = plain()
    positions = packed(box_mesh()[0])
    gltf.json["buffers"] = [{"byteLength": len(gltf.binary)}, {"byteLength": len(positions), "uri": "more.bin"}]
    view = gltf.add("bufferViews", {"buffer": 1, "byteLength": len(positions)})
    gltf.json["accessors"][gltf.box["attributes"]["POSITION"]]["bufferView"] = view
    return {"scene.glb": gltf.glb(), "more.bin": positions}


@variant("a .glb with a chunk of another kind")
def _():
    gltf = plain()
    document = text(gltf.document())
    return {"scene.glb": glb((b"JSON", document + b" " * (-len(document) % 4)),
                             (b"BIN\0", bytes(gltf.binary) + bytes(-len(gltf.binary) % 4)), (b"MORE", bytes(8)))}


@variant("JSON with a byte-order mark")
def _():
    files = external("scene.bin", "scene.bin")
    return {**files, "scene.gltf": b"\xef\xbb\xbf" + files["scene.gltf"]}


@variant("names in Unicode")
def _():
    gltf = plain()
    gltf.node("box")["name"] = "коробка 箱 📦"
    gltf.paint["name"] = "краска \"12\" \n"
    return {"сцена 箱.glb": gltf.glb()}


# --- Reading them ---------------------------------------------------------------------------------------------------
SAMPLES = ("--samples", "64")


class Reader:
    """Reads scenes by the program, each once."""

    def __init__(self, command, folder):
        self.command, self.folder, self.known = command, Path(folder), {}

    def write(self, scene):
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        for name, data in files_of(scene).items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        return folder / next(iter(files_of(scene)))

    def run(self, *arguments, input=None):
        return subprocess.run([self.command, *map(str, arguments)], capture_output=True, text=True, input=input)

    def light(self, scene, options=()):
        """The coefficients of the light at the probes, or none; and what the bake said."""
        path = self.write(scene)
        volume = path.parent / "light.probes"
        done = self.run("bake", path, "-o", volume, *SAMPLES, "--threads", 1, "--invalid-probes", "keep", *options)
        if done.returncode != 0:
            return path, None, done
        places = "".join("{} {} {}\n".format(*place) for place in PROBES)
        answers = self.run("query", volume, "--json", input=places).stdout.splitlines()
        return path, [c for line in answers for rgb in json.loads(line)["irradiance_sh"] for c in rgb], done

    def plain_light(self, make):
        if make not in self.known:
            path, light, done = self.light(make())
            assert light is not None, done.stderr
            self.known[make] = light
        return self.known[make]

    def parts(self, path, options=()):
        done = self.run("explain", path, "--json", *options)
        return json.loads(done.stdout)["parts"] if done.returncode == 0 else []


def difference(a, b):
    return max(abs(x - y) for x, y in zip(a, b)) / max(map(abs, b))


@dataclass
class Outcome:
    kind: str  # right, told, refused, failed or SILENT
    detail: str
    difference: float = 0.0


def told_parts(parts):
    return [" ".join([p["use"], p["name"], *p["elements"], p["note"], p["remedy"]]) for p in parts
            if p["use"] != "read"]


def outcome(reader, it):
    path, light, done = reader.light(it.make(), it.options)
    said = done.stderr.replace(str(path), "SCENE").strip()
    if light is None:
        if done.returncode not in (1, 2, 3, 4, 5, 6, 7, 8, 9):
            return Outcome("failed", f"exit code {done.returncode}: {said}")
        is_clear = it.expected == "refused" and it.says in said
        return Outcome("refused" if is_clear else "failed", said)
    apart = difference(light, reader.plain_light(it.twin))
    tells = told_parts(reader.parts(path, it.options)) + said.splitlines()
    named = [line for line in tells if it.expected == "told" and it.says in line]
    if named:
        return Outcome("told", named[0], apart)
    if it.expected != "told" and apart <= it.tolerance:
        return Outcome("right", said, apart)
    if apart > it.tolerance and it.expected == "right" and tells:
        return Outcome("told?", tells[0], apart)
    return Outcome("SILENT", said, apart)


def proves(reader, it):
    """True if a reader that misses the feature would see other light."""
    if it.wrong is None:
        return True
    return difference(reader.plain_light(it.wrong), reader.plain_light(it.twin)) > 5 * it.tolerance


def print_table(command):
    counts = {}
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        reader = Reader(command, folder)
        for it, found in zip(VARIANTS, pool.map(lambda it: outcome(reader, it), VARIANTS)):
            counts[found.kind] = counts.get(found.kind, 0) + 1
            mark = "" if found.kind == it.expected else f"   (expected {it.expected} {it.says})"
            print(f"{found.kind:8} {found.difference:9.2e}  {it.name}{mark}")
            if found.detail and found.kind != "right":
                print(" " * 20 + found.detail.splitlines()[0][:200])
            if not proves(reader, it):
                print(" " * 20 + "its wrong reading has the same light")
    print(len(VARIANTS), counts)


def main(arguments):
    if arguments == ["--table"]:
        return print_table(os.environ["TETRALIGHT_COMMAND"])
    if arguments == ["--box"]:
        positions, normals, uvs, indices = box_mesh()
        flat = {name: [c for v in values for c in v]
                for name, values in (("positions", positions), ("normals", normals), ("uvs", uvs))}
        rotations = [c for i in range(4) for c in turn((0, 1, 0), 30 * i)]
        return print(json.dumps({**flat, "indices": indices, "rotations": rotations, "color": PAINT}))
    for i, it in enumerate(VARIANTS):
        for name, data in files_of(it.make()).items():
            path = Path(arguments[0]) / f"{i:03} {it.name.replace('/', ' ')}" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)


if __name__ == "__main__":
    main(sys.argv[1:])
