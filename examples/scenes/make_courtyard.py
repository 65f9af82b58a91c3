#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the sample scene of Tetralight: a sunny court around a house with a dark interior and one open side.

    python3 make_courtyard.py [OUT.glb]        (default: courtyard.glb beside this script)

The result is one glTF 2.0 binary, the same bytes on every run. Right-handed, Y up, metres; +Z is the open side of
the house. What a reader finds besides plain glTF, all of it in `extras`:

    scenes[0].extras.sky.radiance      constant sky radiance, linear RGB
    node.extras.contribute_gi = false  the object moves: probes light it, and the bake does not see it
    node.extras.light_probe_group      the vertices of the node's POINTS mesh, or else its child nodes, are probes
"""
import argparse
import json
import math
import os
import struct
import zlib
from pathlib import Path

# --- The house: outer size, and where its inner faces are -----------------------------------------------------------
HALF_X, HALF_Z, WALL_TOP, WALL, ROOF_TOP = 4.0, 3.0, 3.5, 0.25, 3.75
INNER_X, INNER_Z, FLOOR_TOP = HALF_X - WALL, HALF_Z - WALL, 0.1
OPEN_X, OPEN_TOP = 3.25, 3.0  # the open side: |x| < OPEN_X, up to OPEN_TOP

PERGOLA_Y = 2.6  # the pergola's panels lie at this height
PERGOLA_X = (-9.0, -5.5)
PERGOLA_Z = {"panel_tinted": (0.5, 3.7), "panel_lattice": (4.1, 7.3)}

# The sun stands in front and to the left: it reaches less than 1 m into the house, and the shadow of the house
# falls to the right, where the camera sees it.
SUN_DIRECTION = (0.55, -1.0, -0.3)
SKY_RADIANCE = [0.35, 0.5, 0.8]

PROBE_FROM_WALL = 0.3  # probes keep this distance from the walls, inside and outside
PROBE_CLEARANCE = 0.15  # no probe is nearer than this to something solid
PROBE_SPACING = 0.5  # a court probe nearer than this to another group's probe is dropped

MATERIALS = {  # name: (linear base colour with alpha, what else the material has)
    "ground_green": ((0.13, 0.30, 0.08, 1), {}),
    "plaster_grey": ((0.72, 0.71, 0.69, 1), {}),
    "paint_warm_red": ((0.70, 0.10, 0.05, 1), {}),
    "stone_pale": ((0.52, 0.49, 0.44, 1), {}),
    "sandstone": ((0.66, 0.56, 0.42, 1), {}),
    "wood_dark": ((0.20, 0.11, 0.06, 1), {}),
    "red": ((0.75, 0.07, 0.06, 1), {}),
    "yellow": ((0.80, 0.58, 0.07, 1), {}),
    "blue": ((0.08, 0.20, 0.68, 1), {}),
    "teal": ((0.05, 0.48, 0.45, 1), {}),
    "orange": ((0.80, 0.28, 0.05, 1), {}),
    "violet": ((0.34, 0.12, 0.60, 1), {}),
    "white": ((0.80, 0.80, 0.80, 1), {}),
    "mover_white": ((0.85, 0.85, 0.85, 1), {}),
    "emissive_warm": ((0.80, 0.40, 0.15, 1), {"emission": (1.0, 0.38, 0.06), "strength": 14.0}),
    "emissive_cool": ((0.15, 0.40, 0.80, 1), {"emission": (0.08, 0.36, 1.0), "strength": 16.0}),
    "panel_tinted": ((0.85, 0.18, 0.42, 0.5), {"alphaMode": "BLEND", "doubleSided": True}),
    "panel_lattice": ((1, 1, 1, 1), {"alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": True, "texture": 0}),
}

COURT_BOXES = [  # name (and material), size, centre x and z, turn about Y in degrees; all stand on the ground
    ("yellow", (1.4, 1.0, 1.4), (6.4, 9.4), 20),
    ("blue", (2.2, 0.7, 1.2), (1.6, 9.6), -12),
    ("red", (1.1, 1.1, 1.1), (-3.4, 9.0), 35),
    ("teal", (1.2, 1.7, 1.2), (8.6, 1.6), -25),
    ("orange", (1.8, 1.4, 1.4), (-6.8, -5.6), 10),
    ("violet", (1.4, 2.2, 1.4), (1.6, -6.4), 0),
    ("white", (1.2, 2.8, 1.2), (-11.2, 1.2), 15),
]
COLUMNS = [(6.4, -2.6), (10.2, -2.6), (-12.3, -2.2)]  # centre x and z

SPHERES = [  # name, radius, x and z of the centre, height of what it rests on
    ("sun_front", 0.50, (2.0, 6.2), 0.0),
    ("sun_big", 0.60, (-1.0, 10.6), 0.0),
    ("sun_on_yellow", 0.45, (6.4, 9.4), 1.0),
    ("sun_on_dais", 0.55, (8.3, -5.6), 1.0),
    ("shade_cool", 0.45, (5.1, 0.95), 0.0),
    ("shade_north", 0.50, (0.0, -3.75), 0.0),
    ("shade_tinted", 0.50, (-6.3, 1.9), 0.0),
    ("shade_lattice", 0.50, (-6.6, 5.7), 0.0),
    ("inside_warm", 0.45, (0.75, -1.85), FLOOR_TOP),
    ("inside_on_plinth", 0.40, (-2.95, 0.1), 1.4),
    ("inside_middle", 0.50, (0.3, 0.7), FLOOR_TOP),
    ("inside_near_sun", 0.40, (1.9, 1.6), FLOOR_TOP),
]


# --- Small vector and quaternion helpers ----------------------------------------------------------------------------
def normalized(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def rounded(v):
    """Rounds away the last bits, in which math libraries differ; + 0.0 turns -0.0 into 0.0."""
    return [round(c, 7) + 0.0 for c in v]


def yaw_rotation(degrees):
    half = math.radians(degrees) / 2
    return rounded([0.0, math.sin(half), 0.0, math.cos(half)])


def look_rotation(direction):
    """The quaternion which turns -Z (where glTF's cameras and lights look) to `direction` and keeps X level."""
    z = normalized([-c for c in direction])
    yaw, pitch = math.atan2(z[0], z[2]) / 2, -math.asin(z[1]) / 2
    return rounded([math.cos(yaw) * math.sin(pitch), math.sin(yaw) * math.cos(pitch),
                    -math.sin(yaw) * math.sin(pitch), math.cos(yaw) * math.cos(pitch)])


def turned(position, degrees):
    """Turns a position about Y, as yaw_rotation does."""
    s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    x, y, z = position
    return (c * x + s * z, y, c * z - s * x)


# --- Geometry: every function returns (positions, normals, triangles) -------------------------------------------------
FACES = {"+x": (1, 0, 0), "-x": (-1, 0, 0), "+y": (0, 1, 0), "-y": (0, -1, 0), "+z": (0, 0, 1), "-z": (0, 0, -1)}


def box_faces(size, faces=tuple(FACES)):
    """The named faces of a box about the origin, with outward normals, counter-clockwise from outside."""
    positions, normals, triangles = [], [], []
    for normal in (FACES[face] for face in faces):
        u = (0, 0, 1) if normal[1] else (0, 1, 0)
        v = cross(normal, u)
        first = len(positions)
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            positions.append([(normal[i] + a * u[i] + b * v[i]) * size[i] / 2 for i in range(3)])
            normals.append(normal)
        triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return positions, normals, triangles


def horizontal_quad(size_x, size_z):
    positions = [(x * size_x / 2, 0, z * size_z / 2) for x, z in ((-1, 1), (1, 1), (1, -1), (-1, -1))]
    return positions, [(0, 1, 0)] * 4, [(0, 1, 2), (0, 2, 3)]


def sphere(radius, segments=48, rings=24):
    normals, triangles = [], []
    for ring in range(rings + 1):
        polar = math.pi * ring / rings
        for segment in range(segments + 1):
            around = 2 * math.pi * segment / segments
            normals.append(rounded([math.sin(polar) * math.sin(around), math.cos(polar),
                                    math.sin(polar) * math.cos(around)]))
    for ring in range(rings):
        for a in range(ring * (segments + 1), ring * (segments + 1) + segments):
            below = a + segments + 1
            if ring > 0:
                triangles.append((a, below, a + 1))
            if ring < rings - 1:
                triangles.append((a + 1, below, below + 1))
    return [[radius * c for c in n] for n in normals], normals, triangles


def cylinder(radius, height, segments=32):
    """A closed cylinder about the origin: smooth side, flat caps."""
    positions, normals, triangles = [], [], []
    rim = [rounded([math.sin(2 * math.pi * i / segments), 0, math.cos(2 * math.pi * i / segments)])
           for i in range(segments)]
    for y in (-height / 2, height / 2):
        positions += [(radius * x, y, radius * z) for x, _, z in rim]
        normals += rim
    for i in range(segments):
        j = (i + 1) % segments
        triangles += [(i, j, segments + j), (i, segments + j, segments + i)]
    for up in (-1, 1):
        first = len(positions)
        positions += [(radius * x, up * height / 2, radius * z) for x, _, z in rim]
        normals += [(0, up, 0)] * segments
        triangles += [(first, first + i, first + i + 1)[::up] for i in range(1, segments - 1)]
    return positions, normals, triangles


def rgba_png(size, pixel):
    """An RGBA image of size x size pixels, whose bytes are pixel(x, y); y = 0 is the top row."""
    rows = bytearray()
    for y in range(size):
        rows.append(0)  # PNG: this row is not filtered
        for x in range(size):
            rows += bytes(pixel(x, y))
    # One stored block by hand, since the bytes that compressors write differ from one zlib to the next.
    pixels = b"\x78\x01\x01" + struct.pack("<HH", len(rows), len(rows) ^ 0xFFFF) + rows
    pixels += struct.pack(">I", zlib.adler32(rows))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", size, size, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


def lattice_png(size=64, holes=2):
    """An image of a wooden lattice: alpha 0 in `holes` x `holes` square holes. Tiles in both directions."""
    period, bar = size // holes, size // holes * 5 // 32

    def pixel(x, y):
        hole = bar <= x % period < period - bar and bar <= y % period < period - bar
        grain = (x * 7 + y * 3) % 11 + (x * y) % 7
        return 176 - grain, 128 - grain, 84 - grain, 0 if hole else 255

    return rgba_png(size, pixel)


# --- The glTF document ------------------------------------------------------------------------------------------------
class Gltf:
    """Collects glTF's arrays and the binary chunk, and what the probes must keep away from."""

    materials = MATERIALS  # by name, in the order of the file

    def __init__(self):
        self.binary = bytearray()
        self.accessors, self.views, self.meshes, self.nodes, self.cameras = [], [], [], [], []
        self.roots = []
        self.mesh_of = {}  # key: mesh index, so that equal boxes share one mesh
        self.solids = []  # (name, low corner, high corner) of everything static, in world space
        self.probes = {}  # group name: world positions
        self.lattice_view = self.view(lattice_png())
        self.bakes_emission = True

    def view(self, data, target=None):
        self.binary += bytes(-len(self.binary) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        if target:
            self.views[-1]["target"] = target
        self.binary += data
        return len(self.views) - 1

    def float_accessor(self, vectors, bounds=False):
        width = len(vectors[0])
        flat = [c + 0.0 for vector in vectors for c in vector]
        data = struct.pack(f"<{len(flat)}f", *flat)
        accessor = {"bufferView": self.view(data, 34962), "componentType": 5126, "count": len(vectors),
                    "type": f"VEC{width}"}
        if bounds:
            stored = struct.unpack(f"<{len(flat)}f", data)
            accessor["min"] = [min(stored[i::width]) for i in range(width)]
            accessor["max"] = [max(stored[i::width]) for i in range(width)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def index_accessor(self, triangles):
        flat = [index for triangle in triangles for index in triangle]
        self.accessors.append({"bufferView": self.view(struct.pack(f"<{len(flat)}H", *flat), 34963),
                               "componentType": 5123, "count": len(flat), "type": "SCALAR"})
        return len(self.accessors) - 1

    def primitive(self, geometry, material, uvs=None):
        positions, normals, triangles = geometry
        attributes = {"POSITION": self.float_accessor(positions, bounds=True), "NORMAL": self.float_accessor(normals)}
        if uvs:
            attributes["TEXCOORD_0"] = self.float_accessor(uvs)
        return {"attributes": attributes, "indices": self.index_accessor(triangles),
                "material": list(self.materials).index(material)}

    def mesh(self, name, primitives):
        self.meshes.append({"name": name, "primitives": primitives})
        return len(self.meshes) - 1

    def node(self, name, parent=None, translation=None, **fields):
        assert all(node["name"] != name for node in self.nodes), f"two nodes are named {name}"
        node = {"name": name}
        if translation and any(translation):
            node["translation"] = rounded(translation)
        node.update({key: value for key, value in fields.items() if value is not None})
        self.nodes.append(node)
        index = len(self.nodes) - 1
        if parent is None:
            self.roots.append(index)
        else:
            self.nodes[parent].setdefault("children", []).append(index)
        return index

    def box(self, name, size, center, material, parent=None, turn=0, moves=False, paint=None,
            light_probes=None):
        """A closed box. `paint` = (face, material) paints one face differently."""
        key = (tuple(size), material, paint)
        if key not in self.mesh_of:
            plain = [face for face in FACES if not paint or face != paint[0]]
            primitives = [self.primitive(box_faces(size, plain), material)]
            if paint:
                primitives.append(self.primitive(box_faces(size, [paint[0]]), paint[1]))
            self.mesh_of[key] = self.mesh(name, primitives)
        self.node(name, parent, center, rotation=yaw_rotation(turn) if turn else None, mesh=self.mesh_of[key],
                  extras=self.mover_extras(light_probes) if moves else None)
        if not moves:
            self.add_solid(name, size, center, turn)

    @staticmethod
    def mover_extras(light_probes):
        extras = {"contribute_gi": False}
        if light_probes:
            extras["light_probes"] = light_probes
        return extras

    def add_solid(self, name, size, center, turn=0):
        s, c = abs(math.sin(math.radians(turn))), abs(math.cos(math.radians(turn)))
        half = ((c * size[0] + s * size[2]) / 2, size[1] / 2, (s * size[0] + c * size[2]) / 2)
        self.solids.append((name, [m - h for m, h in zip(center, half)], [m + h for m, h in zip(center, half)]))

    def is_free(self, position, clearance=PROBE_CLEARANCE):
        return not any(all(low[i] - clearance < position[i] < high[i] + clearance for i in range(3))
                       for _, low, high in self.solids)

    def json(self):
        return {
            "asset": {"version": "2.0", "generator": "Tetralight make_courtyard.py"},
            "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_emissive_strength"],
            "extensions": {"KHR_lights_punctual": {"lights": [
                {"name": "sun", "type": "directional", "color": [1.0, 0.95, 0.86], "intensity": 3.0}]}},
            "scene": 0,
            "scenes": [{"name": "courtyard", "nodes": self.roots, "extras": {"sky": {"radiance": SKY_RADIANCE}}}],
            "nodes": self.nodes,
            "cameras": self.cameras,
            "meshes": self.meshes,
            "materials": [material_json(name, *value, self.bakes_emission) for name, value in MATERIALS.items()],
            "textures": [{"name": "lattice", "sampler": 0, "source": 0}],
            "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}],
            "images": [{"name": "lattice", "mimeType": "image/png", "bufferView": self.lattice_view}],
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": len(self.binary)}],
        }

    def glb(self):
        document = json.dumps(self.json(), separators=(",", ":")).encode()
        document += b" " * (-len(document) % 4)
        binary = bytes(self.binary) + bytes(-len(self.binary) % 4)
        total = 12 + 8 + len(document) + 8 + len(binary)
        return (struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(document), b"JSON") + document
                + struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def material_json(name, color, other, bakes_emission):
    material = {"name": name, "pbrMetallicRoughness":
                {"baseColorFactor": list(color), "metallicFactor": 0.0, "roughnessFactor": 0.95}}
    if "texture" in other:
        material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": other["texture"]}
    if "emission" in other:
        material["emissiveFactor"] = list(other["emission"])
        material["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": other["strength"]}}
        if not bakes_emission:
            material["extras"] = {"bake_emission": False}
    material.update({key: other[key] for key in ("alphaMode", "alphaCutoff", "doubleSided") if key in other})
    return material


# --- The parts of the scene -------------------------------------------------------------------------------------------
def add_ground(gltf):
    gltf.node("ground", mesh=gltf.mesh("ground", [gltf.primitive(horizontal_quad(40, 40), "ground_green")]))


def add_house(gltf):
    house = gltf.node("house")

    def part(name, low, high, material="plaster_grey", paint=None):
        gltf.box(name, [round(h - l, 6) for l, h in zip(low, high)], [(l + h) / 2 for l, h in zip(low, high)],
                 material, house, paint=paint)

    part("wall_west", (-HALF_X, 0, -HALF_Z), (-INNER_X, WALL_TOP, HALF_Z), paint=("+x", "paint_warm_red"))
    part("wall_east", (INNER_X, 0, -HALF_Z), (HALF_X, WALL_TOP, HALF_Z))
    part("wall_north", (-INNER_X, 0, -HALF_Z), (INNER_X, WALL_TOP, -INNER_Z))
    part("wall_south_left", (-INNER_X, 0, INNER_Z), (-OPEN_X, WALL_TOP, HALF_Z))
    part("wall_south_right", (OPEN_X, 0, INNER_Z), (INNER_X, WALL_TOP, HALF_Z))
    part("lintel", (-OPEN_X, OPEN_TOP, INNER_Z), (OPEN_X, WALL_TOP, HALF_Z))
    part("roof", (-HALF_X - 0.1, WALL_TOP, -HALF_Z - 0.1), (HALF_X + 0.1, ROOF_TOP, HALF_Z + 0.1))
    part("floor", (-INNER_X, 0, -INNER_Z), (INNER_X, FLOOR_TOP, INNER_Z), "stone_pale")
    part("plinth", (-3.15, FLOOR_TOP, -0.1), (-2.75, 1.4, 0.3), "stone_pale")
    part("doorstep", (-OPEN_X, 0, INNER_Z), (OPEN_X, FLOOR_TOP, HALF_Z + 1), "stone_pale")


def add_court(gltf):
    court = gltf.node("court_objects")
    for color, size, (x, z), turn in COURT_BOXES:
        gltf.box(f"box_{color}", size, (x, size[1] / 2, z), color, court, turn)
    column = gltf.mesh("column", [gltf.primitive(cylinder(0.3, 3.6), "sandstone")])
    for number, (x, z) in enumerate(COLUMNS):
        gltf.node(f"column_{number}", court, (x, 1.8, z), mesh=column)
        gltf.add_solid(f"column_{number}", (0.6, 3.6, 0.6), (x, 1.8, z))
    for number in range(3):
        height = 0.25 * (number + 1)
        gltf.box(f"step_{number}", (3, height, 0.5), (8.3, height / 2, -3.25 - 0.5 * number), "stone_pale", court)
    gltf.box("dais", (3, 1, 2.5), (8.3, 0.5, -5.75), "stone_pale", court)
    for name, size, x, z in (("north", (40, 1.6, 0.4), 0, -19.8), ("south", (40, 1.6, 0.4), 0, 19.8),
                             ("west", (0.4, 1.6, 39.2), -19.8, 0), ("east", (0.4, 1.6, 39.2), 19.8, 0)):
        gltf.box(f"court_wall_{name}", size, (x, 0.8, z), "sandstone", court)


def add_emitters(gltf):
    emitters = gltf.node("emitters")
    gltf.box("emitter_warm", (0.5, 0.5, 0.5), (-0.5, FLOOR_TOP + 0.25, -2.2), "emissive_warm", emitters)
    gltf.box("emitter_cool", (0.5, 0.5, 0.5), (4.85, 0.25, 0.0), "emissive_cool", emitters)


def add_pergola(gltf):
    pergola = gltf.node("pergola_structure")
    middle_x, size_x = sum(PERGOLA_X) / 2, PERGOLA_X[1] - PERGOLA_X[0]
    for name, (z0, z1) in PERGOLA_Z.items():
        quad = horizontal_quad(size_x, z1 - z0)
        # The lattice repeats every 0.8 m.
        uvs = [(x / 0.8, z / 0.8) for x, _, z in quad[0]] if name == "panel_lattice" else None
        mesh = gltf.mesh(name, [gltf.primitive(quad, name, uvs)])
        gltf.node(name, pergola, (middle_x, PERGOLA_Y, (z0 + z1) / 2), mesh=mesh)
        gltf.add_solid(name, (size_x, 0, z1 - z0), (middle_x, PERGOLA_Y, (z0 + z1) / 2))
        for x_name, x in zip(("west", "east"), PERGOLA_X):
            for z_name, z in (("north", z0), ("south", z1)):
                gltf.box(f"{name}_post_{z_name}_{x_name}", (0.1, PERGOLA_Y - 0.12, 0.1),
                         (x, (PERGOLA_Y - 0.12) / 2, z), "wood_dark", pergola)
            gltf.box(f"{name}_rail_{x_name}", (0.1, 0.1, z1 - z0 + 0.1), (x, PERGOLA_Y - 0.07, (z0 + z1) / 2),
                     "wood_dark", pergola)


def add_movers(gltf):
    movers = gltf.node("movers")
    ball = gltf.mesh("sphere", [gltf.primitive(sphere(0.5), "mover_white")])
    for name, radius, (x, z), rests_on in SPHERES:
        gltf.node(f"sphere_{name}", movers, (x, rests_on + radius, z), scale=[2 * radius] * 3, mesh=ball,
                  extras={"contribute_gi": False})
    # The beam lies on two trestles, one inside and one in the sun; the post has its foot in shade, its top in the sun.
    # Both are longer than the space between probes, and ask for grids of light of their own.
    gltf.box("beam_long", (0.6, 0.6, 10), (-1.8, 1.1, 2.7), "mover_white", movers, moves=True,
             light_probes="proxy_volume")
    gltf.box("post_tall", (0.6, 5, 0.6), (5.15, 2.5, -1.5), "mover_white", movers, moves=True,
             light_probes="proxy_volume")
    supports = gltf.node("trestles")
    gltf.box("trestle_inside", (0.9, 0.8 - FLOOR_TOP, 0.15), (-1.8, (0.8 + FLOOR_TOP) / 2, -1.6), "wood_dark", supports)
    gltf.box("trestle_court", (0.9, 0.8, 0.15), (-1.8, 0.4, 7.0), "wood_dark", supports)


def add_camera(gltf, name, position, target, yfov_degrees):
    gltf.cameras.append({"name": name, "type": "perspective", "perspective":
                         {"aspectRatio": 16 / 9, "yfov": round(math.radians(yfov_degrees), 7), "znear": 0.05,
                          "zfar": 200.0}})
    gltf.node(name, None, position, rotation=look_rotation([t - p for t, p in zip(target, position)]),
              camera=len(gltf.cameras) - 1)


def add_lights_and_cameras(gltf):
    gltf.node("sun", None, (-8, 16, 8), rotation=look_rotation(SUN_DIRECTION),
              extensions={"KHR_lights_punctual": {"light": 0}})
    add_camera(gltf, "camera", (9.5, 5.0, 18.0), (-0.3, 0.8, 1.0), 40)
    add_camera(gltf, "camera_interior", (3.35, 2.2, -2.4), (-2.0, 0.7, 1.6), 64)


# --- The probes -------------------------------------------------------------------------------------------------------
def grid(xs, ys, zs):
    return [(x, y, z) for y in ys for z in zs for x in xs]


def add_probe_group(gltf, name, local, translation=(0, 0, 0), turn=0, as_children=False, wanted=lambda world: True):
    """Adds those of the `local` positions that are free and `wanted`, as POINTS or as child nodes."""
    local = [tuple(rounded(p)) for p in local]
    placed = {p: tuple(c + t for c, t in zip(turned(p, turn), translation)) for p in local}
    kept = [p for p in local if gltf.is_free(placed[p]) and wanted(placed[p])]
    mesh = None
    if not as_children:
        mesh = gltf.mesh(f"probes_{name}", [
            {"attributes": {"POSITION": gltf.float_accessor(kept, bounds=True)}, "mode": 0}])
    group = gltf.node(name, None, translation, rotation=yaw_rotation(turn) if turn else None, mesh=mesh,
                      extras={"light_probe_group": True})
    if as_children:
        for number, position in enumerate(kept):
            gltf.node(f"{name}_probe_{number:02}", group, position)
    gltf.probes[name] = [placed[p] for p in kept]


def add_probes(gltf):
    d = PROBE_FROM_WALL
    xs = [-INNER_X + d, -1.15, 1.15, INNER_X - d]
    zs = [-INNER_Z + d, -0.8, 0.8, INNER_Z - d]
    heights = [FLOOR_TOP + d, 1.7, WALL_TOP - d]
    # The lowest layer lies near the floor, so that the foot of the walls is lit from inside.
    add_probe_group(gltf, "interior", grid(xs, [FLOOR_TOP + 0.16] + heights[1:], zs))

    # The same places on the other side of the walls and of the roof, and the corners.
    out_x, out_z = HALF_X + d, HALF_Z + d
    around = (grid(xs, heights, (-out_z, out_z)) + grid((-out_x, out_x), heights, zs)
              + grid((-out_x, out_x), heights, (-out_z, out_z)))
    add_probe_group(gltf, "walls_outside", around + grid(xs, [ROOF_TOP + d], zs))

    pergola_middle = ((PERGOLA_X[0] + PERGOLA_X[1]) / 2, 0, 3.9)
    add_probe_group(gltf, "pergola", grid((-1.2, 0, 1.2), (0.4, PERGOLA_Y - 0.4, PERGOLA_Y + 0.4), (-2.6, -1, 1, 2.6)),
                    pergola_middle, as_children=True)

    high = [turned((0, 9, 15), 45 * i + 22.5) for i in range(8)]
    add_probe_group(gltf, "sky", high + [p for p in grid((-19, 0, 19), (0.4,), (-19, 0, 19)) if p[0] or p[2]])

    others = [p for positions in gltf.probes.values() for p in positions]
    gltf.add_solid("house_inside", (2 * HALF_X, ROOF_TOP, 2 * HALF_Z), (0, ROOF_TOP / 2, 0))

    def apart(world):
        return all(math.dist(world, other) >= PROBE_SPACING for other in others)

    layout = grid([4.5 * i - 11.25 for i in range(6)], (0.3, 1.5, 4.0), [4.5 * i - 9 for i in range(5)])
    add_probe_group(gltf, "court", layout, (0.3, 0, 2.6), turn=12, wanted=apart)


def make_courtyard():
    gltf = Gltf()
    for add in (add_ground, add_house, add_court, add_emitters, add_pergola, add_movers, add_lights_and_cameras,
                add_probes):
        add(gltf)
    return gltf


def main():
    parser = argparse.ArgumentParser(description="Writes the courtyard sample scene as glTF 2.0 binary.")
    parser.add_argument("out", nargs="?", type=Path, metavar="OUT.glb",
                        default=Path(__file__).with_name("courtyard.glb"),
                        help="default: courtyard.glb beside this script")
    parser.add_argument("--unbaked-emission", action="store_true",
                        help="what shines lights nothing: bakes do not see it")
    arguments = parser.parse_args()
    out = arguments.out
    gltf = make_courtyard()
    gltf.bakes_emission = not arguments.unbaked_emission
    beside = out.with_name(out.name + ".part")
    beside.write_bytes(gltf.glb())
    os.replace(beside, out)
    groups = ", ".join(f"{name} {len(positions)}" for name, positions in gltf.probes.items())
    print(f"{out}: {len(gltf.nodes)} nodes, {sum(map(len, gltf.probes.values()))} probes ({groups})")


if __name__ == "__main__":
    main()
