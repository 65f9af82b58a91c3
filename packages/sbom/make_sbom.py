#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_sbom.py PACKAGE ROOT --version VERSION: the bill of materials of a Debian package, as SPDX 2.3.

Lists what the programs and libraries below ROOT link: shared libraries, directly or through others, by
the Debian packages that they come from, and libraries of headers, which are compiled in. Prints JSON. The
same files on the same system give the same bytes.
"""
import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from compiled_in import compiled_into, license_of, run, table  # noqa: E402

# Debian's short names that differ from SPDX's, as they stand in copyright files.
SPDX_NAMES = {
    "Expat": "MIT", "MIT": "MIT", "ISC": "ISC", "Zlib": "Zlib", "zlib": "Zlib",
    "Apache-2": "Apache-2.0", "Apache-2.0": "Apache-2.0", "BSL-1.0": "BSL-1.0",
    "BSD-2-clause": "BSD-2-Clause", "BSD-2-Clause": "BSD-2-Clause",
    "BSD-3-clause": "BSD-3-Clause", "BSD-3-Clause": "BSD-3-Clause",
    "MPL-2": "MPL-2.0", "MPL-2.0": "MPL-2.0",
    "GPL-2+": "GPL-2.0-or-later", "GPL-3+": "GPL-3.0-or-later",
    "LGPL-2+": "LGPL-2.0-or-later", "LGPL-2.1+": "LGPL-2.1-or-later", "LGPL-3+": "LGPL-3.0-or-later",
    "AGPL3+": "AGPL-3.0-or-later",
}


def elf_files(root):
    for path in sorted(Path(root).rglob("*")):
        if path.is_file() and not path.is_symlink():
            with path.open("rb") as file:
                if file.read(4) == b"\x7fELF":
                    yield path


def needed(path):
    """The names of the shared libraries that a file names itself."""
    return set(re.findall(r"\(NEEDED\).*\[(.*)\]", run("readelf", "-d", str(path))))


def loaded(path):
    """The shared libraries that are loaded with a file: {name: path}."""
    found = dict(re.findall(r"^\s*(\S+) => (/\S+) ", run("ldd", str(path)), re.M))
    loader = re.search(r"^\s*(/\S+) \(", run("ldd", str(path)), re.M)
    return dict(found, **({Path(loader[1]).name: loader[1]} if loader else {}))


def owners(paths):
    """The Debian package of each file of the system: {path: package}. A library may be known to dpkg by
    its path before or after the merge of /usr."""
    bare = {path: re.sub("^/usr", "", path) for path in paths}
    names = {name for path in bare.values() for name in (path, "/usr" + path)}
    printed = subprocess.run(["dpkg", "-S", *sorted(names)], text=True, stdout=subprocess.PIPE,
                             stderr=subprocess.DEVNULL, env=dict(os.environ, LC_ALL="C.UTF-8")).stdout
    known = {}
    for line in printed.splitlines():
        packages, file = line.rsplit(": ", 1)
        known[re.sub("^/usr", "", file)] = packages.split(", ")[0]
    lost = [path for path in paths if bare[path] not in known]
    if lost:
        sys.exit(f"no package has {', '.join(lost)}")
    return {path: known[bare[path]] for path in paths}


def declared_license(package):
    """(SPDX expression or NOASSERTION, Debian's names) of the first paragraph of a copyright file."""
    path = Path("/usr/share/doc", package.split(":")[0], "copyright")
    text = path.read_text(errors="replace") if path.exists() else ""
    match = re.search(r"^Files: *\*.*?^License: *(\S[^\n]*)", text, re.M | re.S)
    name = match[1].strip() if match and text.startswith("Format:") else ""
    known = table()["shared_libraries"].get(package.split(":")[0])
    return known or SPDX_NAMES.get(name, "NOASSERTION"), name


def element(name, version, license_name, **more):
    identifier = "SPDXRef-" + re.sub("[^A-Za-z0-9.-]", "-", name)
    return {"SPDXID": identifier, "name": name, "versionInfo": version, "filesAnalyzed": False,
            "downloadLocation": "NOASSERTION", "licenseConcluded": "NOASSERTION",
            "licenseDeclared": license_name, "copyrightText": "NOASSERTION", **more}


def debian_element(package):
    version, source, architecture = run(
        "dpkg-query", "-W", "-f", "${Version}\t${source:Package}\t${Architecture}", package).split("\t")
    license_name, debian_name = declared_license(package)
    more = {"sourceInfo": f"Debian source package {source}", "externalRefs": [{
        "referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
        "referenceLocator": f"pkg:deb/debian/{package.split(':')[0]}@{version}?arch={architecture}"}]}
    if license_name == "NOASSERTION":
        more["licenseComments"] = f"In Debian's copyright file: {debian_name or 'see there'}"
    return element(package.split(":")[0], version, license_name, **more)


def library_element(row):
    if row["package"].startswith("npm:"):
        return element(row["name"], npm_version(row["package"][4:]), row["license"],
                       copyrightText="; ".join(row["copyright"]))
    found = debian_element(row["package"])
    found.pop("licenseComments", None)
    return dict(found, licenseDeclared=row["license"], copyrightText="; ".join(row["copyright"]),
                description=f"Headers of {row['name']}, compiled in")


def npm_version(name):
    viewer = Path(__file__).resolve().parents[2] / "viewer/package.json"
    return json.loads(viewer.read_text())["dependencies"][name]


def relation(kind, subject, target, comment=""):
    found = {"spdxElementId": subject, "relationshipType": kind, "relatedSpdxElement": target}
    return dict(found, comment=comment) if comment else found


def add_shared_libraries(root, package, elements, relations):
    direct, paths = set(), {}
    for path in elf_files(root):
        paths.update(loaded(path))
        direct |= needed(path)
    own = {path.name for path in Path(root).rglob("*.so.*")}
    package_of = owners({path for name, path in paths.items() if name not in own})
    direct_packages = {package_of[paths[name]] for name in direct if name in paths and name not in own}
    for library in sorted(set(package_of.values())):
        found = debian_element(library)
        elements.append(found)
        comment = "" if library in direct_packages else "through other libraries"
        relations.append(relation("DYNAMIC_LINK", package["SPDXID"], found["SPDXID"], comment))


def make_sbom(name, root, version, created="1970-01-01T00:00:00Z"):
    """`created` is the day of the release, so that the same files give the same bytes."""
    package = element(name, version, license_of(name))
    elements, relations = [package], [relation("DESCRIBES", "SPDXRef-DOCUMENT", package["SPDXID"])]
    add_shared_libraries(root, package, elements, relations)
    for row in compiled_into(name):
        found = library_element(row)
        elements.append(found)
        relations.append(relation("STATIC_LINK", package["SPDXID"], found["SPDXID"], "headers, compiled in"))
    content = json.dumps([elements, relations], sort_keys=True).encode()
    return {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"{name}-{version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/{name}-{version}-{hashlib.sha256(content).hexdigest()}",
        "creationInfo": {"created": created, "creators": ["Tool: tetralight-make_sbom"]},
        "packages": elements, "relationships": relations}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("package")
    parser.add_argument("root")
    parser.add_argument("--version", required=True)
    options = parser.parse_args()
    print(json.dumps(make_sbom(options.package, options.root, options.version), indent=1, ensure_ascii=False))


if __name__ == "__main__":
    main()
