# SPDX-License-Identifier: Apache-2.0
"""Bakes survive whatever ends the server, and end with the same bytes."""
import json
import os
import random
import threading
import time
import unittest

from faults import SHIM
from service import COURTYARD, PATIENCE, ServiceTest, lattice, write_groups, read

# How often the server is killed: a few times, or as often as one likes.
KILLS = int(os.environ.get("TETRALIGHT_KILLS", "5"))

# Some seconds of work, saved about 16 times.
SLOW = {"samples": 8192, "bounces": 4}
QUICK = {"samples": 16, "bounces": 1}


class BakeTest(ServiceTest):
    def begin(self, server, orders="/v1/bakes", **members):
        members.setdefault("scene", self.scene)
        answer = server.post(orders, members)
        self.assertEqual(answer.status, 202, answer.body)
        self.assertEqual(answer.headers["Location"], "/v1/bakes/" + answer.json()["id"])
        return answer.json()["id"]

    def start(self, *options, **more):
        server = super().start(*options, **more)
        self.scene = self.upload(server, "scenes", COURTYARD)
        return server

    def baked_by_command(self, *options):
        path = os.path.join(self.folder, "expected.probes")
        self.command("bake", COURTYARD, "-o", path, *options)
        return read(path)

    def file_of(self, server, bake):
        answer = server.wait_for(bake)
        self.assertEqual(answer["state"], "done", answer)
        return server.get(f"/v1/volumes/{answer['volume']}/file").body

    def chunk_folder(self, bake):
        return os.path.join(self.data, "bakes", bake, "results", "chunks")

    def wait_for_chunks(self, bake, count):
        chunks = []

        def are_written():
            nonlocal chunks
            if os.path.isdir(self.chunk_folder(bake)):
                chunks = [c for c in os.listdir(self.chunk_folder(bake)) if c.endswith(".pack")]
            return len(chunks) >= count

        self.assertTrue(self.eventually(are_written, PATIENCE), "no chunk was written")
        return chunks

    def wait_for_no_folders(self):
        """Folders go after the bake is said to be over, never before."""
        for _ in range(500):
            if not os.listdir(os.path.join(self.data, "bakes")):
                return
            time.sleep(0.02)
        self.fail("a bake left its folder behind")


