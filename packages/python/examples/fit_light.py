#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How bright is each light? Finds the weights of the layers of a volume from a few measured irradiances, by least
squares: the light of a source is proportional to its brightness.

    python3 fit_light.py courtyard.glb --samples 1024 -o fit.png

The measurements are computed here: those of light meters at random places, with five percent of noise. Needs Matplotlib.
"""
import argparse
import sys

import numpy

import tetralight

LAYERS = ("sun", "sky", "emission")
TRUTH = {"sun": 0.4, "sky": 1.7, "emission": 2.5}
NOISE = 0.05


def meters(volume, count, seed=1):
    """Places and normals of light meters: near random probes, in random directions."""
    random = numpy.random.default_rng(seed)
    probes = numpy.asarray(volume.positions)
    places = probes[random.integers(len(probes), size=count)] + random.uniform(-0.1, 0.1, (count, 3))
    normals = random.normal(size=(count, 3))
    return places, normals / numpy.linalg.norm(normals, axis=1, keepdims=True)


def light_of(volume, weights, places, normals):
    """Irradiance (meter, channel) with these weights of the layers."""
    volume.recombine({name: weights.get(name, 0.0) for name in volume.layers})
    return volume.query(places).irradiance(normals).astype(float)


def design(volume, places, normals):
    """(meter and channel, layer): the irradiance of each layer alone."""
    columns = [light_of(volume, {name: 1.0}, places, normals).ravel() for name in volume.layers]
    return numpy.stack(columns, 1)


def fit(matrix, measured, noise):
    """Weights, and their standard errors.

    Noise grows with the light, so that dim rows count more. The light of the last fit says how much: with that of the
    measurement, rows that are too dark by chance would count most."""
    light = numpy.full(len(measured), measured.mean())
    for _ in range(4):
        deviation = noise * numpy.maximum(light, 0.02 * measured.mean())
        rows, values = matrix / deviation[:, None], measured / deviation
        weights = numpy.linalg.lstsq(rows, values, rcond=None)[0]
        light = matrix @ weights
    return weights, numpy.sqrt(numpy.diag(numpy.linalg.inv(rows.T @ rows)))


def measure(scene, meter_count=200, seed=1, **settings):
    """Bakes, measures and fits. Returns the figures by name."""
    volume = tetralight.bake(scene, layers=LAYERS, **settings)
    places, normals = meters(volume, meter_count, seed)
    exact = light_of(volume, TRUTH, places, normals).ravel()
    random = numpy.random.default_rng(seed + 1)
    measured = exact * (1 + NOISE * random.normal(size=exact.shape))
    matrix = design(volume, places, normals)
    weights, errors = fit(matrix, measured, NOISE)
    return {"layers": list(volume.layers), "weights": weights, "errors": errors, "matrix": matrix, "exact": exact,
            "measured": measured, "fitted": matrix @ weights}


def draw(found, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    picture, (left, right) = pyplot.subplots(1, 2, figsize=(9, 4), layout="constrained", width_ratios=(1.3, 1))
    low, high = found["measured"].clip(1e-3).min(), 1.2 * found["measured"].max()
    left.plot([low, high], [low, high], color="black", linewidth=0.8)
    left.loglog(found["measured"], found["fitted"], ".", color="#1f5a96", markersize=3)
    left.set_xlabel("measured irradiance")
    left.set_ylabel("irradiance of the fit")
    places = numpy.arange(len(found["layers"]))
    right.bar(places, [TRUTH[name] for name in found["layers"]], color="#c9d7e6", label="true weight")
    right.errorbar(places, found["weights"], 3 * found["errors"], fmt="o", color="#1f5a96", capsize=5,
                   label="fit, 3 standard errors")
    right.set_xticks(places, found["layers"])
    right.set_ylabel("weight of the layer")
    right.legend()
    picture.savefig(path, dpi=110)
    pyplot.close(picture)


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Fits the weights of light layers to measured irradiance.")
    parser.add_argument("scene")
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--meters", type=int, default=200)
    parser.add_argument("-o", "--output", help="picture to write (.png)")
    given = parser.parse_args(arguments)
    found = measure(given.scene, given.meters, samples=given.samples)
    for name, weight, error in zip(found["layers"], found["weights"], found["errors"]):
        print(f"{name}: {weight:.3f} ± {error:.3f}, true {TRUTH[name]}")
    if given.output:
        draw(found, given.output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
