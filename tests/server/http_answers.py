# SPDX-License-Identifier: Apache-2.0
"""Reads what a server sent, and accepts well-formed HTTP/1.1 answers only (RFC 9112)."""
import json
import re

STATUS_LINE = re.compile(rb"HTTP/1\.1 ([1-5]\d\d) [\t -~\x80-\xff]*\Z")
FIELD = re.compile(rb"([!#$%&'*+.^_`|~0-9A-Za-z-]+):[ \t]*([\t -~\x80-\xff]*?)[ \t]*\Z")
CHUNK = re.compile(rb"([0-9A-Fa-f]+)\r\n")


class Malformed(Exception):
    pass


class Torn(Exception):
    """The bytes end within an answer."""


class Answer:
    def __init__(self, status, headers, body=b""):
        self.status, self.headers, self.body = status, headers, body

    @property
    def is_stream(self):
        return self.headers.get("content-type") == "text/event-stream"


def read_head(data, begin):
    end = data.find(b"\r\n\r\n", begin)
    if end < 0:
        raise Torn
    lines = data[begin:end].split(b"\r\n")
    status = STATUS_LINE.match(lines[0])
    if not status:
        raise Malformed(f"the status line is {lines[0][:200]!r}")
    headers = {}
    for line in lines[1:]:
        field = FIELD.match(line)
        if not field:
            raise Malformed(f"a header is {line[:200]!r}")
        name = field[1].decode().lower()
        if name in headers and name in ("content-length", "transfer-encoding", "content-type", "date"):
            raise Malformed(f"the header {name} is there twice")
        headers[name] = field[2].decode("latin-1")
    return Answer(int(status[1]), headers), end + 4


def read_chunks(data, begin):
    body = b""
    while True:
        chunk = CHUNK.match(data, begin)
        if not chunk:
            if len(data) - begin < 20 and b"\r\n" not in data[begin:]:
                raise Torn
            raise Malformed(f"a chunk begins with {data[begin:begin + 20]!r}")
        size, begin = int(chunk[1], 16), chunk.end()
        if len(data) < begin + size + 2:
            raise Torn
        if data[begin + size:begin + size + 2] != b"\r\n":
            raise Malformed("a chunk does not end with a line break")
        body += data[begin:begin + size]
        begin += size + 2
        if size == 0:
            return body, begin


def read_body(answer, data, begin, is_head):
    """Where the answer ends."""
    length, coding = (answer.headers.get(name) for name in ("content-length", "transfer-encoding"))
    if is_head or answer.status < 200 or answer.status in (204, 304):
        return begin
    if coding is not None:
        if coding != "chunked" or length is not None:
            raise Malformed(f"the framing is {coding!r} and {length!r}")
        answer.body, end = read_chunks(data, begin)
        return end
    if length is None:
        if answer.headers.get("connection", "").lower() != "close":
            raise Malformed("the answer has no length, and the connection stays")
        answer.body = data[begin:]
        return len(data)
    if not re.fullmatch(r"\d+", length):
        raise Malformed(f"the length is {length!r}")
    if len(data) < begin + int(length):
        raise Torn
    answer.body = data[begin:begin + int(length)]
    return begin + int(length)


def read_answers(data, may_be_head=False):
    """All answers in `data`. Answers to HEAD have no body, and which of the requests were HEAD in the
    eyes of the server is not known: with `may_be_head` any reading that fits is right."""
    return _read_from(data, 0, may_be_head)


def _read_from(data, begin, may_be_head):
    if begin == len(data):
        return []
    problem = None
    for is_head in (False, True) if may_be_head else (False,):
        answer, end = read_head(data, begin)
        try:
            end = read_body(answer, data, end, is_head)
            return [answer] + _read_from(data, end, may_be_head)
        except (Malformed, Torn) as error:
            problem = problem or error
    raise problem


def fault_of(answer, statuses):
    """What is wrong with an answer besides its framing; nothing if it is right."""
    if answer.status not in statuses:
        return f"status {answer.status}: {answer.body[:300]!r}"
    if "date" not in answer.headers:
        return f"status {answer.status} without Date"
    if answer.status < 400 or not answer.body:
        return None
    if answer.headers.get("content-type") == "text/plain; charset=utf-8":
        return None if answer.status == 503 else f"status {answer.status} as plain text"
    if answer.headers.get("content-type") != "application/problem+json":
        return f"status {answer.status} of type {answer.headers.get('content-type')}"
    try:
        problem = json.loads(answer.body.decode("utf-8"))
    except ValueError as error:
        return f"a problem is no JSON ({error}): {answer.body[:300]!r}"
    for member, kind in (("status", int), ("code", str), ("title", str), ("detail", str)):
        if not isinstance(problem.get(member), kind) or problem[member] == "":
            return f"a problem without {member}: {problem}"
    if problem["status"] != answer.status:
        return f"status {answer.status} and in the problem {problem['status']}"
    if answer.status == 504 and problem["code"] != "too_slow":
        return f"504 {problem['code']}"
    return None
