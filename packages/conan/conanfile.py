# SPDX-License-Identifier: Apache-2.0
"""The ship set for Conan 2, from the sources around this recipe: conan create packages/conan

Untried: written from Conan's documentation, without a run of it (docs/install.md).
"""
import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

FOLDERS = ("base", "cmake", "examples", "lightmap", "lppv", "packages", "probes", "reflection", "runtime")


class Tetralight(ConanFile):
    name = "tetralight"
    description = "Baked light probes at run time: locate, interpolate and shade with them"
    license = "Apache-2.0"
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"fPIC": [True, False], "with_highway": [True, False]}
    default_options = {"fPIC": True, "with_highway": True}

    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        lists = load(self, os.path.join(self._root(), "CMakeLists.txt"))
        self.version = re.search(r"project\(tetralight VERSION (\S+)", lists)[1]

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", *(f"{folder}/*" for folder in FOLDERS)):
            copy(self, pattern, self._root(), self.export_sources_folder, excludes="*/node_modules/*")

    def config_options(self):
        if self.settings.os == "Windows":
            del self.options.fPIC

    def requirements(self):
        self.requires("glm/[>=0.9.9]", transitive_headers=True)
        self.requires("xxhash/[>=0.8]")
        if self.options.with_highway:
            self.requires("highway/[>=1.0]")

    def validate(self):
        check_min_cppstd(self, 20)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["TETRALIGHT_BUILD_OFFLINE"] = False
        toolchain.cache_variables["TETRALIGHT_BUILD_SHARED"] = False
        toolchain.cache_variables["TETRALIGHT_BUILD_TESTS"] = False
        toolchain.cache_variables["TETRALIGHT_INSTALL"] = True
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # find_package(tetralight) takes the files that the package has itself.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs.append(os.path.join("lib", "cmake", "tetralight"))
