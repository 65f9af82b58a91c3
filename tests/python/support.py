# SPDX-License-Identifier: Apache-2.0
"""What tests share: the conformance volumes, and files baked from the courtyard."""
import functools
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

VECTORS = Path(__file__).resolve().parents[1] / "conformance/vectors"

_FOLDER = tempfile.TemporaryDirectory(prefix="tetralight_python_")


def temporary_path(name):
    return os.path.join(_FOLDER.name, name)


def vector_path(name):
    return str(VECTORS / f"{name}.probes")


def run_command(*arguments):
    command = os.environ.get("TETRALIGHT_COMMAND")
    if not command:
        raise unittest.SkipTest("TETRALIGHT_COMMAND is not set")
    return subprocess.run([command, *map(str, arguments)], check=True, capture_output=True, text=True)


@functools.lru_cache(maxsize=None)
def baked(*arguments):
    """The path of a file that the command makes of the courtyard: baked("bake", ".probes", "--samples", 8)."""
    scene = os.environ.get("TETRALIGHT_COURTYARD")
    if not scene or not os.path.exists(scene):
        raise unittest.SkipTest("TETRALIGHT_COURTYARD is not set")
    name, extension, *options = arguments
    path = temporary_path(f"{len(os.listdir(_FOLDER.name))}{extension}")
    run_command(name, scene, "-o", path, "--quiet", *options)
    return path
