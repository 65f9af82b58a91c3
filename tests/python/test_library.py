# SPDX-License-Identifier: Apache-2.0
import os
import subprocess
import sys
import unittest

import tetralight


def import_with(library):
    """What the import prints where TETRALIGHT_LIBRARY names another file."""
    environment = {**os.environ, "TETRALIGHT_LIBRARY": library}
    command = [sys.executable, "-c", "import tetralight"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    return done.returncode, done.stderr.splitlines()[-1] if done.stderr else ""


class Library(unittest.TestCase):
    def test_a_missing_one_is_named(self):
        code, message = import_with("/no/such/library.so")
        self.assertEqual(code, 1)
        self.assertIn("ImportError: /no/such/library.so", message)

    def test_another_one_is_refused(self):
        code, message = import_with("libm.so.6")
        self.assertEqual(code, 1)
        self.assertIn("ImportError: libm.so.6: not the library of this version", message)

    def test_does_not_import_what_it_does_not_need(self):
        """The import stays short."""
        code = "import sys, numpy; before = set(sys.modules); import tetralight; print(*set(sys.modules) - before)"
        done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
        loaded = set(done.stdout.split())
        for name in ("asyncio", "concurrent.futures", "http", "json", "logging", "subprocess", "urllib", "zlib"):
            self.assertNotIn(name, loaded)

    def test_the_version_is_that_of_the_library(self):
        self.assertRegex(tetralight.__version__, r"^\d+\.\d+\.\d+$")
