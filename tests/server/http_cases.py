# SPDX-License-Identifier: Apache-2.0
"""Sound requests, and random changes of them. The same seed makes the same changes."""
import json
import random
import re
import struct

from test_query import binary_query

HOST = b"localhost"
METHODS = (b"GET", b"HEAD", b"POST", b"PUT", b"PATCH", b"DELETE", b"OPTIONS", b"TRACE", b"CONNECT",
           b"get", b"G\xc3\x89T", b"", b"A" * 100)
VERSIONS = (b"HTTP/1.1", b"HTTP/1.0", b"HTTP/2.0", b"HTTP/1.12", b"http/1.1", b"HTTP/1.1 x", b"")
TARGET_PARTS = (b"%2F", b"%2e%2e", b"%73", b"%00", b"%", b"%zz", b"//", b"/../", b"?", b"#", b";", b"\\",
                b"?limit=1", b"?limit=-1", b"?limit=99999999999999999999", b"?after=\xff", b"?name=%FF",
                b"&&==", b"\x01", b"*", b"http://localhost/v1/volumes", b"a" * 3000, b" ")
FIELDS = (b"Transfer-Encoding: chunked", b"Transfer-Encoding: xchunked", b"Transfer-Encoding: identity",
          b"Transfer-Encoding : chunked", b"Transfer-Encoding:\tchunked", b"Transfer-Encoding: chunked, chunked",
          b"Content-Length: 0", b"Content-Length: 5", b"Content-Length: +5", b"Content-Length: -1",
          b"Content-Length: 5, 5", b"Content-Length: 0x5", b"Content-Length: 18446744073709551616",
          b"Content-Length: 99999999", b"Content-Length:", b"Expect: 100-continue", b"Expect: x",
          b"Connection: close", b"Connection: keep-alive", b"Connection: upgrade", b"Upgrade: h2c",
          b"Content-Encoding: gzip", b"Accept-Encoding: gzip;q=1e9", b"Range: bytes=0-", b"Range: bytes=5-1",
          b"Range: bytes=-99999999999999999999", b"Range: bytes=0-0,1-1,2-2", b"If-None-Match: *",
          b"If-None-Match: \"", b"If-Match: \"a\"", b"Origin: http://example.com", b"Origin: null",
          b"Authorization: Bearer x", b"Authorization: Bearer", b"Host: example.com", b"Host:",
          b"Content-Type: application/octet-stream", b"Content-Type: multipart/form-data; boundary=x",
          b"Content-Type: text/plain", b"X-Request-Id: \xff\x01", b"X-Request-Id: a\tb",
          b"X: " + b"a" * 9000, b" folded", b"no colon", b"\x00: a", b": empty", b"A\r: b")
NUMBERS = ("0", "-0", "-1", "1e308", "1e400", "1e-400", "4294967296", "18446744073709551616", "0.5",
           "NaN", "Infinity", "01", "1.", "9" * 400)
WORDS = ("null", "true", "{}", "[]", '""', '"\\u0000"', '"\\ud800"', '"\xff"', '"\\u001b[2J"', '"../../x"',
         "[" * 300, '{"a":1,"a":2}', ",", ":", '"positions":1,', '"\\u202e"', "\x00", "\ufeff", '"' + "x" * 300 + '"')
FLOATS = (0.0, -0.0, 1e30, 3e38, -3e38, 1e-40, float("inf"), float("nan"))


def request(method, target, body=b"", content_type=None, fields=()):
    if isinstance(body, (dict, list)):
        body, content_type = json.dumps(body).encode(), "application/json"
    lines = [method.encode() + b" " + target.encode() + b" HTTP/1.1", b"Host: " + HOST, *fields]
    if content_type:
        lines.append(b"Content-Type: " + content_type.encode())
    if body or method in ("POST", "PATCH"):
        lines.append(b"Content-Length: %d" % len(body))
    return b"\r\n".join(lines) + b"\r\n\r\n" + body


