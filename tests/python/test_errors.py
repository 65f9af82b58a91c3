# SPDX-License-Identifier: Apache-2.0
import unittest

import tetralight


class Errors(unittest.TestCase):
    def test_each_has_a_code_of_its_own(self):
        classes = tetralight.Error.__subclasses__()
        self.assertEqual(len({error.code for error in classes}), len(classes))

    def test_carries_code_and_message(self):
        error = tetralight.Corrupt("a.probes: wrong checksum")
        self.assertEqual((error.code, error.message), ("corrupt", "a.probes: wrong checksum"))
        self.assertEqual(str(error), "a.probes: wrong checksum")

    def test_is_what_python_programs_expect(self):
        self.assertTrue(issubclass(tetralight.BadValue, ValueError))
        self.assertTrue(issubclass(tetralight.NotFound, FileNotFoundError))
        self.assertTrue(issubclass(tetralight.OutOfMemory, MemoryError))
