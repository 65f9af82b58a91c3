#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a room that is lit by the sun and the sky through one window, and a dark one behind a door.

    python3 make_window_room.py [OUT.glb]        (default: window_room.glb beside this script)

The rooms are 5 x 3 x 4 m, one behind the other along x; the window is in the wall at x = 0. White balls move: probes
light them and the bake does not see them.
"""
import argparse
from pathlib import Path

from make_courtyard import Gltf, add_camera, look_rotation, sphere

LONG, HIGH, WIDE, WALL = 5.0, 3.0, 4.0, 0.2
WINDOW = ((0.9, 2.1), (1.2, 2.6))  # y and z
DOOR = ((0.0, 2.1), (0.6, 1.6))
SUN_DIRECTION = (1.0, -0.8, 0.25)
BALLS = [(1.2, 0.3, 3.2), (3.2, 0.3, 2.6), (4.3, 0.3, 1.1), (7.2, 0.3, 1.6)]


class WindowRoom(Gltf):
    def json(self):
        document = super().json()
        document["asset"]["generator"] = "Tetralight make_window_room.py"
        document["scenes"][0].update(name="window room", extras={"sky": {"radiance": [0.7, 0.9, 1.2]}})
        return document

    def part(self, name, low, high, material="plaster_grey"):
        size = [h - l for l, h in zip(low, high)]
        self.box(name, size, [(l + h) / 2 for l, h in zip(low, high)], material)


def add_wall_with_hole(gltf, name, x, hole):
    (low, high), (near, far) = hole
    sides = {"near": ((0, 0), (HIGH, near)), "far": ((0, far), (HIGH, WIDE)), "above": ((high, near), (HIGH, far))}
    if low > 0:
        sides["below"] = ((0, near), (low, far))
    for side, ((y0, z0), (y1, z1)) in sides.items():
        gltf.part(f"{name}_{side}", (x, y0, z0), (x + WALL, y1, z1))


def add_rooms(gltf):
    end = 2 * LONG + WALL
    gltf.part("ground", (-15, -0.7, -15), (end + 15, -0.2, WIDE + 15), "sandstone")
    gltf.part("floor", (-WALL, -0.2, -WALL), (end + WALL, 0, WIDE + WALL), "stone_pale")
    gltf.part("roof", (-WALL, HIGH, -WALL), (end + WALL, HIGH + 0.2, WIDE + WALL))
    gltf.part("left", (-WALL, 0, -WALL), (end + WALL, HIGH, 0))
    gltf.part("right", (-WALL, 0, WIDE), (end + WALL, HIGH, WIDE + WALL))
    gltf.part("back", (end, 0, 0), (end + WALL, HIGH, WIDE))
    add_wall_with_hole(gltf, "window_wall", -WALL, WINDOW)
    add_wall_with_hole(gltf, "door_wall", LONG, DOOR)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", nargs="?", default=Path(__file__).with_name("window_room.glb"), type=Path)
    out = parser.parse_args().out
    gltf = WindowRoom()
    add_rooms(gltf)
    mesh = gltf.mesh("ball", [gltf.primitive(sphere(0.3), "mover_white")])
    for number, center in enumerate(BALLS):
        gltf.node(f"ball_{number}", None, center, mesh=mesh, extras=gltf.mover_extras(None))
    gltf.node("sun", None, (-8, 8, 0), rotation=look_rotation(SUN_DIRECTION),
              extensions={"KHR_lights_punctual": {"light": 0}})
    add_camera(gltf, "camera", (4.7, 1.9, 3.6), (0.6, 0.9, 1.5), 62)
    out.write_bytes(gltf.glb())


if __name__ == "__main__":
    main()
