# SPDX-License-Identifier: Apache-2.0
"""Builds the wheel: the package with the shared library inside. `./run package python` calls this.

TETRALIGHT_LIBRARY is the path of libtetralight.so.0, in a folder that holds only it and what it needs. The version is that of CMakeLists.txt."""
import os
import re
import shutil
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.dist import Distribution
from wheel.bdist_wheel import bdist_wheel

PROJECT = Path(__file__).resolve().parents[2]


def project_version() -> str:
    text = (PROJECT / "CMakeLists.txt").read_text(encoding="utf-8")
    found = re.search(r"^project\(tetralight VERSION ([0-9.]+)", text, re.MULTILINE)
    if found is None:
        raise RuntimeError(f"{PROJECT}/CMakeLists.txt: no version of the project")
    return found.group(1)


class BuildWithLibrary(build_py):
    """Copies the shared libraries and the licence beside the modules."""

    def run(self) -> None:
        super().run()
        library = os.environ.get("TETRALIGHT_LIBRARY")
        if not library:
            raise RuntimeError("TETRALIGHT_LIBRARY is not set: the path of libtetralight.so.0")
        package = Path(self.build_lib) / "tetralight"
        for path in Path(library).parent.glob("*.so.*"):
            shutil.copyfile(path, package / path.name)
        shutil.copyfile(PROJECT / "LICENSE", package / "LICENSE")


class PlatformWheel(bdist_wheel):
    """One wheel for every Python 3: the library does not use Python's own interface."""

    def get_tag(self) -> tuple[str, str, str]:
        return "py3", "none", super().get_tag()[2]


class PlatformDistribution(Distribution):
    def has_ext_modules(self) -> bool:
        return True


setup(
    version=project_version(),
    cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel},
    distclass=PlatformDistribution,
)
