# SPDX-License-Identifier: Apache-2.0
"""Reads `.probes` files and queries them, in Python's standard library alone.

    volume = ProbeVolume(Path("courtyard.probes").read_bytes())
    answer = volume.query((1.0, 1.5, 2.0))
    answer.irradiance((0.0, 1.0, 0.0))

It is written from docs/how_to_query.md and docs/file_format.md, not from the sources of the library. Its test shows
that these pages suffice. Its functions follow the sections of the first page. It is slow: each number is a Python
object.

Counts, sizes and indices are checked when a file is opened. Checksums are not: the standard library has no xxh3.
"""
import functools
import math
import struct
from array import array
from dataclasses import dataclass

NONE = 2**32 - 1
TINY = 2.0**-126
# Corners of the hull move along their rays up to this many sizes of the cell.
LONGEST_RAY = 2.0**20
INFO = struct.Struct("<3d3dd3dIIf27fff")
# The struct format of the elements that queries need.
FORMATS = {
    "positions": "<3f",
    "cells": "<8I",
    "hull_rays": "<9f",
    "seeds": "<QII",
    "seed_grid": "<I",
    "visibility_blocks": "<II",
    "cell_visibility": "<12BH",
    "compact": "<32e",
    "irradiance": "<27f",
    "occlusion": "<4f",
    "rendering_layers": "<I",
    "layers": "<2f27f3I",
    "layer_irradiance": "<27f",
}


# Vectors are tuples of three numbers.


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scaled(a, factor):
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def to_floats(numbers):
    """The nearest 32-bit floats, as a tuple."""
    return tuple(array("f", numbers))


def to_half(number):
    """The nearest 16-bit float."""
    return struct.unpack("<e", struct.pack("<e", number))[0]


@dataclass(frozen=True)
class Options:
    """Options of a query, with the names and values of the conformance vectors."""

    precision: str = "half"
    outside: str = "extrapolate"
    fade_distance: float = 10.0
    walls: str = "hide"
    rendering_layers: int = NONE
    radius: float = 0.0
    normal_offset: float = 0.0
    layer_weights: tuple = ()


@dataclass(frozen=True)
class Location:
    """A cell, the weights of its four corners and the fraction of ambient light. Without a cell it is all ambient."""

    cell: int | None = None
    weights: tuple = (0.0, 0.0, 0.0, 0.0)
    ambient: float = 1.0


@dataclass(frozen=True)
class Answer:
    """The light of a position: nine coefficients of R, G and B, and four channels of occlusion."""

    location: Location
    probes: tuple
    weights: tuple
    coefficients: tuple
    occlusion: tuple

    def irradiance(self, normal):
        """RGB irradiance of a surface with this unit normal."""
        x, y, z = normal
        basis = (
            0.28209479177387814,
            0.48860251190291992 * y,
            0.48860251190291992 * z,
            0.48860251190291992 * x,
            1.09254843059207907 * x * y,
            1.09254843059207907 * y * z,
            0.31539156525252001 * (3 * z * z - 1),
            1.09254843059207907 * x * z,
            0.54627421529603953 * (x * x - y * y),
        )
        return tuple(sum(c[channel] * y_i for c, y_i in zip(self.coefficients, basis)) for channel in range(3))


def read_sections(data):
    """The bytes of each section of a file by its name, with the size of an element."""
    if len(data) < 64 or data[:8] != b"TETRAPV\n":
        raise ValueError("the file does not begin with TETRAPV")
    version, count, size = struct.unpack_from("<IIQ", data, 8)
    if version != 1:
        raise ValueError(f"the version of the file is {version}, not 1")
    if count > 1024 or size != len(data) or 64 + 64 * count > size:
        raise ValueError(f"the file has {len(data)} bytes; its header says {size}, and {count} sections")
    sections = {}
    for i in range(count):
        name, offset, elements, element_size = struct.unpack_from("<24sQQQ", data, 64 + 64 * i)
        name = name.rstrip(b"\0").decode()
        place = f"{elements} elements of {element_size} bytes at {offset}"
        if offset % 64 or offset + elements * element_size > size:
            raise ValueError(f"section {name}: {place} are not in the file")
        sections[name] = (data[offset : offset + elements * element_size], element_size)
    return sections


