# SPDX-License-Identifier: Apache-2.0
"""Three readers behind HAProxy, as docs/haproxy.cfg and docs/runbook.md describe them."""
import http.client
import json
import os
import signal
import socket
import unittest

from balancer import HEADERS, NAMES, TOKEN, DyingReader, Load, Query, ReplicaTest, ask, has_haproxy
from service import COURTYARD, lattice, read, write_groups
from test_query import FLOATS, OCCLUSION

# Positions of queries that fit in a buffer of HAProxy, and whose answers the server writes at once.
SMALL, LARGE = 50, 3500
# This fits in the buffer, but its answer is written in pieces.
FITTING = 10000
# This does not fit.
TOO_LARGE = 20000
ONE_WRITE = 65536


@unittest.skipUnless(has_haproxy(), "there is no haproxy")
class Replicas(ReplicaTest):
    def make_query(self, name, count):
        return Query(self.writer.port, name, count, 0 if count > SMALL else FLOATS, OCCLUSION)

    def start_load(self, *counts):
        queries = [self.make_query(name, count) for count in counts for name in NAMES]
        for query in queries:
            fits = (len(query.body) < self.balancer.buffer_size() * 3 // 4 and
                    len(query.answer) < ONE_WRITE - 1024)
            self.assertEqual(fits, query.count != TOO_LARGE)
        load = Load(self.balancer.port, queries)
        self.addCleanup(load.stop)
        return load

    def queries_go_on(self, load):
        count = load.count()
        self.assertTrue(self.eventually(lambda: load.count() > count + 100, 60))

    def test_haproxy_has_no_warnings(self):
        result = self.balancer.check()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("WARNING", result.stderr + result.stdout)

    def test_no_query_fails_while_each_replica_restarts(self):
        self.start_balancer()
        load = self.start_load(SMALL, LARGE, TOO_LARGE)
        for number in range(3):
            self.assertEqual(self.stop_reader(number), 0)
            self.queries_go_on(load)
            self.restart_reader(number)
        load.stop()
        self.assertEqual(load.failures, [])

    def test_no_query_fails_while_each_replica_is_killed(self):
        self.start_balancer()
        load = self.start_load(SMALL, LARGE)
        for number in range(3):
            self.queries_go_on(load)
            self.assertEqual(self.stop_reader(number, signal.SIGKILL), -signal.SIGKILL)
            self.queries_go_on(load)
            self.restart_reader(number)
        load.stop()
        self.assertEqual(load.failures, [])
        self.assertGreater(self.balancer.retries(), 0)

    def test_a_query_is_repeated_if_it_fits_in_the_buffer(self):
        dying = DyingReader()
        self.addCleanup(dying.server_close)
        self.addCleanup(dying.shutdown)
        self.make_balancer([dying.server_address[1], self.readers[1].port, self.readers[2].port])
        self.start_balancer()
        for count, others in ((SMALL, set()), (FITTING, set()), (TOO_LARGE, {502})):
            killed = dying.killed
            statuses = set()
            for name in NAMES:
                query = self.make_query(name, count)
                answer = ask(self.balancer.port, "POST", query.path, query.body)
                statuses.add(answer.status)
                self.assertIn(answer.body, [query.answer] if answer.status == 200 else [answer.body])
            self.assertGreater(dying.killed, killed)
            self.assertEqual(statuses, {200} | others)

    def test_no_query_fails_while_a_replica_hangs(self):
        self.balancer.replace("timeout server 70s", "timeout server 5s")
        self.start_balancer()
        load = self.start_load(SMALL)
        self.queries_go_on(load)
        process = self.readers[0].process
        process.send_signal(signal.SIGSTOP)
        self.addCleanup(process.send_signal, signal.SIGCONT)
        self.assertTrue(self.eventually(lambda: not self.balancer.are_up("reader1"), 60))
        self.queries_go_on(load)
        process.send_signal(signal.SIGCONT)
        self.assertTrue(self.eventually(lambda: self.balancer.are_up("reader1"), 60))
        load.stop()
        self.assertEqual(load.failures, [])

    def test_queries_go_on_without_the_writer(self):
        self.start_balancer()
        load = self.start_load(SMALL)
        self.writer.kill()
        self.queries_go_on(load)
        self.assertEqual(ask(self.balancer.port, "DELETE", "/v1/volumes/" + NAMES[0]).status, 503)
        self.start("--listen", f"127.0.0.1:{self.writer.port}", env=TOKEN)
        data = read(self.file_of(NAMES[0]))
        upload = lambda: ask(self.balancer.port, "POST", "/v1/volumes?name=again", data)
        self.assertTrue(self.eventually(lambda: upload().status in (200, 201)))
        load.stop()
        self.assertEqual(load.failures, [])

    def volumes_of_readers(self, queries):
        """Asks one query after another, and for its volume; returns the paths that each reader was asked for."""
        begin = [len(reader.logged()) for reader in self.readers]
        for query in queries:
            connection = http.client.HTTPConnection("127.0.0.1", self.balancer.port, timeout=60)
            self.assertEqual(query.ask(connection), (200, query.answer))
            connection.close()
            self.assertEqual(ask(self.balancer.port, "GET", query.path.removesuffix("/query")).status, 200)

        def paths():
            lines = [reader.logged()[first:] for reader, first in zip(self.readers, begin)]
            return [[path for line in each if (path := line.get("path", "")).startswith("/v1/volumes/")]
                    for each in lines]

        self.assertTrue(self.eventually(lambda: sum(map(len, paths())) == 2 * len(queries)))
        return [{path.split("/")[3] for path in each} for each in paths()]

    def test_a_volume_stays_with_its_replica(self):
        self.start_balancer()
        queries = [Query(self.writer.port, name, SMALL) for name in NAMES]
        before = self.volumes_of_readers(queries * 3)
        self.assertEqual(sum(map(len, before)), len(NAMES))
        self.assertTrue(all(before), before)
        self.stop_reader(0)
        self.assertTrue(self.eventually(lambda: not self.balancer.are_up("reader1")))
        after = self.volumes_of_readers(queries * 3)
        self.assertEqual(after[0], set())
        for number in (1, 2):
            self.assertLessEqual(before[number], after[number])
        self.assertEqual(after[1] & after[2], set())

    def test_a_change_reaches_every_replica(self):
        self.start_balancer()
        path = os.path.join(self.folder, "new.json")
        write_groups(path, lattice(3))
        self.command("tetrahedralize", path, "-o", path + ".probes")
        data = read(path + ".probes")

        def statuses(name):
            body = b'{"positions":[[0,0,0]]}'
            return {ask(reader.port, "POST", f"/v1/volumes/{name}/query", body, "application/json").status
                    for reader in self.readers}

        self.assertEqual(statuses("new"), {404})
        self.assertEqual(ask(self.balancer.port, "POST", "/v1/volumes?name=new", data).status, 201)
        self.assertTrue(self.eventually(lambda: statuses("new") == {200}))
        renamed = ask(self.balancer.port, "PATCH", "/v1/volumes/new", json.dumps({"name": "newer"}).encode(),
                      "application/json")
        self.assertEqual(renamed.status, 200, renamed.body)
        self.assertTrue(self.eventually(lambda: statuses("newer") == {200} and statuses("new") == {404}))
        self.assertEqual(ask(self.balancer.port, "DELETE", "/v1/volumes/newer").status, 204)
        self.assertTrue(self.eventually(lambda: statuses("newer") == {404}))

    def test_metrics_are_not_public(self):
        self.start_balancer()
        self.assertEqual(ask(self.balancer.port, "GET", "/metrics").status, 403)

    def test_programs_end_when_nobody_waits(self):
        self.start_balancer()
        with open(COURTYARD, "rb") as file:
            scene = ask(self.balancer.port, "POST", "/v1/scenes?name=court", file.read()).json()["id"]
        order = json.dumps({"scene": scene, "volume": NAMES[0], "width": 16384, "height": 16384,
                            "antialias": 16}).encode()
        head = "".join(f"{name}: {value}\r\n" for name, value in HEADERS.items())
        with socket.create_connection(("127.0.0.1", self.balancer.port)) as client:
            client.sendall(f"POST /v1/render HTTP/1.1\r\n{head}Content-Length: {len(order)}\r\n\r\n".encode() + order)
            self.assertTrue(self.eventually(self.writer.children))
        self.assertTrue(self.eventually(lambda: not self.writer.children()))


if __name__ == "__main__":
    unittest.main()