def sound_requests(files):
    """`files` has the bytes of small uploads by their kinds. Names are those of `FuzzedServer`."""
    positions = [[0.5, 1.0, 0.5], [3, 1, 2], [-40, 5, 1e4]]
    query = "/v1/volumes/level/query"
    binary = "application/octet-stream"
    get = [request("GET", target) for target in (
        "/healthz", "/readyz", "/version", "/openapi.json", "/metrics", "/v1/volumes", "/v1/volumes?limit=1",
        "/v1/volumes/level", "/v1/volumes/level/file", "/v1/volumes/level/sections/positions",
        "/v1/lightmaps", "/v1/lightmaps/floor", "/v1/lightmaps/floor/file",
        "/v1/lightmaps/floor/sections/irradiance", "/v1/reflections", "/v1/reflections/room",
        "/v1/reflections/room/file", "/v1/scenes/court", "/v1/groups?name=few", "/v1/groups/few/file", "/v1/skies", "/v1/bakes",
        "/v1/bakes?limit=2", "/v1/bakes/none/events", "/v1/quarantine", "/", "/assets/none.js")]
    post = [request("POST", query, {"positions": positions}),
            request("POST", query, {"positions": positions, "outside": "clamp", "fade": 2, "cells": True}),
            request("POST", query, binary_query(positions), binary),
            request("POST", query, binary_query(positions, sh=3, wants=3, outside=2, fade=1.5), binary),
            *(request("POST", f"/v1/{kind}?name=fuzzed", data, binary) for kind, data in files.items()),
            request("POST", "/v1/tetrahedralize", {"groups": ["few"], "name": "again"}),
            request("POST", "/v1/volumes/level/validate"),
            request("POST", "/v1/relight", {"volume": "level", "name": "dusk"}),
            request("POST", "/v1/lightmaps/floor/validate"),
            request("POST", "/v1/reflections/room/validate"),
            request("POST", "/v1/reflection-bakes", {"scene": "court", "samples": "x"}),
            request("POST", "/v1/lightmaps/floor/relight", {"weights": {"sky": 0.5}, "name": "dusk"}),
            request("POST", "/v1/grid", {"scene": "court", "spacing": 8, "name": "grid"}),
            request("POST", "/v1/render", {"scene": "court", "volume": "level", "width": 8, "height": 8}),
            request("POST", "/v1/lppv", {"volume": "level", "min": [0, 0, 0], "max": [1, 1, 1]}),
            request("POST", "/v1/bakes", {"scene": "court", "samples": "x"}),
            request("POST", "/v1/bakes/none/cancel"),
            request("POST", "/v1/quarantine/none/restore")]
    change = [request("PATCH", "/v1/groups/few", {"name": "few"}), request("DELETE", "/v1/volumes/fuzzed"),
              request("DELETE", "/v1/lightmaps/fuzzed"), request("DELETE", "/v1/reflections/fuzzed"),
              request("DELETE", "/v1/bakes/none"), request("DELETE", "/v1/quarantine/none"), request("HEAD", "/v1/volumes/level/file"),
              request("OPTIONS", query, fields=[b"Origin: http://example.com",
                                                b"Access-Control-Request-Method: POST"]),
              request("GET", "/v1/volumes/level/file", fields=[b"Range: bytes=0-9"])]
    # Programs are slow to start: most cases are about HTTP.
    slow = re.compile(rb"POST /v1/(?!volumes/level/query|bakes/|quarantine)")
    quick = [one for one in get + post + change if not slow.match(one)]
    return quick * 6 + get + post + change


