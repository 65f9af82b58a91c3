# SPDX-License-Identifier: Apache-2.0
"""Run by Blender: the tests of a module that `run_blender.py` names."""
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "packages/blender")]

suite = unittest.defaultTestLoader.loadTestsFromName(sys.argv[-1])
result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(suite)
sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
