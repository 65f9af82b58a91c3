# SPDX-License-Identifier: Apache-2.0
"""What is not a good request gets the right answer, and the server goes on."""
import http.client
import json
import os
import re
import socket
import threading
import time
import unittest

from service import ServiceTest, read


class Malformed(ServiceTest):
    def setUp(self):
        super().setUp()
        self.server = self.start("--header-seconds", "2", "--idle-seconds", "20")

    def tearDown(self):
        self.assertEqual(self.server.get("/healthz").status, 200)
        super().tearDown()

    def status_of(self, data, **options):
        answer = self.server.raw(data, **options)
        return int(answer.split(b" ", 2)[1]) if answer.startswith(b"HTTP/1.1 ") else None

    def test_what_is_no_http_is_refused(self):
        for data in (b"nonsense\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\nHost: a\r\n\r\n",
                     b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n",
                     b"GET / HTTP/1.1\r\nHost: localhost\r\nbad header\r\n\r\n",
                     b"POST /v1/grid HTTP/1.1\r\nHost: localhost\r\nContent-Length: -1\r\n\r\n",
                     b"POST /v1/grid HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n"
                     b"Content-Length: 6\r\n\r\nhello",
                     b"GET /%zz HTTP/1.1\r\nHost: localhost\r\n\r\n",
                     b"GET /%00 HTTP/1.1\r\nHost: localhost\r\n\r\n",
                     b"GET http HTTP/1.1\r\nHost: localhost\r\n\r\n"):
            with self.subTest(data=data[:40]):
                self.assertEqual(self.status_of(data), 400)

    def test_length_and_chunks_together_are_refused(self):
        self.assertEqual(self.status_of(
            b"POST /v1/grid HTTP/1.1\r\nHost: localhost\r\nContent-Length: 4\r\n"
            b"Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n"), 400)

    def test_a_million_headers_are_refused(self):
        line = b"a: b\r\n" * 1000
        self.assertEqual(self.status_of([b"GET / HTTP/1.1\r\nHost: localhost\r\n"] + [line] * 1000),
                         431)

    def test_one_long_header_is_refused(self):
        self.assertEqual(self.status_of(b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"a" * 100000),
                         431)

    def test_a_body_of_5_gb_is_refused_before_it_comes(self):
        begin = time.monotonic()
        for path in (b"/v1/grid", b"/v1/scenes"):
            self.assertEqual(self.status_of(
                b"POST " + path + b" HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5000000000\r\n"
                b"\r\nabc"), 413)
        self.assertLess(time.monotonic() - begin, 15)

    def test_chunks_count_against_the_limit(self):
        self.server.kill()
        self.server = self.start("--max-body", "1000")
        piece = b"200\r\n" + b" " * 512 + b"\r\n"
        self.assertEqual(self.status_of(
            [b"POST /v1/grid HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"] +
            [piece] * 10), 413)

    def test_torn_chunks_are_refused(self):
        self.assertEqual(self.status_of(
            b"POST /v1/grid HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
            b"zz\r\nhello\r\n0\r\n\r\n"), 400)

    def test_a_head_that_drips_is_cut_off(self):
        begin = time.monotonic()
        with socket.create_connection(("127.0.0.1", self.server.port)) as slow:
            slow.settimeout(0.2)
            slow.sendall(b"GET / HTTP/1.1\r\n")
            closed = False
            while not closed and time.monotonic() - begin < 20:
                try:
                    slow.sendall(b"X")
                    closed = slow.recv(100) == b""
                except socket.timeout:
                    pass
                except OSError:
                    closed = True
        self.assertTrue(closed)
        self.assertGreater(time.monotonic() - begin, 1.5)

    def test_others_are_served_while_many_drip(self):
        slow = [socket.create_connection(("127.0.0.1", self.server.port)) for _ in range(200)]
        for connection in slow:
            connection.sendall(b"POST /v1/grid HTTP/1.1\r\nHost: loc")
        self.assertEqual(self.server.get("/healthz").status, 200)
        for connection in slow:
            connection.close()

    def test_deep_json_is_refused(self):
        body = b'{"scene":' + b"[" * 100000 + b"]" * 100000 + b"}"
        answer = self.server.post("/v1/bakes", body, "application/json")
        self.assert_problem(answer, 400, "invalid_json")

    def test_what_is_no_json_object_is_refused(self):
        for body in (b"", b"[]", b"{", b'{"a":NaN}', b"\xff", b'{"a":1}x'):
            with self.subTest(body=body):
                self.assert_problem(self.server.post("/v1/bakes", body, "application/json"), 400,
                                    "invalid_json")

    def test_a_client_that_leaves_disturbs_nobody(self):
        for data in (b"", b"G", b"POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\n"
                     b"Content-Length: 1000\r\n\r\nhalf"):
            with socket.create_connection(("127.0.0.1", self.server.port)) as connection:
                connection.sendall(data)


