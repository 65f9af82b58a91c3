# SPDX-License-Identifier: Apache-2.0
"""The examples of the package: what they compute, and their pictures."""
import contextlib
import importlib.util
import io
import os
import sys
import unittest
from pathlib import Path

import numpy

import tetralight
from command_case import COURTYARD, CommandCase

EXAMPLES = Path(__file__).resolve().parents[2] / "packages/python/examples"
HAS_MATPLOTLIB = importlib.util.find_spec("matplotlib") is not None
SAMPLES = 64


def load(name):
    sys.path.insert(0, str(EXAMPLES))
    try:
        return importlib.import_module(name)
    finally:
        sys.path.remove(str(EXAMPLES))


class Examples(CommandCase):
    def main(self, example, *arguments):
        """Exit code, output, and whether there is a picture."""
        picture = self.folder / f"{example.__name__}.png"
        options = ["-o", str(picture)] if HAS_MATPLOTLIB else []
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            code = example.main([COURTYARD, "--samples", str(SAMPLES), *arguments, *options])
        if HAS_MATPLOTLIB and code != 2:
            self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        return code, output.getvalue()


class Thresholds(Examples):
    def test_the_figures_are_those_of_the_volume_and_the_command(self):
        example = load("light_thresholds")
        limits = {"error": 1.0, "invalid": 1.0, "leak": 1.0, "unseen": 1.0}
        volume, figures = example.measure(COURTYARD, limits, 100, samples=SAMPLES)
        values = {figure.name: figure.value for figure in figures}
        path = self.folder / "court.probes"
        tetralight.run("bake", scene=COURTYARD, output=path, samples=SAMPLES)
        probes = tetralight.run("info", volume=path, probes=True)["probe_list"]
        errors = sorted(probe["standard_error"] for probe in probes)
        below = sum(error < values["error"] for error in errors) / len(errors)
        self.assertAlmostEqual(below, 0.95, delta=1 / len(errors))
        self.assertEqual(values["invalid"], sum(probe["validity"] < 0.75 for probe in probes) / len(probes))
        leaks = tetralight.run("check-leaks", volume=path, scene=COURTYARD, places=100)
        self.assertEqual(values["leak"], leaks["through_walls"]["mean"] / leaks["mean_light"])
        self.assertEqual(values["unseen"], leaks["unseen"] / 100)
        self.assertEqual(volume.probe_count, len(probes))

    def test_the_exit_code_is_that_of_a_check(self):
        example = load("light_thresholds")
        loose = ["--places", "50", "--max-error", "100%", "--max-unseen", "1", "--max-leak", "1"]
        code, output = self.main(example, *loose)
        self.assertEqual((code, output.count("ok  "), output.count("FAIL")), (0, 4, 0))
        code, output = self.main(example, *loose, "--max-error", "0.01%")
        self.assertEqual((code, output.count("ok  "), output.count("FAIL")), (1, 3, 1))
        with contextlib.redirect_stderr(io.StringIO()) as messages:
            self.assertEqual(example.main([str(self.folder / "none.glb")]), 2)
        self.assertIn("not_found", messages.getvalue())


class ErrorByProbeCount(Examples):
    def test_probes_at_the_places_have_no_error(self):
        example = load("error_by_probe_count")
        places = tetralight.grid(COURTYARD, spacing=7).positions
        settings = {"samples": SAMPLES, "virtual_offset": 0}
        kept, truth = example.reference(COURTYARD, places, samples=SAMPLES)
        same = tetralight.bake(COURTYARD, positions=kept, **settings)
        self.assertLess(example.relative_error(same, kept, truth), 1e-6)
        # Twice the light everywhere is an error of the whole light.
        self.assertAlmostEqual(example.relative_error(same, kept, 0.5 * truth), 1.0, places=5)

    def test_the_light_of_the_places_is_baked_there(self):
        example = load("error_by_probe_count")
        kept, truth = example.reference(COURTYARD, example.test_places(COURTYARD, 50, spacing=4), samples=SAMPLES)
        volume = tetralight.bake(COURTYARD, positions=kept, virtual_offset=0, samples=SAMPLES)
        own = {tuple(position): light for position, light in zip(numpy.array(volume.positions).tolist(),
                                                                 numpy.array(volume.irradiance))}
        sh = numpy.stack([own[tuple(position)] for position in kept.tolist()])
        up = tetralight.sh.irradiance(sh, numpy.array([0, 1, 0], numpy.float32))
        numpy.testing.assert_allclose(truth[:, 1], up, atol=2e-3 * truth.mean())

    def test_more_probes_have_less_error(self):
        example = load("error_by_probe_count")
        code, output = self.main(example, "--places", "150", "--spacings", "8", "5", "3")
        self.assertEqual(code, 0)
        lines = output.splitlines()
        counts = [int(line.split(" probes")[0].split()[-1]) for line in lines[:3]]
        errors = [float(line.split()[-1].rstrip("%")) for line in lines[:3]]
        self.assertEqual(counts, sorted(counts))
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertLess(float(lines[3].split("^")[1]), -0.2)

    def test_the_exponent_of_a_power_is_found(self):
        results = [(count, 3 * count**-0.7) for count in (10, 50, 400)]
        self.assertAlmostEqual(load("error_by_probe_count").slope(results), -0.7)


class FitLight(Examples):
    def test_finds_the_true_weights_within_their_errors(self):
        example = load("fit_light")
        found = example.measure(COURTYARD, samples=SAMPLES)
        truth = numpy.array([example.TRUTH[name] for name in found["layers"]])
        # Light is linear in the weights.
        numpy.testing.assert_allclose(found["matrix"] @ truth, found["exact"], atol=5e-3 * found["exact"].mean())
        random = numpy.random.default_rng(3)
        scores = []
        for _ in range(200):
            noise = 1 + example.NOISE * random.normal(size=len(found["exact"]))
            weights, errors = example.fit(found["matrix"], found["matrix"] @ truth * noise, example.NOISE)
            scores.append((weights - truth) / errors)
        scores = numpy.array(scores)
        # The errors are an upper bound: dim rows count as if they had the noise of brighter ones.
        self.assertLess(numpy.abs(scores.mean(0)).max(), 4 / numpy.sqrt(200))
        self.assertLess(scores.std(0).max(), 1 + 4 / numpy.sqrt(2 * 200))
        self.assertGreater(scores.std(0).min(), 0.5)

    def test_without_noise_it_is_exact(self):
        example = load("fit_light")
        matrix = numpy.random.default_rng(2).uniform(0.1, 1, (30, 3))
        weights, _ = example.fit(matrix, matrix @ [0.4, 1.7, 2.5], 0.05)
        numpy.testing.assert_allclose(weights, [0.4, 1.7, 2.5], rtol=1e-12)

    def test_prints_each_weight(self):
        code, output = self.main(load("fit_light"))
        self.assertEqual(code, 0)
        self.assertEqual([line.split(":")[0] for line in output.splitlines()], ["sun", "sky", "emission"])


if __name__ == "__main__":
    unittest.main()
