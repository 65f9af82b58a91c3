# SPDX-License-Identifier: Apache-2.0
"""Bakes on a real Slurm of two nodes: the lines of docs/farm.md, and a bake whose tasks and nodes are killed."""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from slurm_cluster import SlurmCluster, missing, processes, send, session_of, wait_until

TETRALIGHT = os.environ["TETRALIGHT_COMMAND"]
COURTYARD = os.environ["TETRALIGHT_COURTYARD"]
DOCS = Path(__file__).resolve().parents[2] / "docs" / "farm.md"
# How long all tasks may take on a slow machine, under sanitizers.
PATIENCE = 1500
# A shell that read one of these names would make files.
ODD = "it's \"odd\" $(touch made_1) `touch made_2`; touch made_3 & %j #"


def probe_groups():
    """A lattice of 2 000 probes in and above the courtyard."""
    positions = [[x - 9.5, 0.5 + 1.2 * y, z - 9.5] for x in range(20) for y in range(5) for z in range(20)]
    return json.dumps({"groups": [{"name": "lattice", "positions": positions}]})


def running_tasks(job):
    """Processes that run tasks of a job, by the number of the task."""
    found = {}
    for process in processes():
        try:
            words = Path(f"/proc/{process}/cmdline").read_bytes().decode(errors="replace").split("\0")
            folder = os.readlink(f"/proc/{process}/cwd")
        except OSError:  # it has ended meanwhile
            continue
        if words[1:3] == ["task", "."] and folder == str(job):
            found[int(words[3])] = process
    return found


def has_signal(process, kind, number):
    """True if a set of signals of a process has this one: SigCgt are caught, ShdPnd wait until it is no longer frozen."""
    try:
        status = Path(f"/proc/{process}/status").read_text()
    except OSError:  # it has ended meanwhile
        return False
    return int(re.search(kind + r":\s*(\w+)", status).group(1), 16) >> (number - 1) & 1 == 1


