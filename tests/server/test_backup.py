# SPDX-License-Identifier: Apache-2.0
"""Data folders are checked, stored and brought back; what is in quarantine is listed and taken back."""
import io
import json
import os
import shutil
import subprocess
import tarfile

import test_bakes
from service import COMMAND, read
from test_files import VolumeTest

QUERY = {"positions": [[0.5, 0.5, 0.5]]}


class DataFolder(VolumeTest):
    def run_command(self, *arguments):
        done = subprocess.run([COMMAND, *arguments, "--json"], cwd=self.folder, capture_output=True,
                              text=True)
        return done.returncode, json.loads(done.stdout)

    def damage(self, path):
        with open(path, "r+b") as file:
            file.seek(os.path.getsize(path) // 2)
            file.write(b"\xff" * 64)

    def stored(self, volume):
        return os.path.join(self.data, "volumes", volume + ".probes")


class Fsck(DataFolder):
    def test_a_whole_folder(self):
        server = self.start()
        path = self.volume_file(2)
        self.upload(server, "volumes", path)
        for _ in range(2):  # while the server runs, and after it
            code, report = self.run_command("fsck", self.data)
            self.assertEqual((code, report["findings"], report["files"]), (0, [], 1))
            self.assertEqual(report["bytes"], os.path.getsize(path))
            if server.is_running():
                server.stop()

    def test_everything_that_is_wrong_is_found_and_nothing_is_changed(self):
        server = self.start()
        volumes = [self.upload(server, "volumes", self.volume_file(n)) for n in (2, 3, 4)]
        server.stop()
        self.damage(self.stored(volumes[0]))
        os.remove(self.stored(volumes[1]))
        with open(os.path.join(self.data, "volumes", "notes"), "w") as file:
            file.write("mine")
        code, report = self.run_command("fsck", self.data)
        self.assertEqual((code, report["error"]["code"]), (1, "corrupt"))
        found = {(f["kind"], f["path"]) for f in report["findings"]}
        self.assertEqual(found, {("damaged", f"volumes/{volumes[0]}.probes"),
                                 ("missing", f"volumes/{volumes[1]}.probes"),
                                 ("unknown", "volumes/notes")})
        self.assertTrue(os.path.exists(os.path.join(self.data, "volumes", "notes")))
        self.assertEqual(os.listdir(os.path.join(self.data, "quarantine")), [])

    def test_a_damaged_database(self):
        self.start().stop()
        with open(os.path.join(self.data, "tetralight.db"), "r+b") as file:
            file.write(b"\0" * 100)
        code, report = self.run_command("fsck", self.data)
        self.assertEqual((code, report["findings"][0]["kind"]), (1, "database"))

    def test_what_is_no_data_folder(self):
        code, report = self.run_command("fsck", self.folder)
        self.assertEqual((code, report["error"]["field"]), (1, "data"))


class Backup(DataFolder):
    def setUp(self):
        super().setUp()
        self.archive = os.path.join(self.folder, "backup.tar")
        self.copy = os.path.join(self.folder, "copy")

    def test_a_running_server_comes_back_elsewhere(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(2), "level")
        groups = self.upload(server, "groups", os.path.join(self.folder, "groups.json"), "few")
        light = server.post("/v1/volumes/level/query", QUERY).body
        code, report = self.run_command("backup", self.data, "-o", self.archive)
        self.assertEqual((code, report["missing"]), (0, []))
        self.upload(server, "volumes", self.volume_file(3), "level")
        with tarfile.open(self.archive) as tar:
            self.assertLessEqual({"tetralight.db", f"volumes/{volume}.probes",
                                  f"groups/{groups}.json"}, set(tar.getnames()))
        code, again = self.run_command("restore", self.archive, "-o", self.copy)
        self.assertEqual((code, again["files"]), (0, report["files"]))
        self.assertEqual(self.run_command("fsck", self.copy)[1]["findings"], [])
        other = self.start(data=self.copy)
        self.assertEqual(other.get("/v1/volumes/level").json()["id"], volume)
        self.assertEqual(other.post("/v1/volumes/level/query", QUERY).body, light)
        self.assertEqual(other.get("/v1/groups/few").json()["id"], groups)

    def test_a_file_that_is_missing_is_told(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(2))
        os.remove(self.stored(volume))
        code, report = self.run_command("backup", self.data, "-o", self.archive)
        self.assertEqual(code, 0)
        self.assertIn(volume, report["missing"][0])

    def test_a_folder_with_files_is_not_replaced(self):
        self.start().stop()
        self.run_command("backup", self.data, "-o", self.archive)
        code, report = self.run_command("restore", self.archive, "-o", self.data)
        self.assertEqual((code, report["error"]["field"]), (1, "output"))

    def entry(self, name, data=b"bytes", **more):
        info = tarfile.TarInfo(name)
        info.size = len(data)
        for member, value in more.items():
            setattr(info, member, value)
        return info, data

    def test_hostile_and_damaged_archives_leave_nothing(self):
        self.start().stop()
        self.run_command("backup", self.data, "-o", self.archive)
        whole = read(self.archive)
        link = {"type": tarfile.SYMTYPE, "linkname": "/etc", "data": b""}
        hostile = [self.entry("../escaped"), self.entry("/tmp/tetralight_escaped"),
                   self.entry("volumes/../../escaped"), self.entry("volumes/./x"),
                   self.entry("volumes", **link), self.entry("volumes/x", b"", type=tarfile.LNKTYPE,
                                                             linkname="tetralight.db"),
                   self.entry("volumes/d", b"", type=tarfile.DIRTYPE),
                   self.entry("volumes/f", b"", type=tarfile.FIFOTYPE), self.entry("elsewhere/x"),
                   self.entry("volumes/" + "0" * 64 + ".probes"), self.entry("tetralight.db")]
        archives = [whole[:1000], whole[:len(whole) // 2], b"", b"\0" * 1024, b"x" * 2048]
        for info, data in hostile:
            memory = io.BytesIO()
            with tarfile.open(fileobj=memory, mode="w", format=tarfile.USTAR_FORMAT) as tar:
                tar.addfile(info, io.BytesIO(data))
            archives.append(whole[:-1024] + memory.getvalue())
        before = set(os.listdir(self.folder)) | {"bad.tar"}
        for number, archive in enumerate(archives):
            with self.subTest(number=number):
                with open(os.path.join(self.folder, "bad.tar"), "wb") as file:
                    file.write(archive)
                code, report = self.run_command("restore", "bad.tar", "-o", self.copy)
                self.assertEqual((code, report["error"]["code"]), (1, "corrupt"))
                self.assertEqual(set(os.listdir(self.folder)), before)
        self.assertFalse(os.path.exists("/tmp/tetralight_escaped"))


class BackupOfBakes(test_bakes.BakeTest):
    def test_an_unfinished_bake_goes_on_elsewhere(self):
        server = self.start()
        bake = self.begin(server, **test_bakes.QUICK, priority=1)
        archive, copy = (os.path.join(self.folder, name) for name in ("backup.tar", "copy"))
        self.command("backup", self.data, "-o", archive)
        expected = self.file_of(server, bake)
        self.command("restore", archive, "-o", copy)
        other = super().start(data=copy)
        self.assertEqual(self.file_of(other, bake), expected)


class Quarantine(DataFolder):
    def test_what_is_put_aside_is_listed_and_taken_back_when_it_is_whole(self):
        server = self.start()
        path = self.volume_file(2)
        volume = self.upload(server, "volumes", path, "level")
        server.stop()
        self.damage(self.stored(volume))
        os.makedirs(os.path.join(self.data, "bakes", "0123"))
        server = self.start()
        self.assert_problem(server.post("/v1/volumes/level/query", QUERY), 410, "quarantined")
        entries = server.get("/v1/quarantine").json()["quarantine"]
        name = f"volumes-{volume}.probes"
        self.assertEqual([(e["name"], e["kind"], e["id"]) for e in entries],
                         [("bake-0123", None, None), (name, "volumes", volume)])
        self.assertEqual(entries[1]["bytes"], os.path.getsize(path))
        self.assert_problem(server.post(f"/v1/quarantine/{name}/restore"), 422, "bad_data")
        self.assert_problem(server.post("/v1/quarantine/bake-0123/restore"), 422, "bad_data")
        self.assert_problem(server.post("/v1/quarantine/none/restore"), 404, "not_found")
        shutil.copy(path, os.path.join(self.data, "quarantine", name))
        answer = server.post(f"/v1/quarantine/{name}/restore")
        self.assertEqual((answer.status, answer.json()["names"]), (200, ["level"]))
        self.assertEqual(server.post("/v1/volumes/level/query", QUERY).status, 200)
        page = server.get("/v1/quarantine?limit=1").json()
        self.assertEqual([e["name"] for e in page["quarantine"]], ["bake-0123"])
        self.assertIsNone(page["next"])
        server.stop()
        self.assertEqual(self.start().get("/v1/volumes/level").json()["state"], "ready")

    def test_what_is_put_aside_can_be_deleted(self):
        server = self.start()
        path = self.volume_file(2)
        volume = self.upload(server, "volumes", path, "level")
        folder = os.path.join(self.data, "quarantine")
        os.makedirs(os.path.join(folder, "bake-0123", "results"))
        self.damage(self.stored(volume))
        self.assert_problem(server.get("/v1/volumes/level/file"), 410, "quarantined")
        self.assertEqual(self.upload(server, "volumes", path), volume)  # leaves the damaged file there
        name = f"volumes-{volume}.probes"
        for missing in ("none", "..", "%2e%2e", "..%2Flock", "bake-0123%2Fresults"):
            self.assert_problem(server.request("DELETE", "/v1/quarantine/" + missing), 404, "not_found")
        for entry in (name, "bake-0123"):
            self.assertIn(entry, os.listdir(folder))
            self.assertEqual(server.request("DELETE", "/v1/quarantine/" + entry).status, 204)
            self.assertNotIn(entry, os.listdir(folder))
        self.assertEqual(server.get("/v1/quarantine").json()["quarantine"], [])
        self.assertEqual(server.post("/v1/volumes/level/query", QUERY).status, 200)

    def test_a_good_copy_counts_in_the_quarantine_only(self):
        server = self.start()
        path = self.volume_file(2)
        volume = self.upload(server, "volumes", path, "level")
        self.damage(self.stored(volume))
        self.assert_problem(server.get("/v1/volumes/level/file"), 410, "quarantined")
        shutil.copy(path, self.stored(volume))
        self.assert_problem(server.get("/v1/volumes/level/file"), 410, "quarantined")
        name = f"volumes-{volume}.probes"
        shutil.copy(path, os.path.join(self.data, "quarantine", name))
        self.assertEqual(server.post(f"/v1/quarantine/{name}/restore").status, 200)
        self.assertEqual(server.get("/v1/volumes/level/file").body, read(path))

    def test_an_unknown_file_becomes_a_file_of_the_store(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(2))
        self.assertEqual(server.request("DELETE", "/v1/volumes/" + volume).status, 204)
        name = f"unknown-volumes-{volume}.probes"
        shutil.copy(os.path.join(self.folder, "volume2.probes"),
                    os.path.join(self.data, "quarantine", name))
        answer = server.post(f"/v1/quarantine/{name}/restore")
        self.assertEqual((answer.status, answer.json()["id"]), (200, volume))
        self.assertEqual(server.post(f"/v1/volumes/{volume}/query", QUERY).status, 200)


if __name__ == "__main__":
    import unittest
    unittest.main()
