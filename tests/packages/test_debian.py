# SPDX-License-Identifier: Apache-2.0
"""The Debian packages are built from this build, checked by lintian, installed, used and removed: in a new Debian
system (mmdebstrap) where the mirror can be reached, or in an empty folder. This system is never changed."""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from systems import MIRROR, can_make_system, can_reach_mirror, run

SOURCES = Path(os.environ["TETRALIGHT_SOURCES"])
BUILD = Path(os.environ["TETRALIGHT_BUILD"])
HERE = Path(__file__).resolve().parent
USED = "/tmp/tetralight"

INSTALL = f"""set -e
export DEBIAN_FRONTEND=noninteractive
size() {{ dpkg-query -W -f '${{Installed-Size}}\\n' | awk '{{sum += $1}} END {{print sum}}'; }}
cd {USED}
size >size_before
[ ! -e ./debs/libtetralight0_*.deb ] || apt-get install -qq -y --no-install-recommends ./debs/libtetralight0_*.deb
size >size_runtime
apt-get install -qq -y --no-install-recommends ./debs/tetralight_*.deb
size >size_command
apt-get install -qq -y --no-install-recommends ./debs/*.deb gcc libc6-dev libstdc++-12-dev pkg-config
chown -R nobody .
su -s /bin/sh nobody -c 'sh use_packages.sh {USED}'
ls debs | sed 's/_.*//' >packages
xargs dpkg -L <packages | sort -u >paths
xargs apt-get purge -qq -y --autoremove <packages
while read -r path; do [ -d "$path" ] || [ ! -e "$path" ] || echo "$path"; done <paths >left
find / -xdev -iname '*tetralight*' -not -path '{USED}*' -not -path '/proc/*' -not -path '/var/cache/apt/*' >>left
"""


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="tetralight_packages_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.debs = cls.folder / "debs"
        run("cpack", "-G", "DEB", "-B", cls.debs, cwd=BUILD)
        shutil.rmtree(cls.debs / "_CPack_Packages")
        cls.names = sorted(path.name.split("_")[0] for path in cls.debs.glob("*.deb"))

    def test_lintian_has_no_error_and_no_warning(self):
        if not shutil.which("lintian"):
            self.skipTest("lintian is missing")
        print(run("lintian", "--allow-root", "--fail-on", "error,warning", *self.debs.glob("*.deb")))

    def test_licences_stay_apart(self):
        """Only the two backends have a copyleft licence, and nothing depends on them."""
        for deb in self.debs.glob("*.deb"):
            name = deb.name.split("_")[0]
            root = self.folder / "unpacked" / name
            root.mkdir(parents=True)
            run("dpkg-deb", "-x", deb, root)
            text = (root / "usr/share/doc" / name / "copyright").read_text()
            whole = re.search(r"^Files: \*\n.*?^License: (\S+)", text, re.M | re.S)[1]
            expected = {"tetralight-cgal": "GPL-3+", "tetralight-tetgen": "AGPL-3+"}
            self.assertEqual(whole, expected.get(name, "Apache-2.0"), name)
            depends = run("dpkg-deb", "-f", deb, "Depends", "Recommends")
            for backend in expected:
                self.assertNotIn(backend, depends)
            used = set(re.findall(r"^License: (\S+)", text, re.M))
            texts = {match[1] for match in re.finditer(r"^License: (\S+)\n ", text, re.M)}
            self.assertEqual(used, texts, f"{name}: each licence has its text")

    def test_installed_used_and_removed(self):
        used = self.folder / "tetralight"
        used.mkdir()
        shutil.copytree(self.debs, used / "debs")
        for path in (SOURCES / "examples/scenes/courtyard.glb", HERE / "light.c", HERE / "use_packages.sh"):
            shutil.copy(path, used)
        if can_make_system() and can_reach_mirror():
            self.in_new_system(used)
        else:
            print("no new system can be made here: the packages are installed in an empty folder")
            self.in_folder(used)
        self.check_results(used)

    def in_new_system(self, used):
        (used / "install.sh").write_text(INSTALL)
        cache = BUILD / "debian_cache"
        cache.mkdir(exist_ok=True)
        run("mmdebstrap", "--variant=minbase", "--skip=download/empty,essential/unlink",
            "--dpkgopt=force-unsafe-io",
            '--setup-hook=mkdir -p "$1"/var/cache/apt/archives',
            f"--setup-hook=sync-in {cache} /var/cache/apt/archives",
            f'--customize-hook=mkdir "$1"{USED}', f"--customize-hook=sync-in {used} {USED}",
            f'--customize-hook=chroot "$1" sh {USED}/install.sh >&2',
            f"--customize-hook=sync-out {USED} {used}",
            f"--customize-hook=sync-out /var/cache/apt/archives {cache}",
            "bookworm", "/dev/null", MIRROR)
        before, runtime, command = (int((used / f"size_{name}").read_text())
                                    for name in ("before", "runtime", "command"))
        print(f"installed with all that it needs: runtime library {runtime - before} KiB, "
              f"command {command - runtime} KiB")

    def in_folder(self, used):
        root = self.folder / "root"
        for folder in ("var/lib/dpkg/updates", "var/lib/dpkg/info"):
            (root / folder).mkdir(parents=True)
        (root / "var/lib/dpkg/status").touch()
        dpkg = [*([] if os.getuid() == 0 else ["fakeroot"]), "dpkg", f"--root={root}", "--force-depends",
                "--force-script-chrootless", "--force-not-root"]
        run(*dpkg, "-i", *self.debs.glob("*.deb"))
        run("sh", used / "use_packages.sh", used, root)
        run(*dpkg, "--purge", *self.names)
        left = [str(path) for path in root.rglob("*") if path.is_file() and "var/lib/dpkg" not in str(path)]
        (used / "left").write_text("\n".join(left))

    def check_results(self, used):
        self.assertEqual((used / "left").read_text(), "", "files that stay when the packages are gone")
        version = re.search(r"^project\(tetralight VERSION (\S+)", (SOURCES / "CMakeLists.txt").read_text(), re.M)[1]
        self.assertEqual((used / "version").read_text(), f"tetralight {version}\n")
        sh = json.loads((used / "answer.json").read_text())["irradiance_sh"]
        # E(n) with n = +Y: the polynomials y, 3z^2 - 1 and x^2 - y^2 are 1, -1 and -1.
        above = sh[0][0] * 0.282095 + sh[1][0] * 0.488603 - sh[6][0] * 0.315392 - sh[8][0] * 0.546274
        self.assertAlmostEqual(float((used / "light.txt").read_text()), above / math.pi, delta=1e-4 * abs(above))
        if "python3-tetralight" in self.names:
            self.assertAlmostEqual(float((used / "python.txt").read_text()), above, delta=1e-3 * abs(sh[0][0]))
        ours = json.loads((used / "tetralight.json").read_text())
        for backend in ("cgal", "tetgen"):
            theirs = json.loads((used / f"{backend}.json").read_text())
            self.assertEqual(theirs["probes"], ours["probes"])
        self.assertIn('"serving"', (used / "serve.log").read_text())
        if "tetralight-viewer" in self.names:
            self.assertIn("/usr/share/tetralight/viewer", (used / "serve.log").read_text())


if __name__ == "__main__":
    unittest.main(verbosity=2, argv=[sys.argv[0], *sys.argv[1:]])