class SlurmTest(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="slurm")
        self.addCleanup(place.cleanup)
        self.slurm = SlurmCluster(place.name)
        self.addCleanup(self.slurm.stop)
        self.slurm.start()
        place = tempfile.TemporaryDirectory(prefix="farm")
        self.addCleanup(place.cleanup)
        self.place = Path(place.name)
        self.folder = self.place / ODD
        self.folder.mkdir()

    def assert_ends_well(self, number):
        """A job of Slurm succeeds; else the message has all logs."""
        state = self.slurm.wait_for(number, PATIENCE)
        logs = [f"{log.name}: {log.read_text()[-1000:]}" for log in self.place.rglob("logs/*.log")]
        self.assertEqual(state, "COMPLETED", "\n".join([self.slurm.log(), *logs]))

    def tetralight(self, *arguments):
        return self.slurm.run(TETRALIGHT, *arguments, cwd=self.folder).stdout

    def plan(self, samples, tasks):
        """A job of 2 000 probes, all of whose names are odd."""
        scene = self.folder / f"scene {ODD}.glb"
        shutil.copy(COURTYARD, scene)
        (self.folder / "groups.json").write_text(probe_groups())
        (self.folder / "order.json").write_text(json.dumps({"scenes": [
            {"scene": scene.name, "name": f"name {ODD}",
             "probes": {"samples": samples, "groups": ["groups.json"]}}]}))
        self.tetralight("plan", "order.json", "--tasks", tasks, "-o", "job " + ODD)
        return scene, self.folder / ("job " + ODD)

    def submit(self, job, *options):
        program = self.folder / ("program " + ODD)
        program.symlink_to(TETRALIGHT)
        sent = json.loads(self.tetralight("submit", job, "--to", "slurm", "--json", "--program", program,
                                          "-o", "baked " + ODD, *options))
        return {step["name"]: str(step["job"]) for step in sent["jobs"]}

    def freeze_tasks(self, job, count, but=()):
        """Stops tasks that bake, so that they cannot end meanwhile: their processes by their numbers."""
        frozen = {}

        def are_frozen():
            for task, process in running_tasks(job).items():
                if task in but or len(frozen) == count or not has_signal(process, "SigCgt", signal.SIGTERM):
                    continue
                send(process, signal.SIGSTOP)
                if running_tasks(job).get(task) == process:
                    frozen[task] = process
            return len(frozen) == count

        wait_until(are_frozen, PATIENCE, f"{count} tasks that run")
        return frozen

    def node_of(self, process):
        return next(name for name in self.slurm.names
                    if session_of(process) in map(session_of, self.slurm.steps(name)))

    def restarts(self, job):
        shown = self.slurm.run("scontrol", "--oneliner", "show", "job", job).stdout
        return sum(map(int, re.findall(r"Restarts=(\d+)", shown)))

    def limit_time(self, job, element, minutes):
        self.slurm.run("scontrol", "update", f"JobId={job}_{element}", f"TimeLimit={minutes}")

    def nothing_was_executed(self):
        made = [path for path in self.place.rglob("*") if re.fullmatch(r"made_\d", path.name)]
        self.assertEqual(made, [])

    def test_nodes_and_tasks_may_die(self):
        samples = 4096
        scene, job = self.plan(samples, tasks=12)
        jobs = self.submit(job)
        # Two tasks are killed, and a third is run twice at once.
        killed = self.freeze_tasks(job, 2)
        for process in killed.values():
            send(process, signal.SIGKILL)
        (task, process), = self.freeze_tasks(job, 1, but=killed).items()
        twin = subprocess.Popen([TETRALIGHT, "task", job, str(task), "--threads", "1", "--quiet"])
        send(process, signal.SIGCONT)
        # A node fails while it works, and comes back. Its task goes on beside its next start.
        process, = self.freeze_tasks(job, 1, but=[*killed, task]).values()
        node = self.node_of(process)
        self.slurm.kill_node(node)
        send(process, signal.SIGCONT)
        self.slurm.start_node(node)
        self.assert_ends_well(jobs["collect"])
        self.assertEqual(twin.wait(PATIENCE), 0)
        self.assertGreaterEqual(self.restarts(jobs["phase 0"]), 3)
        self.tetralight("bake", scene, "--groups", "groups.json", "--samples", samples, "-o", "one.probes", "--quiet")
        baked = self.folder / ("baked " + ODD) / f"name {ODD}.probes"
        self.assertEqual(baked.read_bytes() == (self.folder / "one.probes").read_bytes(), True)
        self.nothing_was_executed()

    def test_a_task_saves_its_work_before_its_time_is_over(self):
        _, job = self.plan(samples=4096, tasks=2)
        jobs = self.submit(job, "--at-once", 1, "--option=--time=60")
        (task, process), = self.freeze_tasks(job, 1).items()
        # Of a limit of a minute, the signal comes as soon as Slurm looks at it. The next start has the time that it needs.
        self.limit_time(jobs["phase 0"], task, 1)
        wait_until(lambda: has_signal(process, "ShdPnd", signal.SIGTERM), 120, "the signal before the time limit")
        self.limit_time(jobs["phase 0"], task, 60)
        send(process, signal.SIGCONT)
        self.assert_ends_well(jobs["collect"])
        self.assertEqual(self.restarts(jobs["phase 0"]), 1)
        self.nothing_was_executed()

    def test_cancelled_jobs_stay_cancelled_and_are_sent_again(self):
        _, job = self.plan(samples=4096, tasks=4)
        jobs = self.submit(job)
        process, = self.freeze_tasks(job, 1).values()
        refused = self.slurm.run(TETRALIGHT, "submit", job, "--to", "slurm", check=False)
        self.assertIn("scancel " + " ".join(jobs.values()), refused.stderr)
        self.slurm.run("scancel", *jobs.values())
        send(process, signal.SIGCONT)
        for number in jobs.values():
            self.assertNotEqual(self.slurm.wait_for(number, PATIENCE), "COMPLETED")
        (self.folder / ("program " + ODD)).unlink()
        again = self.submit(job)
        self.assert_ends_well(again["collect"])

    def test_the_lines_of_the_docs(self):
        lines = re.search(r"```sh\n(.*?)```", DOCS.read_text(), re.S).group(1)
        self.assertLessEqual(len(lines.splitlines()), 10)
        shutil.copy(COURTYARD, self.place / "courtyard.glb")
        programs = self.place / "bin"
        programs.mkdir()
        (programs / "tetralight").symlink_to(TETRALIGHT)
        lines = f"PATH='{programs}':$PATH\n{lines}"
        done = self.slurm.run("bash", "-euo", "pipefail", "-c", lines, cwd=self.place, timeout=PATIENCE)
        self.assertIn("job", done.stdout)
        self.assertGreater((self.place / "baked" / "courtyard.probes").stat().st_size, 0)


if __name__ == "__main__":
    why = missing()
    if why:
        print("skipped: " + why)
        sys.exit(77)
    unittest.main()
