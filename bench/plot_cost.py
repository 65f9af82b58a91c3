#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws rays of bakes over those that were expected, from the lines of `./run bench farm`, as an SVG.

    ./run bench farm --scene sponza.glb > farm.jsonl
    bench/plot_cost.py farm.jsonl Sponza > docs/images/farm_cost.svg

The second argument is the name of the scene that --scene gave.
"""
import json
import math
import re
import sys

SIZE, LEFT, TOP, BOTTOM, LEGEND = 300, 56, 14, 44, 150
COLORS = ["#2f6db5", "#4f9a4f", "#8a63b0", "#c0504d"]
TARGETS = {"0.05": "5 %", "0.02": "2 %", "0.01": "1 %"}


def read_points(path):
    """{scene: {target: (expected, real)}} in the order of the file."""
    scenes = {}
    for line in open(path, encoding="utf-8"):
        figure = json.loads(line)
        found = re.fullmatch(r"farm\.cost_rays\.(\w+)\.([\d.]+)", figure["figure"])
        if found:
            real = int(re.search(r"\d+", figure["unit"])[0])
            scenes.setdefault(found[1], {})[found[2]] = (figure["ours"] * real, real)
    return scenes


def main():
    scenes = read_points(sys.argv[1])
    if len(sys.argv) > 2 and "scene" in scenes:
        scenes[sys.argv[2]] = scenes.pop("scene")
    values = [v for points in scenes.values() for point in points.values() for v in point]
    low, high = min(values) / 1.6, max(values) * 1.6
    x0, x1, y0, y1 = LEFT, LEFT + SIZE, TOP + SIZE, TOP

    def along(value, begin, end):
        return begin + (end - begin) * math.log(value / low) / math.log(high / low)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{x1 + LEGEND}" height="{y0 + BOTTOM}" '
           'font-family="sans-serif" font-size="11" fill="#333">',
           '<rect width="100%" height="100%" fill="#fff"/>',
           f'<clipPath id="frame"><rect x="{x0}" y="{y1}" width="{SIZE}" height="{SIZE}"/></clipPath>']
    for exponent in range(math.ceil(math.log10(low)), math.floor(math.log10(high)) + 1):
        x, y = along(10.0 ** exponent, x0, x1), along(10.0 ** exponent, y0, y1)
        power = f'10<tspan dy="-4" font-size="8">{exponent}</tspan>'
        out += [f'<path d="M{x:.1f} {y0}V{y1}M{x0} {y:.1f}H{x1}" stroke="#e4e4e4"/>',
                f'<text x="{x:.1f}" y="{y0 + 16}" text-anchor="middle">{power}</text>',
                f'<text x="{x0 - 6}" y="{y + 4:.1f}" text-anchor="end">{power}</text>']
    for factor, style in ((1.0, ""), (1.25, ' stroke-dasharray="4 3"'), (1 / 1.25, ' stroke-dasharray="4 3"')):
        ends = [(along(v, x0, x1), along(v * factor, y0, y1)) for v in (low, high)]
        out.append('<path clip-path="url(#frame)" d="M{:.1f} {:.1f}L{:.1f} {:.1f}" stroke="#999"{}/>'.format(
            *ends[0], *ends[1], style))
    out.append(f'<rect x="{x0}" y="{y1}" width="{SIZE}" height="{SIZE}" fill="none" stroke="#999"/>')
    for (scene, points), color in zip(scenes.items(), COLORS):
        places = [(along(e, x0, x1), along(r, y0, y1)) for e, r in points.values()]
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        out.append(f'<polyline points="{line}" fill="none" stroke="{color}" stroke-opacity="0.4"/>')
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{color}"/>' for x, y in places]
    for i, (scene, color) in enumerate(zip(scenes, COLORS)):
        out.append(f'<circle cx="{x1 + 18}" cy="{y1 + 14 + 18 * i}" r="4" fill="{color}"/>'
                   f'<text x="{x1 + 28}" y="{y1 + 18 + 18 * i}">{scene}</text>')
    note = y1 + 32 + 18 * len(scenes)
    targets = ", ".join(TARGETS[t] for t in next(iter(scenes.values())))
    out += [f'<text x="{x1 + 12}" y="{note}">targets {targets}</text>',
            f'<text x="{x1 + 12}" y="{note + 16}">dashed: 25 % off</text>',
            f'<text x="{(x0 + x1) / 2:.0f}" y="{y0 + 34}" text-anchor="middle">expected rays</text>',
            f'<text transform="translate(14 {(y0 + y1) / 2:.0f}) rotate(-90)" text-anchor="middle">rays of the bake</text>']
    print("\n".join(out + ["</svg>"]))


if __name__ == "__main__":
    main()
