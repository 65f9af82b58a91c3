# SPDX-License-Identifier: Apache-2.0
"""Data folders are checked, stored and brought back; what is in quarantine is listed and taken back."""
import json
import os
import shutil
import signal
import subprocess
import tarfile

import test_bakes
from service import COMMAND, COURTYARD, read
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

    def test_a_damaged_or_missing_index(self):
        self.start().stop()
        index = os.path.join(self.data, "index.json")
        for text in ("", "{{{", '{"files": {}}', '{"files": [{"kind": "volumes"}]}'):
            with open(index, "w") as file:
                file.write(text)
            code, report = self.run_command("fsck", self.data)
            self.assertEqual((code, [(f["kind"], f["path"]) for f in report["findings"]]),
                             (1, [("damaged", "index.json")]), text)
        os.remove(index)
        code, report = self.run_command("fsck", self.data)
        self.assertEqual((code, report["findings"][0]["kind"]), (1, "missing"))
        self.start().stop()
        self.assertEqual(self.run_command("fsck", self.data)[0], 0)

    def test_unknown_folders_of_bakes(self):
        self.start().stop()
        for name in ("q", "new-0123"):  # the second one was never accepted
            os.makedirs(os.path.join(self.data, "bakes", name))
        code, report = self.run_command("fsck", self.data)
        self.assertEqual((code, [(f["kind"], f["path"]) for f in report["findings"]]),
                         (1, [("unknown", "bakes/q")]))

    def test_without_a_database_files_are_held_to_their_names(self):
        server = self.start()
        volumes = [self.upload(server, "volumes", self.volume_file(n)) for n in (2, 3)]
        server.stop()
        self.damage(self.stored(volumes[0]))
        database = os.path.join(self.data, "tetralight.db")
        with open(database, "wb") as file:
            file.write(b"no database" * 100)
        damaged = ("damaged", f"volumes/{volumes[0]}.probes")
        for kind in ("database", "missing"):
            code, report = self.run_command("fsck", self.data)
            self.assertEqual((code, report["files"]), (1, 2))
            self.assertEqual([(f["kind"], f["path"]) for f in report["findings"]],
                             [(kind, "tetralight.db"), damaged])
            self.assertIn("tetralight.db is " + kind.replace("database", "damaged"),
                          report["error"]["message"])
            if kind == "database":
                os.remove(database)

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
        self.assertEqual((code, len(report["missing"])), (1, 1))
        self.assertIn(volume, report["missing"][0])
        code, report = self.run_command("restore", self.archive, "-o", self.copy)
        self.assertEqual((code, len(report["missing"]), report["damaged"]), (1, 1, []))
        self.assertIn(volume, report["missing"][0])
        findings = self.run_command("fsck", self.copy)[1]["findings"]
        self.assertEqual([f["kind"] for f in findings], ["missing"])

    def test_a_damaged_file_is_told_and_all_else_comes_back(self):
        server = self.start()
        bad = self.upload(server, "volumes", self.volume_file(2), "bad")
        good = self.upload(server, "volumes", self.volume_file(3), "good")
        light = server.post("/v1/volumes/good/query", QUERY).body
        with open(self.stored(bad), "r+b") as file:
            file.seek(1000)
            file.write(b"\0" * 100)
        code, report = self.run_command("backup", self.data, "-o", self.archive)
        self.assertEqual((code, report["missing"], len(report["damaged"])), (1, [], 1))
        self.assertIn(bad, report["damaged"][0])
        code, report = self.run_command("restore", self.archive, "-o", self.copy)
        self.assertEqual((code, report["missing"], len(report["damaged"])), (1, [], 1))
        self.assertIn(bad, report["damaged"][0])
        other = self.start(data=self.copy)
        self.assertEqual(other.get("/v1/volumes/good").json()["id"], good)
        self.assertEqual(other.post("/v1/volumes/good/query", QUERY).body, light)
        self.assert_problem(other.post("/v1/volumes/bad/query", QUERY), 410, "quarantined")
        name = f"volumes-{bad}.probes"
        self.assertEqual(os.listdir(os.path.join(self.copy, "quarantine")), [name])
        shutil.copy(self.volume_file(2), os.path.join(self.copy, "quarantine", name))
        self.assertEqual(other.post(f"/v1/quarantine/{name}/restore").status, 200)
        self.assertEqual(other.post("/v1/volumes/bad/query", QUERY).status, 200)

    def test_what_is_no_file_is_told(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(2))
        os.remove(self.stored(volume))
        os.mkfifo(self.stored(volume))
        code, report = self.run_command("backup", self.data, "-o", self.archive)
        self.assertEqual((code, len(report["missing"])), (1, 1))
        self.assertIn("is not a regular file", report["missing"][0])

    def test_long_names_in_quarantine(self):
        self.start().stop()
        names = ["10-unknown-volumes-" + "0" * 64 + ".probes", "n" * 150]
        for name in names:
            with open(os.path.join(self.data, "quarantine", name), "w") as file:
                file.write("put aside")
        code, report = self.run_command("backup", self.data, "-o", self.archive)
        self.assertEqual((code, len(report["missing"])), (1, 1))
        self.assertIn(names[1], report["missing"][0])
        self.assertEqual(self.run_command("restore", self.archive, "-o", self.copy)[0], 0)
        self.assertEqual(os.listdir(os.path.join(self.copy, "quarantine")), names[:1])

    def test_a_file_deleted_during_a_backup_is_no_part_of_it(self):
        server = self.start()
        self.upload(server, "scenes", COURTYARD, "court")  # first, and more than a pipe holds
        volume = self.upload(server, "volumes", self.volume_file(2), "level")
        os.mkfifo(self.archive)
        backup = subprocess.Popen([COMMAND, "backup", self.data, "-o", self.archive, "--json"],
                                  stdout=subprocess.PIPE)
        with open(self.archive, "rb") as pipe:
            begin = pipe.read(512)
            self.assertEqual(server.request("DELETE", "/v1/volumes/" + volume).status, 204)
            whole = begin + pipe.read()
        report = json.loads(backup.communicate()[0])
        self.assertEqual((backup.returncode, report["missing"]), (0, []))
        done = subprocess.run([COMMAND, "restore", "-", "-o", self.copy], input=whole)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(self.run_command("fsck", self.copy)[0], 0)

    def test_through_pipes(self):
        server = self.start()
        self.upload(server, "volumes", self.volume_file(2), "level")
        whole = subprocess.run([COMMAND, "backup", self.data, "-o", "-"], cwd=self.folder,
                               capture_output=True, check=True).stdout
        subprocess.run([COMMAND, "restore", "-", "-o", self.copy + "/"], input=whole, check=True)
        self.assertEqual(self.run_command("fsck", self.copy)[0], 0)

    def test_an_archive_in_the_data_folder_is_refused(self):
        self.start().stop()
        os.symlink(self.data, os.path.join(self.folder, "link"))
        for place in ("data/in.tar", "data/volumes/in.tar", "link/in.tar", "data/../data/in.tar"):
            code, report = self.run_command("backup", self.data, "-o", place)
            self.assertEqual((code, report["error"]["field"]), (1, "output"), place)
        self.assertEqual(self.run_command("fsck", self.data)[0], 0)
        self.assertEqual(self.run_command("backup", self.data, "-o", "data.tar")[0], 0)

    def test_a_signal_leaves_nothing_but_the_archive_before(self):
        self.start().stop()
        with open(self.archive, "w") as file:
            file.write("the archive before")
        with open(os.path.join(self.data, "quarantine", "large"), "w") as file:
            file.truncate(8 << 30)
        before = set(os.listdir(self.folder))
        backup = subprocess.Popen([COMMAND, "backup", self.data, "-o", self.archive],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        descriptors = f"/proc/{backup.pid}/fd"
        self.assertTrue(self.eventually(lambda: any(
            os.readlink(os.path.join(descriptors, fd)).endswith("/large")
            for fd in os.listdir(descriptors) if os.path.lexists(os.path.join(descriptors, fd)))))
        backup.terminate()
        self.assertEqual(backup.wait(timeout=60), 128 + signal.SIGTERM)
        self.assertEqual(set(os.listdir(self.folder)), before)
        self.assertEqual(read(self.archive), b"the archive before")

    def test_a_folder_with_files_is_not_replaced(self):
        self.start().stop()
        self.run_command("backup", self.data, "-o", self.archive)
        code, report = self.run_command("restore", self.archive, "-o", self.data)
        self.assertEqual((code, report["error"]["field"]), (1, "output"))


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

    def test_an_unfinished_bake_without_its_folder_is_told(self):
        server = self.start()
        bake = self.begin(server, **test_bakes.QUICK, priority=1)
        server.kill()
        shutil.rmtree(os.path.join(self.data, "bakes", bake))
        archive = os.path.join(self.folder, "backup.tar")
        for command in (("backup", self.data, "-o", archive, "--json"),
                        ("fsck", self.data, "--json")):
            done = subprocess.run([COMMAND, *command], capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("bakes/" + bake, done.stdout)


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
