# SPDX-License-Identifier: Apache-2.0
"""One system call fails, in every place and in every way: nothing is lost, wrong, stuck or left behind.

A seeded sample; TETRALIGHT_NIGHTLY=1 tries every place."""
import contextlib
import json
import os
import random
import shutil
import unittest

from faults import CALLS, ERRORS, SHIM, Faults, error_name
from service import BINARY, COURTYARD, ServiceTest, lattice, read, write_groups

IS_NIGHTLY = os.environ.get("TETRALIGHT_NIGHTLY", "") == "1"
SAMPLE = int(os.environ.get("TETRALIGHT_FAULTS", "8"))
SEED = int(os.environ.get("TETRALIGHT_SEED", "0"))
QUERY = {"positions": [[0.5, 1.0, 0.5], [0.1, 0.2, 0.3]]}
# What a server may say that lacks something: not that the data or the request are wrong.
EXCUSES = (500, 503, 507)


class Script:
    """Start, upload, bake, query, relight, delete, restart. Each step is repeated until it succeeds,
    which it must once the fault is over."""

    TRIES = 4

    def __init__(self, test, data, faults):
        self.test, self.data, self.faults = test, data, faults
        self.server = None
        self.answers = {}
        self.excuses = []
        self.descriptors = 0

    def start(self):
        for _ in range(self.TRIES):
            try:
                self.server = self.test.start(data=self.data, env=self.faults.env)
                return
            except RuntimeError as error:
                self.excuses.append(str(error)[-300:])
        self.test.fail(f"does not start: {self.excuses}")

    def ask(self, method, path, body=None, content_type=None):
        headers = {"Content-Type": content_type} if content_type else {}
        for _ in range(self.TRIES):
            try:
                answer = self.server.request(method, path, body, headers)
            except ConnectionError as error:
                self.test.assertTrue(self.server.is_running(), f"the server ended: {error}")
                self.excuses.append(f"{method} {path}: {error}")
                continue
            if answer.status < 300:
                return answer
            self.test.assertIn(answer.status, EXCUSES, (method, path, answer.body))
            self.excuses.append(f"{method} {path}: {answer.body[:200]}")
        self.test.fail(f"{method} {path}: {self.excuses}")

    def bake(self, order):
        for _ in range(self.TRIES):
            bake = self.ask("POST", "/v1/bakes", order).json()["id"]
            answer = self.server.wait_for(bake, seconds=40)
            if answer["state"] == "done":
                return answer["volume"]
            self.excuses.append(answer["error"])
        self.test.fail(f"no bake ends: {self.excuses}")

    def light(self, volume):
        return self.ask("POST", f"/v1/volumes/{volume}/query", QUERY).body

    def run(self):
        self.start()
        post = lambda kind, path, name: self.ask(
            "POST", f"/v1/{kind}?name={name}", read(path), BINARY).json()["id"]
        self.answers["scene"] = post("scenes", COURTYARD, "court")
        self.answers["groups"] = post("groups", self.test.groups, "few")
        self.answers["volume"] = self.bake(
            {"scene": "court", "groups": ["few"], "only_given_groups": True, "samples": 1,
             "bounces": 1, "name": "level"})
        self.answers["light"] = self.light("level")
        relit = self.ask("POST", "/v1/relight", {"volume": "level", "name": "dusk"}).json()["id"]
        self.answers["relit"] = relit
        other = post("volumes", self.test.other, "other")
        self.ask("DELETE", f"/v1/volumes/{other}") if self.is_there(other) else None
        self.descriptors = self.open_descriptors()
        self.stop()
        self.start()
        self.answers["light again"] = self.light("level")
        self.stop()

    def open_descriptors(self):
        """Of all but connections, which end when the system likes."""
        folder = f"/proc/{self.server.process.pid}/fd/"
        links = []
        for name in os.listdir(folder):
            with contextlib.suppress(FileNotFoundError):
                links.append(os.readlink(folder + name))
        return sum(not link.startswith("socket:") for link in links)

    def is_there(self, volume):
        return self.server.get("/v1/volumes/" + volume).status == 200

    def stop(self):
        self.test.assertEqual(self.server.stop(seconds=30), 0)


@unittest.skipUnless(SHIM, "sanitizers do not go with preloaded libraries")
class Injected(ServiceTest):
    def setUp(self):
        super().setUp()
        self.groups = os.path.join(self.folder, "groups.json")
        write_groups(self.groups, lattice(2))
        self.other = os.path.join(self.folder, "other.probes")
        self.command("tetrahedralize", self.groups, "-o", self.other)

    def run_script(self, number, *fault):
        folder = os.path.join(self.folder, str(number))
        os.mkdir(folder)
        script = Script(self, os.path.join(folder, "data"), Faults(folder + "/data", folder))
        script.faults.arm(*fault)
        script.run()
        return script

    def check(self, script, expected):
        """What a start without faults finds."""
        self.assertEqual(script.answers, expected.answers)
        server = self.start(data=script.data)
        self.assertEqual(server.post("/v1/volumes/level/query", QUERY).body, expected.answers["light"])
        volumes = {v["id"]: v["names"] for v in server.get("/v1/volumes").json()["volumes"]}
        if expected.answers["relit"] == expected.answers["volume"]:
            self.assertEqual(volumes, {expected.answers["volume"]: ["dusk", "level"]})
        else:
            self.assertEqual(volumes, {expected.answers["volume"]: ["level"],
                                       expected.answers["relit"]: ["dusk"]})
        self.assertEqual(server.get("/v1/scenes/court/file").body, read(COURTYARD))
        self.assertEqual(server.get("/v1/groups/few/file").body, read(self.groups))
        self.assertEqual(server.stop(), 0)
        self.assertEqual(self.files_in(script.data), self.files_in(expected.data))

    @staticmethod
    def files_in(data):
        """All that is in a folder; the database's log may outlive it."""
        found = set()
        for folder, _, names in os.walk(data):
            found |= {os.path.relpath(os.path.join(folder, name), data) for name in names}
        return {name for name in found if not name.startswith("tetralight.db-")}

    @staticmethod
    def places(counts):
        counts = dict(counts, accept=16)  # how often a bake is asked for depends on the time
        return [(call, number, error) for call in CALLS for number in range(1, counts[call] + 1)
                for error in ERRORS[call]]

    def test_no_fault_loses_or_breaks_anything(self):
        expected = self.run_script(0)
        places = self.places(expected.faults.counts())
        self.assertGreater(min(expected.faults.counts().values()), 0)
        if not IS_NIGHTLY:
            places = random.Random(SEED).sample(places, SAMPLE)
        reached = 0
        for number, fault in enumerate(places, 1):
            call, place, error = fault
            with self.subTest(call=call, number=place, error=error_name(error)):
                script = self.run_script(number, *fault)
                reached += script.faults.has_fired()
                self.assertTrue(script.faults.has_fired())
                self.check(script, expected)
                # Fewer if SQLite began without the memory that it shares with other programs.
                self.assertLessEqual(script.descriptors, expected.descriptors)
                shutil.rmtree(os.path.dirname(script.data))
        print(json.dumps({"faults_tried": len(places), "reached": reached}))


if __name__ == "__main__":
    unittest.main()