class Case:
    """Pieces to send, the pause between them, and how the sending ends."""

    ENDS = ("wait", "wait", "wait", "half", "reset")

    def __init__(self, seed, sound):
        self.random = random.Random(seed)
        requests = [self.changed(self.random.choice(sound))
                    for _ in range(self.random.choice((1, 1, 1, 1, 2, 3)))]
        data = b"".join(requests)
        self.count = len(requests)
        self.leaves = self.random.random() < 0.9  # once it has that many answers
        self.end = self.random.choice(self.ENDS)
        if self.random.random() < 0.1:
            data = data[:self.random.randrange(len(data) + 1)]
        self.pieces, self.pause = [data], 0.0
        if self.random.random() < 0.15:
            cuts = sorted(self.random.randrange(len(data) + 1) for _ in range(self.random.randrange(1, 6)))
            self.pieces = [data[a:b] for a, b in zip([0] + cuts, cuts + [len(data)])]
            self.pause = self.random.choice((0.0, 0.01, 0.2))

    @property
    def data(self):
        return b"".join(self.pieces)

    def changed(self, data):
        head, _, body = data.partition(b"\r\n\r\n")
        lines = head.split(b"\r\n")
        is_framed = True
        for _ in range(self.random.choice((0, 1, 1, 2, 3))):
            change = self.random.choice((self.change_line, self.change_target, self.change_fields,
                                         self.change_body, self.change_body))
            if change == self.change_body:
                body = self.change_body(body)
                is_framed = is_framed and self.random.random() < 0.1
            else:
                change(lines)
        if not is_framed:
            lines, body = self.framed(lines, body)
        data = b"\r\n".join(lines) + b"\r\n\r\n" + body
        return self.flipped(data) if self.random.random() < 0.1 else data

    def change_line(self, lines):
        words = lines[0].split(b" ")
        if self.random.random() < 0.6:
            words[0] = self.random.choice(METHODS)
        else:
            words[-1] = self.random.choice(VERSIONS)
        lines[0] = b" ".join(words)

    def change_target(self, lines):
        words = lines[0].split(b" ")
        target = words[1] if len(words) > 1 else b"/"
        place = self.random.randrange(len(target) + 1)
        if self.random.random() < 0.3 and place < len(target):
            target = target[:place] + b"%%%02x" % target[place] + target[place + 1:]
        else:
            target = target[:place] + self.random.choice(TARGET_PARTS) + target[place:]
        lines[0] = b" ".join([words[0], target] + words[2:])

    def change_fields(self, lines):
        place = self.random.randrange(1, len(lines) + 1)
        choice = self.random.random()
        if choice < 0.6:
            lines.insert(place, self.random.choice(FIELDS))
        elif place < len(lines):
            if choice < 0.75:
                lines.insert(place, lines[place])
            elif choice < 0.9:
                del lines[place]
            else:
                lines[place] = lines[place].swapcase()

    def change_body(self, body):
        if body[:1] in (b"{", b"["):
            return self.change_json(body)
        if not body:
            return self.random.choice(WORDS).encode("utf-8", "surrogatepass")
        body = bytearray(body)
        place = self.random.randrange(len(body))
        choice = self.random.random()
        if choice < 0.3:
            body[place] ^= 1 << self.random.randrange(8)
        elif choice < 0.6:
            body[place:place + 4] = struct.pack("<f", self.random.choice(FLOATS))
        elif choice < 0.8:
            body[place:place + 4] = struct.pack("<I", self.random.choice((0, 1, 2**31, 2**32 - 1)))
        else:
            del body[place:]
        return bytes(body)

    def change_json(self, body):
        tokens = re.findall(rb'"[^"]*"|[-+.\w]+|.', body, re.S)
        place = self.random.randrange(len(tokens))
        new = self.random.choice(NUMBERS + WORDS).encode("utf-8", "surrogatepass")
        choice = self.random.random()
        if choice < 0.6:
            tokens[place] = new
        elif choice < 0.75:
            tokens.insert(place, new)
        elif choice < 0.9:
            del tokens[place]
        else:
            tokens[place:place] = tokens[place:place + self.random.randrange(1, 6)]
        return b"".join(tokens)

    def framed(self, lines, body):
        """The length of the changed body, or chunks, some of them broken."""
        lines = [line for line in lines if not line.lower().startswith(b"content-length:")]
        if self.random.random() < 0.7:
            return lines + [b"Content-Length: %d" % len(body)], body
        chunks, rest = b"", body
        while rest:
            size = self.random.randrange(1, len(rest) + 1)
            chunks += b"%x%s\r\n%s\r\n" % (size, self.random.choice((b"", b"", b";a=b", b" ")), rest[:size])
            rest = rest[size:]
        chunks += self.random.choice((b"0\r\n\r\n", b"0\r\n\r\n", b"0\r\nTrailer: a\r\n\r\n", b"0\r\n", b"zz\r\n",
                                      b"FFFFFFFFFFFFFFFFF\r\n", b"-1\r\n\r\n", b"0\n\n"))
        return lines + [b"Transfer-Encoding: chunked"], chunks

    def flipped(self, data):
        data = bytearray(data)
        for _ in range(self.random.randrange(1, 4)):
            data[self.random.randrange(len(data))] = self.random.choice(b"\x00\r\n \t\x7f\xff:A")
        return bytes(data)