def first_crossing(c, has_area):
    """The first t at which the moved face reaches the position, whose side is f(t) = c0 + c1 t + c2 t² + c3 t³.

    `has_area` is false for a face that has no area at t = 0. None if there is none.
    """

    def f(t):
        return c[0] + t * (c[1] + t * (c[2] + t * c[3]))

    extrema = [t for t in quadratic_roots(3 * c[3], c[2], c[1]) if t > 0]
    if c[0] > 0:
        begin = 0.0
    elif c[0] == 0 and has_area:
        return 0.0
    else:
        begin = max(extrema, default=0.0)
        if begin == 0 or not f(begin) > 1e-12:
            return None
    ends = [t for t in extrema if begin < t < LONGEST_RAY]
    t = max(1.0, 2 * max(extrema, default=0.0))
    while t < LONGEST_RAY:
        ends.append(t)
        t *= 2
    ends.append(LONGEST_RAY)
    low = begin
    for high in ends:
        if f(high) <= 0:
            while high - low > 1e-15 * high:
                middle = 0.5 * (low + high)
                if middle in (low, high):
                    break
                if f(middle) <= 0:
                    high = middle
                else:
                    low = middle
            return high
        low = high
    return None


def quadratic_roots(a, half_b, c):
    """The real roots of a t² + 2 half_b t + c = 0, ascending."""
    discriminant = half_b * half_b - a * c
    if discriminant < 0:
        return []
    r = -(half_b + math.copysign(math.sqrt(discriminant), half_b))
    roots = []
    if a != 0:
        roots.append(r / a)
    if r != 0:
        roots.append(c / r)
    return sorted(t for t in roots if math.isfinite(t))


def triangle_weights(corners, rays, q):
    """Weights of q on the triangle of a hull cell that has moved along its rays to q, or None if q is behind it."""
    nearest = min(range(3), key=lambda i: dot(sub(corners[i], q), sub(corners[i], q)))
    order = [(nearest + 1) % 3, (nearest + 2) % 3, nearest]
    p0, p1, p2 = (corners[i] for i in order)
    ray0, ray1, ray2 = (rays[i] for i in order)

    a, b, d = sub(p0, p2), sub(p1, p2), sub(q, p2)
    s = max(length(a), length(b), length(d))
    if s == 0 or not math.isfinite(s):
        return None
    a, b, d = scaled(a, 1 / s), scaled(b, 1 / s), scaled(d, 1 / s)
    a_step, b_step = sub(ray0, ray2), sub(ray1, ray2)
    n0 = cross(a, b)
    n1 = add(cross(a, b_step), cross(a_step, b))
    n2 = cross(a_step, b_step)
    c = (dot(n0, d), dot(n1, d) - dot(n0, ray2), dot(n2, d) - dot(n1, ray2), -dot(n2, ray2))

    def area_of(f, g):
        """Square of twice the area, or None if there is no area."""
        n = cross(f, g)
        area = dot(n, n)
        return None if area <= 1e-24 * max(dot(f, f), dot(g, g)) ** 2 else area

    t = first_crossing(c, area_of(a, b) is not None)
    if t is None:
        return None
    f, g, h = add(a, scaled(a_step, t)), add(b, scaled(b_step, t)), sub(d, scaled(ray2, t))
    area = area_of(f, g)
    if area is None:
        return None
    n = cross(f, g)
    w0 = dot(cross(h, g), n) / area
    w1 = dot(cross(f, h), n) / area
    weights = [0.0] * 4
    for i, w in zip(order, (w0, w1, 1 - w0 - w1)):
        weights[i] = w
    return tuple(weights)


