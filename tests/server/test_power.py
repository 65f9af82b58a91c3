# SPDX-License-Identifier: Apache-2.0
"""Power is cut at any moment: the server starts on whatever the disk has, and all that it acknowledged
is there.

A seeded sample; TETRALIGHT_NIGHTLY=1 cuts after every change."""
import json
import os
import random
import shutil
import tempfile
import unittest

from faults import SHIM, Faults
from power import Change, Disk, read_log
from service import BINARY, COURTYARD, ServiceTest, lattice, read, write_groups

IS_NIGHTLY = os.environ.get("TETRALIGHT_NIGHTLY", "") == "1"
SAMPLE = int(os.environ.get("TETRALIGHT_POWER_CUTS", "16"))
SEED = int(os.environ.get("TETRALIGHT_SEED", "0"))
ORDER = {"scene": "court", "groups": ["few"], "only_given_groups": True, "samples": 1, "bounces": 1,
         "name": "baked"}


class History:
    """What clients know: between a request and its answer, the old or the new state; then the new."""

    def __init__(self, faults):
        self.faults, self.steps = faults, []

    def step(self, change, key, value=None, before=None):
        """`value(answer)` is the state of `key` after the change; `before` is that of its first."""
        begin = self.faults.recorded()
        answer = change()
        self.steps.append((begin, self.faults.recorded(), key, before,
                           value(answer) if value else None))
        return answer

    def possible(self, position):
        states = {}
        for begin, end, key, before, value in self.steps:
            if end <= position:
                states[key] = {value}
            elif begin <= position:
                states.setdefault(key, {before}).add(value)
        return states


class DiskModel(unittest.TestCase):
    """The disk of the tests forgets what was not synced."""

    def setUp(self):
        self.disk = Disk("/data")

    def follow(self, kind, path, other="", data=b"", inode=1, offset=0):
        self.disk.follow(Change(kind, inode, path, other, offset, data, 0))

    def left(self, choose):
        with tempfile.TemporaryDirectory() as folder:
            self.disk.crash(folder + "/data", choose)
            return {name: read(f"{folder}/data/{name}") for name in os.listdir(folder + "/data")}

    def test_bytes_need_a_sync_of_the_file_and_names_one_of_the_folder(self):
        self.follow("create", "/data/new")
        self.follow("write", "/data/new", data=b"bytes")
        self.assertEqual(self.left(lambda n: 0), {})
        self.assertEqual(self.left(lambda n: n), {"new": b"bytes"})
        self.follow("sync", "/data", inode=7)
        self.assertEqual(self.left(lambda n: 0), {"new": b""})
        self.follow("sync", "/data/new")
        self.follow("rename", "/data/new", "/data/old")
        self.assertEqual(self.left(lambda n: 0), {"new": b"bytes"})
        self.assertEqual(self.left(lambda n: n), {"old": b"bytes"})

    def test_the_last_write_may_be_torn(self):
        self.follow("create", "/data/file")
        self.follow("sync", "/data", inode=7)
        self.follow("write", "/data/file", data=bytes(512) + b"x" * 1024)
        pieces = iter([0, 0, 2])  # names, whole writes, sectors
        self.assertEqual(self.left(lambda n: next(pieces)), {"file": bytes(512) + b"x" * 512})


