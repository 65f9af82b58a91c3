# SPDX-License-Identifier: Apache-2.0
"""A client of the HTTP service `tetralight serve`. Needs no Blender."""
import http.client
import json
import shutil
import urllib.error
import urllib.parse
import urllib.request

SECONDS = 60  # without an answer, until a request fails
LOOPBACK = ("localhost", "127.0.0.1", "::1")


class ServiceError(Exception):
    """A request failed. `may_pass` is true if the same request may succeed later."""

    def __init__(self, message, may_pass=False):
        super().__init__(message)
        self.may_pass = may_pass


class _Answer(dict):
    """An object of an answer. A member that is not there is an error of the service."""

    def __missing__(self, name):
        raise ServiceError(f'the service did not answer as Tetralight does: its answer has no "{name}"')


class _StayHere(urllib.request.HTTPRedirectHandler):
    """Follows no redirection: it would send the token to another server."""

    def redirect_request(self, request, file, code, message, headers, url):
        return None


class Service:
    def __init__(self, address, token=""):
        """Raises ServiceError if the address or the token cannot be used. Sends nothing."""
        self.address = _checked_address(address)
        self._headers = {}
        if token:
            if not (token.isascii() and token.isprintable() and " " not in token):
                raise ServiceError("the token has characters that no token has, such as blanks or line breaks")
            self._headers["Authorization"] = "Bearer " + token
        handlers = [_StayHere()]
        if urllib.parse.urlsplit(self.address).hostname in LOOPBACK:
            handlers.append(urllib.request.ProxyHandler({}))
        self._opener = urllib.request.build_opener(*handlers)

    def get(self, path):
        return self._json("GET", path)

    def post(self, path, order=None):
        body = None if order is None else json.dumps(order).encode()
        return self._json("POST", path, body, {"Content-Type": "application/json"})

    def upload(self, path, file_path, kind):
        """Posts the bytes of a file."""
        headers = {"Content-Type": kind, "Content-Length": str(file_path.stat().st_size)}
        with file_path.open("rb") as file:
            return self._json("POST", path, file, headers)

    def download(self, path, file_path):
        """Writes the bytes of an answer to a file."""
        with self._answer("GET", path) as answer, file_path.open("wb") as file:
            try:
                shutil.copyfileobj(answer, file)
            except (OSError, http.client.HTTPException) as error:
                raise ServiceError(f"{self.address}: the download of {path} ended early: {error}", True) from error

    def _json(self, method, path, body=None, headers=None):
        with self._answer(method, path, body, headers) as answer:
            try:
                return _Answer(json.load(answer))
            except (ValueError, TypeError) as error:
                raise ServiceError(f"{self.address} does not answer as Tetralight does") from error
            except (OSError, http.client.HTTPException) as error:
                raise ServiceError(f"{self.address}: the answer ended early: {error}", True) from error

    def _answer(self, method, path, body=None, headers=None):
        headers = {**self._headers, **(headers or {})}
        request = urllib.request.Request(self.address + path, body, headers, method=method)
        try:
            return self._opener.open(request, timeout=SECONDS)
        except urllib.error.HTTPError as error:
            with error:
                raise ServiceError(*self._refusal(error)) from error
        except (OSError, http.client.HTTPException, ValueError) as error:
            reason = getattr(error, "reason", error)
            raise ServiceError(f"{self.address} cannot be reached: {reason}", True) from error

    def _refusal(self, error):
        """What an answer with a status of 300 or more says, and whether the request may succeed later."""
        if error.code == 401:
            return f"{self.address} refuses the token: set it in the preferences of the add-on", False
        if error.code < 400:
            return f"{self.address} redirects to another address: enter that one in the preferences", False
        try:
            problem = json.load(error)
            text = problem["detail"]
        except (ValueError, KeyError, TypeError, OSError, http.client.HTTPException):
            text = f"status {error.code} {error.reason}"
        return f"{self.address}: {text}", error.code == 503


def _checked_address(address):
    """The address without a slash at its end."""
    try:
        parts = urllib.parse.urlsplit(address.strip())
        parts.port  # raises ValueError if it is not a number
    except ValueError as error:
        raise ServiceError(f'the address of the service "{address}" is wrong: {error}') from error
    is_plain = not (parts.username or parts.password or parts.query or parts.fragment)
    if parts.scheme not in ("http", "https") or not parts.hostname or not is_plain:
        example = "an address such as http://127.0.0.1:8080"
        raise ServiceError(f'the address of the service "{address}" is not {example}')
    return f"{parts.scheme}://{parts.netloc}{parts.path.rstrip('/')}"
