#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many probes does a scene need? Bakes grids of several spacings, and compares the light between their probes with
light that is baked at the same places.

    python3 error_by_probe_count.py courtyard.glb --samples 1024 --spacings 6 4 3 2 1.5 -o error.png

Needs Matplotlib.
"""
import argparse
import sys

import numpy

import tetralight

# Surfaces along the six axes.
NORMALS = numpy.concatenate([numpy.eye(3), -numpy.eye(3)]).astype(numpy.float32)


def test_places(scene, count, spacing=1.1, seed=1):
    """Random places in free space: some of a fine grid, moved a little."""
    fine = tetralight.grid(scene, spacing=spacing, clearance=0.25 * spacing).positions
    random = numpy.random.default_rng(seed)
    chosen = fine[random.choice(len(fine), min(count, len(fine)), replace=False)]
    return chosen + random.uniform(-0.2, 0.2, chosen.shape) * spacing


def irradiance(volume, places):
    """(place, normal, channel)."""
    return volume.query(places[:, None, :].repeat(len(NORMALS), 1)).irradiance(
        numpy.broadcast_to(NORMALS, (len(places), *NORMALS.shape)))


def reference(scene, places, **settings):
    """Places, and the light that is baked there. Those that turn out to lie inside of geometry are left out."""
    volume = tetralight.bake(scene, positions=places, virtual_offset=0, **settings)
    kept = numpy.array(volume.positions)
    return kept, irradiance(volume, kept)


def relative_error(volume, places, truth):
    """Mean difference over the mean irradiance. Its square would count one place beside a lamp more than all others."""
    return float(numpy.mean(numpy.abs(irradiance(volume, places) - truth)) / numpy.mean(truth))


def measure(scene, spacings, place_count=400, **settings):
    """(probes, error) of each spacing."""
    places, truth = reference(scene, test_places(scene, place_count), **settings)
    results = []
    for spacing in spacings:
        positions = tetralight.grid(scene, spacing=spacing).positions
        volume = tetralight.bake(scene, positions=positions, **settings)
        results.append((volume.probe_count, relative_error(volume, places, truth)))
    return results


def slope(results):
    """Exponent of the error as a power of the number of probes."""
    counts, errors = numpy.log(numpy.array(results)).T
    return float(numpy.polyfit(counts, errors, 1)[0])


def draw(results, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
    from matplotlib.ticker import PercentFormatter

    counts, errors = numpy.array(results).T
    exponent, offset = numpy.polyfit(numpy.log(counts), numpy.log(errors), 1)
    picture, axes = pyplot.subplots(figsize=(7, 4.2), layout="constrained")
    axes.loglog(counts, errors, "o", color="#1f5a96", markersize=7)
    axes.loglog(counts, numpy.exp(offset) * counts**exponent, color="#1f5a96", linewidth=1,
                label=f"error ~ probes$^{{{exponent:.2f}}}$")
    axes.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=0))
    axes.yaxis.set_minor_formatter(PercentFormatter(1.0, decimals=0))
    axes.set_xticks(counts, [f"{count:.0f}" for count in counts])
    axes.set_xticks([], minor=True)
    axes.set_xlabel("probes")
    axes.set_ylabel("mean error / mean irradiance")
    axes.grid(True, which="both", linewidth=0.3)
    axes.legend()
    picture.savefig(path, dpi=110)
    pyplot.close(picture)


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Error of the light against the number of probes.")
    parser.add_argument("scene")
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--places", type=int, default=400)
    parser.add_argument("--spacings", type=float, nargs="+", default=[6, 4, 3, 2, 1.5])
    parser.add_argument("-o", "--output", help="picture to write (.png)")
    given = parser.parse_args(arguments)
    results = measure(given.scene, given.spacings, given.places, samples=given.samples)
    for spacing, (count, error) in zip(given.spacings, results):
        print(f"spacing {spacing:g} m: {count} probes, error {error:.1%}")
    print(f"error ~ probes^{slope(results):.2f}")
    if given.output:
        draw(results, given.output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
