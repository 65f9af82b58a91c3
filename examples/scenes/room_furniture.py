# SPDX-License-Identifier: Apache-2.0
"""The furniture of make_room.py. Each function adds one piece to a Room; measures are in metres."""
import math
import random

from make_courtyard import sphere
from room_shapes import block, lathe, merged, moved, rod, rolled, sheet, smooth, soft_box, tilted

BOOKS = ("book_red", "book_blue", "book_cream", "book_green", "book_ochre", "book_black")


def add_sofa(room, x, z):
    """Three seats along X; the back is towards -Z."""
    room.add("sofa_frame", merged(soft_box((2.1, 0.22, 0.86), 0.05),
                                  moved(soft_box((2.1, 0.5, 0.2), 0.07), (0, 0.3, -0.33)),
                                  *[moved(soft_box((0.2, 0.36, 0.86), 0.07), (s * 0.95, 0.2, 0)) for s in (-1, 1)]),
             "fabric", (x, 0.27, z), uv=0.06, lightmap_scale=0.7)
    seat, back = soft_box((0.56, 0.15, 0.62), 0.06, 0.02), tilted(soft_box((0.56, 0.16, 0.42), 0.07, 0.03), 78)
    room.add("sofa_cushions", merged(*[moved(seat, (0.57 * i, 0, 0.06)) for i in (-1, 0, 1)],
                                     *[moved(back, (0.57 * i, 0.25, -0.17)) for i in (-1, 0, 1)]),
             "fabric", (x, 0.45, z), uv=0.06, lightmap_scale=0.7)
    pillow = tilted(soft_box((0.4, 0.1, 0.4), 0.045, 0.05), 66)
    room.add("pillow_cream", moved(pillow, (0, 0, 0), 16), "fabric_cream", (x - 0.66, 0.73, z + 0.05), uv=0.06,
             lightmap_scale=0.7)
    room.add("pillow_green", moved(pillow, (0, 0, 0), -12), "fabric_green", (x + 0.62, 0.73, z + 0.06), uv=0.06,
             lightmap_scale=0.7)
    feet = [block((0.05, 0.16, 0.05), (sx * 0.95, 0.08, sz * 0.36)) for sx in (-1, 1) for sz in (-1, 1)]
    room.add("sofa_feet", merged(*feet), "wood_dark", (x, 0, z), uv=0.5, lightmap_scale=0.5)


def add_coffee_table(room, x, z):
    room.add("coffee_table", soft_box((1.1, 0.035, 0.6), 0.012), "lacquer", (x, 0.4, z), uv=0.8, lightmap_scale=1.5)
    legs = [rod_between((sx * 0.48, 0, sz * 0.24), (sx * 0.42, 0.385, sz * 0.2), 0.014) for sx in (-1, 1)
            for sz in (-1, 1)]
    room.add("coffee_table_legs", merged(*legs), "brass", (x, 0, z), receive_gi="probes")
    room.add("magazines", merged(block((0.3, 0.012, 0.22), (0, 0.006, 0), 14),
                                 block((0.3, 0.012, 0.22), (0.01, 0.018, 0), 6)),
             "book_cream", (x - 0.28, 0.4175, z + 0.02), lightmap_scale=1)


def rod_between(a, b, radius):
    """A round bar from a to b, a below b."""
    offset = [q - p for p, q in zip(a, b)]
    length = math.sqrt(sum(c * c for c in offset))
    tilt = math.degrees(math.acos(offset[1] / length))
    turn = math.degrees(math.atan2(offset[0], offset[2]))
    return moved(tilted(rod(radius, length), tilt), [(p + q) / 2 for p, q in zip(a, b)], turn)


