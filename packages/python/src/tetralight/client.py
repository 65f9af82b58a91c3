# SPDX-License-Identifier: Apache-2.0
"""Bakes and queries with the service `tetralight serve`.

    client = tetralight.Client("http://127.0.0.1:8080")
    bake = client.bake(Path("court.glb"), name="court", samples=256)
    volume = bake.wait()                          # a tetralight.Volume
    light = client.query("court", positions)      # computed by the service
"""
from __future__ import annotations

import hashlib
import os
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, Sequence, Union

import numpy

import tetralight
from tetralight._arguments import choice, number, numbers, path_text, wrong_shape
from tetralight._http import BYTES, Service, quoted
from tetralight._positions import Positions, checked_positions, write_groups
from tetralight._progress import Progress, counted, reporter
from tetralight._query_bytes import read_answer, write_request
from tetralight._settings import check_names, json_value
from tetralight.errors import Cancelled, Corrupt, Error, Unavailable

if TYPE_CHECKING:
    from tetralight import Light, Volume

Source = Union["os.PathLike[str]", bytes]

KINDS = dict.fromkeys(("scenes", "skies", "groups", "volumes", "lightmaps", "reflections"))
POSITIONS_AT_ONCE = 250_000
MOST_SECONDS_BETWEEN_LOOKS = 0.5


class Client:
    """A service. `token` as it is started with; `timeout`: seconds without an answer until a request fails;
    `retry_seconds`: how long requests that may be repeated are tried again while the service is away or busy.

    May be used by several threads."""

    def __init__(self, url: str, token: str | None = None, timeout: float = 60, retry_seconds: float = 10) -> None:
        self._service = Service(url, token, timeout, retry_seconds)
        self._members: dict[str, frozenset[str]] = {}

    @property
    def url(self) -> str:
        return self._service.url

    def __repr__(self) -> str:
        return f"Client({self.url!r})"

    def scenes(self) -> list[dict[str, Any]]:
        """All scenes: `id`, `names`, `bytes`..."""
        return self.files("scenes")

    def volumes(self) -> list[dict[str, Any]]:
        """All probe volumes."""
        return self.files("volumes")

    def bakes(self) -> list[Bake]:
        """All bakes, the newest first."""
        return [Bake(self, facts) for facts in self.files("bakes")]

    def files(self, kind: str) -> list[dict[str, Any]]:
        """All files of a kind, such as "lightmaps"."""
        found: list[dict[str, Any]] = []
        after: str | None = ""
        while after is not None:
            page = self._service.get(f"/v1/{quoted(kind)}" + (f"?after={quoted(after)}" if after else ""))
            found += page[kind]
            after = page["next"]
        return found

    def upload(self, kind: str, source: Source, name: str | None = None) -> str:
        """Stores a file or bytes as one of the "scenes", "skies", "groups", "volumes", "lightmaps" or "reflections":
        its id. `name` moves from the file that had it."""
        choice("kind", kind, KINDS)
        path = f"/v1/{kind}" + (f"?name={quoted(name)}" if name else "")
        # The same bytes are one file: an upload that is repeated changes nothing.
        if isinstance(source, (bytes, bytearray, memoryview)):
            return str(self._service.json("POST", path, bytes(source), BYTES, True)["id"])
        try:
            with open(path_text("source", source, "a path or bytes"), "rb") as file:
                return str(self._service.json("POST", path, file, BYTES, True)["id"])
        except OSError as reason:
            if isinstance(reason, Error):
                raise
            raise Unavailable(f"{os.fspath(source)} cannot be read: {reason.strerror or reason}") from reason

    def download(self, volume: str, kind: str = "volumes") -> bytes:
        """The bytes of a stored file, by id or name."""
        data = self._service.send("GET", f"/v1/{quoted(kind)}/{quoted(volume)}/file")
        if len(volume) == 64 and hashlib.sha256(data).hexdigest() != volume:
            raise Corrupt(f"{self.url}: the bytes of {volume} do not have this SHA-256")
        return data

    def open(self, volume: str) -> Volume:
        """Downloads a volume and opens it."""
        return tetralight.open(self.download(volume))

    def delete(self, kind: str, name: str) -> None:
        """Removes a name, or by its id a file with all its names."""
        self._service.send("DELETE", f"/v1/{quoted(kind)}/{quoted(name)}")

    def bake(
        self,
        scene: str | Source,
        positions: Positions | None = None,
        groups: Mapping[str, Positions] | Sequence[str | Source] | None = None,
        **settings: Any,
    ) -> Bake:
        """Orders a bake. `scene` is an id or a name; a path object, bytes, or text that ends in .glb is uploaded,
        with the name of the order. `positions` and `groups` are those of `tetralight.bake`; texts in `groups` are ids
        or names. Other members, such as `samples`, `name`, `priority` or `batch`: `BakeOrder` of /openapi.json."""
        if positions is not None and groups is not None:
            raise TypeError("bake() accepts positions or groups, not both")
        check_names("bake", settings, self._members_of("BakeOrder") - {"scene", "groups"})
        order = {name: value if name == "sky" else json_value(name, value) for name, value in settings.items()}
        if positions is not None:
            groups = {"positions": checked_positions("positions", positions)}
            order.setdefault("only_given_groups", True)
        name = order.get("name")
        if isinstance(order.get("sky"), os.PathLike):
            order["sky"] = self.upload("skies", order["sky"])
        order["scene"] = self._stored("scenes", scene, name if isinstance(name, str) else None)
        if groups is not None:
            order["groups"] = self._stored_groups(groups)
        return Bake(self, self._service.post("/v1/bakes", json_value("bake", order)))

    def query(
        self,
        volume: str,
        positions: Positions,
        *,
        format: str = "coefficients",
        outside: str = "extrapolate",
        fade_distance: float | None = None,
        walls: str = "hide",
    ) -> Light:
        """The light at positions (..., 3) in a stored volume, computed by the service. As `Volume.query`; without
        `fade_distance` ambient light fades over the service's default."""
        array = numbers("positions", positions, "numbers of the shape (…, 3)")
        if array.ndim < 1 or array.shape[-1] != 3:
            raise wrong_shape("positions", "(…, 3)", array.shape)
        rows = checked_positions("positions", array.reshape(-1, 3))
        path = f"/v1/volumes/{quoted(volume)}/query"
        if len(rows) > POSITIONS_AT_ONCE:  # a name may move between two requests
            path = f"/v1/volumes/{self._service.get(f'/v1/volumes/{quoted(volume)}')['id']}/query"
        parts = []
        for begin in range(0, max(len(rows), 1), POSITIONS_AT_ONCE):
            request = write_request(rows[begin : begin + POSITIONS_AT_ONCE], begin, format, outside, fade_distance,
                                    walls)
            parts.append(read_answer(self._service.send("POST", path, request, BYTES, True), format))
        sh, occlusion, cells = (numpy.concatenate(arrays) for arrays in zip(*parts))
        shape = array.shape[:-1]
        return tetralight.Light(sh.reshape(shape + sh.shape[1:]), format, occlusion.reshape(shape + (4,)),
                                cells.reshape(shape))

    def _members_of(self, schema: str) -> frozenset[str]:
        if schema not in self._members:
            api = self._service.get("/openapi.json")
            self._members[schema] = frozenset(api["components"]["schemas"][schema]["properties"])
        return self._members[schema]

    def _stored(self, kind: str, source: str | Source, name: str | None = None) -> str:
        """The id or name of a stored file; others are uploaded."""
        if isinstance(source, str) and kind == "scenes" and source.lower().endswith((".glb", ".gltf")):
            source = Path(source)
        return source if isinstance(source, str) else self.upload(kind, source, name)

    def _stored_groups(self, groups: Mapping[str, Positions] | Sequence[str | Source]) -> list[str]:
        if isinstance(groups, (str, bytes, os.PathLike)):
            groups = [groups]
        if not isinstance(groups, Mapping):
            return [self._stored("groups", group) for group in groups]
        with tempfile.TemporaryDirectory(prefix="tetralight_") as folder:
            path = Path(folder) / "groups.json"
            write_groups(path, groups)
            return [self.upload("groups", path)]


