#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""finish_package.py PACKAGE ROOT --version V --release R --contact C: adds to the staged files of a Debian
package what Debian's policy asks for: copyright, changelogs, compressed manual pages, stripped static
libraries, lintian's overrides and a bill of materials. CPack runs it (cmake/finish_packages.cmake).
"""
import argparse
import gzip
import json
import re
import shutil
import subprocess
import sys
from email.utils import format_datetime
from datetime import datetime, timezone
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCES = HERE.parents[1]
sys.path.insert(0, str(SOURCES / "packages/sbom"))
from compiled_in import compiled_into, license_of  # noqa: E402
from make_sbom import make_sbom  # noqa: E402

# Debian's short names of licences, and those whose text every Debian system has.
DEBIAN_NAMES = {"MIT": "Expat", "BSD-2-Clause": "BSD-2-clause", "BSD-3-Clause": "BSD-3-clause",
                "GPL-3.0-or-later": "GPL-3+", "AGPL-3.0-or-later": "AGPL-3+"}
COMMON = {"Apache-2.0": "Apache-2.0", "MPL-2.0": "MPL-2.0", "GPL-3+": "GPL-3"}
# What links a library of another licence is that licence's as a whole.
WHOLE_PROGRAM = {
    "tetralight-cgal": "The sources are Apache-2.0. The program contains CGAL, so it is distributed under "
                       "GPL-3.0-or-later as a whole. CGAL's sources: Debian's source package cgal.",
    "tetralight-tetgen": "The sources are Apache-2.0. The program links TetGen, so it is distributed under "
                         "AGPL-3.0-or-later as a whole. TetGen's sources: Debian's source package tetgen.",
}


def write_compressed(path, data):
    """As gzip -9n: without name and time."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("wb") as file, gzip.GzipFile("", "wb", 9, file, mtime=0) as stream:
        stream.write(data)


def compress_pages(root):
    for page in sorted(root.glob("usr/share/man/man*/*")):
        if page.suffix != ".gz":
            write_compressed(page.with_name(page.name + ".gz"), page.read_bytes())
            page.unlink()


def strip_static_libraries(root):
    libraries = [str(path) for path in sorted(root.rglob("*.a"))]
    if libraries:
        subprocess.run(["strip", "--strip-debug", "--remove-section=.comment", "--remove-section=.note",
                        "--enable-deterministic-archives", *libraries], check=True)


def license_text(package, name):
    """The text of a licence in the copyright file of the Debian package that has the library."""
    text = Path("/usr/share/doc", package, "copyright").read_text()
    for paragraph in re.split(r"\n\s*\n", text):
        match = re.search(rf"^License: *{re.escape(name)} *\n((?: .*\n?)+)", paragraph + "\n", re.M)
        if match:
            return match[1].rstrip("\n")
    sys.exit(f"/usr/share/doc/{package}/copyright: it has no text of the licence {name}")


def agpl_text():
    """The AGPL, which is not among Debian's common licences."""
    lines = (HERE / "AGPL-3").read_text().splitlines()
    return "\n".join(f" {line}" if line else " ." for line in lines)


def paragraph(files, holders, name, comment=""):
    text = f"Files: {files}\nCopyright: " + "\n           ".join(holders) + f"\nLicense: {name}\n"
    return text + (f"Comment: {comment}\n" if comment else "")


def copyright_text(package):
    own = DEBIAN_NAMES.get(license_of(package), license_of(package))
    holders = ["2026 the contributors of Tetralight"]
    parts = ["Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n"
             "Upstream-Name: Tetralight\nSource: the sources of Tetralight that this package was built from\n",
             paragraph("*", holders, own, WHOLE_PROGRAM.get(package, ""))]
    texts = {"Apache-2.0": None, own: None}
    for row in compiled_into(package):
        name = DEBIAN_NAMES.get(row["license"], row["license"])
        source = row["package"].replace("npm:", "the npm package ")
        parts.append(paragraph(f"{row['name'].replace(' ', '-')}/*", row["copyright"], name,
                               f"Parts of {row['name']} ({source}) are compiled in."))
        texts[name] = (row.get("text_of", row["package"]), row.get("text"))
    for name, text in sorted(texts.items()):
        if name in COMMON:
            body = f" On Debian systems the text is in /usr/share/common-licenses/{COMMON[name]}."
        elif name == "AGPL-3+":
            body = agpl_text()
        else:
            body = license_text(*text)
        parts.append(f"License: {name}\n{body}\n")
    return "\n".join(parts)


def released(version):
    """The day of a version in CHANGELOG.md; of the newest one before it was released."""
    text = (SOURCES / "CHANGELOG.md").read_text()
    days = dict(re.findall(r"^## \[(\d+\.\d+\.\d+)\] - (\d{4}-\d\d-\d\d)", text, re.M))
    day = days.get(version) or max(days.values())
    return datetime.fromisoformat(day).replace(hour=12, tzinfo=timezone.utc)


def debian_changelog(options):
    return (f"tetralight ({options.version}-{options.release}) bookworm; urgency=medium\n\n"
            f"  * Version {options.version}; changelog.gz says what changed.\n\n"
            f" -- {options.contact}  {format_datetime(released(options.version))}\n")


def write_documents(package, root, options):
    folder = root / "usr/share/doc" / package
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "copyright").write_text(copyright_text(package))
    write_compressed(folder / "changelog.gz", (SOURCES / "CHANGELOG.md").read_bytes())
    write_compressed(folder / "changelog.Debian.gz", debian_changelog(options).encode())
    day = released(options.version).strftime("%Y-%m-%dT%H:%M:%SZ")
    sbom = make_sbom(package, root, f"{options.version}-{options.release}", day)
    (folder / "sbom.spdx.json").write_text(json.dumps(sbom, indent=1, ensure_ascii=False) + "\n")


def write_overrides(package, root):
    """The overrides of this package and those of all, with their reasons, for lintian."""
    paragraphs = (HERE / "lintian_overrides").read_text().split("\n\n")
    wanted = [text.replace("all-packages:", f"{package}:") for text in paragraphs
              if re.search(rf"^(all-packages|{package}):", text, re.M)]
    path = root / "usr/share/lintian/overrides" / package
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(text.strip() + "\n" for text in wanted))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("package")
    parser.add_argument("root", type=Path)
    for name in ("version", "release", "contact"):
        parser.add_argument(f"--{name}", required=True)
    options = parser.parse_args()
    package, root = options.package, options.root
    compress_pages(root)
    strip_static_libraries(root)
    if package == "tetralight-server":
        (root / "etc/default").mkdir(parents=True, exist_ok=True)
        shutil.copyfile(SOURCES / "packages/systemd/tetralight.default", root / "etc/default/tetralight")
    write_overrides(package, root)
    write_documents(package, root, options)
    for path in root.rglob("*"):
        if not path.is_symlink():
            path.chmod(0o755 if path.is_dir() or path.parent.name == "bin" else 0o644)


if __name__ == "__main__":
    main()