class Protocol(ServiceTest):
    def test_connections_stay_open_for_more(self):
        server = self.start()
        connection = server.connect()
        for _ in range(5):
            connection.request("GET", "/version")
            self.assertEqual(json.loads(connection.getresponse().read())["name"], "tetralight")
        first = connection.sock.getsockname()
        connection.request("GET", "/healthz")
        connection.getresponse().read()
        self.assertEqual(connection.sock.getsockname(), first)

    def test_requests_may_follow_each_other_at_once(self):
        server = self.start()
        one = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
        last = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"
        self.assertEqual(server.raw(one * 9 + last).count(b"HTTP/1.1 200 OK"), 10)

    def test_a_client_may_wait_for_its_leave(self):
        server = self.start()
        with socket.create_connection(("127.0.0.1", server.port), timeout=20) as connection:
            connection.sendall(b"POST /v1/volumes/x/query HTTP/1.1\r\nHost: localhost\r\n"
                               b"Content-Length: 2\r\nExpect: 100-continue\r\n\r\n")
            self.assertEqual(connection.recv(100), b"HTTP/1.1 100 Continue\r\n\r\n")
            connection.sendall(b"{}")
            self.assertTrue(connection.recv(65536).startswith(b"HTTP/1.1 404"))

    def test_chunked_bodies_are_taken(self):
        server = self.start()
        answer = server.raw(b"POST /v1/volumes/x/query HTTP/1.1\r\nHost: localhost\r\n"
                            b"Connection: close\r\nTransfer-Encoding: chunked\r\n\r\n"
                            b"1\r\n{\r\n1\r\n}\r\n0\r\n\r\n")
        self.assertTrue(answer.startswith(b"HTTP/1.1 404"))

    def test_paths_and_methods_that_are_not_there(self):
        server = self.start()
        self.assert_problem(server.get("/nothing"), 404, "no_such_path")
        self.assert_problem(server.request("PUT", "/v1/scenes"), 405, "wrong_method")
        self.assert_problem(server.get("/v1/volumes/none"), 404, "not_found")

    def test_head_has_the_length_and_no_body(self):
        server = self.start()
        whole = server.get("/openapi.json")
        head = server.request("HEAD", "/openapi.json")
        self.assertEqual(head.body, b"")
        self.assertEqual(head.headers["Content-Length"], str(len(whole.body)))

    def test_request_ids_come_back_and_are_logged(self):
        server = self.start()
        self.assertEqual(server.get("/healthz", X_Request_Id="abc-1").headers["X-Request-Id"],
                         "abc-1")
        self.assertRegex(server.get("/healthz", X_Request_Id="a b").headers["X-Request-Id"],
                         "^[0-9a-f-]+$")
        server.stop()
        lines = [json.loads(line) for line in open(server.log_path)]
        self.assertIn("abc-1", [line.get("request_id") for line in lines])

    def test_too_many_connections_are_told_so(self):
        server = self.start("--max-connections", "5")
        kept = [server.connect() for _ in range(5)]
        for connection in kept:
            connection.request("GET", "/healthz")
            connection.getresponse().read()
        self.assertTrue(server.raw(b"").startswith(b"HTTP/1.1 503"))
        kept[0].close()
        self.assertTrue(self.eventually(lambda: server.get("/healthz").status == 200))

    def test_metrics_count(self):
        server = self.start()
        server.get("/healthz")
        counted = 'request_duration_seconds_count{route="/healthz",status="2xx"} 1\n'
        # A request counts when its answer is sent, which its client may know first.
        self.assertTrue(self.eventually(lambda: counted in server.get("/metrics").body.decode()))
        for line in server.get("/metrics").body.decode().splitlines():
            self.assertRegex(line, r"^(# (HELP|TYPE) |tetralight_\w+(\{[^}]*\})? [0-9.e+-]+$)")