def edge_weights(corners, rays, axis, q):
    """As `triangle_weights`, for the hull cell of an edge of a plane."""
    a, b = sub(corners[0], q), sub(corners[1], q)
    s = max(length(a), length(b))
    if s == 0:
        return None
    a, b = scaled(a, 1 / s), scaled(b, 1 / s)

    def det(x, y):
        return dot(cross(x, y), axis)

    c = (-det(a, b), -det(rays[0], b) - det(a, rays[1]), -det(rays[0], rays[1]), 0.0)
    t = first_crossing(c, True)
    if t is None:
        return None
    a = add(a, scaled(rays[0], t))
    e = sub(add(b, scaled(rays[1], t)), a)
    g = cross(axis, cross(e, axis))
    if dot(g, e) <= 0:
        return None
    w1 = -dot(g, a) / dot(g, e)
    return (1 - w1, w1, 0.0, 0.0)


def measure_of(w, rounding):
    total = sum(w)
    return min(w) / total if total > 0 and total * total > rounding else -math.inf


def closest_on_segment(a, b):
    """Weights of the point of a segment that is closest to the origin."""
    e = sub(b, a)
    t = -dot(a, e) / dot(e, e) if dot(e, e) > 0 else 0.0
    t = min(max(t, 0.0), 1.0)
    return (1 - t, t)


def blend_of(weights, points):
    """Σ weight · point"""
    total = (0.0, 0.0, 0.0)
    for weight, point in zip(weights, points):
        total = add(total, scaled(point, weight))
    return total


def closest_on_simplex(corners):
    """Weights of the point of a triangle, an edge or a point that is closest to the origin."""
    if len(corners) == 1:
        return (1.0,)
    if len(corners) == 2:
        return closest_on_segment(*corners)
    a, b, c = corners
    n = cross(sub(b, a), sub(c, a))
    area = dot(n, n)
    if area > 0:
        w = tuple(dot(cross(x, y), n) / area for x, y in ((b, c), (c, a), (a, b)))
        if min(w) >= 0:
            return w
    best = None
    for i, j in ((0, 1), (1, 2), (2, 0)):
        w = [0.0] * 3
        w[i], w[j] = closest_on_segment(corners[i], corners[j])
        point = blend_of(w, corners)
        if best is None or dot(point, point) < best[0]:
            best = (dot(point, point), tuple(w))
    return best[1]


