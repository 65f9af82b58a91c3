# SPDX-License-Identifier: Apache-2.0
"""Figures of bakes in tasks, one JSON object a line: bytes on a Slurm whose nodes die, the cost of cutting a bake, and
what `bake-all` does again.

    bench_farm.py [--quick]
"""
import argparse
import json
import os
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import slurm_cluster
from test_slurm import COURTYARD, TETRALIGHT, running_tasks

PATIENCE = 3600


def report(figure, value, unit, **more):
    print(json.dumps({"figure": figure, "ours": round(value, 4), "unit": unit, **more}), flush=True)


def tetralight(folder, *arguments):
    """Processor seconds of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([TETRALIGHT, *map(str, arguments), "--quiet"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def write_order(folder, scene, count, samples):
    """An order of about `count` probes in and above a scene of 20 x 5 x 20 m."""
    side = round((count / 5) ** 0.5)
    step = 20 / side
    positions = [[x * step - 10, 0.5 + 1.2 * y, z * step - 10]
                 for x in range(side) for y in range(5) for z in range(side)]
    (folder / "groups.json").write_text(json.dumps({"groups": [{"name": "lattice", "positions": positions}]}))
    (folder / "order.json").write_text(json.dumps({"scenes": [
        {"scene": str(scene), "name": "scene", "probes": {"samples": samples, "groups": ["groups.json"]}}]}))
    return len(positions)


def bench_tasks(folder, count, tasks):
    """Bytes and processor time of a bake in tasks, on this machine and on a Slurm."""
    probes = write_order(folder, COURTYARD, count, 64)
    one = tetralight(folder, "bake", COURTYARD, "--groups", "groups.json", "--samples", 64, "-o", "one.probes")
    cut = tetralight(folder, "plan", "order.json", "--tasks", tasks, "-o", "here")
    cut += sum(tetralight(folder, "task", "here", task) for task in range(tasks))
    cut += tetralight(folder, "collect", "here", "-o", "here_baked")
    report("farm.overhead", cut / one, "of the processor time of one bake", probes=probes, tasks=tasks)
    report("farm.overhead_per_task", (cut - one) / tasks, "seconds of a processor", one_bake=round(one, 2))
    why = slurm_cluster.missing()
    if why:
        print("farm.bytes is left out: " + why, file=sys.stderr)
        return
    tetralight(folder, "plan", "order.json", "--tasks", tasks, "-o", "job")
    with slurm_cluster.SlurmCluster(folder / "slurm") as slurm:
        sent = json.loads(slurm.run(TETRALIGHT, "submit", folder / "job", "--to", "slurm", "--json",
                                    "-o", folder / "baked").stdout)
        disturb(slurm, folder / "job")
        state = slurm.wait_for(sent["jobs"][-1]["job"], PATIENCE)
    same = state == "COMPLETED" and \
        (folder / "baked" / "scene.probes").read_bytes() == (folder / "one.probes").read_bytes()
    report("farm.bytes", same, "1 = the bytes of one bake", probes=probes, tasks=tasks)


def disturb(slurm, job):
    """Kills two tasks, runs one twice, and kills a node with its steps twice."""
    for _ in range(2):
        slurm_cluster.wait_until(lambda: running_tasks(job), PATIENCE, "a task that runs")
        slurm_cluster.send(next(iter(running_tasks(job).values()), 0), signal.SIGKILL)
    slurm_cluster.wait_until(lambda: running_tasks(job), PATIENCE, "a task that runs")
    task = next(iter(running_tasks(job)), 0)
    twin = subprocess.Popen([TETRALIGHT, "task", job, str(task), "--quiet"])
    for name in slurm.names:
        slurm_cluster.wait_until(lambda: slurm.steps(name), PATIENCE, "a task on " + name)
        slurm.kill_node(name)
        slurm.start_node(name)
    twin.wait()


def with_stronger_light(source, target):
    """A copy of a .glb whose first light is twice as strong. Gives the name of the layer of that light."""
    data = source.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    scene = json.loads(data[20:20 + length])
    light = scene["extensions"]["KHR_lights_punctual"]["lights"][0]
    light["intensity"] = 2 * light.get("intensity", 1)
    node = next(node for node in scene["nodes"]
                if node.get("extensions", {}).get("KHR_lights_punctual", {}).get("light") == 0)
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length:]
    target.write_bytes(data[:8] + struct.pack("<I", 20 + len(text) + len(rest)) +
                       struct.pack("<I", len(text)) + b"JSON" + text + rest)
    return "sun" if light["type"] == "directional" else "light:" + node.get("name", light.get("name"))


def bench_bake_all(folder, scene, name):
    """All light of a scene by default settings, and again after its first light, a layer of its own, became twice as strong."""
    stronger = folder / "stronger.glb"
    layer = with_stronger_light(Path(scene), stronger)
    shutil.copy(scene, folder / "scene.glb")
    baked = {"layers": [layer]}
    (folder / "order.json").write_text(json.dumps({"scenes": [
        {"scene": "scene.glb", "probes": baked,
         "lightmaps": {**baked, "texels_per_meter": 4}}]}))
    whole = tetralight(folder, "bake-all", "order.json", "-o", "baked")
    nothing = tetralight(folder, "bake-all", "order.json", "-o", "baked")
    os.replace(stronger, folder / "scene.glb")
    again = tetralight(folder, "bake-all", "order.json", "-o", "baked")
    report("farm.bake_all_unchanged." + name, nothing / whole, "of the processor time of all")
    report("farm.bake_all_lamp." + name, again / whole, "of the processor time of all")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true")
    options, _ = parser.parse_known_args()
    with tempfile.TemporaryDirectory(prefix="farm") as place:
        bench_tasks(Path(place), 2000 if options.quick else 100000, 8 if options.quick else 64)
    with tempfile.TemporaryDirectory(prefix="farm") as place:
        bench_bake_all(Path(place), COURTYARD, "courtyard")
