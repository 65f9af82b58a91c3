# SPDX-License-Identifier: Apache-2.0
"""Requests that take long leave the others their share."""
import http.client
import json
import os
import re
import threading
import unittest

from service import BINARY, ServiceTest, lattice, write_groups


class Queues(ServiceTest):
    def setUp(self):
        super().setUp()
        self.threads = []
        self.answers = []

    def tearDown(self):
        super().tearDown()  # ends the servers
        for thread in self.threads:
            thread.join()

    def ask(self, server, path, body, source="127.0.0.1"):
        """Sends a request from an address without waiting for the answer."""
        def run():
            connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=120,
                                                    source_address=(source, 0))
            try:
                connection.request("POST", path, json.dumps(body), {"Content-Type": "application/json"})
                response = connection.getresponse()
                self.answers.append((source, response.status, response.read()[:500]))
            except (ConnectionError, http.client.HTTPException, TimeoutError):
                pass
            finally:
                connection.close()
        self.threads.append(threading.Thread(target=run))
        self.threads[-1].start()

    def waiting(self, server, queue):
        found = re.search(rf'^tetralight_waiting_requests{{queue="{queue}"}} (\d+)$',
                          server.get("/metrics").body.decode(), re.M)
        return int(found[1])

    def fill(self, server, order, count):
        """One picture that is drawn and others that wait for it."""
        for waiting in range(count + 1):
            self.ask(server, "/v1/render", order)
            if waiting == 0:
                self.assertTrue(self.eventually(server.children))
            self.assertTrue(self.eventually(lambda: self.waiting(server, "tools") == waiting))

    def statuses(self, source):
        return [status for other, status, _ in self.answers if other == source]

    def test_files_are_stored_while_pictures_take_all_workers(self):
        server = self.start("--workers", "1")
        self.fill(server, self.order_of_hours(server), 2)
        groups = os.path.join(self.folder, "more.json")
        write_groups(groups, lattice(3))
        self.upload(server, "groups", groups, "more")
        self.assertEqual(server.request("PATCH", "/v1/groups/more", {"name": "most"}).status, 200)
        self.assertEqual(server.request("DELETE", "/v1/groups/most").status, 204)
        self.assertEqual(self.waiting(server, "tools"), 2)
        self.assertEqual(self.answers, [])

    def test_long_queries_leave_the_network_threads(self):
        server = self.start("--threads", "1")
        self.order_of_hours(server)  # stores the volume "few"
        order = {"positions": [[0.5, 0.25, i / 50000] for i in range(50000)]}
        for _ in range(3):
            self.ask(server, "/v1/volumes/few/query", order)
        self.assertTrue(self.eventually(lambda: self.waiting(server, "compute") > 0))
        self.assertTrue(self.eventually(lambda: len(self.answers) == 3, 60))
        self.assertEqual(self.statuses("127.0.0.1"), [200] * 3)

    def test_a_client_that_asks_for_much_leaves_room_for_others(self):
        server = self.start("--workers", "1", "--max-waiting", "3")
        order = self.order_of_hours(server)
        self.fill(server, order, 3)
        self.assert_problem(server.post("/v1/render", order), 503, "busy")
        self.ask(server, "/v1/render", order, "127.0.0.2")
        self.assertTrue(self.eventually(lambda: self.answers))
        self.assertEqual(self.statuses("127.0.0.1"), [503])
        self.assertIn(b'"busy"', self.answers[0][2])
        self.assertEqual(self.waiting(server, "tools"), 3)

    def test_the_work_of_clients_takes_turns(self):
        server = self.start("--workers", "1")
        order = self.order_of_hours(server)
        self.fill(server, order, 1)
        wrong = {"scene": "court", "volume": "few", "camera": "none"}  # answered at once
        for _ in range(3):
            self.ask(server, "/v1/render", order)
        self.assertTrue(self.eventually(lambda: self.waiting(server, "tools") == 4))
        self.ask(server, "/v1/render", wrong, "127.0.0.2")
        self.assertTrue(self.eventually(lambda: self.waiting(server, "tools") == 5))
        for turn in range(2):  # at most one picture comes before it
            if self.statuses("127.0.0.2"):
                break
            child = server.children()
            for process in child:
                os.kill(process, 9)
            self.assertTrue(self.eventually(
                lambda: self.statuses("127.0.0.2") or set(server.children()) - set(child)))
        self.assertTrue(self.eventually(lambda: self.statuses("127.0.0.2")))
        self.assertLessEqual(len(self.statuses("127.0.0.1")), 2)

    def test_a_request_does_not_wait_longer_than_its_limit(self):
        server = self.start("--workers", "1", "--queue-seconds", "1")
        order = self.order_of_hours(server)
        self.fill(server, order, 0)
        answer = server.post("/v1/render", order)
        self.assert_problem(answer, 503, "busy")
        self.assertTrue(answer.headers["Retry-After"])
        self.assertEqual(self.waiting(server, "tools"), 0)

    def test_a_client_that_leaves_gives_its_place_back(self):
        server = self.start("--workers", "1")
        order = self.order_of_hours(server)
        self.fill(server, order, 0)
        connection = server.connect()
        connection.request("POST", "/v1/render", json.dumps(order))
        self.assertTrue(self.eventually(lambda: self.waiting(server, "tools") == 1))
        connection.close()
        self.assertTrue(self.eventually(lambda: self.waiting(server, "tools") == 0))

    def test_long_binary_queries_are_answered(self):
        server = self.start("--threads", "1")
        self.order_of_hours(server)
        from test_query import binary_query
        positions = [[0.5, 0.25, i / 20000] for i in range(20000)]
        answer = server.post("/v1/volumes/few/query", binary_query(positions), BINARY)
        self.assertEqual((answer.status, answer.body[:4]), (200, b"TLA1"))


if __name__ == "__main__":
    unittest.main()
