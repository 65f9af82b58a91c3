# SPDX-License-Identifier: Apache-2.0
"""A fixed number of cases of fuzz_http.py, and all requests that were answered wrongly once."""
import itertools
import os
import unittest

import fuzz_http
import http_answers
from service import ServiceTest

CASES = int(os.environ.get("TETRALIGHT_FUZZ_CASES", "512"))


class Reader(unittest.TestCase):
    """The fuzzer sees what is wrong."""

    HEAD = b"HTTP/1.1 200 OK\r\nContent-Length: 2\r\n"

    def test_answers_that_are_right(self):
        both = self.HEAD + b"\r\nok" + self.HEAD + b"\r\nok"
        self.assertEqual([answer.body for answer in http_answers.read_answers(both)], [b"ok", b"ok"])
        chunked = b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n2\r\nok\r\n0\r\n\r\n"
        self.assertEqual(http_answers.read_answers(chunked)[0].body, b"ok")
        self.assertEqual(len(http_answers.read_answers(self.HEAD + b"\r\n" + self.HEAD + b"\r\nok", True)), 2)

    def test_answers_that_are_wrong(self):
        for data in (b"ok\r\n\r\n", b"HTTP/1.1 2000 OK\r\n\r\n", b"HTTP/1.1 200 OK\r\na: b\n\r\n\r\n",
                     self.HEAD + b"Content-Length: 2\r\n\r\nok", self.HEAD + b"X: \x1b[2J\r\n\r\nok",
                     self.HEAD + b"\r\nokay\r\n\r\n", b"HTTP/1.1 200 OK\r\n\r\nok",
                     self.HEAD + b"Transfer-Encoding: chunked\r\n\r\nok"):
            with self.subTest(data=data), self.assertRaises(http_answers.Malformed):
                http_answers.read_answers(data)
        with self.assertRaises(http_answers.Torn):
            http_answers.read_answers(self.HEAD + b"\r\no")

    def test_problems_that_are_wrong(self):
        headers = {"date": "now", "content-type": "application/problem+json"}
        right = b'{"status": 400, "code": "a", "title": "b", "detail": "c"}'
        fault = lambda status, body: http_answers.fault_of(http_answers.Answer(status, headers, body), {400, 500})
        self.assertIsNone(fault(400, right))
        for status, body in ((418, right), (500, right), (400, b"no"), (400, b'{"status": 400}')):
            self.assertIsNotNone(fault(status, body))


class Fuzz(ServiceTest):
    def setUp(self):
        super().setUp()
        self.fuzzed = fuzz_http.FuzzedServer(self)

    def test_changed_requests_get_good_answers_and_leave_nothing(self):
        count, fault = fuzz_http.run_cases(self.fuzzed, itertools.count(1), lambda done: done >= CASES)
        self.assertIsNone(fault)
        self.assertGreaterEqual(count, CASES)
        self.assertIsNone(self.fuzzed.fault_at_the_end())

    def test_what_was_found_once(self):
        cases = fuzz_http.corpus()
        self.assertGreater(len(cases), 10)
        for name, (pieces, statuses) in cases.items():
            with self.subTest(name=name):
                answers = http_answers.read_answers(self.fuzzed.server.raw(pieces, pause=0.02))
                self.assertEqual([answer.status for answer in answers], statuses)
                for answer in answers:
                    self.assertIsNone(self.fuzzed.fault_of_answer(answer))
        self.assertIsNone(self.fuzzed.fault_at_the_end())


if __name__ == "__main__":
    unittest.main()