def add_dining(room, x, z):
    """A round table with two chairs and a lamp above it; one chair moves."""
    room.add("dining_table", merged(moved(rod(0.5, 0.03, 48), (0, 0.735, 0)), moved(rod(0.035, 0.7), (0, 0.37, 0)),
                                    moved(rod(0.26, 0.02, 32), (0, 0.01, 0))), "wood_walnut", (x, 0, z), uv=0.8)
    add_chair(room, "chair", x + 0.08, z - 0.62, 172)
    add_chair(room, "chair_moving", x + 0.72, z + 0.12, 80, moves=True)
    shade = [(0.2, 0), (0.19, 0.03), (0.16, 0.09), (0.1, 0.15), (0.04, 0.18), (0.025, 0.22)]
    room.add("pendant_shade", merged(lathe(shade, 40), moved(rod(0.004, 0.96), (0, 0.7, 0))), "copper", (x, 1.52, z),
             receive_gi="probes")
    room.add("pendant_inside", lathe([(r - 0.004, y) for r, y in shade[::-1]], 40), "shade_inside", (x, 1.52, z),
             receive_gi="probes")
    room.add("pendant_bulb", sphere(0.045, 24, 12), "bulb_pendant", (x, 1.6, z), receive_gi="probes")
    room.lamp("pendant", (x, 1.5, z), cone=75)


def add_chair(room, name, x, z, turn, moves=False):
    legs = [rod_between((sx * 0.2, 0, sz * 0.19), (sx * 0.16, 0.44, sz * 0.15), 0.014) for sx in (-1, 1)
            for sz in (-1, 1)]
    posts = [rod_between((sx * 0.17, 0.44, -0.17), (sx * 0.18, 0.8, -0.23), 0.012) for sx in (-1, 1)]
    seat = moved(soft_box((0.42, 0.03, 0.4), 0.012), (0, 0.45, 0))
    rest = sheet(12, 6, lambda u, v: [0.2 * (2 * u - 1), 0.66 + 0.16 * v,
                                      -0.23 - 0.04 * math.sin(math.pi * u) - 0.02 * v])
    back = ([[a, b, c - 0.015] for a, b, c in rest[0]], [[-a for a in n] for n in rest[1]], [t[::-1] for t in rest[2]])
    room.add(name, moved(merged(seat, *legs, *posts, rest, back), turn=turn), "wood_ash", (x, 0, z), uv=0.6,
             moves=moves,
             lightmap_scale=0.8)


def add_bookshelf(room, x, z):
    """Against a wall at -Z of it; 1.3 m wide."""
    wide, high, deep, board = 1.3, 2.1, 0.3, 0.025
    levels = [0.06 + i * 0.405 for i in range(6)]
    parts = [block((board, high, deep), (s * (wide - board) / 2, high / 2, 0)) for s in (-1, 1)]
    parts += [block((wide - 2 * board, board, deep), (0, y, 0)) for y in levels]
    parts.append(block((wide - 2 * board, high - 0.06, 0.01), (0, high / 2 + 0.03, -deep / 2 + 0.005)))
    room.add("bookshelf", merged(*parts), "wood_walnut", (x, 0, z), uv=0.8)
    add_books(room, x, z, levels[:5], wide / 2 - board)


def add_books(room, x, z, levels, half_wide):
    numbers = random.Random(5)
    books = {material: [] for material in BOOKS}
    for number, level in enumerate(levels):
        at, end = -half_wide + 0.02, half_wide - numbers.uniform(0.05, 0.5) if number else half_wide - 0.05
        while at < end - 0.06:
            thick, tall, deep = numbers.uniform(0.018, 0.05), numbers.uniform(0.19, 0.31), numbers.uniform(0.15, 0.2)
            books[BOOKS[numbers.randrange(len(BOOKS))]].append(
                block((thick, tall, deep), (at + thick / 2, level + 0.0126 + tall / 2, -0.03 - 0.5 * (0.2 - deep))))
            at += thick + 0.0015
    for material, blocks in books.items():
        room.add(material + "s", merged(*blocks), material, (x, 0, z), receive_gi="probes")


def add_floor_lamp(room, x, z):
    room.add("floor_lamp", merged(moved(rod(0.15, 0.02, 32), (0, 0.01, 0)), moved(rod(0.011, 1.26), (0, 0.64, 0))),
             "brass",
             (x, 0, z), receive_gi="probes")
    side = [(0.2, 0.0), (0.15, 0.3)]
    room.add("floor_lamp_shade", lathe(side, 40), "shade", (x, 1.3, z))
    room.lamp("floor_lamp", (x, 1.43, z))


