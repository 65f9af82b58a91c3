#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_image.py DEBS OUT: an OCI image of the service, as the folder OUT in the image layout of OCI.

A small Debian 12 (mmdebstrap) with the packages tetralight and tetralight-viewer of the folder DEBS. The entry point
is `tetralight serve` on the volume /data, as a user without rights. Needs root or user namespaces, and Debian's
mirror; TETRALIGHT_MIRROR names another one. `skopeo copy oci:OUT:latest docker-daemon:tetralight:latest` or
`podman pull oci:OUT` loads it.
"""
import argparse
import gzip
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

USER = 65532  # of nobody else on usual hosts; /data belongs to it
PACKAGES = ("tetralight", "tetralight-viewer")
# What the image does not need: documents but licences, translations, caches.
LEFT_OUT = ("/usr/share/doc/*", "/usr/share/man/*", "/usr/share/locale/*", "/usr/share/info/*", "/usr/share/lintian/*")
INCLUDED = ("/usr/share/doc/*/copyright", "/usr/share/doc/*/sbom.spdx.json")
INSTALL = f"""set -e
apt-get install -qq -y --no-install-recommends /tmp/debs/*.deb
rm -rf /tmp/debs /var/log/* /var/cache/ldconfig/* /var/cache/debconf/*-old
install -d -o {USER} -g {USER} -m 0700 /data
"""


def make_root(debs, tar, mirror):
    """A Debian with the packages installed, as a tar. The command that fails says why on stderr."""
    rules = [f"--dpkgopt=path-exclude={path}" for path in LEFT_OUT]
    rules += [f"--dpkgopt=path-include={path}" for path in INCLUDED]
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "install.sh"
        script.write_text(INSTALL)
        subprocess.run(
            ["mmdebstrap", "--variant=minbase", "--dpkgopt=force-unsafe-io", "--aptopt=Apt::Install-Recommends false", *rules,
             '--customize-hook=mkdir -p "$1"/tmp/debs',
             *(f"--customize-hook=copy-in {deb} /tmp/debs" for deb in debs),
             f"--customize-hook=copy-in {script} /tmp",
             '--customize-hook=chroot "$1" sh /tmp/install.sh', '--customize-hook=rm "$1"/tmp/install.sh',
             "bookworm", str(tar), mirror], check=True, stdout=sys.stderr)


def digest_of(path):
    with path.open("rb") as file:
        return "sha256:" + hashlib.file_digest(file, "sha256").hexdigest()


def compress(source, target):
    """gzip without name and time: the same bytes for the same tar."""
    with source.open("rb") as tar, target.open("wb") as file, gzip.GzipFile("", "wb", 6, file, mtime=0) as stream:
        shutil.copyfileobj(tar, stream, 1 << 20)


class Layout:
    """A folder in the image layout of OCI: blobs by their SHA-256, and index.json."""

    def __init__(self, folder):
        self.folder = folder
        self.blobs = folder / "blobs/sha256"
        self.blobs.mkdir(parents=True)
        (folder / "oci-layout").write_text('{"imageLayoutVersion": "1.0.0"}')

    def add_file(self, path, media_type):
        """Moves a file into the layout; its descriptor."""
        digest, size = digest_of(path), path.stat().st_size
        path.rename(self.blobs / digest.removeprefix("sha256:"))
        return {"mediaType": media_type, "digest": digest, "size": size}

    def add_json(self, value, media_type):
        path = self.folder / "blob.json"
        path.write_text(json.dumps(value))
        return self.add_file(path, media_type)

    def write_index(self, manifest, name):
        entry = dict(manifest, annotations={"org.opencontainers.image.ref.name": name})
        (self.folder / "index.json").write_text(json.dumps({
            "schemaVersion": 2, "mediaType": "application/vnd.oci.image.index.v1+json", "manifests": [entry]}))


def image_config(version, architecture, diff_id):
    return {
        "created": "1970-01-01T00:00:00Z", "architecture": architecture, "os": "linux",
        "config": {
            "User": f"{USER}:{USER}", "WorkingDir": "/data", "Volumes": {"/data": {}},
            "ExposedPorts": {"8080/tcp": {}},
            # Every address of the container, so a token is needed: $TETRALIGHT_TOKEN or --token-file.
            "Entrypoint": ["/usr/bin/tetralight", "serve", "--data", "/data"],
            "Cmd": ["--listen", "0.0.0.0:8080"],
            "Env": ["PATH=/usr/local/bin:/usr/bin:/bin", "LC_ALL=C.UTF-8"],
            "StopSignal": "SIGTERM",
            "Labels": {"org.opencontainers.image.title": "tetralight",
                       "org.opencontainers.image.version": version,
                       "org.opencontainers.image.licenses": "Apache-2.0"}},
        "rootfs": {"type": "layers", "diff_ids": [diff_id]},
        "history": [{"created": "1970-01-01T00:00:00Z", "created_by": "packages/oci/make_image.py"}]}


def make_image(tar, folder, version, architecture):
    """Writes the layout of an image with one layer. The tar is used up."""
    layout = Layout(folder)
    diff_id, layer = digest_of(tar), folder / "layer.tar.gz"
    compress(tar, layer)
    tar.unlink()
    kind = "application/vnd.oci.image.{}+json"
    config = layout.add_json(image_config(version, architecture, diff_id), kind.format("config.v1"))
    layers = [layout.add_file(layer, "application/vnd.oci.image.layer.v1.tar+gzip")]
    manifest = {"schemaVersion": 2, "mediaType": kind.format("manifest.v1"), "config": config, "layers": layers}
    layout.write_index(layout.add_json(manifest, manifest["mediaType"]), "latest")
    return layers[0]["size"]


def find_debs(folder):
    found = []
    for name in PACKAGES:
        debs = sorted(folder.glob(f"{name}_*.deb"))
        if len(debs) != 1:
            sys.exit(f"{folder}: {len(debs)} packages {name}_*.deb; exactly one is needed (./run package debian)")
        found.append(debs[0].resolve())
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("debs", type=Path)
    parser.add_argument("out", type=Path)
    options = parser.parse_args()
    debs = find_debs(options.debs)
    _, version, architecture = re.fullmatch(r"(\w+)_(.*)_(\w+)\.deb", debs[0].name).groups()
    fresh = options.out.with_name(options.out.name + ".new")
    shutil.rmtree(fresh, ignore_errors=True)
    fresh.mkdir(parents=True)
    tar = fresh / "root.tar"
    make_root(debs, tar, os.environ.get("TETRALIGHT_MIRROR", "http://deb.debian.org/debian"))
    unpacked = tar.stat().st_size
    packed = make_image(tar, fresh, version, architecture)
    shutil.rmtree(options.out, ignore_errors=True)
    fresh.rename(options.out)
    print(f"{options.out}: {packed / 1e6:.0f} MB compressed, {unpacked / 1e6:.0f} MB unpacked")


if __name__ == "__main__":
    main()
