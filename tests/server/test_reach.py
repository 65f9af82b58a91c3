# SPDX-License-Identifier: Apache-2.0
"""What is out of reach or used up for a moment is 503, and comes back by itself: nothing is condemned."""
import contextlib
import errno
import os
import resource
import unittest

import test_bakes
from faults import SHIM, Faults
from service import BINARY, Answer, read
from test_files import VolumeTest

QUERY = {"positions": [[0.5, 0.5, 0.5]]}


@contextlib.contextmanager
def folder_is_away(folder, replacement=None):
    """Meanwhile there is nothing at its path, or a plain file."""
    os.rename(folder, folder + ".away")
    if replacement is not None:
        with open(folder, "wb") as file:
            file.write(replacement)
    try:
        yield
    finally:
        if replacement is not None:
            os.remove(folder)
        elif os.path.isdir(folder):
            os.rmdir(folder)
        os.rename(folder + ".away", folder)


@contextlib.contextmanager
def descriptors_left(server, count):
    """Meanwhile the server can open this many files more, its connections included."""
    process = server.process.pid
    limits = resource.prlimit(process, resource.RLIMIT_NOFILE)
    used = max(map(int, os.listdir(f"/proc/{process}/fd"))) + 1
    free = set(range(used)) - set(map(int, os.listdir(f"/proc/{process}/fd")))
    resource.prlimit(process, resource.RLIMIT_NOFILE, (used + count - len(free), limits[1]))
    try:
        yield
    finally:
        resource.prlimit(process, resource.RLIMIT_NOFILE, limits)


class ReachTest(VolumeTest):
    def setUp(self):
        super().setUp()
        self.volumes = os.path.join(self.data, "volumes")

    @staticmethod
    def answer(connection):
        response = connection.getresponse()
        return Answer(response, response.read())

    def in_quarantine(self):
        return os.listdir(os.path.join(self.data, "quarantine"))

    def assert_retry(self, answer, code="unavailable"):
        self.assert_problem(answer, 503, code)
        self.assertGreater(int(answer.headers["Retry-After"]), 0)

    def fresh_server_with_a_volume(self):
        """One that has not opened its volume yet."""
        server = self.start()
        self.upload(server, "volumes", self.volume_file(2), "level")
        server.stop()
        return self.start()

    def assert_served(self, server):
        self.assertEqual(server.post("/v1/volumes/level/query", QUERY).status, 200)
        self.assertEqual(server.get("/v1/volumes/level").json()["state"], "ready")
        self.assertEqual(self.in_quarantine(), [])


class Reach(ReachTest):
    def test_a_volume_without_a_free_descriptor(self):
        server = self.fresh_server_with_a_volume()
        connection = server.connect()
        connection.request("GET", "/healthz")
        connection.getresponse().read()
        with descriptors_left(server, 0):
            connection.request("POST", "/v1/volumes/level/query", '{"positions": [[0, 0, 0]]}')
            self.assert_retry(self.answer(connection), "out_of_resources")
            connection.request("GET", "/v1/volumes/level/file")
            self.assert_retry(self.answer(connection), "out_of_resources")
        connection.close()
        self.assert_served(server)

    def test_a_folder_that_is_away_for_a_request(self):
        server = self.fresh_server_with_a_volume()
        for replacement in (None, b"a file"):
            with folder_is_away(self.volumes, replacement):
                for path in ("query", "validate"):
                    self.assert_retry(server.post("/v1/volumes/level/" + path, QUERY))
                self.assert_retry(server.get("/v1/volumes/level/file"))
                self.assert_retry(server.post("/v1/volumes", read(self.volume_file(3)), BINARY))
                self.assert_retry(server.post("/v1/relight", {"volume": "level"}))
        self.assert_served(server)
        self.upload(server, "volumes", self.volume_file(3))

    def test_a_folder_that_is_away_at_the_start(self):
        server = self.start()
        self.upload(server, "volumes", self.volume_file(2), "level")
        server.stop()
        with folder_is_away(self.volumes):
            server = self.start()
            self.assert_retry(server.post("/v1/volumes/level/query", QUERY))
            self.assertIn("is missing", read(server.log_path).decode())
        self.assert_served(server)

    def test_a_start_on_a_folder_that_is_no_folder_condemns_nothing(self):
        server = self.start()
        self.upload(server, "volumes", self.volume_file(2), "level")
        server.stop()
        with folder_is_away(self.volumes, b"a file"):
            with self.assertRaises(RuntimeError):
                self.start()
        self.assert_served(self.start())

    def test_a_missing_file_comes_back_with_an_upload(self):
        server = self.fresh_server_with_a_volume()
        volume = server.get("/v1/volumes/level").json()["id"]
        os.remove(os.path.join(self.volumes, volume + ".probes"))
        self.assert_retry(server.get(f"/v1/volumes/{volume}/file"))
        self.upload(server, "volumes", self.volume_file(2))
        self.assert_served(server)

    def test_a_folder_of_requests_that_is_away(self):
        server = self.fresh_server_with_a_volume()
        with folder_is_away(os.path.join(self.data, "work"), b"a file"):
            self.assert_retry(server.post("/v1/volumes", read(self.volume_file(3)), BINARY))
        self.upload(server, "volumes", self.volume_file(3))


@unittest.skipUnless(SHIM, "sanitizers do not go with preloaded libraries")
class Refused(ReachTest):
    def test_a_call_that_fails_once_condemns_nothing(self):
        self.fresh_server_with_a_volume().stop()
        faults = Faults(self.data, self.folder)
        for options in ((), ("--copy-limit", "0")):
            for call, error in (("open", errno.EACCES), ("open", errno.EMFILE), ("open", errno.ENOENT),
                                ("read", errno.EIO), ("read", errno.ESTALE)):
                with self.subTest(call=call, error=errno.errorcode[error], options=options):
                    server = self.start(*options, env=faults.env)
                    faults.arm(call, 1, error)
                    answer = server.post("/v1/volumes/level/query", QUERY)
                    self.assertTrue(faults.has_fired())
                    self.assertEqual(answer.status, 503, answer.body)
                    self.assertNotIn(self.folder, answer.body.decode())
                    self.assert_served(server)
                    server.stop()

    def test_a_folder_that_cannot_be_read_at_the_start(self):
        self.fresh_server_with_a_volume().stop()
        faults = Faults(self.data, self.folder)
        opened = self.opens_of_a_start(faults)
        for number in range(1, opened + 1):
            with self.subTest(number=number):
                faults.arm("open", number, errno.EACCES)
                try:
                    server = self.start(env=faults.env)
                except RuntimeError:
                    server = self.start(env=faults.env)
                self.assertTrue(faults.has_fired())
                self.assert_served(server)
                self.command("fsck", self.data)  # the database is not locked for others
                server.stop()

    def opens_of_a_start(self, faults):
        faults.arm()
        server = self.start(env=faults.env)
        count = faults.counts()["open"]
        server.stop()
        return count


class Bakes(test_bakes.BakeTest):
    def test_a_bake_waits_for_descriptors(self):
        server = self.start()
        first = self.begin(server, **test_bakes.SLOW)
        self.wait_for_chunks(first, 1)
        second = self.begin(server, **test_bakes.QUICK)
        connection = server.connect()
        connection.request("POST", f"/v1/bakes/{first}/cancel")
        with descriptors_left(server, 0):
            self.assertEqual(connection.getresponse().status, 200)
            self.assertTrue(self.eventually(
                lambda: "tried again" in read(server.log_path).decode()))
        self.assertEqual(server.wait_for(second)["state"], "done")


if __name__ == "__main__":
    unittest.main()
