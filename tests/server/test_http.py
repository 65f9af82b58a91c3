# SPDX-License-Identifier: Apache-2.0
"""What is not a good request gets the right answer, and the server goes on."""
import email.utils
import gzip
import http.client
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import threading
import time
import unittest
import urllib.parse

from service import COMMAND, ServiceTest, lattice, read, write_groups
from test_query import binary_query


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

    def test_other_transfer_codings_are_refused_and_the_connection_is_closed(self):
        # The rest of the bytes must not be taken for a second request.
        rest = b"0\r\n\r\nGET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
        for fields in (b"Transfer-Encoding: xchunked", b"Transfer-Encoding: identity",
                       b"Transfer-Encoding: chunked, identity", b"Transfer-Encoding: gzip, chunked",
                       b"Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked",
                       b"Transfer-Encoding: gzip\r\nTransfer-Encoding: chunked",
                       b"Transfer-Encoding: \"chunked\"", b"Transfer-Encoding:",
                       b"Transfer-Encoding: chunked\r\nContent-Length: 5",
                       b"Content-Length: 5\r\nTransfer-Encoding: chunked",
                       b"Transfer-Encoding: xchunked\r\nContent-Length: 5",
                       b"Content-Length: 5\r\nTransfer-Encoding: identity"):
            with self.subTest(fields=fields):
                answer = self.server.raw(b"POST /v1/grid HTTP/1.1\r\nHost: localhost\r\n" + fields +
                                         b"\r\n\r\n" + rest)
                self.assertTrue(answer.startswith(b"HTTP/1.1 400"), answer)
                self.assertEqual(answer.count(b"HTTP/1.1 "), 1)
                self.assertIn(b"Connection: close", answer)

    def test_the_only_transfer_coding_is_chunked_in_any_case_and_in_http_1_1(self):
        for version, coding, status in ((b"1.1", b"chunked", 200), (b"1.1", b"Chunked ", 200),
                                        (b"1.0", b"chunked", 400)):
            self.assertEqual(self.status_of(
                b"GET /healthz HTTP/" + version + b"\r\nHost: localhost\r\nConnection: close\r\n"
                b"Transfer-Encoding: " + coding + b"\r\n\r\n0\r\n\r\n"), status)

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

    CHUNKED = (b"POST /v1/%s HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n")

    def resident_bytes(self):
        with open(f"/proc/{self.server.process.pid}/statm") as file:
            return int(file.read().split()[1]) * 4096

    def test_what_chunks_have_besides_the_body_is_limited(self):
        megabyte = b"a" * (1 << 20)
        endless = {"an extension": [b"5;"] + [megabyte] * 40,
                   "a size": [b"0" * len(megabyte)] * 40,
                   "extensions": [b"1;" + b"a" * 30000 + b"\r\nx\r\n"] * 1400,
                   "one trailer": [b"0\r\nA: "] + [megabyte] * 40,
                   "trailers": [b"0\r\n"] + [b"Trailer: a\r\n" * 100000] * 33}
        before = self.resident_bytes()
        for path in (b"grid", b"groups"):
            for what, pieces in endless.items():
                with self.subTest(path=path, what=what):
                    answer = self.server.raw([self.CHUNKED % path] + pieces)
                    if answer:  # not if the connection was reset before it was read
                        self.assertTrue(answer.startswith(b"HTTP/1.1 431"), answer[:200])
                        self.assertIn(b"Connection: close", answer)
                        self.assertEqual(answer.count(b"HTTP/1.1 "), 1)
        self.assertLess(self.resident_bytes() - before, 32 << 20)

    def test_small_excesses_of_framing_are_told(self):
        for framing in (b"5;" + b"a" * 70000, b"1;" + b"a" * 20000 + b"\r\nx\r\n0\r\n\r\n",
                        b"0\r\nA: " + b"a" * 20000 + b"\r\n\r\n"):
            answer = self.server.raw(self.CHUNKED % b"grid" + framing)
            problem = json.loads(answer.split(b"\r\n\r\n", 1)[1])
            self.assertEqual((problem["status"], problem["code"], problem["field"]),
                             (431, "header_too_large", "body"), framing[:40])

    def test_every_byte_may_have_a_chunk_of_its_own(self):
        body = b'{"positions": [[0, 0, 0]]}' + b" " * 100000
        chunks = b"".join(b"1;a=b\r\n%c\r\n" % byte for byte in body[:1000])
        chunks += b"".join(b"1\r\n%c\r\n" % byte for byte in body[1000:])
        data = self.CHUNKED % b"volumes/none/query" + chunks + b"0\r\nTrailer: a\r\n\r\n"
        answer = self.server.raw(data + b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
        statuses = re.findall(rb"HTTP/1\.1 (\d+)", answer)
        self.assertEqual(statuses, [b"404", b"200"])

    def test_an_empty_line_before_a_request_is_ignored(self):
        get = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
        last = get.replace(b"\r\n\r\n", b"\r\nConnection: close\r\n\r\n")
        for data, statuses in (([b"\r\n" + last], [b"200"]), ([b"\r", b"\n", last], [b"200"]),
                               ([get + b"\r\n", b"\r", b"\n" + last], [b"200", b"400"]),
                               ([get + b"\r\n" + last], [b"200", b"200"]),
                               ([b"\r\n\r\n" + last], [b"400"]), ([b"\rGET" + last], [b"400"]),
                               ([b"\n" + last], [b"400"])):
            with self.subTest(data=data):
                answer = self.server.raw(data, pause=0.05)
                self.assertEqual(re.findall(rb"HTTP/1\.1 (\d+)", answer), statuses)

    def test_a_huge_chunk_is_refused_before_it_comes(self):
        for path in (b"/v1/grid", b"/v1/scenes"):
            answer = self.server.raw(b"POST " + path + b" HTTP/1.1\r\nHost: localhost\r\n"
                                     b"Transfer-Encoding: chunked\r\n\r\nFFFFFFFFFFFFFFF\r\nabc")
            self.assertTrue(answer.startswith(b"HTTP/1.1 413"), answer)

    def test_refusals_of_the_protocol_say_what_is_at_fault(self):
        head = b"POST /v1/grid HTTP/1.1\r\nHost: localhost\r\n"
        for data, code, field, value in (
                (b"nonsense\r\n\r\n", "malformed_request", "head", None),
                (b"GET http HTTP/1.1\r\nHost: a\r\n\r\n", "malformed_request", "target", "http"),
                (b"GET / HTTP/1.1\r\nX: " + b"a" * 20000, "header_too_large", "head",
                 "more than 16384 bytes"),
                (head + b"Content-Length: 5000000000\r\n\r\n", "too_large", "body",
                 "5000000000 bytes"),
                (head + b"Transfer-Encoding: chunked\r\n\r\nzz\r\n", "malformed_request", "body",
                 "0 bytes")):
            with self.subTest(data=data[:60]):
                problem = json.loads(self.server.raw(data).split(b"\r\n\r\n", 1)[1])
                self.assertEqual((problem["code"], problem["field"]), (code, field))
                if value is not None:
                    self.assertEqual(problem["value"], value)
                self.assertTrue(problem["request_id"])

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


class Slow(ServiceTest):
    """Clients that stop in the middle."""

    def setUp(self):
        super().setUp()
        self.server = self.start("--transfer-seconds", "1", "--header-seconds", "1")

    def aborted(self, status):
        return [line for line in self.server.logged()
                if line.get("aborted") and line.get("status") == status]

    def test_a_body_that_stops_is_answered_with_408(self):
        for path in ("/v1/scenes", "/v1/bakes", "/v1/volumes/none/query"):
            with self.subTest(path=path):
                answer = self.server.raw(f"POST {path} HTTP/1.1\r\nHost: localhost\r\n"
                                         "Content-Length: 1000\r\n\r\n12345".encode())
                self.assertTrue(answer.startswith(b"HTTP/1.1 408"), answer)
                problem = json.loads(answer.split(b"\r\n\r\n", 1)[1])
                self.assertEqual((problem["code"], problem["field"], problem["value"]),
                                 ("too_slow", "body", "5 bytes"))
        self.assertTrue(self.eventually(
            lambda: [line["status"] for line in self.server.logged()
                     if line.get("message") == "request"] == [408] * 3))

    def test_a_head_that_stops_is_answered_with_408(self):
        answer = self.server.raw(b"GET /healthz HTTP/1.1\r\nHost: loc")
        self.assertTrue(answer.startswith(b"HTTP/1.1 408"), answer)

    def ask_for_much(self):
        """A connection on which eleven megabytes are to come."""
        groups = os.path.join(self.folder, "groups.json")
        write_groups(groups, lattice(2))
        self.command("tetrahedralize", groups, "-o", groups + ".probes")
        self.upload(self.server, "volumes", groups + ".probes", "much")
        body = binary_query([[0, 0, 0]] * 100000)
        connection = socket.socket()
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 65536)
        connection.settimeout(30)
        connection.connect(("127.0.0.1", self.server.port))
        connection.sendall(b"POST /v1/volumes/much/query HTTP/1.1\r\nHost: localhost\r\n"
                           b"Connection: close\r\nContent-Type: application/octet-stream\r\n"
                           b"Content-Length: %d\r\n\r\n" % len(body) + body)
        return connection, 16 + 108 * 100000

    def test_who_stops_reading_is_cut_off_and_logged_so(self):
        connection, size = self.ask_for_much()
        with connection:
            self.assertTrue(self.eventually(lambda: self.aborted(200)))
        self.assertLess(self.aborted(200)[0]["sent"], size)

    def test_who_reads_slowly_gets_all(self):
        connection, size = self.ask_for_much()
        received = 0
        with connection:
            # Longer than the seconds for 64 KiB, and always faster than those.
            while piece := connection.recv(1 << 20):
                received += len(piece)
                time.sleep(0.02)
        self.assertGreater(received, size)
        self.assertEqual(self.aborted(200), [])

    def test_an_upload_that_is_left_is_logged_as_such(self):
        with socket.create_connection(("127.0.0.1", self.server.port)) as connection:
            connection.sendall(b"POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\n"
                               b"Content-Length: 1000\r\n\r\nhalf")
        self.assertTrue(self.eventually(lambda: self.aborted(499)))
        self.assertEqual(os.listdir(os.path.join(self.data, "work")), [])


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
        answer = server.request("PUT", "/v1/scenes")
        self.assert_problem(answer, 405, "wrong_method")
        self.assertEqual(answer.headers["Allow"], "POST, GET, HEAD")
        self.assert_problem(server.get("/v1/volumes/none"), 404, "not_found")

    def test_escapes_in_the_words_of_a_path_are_refused(self):
        server = self.start()
        for path in ("/metric%73", "/%6detrics", "/v1%2Fscenes", "/v1/scene%73", "/v%31/bakes",
                     "/%2Fmetrics", "/v1/volumes/x/quer%79", "//metrics", "/./metrics",
                     "/healthz/../metrics"):
            with self.subTest(path=path):
                self.assert_problem(server.get(path), 404, "no_such_path")

    def test_an_encoded_slash_is_part_of_a_name(self):
        server = self.start()
        for path in ("/v1/scenes/a%2Ffile", "/v1/scenes/a%2ffile", "/v1/bakes%2Fx/events"):
            answer = server.get(path)
            code = "not_found" if "scenes" in path else "no_such_path"
            self.assert_problem(answer, 404, code)
        self.assert_problem(server.post("/v1/scenes?name=a%2Fb", b"glTF"), 400, "invalid_value")

    def test_names_may_be_escaped(self):
        server = self.start()
        groups = json.dumps({"groups": [{"name": "g", "positions": lattice(2)}]}).encode()
        self.assertEqual(server.post("/v1/groups?name=m%C3%BC%20x", groups).status, 201)
        self.assertEqual(server.get("/v1/groups/m%C3%BC%20%78").status, 200)

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
        answer = server.get("/healthz")
        problem = self.assert_problem(answer, 503, "too_many_connections")
        self.assertEqual(problem["value"], "5")
        self.assertTrue(self.eventually(lambda: problem["request_id"] in [
            line.get("request_id") for line in server.logged()]))
        kept[0].close()
        self.assertTrue(self.eventually(lambda: server.get("/healthz").status == 200))

    def test_http_1_1_needs_one_host(self):
        server = self.start()
        for hosts, status in ((b"", 400), (b"Host: a\r\nHost: b\r\n", 400), (b"Host: a\r\n", 200)):
            answer = server.raw(b"GET /healthz HTTP/1.1\r\n" + hosts + b"Connection: close\r\n\r\n")
            self.assertTrue(answer.startswith(b"HTTP/1.1 %d" % status), answer)
        self.assertTrue(server.raw(b"GET /readyz HTTP/1.0\r\n\r\n").startswith(b"HTTP/1.1 200"))

    def test_parameters_that_nobody_knows_are_refused(self):
        server = self.start()
        for path, code, field, value in (
                ("/v1/scenes?nam=x", "unknown_parameter", "nam", "x"),
                ("/v1/scenes?name=a&name=b", "repeated_parameter", "name", "b"),
                ("/healthz?x", "unknown_parameter", "x", None)):
            problem = self.assert_problem(server.get(path), 400, code)
            self.assertEqual((problem["field"], problem.get("value")), (field, value))
        self.assertEqual(server.get("/v1/scenes?name=a&limit=3").status, 200)

    def test_encoded_bodies_are_refused(self):
        server = self.start()
        for encoding, status in (("gzip", 415), ("identity", 404)):
            answer = server.request("POST", "/v1/volumes/x/query", b"{}",
                                    {"Content-Encoding": encoding})
            self.assertEqual(answer.status, status, answer.body)

    def test_duplicate_members_are_refused_by_name(self):
        server = self.start()
        for path, body, key in (
                ("/v1/bakes", '{"scene": "a", "scene": "b"}', "scene"),
                ("/v1/bakes", '{"scene": "a", "\\u0073cene": "b"}', "scene"),
                ("/v1/relight", '{"volume": "v", "weights": {"sun": 1, "sky": 1, "sun": 0}}', "sun"),
                ("/v1/volumes/x/query", '{"positions": [[0, 0, 0]], "positions": []}', "positions"),
                ("/v1/grid", '{"a": [{"b": 1}, [{"b": 1, "c": ":", "c": 2}]]}', "c")):
            with self.subTest(body=body):
                answer = server.post(path, body.encode(), "application/json")
                if path.endswith("query"):  # the volume is looked up first
                    self.assert_problem(answer, 404, "not_found")
                    continue
                problem = self.assert_problem(answer, 422, "duplicate_member")
                self.assertEqual(problem["field"], key)
                self.assertIn(f'"{key}"', problem["detail"])

    def test_equal_keys_of_different_objects_are_no_duplicates(self):
        server = self.start()
        body = rb'{"a:\":": {"b": ":"}, "b": [{"b": "\\"}, {"b": {"b": 1}}], "c": "\":\""}'
        self.assert_problem(server.post("/v1/bakes", body, "application/json"), 400,
                            "unknown_member")

    def test_names_of_blanks_and_with_hidden_characters_are_refused(self):
        server = self.start()
        groups = json.dumps({"groups": [{"name": "g", "positions": lattice(2)}]}).encode()
        hidden = [0x85, 0x9b, 0xad, 0x61c, 0x200b, 0x200d, 0x200f, 0x2028, 0x202a, 0x202e, 0x2060,
                  0x2066, 0x2069, 0xfeff, 0xe0041]
        names = [" ", "   ", " a", "a ", "\u00a0", "a\u3000", "\u2003a", "\u2800"]
        names += [f"a{chr(code)}b" for code in hidden]
        for name in names:
            with self.subTest(name=ascii(name)):
                path = "/v1/groups?name=" + urllib.parse.quote(name)
                problem = self.assert_problem(server.post(path, groups), 400, "invalid_value")
                self.assertEqual((problem["field"], problem["value"]), ("name", name))
        for name in ("a b", "\u00e9t\u00e9", "\u5149", "\U0001f4a1", "\u05d0\u05d1"):
            with self.subTest(name=ascii(name)):
                path = "/v1/groups?name=" + urllib.parse.quote(name)
                self.assertIn(server.post(path, groups).status, (200, 201))

    def test_each_answer_has_the_date(self):
        server = self.start("--header-seconds", "1")
        for answer in (server.get("/healthz"), server.get("/nothing"),
                       server.request("HEAD", "/openapi.json")):
            date = email.utils.parsedate_to_datetime(answer.headers["Date"])
            self.assertRegex(answer.headers["Date"], r"^\w{3}, \d\d \w{3} \d{4} [\d:]{8} GMT$")
            self.assertLess(abs(time.time() - date.timestamp()), 60)
        self.assertIn(b"\r\nDate: ", server.raw(b"nonsense\r\n\r\n"))

    def test_names_of_dots_are_refused(self):
        server = self.start()
        for name in (".", ".."):
            problem = self.assert_problem(server.post("/v1/groups?name=" + name, b"{}"), 400,
                                          "invalid_value")
            self.assertEqual((problem["field"], problem["value"]), ("name", name))

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
        server = self.start(env={"TETRALIGHT_TOKEN": "many-secret-words"})
        self.assertEqual(server.get("/healthz").status, 200)
        for wrong in ({}, {"Authorization": "Bearer wrong"}, {"Authorization": "Bearer many-secret-word"},
                      {"Authorization": "Basic many-secret-words"}, {"Authorization": "Bearer "},
                      {"Authorization": "Bearer many-secret-wordsmany-secret-words"},
                      {"Authorization": "Bearer many-secret-words2"}):
            for path in ("/v1/scenes", "/metrics", "/v1/nothing"):
                answer = server.request("GET", path, headers=wrong)
                self.assert_problem(answer, 401, "unauthorized")
                self.assertEqual(answer.headers["WWW-Authenticate"], "Bearer")
        for scheme in ("Bearer", "bearer"):
            right = {"Authorization": scheme + " many-secret-words"}
            self.assertEqual(server.request("GET", "/v1/scenes", headers=right).status, 200)
        server.stop()
        self.assertNotIn("secret-word", read(server.log_path).decode())

    def test_an_upload_without_the_token_is_not_read(self):
        server = self.start(env={"TETRALIGHT_TOKEN": "many-secret-words"})
        answer = server.raw(b"POST /v1/scenes HTTP/1.1\r\nHost: a\r\nContent-Length: 1000000\r\n\r\n")
        self.assertTrue(answer.startswith(b"HTTP/1.1 401"))

    def test_other_addresses_need_a_token(self):
        with self.assertRaisesRegex(RuntimeError, "needs a token"):
            self.start("--listen", "0.0.0.0:0")

    def test_a_token_file_is_read(self):
        path = os.path.join(self.folder, "token")
        with open(path, "w") as file:
            file.write("token-from-a-file\n")
        server = self.start("--token-file", path, "--listen", "0.0.0.0:0")
        self.assertEqual(server.get("/v1/scenes", Authorization="Bearer token-from-a-file").status, 200)

    def write_token(self, name, token):
        """A file with a token, replaced as a whole."""
        path = os.path.join(self.folder, name)
        with open(path + ".new", "w") as file:
            file.write(token + "\n")
        os.replace(path + ".new", path)
        return path

    def status_with(self, server, method, path, token):
        return server.request(method, path, headers={"Authorization": "Bearer " + token}).status

    def test_a_token_for_reading_changes_nothing(self):
        server = self.start("--token-file", self.write_token("admin", "all-that-there-is"),
                            "--read-token-file", self.write_token("reader", "a-part-of-what-is"))
        for method, path, admin, reader in (
                ("GET", "/v1/scenes", 200, 200), ("GET", "/metrics", 200, 200),
                ("POST", "/v1/volumes/x/query", 404, 404), ("DELETE", "/v1/scenes/x", 404, 403),
                ("POST", "/v1/scenes", 400, 403), ("POST", "/v1/bakes", 400, 403)):
            with self.subTest(method=method, path=path):
                self.assertEqual(self.status_with(server, method, path, "all-that-there-is"), admin)
                self.assertEqual(self.status_with(server, method, path, "a-part-of-what-is"), reader)
                self.assertEqual(self.status_with(server, method, path, "neither"), 401)
        answer = server.request("DELETE", "/v1/scenes/x", headers={"Authorization": "Bearer a-part-of-what-is"})
        self.assert_problem(answer, 403, "read_only_token")

    @staticmethod
    def token(name, number):
        return f"{name}-{number}-of-16-characters"

    def start_with_tokens(self, admin, reader):
        return self.start("--token-file", self.write_token("admin", admin),
                          "--read-token-file", self.write_token("reader", reader))

    def assert_token(self, server, token, status=200):
        self.assertTrue(self.eventually(
            lambda: self.status_with(server, "GET", "/v1/scenes", token) == status))

    def test_tokens_are_replaced_while_the_server_runs(self):
        server = self.start_with_tokens(self.token("admin", 1), self.token("reader", 1))
        for name in ("admin", "reader"):
            self.assert_token(server, self.token(name, 1))
            self.write_token(name, self.token(name, 2))
            self.assert_token(server, self.token(name, 2))
            self.assert_token(server, self.token(name, 1), 401)
        for count, token in enumerate(("", "two words of a token", "short")):  # mistakes lock nobody out
            self.write_token("admin", token)
            self.assertTrue(self.eventually(lambda: self.failed_reads(server) > count))
            self.assert_token(server, self.token("admin", 2))
        os.remove(os.path.join(self.folder, "admin"))
        self.assertTrue(self.eventually(lambda: self.failed_reads(server) > 3))
        self.assert_token(server, self.token("admin", 2))
        server.stop()
        self.assertNotRegex(read(server.log_path).decode(), "admin-[12]-of|reader-[12]-of|two words")

    def failed_reads(self, server):
        """How often a token could not be read so far; asks, as files are read for requests."""
        server.get("/v1/scenes")
        return sum("could not be read" in line["message"] for line in server.logged())

    def equal_tokens(self, server):
        """How often the log said that both files hold one token."""
        server.get("/v1/scenes")
        return sum("hold one token" in line["message"] for line in server.logged())

    def test_a_token_for_reading_never_becomes_one_for_everything(self):
        admin, reader = self.token("admin", 1), self.token("reader", 1)
        server = self.start_with_tokens(admin, reader)
        self.write_token("reader", admin)
        self.assertTrue(self.eventually(lambda: self.equal_tokens(server) == 1))
        self.assert_token(server, reader)  # the last one
        self.assertEqual(self.status_with(server, "DELETE", "/v1/scenes/x", reader), 403)
        self.write_token("admin", reader)  # they have changed places now
        self.assertTrue(self.eventually(
            lambda: self.status_with(server, "DELETE", "/v1/scenes/x", reader) == 404))
        self.assertEqual(self.status_with(server, "DELETE", "/v1/scenes/x", admin), 403)
        self.assertEqual(self.equal_tokens(server), 1)

    def test_equal_tokens_are_refused(self):
        with self.assertRaisesRegex(RuntimeError, "holds the token that may change everything"):
            self.start_with_tokens(self.token("admin", 1), self.token("admin", 1))
        with self.assertRaisesRegex(RuntimeError, "holds the token that may change everything"):
            self.start("--read-token-file", self.write_token("reader", self.token("admin", 1)),
                       env={"TETRALIGHT_TOKEN": self.token("admin", 1)})

    def test_short_tokens_are_refused(self):
        path = self.write_token("short", "x" * 15)
        for option in ("--token-file", "--read-token-file"):
            with self.assertRaisesRegex(RuntimeError, "at least 16 characters"):
                self.start(option, path)
        with self.assertRaisesRegex(RuntimeError, "at least 16 characters"):
            self.start(env={"TETRALIGHT_TOKEN": "x" * 15})
        self.start("--token-file", self.write_token("short", "x" * 16))

    def test_a_token_for_reading_alone_is_warned_of(self):
        server = self.start("--read-token-file", self.write_token("reader", self.token("reader", 1)))
        self.assertTrue(self.eventually(lambda: any(
            "no token lets clients change" in line["message"] for line in server.logged())))

    def test_names_that_lead_here_by_dns_alone_are_refused(self):
        server = self.start()
        self.assert_problem(server.get("/v1/scenes", Host="evil.example"), 403, "wrong_host")
        for host in ("localhost:80", "127.0.0.1", "[::1]:8080"):
            self.assertEqual(server.get("/v1/scenes", Host=host).status, 200)

    def test_whether_it_lives_is_told_whatever_the_host(self):
        server = self.start()
        for path in ("/healthz", "/readyz", "/version"):
            self.assertEqual(server.get(path, Host="10.0.0.1").status, 200)

    def test_a_proxy_may_call_by_a_name_that_is_allowed(self):
        server = self.start("--allowed-host", "light.example.com", "--allowed-host", "b.example")
        for host in ("light.example.com", "Light.Example.com:443", "b.example", "localhost"):
            self.assertEqual(server.get("/v1/scenes", Host=host).status, 200)
        self.assert_problem(server.get("/v1/scenes", Host="example.com"), 403, "wrong_host")

    def test_tokens_that_no_header_could_hold_are_refused(self):
        path = os.path.join(self.folder, "token")
        for token in ("two words", "two\nlines", "\x01", "m\u00fc"):
            with open(path, "w") as file:
                file.write(token)
            with self.assertRaisesRegex(RuntimeError, "token: a token is letters") as caught:
                self.start("--token-file", path)
            self.assertNotIn(token, str(caught.exception))

    def test_options_that_make_no_sense_are_refused(self):
        for option, value in (("--threads", "1000000"), ("--threads", "-1"), ("--drain-seconds", "nan"),
                              ("--header-seconds", "0"), ("--transfer-seconds", "nan"),
                              ("--max-connections", "0"), ("--max-body", "0"), ("--workers", "0"),
                              ("--idle-seconds", "1e300"), ("--viewer", "/nonexist"), ("--viewer", "/proc"),
                              ("--cors-origin", "good.example"), ("--allowed-host", "a:80"),
                              ("--cors-origin", "https://good.example/")):
            with self.subTest(option=option, value=value):
                done = subprocess.run([COMMAND, "serve", "--data", self.data, option, value],
                                      capture_output=True, text=True, timeout=60)
                self.assertEqual(done.returncode, 2)
                self.assertIn(option, done.stderr)
                self.assertLess(len(done.stderr), 300)

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
        head = server.request("HEAD", "/index.html")
        self.assertEqual((head.status, head.headers["Content-Length"], head.body), (200, "8", b""))
        os.mkdir(os.path.join(viewer, "assets"))
        open(os.path.join(viewer, "assets", "a.js"), "w").write("a")
        self.assertEqual(server.get("/assets/a.js").body, b"a")
        for path in ("/link", "/../secret", "/%2e%2e/secret", "/missing.js", "/assets%2Fa.js"):
            self.assert_problem(server.get(path), 404, "no_such_path")
        self.assert_problem(server.get("/v1/nothing"), 404, "no_such_path")

    def viewer_server(self, files):
        """A server of a page with these files: bytes by their names."""
        viewer = os.path.join(self.folder, "viewer")
        os.makedirs(os.path.join(viewer, "assets"))
        for name, content in files.items():
            with open(os.path.join(viewer, name), "wb") as file:
                file.write(content)
        return self.start("--viewer", viewer)

    def test_files_of_the_viewer_are_sent_again_only_if_they_changed(self):
        server = self.viewer_server({"index.html": b"<p>one"})
        tag = server.get("/").headers["ETag"]
        for known in (tag, "W/" + tag, '"other", ' + tag, "*"):
            answer = server.get("/", If_None_Match=known)
            self.assertEqual((answer.status, answer.body), (304, b""), known)
            self.assertEqual(answer.headers["ETag"], tag)
        self.assertEqual(server.get("/", If_None_Match='"other"').status, 200)
        self.assertEqual(server.get("/", If_None_Match=tag.strip('"')).status, 200)
        with open(os.path.join(self.folder, "viewer", "index.html"), "wb") as file:
            file.write(b"<p>and two")
        answer = server.get("/", If_None_Match=tag)
        self.assertEqual((answer.status, answer.body), (200, b"<p>and two"))
        self.assertNotEqual(answer.headers["ETag"], tag)

    def test_only_files_with_a_hash_in_their_names_are_kept_for_ever(self):
        names = {"assets/index-DkD0Xn2v.js": True, "assets/a-b_-4Xc9d.css": True,
                 "index.html": False, "assets/plain.js": False, "assets/my-longname.js": False,
                 "other-DkD0Xn2v.js": False}
        server = self.viewer_server({name: b"x" for name in [*names, "index.html"]})
        for name, is_immutable in names.items():
            expected = "public, max-age=31536000, immutable" if is_immutable else "no-cache"
            self.assertEqual(server.get("/" + name).headers["Cache-Control"], expected, name)

    def test_compressed_files_go_to_clients_that_accept_them(self):
        text = b"let a = 1;\n" * 1000
        server = self.viewer_server({"index.html": b"x", "assets/a.js": text})
        packed = os.path.join(self.folder, "viewer", "assets", "a.js.gz")
        with open(packed, "wb") as file:
            file.write(gzip.compress(text))
        plain = server.get("/assets/a.js")
        self.assertEqual((plain.body, plain.headers["Content-Encoding"]), (text, None))
        for accepted in ("gzip", "deflate, gzip;q=0.5", "br, *", "GZIP"):
            answer = server.get("/assets/a.js", Accept_Encoding=accepted)
            self.assertEqual(answer.headers["Content-Encoding"], "gzip", accepted)
            self.assertEqual(gzip.decompress(answer.body), text)
            self.assertEqual(answer.headers["Vary"], "Accept-Encoding")
            self.assertNotEqual(answer.headers["ETag"], plain.headers["ETag"])
            self.assertEqual(answer.headers["Content-Type"], "text/javascript; charset=utf-8")
        for refused in ("gzip;q=0", "identity", "br", "*;q=0", "*, gzip;q=0.0"):
            answer = server.get("/assets/a.js", Accept_Encoding=refused)
            self.assertEqual((answer.body, answer.headers["Content-Encoding"]), (text, None))
        os.utime(packed, (1, 1))  # older than the file
        self.assertEqual(server.get("/assets/a.js", Accept_Encoding="gzip").body, text)

    def test_a_program_finds_the_viewer_beside_it_or_says_how_to_get_it(self):
        program = os.path.join(self.folder, "prefix", "bin", "tetralight")
        os.makedirs(os.path.dirname(program))
        shutil.copy(COMMAND, program)
        server = self.start(program=program)
        answer = server.get("/")
        self.assertEqual((answer.status, answer.headers["Content-Type"]),
                         (200, "text/plain; charset=utf-8"))
        self.assertIn(b"--viewer", answer.body)
        self.assert_problem(server.get("/missing.js"), 404, "no_such_path")
        server.stop()
        # A built one comes before an installed one.
        for folder, page in (("share/tetralight/viewer", "installed"), ("viewer", "built")):
            folder = os.path.join(self.folder, "prefix", folder)
            os.makedirs(folder)
            with open(os.path.join(folder, "index.html"), "w") as file:
                file.write(page)
            server = self.start(program=program)
            self.assertEqual(server.get("/").body.decode(), page)
            server.stop()


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

    def test_the_end_is_announced_while_connections_are_still_taken(self):
        server = self.start("--drain-notice-seconds", "3")
        kept = server.connect()
        kept.request("GET", "/healthz")
        kept.getresponse().read()
        server.process.send_signal(signal.SIGTERM)
        self.assertTrue(self.eventually(lambda: server.get("/readyz").status == 503))
        self.assertEqual(server.get("/v1/scenes").status, 200)
        kept.request("GET", "/healthz")
        self.assertEqual(kept.getresponse().headers["Connection"], "close")
        self.assertEqual(server.process.wait(timeout=60), 0)
        with self.assertRaises(ConnectionRefusedError):
            server.get("/healthz")

    def test_what_takes_too_long_is_ended_with_the_server(self):
        server = self.start("--drain-seconds", "1", "--workers", "1")
        order = self.order_of_hours(server)
        askers = [threading.Thread(target=self.ask_and_lose, args=(server, order))
                  for _ in range(4)]
        for asker in askers:
            asker.start()
        self.assertTrue(self.eventually(server.children))
        self.assertEqual(server.stop(60), 0)
        for asker in askers:
            asker.join()

    def ask_and_lose(self, server, order):
        try:
            server.post("/v1/render", order)
        except (ConnectionError, http.client.HTTPException):
            pass

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
