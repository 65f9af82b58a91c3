# SPDX-License-Identifier: Apache-2.0
"""Many bakes with one report, several at once, and on the machines of a cluster."""
import os
import stat
import unittest
import xml.etree.ElementTree as ElementTree

from service import PATIENCE, read
from test_bakes import QUICK, SLOW, BakeTest


# Enough samples for standard errors.
ROUGH = {"samples": 32}


class Batches(BakeTest):
    def report(self, server, batch="night"):
        answer = server.get("/v1/batches/" + batch)
        self.assertEqual(answer.status, 200, answer.body)
        return answer.json()

    def test_a_report_of_what_passes_and_what_does_not(self):
        server = self.start()
        orders = [dict(name="kept", limits={"error": 1, "dead_probes": "100%", "leak": 1}),
                  dict(name="missed", limits={"error": "0.01%", "seconds": 1e-6})]
        bakes = [self.begin(server, batch="night", **ROUGH, **order) for order in orders]
        self.begin(server, batch="other", **QUICK)
        self.begin(server, **QUICK)
        reports = [server.wait_for(bake)["report"] for bake in bakes]
        batch = self.report(server)
        self.assertEqual(batch["states"], {"done": 2})
        self.assertEqual([scene["name"] for scene in batch["scenes"]], ["kept", "missed"])
        self.assertEqual([scene["passed"] for scene in batch["scenes"]], [True, False])
        self.assertFalse(batch["passed"])
        values = {limit["name"]: limit["value"] for limit in batch["scenes"][0]["limits"]}
        self.assertEqual(values, {
            "error of probes": reports[0]["standard_error"]["p99"],
            "dead_probes of probes": reports[0]["dilated"] / reports[0]["probes"],
            "leak of probes": reports[0]["leaks"]["through_walls"]["mean"]})
        self.assertEqual(batch["scenes"][0]["rays"], reports[0]["rays"])
        self.assertEqual(batch["scenes"][0]["seconds"], sum(reports[0]["seconds"].values()))
        answer = server.get("/v1/batches/night/junit")
        self.assertEqual(answer.headers["Content-Type"], "application/xml")
        suites = ElementTree.fromstring(answer.body)
        self.assertEqual([(suite.get("name"), suite.get("tests"), suite.get("failures"))
                          for suite in suites], [("kept", "4", "0"), ("missed", "3", "2")])

    def test_a_batch_survives_a_restart(self):
        server = self.start()
        bake = self.begin(server, batch="night", limits={"error": 1}, **QUICK)
        server.wait_for(bake)
        before = self.report(server)
        server.kill()
        self.assertEqual(self.report(self.start()), before)

    def test_a_batch_is_cancelled(self):
        server = self.start()
        bakes = [self.begin(server, batch="night", **SLOW) for _ in range(3)]
        other = self.begin(server, **SLOW)
        answer = server.post("/v1/batches/night/cancel")
        self.assertEqual(answer.json()["states"], {"cancelled": 3})
        self.assertEqual([scene["error"] for scene in answer.json()["scenes"]], ["it was cancelled"] * 3)
        self.assertEqual({server.wait_for(bake)["state"] for bake in bakes}, {"cancelled"})
        self.assertNotEqual(server.get("/v1/bakes/" + other).json()["state"], "cancelled")

    def test_wrong_members_are_refused(self):
        server = self.start()
        for members, detail in (({"limits": {"eror": 1}}, "eror"), ({"limits": 3}, "limits"),
                                ({"limits": {"error": "much"}}, "error"), ({"batch": "a/b"}, "batch"),
                                ({"batch": 3}, "batch"), ({"limits": {"error": 1}}, "need a batch")):
            answer = server.post("/v1/bakes", {"scene": self.scene, **members})
            self.assertEqual(answer.status, 400, answer.body)
            self.assertIn(detail, answer.json()["detail"])
        self.assertEqual(server.get("/v1/batches/none").status, 404)

    def test_several_bakes_run_at_once(self):
        server = self.start("--bakes-at-once", "2")
        bakes = [self.begin(server, **SLOW, seed=seed) for seed in range(3)]
        running = lambda: [bake for bake in bakes
                           if server.get("/v1/bakes/" + bake).json()["state"] == "running"]
        self.assertTrue(self.eventually(lambda: len(running()) == 2, PATIENCE))
        for bake in bakes:
            server.post(f"/v1/bakes/{bake}/cancel")
        self.wait_for_no_folders()


