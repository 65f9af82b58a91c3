# SPDX-License-Identifier: Apache-2.0
"""The recipes of vcpkg and Conan, which no test runs: their form, their version, and the options that they set."""
import ast
import json
import os
import re
import unittest
from pathlib import Path

SOURCES = Path(os.environ["TETRALIGHT_SOURCES"])
LISTS = (SOURCES / "CMakeLists.txt").read_text()
VERSION = re.search(r"project\(tetralight VERSION (\S+)", LISTS)[1]
OPTIONS = set(re.findall(r"(?:option|cmake_dependent_option)\(\s*(TETRALIGHT_\w+)", LISTS))
PORT = SOURCES / "packages/vcpkg/tetralight"
CONAN = SOURCES / "packages/conan/conanfile.py"


class Recipes(unittest.TestCase):
    def test_they_set_options_that_exist(self):
        for path in (PORT / "portfile.cmake", CONAN):
            named = set(re.findall(r"TETRALIGHT_\w+", path.read_text()))
            self.assertTrue(named)
            self.assertLessEqual(named, OPTIONS, path)

    def test_they_say_that_they_are_untried(self):
        for path in (PORT / "portfile.cmake", CONAN):
            self.assertIn("Untried", path.read_text())

    def test_the_port_has_the_version_of_the_project(self):
        self.assertEqual(json.loads((PORT / "vcpkg.json").read_text())["version"], VERSION)

    def test_the_port_depends_on_what_the_ship_set_links(self):
        names = {entry for entry in json.loads((PORT / "vcpkg.json").read_text())["dependencies"]
                 if isinstance(entry, str)}
        self.assertEqual(names, {"glm", "highway", "xxhash"})
        for library in names:
            self.assertIn(f'"{library}/', CONAN.read_text())

    def test_conan_s_recipe_is_python_and_names_folders_that_exist(self):
        tree = ast.parse(CONAN.read_text())
        folders = next(ast.literal_eval(node.value) for node in tree.body
                       if isinstance(node, ast.Assign) and node.targets[0].id == "FOLDERS")
        for folder in folders:
            self.assertTrue((SOURCES / folder).is_dir(), folder)
        # Those that the build without the baker enters.
        head = LISTS.split("if(TETRALIGHT_BUILD_OFFLINE OR")[0]
        for folder in re.findall(r"add_subdirectory\((\w+)", head):
            self.assertIn(folder, folders)


if __name__ == "__main__":
    unittest.main()
