# SPDX-License-Identifier: Apache-2.0
"""Every file that repeats the version of the project has that of CMakeLists.txt, and no other file repeats it."""
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCES = Path(os.environ["TETRALIGHT_SOURCES"])
BUILD = Path(os.environ["TETRALIGHT_BUILD"])
sys.path.insert(0, str(SOURCES / "packages/release"))
import version  # noqa: E402

# Pages that name versions that were, and what other projects call theirs.
OTHERS = ("CHANGELOG.md", "docs/licences.md", "docs/release.md", "package-lock.json")


class Version(unittest.TestCase):
    def test_all_places_agree(self):
        self.assertEqual(version.differing(), [])

    def test_the_command_has_it(self):
        printed = subprocess.run([BUILD / "tetralight", "--version"], text=True, stdout=subprocess.PIPE, check=True)
        self.assertEqual(printed.stdout, f"tetralight {version.current()}\n")

    def test_no_other_file_repeats_it(self):
        known = {path for path, _, _ in version.PLACES}
        number = re.compile(rf"(?<![\d.]){re.escape(version.current())}(?![\d.])")
        listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=SOURCES, text=True,
                                stdout=subprocess.PIPE, check=True).stdout.splitlines()
        for name in listed:
            if name in known or name.endswith(OTHERS) or not (SOURCES / name).is_file():
                continue
            text = (SOURCES / name).read_bytes().decode(errors="replace")
            for line in text.splitlines():
                if number.search(line) and "tetralight" in line.lower():
                    self.fail(f"{name}: {line.strip()[:200]}")

    def test_the_changelog_has_a_day_for_it(self):
        """The bump comes with the entry of the release (docs/release.md)."""
        text = (SOURCES / "CHANGELOG.md").read_text()
        self.assertRegex(text, rf"(?m)^## \[{re.escape(version.current())}\] - \d{{4}}-\d\d-\d\d$")


if __name__ == "__main__":
    unittest.main()
