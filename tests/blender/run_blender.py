# SPDX-License-Identifier: Apache-2.0
"""run_blender.py MODULE: runs the tests of a module in Blender, without a window.

Ends with 77, which CTest counts as skipped, where Blender or the NumPy that its glTF exporter needs is missing.
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SYSTEM_PATH = "/usr/bin:/bin"  # Debian's Blender takes NumPy from the first python3 of PATH
SKIPPED = 77


def skip(reason):
    print("skipped:", reason)
    sys.exit(SKIPPED)


def run(arguments, environment):
    command = [blender, "-b", "--factory-startup", "--python-exit-code", "1", *arguments]
    return subprocess.run(command, env=environment).returncode


blender = shutil.which("blender")
if not blender:
    skip("Blender is not installed (Debian package blender)")
# An empty folder of settings: what the user has installed and saved is neither read nor changed.
with tempfile.TemporaryDirectory(prefix="tetralight_blender_") as folder:
    users = {"BLENDER_USER_CONFIG": folder + "/config", "BLENDER_USER_SCRIPTS": folder + "/scripts"}
    environment = {**os.environ, **users, "PATH": SYSTEM_PATH}
    for path in users.values():
        Path(path).mkdir()
    if run(["--python-expr", "import numpy"], environment) != 0:
        skip("Blender has no NumPy (Debian package python3-numpy)")
    sys.exit(run(["--python", str(HERE / "in_blender.py"), "--", sys.argv[1]], environment))
