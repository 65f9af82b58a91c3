# SPDX-License-Identifier: Apache-2.0
"""The textures of make_room.py as PNG files: the same bytes on every run, with the standard library alone."""
import math
import random
import struct
import zlib

WEAVE = 64


def png(width, height, kind, rows, palette=None):
    """A PNG of one stored block, since the bytes that compressors write differ from one zlib to the next."""
    data = b"".join(b"\0" + bytes(row) for row in rows)
    blocks = [data[i:i + 65535] for i in range(0, len(data), 65535)]
    stream = b"\x78\x01" + b"".join(
        struct.pack("<BHH", block is blocks[-1], len(block), len(block) ^ 0xFFFF) + block for block in blocks)
    stream += struct.pack(">I", zlib.adler32(data))

    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    header = struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0)
    colors = chunk(b"PLTE", bytes(c for color in palette for c in color)) if palette else b""
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + colors + chunk(b"IDAT", stream) + chunk(b"IEND", b"")


def ramp_png(rows, colors):
    """An image of numbers from 0 to 1, which become sRGB colours along a ramp of bytes."""
    palette = []
    for i in range(256):
        at = i / 255 * (len(colors) - 1)
        k = min(int(at), len(colors) - 2)
        palette.append([round(a + (b - a) * (at - k)) for a, b in zip(colors[k], colors[k + 1])])
    indices = [[min(255, max(0, round(255 * t))) for t in row] for row in rows]
    return png(len(rows[0]), len(rows), 3, indices, palette)


def normal_png(heights, strength):
    """The normal map of heights that tile; `strength` is the slope of a step of 1 from texel to texel."""
    size, rows = len(heights), []
    for y in range(size):
        row = []
        for x in range(size):
            # Green points up in the image, and rows go down.
            slope_x = strength * (heights[y][(x + 1) % size] - heights[y][x - 1]) / 2
            slope_y = strength * (heights[y - 1][x] - heights[(y + 1) % size][x]) / 2
            scale = 127 / math.sqrt(1 + slope_x * slope_x + slope_y * slope_y)
            row += [round(128 - scale * slope_x), round(128 - scale * slope_y), round(128 + scale)]
        rows.append(row)
    return png(size, size, 2, rows)


def noise(size, cells_x, cells_y, seed):
    """Smooth values from 0 to 1 that tile."""
    numbers = random.Random(seed)
    lattice = [[numbers.random() for _ in range(cells_x)] for _ in range(cells_y)]

    def steps(cells):
        for i in range(size):
            at = i * cells / size
            t = at - int(at)
            yield int(at), (int(at) + 1) % cells, t * t * (3 - 2 * t)

    columns = list(steps(cells_x))
    rows = []
    for y0, y1, v in steps(cells_y):
        line = [a + (b - a) * v for a, b in zip(lattice[y0], lattice[y1])]
        rows.append([line[a] + (line[b] - line[a]) * u for a, b, u in columns])
    return rows


def mixed(*parts):
    """The sum of images, each with a weight."""
    return [[sum(w * v for (w, _), v in zip(parts, values)) for values in zip(*(image[y] for _, image in parts))]
            for y in range(len(parts[0][1]))]


BOARD_ROWS = 16  # of a tile of the floor


