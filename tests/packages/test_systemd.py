# SPDX-License-Identifier: Apache-2.0
"""The unit of the service: systemd accepts it, its sandbox is tight, and nothing that the service needs is forbidden."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCES = Path(os.environ["TETRALIGHT_SOURCES"])
UNIT = SOURCES / "packages/systemd/tetralight.service"
# systemd's measure: 0 = nothing is allowed, 10 = everything is. Below 2 it says "OK".
LARGEST_EXPOSURE = 1.5


def settings():
    found = {}
    for key, value in re.findall(r"^([A-Za-z]+)=(.*)$", UNIT.read_text(), re.M):
        found.setdefault(key, []).append(value)
    return found


def analyze(*arguments):
    return subprocess.run(["systemd-analyze", *arguments], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


@unittest.skipUnless(shutil.which("systemd-analyze"), "systemd is missing")
class Analyzed(unittest.TestCase):
    def test_systemd_accepts_it(self):
        with tempfile.TemporaryDirectory() as folder:
            unit = Path(folder) / "tetralight.service"
            # The program and its manual page are not installed where the tests run.
            text = UNIT.read_text().replace("/usr/bin/tetralight", "/bin/true")
            unit.write_text(re.sub("^Documentation=.*\n", "", text, flags=re.M))
            done = analyze("verify", "--man=no", str(unit))
            self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_its_sandbox_is_tight(self):
        done = analyze("security", "--offline=yes", "--no-pager", str(UNIT))
        exposure = re.search(r"Overall exposure level for tetralight.service: ([\d.]+)", done.stdout)
        self.assertTrue(exposure, done.stdout)
        print(exposure[0])
        self.assertLessEqual(float(exposure[1]), LARGEST_EXPOSURE, done.stdout)


class Needs(unittest.TestCase):
    def test_programs_may_restrict_themselves(self):
        allowed = " ".join(settings()["SystemCallFilter"])
        for call in ("landlock_create_ruleset", "landlock_add_rule", "landlock_restrict_self"):
            self.assertIn(call, allowed)
        self.assertNotIn("~@resources", allowed)  # setpriority, prlimit64

    def test_files_of_the_kernel_that_it_reads_stay_visible(self):
        """base/process/landlock.cpp names them: all of /proc, not only processes."""
        self.assertIn('"/proc/meminfo"', (SOURCES / "base/process/landlock.cpp").read_text())
        self.assertNotIn("ProcSubset", settings())

    def test_a_program_that_takes_too_much_memory_does_not_end_the_server(self):
        self.assertEqual(settings()["OOMPolicy"], ["continue"])
        self.assertIn("MemoryMax", settings())

    def test_requests_in_progress_keep_their_programs(self):
        self.assertEqual(settings()["KillMode"], ["mixed"])

    def test_its_options_are_those_of_the_file_of_options(self):
        self.assertEqual(settings()["EnvironmentFile"], ["-/etc/default/tetralight"])
        self.assertIn("$TETRALIGHT_OPTIONS", settings()["ExecStart"][0])
        options = (UNIT.parent / "tetralight.default").read_text()
        self.assertRegex(options, r'(?m)^TETRALIGHT_OPTIONS="--listen 127\.0\.0\.1:\d+"$')


if __name__ == "__main__":
    unittest.main()
