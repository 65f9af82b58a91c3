# SPDX-License-Identifier: Apache-2.0
"""Archives that are damaged, changed or hostile, and restoring that is interrupted."""
import io
import json
import os
import signal
import sqlite3
import subprocess
import tarfile

from service import COMMAND, read
from test_backup import DataFolder


class Archive(DataFolder):
    """A backup of a folder with two volumes."""

    def setUp(self):
        super().setUp()
        self.archive = os.path.join(self.folder, "backup.tar")
        self.bad = os.path.join(self.folder, "bad.tar")
        self.copy = os.path.join(self.folder, "copy")
        server = self.start()
        self.volumes = [self.upload(server, "volumes", self.volume_file(n)) for n in (2, 3)]
        server.stop()
        self.assertEqual(self.run_command("backup", self.data, "-o", self.archive)[0], 0)
        self.whole = read(self.archive)

    def members(self):
        with tarfile.open(self.archive) as tar:
            return {member.name: tar.extractfile(member).read() for member in tar}

    def packed(self, members):
        memory = io.BytesIO()
        with tarfile.open(fileobj=memory, mode="w", format=tarfile.USTAR_FORMAT) as tar:
            for name, data in members.items():
                info = tarfile.TarInfo(name)
                info.size = len(data)
                tar.addfile(info, io.BytesIO(data))
        return memory.getvalue()

    def restore(self, archive):
        with open(self.bad, "wb") as file:
            file.write(archive)
        return self.run_command("restore", "bad.tar", "-o", self.copy)

    def assert_refused(self, archive, words=""):
        before = set(os.listdir(self.folder)) | {"bad.tar"}
        code, report = self.restore(archive)
        self.assertEqual((code, report["error"]["code"]), (1, "corrupt"), report)
        message = report["error"]["message"]
        self.assertIn(words, message)
        self.assertEqual(message.count("bad.tar"), 1, message)
        self.assertEqual(set(os.listdir(self.folder)), before)

    def assert_told(self, archive, member, name):
        """Restored, with the name among the missing or the damaged files only."""
        code, report = self.restore(archive)
        told = {key: report[key] for key in ("missing", "damaged")}
        self.assertEqual(code, 1, report)
        self.assertEqual(len(told[member]), 1, told)
        self.assertIn(name, told[member][0])
        self.assertEqual(sum(map(len, told.values())), 1, told)
        self.assertTrue(os.path.exists(os.path.join(self.copy, "tetralight.db")))
        self.assertEqual(self.start(data=self.copy).stop(), 0)


