# SPDX-License-Identifier: Apache-2.0
"""A disk that is full: what is there is served, writes are refused, deleting helps."""
import ctypes
import errno
import os
import subprocess
import time
import unittest

import test_bakes
from service import BINARY, Server, read
from test_files import VolumeTest

CLONE_NEWNS = 0x00020000
CLONE_NEWUSER = 0x10000000
QUERY = {"positions": [[0.5, 0.5, 0.5]]}


def setUpModule():
    """Lets this process, and no other, see what it mounts."""
    user, group = os.getuid(), os.getgid()
    if ctypes.CDLL(None).unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0:
        raise unittest.SkipTest("the system lets users mount nothing")
    for name, line in (("setgroups", "deny"), ("uid_map", f"0 {user} 1"), ("gid_map", f"0 {group} 1")):
        with open("/proc/self/" + name, "w") as file:
            file.write(line)


class SmallDisk(VolumeTest):
    """The server's folder is a disk of 24 MiB."""

    def setUp(self):
        super().setUp()
        os.mkdir(self.data)
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=24m", "tmpfs", self.data], check=True)
        self.addCleanup(subprocess.run, ["umount", "--lazy", self.data])
        self.filler = os.path.join(self.data, "filler")
        self.reserve = os.path.join(self.data, "reserve")

    def fill(self):
        with open(self.filler, "ab", buffering=0) as file:
            for size in (1 << 20, 4096):
                try:
                    while True:
                        file.write(bytes(size))
                except OSError as error:
                    self.assertEqual(error.errno, errno.ENOSPC)

    def assert_full(self, server):
        self.fill()
        path = self.volume_file(4)
        self.assert_problem(server.post("/v1/volumes?name=new", read(path), BINARY), 507, "disk_full")
        self.assertEqual(len(os.listdir(os.path.join(self.data, "volumes"))),
                         len(server.get("/v1/volumes").json()["volumes"]))


class LostDisk(SmallDisk):
    def assert_not_ready(self, server, words):
        """Soon: the server looks four times a second."""
        self.assertTrue(self.eventually(lambda: words in server.get("/readyz").body.decode()))
        self.assertEqual(server.get("/readyz").status, 503)

    def test_an_unmounted_disk_is_not_ready(self):
        server = self.start()
        self.assertEqual(server.get("/readyz").status, 200)
        subprocess.run(["umount", "--lazy", self.data], check=True)
        self.assert_not_ready(server, "the data folder is not the one that was opened\n")

    def test_a_disk_that_cannot_be_written_is_not_ready(self):
        server = self.start()
        subprocess.run(["mount", "--bind", self.data, self.data], check=True)
        self.addCleanup(subprocess.run, ["umount", "--lazy", self.data])
        subprocess.run(["mount", "-o", "remount,bind,ro", self.data], check=True)
        self.assert_not_ready(server, "cannot be written")

    def test_a_full_disk_is_ready_to_answer_queries(self):
        server = self.start()
        self.fill()
        time.sleep(0.5)  # the server looks four times a second
        self.assertEqual(server.get("/readyz").status, 200)


class FullDisk(SmallDisk):
    def test_deleting_helps(self):
        server = self.start()
        small = self.upload(server, "volumes", self.volume_file(2), "small")
        self.upload(server, "volumes", self.volume_file(3), "other")
        self.upload(server, "volumes", self.volume_file(3), "more")
        self.assert_full(server)
        self.assertEqual(server.post("/v1/volumes/other/query", QUERY).status, 200)
        for reference in (small, "other", "more"):
            answer = server.request("DELETE", "/v1/volumes/" + reference)
            self.assertEqual(answer.status, 204, answer.body)
            self.fill()
        self.assertEqual(server.get("/v1/volumes").json()["volumes"], [])
        server.kill()
        self.assertEqual(self.start().get("/v1/volumes").json()["volumes"], [])

    def test_space_to_delete_with_comes_back(self):
        server = self.start()
        first = self.upload(server, "volumes", self.volume_file(2))
        whole = os.path.getsize(self.reserve)
        self.fill()
        self.assertEqual(server.request("DELETE", "/v1/volumes/" + first).status, 204)
        self.assertGreater(os.path.getsize(self.reserve), 0)
        os.remove(self.filler)
        self.upload(server, "volumes", self.volume_file(3))
        self.assertEqual(os.path.getsize(self.reserve), whole)

    def start_on_a_full_disk(self, end, has_reserve):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(2), "level")
        end(server)
        if not has_reserve:
            os.remove(self.reserve)
        self.fill()
        server = self.start()
        self.assertEqual(server.get("/readyz").status, 200)
        self.assertEqual(server.post("/v1/volumes/level/query", QUERY).status, 200)
        self.assert_full(server)
        os.remove(self.filler)
        self.assertEqual(server.request("DELETE", "/v1/volumes/" + volume).status, 204)

    def test_a_server_that_ended_starts(self):
        self.start_on_a_full_disk(Server.stop, has_reserve=True)

    def test_a_server_that_was_killed_starts(self):
        self.start_on_a_full_disk(Server.kill, has_reserve=True)

    def test_a_server_that_ended_starts_without_a_reserve(self):
        self.start_on_a_full_disk(Server.stop, has_reserve=False)

    def test_a_server_that_was_killed_starts_without_a_reserve(self):
        self.start_on_a_full_disk(Server.kill, has_reserve=False)


class BakesOnAFullDisk(SmallDisk, test_bakes.BakeTest):
    def bake_until_it_is_full(self, server, keep_full=False):
        bake = self.begin(server, **test_bakes.SLOW)
        self.wait_for_chunks(bake, 2)
        self.fill()
        while keep_full and server.get("/v1/bakes/" + bake).json()["state"] == "running":
            self.fill()  # what the bake frees when it fails
        answer = server.wait_for(bake)
        self.assertEqual(answer["state"], "failed")
        self.assertIn("No space left", answer["error"])
        return bake, answer

    def test_a_bake_fails_with_its_reason_for_good(self):
        server = self.start()
        bake, answer = self.bake_until_it_is_full(server)
        self.wait_for_no_folders()
        server.kill()
        again = super(test_bakes.BakeTest, self).start()
        self.assertEqual(again.get("/v1/bakes/" + bake).json(), answer)
        os.remove(self.filler)
        self.assertEqual(again.wait_for(self.begin(again, **test_bakes.QUICK))["state"], "done")

    def test_a_bake_whose_end_cannot_be_stored_goes_on_the_next_time(self):
        expected = self.baked_by_command("--samples", str(test_bakes.SLOW["samples"]), "-b", "4")
        server = self.start()
        os.remove(self.reserve)
        bake, _ = self.bake_until_it_is_full(server, keep_full=True)
        chunks = os.listdir(self.chunk_folder(bake))
        self.assertTrue(chunks)
        server.kill()
        os.remove(self.filler)
        again = super(test_bakes.BakeTest, self).start()
        self.assertEqual(self.file_of(again, bake), expected)


if __name__ == "__main__":
    unittest.main()
