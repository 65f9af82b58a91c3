# SPDX-License-Identifier: Apache-2.0
"""What the server does not know is never deleted: it is taken in or put aside, and the log says so."""
import hashlib
import os
import shutil
import unittest

import test_bakes
from service import COURTYARD, read
from test_files import VolumeTest


class Unknown(VolumeTest):
    def in_quarantine(self):
        return sorted(os.listdir(os.path.join(self.data, "quarantine")))

    def findings(self, server):
        """What this start has found. Lines below warnings are written after a moment."""
        process = {"port": server.port}
        lines = lambda: [line["findings"] for line in server.logged()
                         if process.items() <= line.items()]
        self.assertTrue(self.eventually(lines))
        return lines()[-1]

    def copy_database(self, target):
        shutil.copy(os.path.join(self.data, "tetralight.db"), target)

    def test_files_newer_than_a_restored_database_are_taken_in(self):
        server = self.start()
        old = self.upload(server, "volumes", self.volume_file(2), "level")
        server.stop()
        backup = os.path.join(self.folder, "backup.db")
        self.copy_database(backup)
        server = self.start()
        new = self.upload(server, "volumes", self.volume_file(3), "level")
        facts = server.get("/v1/volumes/" + new).json()["facts"]
        scene = self.upload(server, "scenes", COURTYARD, "court")
        server.stop()
        shutil.copy(backup, os.path.join(self.data, "tetralight.db"))
        server = self.start()
        self.assertEqual(server.get("/v1/volumes/level").json()["id"], new)
        self.assertEqual(server.get("/v1/volumes/level").json()["facts"], facts)
        self.assertEqual(server.get(f"/v1/volumes/{old}").json()["state"], "ready")
        self.assertEqual(server.get("/v1/scenes/court/file").body, read(COURTYARD))
        self.assertEqual(len(self.findings(server)), 2)
        self.assertIn(f"scenes/{scene}.glb was not in the database and is taken in",
                      self.findings(server))
        self.assertEqual(self.in_quarantine(), [])

    def test_a_file_with_other_bytes_than_its_name_says_is_put_aside(self):
        self.start().stop()
        name = hashlib.sha256(b"other bytes").hexdigest() + ".probes"
        names = [name, "notes.txt", hashlib.sha256(b"bytes").hexdigest() + ".txt"]
        for file_name in names:
            with open(os.path.join(self.data, "volumes", file_name), "wb") as file:
                file.write(b"bytes")
        os.makedirs(os.path.join(self.data, "scenes", "folder", "inner"))
        server = self.start()
        expected = sorted(["unknown-volumes-" + n for n in names] + ["unknown-scenes-folder"])
        self.assertEqual(self.in_quarantine(), expected)
        self.assertTrue(os.path.isdir(
            os.path.join(self.data, "quarantine", "unknown-scenes-folder", "inner")))
        self.assertEqual(len(self.findings(server)), 4)
        self.assertEqual(server.get("/v1/volumes").json()["volumes"], [])
        server.stop()
        # A second one of the same name replaces nothing.
        with open(os.path.join(self.data, "volumes", name), "wb") as file:
            file.write(b"more")
        self.start()
        self.assertEqual(self.in_quarantine(), sorted(expected + ["1-unknown-volumes-" + name]))

    def test_work_and_bakes_of_others_are_put_aside(self):
        self.start().stop()
        for folder in ("work/7", "work/mine", "bakes/0123456789abcdef", "bakes/new-0123"):
            os.makedirs(os.path.join(self.data, folder))
            with open(os.path.join(self.data, folder, "file"), "wb") as file:
                file.write(b"bytes")
        server = self.start()
        self.assertEqual(self.in_quarantine(), ["bake-0123456789abcdef", "work-mine"])
        for name in self.in_quarantine():
            self.assertEqual(read(os.path.join(self.data, "quarantine", name, "file")), b"bytes")
        for folder in ("work", "bakes"):
            self.assertEqual(os.listdir(os.path.join(self.data, folder)), [])
        self.assertEqual(len(self.findings(server)), 2)

    def test_a_file_that_outlived_its_deletion_does_not_come_back(self):
        server = self.start()
        path = self.volume_file(2)
        volume = self.upload(server, "volumes", path)
        stored = os.path.join(self.data, "volumes", volume + ".probes")
        os.link(stored, os.path.join(self.folder, "kept"))
        self.assertEqual(server.request("DELETE", "/v1/volumes/" + volume).status, 204)
        server.stop()
        os.link(os.path.join(self.folder, "kept"), stored)
        server = self.start()
        self.assert_problem(server.get("/v1/volumes/" + volume), 404, "not_found")
        self.assertFalse(os.path.exists(stored))
        server.stop()
        # The same bytes, brought later.
        shutil.copyfile(path, stored)
        self.assertEqual(self.start().get("/v1/volumes/" + volume).json()["state"], "ready")


class UnknownBakes(test_bakes.BakeTest):
    def test_a_bake_newer_than_a_restored_database_is_put_aside(self):
        server = self.start()
        server.stop()
        backup = os.path.join(self.folder, "backup.db")
        shutil.copy(os.path.join(self.data, "tetralight.db"), backup)
        server = self.start()
        bake = self.begin(server, **test_bakes.SLOW)
        self.wait_for_chunks(bake, 1)
        server.stop()
        shutil.copy(backup, os.path.join(self.data, "tetralight.db"))
        server = self.start()
        aside = os.path.join(self.data, "quarantine", "bake-" + bake)
        self.assertEqual(read(os.path.join(aside, "scene")), read(COURTYARD))
        self.assertTrue(os.listdir(os.path.join(aside, "results", "chunks")))


if __name__ == "__main__":
    unittest.main()