@unittest.skipUnless(SHIM, "sanitizers do not go with preloaded libraries")
class PowerCuts(ServiceTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.data)
        self.groups = os.path.join(self.folder, "groups.json")
        write_groups(self.groups, lattice(2))
        self.volumes = []
        for count in (2, 3):
            write_groups(os.path.join(self.folder, "more.json"), lattice(count))
            self.volumes.append(os.path.join(self.folder, f"{count}.probes"))
            self.command("tetrahedralize", "more.json", "-o", self.volumes[-1])
        self.faults = Faults(self.data, self.folder, with_log=True)
        self.history = History(self.faults)

    def record(self):
        """A server's day."""
        server = self.start(env=self.faults.env)
        id_of = lambda answer: answer.json()["id"]

        def post(kind, path, name):
            return self.history.step(
                lambda: server.post(f"/v1/{kind}?name={name}", read(path), BINARY), (kind, name), id_of)

        post("scenes", COURTYARD, "court")
        post("groups", self.groups, "few")
        first = id_of(post("volumes", self.volumes[0], "level"))
        bake = id_of(self.history.step(lambda: server.post("/v1/bakes", ORDER), ("bakes", "one"), id_of))
        second = id_of(post("volumes", self.volumes[1], "level"))
        self.history.step(lambda: server.request("DELETE", "/v1/volumes/" + first),
                          ("volumes", first), before=first)
        self.history.step(lambda: server.wait_for(bake), ("volumes", "baked"), lambda a: a["volume"])
        self.history.step(lambda: server.request("PATCH", "/v1/volumes/" + second, {"name": "hall"}),
                          ("volumes", "hall"), id_of)
        self.history.step(lambda: server.request("DELETE", "/v1/bakes/" + bake),
                          ("bakes", "one"), before=bake)
        self.assertEqual(server.stop(), 0)
        server = self.start(env=self.faults.env)
        self.history.step(lambda: server.post("/v1/relight", {"volume": "hall", "name": "dusk"}),
                          ("volumes", "dusk"), id_of)
        self.assertEqual(server.stop(), 0)
        return read_log(self.faults.log)

    def state_of(self, server, key):
        kind, name = key
        if kind == "bakes":
            bakes = server.get("/v1/bakes").json()["bakes"]
            return bakes[0]["id"] if bakes else None
        answer = server.get(f"/v1/{kind}/{name}")
        return answer.json()["id"] if answer.status == 200 else None

    def check(self, data, position):
        server = self.start(data=data)
        try:
            self.check_states(server, position)
        finally:
            server.kill()

    def check_states(self, server, position):
        for key, possible in self.history.possible(position).items():
            found = self.state_of(server, key)
            if key == ("volumes", "baked") and None in possible:
                continue
            self.assertIn(found, possible, key)
            if found is None:
                continue
            if key[0] == "volumes":
                answer = server.post(f"/v1/volumes/{found}/query", {"positions": [[0.5, 0.5, 0.5]]})
                self.assertEqual(answer.status, 200, answer.body)
            elif key[0] == "bakes":
                bake = server.wait_for(found)
                self.assertEqual(bake["state"], "done", bake)
            else:
                self.assertEqual(server.get(f"/v1/{key[0]}/{found}/file").status, 200)

    @staticmethod
    def choices(generator):
        """Nothing that is not safe is left, or all of it, or some."""
        return generator.choice((lambda n: 0, lambda n: n, lambda n: generator.randint(0, n),
                                 lambda n: generator.randint(0, n)))

    def test_what_was_acknowledged_survives(self):
        changes = self.record()
        generator = random.Random(SEED)
        points = range(len(changes))
        chosen = set(points if IS_NIGHTLY else generator.sample(points, min(SAMPLE, len(points))))
        disk, states = Disk(self.data), 0
        for point, change in enumerate(changes):
            disk.follow(change)
            if point not in chosen:
                continue
            for _ in range(4 if IS_NIGHTLY else 1):
                states += 1
                data = os.path.join(self.folder, f"left{states}")
                disk.crash(data, self.choices(generator))
                with self.subTest(point=point, of=len(changes), change=change.kind, path=change.path):
                    self.check(data, change.end)
                shutil.rmtree(data, ignore_errors=True)
        print(json.dumps({"power_cuts": states, "changes": len(changes)}))

    def test_the_replay_of_all_changes_is_the_folder(self):
        disk = Disk(self.data)
        for change in self.record():
            disk.follow(change)
        copy = os.path.join(self.folder, "copy")
        disk.crash(copy, lambda n: n)
        for folder, _, names in os.walk(self.data):
            for name in names:
                path = os.path.join(folder, name)
                if name in ("reserve", "tetralight.db-shm"):
                    continue
                relative = os.path.relpath(path, self.data)
                with self.subTest(path=relative):
                    self.assertEqual(read(os.path.join(copy, relative)), read(path))


if __name__ == "__main__":
    unittest.main()
