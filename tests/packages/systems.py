# SPDX-License-Identifier: Apache-2.0
"""Whether new Debian systems can be made here, for tests that install packages."""
import os
import shutil
import subprocess
import urllib.request

MIRROR = os.environ.get("TETRALIGHT_MIRROR", "http://deb.debian.org/debian")


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command} failed with {done.returncode}:\n{done.stdout}")
    return done.stdout


def is_nightly():
    """Whether the environment asks for what takes a night: TETRALIGHT_NIGHTLY=1."""
    return os.environ.get("TETRALIGHT_NIGHTLY") == "1"


def can_reach_mirror():
    try:
        with urllib.request.urlopen(f"{MIRROR}/dists/bookworm/InRelease", timeout=20):
            return True
    except OSError:
        return False


def can_make_system():
    """True if this process may make a root folder: as root, or with user namespaces."""
    return shutil.which("mmdebstrap") and subprocess.run(
        ["unshare", "--map-root-user", "--mount", "true"], stderr=subprocess.DEVNULL).returncode == 0
