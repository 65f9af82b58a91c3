# SPDX-License-Identifier: Apache-2.0
"""Runs the tests on NumPy 2 and a newer Python: those of Debian 13, in a folder that mmdebstrap fills once."""
import os
import shutil
import subprocess
import tempfile
import unittest
import zipfile
from pathlib import Path

TESTS = Path(__file__).resolve().parent
PROJECT = TESTS.parents[1]
NAMES = ("errors", "arguments", "arrays", "conformance", "layers", "lppv", "meshes", "pictures", "query")
PACKAGES = "python3,python3-numpy"


def system_folder():
    """A root folder with Debian 13, its Python and its NumPy."""
    folder = os.environ.get("TETRALIGHT_TRIXIE")
    if not folder:
        raise unittest.SkipTest("TETRALIGHT_TRIXIE is not set")
    if os.path.exists(f"{folder}/usr/bin/python3"):
        return Path(folder)
    if os.getuid() != 0 or not shutil.which("mmdebstrap"):
        raise unittest.SkipTest("needs root and mmdebstrap")
    part = folder + ".part"
    shutil.rmtree(part, ignore_errors=True)
    os.makedirs(os.path.dirname(part), exist_ok=True)
    command = ["mmdebstrap", "--quiet", "--variant=apt", f"--include={PACKAGES}", "trixie", part]
    made = subprocess.run(command, capture_output=True, text=True)
    if made.returncode != 0:
        shutil.rmtree(part, ignore_errors=True)
        raise unittest.SkipTest(f"Debian 13 cannot be installed: {made.stderr[-300:]}")
    os.rename(part, folder)
    return Path(folder)


class NumPy2(unittest.TestCase):
    def in_system(self, root, *command):
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL": "C.UTF-8"}
        finished = subprocess.run(["chroot", str(root), *command], env=environment, capture_output=True, text=True)
        self.assertEqual(finished.returncode, 0, finished.stdout + finished.stderr)
        return finished.stdout

    def test_the_wheel_passes_the_tests(self):
        root = system_folder()
        version = self.in_system(root, "python3", "-c", "import numpy; print(numpy.__version__)")
        self.assertTrue(version.startswith("2."), version)
        with tempfile.TemporaryDirectory(dir=root / "tmp") as place, tempfile.TemporaryDirectory() as output:
            script = PROJECT / "packages/python/make_wheel.sh"
            subprocess.run([script, os.environ["TETRALIGHT_LIBRARY"], output], check=True, capture_output=True)
            (wheel,) = Path(output).glob("*.whl")
            zipfile.ZipFile(wheel).extractall(f"{place}/site")
            for folder in ("python", "conformance"):
                shutil.copytree(TESTS.parent / folder, f"{place}/tests/{folder}")
            inside = "/" + str(Path(place).relative_to(root))
            command = f"PYTHONPATH={inside}/site python3 -B {inside}/tests/python/run_tests.py {' '.join(NAMES)}"
            self.in_system(root, "sh", "-c", command)
