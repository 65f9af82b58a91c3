# SPDX-License-Identifier: Apache-2.0
"""The OCI image: built from the packages of this build, its layout checked, its service run in its root folder."""
import gzip
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import urllib.request
from pathlib import Path

from systems import can_make_system, can_reach_mirror, is_nightly, run

SOURCES = Path(os.environ["TETRALIGHT_SOURCES"])
BUILD = Path(os.environ["TETRALIGHT_BUILD"])
sys.path.insert(0, str(SOURCES / "packages/oci"))
from make_image import USER, make_image  # noqa: E402


class Image:
    """Reads a layout, and checks on the way that each blob has the digest and the size of its descriptor."""

    def __init__(self, folder):
        self.folder = Path(folder)
        assert json.loads((self.folder / "oci-layout").read_text())["imageLayoutVersion"] == "1.0.0"
        index = json.loads((self.folder / "index.json").read_text())
        self.manifest = json.loads(self.blob(index["manifests"][0]))
        self.config = json.loads(self.blob(self.manifest["config"]))

    def blob(self, descriptor):
        algorithm, digest = descriptor["digest"].split(":")
        data = (self.folder / "blobs" / algorithm / digest).read_bytes()
        assert hashlib.sha256(data).hexdigest() == digest and len(data) == descriptor["size"], descriptor
        return data

    def layer(self):
        """The tar of the one layer, whose digest the config has."""
        data = gzip.decompress(self.blob(self.manifest["layers"][0]))
        assert self.config["rootfs"]["diff_ids"] == ["sha256:" + hashlib.sha256(data).hexdigest()]
        return data


class Layout(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="tetralight_oci_"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "file").write_text("light")

    def make(self, name):
        tar = self.folder / "root.tar"
        with tarfile.open(tar, "w") as archive:
            archive.add(self.folder / "file", "usr/bin/file")
        out = self.folder / name
        out.mkdir()
        make_image(tar, out, "1.2.3-1", "amd64")
        return out

    def test_digests_lead_from_the_index_to_the_files(self):
        image = Image(self.make("image"))
        layer = self.folder / "layer.tar"
        layer.write_bytes(image.layer())
        with tarfile.open(layer) as archive:
            self.assertEqual(archive.extractfile("usr/bin/file").read(), b"light")

    def test_the_service_runs_without_rights_on_a_volume(self):
        config = Image(self.make("image")).config["config"]
        self.assertEqual(config["User"], f"{USER}:{USER}")
        self.assertEqual(config["Entrypoint"], ["/usr/bin/tetralight", "serve", "--data", "/data"])
        self.assertEqual(config["Volumes"], {"/data": {}})

    def test_the_same_files_give_the_same_bytes(self):
        first, second = Image(self.make("a")), Image(self.make("b"))
        self.assertEqual(first.manifest, second.manifest)


@unittest.skipUnless(is_nightly() and can_make_system() and can_reach_mirror(),
                     "needs TETRALIGHT_NIGHTLY=1 and a new Debian system")
class Service(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="tetralight_oci_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        run("cpack", "-G", "DEB", "-B", self.folder / "debs", "-D", "CPACK_COMPONENTS_ALL=program;viewer", cwd=BUILD)

    def test_it_answers(self):
        script = SOURCES / "packages/oci/make_image.py"
        print(run(sys.executable, script, self.folder / "debs", self.folder / "image"))
        image = Image(self.folder / "image")
        layer = self.folder / "layer.tar"
        layer.write_bytes(image.layer())
        root = self.folder / "root"
        root.mkdir()
        self.serve(image.config["config"], layer, root)

    def serve(self, config, layer, root):
        # As a container does: the files of the layer as root, the program as the user of the image.
        enter = ["unshare", "--mount", *(["--map-root-user"] if os.getuid() else [])]
        user = "" if os.getuid() else f"--userspec={config['User']}"
        run(*enter, "tar", "-x", "--exclude=./dev/*", "-f", layer, "-C", root)
        program = " ".join([*config["Entrypoint"], "--listen", "127.0.0.1:0"])
        script = f"mount --rbind /proc {root}/proc && exec chroot {user} {root} {program}"
        with subprocess.Popen([*enter, "sh", "-c", script], text=True, stdout=subprocess.PIPE) as server:
            try:
                address = server.stdout.readline().strip()
                with urllib.request.urlopen(address + "/healthz", timeout=60) as answer:
                    self.assertEqual(answer.status, 200)
                with urllib.request.urlopen(address + "/", timeout=60) as page:
                    self.assertIn(b"<html", page.read())
            finally:
                server.terminate()
            self.assertEqual(server.wait(60), 0)


if __name__ == "__main__":
    unittest.main()
