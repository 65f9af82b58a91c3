# SPDX-License-Identifier: Apache-2.0
"""Bills of materials: their structure, and the list of compiled-in libraries against what the build reads."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCES = Path(os.environ["TETRALIGHT_SOURCES"])
BUILD = Path(os.environ["TETRALIGHT_BUILD"])
sys.path.insert(0, str(SOURCES / "packages/sbom"))
from compiled_in import table  # noqa: E402
from make_sbom import make_sbom, needed, owners, loaded  # noqa: E402

# Headers of the compiler and the C library; what they link is in every bill.
TOOLCHAIN = {"gcc-12", "glibc", "linux"}
# Declarations alone: CGAL includes the header of MPFR, and tetralight-cgal calls none of its functions.
DECLARATIONS = {"libmpfr-dev"}
# What is linked into each package.
PRODUCTS = {"tetralight": "tetralight", "tetralight-cgal": "tetralight-cgal", "tetralight-tetgen": "tetralight-tetgen",
            "libtetralight-dev": "runtime/libtetralight_runtime.a", "libtetralight0": "runtime/libtetralight.so"}


def run(*command):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE).stdout


def objects_of(target, seen):
    """The object files that a target of the build is linked from, also through libraries. Programs that are only
    built before it (order-only) are not."""
    for line in run("ninja", "-C", BUILD, "-t", "query", target).split("outputs:")[0].splitlines():
        name = line.strip().removeprefix("| ")
        if not line.startswith("    ") or name.startswith("||") or name in seen:
            continue
        seen.add(name)
        if name.endswith(".o"):
            yield name
        elif name.endswith((".a", ".so")) and not name.startswith("/"):
            yield from objects_of(name, seen)


def header_packages(target):
    """The Debian packages whose headers are compiled into a target, with a static library into all of the ship set."""
    targets = [target]
    if target.endswith(".a"):
        targets = [f"{folder}/libtetralight_{folder}.a" for folder in ("base", "probes", "lppv", "lightmap", "reflection")]
        targets.append(target)
    seen = set()
    objects = [name for one in targets for name in objects_of(one, seen)]
    assert objects, target
    lines = run("ninja", "-C", BUILD, "-t", "deps", *objects).splitlines()
    headers = {line.strip() for line in lines if line.startswith("    /usr/include")}
    return set(owners(headers).values())


def source_of(package):
    return run("dpkg-query", "-W", "-f", "${source:Package}", package)


def bare(package):
    return package.split(":")[0]


class CompiledIn(unittest.TestCase):
    def test_the_list_is_what_the_build_reads(self):
        for package, target in PRODUCTS.items():
            path = (BUILD / target).resolve()  # the library is a link to one with its version
            if not path.exists():
                continue
            target = str(path.relative_to(BUILD.resolve()))
            linked = set()
            if path.suffix != ".a":
                direct = needed(path)
                files = {file for name, file in loaded(path).items() if name in direct}
                linked = {source_of(library) for library in owners(files).values()}
            found = {bare(name) for name in header_packages(target)
                     if source_of(name) not in TOOLCHAIN | linked and bare(name) not in DECLARATIONS}
            read = {bare(name) for name in header_packages(target)}
            listed = set(table()["packages"][package])
            self.assertLessEqual(found, listed, f"{package}: compiled in, but not in libraries.json")
            self.assertLessEqual(listed, read, f"{package}: in libraries.json, but not read by the build")

    def test_the_runtime_library_has_what_the_static_ones_have(self):
        packages = table()["packages"]
        self.assertEqual(packages["libtetralight0"], packages["libtetralight-dev"])

    def test_each_library_is_in_the_table_of_licences(self):
        licences = (SOURCES / "docs/licences.md").read_text()
        for name, row in table()["libraries"].items():
            known = {"libboost1.74-dev": "libboost-dev", "npm:three": "three.js"}.get(name, name)
            self.assertIn(known, licences, row["name"])


class Structure(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "tetralight").write_bytes((BUILD / "tetralight").read_bytes())
        self.sbom = make_sbom("tetralight", self.root, "1.2.3-1")

    def test_it_has_what_spdx_requires(self):
        for key in ("spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo"):
            self.assertTrue(self.sbom[key], key)
        self.assertEqual(self.sbom["spdxVersion"], "SPDX-2.3")
        self.assertEqual(self.sbom["dataLicense"], "CC0-1.0")
        self.assertRegex(self.sbom["creationInfo"]["created"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        for package in self.sbom["packages"]:
            self.assertRegex(package["SPDXID"], r"^SPDXRef-[A-Za-z0-9.-]+$")
            for key in ("name", "versionInfo", "downloadLocation", "licenseDeclared", "licenseConcluded"):
                self.assertTrue(package[key], (package["name"], key))

    def test_relations_lead_to_packages_and_each_package_has_one(self):
        known = [package["SPDXID"] for package in self.sbom["packages"]]
        self.assertEqual(len(known), len(set(known)))
        targets = {relation["relatedSpdxElement"] for relation in self.sbom["relationships"]}
        self.assertEqual(targets, set(known))
        for relation in self.sbom["relationships"]:
            self.assertIn(relation["spdxElementId"], {"SPDXRef-DOCUMENT", known[0]})

    def test_it_names_what_the_program_links(self):
        names = {package["name"] for package in self.sbom["packages"]}
        self.assertLessEqual({"libembree3-3", "libopenvdb10.0", "libc6", "libglm-dev", "libxxhash-dev"}, names)
        through = {relation["relatedSpdxElement"] for relation in self.sbom["relationships"] if "comment" in relation}
        direct = re.findall(r"\(NEEDED\)", run("readelf", "-d", str(BUILD / "tetralight")))
        self.assertGreater(len(direct), 10)
        self.assertIn("SPDXRef-libx11-6", through)  # of GLFW

    def test_no_copyleft_program_is_linked(self):
        for package in self.sbom["packages"]:
            name = package["licenseDeclared"]
            self.assertFalse(re.match("A?GPL", name) and "exception" not in name, (package["name"], name))

    def test_it_repeats(self):
        self.assertEqual(json.dumps(make_sbom("tetralight", self.root, "1.2.3-1")), json.dumps(self.sbom))


if __name__ == "__main__":
    unittest.main()
