# SPDX-License-Identifier: Apache-2.0
"""Requests to `tetralight serve`, with the standard library alone."""
from __future__ import annotations

import http.client
import json
import ssl
import time
import urllib.parse
from typing import Any, BinaryIO, Union

from tetralight._arguments import number
from tetralight._settings import bad_value
from tetralight.errors import BadValue, Corrupt, Error, NotFound, Unavailable

Body = Union[bytes, BinaryIO, None]
JSON = "application/json"
BYTES = "application/octet-stream"

MOST_SECONDS_BETWEEN_TRIES = 2.0
MOST_SECONDS = 1e9  # sockets accept no more
_BAD_VALUE = (400, 409, 412, 413, 422)
_UNAVAILABLE = (408, 429, 502, 503, 504, 507)


class Service:
    """An address, a token, and how long to wait and to try again."""

    def __init__(self, url: str, token: str | None, timeout: float, retry_seconds: float) -> None:
        parts = _checked(url)
        self.url = f"{parts.scheme}://{parts.netloc}{parts.path.rstrip('/')}"
        self._scheme, self._host, self._port = parts.scheme, parts.hostname or "", parts.port
        self._prefix = parts.path.rstrip("/")
        self._headers = {}
        if not isinstance(token, (str, type(None))):
            raise BadValue("token: expected a text", "invalid_argument")
        if token:
            if not (token.isascii() and token.isprintable() and " " not in token):
                raise BadValue("token: it has characters that no token has", "invalid_argument")
            self._headers["Authorization"] = "Bearer " + token
        self.timeout = number("timeout", timeout, 1e-3, MOST_SECONDS, "seconds > 0")
        self.retry_seconds = number("retry_seconds", retry_seconds, 0, MOST_SECONDS, "seconds >= 0")

    def get(self, path: str) -> dict[str, Any]:
        return self.json("GET", path)

    def post(self, path: str, order: dict[str, Any]) -> dict[str, Any]:
        return self.json("POST", path, json.dumps(order).encode(), JSON)

    def json(
        self, method: str, path: str, body: Body = None, kind: str | None = None, may_repeat: bool = False
    ) -> dict[str, Any]:
        answer = self.send(method, path, body, kind, may_repeat)
        try:
            value = json.loads(answer or b"{}")
        except ValueError:
            value = None
        if not isinstance(value, dict):
            raise Error(f"{self.url} does not answer as Tetralight does", "bad_answer")
        return value

    def send(
        self, method: str, path: str, body: Body = None, kind: str | None = None, may_repeat: bool = False
    ) -> bytes:
        """The bytes of an answer. A request is sent again after a lost connection if it changes nothing or
        `may_repeat`, and after 503 or a refused connection in any case: the service has not begun it."""
        may_repeat = may_repeat or method == "GET"
        end = time.monotonic() + self.retry_seconds
        pause = 0.1
        while True:
            try:
                return self._send_once(method, path, body, kind)
            except Unavailable as error:
                status = (error.report or {}).get("status")
                is_untouched = status == 503 or isinstance(error.__cause__, ConnectionRefusedError)
                is_lost = status is None and may_repeat
                wait = max(pause, float((error.report or {}).get("retry_after", 0)))
                if not (is_untouched or is_lost) or time.monotonic() + wait > end:
                    raise
            time.sleep(wait)
            pause = min(2 * pause, MOST_SECONDS_BETWEEN_TRIES)

    def _connect(self) -> http.client.HTTPConnection:
        if self._scheme == "https":
            return http.client.HTTPSConnection(
                self._host, self._port, timeout=self.timeout, context=ssl.create_default_context())
        return http.client.HTTPConnection(self._host, self._port, timeout=self.timeout)

    def _send_once(self, method: str, path: str, body: Body, kind: str | None) -> bytes:
        headers = dict(self._headers)
        if kind is not None:
            headers["Content-Type"] = kind
        if body is not None and not isinstance(body, bytes):
            body.seek(0, 2)
            headers["Content-Length"] = str(body.tell())
            body.seek(0)
        connection = self._connect()
        try:
            try:
                connection.request(method, self._prefix + path, body, headers)
            except (BrokenPipeError, ConnectionResetError):
                pass  # the service may have refused the body before its end
            response = connection.getresponse()
            answer = response.read()
        except (OSError, http.client.HTTPException) as reason:
            raise Unavailable(f"{self.url} cannot be reached, or its answer ended early: {_text(reason)}",
                              "unavailable") from reason
        finally:
            connection.close()
        if response.status >= 300:
            raise self._problem(response, answer)
        return answer

    def _problem(self, response: http.client.HTTPResponse, answer: bytes) -> Error:
        try:
            problem = json.loads(answer)
        except ValueError:
            problem = None
        if not isinstance(problem, dict):
            problem = {}
        status = response.status
        said = problem.get("detail") or f"status {status} {response.reason}"
        error = _class_of(status)(f"{self.url}: {said}", str(problem.get("code", "bad_answer")))
        error.field, error.value = str(problem.get("field", "")), str(problem.get("value", ""))
        wait = response.getheader("Retry-After", "")
        error.report = {**problem, "status": status, "retry_after": int(wait) if wait.isdigit() else 0}
        return error


def quoted(name: str) -> str:
    """A part of an address: a kind, an id or a name."""
    if not isinstance(name, str) or not name:
        raise bad_value("name", name, "is not an id or a name")
    return urllib.parse.quote(name, safe="")


def _class_of(status: int) -> type[Error]:
    if status == 404:
        return NotFound
    if status == 410:
        return Corrupt
    if status in _BAD_VALUE:
        return BadValue
    return Unavailable if status in _UNAVAILABLE else Error


def _text(reason: Exception) -> str:
    return getattr(reason, "strerror", None) or str(reason) or type(reason).__name__


def _checked(url: str) -> urllib.parse.SplitResult:
    what = "is not an address such as http://127.0.0.1:8080"
    if not isinstance(url, str):
        raise bad_value("url", url, what)
    try:
        parts = urllib.parse.urlsplit(url)
        parts.port  # raises ValueError if it is not a number
    except ValueError:
        raise bad_value("url", url, what) from None
    is_plain = not (parts.username or parts.password or parts.query or parts.fragment)
    if parts.scheme not in ("http", "https") or not parts.hostname or not is_plain:
        raise bad_value("url", url, what)
    return parts
