# SPDX-License-Identifier: Apache-2.0
"""run_blender.py MODULE: runs the tests of a module in Blender, without a window.
run_blender.py --window: runs in_window.py in a Blender with a window on a virtual screen.

Ends with 77, which CTest counts as skipped, where Blender, the NumPy that its glTF exporter needs, or the virtual
screen is missing.
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


def run_in_window(folder, environment):
    screen = shutil.which("xvfb-run")
    if not screen:
        skip("there is no virtual screen (Debian package xvfb)")
    command = [screen, "-a", "-s", "-screen 0 1280x800x24", blender, "--factory-startup", "--enable-event-simulate",
               "--window-geometry", "0", "0", "1280", "800", "--python", str(HERE / "in_window.py"), "--", folder]
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(done.stdout)
    has_passed = "all steps passed" in done.stdout
    if not has_passed and "OpenGL" in done.stdout:
        skip("the virtual screen has no OpenGL that Blender can use")
    # Blender prints errors of panels, and goes on.
    return 0 if has_passed and "Traceback" not in done.stdout else 1


def main(test):
    # An empty folder of settings: what the user has installed and saved is neither read nor changed.
    with tempfile.TemporaryDirectory(prefix="tetralight_blender_") as folder:
        users = {"BLENDER_USER_CONFIG": folder + "/config", "BLENDER_USER_SCRIPTS": folder + "/scripts"}
        environment = {**os.environ, **users, "PATH": SYSTEM_PATH}
        for path in users.values():
            Path(path).mkdir()
        if run(["--python-expr", "import numpy"], environment) != 0:
            skip("Blender has no NumPy (Debian package python3-numpy)")
        if test == "--window":
            return run_in_window(folder, environment)
        return run(["--python", str(HERE / "in_blender.py"), "--", test], environment)


blender = shutil.which("blender")
if not blender:
    skip("Blender is not installed (Debian package blender)")
sys.exit(main(sys.argv[1]))
