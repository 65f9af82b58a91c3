# SPDX-License-Identifier: Apache-2.0
"""Volumes for tests of exports with the programs that read them, and what the command says about their light."""
import json
import math
import os
import subprocess
import sys

TETRALIGHT = os.environ["TETRALIGHT_COMMAND"]
COURTYARD = os.environ["TETRALIGHT_COURTYARD"]


def tetralight(*arguments, **options):
    done = subprocess.run([TETRALIGHT, *map(str, arguments)], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return done.stdout


def bake_courtyard(path, *options):
    tetralight("bake", COURTYARD, "-o", path, "-s", "16", "-q", *options)


def skip(why):
    """Ends the program as CTest expects of a test that cannot run."""
    print("skipped: " + why)
    sys.exit(77)


def read_json(path):
    return json.loads(path.read_text())


def sh_basis(n):
    x, y, z = n
    return [0.28209479, 0.48860251 * y, 0.48860251 * z, 0.48860251 * x, 1.09254843 * x * y, 1.09254843 * y * z,
            0.31539157 * (3 * z * z - 1), 1.09254843 * x * z, 0.54627422 * (x * x - y * y)]


def irradiance(coefficients, normal):
    """RGB irradiance of nine times three coefficients, one after the other."""
    basis = sh_basis(normal)
    return [sum(basis[i] * coefficients[3 * i + c] for i in range(9)) for c in range(3)]


def normals():
    """Along the axes and into the octants."""
    d = 1 / math.sqrt(3)
    axes = [tuple(s if i == axis else 0 for i in range(3)) for axis in range(3) for s in (1, -1)]
    return axes + [(x * d, y * d, z * d) for x in (1, -1) for y in (1, -1) for z in (1, -1)]
