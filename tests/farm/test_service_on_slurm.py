# SPDX-License-Identifier: Apache-2.0
"""Bakes of the service on a real Slurm of two nodes, which ends them in all the ways that it can."""
import os
import sys
import unittest
from pathlib import Path

from slurm_cluster import SlurmCluster, missing

sys.path.append(str(Path(__file__).resolve().parents[1] / "server"))
from service import PATIENCE
from test_bakes import QUICK, SLOW, BakeTest

SLOW_OPTIONS = ("-s", str(SLOW["samples"]), "--bounces", str(SLOW["bounces"]))


class ServiceOnSlurm(BakeTest):
    def setUp(self):
        super().setUp()
        self.slurm = SlurmCluster(os.path.join(self.folder, "slurm"))
        self.addCleanup(self.slurm.stop)
        self.slurm.start()

    def start(self, *options, **more):
        return super().start("--bakes-on", "slurm", "--bakes-at-once", "2", "--tool-threads", "1", *options,
                             env=self.slurm.environment, **more)

    def jobs(self):
        """Nodes of jobs that run, by their names."""
        lines = self.slurm.run("squeue", "--noheader", "--states=RUNNING", "--format=%j %N").stdout.splitlines()
        return dict(line.split() for line in lines)

    def node_of(self, bake):
        name = "tetralight-bake-" + bake
        self.assertTrue(self.eventually(lambda: name in self.jobs(), PATIENCE), self.slurm.log())
        return self.jobs()[name]

    def test_bakes_run_on_nodes_beside_each_other(self):
        server = self.start()
        bakes = [self.begin(server, **SLOW, seed=seed) for seed in range(2)]
        self.assertEqual({self.node_of(bake) for bake in bakes}, set(self.slurm.names))
        expected = [self.baked_by_command(*SLOW_OPTIONS, "--seed", str(seed)) for seed in range(2)]
        self.assertEqual([self.file_of(server, bake) for bake in bakes], expected)
        self.assertTrue(self.eventually(lambda: self.jobs() == {}, PATIENCE))

    def test_a_bake_goes_on_after_its_node_died(self):
        server = self.start()
        bake = self.begin(server, **SLOW)
        self.wait_for_chunks(bake, 2)
        self.slurm.kill_node(self.node_of(bake))
        self.assertEqual(self.file_of(server, bake), self.baked_by_command(*SLOW_OPTIONS))
        self.assertIn("a bake waits to be tried again", [line["message"] for line in server.logged()])

    def test_a_cancelled_bake_leaves_no_job(self):
        server = self.start()
        bake = self.begin(server, **SLOW)
        self.wait_for_chunks(bake, 1)
        server.post(f"/v1/bakes/{bake}/cancel")
        self.wait_for_no_folders()
        self.assertEqual(self.jobs(), {})
        self.assertEqual(server.get("/v1/bakes/" + bake).json()["state"], "cancelled")

    def test_a_killed_server_takes_up_its_bakes(self):
        server = self.start()
        bake = self.begin(server, **SLOW)
        self.wait_for_chunks(bake, 2)
        server.kill()
        server = self.start()
        self.assertEqual(self.file_of(server, bake), self.baked_by_command(*SLOW_OPTIONS))
        self.assertEqual(self.jobs(), {})

    def test_bakes_wait_for_a_cluster_that_is_away(self):
        server = self.start()
        for name in self.slurm.names:
            self.slurm.run("scontrol", "update", "NodeName=" + name, "State=DRAIN", "Reason=test")
        bake = self.begin(server, **QUICK)
        self.assertFalse(self.eventually(lambda: server.get("/v1/bakes/" + bake).json()["state"] == "done", 3))
        for name in self.slurm.names:
            self.slurm.run("scontrol", "update", "NodeName=" + name, "State=RESUME")
        self.assertEqual(self.file_of(server, bake), self.baked_by_command("-s", "16", "--bounces", "1"))


if __name__ == "__main__":
    if missing():
        print("skipped: " + missing())
        sys.exit(77)
    unittest.main()
