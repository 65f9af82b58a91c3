#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bakes a scene and holds its light to limits, for build servers: exit code 1 if one is exceeded.

    python3 light_thresholds.py courtyard.glb --samples 1024 --max-error 5% --max-leak 1% -o thresholds.png

Prints a line for each limit, and draws what was measured over the limit. Needs Matplotlib.
"""
import argparse
import sys
from dataclasses import dataclass

import numpy

import tetralight


@dataclass(frozen=True)
class Figure:
    name: str
    value: float
    limit: float

    @property
    def is_kept(self):
        return self.value <= self.limit


def fraction(text):
    """0.01 or 1%."""
    return float(text[:-1]) / 100 if text.endswith("%") else float(text)


def measure(scene, limits, places=1000, **settings):
    """Bakes, and measures each figure that has a limit. Gives the volume, too."""
    volume = tetralight.bake(scene, **settings)
    leaks = tetralight.check_leaks(scene, volume, places=places)
    error = numpy.asarray(volume.standard_error)
    light = leaks["mean_light"]
    values = {
        "error": float(numpy.percentile(error, 95)),
        "invalid": float(numpy.mean(numpy.asarray(volume.validity) < 0.75)),
        "leak": leaks["through_walls"]["mean"] / light if light > 0 else 0.0,
        "unseen": leaks["unseen"] / leaks["places"],
    }
    return volume, [Figure(name, values[name], limit) for name, limit in limits.items()]


NAMES = {
    "error": "standard error of a probe, 95th percentile",
    "invalid": "probes with a validity below 0.75",
    "leak": "light through walls, of the mean light",
    "unseen": "places that see no probe of their cell",
}


def draw(figures, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    picture, axes = pyplot.subplots(figsize=(8, 0.8 + 0.6 * len(figures)), layout="constrained")
    shares = [figure.value / figure.limit for figure in figures]
    colors = ["#3a7d44" if figure.is_kept else "#b3261e" for figure in figures]
    bars = axes.barh([NAMES[figure.name] for figure in figures], shares, color=colors, height=0.6)
    labels = [f"{figure.value:.2%} of {figure.limit:.2%}" for figure in figures]
    axes.axvline(1.0, color="black", linewidth=1, zorder=0)
    axes.bar_label(bars, labels, padding=4, bbox={"color": "white", "pad": 1})
    axes.set_xlim(0, 1.5 * max([1.0, *shares]))
    axes.set_xlabel("measured / limit")
    axes.invert_yaxis()
    picture.savefig(path, dpi=110)
    pyplot.close(picture)


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Bakes a scene and holds its light to limits.")
    parser.add_argument("scene")
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--places", type=int, default=1000)
    parser.add_argument("--max-error", type=fraction, default=0.05)
    parser.add_argument("--max-invalid", type=fraction, default=0.01)
    parser.add_argument("--max-leak", type=fraction, default=0.01)
    parser.add_argument("--max-unseen", type=fraction, default=0.01)
    parser.add_argument("-o", "--output", help="picture to write (.png)")
    given = parser.parse_args(arguments)
    limits = {"error": given.max_error, "invalid": given.max_invalid, "leak": given.max_leak,
              "unseen": given.max_unseen}
    try:
        volume, figures = measure(given.scene, limits, given.places, samples=given.samples)
    except tetralight.Error as error:
        print(f"{error.code}: {error}", file=sys.stderr)
        return 2
    print(f"{volume.probe_count} probes")
    for figure in figures:
        verdict = "ok  " if figure.is_kept else "FAIL"
        print(f"{verdict} {NAMES[figure.name]}: {figure.value:.3%}, limit {figure.limit:.3%}")
    if given.output:
        draw(figures, given.output)
    return 0 if all(figure.is_kept for figure in figures) else 1


if __name__ == "__main__":
    sys.exit(main())