def boards(size):
    """(tone, gap) of each texel of a floor of boards along x: tone from 0 to 1, gap 1 in the joints."""
    numbers = random.Random(7)
    starts = [numbers.randrange(size) for _ in range(BOARD_ROWS)]
    tones = [[numbers.random() for _ in range(2)] for _ in range(BOARD_ROWS)]
    joint = max(1, size // 512)
    for y in range(size):
        row, inside = divmod(y * BOARD_ROWS, size)
        is_side = inside < joint * BOARD_ROWS
        yield [(tones[row][2 * ((x + starts[row]) % size) // size],
                1.0 if is_side or (x + starts[row]) % (size // 2) < joint else 0.0) for x in range(size)]


def grain(size, seed):
    return mixed((0.5, noise(size, 4, size // 8, seed)), (0.3, noise(size, 8, size // 4, seed + 1)),
                 (0.2, noise(size, 3, 12, seed + 2)))


def floor_png(size=512):
    rows = [[(0.2 + 0.45 * tone + 0.45 * (g - 0.5)) * (1 - 0.75 * gap) for (tone, gap), g in zip(line, grains)]
            for line, grains in zip(boards(size), grain(size, 1))]
    return ramp_png(rows, [(58, 40, 28), (136, 103, 74), (168, 134, 100), (192, 160, 124)])


def floor_normal_png(size=256):
    heights = [[0.25 * g - 0.8 * gap for (_, gap), g in zip(line, grains)]
               for line, grains in zip(boards(size), grain(size, 1))]
    return normal_png(heights, 0.35)


def wood_png(size=128):
    """Grain alone, for furniture: its materials scale the colour."""
    return ramp_png(grain(size, 11), [(178, 158, 138), (236, 222, 206), (255, 250, 244)])


def plaster_normal_png(size=256):
    return normal_png(mixed((0.6, noise(size, 20, 20, 21)), (0.3, noise(size, 48, 48, 22)),
                            (0.1, noise(size, 96, 96, 23))), 0.8)


def weave_normal_png(size=WEAVE, threads=8):
    period = size // threads

    def height(x, y):
        over = (x // period + y // period) % 2
        a, b = (x, y) if over else (y, x)
        along, across = (math.sin(math.pi * (c % period + 0.5) / period) for c in (a, b))
        return along * (0.6 + 0.4 * across)

    return normal_png([[height(x, y) for x in range(size)] for y in range(size)], 1.1)


def rug_png(size=256):
    """Two borders and a field of diamonds; the ramp goes from deep blue over red to cream."""
    pile = mixed((0.7, noise(size, 128, 128, 31)), (0.3, noise(size, 32, 32, 32)))

    def tone(x, y):
        edge = min(x, y, size - 1 - x, size - 1 - y) / size
        if edge < 0.03 or 0.09 < edge < 0.105:
            return 0.9
        if edge < 0.09:
            return 0.1 if (x + y) // 8 % 3 else 0.75
        u, v = (x - size / 2) / (size / 8), (y - size / 2) / (size / 8)
        diamond = abs((u % 1) - 0.5) + abs((v % 1) - 0.5)
        if diamond < 0.16:
            return 0.9
        return 0.52 if diamond < 0.34 else 0.4 if (int(u + 64) + int(v + 64)) % 2 else 0.14

    rows = [[tone(x, y) + 0.10 * (pile[y][x] - 0.5) for x in range(size)] for y in range(size)]
    return ramp_png(rows, [(40, 46, 62), (66, 70, 86), (128, 56, 46), (146, 72, 56), (206, 192, 166), (218, 206, 184)])


def picture_png(number, size=128):
    """An abstract painting: hills under a round sun, or discs."""
    numbers = random.Random(40 + number)
    waves = [(numbers.uniform(1, 3), numbers.uniform(0, 6.3), numbers.uniform(0.03, 0.08)) for _ in range(4)]
    canvas = noise(size, 64, 64, 50 + number)

    def hills(x, y):
        tone = 0.95 - 0.2 * y
        if math.hypot(x - 0.66, y - 0.3) < 0.13:
            tone = 0.62
        for i, (turns, phase, height) in enumerate(waves):
            if y > 0.42 + 0.13 * i + height * math.sin(turns * 3 * x + phase):
                tone = 0.5 - 0.14 * i
        return tone

    def discs(x, y):
        tone = 0.92
        for i, (cx, cy, r) in enumerate(((0.4, 0.36, 0.25), (0.62, 0.56, 0.22), (0.36, 0.7, 0.14))):
            if math.hypot(x - cx, y - cy) < r:
                tone = (0.28, 0.62, 0.05)[i]
        return tone

    paint = hills if number == 0 else discs
    rows = [[paint(x / size, y / size) + 0.04 * (canvas[y][x] - 0.5) for x in range(size)] for y in range(size)]
    return ramp_png(rows, [(30, 44, 58), (52, 96, 104), (104, 136, 120), (214, 110, 62), (232, 214, 180),
                           (238, 230, 214)])


def leaves_png(size=128):
    """The outside: a hedge and a lawn."""
    return ramp_png(mixed((0.45, noise(size, 12, 12, 61)), (0.35, noise(size, 32, 32, 62)),
                          (0.2, noise(size, 64, 64, 63))),
                    [(70, 78, 52), (150, 160, 110), (236, 240, 190)])


TEXTURES = {  # name: what writes it
    "floor": floor_png,
    "floor_normal": floor_normal_png,
    "wood": wood_png,
    "plaster_normal": plaster_normal_png,
    "weave_normal": weave_normal_png,
    "rug": rug_png,
    "picture_hills": lambda: picture_png(0),
    "picture_discs": lambda: picture_png(1),
    "leaves": leaves_png,
}