class ProbeVolume:
    """The sections of a `.probes` file that queries need."""

    def __init__(self, data):
        sections = read_sections(data)
        info, size = sections.get("info", (b"", 0))
        if len(info) != INFO.size or size != INFO.size:
            raise ValueError(f"section info: {len(info)} bytes instead of {INFO.size}")
        numbers = INFO.unpack(info)
        self.origin = numbers[0:3]
        self.curve_corner = numbers[3:6]
        self.curve_scale = numbers[6]
        self.axis = numbers[7:10]
        self.dimension, self.inner_count = numbers[10:12]
        self.ambient = numbers[13:40]
        self.extent, self.compact_scale = numbers[40:42]
        for name, element in FORMATS.items():
            setattr(self, name, self._elements(sections, name, element))
        self.cells = [(cell[:4], cell[4:]) for cell in self.cells]
        self.hull_rays = [(ray[0:3], ray[3:6], ray[6:9]) for ray in self.hull_rays]
        # The words of the seed grid, read as floats.
        self.seed_floats = [struct.unpack("<f", struct.pack("<I", word[0]))[0] for word in self.seed_grid]
        self.seed_grid = [word[0] for word in self.seed_grid]
        self.rendering_layers = [mask[0] for mask in self.rendering_layers]
        self._check()

    @staticmethod
    def _elements(sections, name, element):
        if name not in sections:
            return []
        data, size = sections[name]
        if size != struct.calcsize(element):
            raise ValueError(f"section {name}: elements of {size} bytes instead of {struct.calcsize(element)}")
        return list(struct.iter_unpack(element, data))

    def _check(self):
        """Counts that agree, and indices in range."""
        probes, cells = len(self.positions), len(self.cells)
        if self.dimension > 4 or self.inner_count > cells:
            raise ValueError(f"section info: dimension {self.dimension}, {self.inner_count} of {cells} cells")
        expected = {
            "hull_rays": cells - self.inner_count,
            "compact": probes,
            "irradiance": probes,
            "occlusion": probes,
            "rendering_layers": probes,
            "layer_irradiance": probes * len(self.layers),
            "visibility_blocks": (cells + 31) // 32,
        }
        for name, count in expected.items():
            if len(getattr(self, name)) not in (0, count):
                raise ValueError(f"section {name}: {len(getattr(self, name))} elements instead of {count}")
        if len(self.hull_rays) != cells - self.inner_count:
            raise ValueError("section hull_rays is absent")
        for i, (vertices, neighbors) in enumerate(self.cells):
            count = self.corner_count(i)
            if any(v >= probes for v in vertices[:count]) or any(v != NONE for v in vertices[count:]):
                raise ValueError(f"section cells: element {i} has the vertices {vertices}")
            if any(n != NONE and n >= cells for n in neighbors):
                raise ValueError(f"section cells: element {i} has the neighbors {neighbors}")
        for i, (first, marked) in enumerate(self.visibility_blocks):
            if first + marked.bit_count() > len(self.cell_visibility):
                raise ValueError(f"section visibility_blocks: element {i} names elements that do not exist")

    def corner_count(self, cell):
        """Number of vertices of a cell."""
        return self.dimension - (cell >= self.inner_count)

    def corners(self, cell):
        return [self.positions[v] for v in self.cells[cell][0][: self.corner_count(cell)]]

    # 2. Make the position local

    def within_reach(self, position):
        """The position relative to the origin; beyond 65536 extents only the direction counts."""
        return self._limit(sub(position, self.origin))

    def _limit(self, q):
        far = 65536 * self.extent
        if far > 0 and dot(q, q) > far * far:
            q = scaled(q, far / length(q))
        return q

    def to_local(self, position):
        q = sub(position, self.origin)
        if self.dimension == 3:
            q = sub(q, scaled(self.axis, dot(self.axis, sub(q, self.positions[0]))))
        if self.dimension == 2:
            q = add(self.positions[0], scaled(self.axis, dot(self.axis, sub(q, self.positions[0]))))
        return self._limit(q)

    # 3. Find the cell

    def numbers(self, cell, q):
        """The four numbers of q in a cell, and their measure."""
        if cell >= self.inner_count:
            w = self._hull_numbers(cell, q)
            return w, measure_of(w, 0.0)
        corners = self.corners(cell)
        relative = [sub(p, q) for p in corners]
        if self.dimension == 4:
            longest = max(dot(e, e) for e in (sub(p, corners[0]) for p in corners[1:]))
            if dot(relative[0], relative[0]) > LONGEST_RAY * longest:
                return self._far_numbers(corners, relative), -math.inf
            a, b, c, d = relative
            cd, ab = cross(c, d), cross(a, b)
            w = (dot(b, cd), -dot(a, cd), dot(d, ab), -dot(c, ab))
            squares = sorted(dot(x, x) for x in relative)
            return w, measure_of(w, 1e-24 * squares[1] * squares[2] * squares[3])
        if self.dimension == 3:
            a, b, c = relative
            c_axis = cross(c, self.axis)
            w = (dot(b, c_axis), -dot(a, c_axis), dot(self.axis, cross(a, b)), 0.0)
            return w, measure_of(w, 1e-24 * max(dot(x, x) for x in relative) ** 2)
        if self.dimension == 2:
            a, b = relative
            w = (dot(b, self.axis), -dot(a, self.axis), 0.0, 0.0)
            return w, measure_of(w, 0.0)
        return (1.0, 0.0, 0.0, 0.0), 0.0

    @staticmethod
    def _far_numbers(corners, relative):
        """Numbers of a position so far from a tetrahedron that only their signs count."""
        a, b, c, d = corners
        aq, bq = relative[0], relative[1]
        return (
            dot(bq, cross(sub(c, b), sub(d, b))),
            dot(aq, cross(sub(d, a), sub(c, a))),
            dot(aq, cross(sub(b, a), sub(d, a))),
            dot(aq, cross(sub(c, a), sub(b, a))),
        )

    def _hull_numbers(self, cell, q):
        corners, rays = self.corners(cell), self.hull_rays[cell - self.inner_count]
        if self.dimension == 4:
            w = triangle_weights(corners, rays, q)
        elif self.dimension == 3:
            w = edge_weights(corners, rays, self.axis, q)
        else:
            w = (1.0, 0.0, 0.0, 0.0) if dot(sub(corners[0], q), rays[0]) <= 0 else None
        return w or (0.0, 0.0, 0.0, -1.0)

    def find_cell(self, q, start=None):
        """A cell that contains q, and its numbers: the walk from the cell `start`, or from the seed of q."""
        cell = self.first_cell(q) if start is None else start
        previous = None
        previous_w, previous_measure = None, -math.inf
        for _ in range(4 * len(self.cells) + 64):
            w, measure = self.numbers(cell, q)
            if measure >= 0:
                return cell, w
            following = self.cells[cell][1][w.index(min(w))]
            if following == NONE:
                break
            if following == previous:
                if max(measure, previous_measure) >= -1e-9:
                    return (cell, w) if measure > previous_measure else (previous, previous_w)
                break
            previous, previous_w, previous_measure = cell, w, measure
            cell = following
        return self.search_all(q)

    def search_all(self, q):
        """The cell in which q has the largest measure, of all cells."""
        best = max(range(len(self.cells)), key=lambda cell: self.numbers(cell, q)[1])
        w, measure = self.numbers(best, q)
        if measure > -math.inf:
            return best, w
        corners = ((cell, i, p) for cell in range(len(self.cells)) for i, p in enumerate(self.corners(cell)))
        cell, nearest, _ = min(corners, key=lambda corner: length(sub(corner[2], q)))
        return cell, tuple(float(i == nearest) for i in range(4))

    def first_cell(self, q):
        """The cell that the seed grid, or without it the seeds, name near q."""
        cell = self._cell_of_grid(q) if self.seed_grid else self._cell_of_seeds(q)
        return cell if cell < len(self.cells) else 0

    def _cell_of_grid(self, q):
        local = to_floats(q)
        place = 0
        for _ in range(4):
            if place + 10 > len(self.seed_grid):
                return 0
            low, scale = self.seed_floats[place : place + 3], self.seed_floats[place + 3 : place + 6]
            size = self.seed_grid[place + 6 : place + 9]
            voxel = []
            for axis in range(3):
                v = (local[axis] - low[axis]) * scale[axis]
                voxel.append(0 if math.isnan(v) else int(min(max(v, 0), size[axis] - 1)))
            at = place + 10 + (voxel[2] * size[1] + voxel[1]) * size[0] + voxel[0]
            if at >= len(self.seed_grid):
                return 0
            word = self.seed_grid[at]
            if word < 2**31:
                return word
            place = word - 2**31
        return 0

    def _cell_of_seeds(self, q):
        if not self.seeds:
            return 0
        index = self.hilbert_index(q)
        return next((seed[1] for seed in self.seeds if seed[0] >= index), self.seeds[-1][1])

    def hilbert_index(self, q):
        """The place of q on the curve of the seeds."""
        lattice = [
            int(min(max((q[i] - self.curve_corner[i]) * self.curve_scale, 0), 2**21 - 1)) for i in range(3)
        ]
        axes, reverse = [0, 1, 2], [0, 0, 0]
        gray, index = 0, 0
        for bit in range(20, -1, -1):
            bits = [(lattice[axes[i]] >> bit & 1) ^ reverse[i] for i in range(3)]
            for i in range(3):
                gray ^= bits[i]
                index = 2 * index + gray
            for i in range(3):
                if bits[i]:
                    reverse[0] = 1 - reverse[0]
                else:
                    axes[0], axes[i] = axes[i], axes[0]
                    reverse[0], reverse[i] = reverse[i], reverse[0]
        return index

    def locate(self, position, start=None):
        """The cell of a position in the world, and its barycentric weights."""
        if not self.cells or not all(math.isfinite(x) for x in position):
            return Location()
        cell, w = self.find_cell(self.to_local(position), start)
        positive = [max(x, 0.0) for x in w]
        total = sum(positive)
        return Location(cell, to_floats(x / total for x in positive), 0.0)

    # 4. Hide probes behind walls

    def visibility(self, cell):
        """Twelve codes and the splits of a cell, or None if nothing is blocked there."""
        if not self.visibility_blocks:
            return None
        first, marked = self.visibility_blocks[cell // 32]
        if not marked >> cell % 32 & 1:
            return None
        return self.cell_visibility[first + (marked & (1 << cell % 32) - 1).bit_count()]

    def hide(self, location, radius):
        """The weights of a location without the probes that are behind walls."""
        b = location.weights
        element = None if location.cell is None else self.visibility(location.cell)
        if element is None:
            return b
        splits = element[12]
        total = sum(b)
        distances = self.corner_distances(location) if radius > 0 else None
        seen, low, steep = [0.0] * 4, [0.0] * 4, [0.0] * 4
        for i in range(4):
            terms, parts = [], []
            for k in range(3):
                s = element[4 * k + i] - 67
                b_j = b[(i + k + 1) % 4]
                terms.append(b_j * (s * abs(s) / 896))
                parts.append(max(b_j + terms[k], 0.0))
            s01, s02, s12 = splits >> i & 1, splits >> 4 + i & 1, splits >> 8 + i & 1
            others = 0.0
            if s01 or s02 or s12:
                others = sum(parts) - max(parts)
                if not s12:
                    others = min(others, parts[0])
                if not s02:
                    others = min(others, parts[1])
                if not s01:
                    others = min(others, parts[2])
            x = max((sum(terms) - b[i] - others) / max(total, TINY), 0.0)
            ratio = 1 + x
            ramp = 0.03
            if distances is not None:
                ramp = max(ramp, radius * ratio / max(distances[i], TINY))
            u = min(x / ramp, 1.0)
            h = u * u * (3 - 2 * u)
            seen[i] = b[i] * (1 - h)
            low[i] = b[i] * h / ratio**2
            steep[i] = b[i] * h / ratio**8
        share = 0.01 * sum(low) / max(sum(steep), TINY)
        v = [seen[i] + share * steep[i] for i in range(4)]
        return tuple(x * total / max(sum(v), TINY) for x in v)

    def corner_distances(self, location):
        """Distances of the place of a location to the corners of its cell; of absent corners 0."""
        corners = self.corners(location.cell)
        total = max(sum(location.weights), TINY)
        place = scaled(blend_of(location.weights, corners), 1 / total)
        return [length(sub(place, p)) for p in corners] + [0.0] * (4 - len(corners))

    # 5. Blend

    def light_of(self, probe, options):
        """27 coefficients of a probe, or None if the volume has no light."""
        if options.layer_weights:
            return self.sums_of_layers(options.layer_weights, self._reads_halves(options))[probe]
        if self._reads_halves(options):
            return [x * self.compact_scale for x in self.compact[probe][:27]]
        return self.irradiance[probe] if self.irradiance else None

    @functools.cache
    def sums_of_layers(self, weights, as_halves):
        """27 coefficients of each probe at weights of the layers; `as_halves` rounds them as `compact` has them."""
        count = len(self.positions)
        sums = []
        for probe in range(count):
            parts = [self.layer_irradiance[k * count + probe] for k in range(len(self.layers))]
            sums.append([sum(w * part[i] for w, part in zip(weights, parts)) for i in range(27)])
        largest = max((abs(x) for light in sums for x in light), default=0.0)
        if as_halves and largest > 0:
            scale = 2.0 ** (math.frexp(largest)[1] - 12)  # largest / scale is in [2¹¹, 2¹²)
            sums = [[to_half(x / scale) * scale for x in light] for light in sums]
        return sums

    def occlusion_of(self, probe, options):
        if self._reads_halves(options):
            return self.compact[probe][27:31]
        return self.occlusion[probe] if self.occlusion else (1.0,) * 4

    def _reads_halves(self, options):
        return bool(self.compact) and options.precision == "half"

    def ambient_of(self, options):
        if not options.layer_weights:
            return self.ambient
        return [sum(w * layer[2 + i] for w, layer in zip(options.layer_weights, self.layers)) for i in range(27)]

    def blend(self, location, weights, options):
        """Coefficients and occlusion of a location at weights of its corners."""
        ambient = self.ambient_of(options)
        light = [location.ambient * x for x in ambient]
        occlusion = [location.ambient] * 4
        for probe, weight in zip(self.probes_of(location), weights):
            # A volume that is not baked has ambient light everywhere.
            for i, x in enumerate(self.light_of(probe, options) or ambient):
                light[i] += weight * x
            for i, x in enumerate(self.occlusion_of(probe, options)):
                occlusion[i] += weight * x
        return tuple(tuple(light[3 * i : 3 * i + 3]) for i in range(9)), tuple(occlusion)

    def probes_of(self, location):
        """The vertices of the cell of a location."""
        if location.cell is None:
            return ()
        return self.cells[location.cell][0][: self.corner_count(location.cell)]

    # 7. Options

    def to_hull(self, location, position, options):
        """A location outside the hull as `options.outside` has it."""
        if options.outside == "extrapolate" or location.cell is None or location.cell < self.inner_count:
            return location
        q = self.within_reach(position)
        best = None
        for cell in range(self.inner_count, len(self.cells)):
            corners = [self._in_space(sub(p, q)) for p in self.corners(cell)]
            weights = closest_on_simplex(corners)
            distance = length(blend_of(weights, corners))
            if best is None or distance < best[0]:
                best = (distance, cell, weights)
        distance, cell, weights = best
        fraction = 0.0
        if options.outside == "ambient":
            moved = length(sub(sub(position, self.origin), q))
            fraction = min(1.0, (distance + moved) / options.fade_distance)
        weights = [w * (1 - fraction) for w in weights] + [0.0] * (4 - len(weights))
        return Location(cell, to_floats(weights), fraction)

    def _in_space(self, x):
        """The part of a difference of positions that lies in the plane, or along the line, of a flat volume."""
        if self.dimension == 3:
            return sub(x, scaled(self.axis, dot(self.axis, x)))
        if self.dimension == 2:
            return scaled(self.axis, dot(self.axis, x))
        return x

    def share_layers(self, location, weights, mask):
        """Weights for an object on the rendering layers of a mask."""
        if mask == NONE or not self.rendering_layers:
            return weights
        probes = self.probes_of(location)
        shared = [w if self.rendering_layers[p] & mask else w * 0.0001 for p, w in zip(probes, weights)]
        if not sum(shared) > 0:
            return weights
        factor = sum(weights) / sum(shared)
        return tuple(w * factor for w in shared) + (0.0,) * (4 - len(shared))

    def off_surface(self, position, normal, offset):
        """A position on a surface, moved off it along its normal."""
        location = self.locate(position)
        if location.cell is None:
            return position
        b, d = location.weights, self.corner_distances(location)
        mean = sum(x * y for x, y in zip(b, d)) / sum(b)
        return to_floats(add(position, scaled(normal, offset * mean)))

    def query(self, position, options=Options(), normal=None):
        """The light of a position, and with `normal` and `options.normal_offset` of one on a surface."""
        position = to_floats(position)
        if normal is not None and options.normal_offset > 0:
            position = self.off_surface(position, normal, options.normal_offset)
        location = self.to_hull(self.locate(position), position, options)
        weights = location.weights
        if options.walls == "hide":
            weights = self.hide(location, options.radius)
        weights = self.share_layers(location, weights, options.rendering_layers)
        coefficients, occlusion = self.blend(location, weights, options)
        return Answer(location, self.probes_of(location), weights, coefficients, occlusion)