class Damaged(Archive):
    def entry(self, name, data=b"bytes", **more):
        info = tarfile.TarInfo(name)
        info.size = len(data)
        for member, value in more.items():
            setattr(info, member, value)
        return info, data

    def test_hostile_and_damaged_archives_leave_nothing(self):
        whole = self.whole
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
        for number, archive in enumerate(archives):
            with self.subTest(number=number):
                self.assert_refused(archive)
        self.assertFalse(os.path.exists("/tmp/tetralight_escaped"))

    def test_messages_say_what_is_wrong(self):
        for name, words in (("./index2", '"." or "//"'), ("quarantine//x", '"." or "//"'),
                            ("../x", "leads out of the folder"), ("/x", "is an absolute name"),
                            ("", "has no name"), ("elsewhere", "does not belong")):
            with self.subTest(name=name):
                self.assert_refused(self.packed({name: b"bytes"}), words)
        self.assert_refused(self.whole[:-2000], "is cut off at byte")
        self.assert_refused(b"x" * 4096, "is not a tar archive")

    def test_what_follows_the_end_is_refused_unless_it_is_zeros(self):
        for rest in (b"junk" * 4000, self.whole, b"\0" * 100000 + b"x"):
            self.assert_refused(self.whole + rest, "goes on after the end")
        code, report = self.restore(self.whole + b"\0" * 9000)
        self.assertEqual((code, report["missing"], report["damaged"]), (0, [], []))

    def test_wrong_databases(self):
        foreign = os.path.join(self.folder, "foreign.db")
        connection = sqlite3.connect(foreign)
        connection.executescript("CREATE TABLE pets (name TEXT); PRAGMA user_version = 5;")
        connection.close()
        members = self.members()
        database = members["tetralight.db"]
        half = len(database) // 2
        wrong = [os.urandom(8192), b"", read(foreign), database[:half],
                 database[:half] + b"\x7f" * 400 + database[half + 400:]]
        for number, bad in enumerate(wrong):
            with self.subTest(number=number):
                changed = {**members, "tetralight.db": bad}
                self.assert_refused(self.packed(changed), "tetralight.db")
        del members["backup.json"]
        for number, bad in enumerate(wrong[:4]):
            with self.subTest(number=number, is_listed=False):
                self.assert_refused(self.packed({**members, "tetralight.db": bad}), "tetralight.db")

    def test_files_that_were_removed_from_an_archive(self):
        for name in (f"volumes/{self.volumes[0]}.probes", "index.json", "backup.json"):
            with self.subTest(name=name):
                members = self.members()
                del members[name]
                self.copy += "1"
                self.assert_told(self.packed(members), "missing", name)
                findings = self.run_command("fsck", self.copy)[1]["findings"]
                self.assertEqual(len(findings), name.startswith("volumes"))
        members = self.members()
        del members["tetralight.db"]
        self.copy += "1"
        self.assert_refused(self.packed(members), "holds no database")

    def test_files_that_were_changed_in_an_archive(self):
        volume = f"volumes/{self.volumes[0]}.probes"
        for name in (volume, "index.json"):
            with self.subTest(name=name):
                self.copy += "1"
                self.assert_told(self.packed({**self.members(), name: b"{{{"}), "damaged", name)
                findings = self.run_command("fsck", self.copy)[1]["findings"]
                self.assertEqual(len(findings), name == volume)
        self.copy += "1"
        self.assert_refused(self.packed({**self.members(), "backup.json": b"{{{"}), "backup.json")

    def test_a_pipe_that_nobody_writes_to_is_refused(self):
        os.mkfifo(self.bad)
        done = subprocess.run([COMMAND, "restore", self.bad, "-o", self.copy, "--json"],
                              capture_output=True, timeout=20)
        self.assertEqual((done.returncode, json.loads(done.stdout)["error"]["field"]),
                         (1, "archive"))


class Interrupted(Archive):
    def begin(self):
        """Restores from a pipe that has no more bytes yet; gives its unfinished folder, too."""
        restore = subprocess.Popen([COMMAND, "restore", "-", "-o", self.copy],
                                   stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        restore.stdin.write(self.whole[:1024])
        restore.stdin.flush()
        folder = f"{self.copy}.{restore.pid}.restore"
        self.assertTrue(self.eventually(lambda: os.path.isdir(folder)))
        return restore, folder

    def end(self, restore, number):
        restore.send_signal(number)
        code = restore.wait(timeout=20)
        restore.stdin.close()
        return code

    def test_a_signal_leaves_nothing(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            restore, folder = self.begin()
            self.assertEqual(self.end(restore, number), 128 + number)
            self.assertFalse(os.path.exists(folder))
        self.assertFalse(os.path.exists(self.copy))

    def test_what_a_killed_one_left_is_removed_by_the_next_one(self):
        killed, stale = self.begin()
        self.end(killed, signal.SIGKILL)
        self.assertTrue(os.path.isdir(stale))
        living, unfinished = self.begin()
        self.assertFalse(os.path.exists(stale))
        mine = os.path.join(self.folder, "copy.mine.restore")
        os.makedirs(mine)
        self.assertEqual(self.run_command("restore", self.archive, "-o", self.copy)[0], 0)
        self.assertTrue(os.path.isdir(unfinished))  # its process lives
        self.assertTrue(os.path.isdir(mine))
        self.end(living, signal.SIGTERM)
        self.assertEqual(self.run_command("fsck", self.copy)[0], 0)


if __name__ == "__main__":
    import unittest
    unittest.main()
