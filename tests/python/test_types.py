# SPDX-License-Identifier: Apache-2.0
"""The annotations of the package, checked by mypy."""
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import tetralight

PACKAGE = Path(__file__).resolve().parents[2] / "packages/python"


class Types(unittest.TestCase):
    def assert_finds_nothing(self, *arguments):
        command = shutil.which("mypy")
        if not command:
            self.skipTest("mypy is missing")
        with tempfile.TemporaryDirectory() as cache:
            found = subprocess.run(
                [command, "--strict", "--cache-dir", cache, "--python-executable", sys.executable, *arguments],
                cwd=PACKAGE,
                env={**os.environ, "MYPYPATH": str(PACKAGE / "src")},
                capture_output=True,
                text=True,
            )
        self.assertEqual(found.returncode, 0, found.stdout + found.stderr)

    def test_mypy_finds_nothing(self):
        self.assert_finds_nothing("src")

    def test_programs_may_use_each_name(self):
        names = "".join(f"print(tetralight.{name})\n" for name in tetralight.__all__)
        self.assert_finds_nothing("-c", f"import tetralight\n{names}")

    def test_the_marker_is_installed(self):
        found = importlib.util.find_spec("tetralight")
        self.assertTrue((Path(found.origin).parent / "py.typed").exists())