# Instead of Slurm's programs: `srun` runs the command here.
SRUN = """
for argument in "$@"; do printf '%s\\n' "$argument" >> "$FAKE_SLURM/arguments"; done
[ "$1" = --version ] && exit 0
[ -e "$FAKE_SLURM/silent" ] && { rm "$FAKE_SLURM/silent"; echo "srun: error: Node failure on node1" >&2; exit 0; }
[ -e "$FAKE_SLURM/broken" ] && { rm "$FAKE_SLURM/broken"; echo "srun: error: Unable to allocate" >&2; exit 1; }
while [ "$1" != -- ]; do shift; done
shift
exec "$@"
"""
SQUEUE = """
case "$*" in *--name=*) [ -e "$FAKE_SLURM/left" ] && echo 17;; esac
exit 0
"""
SCANCEL = """
[ "$1" = --version ] && exit 0
printf '%s\\n' "$*" >> "$FAKE_SLURM/cancelled"
rm -f "$FAKE_SLURM/left"
"""


class BakesOnSlurm(BakeTest):
    def setUp(self):
        super().setUp()
        self.slurm = os.path.join(self.folder, "slurm")
        os.mkdir(self.slurm)
        for name, text in (("srun", SRUN), ("squeue", SQUEUE), ("scancel", SCANCEL)):
            path = os.path.join(self.slurm, name)
            with open(path, "w") as file:
                file.write("#!/bin/sh" + text)
            os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)

    def begin_on_slurm(self, **members):
        path = self.slurm + os.pathsep + os.environ["PATH"]
        server = self.start("--bakes-on", "slurm", "--tool-threads", "1",
                            env={"PATH": path, "FAKE_SLURM": self.slurm})
        return server, self.begin(server, **members)

    def lines(self, name):
        path = os.path.join(self.slurm, name)
        return read(path).decode().splitlines() if os.path.exists(path) else []

    def touch(self, name):
        open(os.path.join(self.slurm, name), "w").close()

    def test_the_bytes_are_those_of_the_command(self):
        server, bake = self.begin_on_slurm(**QUICK)
        self.assertEqual(self.file_of(server, bake), self.baked_by_command("-s", "16", "--bounces", "1"))
        arguments = self.lines("arguments")
        self.assertIn("--job-name=tetralight-bake-" + bake, arguments)
        self.assertIn("--cpus-per-task=1", arguments)
        self.assertEqual(arguments[-2:], ["--job", "-"])

    def test_a_failure_of_the_cluster_is_tried_again(self):
        self.touch("broken")  # srun says that it failed
        self.touch("silent")  # it says that all is well, and nothing was done
        server, bake = self.begin_on_slurm(**QUICK)
        self.assertEqual(server.wait_for(bake)["state"], "done")
        self.assertEqual(self.lines("arguments").count("--job-name=tetralight-bake-" + bake), 3)

    def test_a_job_that_is_left_is_ended_first(self):
        self.touch("left")
        server, bake = self.begin_on_slurm(**QUICK)
        self.assertEqual(server.wait_for(bake)["state"], "done")
        self.assertEqual(self.lines("cancelled"), ["--name=tetralight-bake-" + bake])

    def test_a_cancelled_bake_ends_its_job(self):
        server, bake = self.begin_on_slurm(**SLOW)
        self.wait_for_chunks(bake, 1)
        self.touch("left")
        server.post(f"/v1/bakes/{bake}/cancel")
        self.wait_for_no_folders()
        self.assertEqual(self.lines("cancelled"), ["--name=tetralight-bake-" + bake])

    def test_a_server_that_was_killed_continues_its_bakes(self):
        server, bake = self.begin_on_slurm(**SLOW)
        self.wait_for_chunks(bake, 2)
        server.kill()
        server = self.start()
        self.assertEqual(self.file_of(server, bake),
                         self.baked_by_command("-s", "8192", "--bounces", "4"))

    def test_without_slurm_the_server_does_not_start(self):
        with self.assertRaisesRegex(RuntimeError, "Slurm: srun"):
            self.start("--bakes-on", "slurm", env={"PATH": self.folder})


if __name__ == "__main__":
    unittest.main()
