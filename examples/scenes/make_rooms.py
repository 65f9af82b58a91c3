#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes two closed rooms beside each other, a bright one and a dim one, with a wall of 5 cm between them.

    python3 make_rooms.py [OUT.glb]        (default: rooms.glb beside this script)

Each room is 4 x 3 x 4 m; the wall is at x = 0. All sides face inwards, so that a camera outside looks through the
nearest ones. A row of white balls goes through the wall; they move: probes light them and the bake does not see them.
"""
import argparse
from pathlib import Path

import make_courtyard
from make_courtyard import FACES, Gltf, box_faces, horizontal_quad, sphere

WIDE, HIGH, DEEP, WALL = 4.0, 3.0, 4.0, 0.05
BALL_RADIUS, BALL_HEIGHT, BALLS_A_ROOM, BALL_SPACING = 0.19, 1.0, 8, 0.46
FIRST_BALL = 0.3  # centre, metres from the wall

make_courtyard.MATERIALS.update({
    "lamp_bright": ((0, 0, 0, 1), {"emission": (1.0, 0.85, 0.6), "strength": 12.0}),
    "lamp_dim": ((0, 0, 0, 1), {"emission": (0.4, 0.65, 1.0), "strength": 2.0}),
})


class Rooms(Gltf):
    def json(self):
        document = super().json()
        document["asset"]["generator"] = "Tetralight make_rooms.py"
        del document["extensions"]["KHR_lights_punctual"]
        document["extensionsUsed"].remove("KHR_lights_punctual")
        document["scenes"] = [{"name": "rooms", "nodes": self.roots}]
        return document


def turned_over(geometry):
    positions, normals, triangles = geometry
    return positions, [[-c for c in n] for n in normals], [(a, c, b) for a, b, c in triangles]


def add_room(gltf, name, sign, lamp):
    middle = sign * (WIDE + WALL) / 2
    sides = gltf.primitive(turned_over(box_faces((WIDE, HIGH, DEEP), tuple(FACES))), "plaster_grey")
    gltf.node(f"room_{name}", None, (middle, HIGH / 2, 0), mesh=gltf.mesh(f"room_{name}", [sides]))
    quad = gltf.primitive(turned_over(horizontal_quad(1, 1)), lamp)
    gltf.node(lamp, None, (middle, HIGH - 0.01, 0), mesh=gltf.mesh(lamp, [quad]))


def add_balls(gltf):
    mesh = gltf.mesh("ball", [gltf.primitive(sphere(BALL_RADIUS), "mover_white")])
    for number in range(BALLS_A_ROOM):
        for side, sign in (("bright", -1), ("dim", 1)):
            x = sign * (FIRST_BALL + number * BALL_SPACING)
            gltf.node(f"ball_{side}_{number}", None, (x, BALL_HEIGHT, 0.6), mesh=mesh,
                      extras=gltf.mover_extras(None))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", nargs="?", default=Path(__file__).with_name("rooms.glb"), type=Path)
    out = parser.parse_args().out
    gltf = Rooms()
    add_room(gltf, "bright", -1, "lamp_bright")
    add_room(gltf, "dim", 1, "lamp_dim")
    add_balls(gltf)
    out.write_bytes(gltf.glb())


if __name__ == "__main__":
    main()
