# SPDX-License-Identifier: Apache-2.0
"""The service under systemd itself, in a new system that boots (systemd-nspawn): bakes, queries and pictures work within
the sandbox of the unit, and programs still restrict themselves by Landlock. Only with TETRALIGHT_NIGHTLY=1, as root."""
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from systems import MIRROR, can_make_system, can_reach_mirror, is_nightly, run

SOURCES = Path(os.environ["TETRALIGHT_SOURCES"])
BUILD = Path(os.environ["TETRALIGHT_BUILD"])
HERE = Path(__file__).resolve().parent
CHECK = """[Unit]
After=tetralight.service
[Service]
Type=oneshot
ExecStart=/bin/sh /check_unit.sh
ExecStopPost=/bin/systemctl poweroff --no-block
"""
INSTALL = """set -e
apt-get install -qq -y --no-install-recommends /debs/*.deb
systemctl enable tetralight.service
mkdir /result /etc/systemd/system/multi-user.target.wants -p
ln -s /etc/systemd/system/check.service /etc/systemd/system/multi-user.target.wants/
"""


def landlock_version(log):
    """The version that the log of a server says that it has."""
    return re.search(r'"landlock":(\d+)', log)[1]


def can_boot():
    return (is_nightly() and os.getuid() == 0 and shutil.which("systemd-nspawn")
            and can_make_system() and can_reach_mirror())


@unittest.skipUnless(can_boot(), "needs TETRALIGHT_NIGHTLY=1, root, systemd-nspawn and a mirror of Debian")
class Unit(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="tetralight_unit_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.root = self.folder / "root"

    def make_root(self):
        files = self.folder / "files"
        (files / "etc/systemd/system").mkdir(parents=True)
        (files / "etc/systemd/system/check.service").write_text(CHECK)
        (files / "install.sh").write_text(INSTALL)
        for path in (HERE / "check_unit.sh", SOURCES / "examples/scenes/courtyard.glb"):
            shutil.copy(path, files)
        run("cpack", "-G", "DEB", "-B", files / "debs", "-D", "CPACK_COMPONENTS_ALL=program;server;viewer", cwd=BUILD)
        shutil.rmtree(files / "debs/_CPack_Packages")
        run("mmdebstrap", "--variant=minbase", "--dpkgopt=force-unsafe-io", "--include=systemd-sysv,dbus,curl",
            f"--customize-hook=sync-in {files} /", '--customize-hook=chroot "$1" sh /install.sh >&2',
            "bookworm", self.root, MIRROR)

    def boot(self):
        # Its own filter of system calls knows no Landlock.
        landlock = "landlock_create_ruleset landlock_add_rule landlock_restrict_self"
        with subprocess.Popen(["systemd-nspawn", "-D", self.root, "--register=no", "--keep-unit", "--boot",
                               f"--system-call-filter={landlock}"], stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as system:
            try:
                system.wait(600)
            finally:
                system.kill()

    def test_everything_works_in_its_sandbox(self):
        self.make_root()
        self.boot()
        result = self.root / "result"
        text = {path.name: path.read_text(errors="replace") for path in result.iterdir()}
        self.assertIn("done", text)
        self.assertNotIn("failed", text)
        self.assertEqual(re.findall(r" (\d+)$", text["statuses"], re.M), ["201", "202", "200", "200", "200"])
        self.assertEqual((result / "picture.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual(len(json.loads(text["answer.json"])["answers"]), 1)
        self.assertEqual(text["rights"].split(), ["CapEff:", "0" * 16, "NoNewPrivs:", "1", "Seccomp:", "2"])
        self.assertEqual(set(text["ended"].split()), {"Result=success", "ExecMainStatus=0"})
        self.assertEqual(landlock_version(text["journal"]), self.landlock_version_here(), "the unit forbids Landlock")

    def landlock_version_here(self):
        """Of a server on this kernel without a unit."""
        with subprocess.Popen([BUILD / "tetralight", "serve", "--data", self.folder / "data", "--listen", "127.0.0.1:0"],
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as server:
            server.stdout.readline()
            server.terminate()
            return landlock_version(server.communicate()[1])


if __name__ == "__main__":
    unittest.main()
