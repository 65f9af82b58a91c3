# SPDX-License-Identifier: Apache-2.0
"""Builds the wheel, installs it without an index into a new environment, and runs the tests there."""
import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
INSTALLED_TESTS = ("errors", "conformance", "query", "arguments", "arrays", "layers", "pictures", "lppv", "surfaces")


def run(*command, **options):
    finished = subprocess.run([*map(str, command)], capture_output=True, text=True, **options)
    if finished.returncode != 0:
        raise AssertionError(f"{command[0]} failed:\n{finished.stdout}{finished.stderr}")
    return finished.stdout + finished.stderr


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        missing = [name for name in ("build", "setuptools", "wheel", "venv") if importlib.util.find_spec(name) is None]
        library = os.environ.get("TETRALIGHT_LIBRARY")
        if missing or not library:
            raise unittest.SkipTest(f"missing: {', '.join(missing) or 'TETRALIGHT_LIBRARY'}")
        cls.folder = tempfile.TemporaryDirectory(prefix="tetralight_wheel_")
        cls.addClassCleanup(cls.folder.cleanup)
        script = PROJECT / "packages/python/make_wheel.sh"
        environment = {**os.environ, "PYTHON": sys.executable}
        cls.path = run(script, library, cls.folder.name, env=environment).splitlines()[-1]

    def test_serves_every_python_3(self):
        version = re.search(r"tetralight VERSION ([0-9.]+)", (PROJECT / "CMakeLists.txt").read_text()).group(1)
        machine = os.uname().machine
        self.assertEqual(Path(self.path).name, f"tetralight-{version}-py3-none-linux_{machine}.whl")

    def test_holds_modules_library_and_licence(self):
        names = set(zipfile.ZipFile(self.path).namelist())
        sources = {f"tetralight/{path.name}" for path in (PROJECT / "packages/python/src/tetralight").glob("*.py")}
        self.assertLessEqual(sources | {"tetralight/libtetralight.so.0", "tetralight/py.typed", "tetralight/LICENSE"}, names)

    def test_installs_without_an_index_and_passes_the_tests(self):
        place = Path(self.folder.name) / "environment"
        run(sys.executable, "-m", "venv", "--system-site-packages", place)
        python = place / "bin/python"
        names = ("TETRALIGHT_LIBRARY", "PYTHONPATH")
        environment = {name: value for name, value in os.environ.items() if name not in names}
        run(python, "-m", "pip", "install", "--quiet", "--no-index", "--no-build-isolation", self.path, env=environment)
        where = run(python, "-c", "import tetralight; print(tetralight.__file__)", env=environment, cwd=self.folder.name)
        self.assertTrue(where.startswith(str(place)), where)
        tests = Path(__file__).resolve().parent / "run_tests.py"
        run(python, tests, *INSTALLED_TESTS, env=environment, cwd=self.folder.name)
        run(python, "-m", "pip", "uninstall", "--quiet", "--yes", "tetralight", env=environment)
