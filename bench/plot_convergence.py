#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws errors over rays, log-log, as an SVG.

    ./run bench bake --convergence errors.csv --scene SCENE.glb
    python3 bench/plot_convergence.py errors.csv docs/images/convergence.svg [SCENE...]

Without scenes it draws all of the file. SCENE=TITLE draws a scene under another name.
"""
import csv
import math
import sys

WIDTH, HEIGHT = 860, 400
TOP, BOTTOM, LEFT, GAP = 50, 60, 70, 60
COLORS = {"ours": "#0a7e8c", "without openings": "#8a6fb0", "random": "#c8553d"}
LABELS = {"ours": "Tetralight", "without openings": "the same without openings", "random": "plain path tracer"}


def read(path):
    """{scene: {method: [(rays, error)]}}, in the order of the file."""
    scenes = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            points = scenes.setdefault(row["scene"], {}).setdefault(row["method"], [])
            points.append((float(row["rays"]), float(row["error"])))
    return scenes


def chosen(scenes, names):
    """The scenes with these names, under their titles."""
    titles = dict(name.split("=", 1) if "=" in name else (name, name) for name in names)
    return {title: scenes[name] for name, title in titles.items()} or scenes


def decades(values):
    return range(math.floor(math.log10(min(values))), math.ceil(math.log10(max(values))) + 1)


class Panel:
    """One scene: a square with logarithmic axes."""

    def __init__(self, left, width, x_decades, y_decades):
        self.left, self.width = left, width
        self.x_decades, self.y_decades = x_decades, y_decades

    def x(self, rays):
        share = (math.log10(rays) - self.x_decades[0]) / (self.x_decades[-1] - self.x_decades[0])
        return self.left + share * self.width

    def y(self, error):
        share = (math.log10(error) - self.y_decades[0]) / (self.y_decades[-1] - self.y_decades[0])
        return HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM)

    def grid(self):
        for d in self.x_decades:
            x = self.x(10.0**d)
            yield f'<path class="grid" d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}"/>'
            label = f"{10**d}" if d < 3 else f"{10**(d % 3)}{'kMG'[d // 3 - 1]}"
            yield f'<text class="end" x="{x:.1f}" y="{HEIGHT - BOTTOM + 20}">{label}</text>'
        for d in self.y_decades:
            y = self.y(10.0**d)
            yield f'<path class="grid" d="M{self.left} {y:.1f}H{self.left + self.width}"/>'
            label = f"{100 * 10.0**d:g} %"
            yield f'<text class="side" x="{self.left - 8}" y="{y + 4:.1f}">{label}</text>'

    def line(self, method, points):
        path = " ".join(f"{self.x(r):.1f},{self.y(e):.1f}" for r, e in points)
        color = COLORS[method]
        yield f'<polyline fill="none" stroke="{color}" stroke-width="2.5" points="{path}"/>'
        for r, e in points:
            yield f'<circle cx="{self.x(r):.1f}" cy="{self.y(e):.1f}" r="4" fill="{color}"/>'


def draw(scenes):
    points = [p for methods in scenes.values() for line in methods.values() for p in line]
    x_decades, y_decades = decades([p[0] for p in points]), decades([p[1] for p in points])
    width = (WIDTH - LEFT - 20 - GAP * (len(scenes) - 1)) / len(scenes)
    yield f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}">'
    yield ("<style>text{font:13px sans-serif;fill:#333}.grid{stroke:#ddd;fill:none}"
           ".end,.title{text-anchor:middle}.side{text-anchor:end}.title{font-size:15px}</style>")
    yield f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>'
    for i, (scene, methods) in enumerate(scenes.items()):
        panel = Panel(LEFT + i * (width + GAP), width, x_decades, y_decades)
        yield from panel.grid()
        middle = panel.left + width / 2
        yield f'<text class="title" x="{middle:.1f}" y="{TOP - 24}">{scene}</text>'
        yield f'<text class="end" x="{middle:.1f}" y="{HEIGHT - 14}">rays a probe</text>'
        for k, (method, line) in enumerate(methods.items()):
            yield from panel.line(method, line)
            x, y = panel.left + 16, HEIGHT - BOTTOM - 16 - 20 * (len(methods) - 1 - k)
            yield f'<circle cx="{x:.1f}" cy="{y}" r="5" fill="{COLORS[method]}"/>'
            yield f'<text x="{x + 12:.1f}" y="{y + 4}">{LABELS[method]}</text>'
    yield "</svg>"


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    with open(sys.argv[2], "w") as out:
        out.write("\n".join(draw(chosen(read(sys.argv[1]), sys.argv[3:]))) + "\n")
