# SPDX-License-Identifier: Apache-2.0
"""Shapes of make_room.py. Each function returns (positions, normals, triangles), like those of make_courtyard.py."""
import math

from make_courtyard import box_faces, cross, normalized, rounded, turned


def moved(shape, offset=(0, 0, 0), turn=0):
    """The shape turned about Y by degrees, then moved."""
    positions, normals, triangles = shape
    return ([[c + o for c, o in zip(turned(p, turn), offset)] for p in positions],
            [rounded(turned(n, turn)) for n in normals], triangles)


def tilted(shape, degrees):
    """The shape turned about X: +Y goes towards +Z."""
    s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))

    def tilt(v):
        return [v[0], c * v[1] - s * v[2], s * v[1] + c * v[2]]

    return [tilt(p) for p in shape[0]], [rounded(tilt(n)) for n in shape[1]], shape[2]


def rolled(shape):
    """The shape with +Y turned to +X."""
    return ([[p[1], -p[0], p[2]] for p in shape[0]], [[n[1], -n[0], n[2]] for n in shape[1]], shape[2])


def merged(*shapes):
    positions, normals, triangles = [], [], []
    for p, n, t in shapes:
        first = len(positions)
        positions += p
        normals += n
        triangles += [tuple(first + i for i in corner) for corner in t]
    return positions, normals, triangles


def block(size, center=(0, 0, 0), turn=0):
    return moved(box_faces(size), center, turn)


def smooth(positions, triangles):
    """The shape with normals that are means of the triangles around each position, by area."""
    sums = {}
    keys = [tuple(round(c, 5) for c in p) for p in positions]
    for corners in triangles:
        a, b, c = (positions[i] for i in corners)
        area = cross([q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)])
        for i in corners:
            sums[keys[i]] = [s + x for s, x in zip(sums.get(keys[i], (0, 0, 0)), area)]
    return positions, [rounded(normalized(sums[key])) for key in keys], triangles


def sheet(columns, rows, place):
    """A surface of quads; place(u, v) is the position at u and v from 0 to 1. Front is where u × v points to."""
    positions = [place(i / columns, j / rows) for j in range(rows + 1) for i in range(columns + 1)]
    triangles = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b = a + columns + 1
            triangles += [(a, a + 1, b + 1), (a, b + 1, b)]
    used = [t for t in triangles if len({tuple(rounded(positions[i])) for i in t}) == 3]
    kept = sorted({i for t in used for i in t})
    new = {old: i for i, old in enumerate(kept)}
    return smooth([list(positions[i]) for i in kept], [tuple(new[i] for i in t) for t in used])


def lathe(profile, segments=32):
    """The surface that a profile of (radius, y) sweeps about Y, from bottom to top for an outside."""
    def place(u, v):
        radius, y = profile[round(v * (len(profile) - 1))]
        angle = 2 * math.pi * (round(u * segments) % segments) / segments
        return [radius * math.sin(angle), y, radius * math.cos(angle)]

    return sheet(segments, len(profile) - 1, place)


def soft_box(size, radius, puff=0.0, steps=3):
    """A box with round edges; its large faces bulge by `puff` metres along Y."""
    half = [s / 2 for s in size]
    parts = []
    for normal in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)):
        axis = next(i for i in range(3) if normal[i])
        u_axis, v_axis = (axis + 1) % 3, (axis + 2) % 3
        if sum(normal) < 0:
            u_axis, v_axis = v_axis, u_axis
        us, vs = _soft_lines(half[u_axis], radius, steps), _soft_lines(half[v_axis], radius, steps)

        def place(u, v):
            on_face = [0.0, 0.0, 0.0]
            on_face[axis] = normal[axis] * half[axis]
            on_face[u_axis] = us[round(u * (len(us) - 1))]
            on_face[v_axis] = vs[round(v * (len(vs) - 1))]
            inner = [min(h - radius, max(radius - h, c)) for c, h in zip(on_face, half)]
            away = normalized([c - i for c, i in zip(on_face, inner)])
            position = [i + radius * a for i, a in zip(inner, away)]
            share = (1 - (position[0] / half[0]) ** 2) * (1 - (position[2] / half[2]) ** 2)
            position[1] += math.copysign(puff, position[1]) * share if abs(position[1]) > 1e-9 else 0.0
            return position

        parts.append(sheet(len(us) - 1, len(vs) - 1, place)[::2])
    joined = merged(*[(p, p, t) for p, t in parts])
    return smooth(joined[0], joined[2])


def _soft_lines(half, radius, steps):
    """Coordinates across a face: fine at the round edges, and a few between them."""
    edge = [half - radius + radius * math.tan(math.pi / 4 * k / steps) for k in range(steps + 1)]
    inner = [(half - radius) * (2 * k / 6 - 1) for k in range(1, 6)]
    return [-c for c in reversed(edge)] + inner + edge


def rod(radius, length, segments=16):
    """A closed cylinder about the origin along Y."""
    h = length / 2
    flat = [[(0, -h), (radius, -h)], [(radius, -h), (radius, h)], [(radius, h), (0, h)]]
    return merged(*[lathe(profile, segments) for profile in flat])


def wall(length, height, thickness, holes=()):
    """The faces of a wall along +X from the origin, up +Y: (front at z = thickness, back at z = 0, rims).

    Holes are (x0, x1, y0, y1). Front and back are one mesh each, so that a lightmap has no seams on them.
    """
    xs = sorted({0, length, *(c for hole in holes for c in hole[:2])})
    ys = sorted({0, height, *(c for hole in holes for c in hole[2:])})

    def in_hole(x, y):
        return any(x0 < x < x1 and y0 < y < y1 for x0, x1, y0, y1 in holes)

    def face(z, normal):
        positions = [(x, y, z) for y in ys for x in xs]
        triangles = []
        for j in range(len(ys) - 1):
            for i in range(len(xs) - 1):
                if in_hole((xs[i] + xs[i + 1]) / 2, (ys[j] + ys[j + 1]) / 2):
                    continue
                a, b = j * len(xs) + i, (j + 1) * len(xs) + i
                quad = (a, a + 1, b + 1, b) if normal > 0 else (a, b, b + 1, a + 1)
                triangles += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
        used = sorted({i for t in triangles for i in t})
        new = {old: i for i, old in enumerate(used)}
        return [positions[i] for i in used], [(0, 0, normal)] * len(used), [tuple(new[i] for i in t) for t in triangles]

    def rim(x0, x1, y0, y1, faces):
        return block_faces((x0, y0, 0), (x1, y1, thickness), faces)

    rims = [rim(0, length, 0, height, ("-x", "+x"))]
    for hole in holes:
        inside = rim(*hole, ("-x", "+x", "-y", "+y") if hole[2] > 0 else ("-x", "+x", "+y"))
        rims.append((inside[0], [[-c for c in n] for n in inside[1]], [t[::-1] for t in inside[2]]))
    return face(thickness, 1), face(0, -1), merged(*rims)


def block_faces(low, high, faces):
    size = [h - l for l, h in zip(low, high)]
    return moved(box_faces(size, faces), [(l + h) / 2 for l, h in zip(low, high)])


def planar_uvs(shape, metres):
    """Texture coordinates by projection along the main axis of each normal; the texture is `metres` wide."""
    uvs = []
    for p, n in zip(shape[0], shape[1]):
        axis = max(range(3), key=lambda i: abs(n[i]))
        u, v = ((p[2], p[1]), (p[0], p[2]), (p[0], p[1]))[axis]
        uvs.append((round(u / metres, 6), round(-v / metres, 6)))
    return uvs
