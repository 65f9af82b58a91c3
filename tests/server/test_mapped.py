# SPDX-License-Identifier: Apache-2.0
"""Files that change under an open volume: no wrong light, and the server stays."""
import os
import threading
import unittest

from service import read
from test_files import VolumeTest

QUERY = {"positions": [[0.5, 0.5, 0.5]] * 100}


class Changed(VolumeTest):
    OPTIONS = ()

    def setUp(self):
        super().setUp()
        self.server = self.start(*self.OPTIONS)
        self.volume = self.upload(self.server, "volumes", self.volume_file(6))
        self.other = self.upload(self.server, "volumes", self.volume_file(2))
        self.path = os.path.join(self.data, "volumes", self.volume + ".probes")
        self.light = self.query().body

    def query(self, volume=None):
        return self.server.post(f"/v1/volumes/{volume or self.volume}/query", QUERY)

    def write_zeros(self):
        with open(self.path, "r+b") as file:
            file.write(bytes(os.path.getsize(self.path)))

    def assert_condemned(self):
        self.assert_problem(self.query(), 410, "quarantined")
        self.assertEqual(self.query(self.other).status, 200)
        self.assertTrue(self.server.is_running())
        # It can come in again, and its light is right.
        self.assertEqual(self.upload(self.server, "volumes", self.volume_file(6)), self.volume)
        self.assertEqual(self.query().body, self.light)


class Copied(Changed):
    def test_a_small_volume_does_not_depend_on_its_file(self):
        for change in (self.write_zeros, lambda: os.truncate(self.path, 100),
                       lambda: os.truncate(self.path, 0)):
            change()
            self.assertEqual(self.query().body, self.light)

    def test_a_file_that_changed_before_it_is_opened_is_found(self):
        self.server.stop()
        with open(self.path, "r+b") as file:
            file.write(b"TETRAPV")
        with open(self.path, "ab") as file:
            file.write(b"more")
        self.server = self.start()
        self.assert_condemned()


class Mapped(Changed):
    OPTIONS = ("--copy-limit", "0", "--recheck-seconds", "86400")

    def test_a_mapped_volume_whose_file_is_cut_off(self):
        os.truncate(self.path, 0)
        self.assertIn(self.query().status, (410, 503))
        self.assert_condemned()

    def test_many_requests_read_what_is_gone(self):
        section = f"/v1/volumes/{self.volume}/sections/positions"
        self.assertEqual(self.server.get(section).status, 200)
        os.truncate(self.path, os.path.getsize(self.path) // 2)
        statuses = {self.query().status for _ in range(20)}
        self.assertLessEqual(statuses, {410, 503})
        self.assert_condemned()


    def test_zeros_that_were_written_into_a_file_are_found_at_the_next_request(self):
        self.assertEqual(self.query().body, self.light)
        self.write_zeros()
        self.assert_condemned()

    def test_a_volume_whose_file_was_written_with_the_same_bytes_is_verified_and_served(self):
        data = read(self.path)
        with open(self.path, "r+b") as file:
            file.write(data)
        self.assertEqual(self.query().body, self.light)

    def test_zeros_under_the_old_time_are_found_in_the_background(self):
        time = os.stat(self.path).st_mtime_ns
        self.write_zeros()
        os.utime(self.path, ns=(time, time))
        self.query()  # sees that something about the file has changed
        self.assertTrue(self.eventually(lambda: self.query().status == 410))
        self.assert_condemned()

    def test_no_answer_is_wrong_while_a_file_is_overwritten(self):
        """Of a file that is changed at any moment: the right light, or a problem."""
        done = threading.Event()
        bodies = set()

        def ask():
            while not done.is_set():
                answer = self.query()
                bodies.add(answer.body if answer.status == 200 else answer.status)

        threads = [threading.Thread(target=ask) for _ in range(4)]
        for thread in threads:
            thread.start()
        self.assertTrue(self.eventually(lambda: bodies))
        self.write_zeros()
        self.assertTrue(self.eventually(lambda: 410 in bodies))
        done.set()
        for thread in threads:
            thread.join()
        self.assertLessEqual(bodies, {self.light, 410, 503})
        self.assert_condemned()


class Rechecked(Changed):
    OPTIONS = ("--copy-limit", "0", "--recheck-seconds", "0.05")

    def test_zeros_that_were_written_into_a_file_are_found(self):
        for _ in range(3):
            self.assertEqual(self.query().body, self.light)
        self.write_zeros()
        self.assertTrue(self.eventually(
            lambda: self.server.get("/v1/volumes/" + self.volume).json()["state"] == "quarantined"))
        self.assert_condemned()


if __name__ == "__main__":
    unittest.main()