def add_curtain(room, name, x, z, wide, turn=90):
    """Folds of linen along Z, from the rail to the floor; drawn on both sides."""
    def place(u, v):
        fold = 0.03 * math.sin(2 * math.pi * u * 5.0 + 0.6 * v) * (0.45 + 0.55 * (1 - v))
        return [wide * (u - 0.5), 0.02 + 2.43 * v, fold]

    room.add(name, moved(sheet(60, 8, place), turn=turn), "linen", (x, 0, z), receive_gi="probes")


def add_plant(room, x, z):
    room.add("pot", lathe([(0, 0), (0.13, 0), (0.17, 0.3), (0.185, 0.3), (0.185, 0.33), (0.165, 0.33), (0.155, 0.27),
                           (0, 0.27)], 36),
             "terracotta", (x, 0, z), uv=0.5)
    numbers = random.Random(9)
    leaves = [leaf(numbers.uniform(0.45, 0.95), numbers.uniform(18, 62), 137.5 * i + numbers.uniform(-12, 12), 0.05)
              for i in range(17)]
    room.add("plant", merged(*leaves), "leaf", (x, 0.27, z), receive_gi="probes")


def leaf(length, lean, turn, width):
    """A long blade that bends down towards its tip."""
    def place(u, v):
        angle = math.radians(lean * (0.35 + 1.3 * v))
        out, up = length * v * math.sin(angle), length * v * math.cos(angle * 0.8)
        half = width * math.sin(math.pi * min(1, 0.12 + 0.88 * v)) ** 0.7
        side = 2 * u - 1
        return [half * side, up + 0.25 * half * abs(side), out]

    return moved(sheet(4, 10, place), turn=turn)


def add_pictures(room, places):
    """(name, width, height, centre, turn): a framed painting that looks towards +Z before it is turned."""
    for name, wide, high, center, turn in places:
        bar = 0.03
        frame = merged(*[block((wide + 2 * bar, bar, 0.03), (0, s * (high + bar) / 2, 0)) for s in (-1, 1)],
                       *[block((bar, high, 0.03), (s * (wide + bar) / 2, 0, 0)) for s in (-1, 1)])
        room.add(f"frame_{name}", moved(frame, turn=turn), "wood_dark", center, uv=0.5, lightmap_scale=0.5)
        canvas = ([(-wide / 2, -high / 2, 0), (wide / 2, -high / 2, 0), (wide / 2, high / 2, 0),
                   (-wide / 2, high / 2, 0)],
                  [(0, 0, 1)] * 4, [(0, 1, 2), (0, 2, 3)])
        room.add(f"picture_{name}", moved(canvas, turn=turn), f"picture_{name}", center,
                 uvs=[(0, 1), (1, 1), (1, 0), (0, 0)])


def add_mirror(room, x, y, z):
    """A round mirror on a wall that looks towards -X."""
    disc = tilted(rod(0.36, 0.012, 64), 90)
    ring = tilted(lathe([(0.36, -0.012), (0.385, -0.012), (0.385, 0.012), (0.36, 0.012)], 64), 90)
    room.add("mirror", moved(disc, turn=-90), "mirror", (x, y, z), receive_gi="probes")
    room.add("mirror_ring", moved(ring, turn=-90), "brass", (x, y, z), receive_gi="probes")


def add_sideboard(room, x, z):
    """On four legs along Z, against a wall at +X of it."""
    room.add("sideboard", merged(block((0.42, 0.5, 1.5), (0, 0.43, 0))), "wood_walnut", (x, 0, z), uv=0.8)
    doors = [block((0.014, 0.46, 0.485), (-0.215, 0.43, 0.495 * i)) for i in (-1, 0, 1)]
    room.add("sideboard_doors", merged(*doors), "wood_walnut", (x, 0, z), uv=0.8)
    knobs = [moved(sphere(0.014, 16, 8), (-0.236, 0.5, 0.495 * i + 0.17)) for i in (-1, 0, 1)]
    room.add("sideboard_knobs", merged(*knobs), "brass", (x, 0, z), receive_gi="probes")
    legs = [block((0.035, 0.18, 0.035), (sx * 0.17, 0.09, sz * 0.68)) for sx in (-1, 1) for sz in (-1, 1)]
    room.add("sideboard_legs", merged(*legs), "wood_dark", (x, 0, z), uv=0.5, lightmap_scale=0.5)


