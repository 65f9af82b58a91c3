#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes two rooms with a doorway between them for the pictures of docs/reflections.md.

    python3 make_reflection_rooms.py [OUT.glb] [--ball X] [--balls metal|plastic] [--pillar shown|hidden] [--chest]
                                                                 (default: reflection_rooms.glb beside this script)

The left room is warm and the right one cool; both are 6 x 3 x 4 m. Each has a reflection probe with the box of the
room. Six balls of metal or black plastic stand in the left room, from smooth to rough; a seventh, a mirror, stands at
X. A pillar stands behind the camera: `hidden` keeps it out of reflections. With --chest the left room has a chest on a
floor of steel instead of the six balls.
"""
import argparse
from pathlib import Path

from make_courtyard import MATERIALS, Gltf, add_camera, add_probe_group, box_faces, grid, horizontal_quad, rgba_png, sphere

LONG, HIGH, DEEP, WALL = 6.0, 3.0, 4.0, 0.2
DOOR_HALF, DOOR_HIGH = 0.8, 2.2
BALLS = 6

MATERIALS.update({
    "checker": ((1, 1, 1, 1), {"texture": 1}),
    "steel": ((0.6, 0.58, 0.55, 1), {}),
    "paint_cool": ((0.25, 0.42, 0.62, 1), {}),
    "lamp_warm": ((0.3, 0.3, 0.3, 1), {"emission": (1.0, 0.62, 0.3), "strength": 22.0}),
    "lamp_cool": ((0.3, 0.3, 0.3, 1), {"emission": (0.55, 0.8, 1.0), "strength": 22.0}),
    **{f"metal_{i}": ((0.92, 0.9, 0.86, 1), {}) for i in range(BALLS)},
    **{f"plastic_{i}": ((0.02, 0.02, 0.02, 1), {}) for i in range(BALLS)},
})


def checker_png(size=32):
    """Two by two squares, light and dark."""
    def pixel(x, y):
        is_light = (2 * x // size + 2 * y // size) % 2
        return (205, 200, 190, 255) if is_light else (70, 62, 56, 255)

    return rgba_png(size, pixel)


class Rooms(Gltf):
    def __init__(self):
        super().__init__()
        self.checker_view = self.view(checker_png())

    def json(self):
        document = super().json()
        document["asset"]["generator"] = "Tetralight make_reflection_rooms.py"
        document["scenes"][0].update(name="reflection rooms", extras={})
        del document["extensions"]
        document["extensionsUsed"].remove("KHR_lights_punctual")
        document["textures"].append({"name": "checker", "sampler": 0, "source": 1})
        document["images"].append({"name": "checker", "mimeType": "image/png", "bufferView": self.checker_view})
        document["samplers"][0]["magFilter"] = 9728
        for material in document["materials"]:
            name, _, number = material["name"].partition("_")
            if name == "metal":
                material["pbrMetallicRoughness"].update(metallicFactor=1.0, roughnessFactor=int(number) / (BALLS - 1))
            if name == "steel":
                material["pbrMetallicRoughness"].update(metallicFactor=1.0, roughnessFactor=0.6)
            if name == "plastic":
                material["pbrMetallicRoughness"]["roughnessFactor"] = int(number) / (BALLS - 1)
        return document


def add_room(gltf, name, center_x, material, floor_material="checker"):
    """Floor, ceiling, three walls, a lamp below the ceiling, and the reflection probe."""
    floor = horizontal_quad(LONG + WALL, DEEP)
    gltf.node(f"{name}_floor", None, (center_x, 0, 0), mesh=gltf.mesh("floor", [
        gltf.primitive(floor, floor_material, [(x + LONG / 2, z + DEEP / 2) for x, _, z in floor[0]])]))
    gltf.box(f"{name}_ceiling", (LONG + WALL, WALL, DEEP), (center_x, HIGH + WALL / 2, 0), "white")
    gltf.box(f"{name}_back", (LONG, HIGH, WALL), (center_x, HIGH / 2, -DEEP / 2 - WALL / 2), material)
    gltf.box(f"{name}_front", (LONG, HIGH, WALL), (center_x, HIGH / 2, DEEP / 2 + WALL / 2), "white")
    side = -1 if center_x < 0 else 1
    gltf.box(f"{name}_end", (WALL, HIGH, DEEP), (center_x + side * (LONG + WALL) / 2, HIGH / 2, 0), material)
    lamp = "lamp_warm" if center_x < 0 else "lamp_cool"
    gltf.box(f"{name}_lamp", (1.6, 0.08, 0.5), (center_x, HIGH - 0.2, -0.4), lamp)
    gltf.node(f"{name}_reflections", None, (center_x, 1.4, 0), extras={"reflection_probe": {
        "size": [LONG, HIGH, DEEP], "center": [0, round(HIGH / 2 - 1.4, 6), 0], "blend_distance": WALL}})
    places = grid([center_x + d for d in (-2.7, -1.6, -0.5, 0.5, 1.6, 2.7)], [0.15, 0.8, 1.6, 2.6], [-1.8, -0.9, 0, 0.9, 1.8])
    add_probe_group(gltf, f"{name}_probes", places)


def add_doorway(gltf):
    for sign in (-1, 1):
        width = DEEP / 2 - DOOR_HALF
        gltf.box("jamb_back" if sign < 0 else "jamb_front", (WALL, HIGH, width),
                 (0, HIGH / 2, sign * (DOOR_HALF + width / 2)), "white")
    gltf.box("lintel", (WALL, HIGH - DOOR_HIGH, 2 * DOOR_HALF), (0, (HIGH + DOOR_HIGH) / 2, 0), "white")


def add_balls(gltf, material):
    ball = sphere(0.3)
    for i in range(BALLS):
        mesh = gltf.mesh(f"ball_{i}", [gltf.primitive(ball, f"{material}_{i}")])
        gltf.node(f"ball_{i}", None, (-5.25 + 0.85 * i, 0.3, -0.7), mesh=mesh, extras={"contribute_gi": False})


def add_roller(gltf, ball_x):
    mesh = gltf.mesh("roller", [gltf.primitive(sphere(0.3), "metal_0")])
    gltf.node("roller", None, (ball_x, 0.3, -0.2), mesh=mesh, extras={"contribute_gi": False})


def add_pillar(gltf, is_shown):
    size = (0.5, HIGH, 0.5)
    mesh = gltf.mesh("pillar", [gltf.primitive(box_faces(size), "teal")])
    gltf.node("pillar", None, (-4.6, HIGH / 2, 1.2), mesh=mesh, extras=None if is_shown else {"in_reflections": False})


def add_chest(gltf):
    """On legs: below it the floor is dark."""
    gltf.box("chest", (2.0, 0.45, 0.9), (-3.4, 0.425, -0.7), "wood_dark")
    for number, (x, z) in enumerate(((-0.9, -0.35), (-0.9, 0.35), (0.9, -0.35), (0.9, 0.35))):
        gltf.box(f"leg_{number}", (0.08, 0.2, 0.08), (x - 3.4, 0.1, z - 0.7), "wood_dark")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", nargs="?", default=Path(__file__).with_name("reflection_rooms.glb"), type=Path)
    parser.add_argument("--ball", type=float, metavar="X", help="a mirror ball at this place between the rooms")
    parser.add_argument("--balls", choices=("metal", "plastic"), default="metal", help="what the six balls are of")
    parser.add_argument("--pillar", choices=("shown", "hidden"), help="a pillar, in reflections or not")
    parser.add_argument("--chest", action="store_true", help="a chest on a floor of steel instead of the six balls")
    options = parser.parse_args()
    gltf = Rooms()
    add_room(gltf, "warm", -LONG / 2 - WALL / 2, "paint_warm_red", "steel" if options.chest else "checker")
    add_room(gltf, "cool", LONG / 2 + WALL / 2, "paint_cool")
    add_doorway(gltf)
    if options.chest:
        add_chest(gltf)
    else:
        add_balls(gltf, options.balls)
    if options.pillar:
        add_pillar(gltf, options.pillar == "shown")
    if options.ball is not None:
        add_roller(gltf, options.ball)
    add_camera(gltf, "camera", (-3.1, 1.35, 1.9), (-3.1, 0.75, -0.7), 58)
    add_camera(gltf, "camera_door", (-2.6, 1.3, 1.7), (0.4, 0.5, -0.3), 52)
    options.out.write_bytes(gltf.glb())


if __name__ == "__main__":
    main()
