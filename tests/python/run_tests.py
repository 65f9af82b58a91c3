# SPDX-License-Identifier: Apache-2.0
"""Runs test_NAME.py for each argument, or every test. Exit code 77: NumPy is missing."""
import importlib.util
import sys
import unittest
from pathlib import Path

FOLDER = Path(__file__).resolve().parent


def main(names):
    if importlib.util.find_spec("numpy") is None:
        print("skipped: NumPy is missing")
        return 77
    names = names or sorted(path.stem[len("test_"):] for path in FOLDER.glob("test_*.py"))
    sys.path.insert(0, str(FOLDER))
    suite = unittest.defaultTestLoader.loadTestsFromNames([f"test_{name}" for name in names])
    return 0 if unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