def add_radiator(room, x, z, wide):
    ribs = [block((0.05, 0.5, 0.045), (0, 0.37, 0.06 * i - wide / 2 + 0.03)) for i in range(round(wide / 0.06))]
    room.add(f"radiator_{round(10 * z)}", merged(*ribs, block((0.03, 0.44, wide - 0.02), (0, 0.37, 0))), "paint_white",
             (x, 0, z), receive_gi="probes")


def add_moving(room):
    """Things that move: probes light them, and the bake does not see them."""
    vase = [(0, 0), (0.05, 0), (0.075, 0.05), (0.08, 0.1), (0.055, 0.17), (0.03, 0.22), (0.035, 0.25), (0.028, 0.25),
            (0.022, 0.21),
            (0, 0.2)]
    room.add("vase", lathe(fine(vase), 40), "ceramic", (3.32, 0.4175, 1.78), moves=True)
    room.add("ball", sphere(0.19, 48, 24), "ball", (4.1, 0.19, 2.62), moves=True)
    room.add("ball_chrome", sphere(0.1, 48, 24), "chrome", (2.2, 0.1, 2.7), moves=True)
    bowl = [(0, 0), (0.06, 0), (0.11, 0.03), (0.145, 0.075), (0.14, 0.077), (0.1, 0.04), (0.05, 0.014), (0, 0.012)]
    room.add("bowl", lathe(fine(bowl), 40), "copper", (1.42, 0.75, 3.36), moves=True)
    add_figure(room, "figure", 5.02, 0.42, 14)