class Bakes(BakeTest):
    def test_the_bytes_are_those_of_the_command(self):
        server = self.start()
        bake = self.begin(server, **QUICK, name="court")
        expected = self.baked_by_command("--samples", "16", "-b", "1")
        self.assertEqual(self.file_of(server, bake), expected)
        self.assertEqual(server.get("/v1/volumes/court/file").body, expected)
        answer = server.get("/v1/bakes/" + bake).json()
        self.assertEqual(answer["probes_done"], answer["probe_count"])
        self.assertEqual(answer["report"]["probes"], answer["probe_count"])
        self.wait_for_no_folders()
        self.assertEqual(answer["probe_count"], 255)
        server.kill()
        self.assertEqual(self.start().get("/v1/bakes/" + bake).json(), answer)

    def test_groups_sky_and_sun(self):
        server = self.start()
        path = os.path.join(self.folder, "groups.json")
        write_groups(path, lattice(3, 2.0))
        self.upload(server, "groups", path, "mine")
        bake = self.begin(server, **QUICK, groups=["mine"], only_given_groups=True, sky=[1, 2, 3],
                          sun_direction=[0, -1, 0], sun_irradiance=[3, 3, 3], seed=7)
        self.assertEqual(
            self.file_of(server, bake),
            self.baked_by_command("--samples", "16", "-b", "1", "-g", path, "--only-given-groups",
                                  "--sky", "1,2,3", "--sun-direction=0,-1,0", "--sun-irradiance",
                                  "3,3,3", "--seed", "7"))

    def test_orders_that_are_none_are_refused_at_once(self):
        server = self.start()
        for members, code, field in (
                ({}, "missing_value", "scene"), ({"scene": 3}, "invalid_value", "scene"),
                ({"scene": self.scene, "samples": 0}, "invalid_value", "samples"),
                ({"scene": self.scene, "samples": "many"}, "invalid_value", "samples"),
                ({"scene": self.scene, "samples": 1.5}, "invalid_value", "samples"),
                ({"scene": self.scene, "sky": [1, 2]}, "invalid_value", "sky"),
                ({"scene": self.scene, "sky": -1}, "invalid_value", "sky"),
                ({"scene": self.scene, "layers": ["a,b"]}, "invalid_value", "layers[0]"),
                ({"scene": self.scene, "priority": 1e9}, "invalid_value", "priority"),
                ({"scene": self.scene, "output": "/etc/passwd"}, "unknown_member", "output")):
            with self.subTest(members=members):
                problem = self.assert_problem(server.post("/v1/bakes", members), 400, code)
                self.assertEqual(problem["field"], field)
        self.assert_problem(server.post("/v1/bakes", {"scene": "none"}), 404, "not_found")
        self.assert_problem(server.post("/v1/bakes", {"scene": self.scene, "sky": "/etc/passwd"}),
                            404, "not_found")
        self.assert_problem(server.post("/v1/bakes", {"scene": self.scene, "layers": ["none"]}), 422,
                            "bad_data")
        self.assertEqual(server.get("/v1/bakes").json()["bakes"], [])

    def test_killed_at_any_moment_it_ends_with_the_same_bytes(self):
        options = {"samples": 512, "bounces": 3}
        expected = self.baked_by_command("--samples", "512", "-b", "3")
        generator = random.Random(int(os.environ.get("TETRALIGHT_SEED", "0")))
        server = self.start()
        begin = time.monotonic()
        self.assertEqual(self.file_of(server, self.begin(server, **options)), expected)
        whole = time.monotonic() - begin
        volume = server.get("/v1/volumes").json()["volumes"][0]["id"]
        kills = 0
        while kills < KILLS:
            server.request("DELETE", "/v1/volumes/" + volume)
            bake = self.begin(server, **options)
            # Killed again and again, more often than not before it is over.
            for _ in range(generator.randint(1, 3)):
                time.sleep(generator.uniform(0, whole))
                server.kill()
                kills += 1
                server = self.start()
            with self.subTest(kills=kills):
                self.assertEqual(self.file_of(server, bake), expected)

    def test_only_what_changed_is_baked_and_killing_it_changes_no_byte(self):
        paths = [os.path.join(self.folder, name) for name in ("old.json", "new.json")]
        positions = [[x, y + 4.5, z] for x, y, z in lattice(6, 0.8)]
        write_groups(paths[0], positions[:40])
        write_groups(paths[1], positions)
        server = self.start()
        old, new = (self.upload(server, "groups", path) for path in paths)
        settings = {"samples": 4096, "bounces": 4, "only_given_groups": True}
        volume = server.wait_for(self.begin(server, **settings, groups=[old]))["volume"]
        bake = self.begin(server, **settings, groups=[new], reuse=volume)
        self.assertEqual(server.request("DELETE", "/v1/volumes/" + volume).status, 204)
        self.wait_for_chunks(bake, 2)
        server.kill()
        server = self.start()
        self.assertEqual(self.file_of(server, bake), self.baked_by_command(
            "--samples", "4096", "-b", "4", "-g", paths[1], "--only-given-groups"))
        report = server.get("/v1/bakes/" + bake).json()["report"]
        self.assertEqual((report["reused"], report["probes"]), (40, 216))

    def test_what_cannot_be_reused_is_baked_and_said(self):
        server = self.start()
        volume = server.wait_for(self.begin(server, **QUICK))["volume"]
        answer = server.wait_for(self.begin(server, **QUICK, reuse=volume, seed=5))
        self.assertEqual((answer["state"], answer["report"]["reused"]), ("done", 0))
        self.assertIn("reuse: nothing is reused: its setting seed is 0, that of this bake is 5",
                      answer["report"]["warnings"])
        self.assert_problem(server.post("/v1/bakes", {"scene": self.scene, "reuse": "none"}), 404,
                            "not_found")

    def test_torn_and_foreign_chunks_are_baked_anew(self):
        expected = self.baked_by_command("--samples", str(SLOW["samples"]), "-b", "4")
        server = self.start()
        bake = self.begin(server, **SLOW)
        chunks = sorted(self.wait_for_chunks(bake, 3))
        server.kill()
        paths = [os.path.join(self.chunk_folder(bake), chunk) for chunk in chunks]
        os.truncate(paths[0], os.path.getsize(paths[0]) - 100)
        with open(paths[1], "r+b") as file:
            file.seek(500)
            file.write(b"\xff")
        with open(os.path.join(self.chunk_folder(bake), "0000000000000099-0000000000000099.pack"), "w") as file:
            file.write("mine")
        server = self.start()
        self.assertEqual(self.file_of(server, bake), expected)

    def test_a_bake_of_an_earlier_version_continues(self):
        expected = self.baked_by_command("--samples", str(SLOW["samples"]), "-b", "4")
        server = self.start()
        bake = self.begin(server, **SLOW)
        self.wait_for_chunks(bake, 2)
        server.kill()
        folder = os.path.join(self.data, "bakes", bake)
        # Its results lay beside its inputs.
        for name in os.listdir(os.path.join(folder, "results")):
            os.rename(os.path.join(folder, "results", name), os.path.join(folder, name))
        os.rmdir(os.path.join(folder, "results"))
        chunks = len(os.listdir(os.path.join(folder, "chunks")))
        server = self.start()
        self.assertGreaterEqual(len(self.wait_for_chunks(bake, chunks)), chunks)
        self.assertEqual(self.file_of(server, bake), expected)

    def test_sigterm_leaves_a_bake_for_the_next_time(self):
        server = self.start()
        bake = self.begin(server, **SLOW)
        self.wait_for_chunks(bake, 1)
        self.assertEqual(server.stop(), 0)
        self.assertTrue(os.listdir(self.chunk_folder(bake)))
        server = self.start()
        self.assertIn(server.get("/v1/bakes/" + bake).json()["state"], ("queued", "running"))
        self.assertEqual(server.wait_for(bake)["state"], "done")

    def test_a_scene_may_be_deleted_while_it_is_baked(self):
        server = self.start()
        bake = self.begin(server, **QUICK)
        server.request("DELETE", "/v1/scenes/" + self.scene)
        self.assertEqual(server.wait_for(bake)["state"], "done")

    def test_a_program_that_is_killed_fails_the_bake_and_nothing_else(self):
        server = self.start()
        bake = self.begin(server, **SLOW)
        self.wait_for_chunks(bake, 1)
        for process in server.children():
            os.kill(process, 9)
        answer = server.wait_for(bake)
        self.assertEqual(answer["state"], "failed")
        self.assertIn("signal 9", answer["error"])
        self.assertEqual(server.wait_for(self.begin(server, **QUICK))["state"], "done")

    @unittest.skipUnless(SHIM, "sanitizers reserve more memory than the limits")
    def test_too_little_memory_fails_the_bake(self):
        server = self.start("--tool-memory", "1000000000")
        server.stop()
        server = ServiceTest.start(self, "--tool-memory", "30000000")
        answer = server.post("/v1/bakes", {"scene": self.scene, **QUICK})
        self.assertGreaterEqual(answer.status, 400)
        self.assertEqual(server.get("/healthz").status, 200)

    def test_bakes_are_cancelled(self):
        server = self.start()
        running, waiting = self.begin(server, **SLOW), self.begin(server, **SLOW)
        self.wait_for_chunks(running, 1)
        self.assert_problem(server.request("DELETE", "/v1/bakes/" + running), 409, "not_over")
        for bake in (waiting, running):
            answer = server.post(f"/v1/bakes/{bake}/cancel")
            self.assertEqual((answer.status, answer.json()["state"]), (200, "cancelled"))
            self.assert_problem(server.post(f"/v1/bakes/{bake}/cancel"), 409, "is_over")
        self.assertEqual(server.wait_for(self.begin(server, **QUICK))["state"], "done")
        self.wait_for_no_folders()
        self.assertEqual(server.request("DELETE", "/v1/bakes/" + running).status, 204)
        self.assert_problem(server.get("/v1/bakes/" + running), 404, "not_found")

    def test_the_queue_has_an_end_and_an_order(self):
        server = self.start("--max-bakes", "4")
        first = self.begin(server, **SLOW)
        self.wait_for_chunks(first, 1)
        low = self.begin(server, **QUICK, priority=-1)
        plain = self.begin(server, **QUICK)
        high = self.begin(server, **QUICK, priority=5)
        self.assert_problem(server.post("/v1/bakes", {"scene": self.scene}), 429, "queue_full")
        server.post(f"/v1/bakes/{first}/cancel")
        ended = [server.wait_for(bake)["ended"] for bake in (high, plain, low)]
        self.assertEqual(ended, sorted(ended))

    def test_events_tell_how_far_it_is(self):
        server = self.start()
        bake = self.begin(server, **SLOW)
        body = server.get(f"/v1/bakes/{bake}/events").body.decode()
        events = [event.split("\n") for event in body.strip().split("\n\n")
                  if not event.startswith(":")]
        kinds = [event[0] for event in events]
        self.assertEqual(kinds[-1], "event: end")
        self.assertEqual(set(kinds[:-1]), {"event: progress"})
        bakes = [json.loads(event[1].removeprefix("data: ")) for event in events]
        done = [bake["probes_done"] for bake in bakes]
        self.assertEqual(done, sorted(done))
        self.assertGreater(len(set(done)), 3)
        self.assertEqual(bakes[-1]["state"], "done")
        running = [bake for bake in bakes if bake["state"] == "running"]
        for member in ("rays_per_second", "seconds_left"):
            self.assertTrue(all(bake[member] is None or bake[member] >= 0 for bake in running))
            self.assertTrue(any(bake[member] for bake in running), member)
            self.assertNotIn(member, bakes[-1])

    def events_of(self, response):
        """The kind and the bake of each event of a stream."""
        kind = None
        while line := response.readline().decode().rstrip("\n"):
            if line.startswith("event: "):
                kind = line.removeprefix("event: ")
            elif line.startswith("data: "):
                yield kind, json.loads(line.removeprefix("data: "))
                response.readline()  # the line that ends the event
            else:
                response.readline()  # a comment

    def test_one_stream_follows_all_bakes(self):
        server = self.start()
        ended = self.begin(server, **QUICK)
        server.wait_for(ended)
        bakes = [self.begin(server, **SLOW) for _ in range(7)]
        connection = server.connect()
        connection.request("GET", "/v1/bakes/events")
        response = connection.getresponse()
        self.assertEqual(response.headers["Content-Type"], "text/event-stream")
        events = self.events_of(response)
        first = {bake["id"] for _, bake in (next(events) for _ in bakes)}
        self.assertEqual(first, set(bakes))
        bakes += [self.begin(server, **SLOW) for _ in range(2)]
        for bake in bakes:  # some of them before the stream looks again
            server.post(f"/v1/bakes/{bake}/cancel")
        server.request("DELETE", "/v1/bakes/" + bakes[-1])
        ends = {}
        for kind, bake in events:
            self.assertNotEqual(bake["id"], ended)
            self.assertNotIn("request", bake)
            if kind == "end" or bake["state"] == "cancelled":
                ends[bake["id"]] = bake["state"]
            if len(set(ends) | {bakes[-1]}) == len(bakes):
                break
        self.assertEqual({ends[bake] for bake in bakes[:-1]}, {"cancelled"})
        connection.close()

    def test_the_pace_after_a_restart_is_that_of_the_new_run(self):
        server = self.start()
        bake = self.begin(server, **{**SLOW, "samples": 4 * SLOW["samples"]})
        self.wait_for_chunks(bake, 1)
        server.kill()
        # A claim of the run before, which no run could keep.
        with open(os.path.join(self.data, "bakes", bake, "results", "progress.json"), "w") as file:
            json.dump({"probe_count": 1, "rays_per_second": 1e30, "seconds_left": 1e30}, file)
        server = self.start()
        seen = []
        while not seen or not seen[-1]["rays_per_second"]:
            seen.append(server.get("/v1/bakes/" + bake).json())
            self.assertIn(seen[-1]["state"], ("queued", "running"))
            time.sleep(0.02)
        for answer in seen:
            self.assertTrue((answer["rays_per_second"] or 0) < 1e30, answer)
            self.assertTrue((answer["seconds_left"] or 0) < 1e30, answer)

    def test_queries_are_answered_while_a_bake_runs(self):
        server = self.start()
        volume = server.wait_for(self.begin(server, **QUICK))["volume"]
        slow = self.begin(server, **SLOW)
        self.wait_for_chunks(slow, 1)
        for _ in range(50):
            answer = server.post(f"/v1/volumes/{volume}/query", {"positions": [[0, 1, 0]]})
            self.assertEqual(answer.status, 200)
        server.post(f"/v1/bakes/{slow}/cancel")

    def test_bakes_give_way_to_queries(self):
        server = self.start()
        bake = self.begin(server, **SLOW)
        self.wait_for_chunks(bake, 1)
        processes = server.children()
        self.assertTrue(processes)
        for process in processes:
            self.assertEqual(os.getpriority(os.PRIO_PROCESS, process), 19)
            self.assertNotEqual(os.getsid(process), os.getsid(server.process.pid))
            groups = f"/proc/{process}/autogroup"
            if os.path.exists(groups):
                with open(groups, encoding="ascii") as file:
                    self.assertTrue(file.read().endswith(" nice 19\n"))
        server.post(f"/v1/bakes/{bake}/cancel")

    def test_bakes_and_relights_of_the_same_bytes_take_no_name_away(self):
        server = self.start()
        bakes = [self.begin(server, **QUICK, layers=["sun", "sky"], name=name)
                 for name in ("release", "nightly")]
        volumes = {server.wait_for(bake)["volume"] for bake in bakes}
        self.assertEqual(len(volumes), 1)
        same = server.post("/v1/relight", {"volume": "nightly", "name": "as baked"}).json()
        self.assertEqual({same["id"]}, volumes)
        self.assertEqual(same["names"], ["as baked", "nightly", "release"])

    def test_a_name_always_leads_to_a_whole_volume(self):
        server = self.start()
        server.wait_for(self.begin(server, **QUICK, name="level"))
        is_over = threading.Event()
        statuses = set()

        def ask():
            while not is_over.is_set():
                query = {"positions": [[0, 1, 0]]}
                statuses.add(server.post("/v1/volumes/level/query", query).status)

        asker = threading.Thread(target=ask)
        asker.start()
        for seed in range(1, 4):
            server.wait_for(self.begin(server, **QUICK, name="level", seed=seed))
        is_over.set()
        asker.join()
        self.assertEqual(statuses, {200})


if __name__ == "__main__":
    unittest.main()
