#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the curves of `./run bench grid` as an SVG: error over the number of probes.

    ./run bench grid --scene sponza.glb > grid.jsonl
    bench/plot_grid.py grid.jsonl Sponza > docs/images/grid_error.svg

The second argument is the name of the scene that --scene gave.
"""
import json
import math
import re
import sys

WIDTH, HEIGHT = 300, 260
LEFT, TOP, RIGHT, BOTTOM = 48, 34, 12, 40
COLORS = {"regular": "#c0504d", "adaptive": "#2f6db5"}


def read_curves(path):
    """{scene: {kind: [(probes, percent)]}} in the order of the file."""
    scenes = {}
    for line in open(path, encoding="utf-8"):
        figure = json.loads(line)
        found = re.fullmatch(r"grid\.error\.(\w+)\.(regular|adaptive)\.\d+", figure["figure"])
        if not found:
            continue
        probes = int(re.search(r"with (\d+) probes", figure["unit"]).group(1))
        curve = scenes.setdefault(found[1], {}).setdefault(found[2], [])
        curve.append((probes, figure["ours"]))
    return {scene: {kind: sorted(set(c)) for kind, c in curves.items()}
            for scene, curves in scenes.items()}


def ticks(low, high):
    """1, 2 and 5 times powers of ten."""
    exponents = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    values = [m * 10.0 ** e for e in exponents for m in (1, 2, 5)]
    return [v for v in values if low <= v <= high]


def panel(scene, curves, left):
    points = [p for curve in curves.values() for p in curve]
    x_low, x_high = min(p[0] for p in points) / 1.1, max(p[0] for p in points) * 1.1
    y_low, y_high = min(p[1] for p in points) / 1.25, max(p[1] for p in points) * 1.25
    x0, x1, y0, y1 = left + LEFT, left + WIDTH - RIGHT, HEIGHT - BOTTOM, TOP

    def place(probes, error):
        x = x0 + (x1 - x0) * math.log(probes / x_low) / math.log(x_high / x_low)
        y = y0 + (y1 - y0) * math.log(error / y_low) / math.log(y_high / y_low)
        return x, y

    out = [f'<text x="{(x0 + x1) / 2:.0f}" y="18" text-anchor="middle" font-weight="bold">{scene}</text>',
           f'<rect x="{x0}" y="{y1}" width="{x1 - x0}" height="{y0 - y1}" fill="none" stroke="#999"/>']
    for v in ticks(x_low, x_high):
        x, _ = place(v, y_low)
        out.append(f'<path d="M{x:.1f} {y0}V{y1}" stroke="#e4e4e4"/>'
                   f'<text x="{x:.1f}" y="{y0 + 15}" text-anchor="middle">{v:g}</text>')
    for v in ticks(y_low, y_high):
        _, y = place(x_low, v)
        out.append(f'<path d="M{x0} {y:.1f}H{x1}" stroke="#e4e4e4"/>'
                   f'<text x="{x0 - 5}" y="{y + 4:.1f}" text-anchor="end">{v:g} %</text>')
    for kind, curve in curves.items():
        line = " ".join("{:.1f},{:.1f}".format(*place(*p)) for p in curve)
        out.append(f'<polyline points="{line}" fill="none" stroke="{COLORS[kind]}" stroke-width="2"/>')
        out += ['<circle cx="{:.1f}" cy="{:.1f}" r="3" fill="{}"/>'.format(*place(*p), COLORS[kind])
                for p in curve]
    out.append(f'<text x="{(x0 + x1) / 2:.0f}" y="{HEIGHT - 6}" text-anchor="middle">probes</text>')
    return out


def main():
    scenes = read_curves(sys.argv[1])
    if len(sys.argv) > 2 and "scene" in scenes:
        scenes[sys.argv[2]] = scenes.pop("scene")
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH * len(scenes)}" height="{HEIGHT + 22}" '
           'font-family="sans-serif" font-size="11" fill="#333">',
           '<rect width="100%" height="100%" fill="#fff"/>']
    for i, (scene, curves) in enumerate(scenes.items()):
        out += panel(scene, curves, i * WIDTH)
    for i, (kind, color) in enumerate(COLORS.items()):
        x = LEFT + 110 * i
        out.append(f'<path d="M{x} {HEIGHT + 10}h24" stroke="{color}" stroke-width="2"/>'
                   f'<text x="{x + 30}" y="{HEIGHT + 14}">{kind}</text>')
    print("\n".join(out + ["</svg>"]))


if __name__ == "__main__":
    main()