class Bake:
    """A bake of the service. The service runs it to its end, even without this object; `Client.bakes` lists it."""

    def __init__(self, client: Client, facts: dict[str, Any]) -> None:
        self._client = client
        self.id = str(facts["id"])
        #: What the service last answered about it.
        self.facts = facts

    def __repr__(self) -> str:
        return f"<Bake {self.id}: {self.state}>"

    @property
    def state(self) -> str:
        """"queued", "running", "done", "failed" or "cancelled", at the last look."""
        return str(self.facts["state"])

    @property
    def is_over(self) -> bool:
        return self.state not in ("queued", "running")

    def look(self) -> Bake:
        """Asks the service for its state and progress."""
        self.facts = self._client._service.get(f"/v1/bakes/{quoted(self.id)}")
        return self

    def wait(self, progress: Progress = None, timeout: float | None = None) -> Volume:
        """Waits for the bake, and opens its volume. KeyboardInterrupt ends the wait, not the bake: see `cancel`.
        Raises TimeoutError after `timeout` seconds."""
        end = None if timeout is None else time.monotonic() + number("timeout", timeout)
        pause = 0.05
        show = reporter(progress)
        try:
            while not self.look().is_over:
                show(*self._progress())
                if end is not None and time.monotonic() + pause > end:
                    raise TimeoutError(f"{self._client.url}: the bake {self.id} is not over after {timeout} s")
                time.sleep(pause)
                pause = min(1.5 * pause, MOST_SECONDS_BETWEEN_LOOKS)
            show(*self._progress())
        finally:
            show.close()
        return self.volume()

    def volume(self) -> Volume:
        """Opens the volume of a bake that is done."""
        if self.state == "done":
            return self._client.open(str(self.facts["volume"]))
        if not self.is_over:
            raise Unavailable(f"{self._client.url}: the bake {self.id} is not over: {self.state}", "not_over")
        reason = self.facts.get("error") or f"the bake was {self.state}"
        message = f"{self._client.url}: bake {self.id}: {reason}"
        raise Cancelled(message) if self.state == "cancelled" else Error(message, "bake_failed")

    def cancel(self) -> None:
        """Ends the bake; does nothing if it is over."""
        try:
            self._client._service.send("POST", f"/v1/bakes/{quoted(self.id)}/cancel", may_repeat=True)
        except Error as error:
            if error.code != "is_over":
                raise
        self.look()

    def _progress(self) -> tuple[float | None, str]:
        if self.state == "queued":
            return None, "waiting for other bakes"
        return counted("baking probes", self.facts.get("probes_done") or 0, self.facts.get("probe_count") or 0,
                       self.facts.get("seconds_left"))
