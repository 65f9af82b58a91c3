#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a small studio for the pictures of docs/lightmaps.md: one object for each thing that lightmaps do.

    python3 make_lightmap_studio.py [OUT.glb] [--sun baked] [--roof blend:0.5] ...
                                               (default: lightmap_studio.glb beside this script)

The studio is 6 x 6 m: a floor of 3 x 3 tiles, a white back wall, a red and a teal one, open to the front and the top.
It has a camera and a group of probes.
"""
import argparse
import math
from pathlib import Path

from make_courtyard import (FACES, MATERIALS, Gltf, add_camera, add_probe_group, box_faces, cylinder, grid,
                            horizontal_quad, look_rotation, rgba_png, rounded, sphere, yaw_rotation)

HALF, HIGH, WALL = 3.0, 2.4, 0.2
SUN_DIRECTION = (-0.45, -1.0, -0.5)

MATERIALS.update({
    "gold_rough": ((0.95, 0.62, 0.18, 1), {}),
    "leaf": ((1, 1, 1, 1), {"alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": True, "texture": 1}),
    "lamp": ((0.3, 0.3, 0.3, 1), {"emission": (1.0, 0.45, 0.1), "strength": 12.0}),
    "glowing_tile": ((0.5, 0.5, 0.5, 1), {"emission": (1.0, 1.0, 1.0), "strength": 2.0}),
    "sign_unlit": ((1.0, 0.15, 0.6, 1), {}),
    "bricks": ((0.75, 0.75, 0.75, 1), {}),
})


def leaf_png(size=64):
    """A green leaf on nothing: two circles that overlap."""
    def pixel(x, y):
        across, along = abs((x + 0.5) / size - 0.5), (y + 0.5) / size - 0.5
        inside = math.hypot(across + 0.4, along) < 0.64
        return 70, 130 if across > 0.02 else 160, 40, 255 if inside else 0

    return rgba_png(size, pixel)


def glow_png(size=64):
    """An emission map: an orange and a blue disc on black."""
    def pixel(x, y):
        def coverage(center):
            return min(max(0.2 * size - math.hypot(x + 0.5 - center * size, y + 0.5 - center * size) + 0.5, 0), 1)

        orange, blue = coverage(0.28), coverage(0.72)
        return (*(round(orange * a + blue * b) for a, b in zip((255, 140, 30), (40, 120, 255))), 255)

    return rgba_png(size, pixel)


def bricks_png(size=96, columns=3, rows=6):
    """A normal map of bricks with round edges: a metre of a wall, which tiles in both directions."""
    width, height, edge = size / columns, size / rows, 3.0

    def elevation(x, y):
        row = math.floor(y / height)
        across = (x + (row % 2) * width / 2) % width - width / 2
        along = y - (row + 0.5) * height
        inside = min(width / 2 - abs(across), height / 2 - abs(along))
        rise = min(max((inside - 0.5) / edge, 0), 1)
        return 3.5 * rise * rise * (3 - 2 * rise)

    def pixel(x, y):
        x, y = x + 0.5, y + 0.5
        slope_x = elevation(x + 0.5, y) - elevation(x - 0.5, y)
        slope_down = elevation(x, y + 0.5) - elevation(x, y - 0.5)
        length = math.sqrt(slope_x * slope_x + slope_down * slope_down + 1)
        # The rows of the image run downwards, y of the normal upwards.
        return (*(round(127.5 * (c / length + 1)) for c in (-slope_x, slope_down, 1)), 255)

    return rgba_png(size, pixel)


class Studio(Gltf):
    def __init__(self, options):
        super().__init__()
        self.options = options
        self.image_views = {"leaf": self.view(leaf_png()), "glow": self.view(glow_png())}
        if options.wall == "bricks":
            self.image_views["bricks"] = self.view(bricks_png())
        self.bakes_emission = options.emission == "baked"

    def object(self, name, primitive, center, turn=0, **extras):
        """A node with a mesh of its own, or with a mesh that is there already (its index)."""
        mesh = primitive if isinstance(primitive, int) else self.mesh(name, [primitive])
        self.node(name, None, center, mesh=mesh, rotation=yaw_rotation(turn) if turn else None, extras=extras or None)

    def json(self):
        document = super().json()
        document["asset"]["generator"] = "Tetralight make_lightmap_studio.py"
        document["scenes"][0].update(name="lightmap studio", extras={"sky": {"radiance": [0.22, 0.3, 0.42]}})
        if self.options.sun == "none":
            del document["extensions"]
        else:
            sun = document["extensions"]["KHR_lights_punctual"]["lights"][0]
            sun["extras"] = {"mode": self.options.sun, "angle": 4}
        for number, (name, view) in enumerate(self.image_views.items(), 1):
            document["textures"].append({"name": name, "sampler": 0, "source": number})
            document["images"].append({"name": name, "mimeType": "image/png", "bufferView": view})
        materials = {material["name"]: material for material in document["materials"]}
        materials["gold_rough"]["pbrMetallicRoughness"].update(metallicFactor=1.0,
                                                               roughnessFactor=self.options.metal_roughness)
        materials["glowing_tile"]["emissiveTexture"] = {"index": 2}
        if self.options.wall == "bricks":
            materials["bricks"]["normalTexture"] = {"index": 3}
        materials["leaf"]["doubleSided"] = self.options.leaves == "two-sided"
        materials["sign_unlit"]["extensions"] = {"KHR_materials_unlit": {}}
        document["extensionsUsed"].append("KHR_materials_unlit")
        return document


def add_room(gltf):
    tile = horizontal_quad(2, 2)
    material = "glowing_tile" if gltf.options.floor == "emissive" else "stone_pale"
    mesh = gltf.mesh("tile", [gltf.primitive(tile, material, [(0.5 + x / 2, 0.5 + z / 2) for x, _, z in tile[0]])])
    for row in range(3):
        for column in range(3):
            gltf.object(f"tile_{row}_{column}", mesh, (2 * column - 2, 0, 2 * row - 2))
    end = 2 * HALF + 2 * WALL
    for name, size, center, material in (
            ("wall_back", (end, HIGH, WALL), (0, HIGH / 2, -HALF - WALL / 2), "white"),
            ("wall_red", (WALL, HIGH, 2 * HALF), (-HALF - WALL / 2, HIGH / 2, 0), "paint_warm_red"),
            ("wall_teal", (WALL, HIGH, 2 * HALF), (HALF + WALL / 2, HIGH / 2, 0), "teal")):
        gltf.box(name, size, center, material)


def add_bricks(gltf):
    """Bricks of a normal map before the white wall."""
    if gltf.options.wall != "bricks":
        return
    corners = [(-HALF, 0), (HALF, 0), (HALF, HIGH), (-HALF, HIGH)]
    wall = ([], [], [])
    add_quad(wall, [(x, y, -HALF + 0.01) for x, y in corners], (0, 0, 1))
    gltf.object("bricks", gltf.primitive(wall, "bricks", [(x, -y) for x, y in corners]), (0, 0, 0))


def add_roof(gltf):
    kind, _, opacity = gltf.options.roof.partition(":")
    if kind == "none":
        return
    name = {"blend": "panel_tinted", "cutout": "panel_lattice"}[kind]
    color, other = MATERIALS[name]
    MATERIALS[name] = ((*color[:3], float(opacity)) if opacity else color, other)
    quad = horizontal_quad(2 * HALF, HALF)
    gltf.object("roof", gltf.primitive(quad, name, [(x, z) for x, _, z in quad[0]]), (0, HIGH, -HALF / 2))


def add_objects(gltf):
    stitched = {} if gltf.options.seams == "stitched" else {"stitch_seams": False}
    gltf.object("sphere", gltf.primitive(sphere(0.6), "white"), (-1.7, 0.6, -1.7), **stitched)
    gltf.object("cylinder", gltf.primitive(cylinder(0.35, 1.5), "white"), (0, 0.75, -1.9), **stitched)
    gltf.add_solid("sphere", (1.2, 1.2, 1.2), (-1.7, 0.6, -1.7))
    gltf.add_solid("cylinder", (0.7, 1.5, 0.7), (0, 0.75, -1.9))
    sunk = gltf.primitive(box_faces((1, 1, 1)), "yellow")
    if gltf.options.uvs == "overlapping":
        side = [(0.02, 0.02), (0.98, 0.02), (0.98, 0.98), (0.02, 0.98)]
        sunk["attributes"]["TEXCOORD_1"] = gltf.float_accessor(side * len(FACES))
    gltf.object("sunk_box", sunk, (1.5, 0.15, -1.5), turn=28)
    gltf.add_solid("sunk_box", (1, 1, 1), (1.5, 0.15, -1.5), 28)
    gltf.box("gold", (0.12, 1.0, 1.1), (-2.3, 0.5, 1.4), "gold_rough")
    gltf.object("sign", gltf.primitive(box_faces((0.9, 0.4, 0.08)), "sign_unlit"), (1.5, 1.5, -HALF))
    gltf.object("lamp", gltf.primitive(box_faces((0.25, 0.25, 0.25)), "lamp"), (2.5, 0.125, 0.2), lightmap_scale=2)


def add_pair(gltf):
    """Two equal balls, and one that moves: a lightmap for one, probes for the others."""
    ball = gltf.mesh("ball", [gltf.primitive(sphere(0.4), "red")])
    gltf.object("ball_lightmap", ball, (-1.0, 0.4, 1.1))
    gltf.object("ball_probes", ball, (0.1, 0.4, 1.1), receive_gi="probes")
    gltf.object("ball_moving", ball, (1.2, 0.4, 1.1), contribute_gi=False)
    for x in (-1.0, 0.1):
        gltf.add_solid("ball", (0.8, 0.8, 0.8), (x, 0.4, 1.1))


def add_leaves(gltf):
    """Three crossed leaves that stand on the floor, and three that hang a little above it."""
    standing = ([], [], [])
    for turn in (0, 60, 120):
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        add_quad(standing, [(0.35 * side * c, y, 0.35 * side * s)
                            for side, y in ((-1, 0), (1, 0), (1, 0.9), (-1, 0.9))], (-s, 0, c))
    lying = ([], [], [])
    for turn in (20, 140, 260):
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        add_quad(lying, [(along * c - across * s, 0.12, along * s + across * c)
                         for along, across in ((0.3, -0.25), (0.3, 0.25), (1.0, 0.25), (1.0, -0.25))], (0, 1, 0))
    for name, geometry in (("leaves_standing", standing), ("leaves_lying", lying)):
        leaf = gltf.primitive(geometry, "leaf", [(0, 1), (1, 1), (1, 0), (0, 0)] * 3)
        gltf.object(name, leaf, (1.5, 0, 2.1))


def add_quad(geometry, corners, normal):
    positions, normals, triangles = geometry
    first = len(positions)
    positions += map(rounded, corners)
    normals += [rounded(normal)] * 4
    triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]


def add_lights_and_cameras(gltf):
    if gltf.options.sun != "none":
        gltf.node("sun", None, (6, 8, 4), rotation=look_rotation(SUN_DIRECTION),
                  extensions={"KHR_lights_punctual": {"light": 0}})
    add_camera(gltf, "camera", (0.0, 3.4, 7.2), (0.0, 0.65, -0.3), 37)


def add_probes(gltf):
    places = grid([-2.7, -1.6, -0.5, 0.6, 1.7, 2.7], [0.15, 0.9, 2.1], [-2.7, -1.6, -0.5, 0.5, 1.7, 2.7])
    add_probe_group(gltf, "probes", places)
    add_probe_group(gltf, "around", grid([-5, 0, 5], [0.2, 4.5], [-5, 0, 5]),
                    wanted=lambda world: world[0] or world[2] or world[1] > 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", nargs="?", default=Path(__file__).with_name("lightmap_studio.glb"), type=Path)
    parser.add_argument("--sun", choices=("realtime", "mixed", "baked", "none"), default="mixed")
    parser.add_argument("--roof", default="none", metavar="none|blend:OPACITY|cutout")
    parser.add_argument("--floor", choices=("stone", "emissive"), default="stone")
    parser.add_argument("--emission", choices=("baked", "none"), default="baked", help="whether bakes see emission")
    parser.add_argument("--metal-roughness", type=float, default=1.0, metavar="R", help="roughness of the gold panel")
    parser.add_argument("--leaves", choices=("two-sided", "one-sided"), default="two-sided")
    parser.add_argument("--seams", choices=("stitched", "plain"), default="stitched",
                        help="whether the seams of the sphere and the cylinder are stitched")
    parser.add_argument("--uvs", choices=("none", "overlapping"), default="none",
                        help="TEXCOORD_1 of the box: none, or all sides at one place")
    parser.add_argument("--wall", choices=("plain", "bricks"), default="plain",
                        help="bricks: a normal map on the wall at the back")
    gltf = Studio(parser.parse_args())
    for add in (add_room, add_bricks, add_roof, add_objects, add_pair, add_leaves, add_lights_and_cameras, add_probes):
        add(gltf)
    gltf.options.out.write_bytes(gltf.glb())


if __name__ == "__main__":
    main()