def fine(profile):
    """The profile with points between, on a curve."""
    points = []
    for i in range(len(profile) - 1):
        p0, p1, p2, p3 = (profile[min(max(i + k, 0), len(profile) - 1)] for k in (-1, 0, 1, 2))
        for k in range(4):
            t = k / 4
            radius, y = (b + 0.5 * ((c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t
                                    + (3 * b - a - 3 * c + d) * t ** 3)
                         for a, b, c, d in zip(p0, p1, p2, p3))
            points.append((max(0.0, radius), y))
    points.append(profile[-1])
    return points


def add_figure(room, name, x, z, turn):
    """A jointed figure of wood, 1.7 m tall, as artists use for poses."""
    def limb(a, b, thick_a, thick_b):
        """A tapered limb from a (top) down to b."""
        length = math.dist(a, b)
        steps = [(0.0, 0.0)] + [((thick_b + (thick_a - thick_b) * t) * math.sin(math.pi * (0.08 + 0.84 * t)) ** 0.35,
                                 length * t)
                                for t in (i / 10 for i in range(11))] + [(0.0, length)]
        offset = [p - q for p, q in zip(a, b)]
        tilt = math.degrees(math.acos(offset[1] / length))
        return moved(tilted(lathe(steps, 20), tilt), b, math.degrees(math.atan2(offset[0], offset[2])))

    def joint(p, radius):
        return moved(sphere(radius, 20, 12), p)

    parts = [moved(stretched(sphere(1, 32, 20), (0.08, 0.12, 0.095)), (0, 1.58, 0.01)),
             limb((0, 1.48, 0), (0, 1.36, 0), 0.045, 0.045),
             moved(lathe(fine([(0, -0.2), (0.07, -0.19), (0.1, -0.1), (0.145, 0.05), (0.15, 0.12), (0.1, 0.18),
                               (0, 0.19)]), 32), (0, 1.24, 0)),
             joint((0, 1.03, 0), 0.075),
             moved(lathe(fine([(0, -0.12), (0.08, -0.115), (0.13, -0.04), (0.115, 0.05), (0.07, 0.09), (0, 0.095)]),
                         32), (0, 0.94, 0))]
    for side in (-1, 1):
        shoulder, elbow = (side * 0.19, 1.35, 0), (side * 0.25, 1.08, 0.02 - 0.05 * side)
        hand = (side * 0.24, 0.83, 0.12 - 0.06 * side)
        hip, knee = (side * 0.09, 0.9, 0), (side * 0.1, 0.49, 0.03 + 0.05 * side)
        foot = (side * 0.11, 0.07, 0.09 * side - 0.02)
        parts += [joint(shoulder, 0.055), limb(shoulder, elbow, 0.05, 0.042), joint(elbow, 0.042),
                  limb(elbow, hand, 0.042, 0.03),
                  moved(stretched(sphere(1, 20, 12), (0.03, 0.075, 0.045)), (hand[0], hand[1] - 0.07, hand[2] + 0.01)),
                  limb(hip, knee, 0.085, 0.06), joint(knee, 0.058), limb(knee, foot, 0.06, 0.038),
                  moved(stretched(sphere(1, 20, 12), (0.05, 0.05, 0.13)), (foot[0], 0.05, foot[2] + 0.05))]
    room.add(name, moved(merged(*parts), turn=turn), "wood_figure", (x, 0, z), uv=0.6, moves=True)


def stretched(shape, factors):
    return smooth([[c * f for c, f in zip(p, factors)] for p in shape[0]], shape[2])


def add_bench(room, x, z):
    """A low bench with a cushion, along X."""
    room.add("bench", soft_box((1.1, 0.04, 0.34), 0.012), "wood_ash", (x, 0.42, z), uv=0.6)
    room.add("bench_cushion", soft_box((1.0, 0.06, 0.32), 0.025, 0.01), "fabric_green", (x, 0.47, z), uv=0.06)
    legs = [block((0.04, 0.4, 0.04), (sx * 0.48, 0.2, sz * 0.12)) for sx in (-1, 1) for sz in (-1, 1)]
    room.add("bench_legs", merged(*legs), "wood_ash", (x, 0, z), uv=0.6, lightmap_scale=0.5)


def add_screen(room, x, z, turn):
    """A folding screen of three panels: large, and it moves. Its light comes from a grid around it."""
    canvas, frames = [], []
    for i, fold in enumerate((14, -14, 14)):
        offset = (0.72 * (i - 1), 0, 0.085 if i == 1 else 0.085)
        canvas.append(moved(block((0.64, 1.62, 0.012), (0, 0.92, 0)), offset, fold))
        frames += [moved(block((0.045, 1.8, 0.03), (s * 0.34, 0.9, 0)), offset, fold) for s in (-1, 1)]
        frames += [moved(block((0.64, 0.05, 0.03), (0, y, 0)), offset, fold) for y in (0.1, 1.75)]
    parent = room.node("screen", None, (x, 0, z), extras={"contribute_gi": False, "light_probes": "proxy_volume"})
    room.add("screen_canvas", moved(merged(*canvas), turn=turn), "canvas", (0, 0, 0), parent=parent)
    room.add("screen_frames", moved(merged(*frames), turn=turn), "wood_dark", (0, 0, 0), uv=0.5, parent=parent)


def add_curtain_rail(room, x, z, wide):
    rail = tilted(rod(0.012, wide), 90)
    ends = [moved(sphere(0.022, 20, 12), (0, 0, s * wide / 2)) for s in (-1, 1)]
    room.add("curtain_rail", merged(rail, *ends), "brass", (x, 2.47, z), receive_gi="probes")


def add_door_handle(room, x, y, z, parent=None):
    bar = moved(rolled(rod(0.009, 0.12)), (-0.05, 0, 0.045))
    neck = moved(tilted(rod(0.01, 0.045), 90), (0, 0, 0.022))
    room.add("door_handle", merged(bar, neck), "chrome", (x, y, z), parent=parent, receive_gi="probes")
