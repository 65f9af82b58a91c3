# SPDX-License-Identifier: Apache-2.0
"""Runs the code of docs/python.md."""
import os
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from support import baked

PAGE = Path(__file__).resolve().parents[2] / "docs/python.md"


class Page(unittest.TestCase):
    def test_its_code_runs(self):
        blocks = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
        self.assertGreater(len(blocks), 4)
        self.assertLessEqual(len(blocks[0].splitlines()), 10)
        files = {
            "courtyard.probes": baked("bake", ".probes", "--samples", "8", "--layers", "sky,sun,transfer"),
            "courtyard.lightmaps": baked("lightmap", ".lightmaps", "--samples", "1", "--texels-per-meter", "1"),
        }
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            for name, path in files.items():
                shutil.copyfile(path, os.path.join(folder, name))
            os.chdir(folder)
            try:
                names = {}
                for block in blocks:
                    exec(compile(block, str(PAGE), "exec"), names)
                self.assertEqual(Path("floor.png").read_bytes()[:4], b"\x89PNG")
                self.assertTrue(Path("evening.probes").exists())
            finally:
                os.chdir(before)
