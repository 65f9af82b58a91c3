#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a furnished living room with a dim corridor behind its door, for the pictures of docs/gallery.md.

    python3 make_room.py [OUT.glb] [--screen]                          (default: room.glb beside this script)

The room is 6 x 2.7 x 4.6 m. The sun shines in through two windows in the wall at x = 0; the corridor is behind the
wall at z = 0. The sun, the sky and the two lamps are on at once: a bake with the layers `sun`, `sky`, `material:shade`,
`material:bulb_pendant`, `light:floor_lamp_light` and `light:pendant_light` gives the day and the evening. Measures,
albedos from 0.04 to 0.86 and the ratio of sun and sky are those of a real room. With --screen a folding screen stands
in it, which moves and takes its light from a proxy volume.
"""
import argparse
import math
import random
from pathlib import Path

from make_courtyard import FACES, Gltf, add_camera, horizontal_quad, look_rotation, sphere
import room_furniture as furniture
from room_materials import LAMP_COLOR, MATERIALS, material_json
from room_shapes import block, block_faces, merged, moved, planar_uvs, wall
from room_textures import TEXTURES

LONG, HIGH, WIDE = 6.0, 2.7, 4.6
OUTER, PARTITION = 0.25, 0.12  # how thick the walls are
CORRIDOR_X, CORRIDOR_DEEP = (2.2, 6.0), 1.3
DOOR = (4.75, 5.6, 0.0, 2.08)  # x and y
WINDOWS = ((0.62, 1.82), (2.5, 3.7))  # z
SILL, LINTEL = 0.82, 2.32
SUN_DIRECTION = (1.0, -0.62, -0.34)


class Room(Gltf):
    materials = MATERIALS

    def __init__(self):
        super().__init__()
        self.images = {name: self.view(write()) for name, write in TEXTURES.items()}
        self.lights = [{"name": "sun", "type": "directional", "color": [1.0, 0.93, 0.82], "intensity": 20.0,
                        "extras": {"angle": 0.53}}]

    def add(self, name, shape, material, center=(0, 0, 0), uv=1.0, uvs=None, parent=None, moves=False, **extras):
        """A node with one shape; uv: metres that the texture of the material covers."""
        look = MATERIALS[material][2]
        if uvs is None and ("color" in look or "normal" in look):
            uvs = planar_uvs(shape, uv)
        if moves:
            extras = {"contribute_gi": False}
        mesh = self.mesh(name, [self.primitive(shape, material, uvs)])
        return self.node(name, parent, center, mesh=mesh, extras=extras or None)

    def lamp(self, name, position, cone=None):
        """A lamp whose direct light is baked too; with a cone of so many degrees it shines down."""
        light = {"name": name, "type": "spot" if cone else "point", "color": LAMP_COLOR, "intensity": 1.6,
                 "extras": {"mode": "baked", "radius": 0.04}}
        if cone:
            light["spot"] = {"innerConeAngle": round(math.radians(cone - 25), 6),
                             "outerConeAngle": round(math.radians(cone), 6)}
        self.lights.append(light)
        self.node(f"{name}_light", None, position, rotation=look_rotation((0, -1, 0)) if cone else None,
                  extensions={"KHR_lights_punctual": {"light": len(self.lights) - 1}})

    def json(self):
        document = super().json()
        images = list(TEXTURES)
        document["asset"]["generator"] = "Tetralight make_room.py"
        document["extensions"]["KHR_lights_punctual"]["lights"] = self.lights
        document["scenes"][0].update(name="room", extras={"sky": {"radiance": [0.8, 1.0, 1.3]}})
        document["materials"] = [material_json(name, *value, images) for name, value in MATERIALS.items()]
        document["textures"] = [{"name": name, "sampler": 0, "source": i} for i, name in enumerate(images)]
        document["images"] = [{"name": name, "mimeType": "image/png", "bufferView": self.images[name]}
                              for name in images]
        return document


# --- The building -----------------------------------------------------------------------------------------------------
def add_wall(room, name, length, thickness, origin, turn, front, back, holes=()):
    """A wall whose front looks to the left of its direction, which is +X turned by `turn` degrees."""
    sides = wall(length, HIGH, thickness, holes)
    for part, shape, material in zip(("front", "back", "rim"), sides, (front, back, "paint_white")):
        if material:
            room.add(f"{name}_{part}", moved(shape, turn=turn), material, origin, uv=1.0,
                     **({"lightmap_scale": 0.15} if material == "facade" else {}))


def add_building(room):
    far = -CORRIDOR_DEEP - PARTITION
    windows = [(WIDE - z1, WIDE - z0, SILL, LINTEL) for z0, z1 in WINDOWS]
    # Fronts look into the room: along +Z from the partition, +X from the windows, and so on.
    add_wall(room, "wall_windows", WIDE, OUTER, (-OUTER, 0, WIDE), 90, "plaster", "facade", windows)
    add_wall(room, "wall_right", WIDE, OUTER, (LONG + OUTER, 0, 0), -90, "plaster", "facade")
    add_wall(room, "corridor_right", CORRIDOR_DEEP, OUTER, (LONG + OUTER, 0, far), -90, "plaster_corridor", "facade")
    add_wall(room, "wall_near", LONG, OUTER, (LONG, 0, WIDE + OUTER), 180, "plaster", "facade")
    add_wall(room, "partition", LONG, PARTITION, (0, 0, -PARTITION), 0, "plaster_sage", "plaster_corridor", [DOOR])
    add_wall(room, "corridor_far", CORRIDOR_X[1] - CORRIDOR_X[0], OUTER, (CORRIDOR_X[0], 0, far - OUTER), 0,
             "plaster_corridor", "facade")
    add_wall(room, "corridor_end", CORRIDOR_DEEP, OUTER, (CORRIDOR_X[0] - OUTER, 0, -PARTITION), 90,
             "plaster_corridor", "facade")
    room.add("floor", plane(-OUTER, LONG + OUTER, far - OUTER, WIDE + OUTER, 0, 1), "floor", uv=2.0, lightmap_scale=1.5)
    room.add("ceiling", plane(-OUTER, LONG + OUTER, far - OUTER, WIDE + OUTER, HIGH, -1), "ceiling")
    room.add("roof", block((LONG + 3 * OUTER, 0.2, WIDE - far + 3 * OUTER), (LONG / 2, HIGH + 0.11, (WIDE + far) / 2)),
             "facade",
             lightmap_scale=0.1)
    # Walls touch along lines alone: posts behind their corners and a band at their tops keep daylight out.
    corners = [(-OUTER, WIDE), (LONG, WIDE), (LONG, far - OUTER), (CORRIDOR_X[0] - OUTER, far - OUTER),
               (-OUTER, -OUTER)]
    posts = [block_faces((x, -0.4, z), (x + OUTER, HIGH + 0.005, z + OUTER), tuple(FACES)) for x, z in corners]
    posts.append(block_faces((LONG, 0, -PARTITION), (LONG + OUTER, HIGH, 0), tuple(FACES)))
    x0, x1, z0, z1 = -OUTER, LONG + OUTER, far - OUTER, WIDE + OUTER
    band = [block_faces((x0 - 0.1, HIGH - 0.15, z0 - 0.1), (x0, HIGH + 0.1, z1 + 0.1), tuple(FACES)),
            block_faces((x1, HIGH - 0.15, z0 - 0.1), (x1 + 0.1, HIGH + 0.1, z1 + 0.1), tuple(FACES)),
            block_faces((x0, HIGH - 0.15, z1), (x1, HIGH + 0.1, z1 + 0.1), tuple(FACES)),
            block_faces((x0, HIGH - 0.15, z0 - 0.1), (x1, HIGH + 0.1, z0), tuple(FACES))]
    room.add("posts_and_band", merged(*posts, *band), "facade", lightmap_scale=0.1)
    base = block_faces((-OUTER, -0.4, far - OUTER), (LONG + OUTER, -0.001, WIDE + OUTER),
                       ("-x", "+x", "-z", "+z", "-y"))
    room.add("base", base, "facade", lightmap_scale=0.1)


def plane(x0, x1, z0, z1, y, up):
    """A horizontal rectangle that looks up (1) or down (-1)."""
    positions = [(x0, y, z1), (x1, y, z1), (x1, y, z0), (x0, y, z0)]
    return positions, [(0, up, 0)] * 4, [(0, 1, 2), (0, 2, 3)] if up > 0 else [(0, 2, 1), (0, 3, 2)]


def add_trim(room):
    """Skirtings, the casing of the door and its open leaf."""
    high, deep = 0.09, 0.014
    x0, x1 = DOOR[:2]
    strips = [(0, WIDE / 2, deep, WIDE), (LONG, WIDE / 2, deep, WIDE), (LONG / 2, WIDE, LONG, deep),
              (x0 / 2 - 0.04, 0, x0 - 0.08, deep), ((x1 + LONG) / 2 + 0.04, 0, LONG - x1 - 0.08, deep)]
    room.add("skirting", merged(*[block((w + deep * (w == deep), high, d + deep * (d == deep)), (x, high / 2, z))
                                  for x, z, w, d in strips]),
             "paint_white", lightmap_scale=0.5)
    sides = [block((0.08, DOOR[3] + 0.08, PARTITION + 0.036), (x, (DOOR[3] + 0.08) / 2, -PARTITION / 2))
             for x in (x0 - 0.04, x1 + 0.04)]
    room.add("door_casing", merged(*sides,
                                   block((x1 - x0, 0.08, PARTITION + 0.036),
                                         ((x0 + x1) / 2, DOOR[3] + 0.04, -PARTITION / 2))),
             "paint_white", lightmap_scale=0.5)
    wide = x1 - x0 - 0.01
    leaf = merged(block((wide, DOOR[3] - 0.015, 0.04), (-wide / 2, DOOR[3] / 2, 0)),
                  *[block((0.56, 0.78, 0.052), (-wide / 2, y, 0)) for y in (0.56, 1.52)])
    hinge = room.node("door", None, (x1, 0, -PARTITION - 0.02),
                      rotation=[0, round(math.sin(math.radians(50)), 7), 0, round(math.cos(math.radians(50)), 7)])
    room.add("door_leaf", leaf, "paint_white", parent=hinge, lightmap_scale=0.5)
    furniture.add_door_handle(room, -wide + 0.07, 1.02, 0.02, parent=hinge)


def add_windows(room):
    for number, (z0, z1) in enumerate(WINDOWS):
        middle, wide, high, bar = (z0 + z1) / 2, z1 - z0, LINTEL - SILL, 0.055
        x, y = -OUTER * 0.6, (SILL + LINTEL) / 2
        frame = [block((0.06, high, bar), (x, y, middle + s * (wide - bar) / 2)) for s in (-1, 1)]
        frame += [block((0.06, bar, wide), (x, y + s * (high - bar) / 2, middle)) for s in (-1, 1)]
        frame += [block((0.05, high, bar), (x, y, middle)), block((0.035, 0.03, wide), (x, SILL + 0.66 * high, middle))]
        room.add(f"window_frame_{number}", merged(*frame), "paint_white", lightmap_scale=0.5)
        room.add(f"window_sill_{number}", block((0.24, 0.03, wide + 0.1), (0.0, SILL - 0.014, middle)), "paint_white",
                 lightmap_scale=0.6)
        room.node(f"window_{number}", None, (-OUTER / 2, y, middle), rotation=[0, 0.7071068, 0, 0.7071068],
                  extras={"portal": [round(wide, 6), round(high, 6)]})
        furniture.add_radiator(room, 0.075, middle, 0.96)
        furniture.add_curtain(room, f"curtain_{number}_left", 0.13, z0 - 0.1, 0.36)
        furniture.add_curtain(room, f"curtain_{number}_right", 0.13, z1 + 0.1, 0.36)
    furniture.add_curtain_rail(room, 0.13, sum(map(sum, WINDOWS)) / 4, 3.9)


def add_outside(room):
    lawn = horizontal_quad(60, 60)
    room.add("lawn", lawn, "lawn", (0, -0.4, 0), uv=3.0, lightmap_scale=0.04)
    room.add("hedge", block((1.0, 1.7, 40), (-12, 0.45, 0)), "hedge", uv=3.0, lightmap_scale=0.1)
    numbers = random.Random(3)
    crowns = []
    for _ in range(44):
        radius = numbers.uniform(0.9, 2.2)
        crown = furniture.stretched(sphere(1, 18, 11), (radius, radius * numbers.uniform(0.7, 1.1), radius))
        crowns.append(moved(crown, (numbers.uniform(-26, -17), numbers.uniform(0.2, 2.6), numbers.uniform(-16, 24))))
    room.add("trees", merged(*crowns), "hedge", uv=3.0, receive_gi="probes")


def add_furniture(room, has_screen):
    rug = horizontal_quad(2.7, 1.9)
    uvs = [(x / 2.7 + 0.5, z / 1.9 + 0.5) for x, _, z in rug[0]]
    room.add("rug", rug, "rug", (3.25, 0.008, 2.0), uvs=uvs, lightmap_scale=2)
    edge = block_faces((-1.35, -0.008, -0.95), (1.35, 0, 0.95), ("-x", "+x", "-z", "+z"))
    room.add("rug_edge", edge, "fabric_cream", (3.25, 0.008, 2.0), uv=0.06, receive_gi="probes")
    furniture.add_sofa(room, 3.05, 0.52)
    furniture.add_coffee_table(room, 3.1, 1.75)
    furniture.add_floor_lamp(room, 4.36, 0.36)
    furniture.add_bookshelf(room, 1.08, 0.155)
    furniture.add_plant(room, 0.42, 2.16)
    furniture.add_dining(room, 1.35, 3.35)
    furniture.add_sideboard(room, 5.76, 2.5)
    furniture.add_mirror(room, LONG - 0.014, 1.5, 2.5)
    furniture.add_pictures(room, [("hills", 0.9, 0.62, (2.72, 1.62, 0.016), 0),
                                  ("discs", 0.5, 0.62, (3.62, 1.62, 0.016), 0),
                                     ("corridor", 0.56, 0.7, (LONG - 0.016, 1.5, -0.77), -90)])
    add_corridor(room)
    furniture.add_moving(room)
    if has_screen:
        furniture.add_screen(room, 2.1, 4.2, -6)


def add_corridor(room):
    runner = horizontal_quad(2.6, 0.7)
    uvs = [(4 * (x / 2.6 + 0.5), z / 0.7 + 0.5) for x, _, z in runner[0]]
    room.add("runner", runner, "rug", (3.9, 0.006, -0.77), uvs=uvs)
    furniture.add_bench(room, 3.9, -CORRIDOR_DEEP - PARTITION + 0.2)


def add_lights_and_cameras(room):
    room.node("sun", None, (-8, 8, 4), rotation=look_rotation(SUN_DIRECTION),
              extensions={"KHR_lights_punctual": {"light": 0}})
    far = -CORRIDOR_DEEP - PARTITION
    for name, x0, x1, z0, z1 in (("room_reflections", 0, LONG, 0, WIDE),
                                 ("corridor_reflections", *CORRIDOR_X, far, -PARTITION)):
        place = ((x0 + x1) / 2, 1.35, (z0 + z1) / 2 + (0.5 if z1 > 1 else 0))
        center = [round(a - b, 6) + 0.0 for a, b in zip(((x0 + x1) / 2, HIGH / 2, (z0 + z1) / 2), place)]
        room.node(name, None, place, extras={"reflection_probe": {
            "size": [round(x1 - x0, 6), HIGH, round(z1 - z0, 6)], "center": center, "blend_distance": PARTITION}})
    add_camera(room, "camera", (5.55, 1.5, 4.3), (2.1, 0.95, 0.6), 54)
    add_camera(room, "camera_windows", (5.5, 1.45, 0.9), (1.2, 0.95, 2.9), 54)
    add_camera(room, "camera_corridor", (2.6, 1.5, -0.85), (5.3, 1.15, -0.35), 62)
    add_camera(room, "camera_table", (4.15, 1.02, 2.75), (3.1, 0.5, 1.5), 42)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", nargs="?", default=Path(__file__).with_name("room.glb"), type=Path, metavar="OUT.glb")
    parser.add_argument("--screen", action="store_true", help="a folding screen, lit by a proxy volume")
    options = parser.parse_args()
    room = Room()
    add_building(room)
    add_trim(room)
    add_windows(room)
    add_outside(room)
    add_furniture(room, options.screen)
    add_lights_and_cameras(room)
    options.out.write_bytes(room.glb())


if __name__ == "__main__":
    main()
