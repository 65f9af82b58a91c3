# SPDX-License-Identifier: Apache-2.0
"""What is out of reach or used up for a moment is 503, and comes back by itself: nothing is condemned."""
import contextlib
import errno
import os
import resource
import socket
import threading
import time
import unittest

import test_bakes
from faults import SHIM, Faults
from service import BINARY, COURTYARD, Answer, lattice, read
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


class Writes(ReachTest):
    """Nothing is promised that the database will not know."""

    def writes(self, server):
        """Answers to requests that store something."""
        groups = self.groups_file([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        return [server.post("/v1/groups", read(groups), BINARY),
                server.request("PATCH", "/v1/volumes/level", {"name": "other"}),
                server.request("DELETE", "/v1/volumes/level"),
                server.post("/v1/relight", {"volume": "level"}),
                server.post("/v1/tetrahedralize", {"groups": ["few"]}),
                server.post("/v1/bakes", {"scene": "court", "groups": ["few"], "only_given_groups": True,
                                          "samples": 1})]

    def server_with_files(self):
        server = self.start()
        self.upload(server, "volumes", self.volume_file(2), "level")
        self.upload(server, "groups", self.groups_file([[0, 1, 0], [1, 1, 0]]), "few")
        self.upload(server, "scenes", COURTYARD, "court")
        return server

    def assert_no_writes(self, server, words):
        for answer in self.writes(server):
            self.assert_retry(answer)
            self.assertIn(words, answer.json()["detail"])
        self.assertEqual(server.post("/v1/volumes/level/query", QUERY).status, 200)

    def test_writes_without_the_database_are_refused(self):
        server = self.server_with_files()
        for suffix in ("", "-wal"):
            path = os.path.join(self.data, "tetralight.db" + suffix)
            os.rename(path, path + ".away")
            self.assert_no_writes(server, "database")
            os.rename(path + ".away", path)
        database = os.path.join(self.data, "tetralight.db")
        os.rename(database, database + ".away")
        with open(database, "wb") as file:  # another one in its place
            file.write(read(database + ".away"))
        self.assert_no_writes(server, "is not the one that was opened")
        os.replace(database + ".away", database)
        for answer in self.writes(server)[:2]:
            self.assertIn(answer.status, (200, 201))

    def test_writes_without_the_folder_are_refused(self):
        server = self.server_with_files()
        server.post("/v1/volumes/level/query", QUERY)  # a copy of the volume is in memory
        with folder_is_away(self.data):
            self.assert_no_writes(server, "")
            self.assertTrue(self.eventually(lambda: server.get("/readyz").status == 503))
            self.assertGreater(int(server.get("/readyz").headers["Retry-After"]), 0)
        self.assertIn(self.writes(server)[0].status, (200, 201))

    def test_a_write_that_loses_its_database_is_not_confirmed(self):
        server = self.start()
        self.upload(server, "groups", self.groups_file(lattice(25)), "many")
        database = os.path.join(self.data, "tetralight.db")
        answers = []
        thread = threading.Thread(
            target=lambda: answers.append(server.post("/v1/tetrahedralize", {"groups": ["many"]})))
        thread.start()
        self.assertTrue(self.eventually(server.children))
        os.rename(database, database + ".away")  # while the program runs
        thread.join()
        os.rename(database + ".away", database)
        self.assert_retry(answers[0])


class Idle(ReachTest):
    def test_idle_connections_make_room_for_new_ones(self):
        server = self.fresh_server_with_a_volume()
        resource.prlimit(server.process.pid, resource.RLIMIT_NOFILE, (64, 64))
        idle = [socket.create_connection(("127.0.0.1", server.port)) for _ in range(100)]
        try:
            begin = time.monotonic()
            self.assertEqual(server.get("/healthz").status, 200)
            self.assertLess(time.monotonic() - begin, 10)
            self.assertTrue(self.eventually(lambda: self.is_served(server)))
            self.assertTrue(self.eventually(lambda: self.warnings(server) == 1))
            closed = [one for one in idle if self.is_closed(one)]
            self.assertGreater(len(closed), 10)
            self.assertIn(idle[0], closed)  # it waited longest
            self.assertLess(len(closed), len(idle))
        finally:
            for one in idle:
                one.close()
        self.assert_served(server)

    def test_a_busy_connection_is_not_closed_for_others(self):
        server = self.fresh_server_with_a_volume()
        resource.prlimit(server.process.pid, resource.RLIMIT_NOFILE, (64, 64))
        with socket.create_connection(("127.0.0.1", server.port)) as busy:
            busy.settimeout(20)
            busy.sendall(b"POST /v1/volumes/level/query HTTP/1.1\r\nHost: localhost\r\nContent-Length: 32\r\n\r\n")
            time.sleep(1.2)
            idle = [socket.create_connection(("127.0.0.1", server.port)) for _ in range(100)]
            self.assertEqual(server.get("/healthz").status, 200)
            busy.sendall(b'{"positions": [[0.5, 0.5, 0.5]]}')
            self.assertRegex(busy.recv(65536), rb"^HTTP/1.1 (200|503) ")
            for one in idle:
                one.close()

    def is_served(self, server):
        return server.post("/v1/volumes/level/query", QUERY).status == 200

    def warnings(self, server):
        return sum("descriptors run out" in line["message"] for line in server.logged())

    @staticmethod
    def is_closed(connection):
        connection.settimeout(0.01)
        try:
            return connection.recv(1) == b""
        except TimeoutError:
            return False
        except ConnectionResetError:
            return True


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