class Access(ServiceTest):
    def test_a_token_is_asked_for_and_never_logged(self):
        server = self.start(env={"TETRALIGHT_TOKEN": "secret-words"})
        self.assertEqual(server.get("/healthz").status, 200)
        for wrong in ({}, {"Authorization": "Bearer wrong"}, {"Authorization": "Bearer secret-word"},
                      {"Authorization": "Basic secret-words"}, {"Authorization": "Bearer "}):
            for path in ("/v1/scenes", "/metrics", "/nothing"):
                answer = server.request("GET", path, headers=wrong)
                self.assert_problem(answer, 401, "unauthorized")
                self.assertEqual(answer.headers["WWW-Authenticate"], "Bearer")
        right = {"Authorization": "Bearer secret-words"}
        self.assertEqual(server.request("GET", "/v1/scenes", headers=right).status, 200)
        server.stop()
        self.assertNotIn("secret-word", read(server.log_path).decode())

    def test_an_upload_without_the_token_is_not_read(self):
        server = self.start(env={"TETRALIGHT_TOKEN": "secret"})
        answer = server.raw(b"POST /v1/scenes HTTP/1.1\r\nHost: a\r\nContent-Length: 1000000\r\n\r\n")
        self.assertTrue(answer.startswith(b"HTTP/1.1 401"))

    def test_other_addresses_need_a_token(self):
        with self.assertRaisesRegex(RuntimeError, "give a token"):
            self.start("--listen", "0.0.0.0:0")

    def test_a_token_file_is_read(self):
        path = os.path.join(self.folder, "token")
        with open(path, "w") as file:
            file.write("from-a-file\n")
        server = self.start("--token-file", path, "--listen", "0.0.0.0:0")
        self.assertEqual(server.get("/v1/scenes", Authorization="Bearer from-a-file").status, 200)

    def test_names_that_lead_here_by_dns_alone_are_refused(self):
        server = self.start()
        self.assert_problem(server.get("/v1/scenes", Host="evil.example"), 403, "wrong_host")
        for host in ("localhost:80", "127.0.0.1", "[::1]:8080"):
            self.assertEqual(server.get("/v1/scenes", Host=host).status, 200)

    def test_pages_of_other_origins_have_to_be_let_in(self):
        server = self.start("--cors-origin", "https://good.example")
        self.assert_problem(server.get("/v1/scenes", Origin="https://evil.example"), 403,
                            "wrong_origin")
        answer = server.get("/v1/scenes", Origin="https://good.example")
        self.assertEqual(answer.headers["Access-Control-Allow-Origin"], "https://good.example")
        preflight = server.request("OPTIONS", "/v1/bakes", headers={
            "Origin": "https://good.example", "Access-Control-Request-Method": "POST"})
        self.assertEqual(preflight.status, 204)
        self.assertIn("DELETE", preflight.headers["Access-Control-Allow-Methods"])
        self.assertIsNone(server.get("/v1/scenes").headers["Access-Control-Allow-Origin"])


class Paths(ServiceTest):
    def test_no_name_leads_out_of_the_folder(self):
        server = self.start()
        secret = os.path.join(self.folder, "secret.probes")
        open(secret, "w").write("secret")
        for name in ("../secret", "..%2Fsecret", "%2e%2e%2fsecret", "..%5csecret", "/etc/passwd",
                     "....//secret", "a%00b", "../../../../../../etc/passwd"):
            for path in (f"/v1/volumes/{name}", f"/v1/volumes/{name}/file", f"/v1/scenes/{name}/file",
                         f"/v1/volumes/{name}/sections/{name}", f"/v1/bakes/{name}"):
                answer = server.get(path)
                self.assertIn(answer.status, (400, 404), path)
                self.assertNotIn(b"secret.probes", answer.body)
            for kind in ("scene", "volume"):
                answer = server.post("/v1/render", {"scene": name, "volume": name})
                self.assert_problem(answer, 404, "not_found")

    def test_the_viewers_folder_is_served_and_nothing_beside_it(self):
        viewer = os.path.join(self.folder, "viewer")
        os.mkdir(viewer)
        open(os.path.join(viewer, "index.html"), "w").write("<p>hello")
        open(os.path.join(self.folder, "secret"), "w").write("secret")
        os.symlink("../secret", os.path.join(viewer, "link"))
        server = self.start("--viewer", viewer)
        answer = server.get("/")
        self.assertEqual((answer.status, answer.body), (200, b"<p>hello"))
        self.assertIn("default-src 'self'", answer.headers["Content-Security-Policy"])
        for path in ("/link", "/../secret", "/%2e%2e/secret", "/missing.js"):
            self.assert_problem(server.get(path), 404, "no_such_path")
        self.assert_problem(server.get("/v1/nothing"), 404, "no_such_path")


class Ending(ServiceTest):
    def test_sigterm_answers_what_was_begun_and_exits_0(self):
        server = self.start()
        with socket.create_connection(("127.0.0.1", server.port), timeout=20) as connection:
            connection.sendall(b"POST /v1/volumes/x/query HTTP/1.1\r\nHost: localhost\r\n"
                               b"Content-Length: 10\r\n\r\n12345")
            time.sleep(0.3)
            codes = []
            waiting = threading.Thread(target=lambda: codes.append(server.stop()))
            waiting.start()
            time.sleep(0.3)
            connection.sendall(b"67890")
            self.assertTrue(connection.recv(65536).startswith(b"HTTP/1.1 404"))
        waiting.join()
        self.assertEqual(codes, [0])

    def test_idle_connections_do_not_hold_it_up(self):
        server = self.start()
        connection = server.connect()
        connection.request("GET", "/healthz")
        connection.getresponse().read()
        begin = time.monotonic()
        self.assertEqual(server.stop(), 0)
        self.assertLess(time.monotonic() - begin, 10)

    def test_two_servers_do_not_share_a_folder(self):
        self.start()
        with self.assertRaisesRegex(RuntimeError, "another server"):
            self.start()


if __name__ == "__main__":
    unittest.main()
