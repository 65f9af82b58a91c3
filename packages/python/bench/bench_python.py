# SPDX-License-Identifier: Apache-2.0
"""Figures of the Python package, one JSON object a line: batch queries against the C++ library on the same
threads, the time of the import and of a first query, and the size of what is installed.

    bench_python.py VOLUME [REPETITIONS]

TETRALIGHT_LIBRARY is the path of libtetralight.so.0, TETRALIGHT_PYTHON_BASELINE that of the baseline."""
import ctypes
import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import tetralight

MILLION = 1_000_000


def report(figure, ours, unit, **more):
    print(json.dumps({"figure": figure, "ours": float(f"{ours:.4g}"), "unit": unit, **more}), flush=True)


class Baseline:
    """The C++ batch (bench/python_baseline.cpp)."""

    def __init__(self, path, positions):
        self.library = ctypes.CDLL(os.environ["TETRALIGHT_PYTHON_BASELINE"])
        for name in ("run", "run_fresh"):
            function = getattr(self.library, f"tetralight_baseline_{name}")
            function.restype, function.argtypes = ctypes.c_double, [ctypes.c_void_p, ctypes.c_size_t]
        self.library.tetralight_baseline_open.restype = ctypes.c_void_p
        self.library.tetralight_baseline_open.argtypes = [ctypes.c_char_p, ctypes.c_void_p, ctypes.c_size_t]
        self.library.tetralight_baseline_light.restype = ctypes.POINTER(ctypes.c_float)
        self.library.tetralight_baseline_light.argtypes = [ctypes.c_void_p]
        self.handle = self.library.tetralight_baseline_open(os.fsencode(path), positions.ctypes.data, len(positions))
        self.count = len(positions)

    def run(self, threads):
        return self.library.tetralight_baseline_run(self.handle, threads)

    def run_fresh(self, threads):
        return self.library.tetralight_baseline_run_fresh(self.handle, threads)

    def light(self):
        pointer = self.library.tetralight_baseline_light(self.handle)
        return np.ctypeslib.as_array(pointer, (self.count, 9, 3))


def seconds(work):
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def contest(figure, ours, baseline, baseline_is, repetitions):
    """Medians of alternating runs, as rates."""
    times = [(ours(), baseline()) for _ in range(repetitions + 1)][1:]
    ratio = statistics.median(theirs / mine for mine, theirs in times)
    mine, theirs = (MILLION * 1e-6 / statistics.median(column) for column in zip(*times))
    report(figure, mine, "Mq/s", baseline=float(f"{theirs:.4g}"), ratio=round(ratio, 3), baseline_is=baseline_is)


def positions_in(volume):
    """Random positions in the box of the probes, in the order of a grid, as instances of a scene are."""
    positions = np.random.default_rng(7).uniform(volume.low, volume.high, (MILLION, 3))
    cell = np.floor((positions - volume.low) / (volume.high - volume.low) * 15.999).astype(np.int64)
    order = np.lexsort(cell.T)
    return positions[order].astype(np.float32)


def bench_query(path, repetitions):
    volume = tetralight.open(path)
    positions = positions_in(volume)
    baseline = Baseline(path, positions)
    threads = len(os.sched_getaffinity(0))
    light = volume.query(positions)
    baseline.run(threads)
    if not np.array_equal(light.sh, baseline.light()):
        sys.exit("python.query: answers differ from those of the C++ library")
    for name, count in (("1m", threads), ("1m.one_thread", 1)):
        contest(f"python.query.{name}",
                lambda: seconds(lambda: volume.query(positions, out=light, threads=count)),
                lambda: baseline.run(count),
                f"C++ batch, {count} thread(s), memory of the answers used again", repetitions)
    contest("python.query.1m.fresh", lambda: seconds(lambda: volume.query(positions)),
            lambda: baseline.run_fresh(threads), f"C++ batch, {threads} thread(s), new memory", repetitions)


def bench_one(path, repetitions):
    volume, position = tetralight.open(path), np.array((0, 1.5, 0), np.float32)
    times = [seconds(lambda: [volume.query(position) for _ in range(1000)]) / 1000 for _ in range(repetitions)]
    report("python.query.one", 1e6 * statistics.median(times), "microseconds")


def run_python(code, path):
    """What new processes print."""
    output = subprocess.run([sys.executable, "-c", code, path], check=True, capture_output=True, text=True).stdout
    return float(output)


IMPORT = """
import time
import numpy
begin = time.process_time()
import tetralight
print(time.process_time() - begin)
"""

FIRST_QUERY = """
import sys, time
import tetralight
begin = time.perf_counter()
tetralight.open(sys.argv[1]).query((0, 1.5, 0))
print(time.perf_counter() - begin)
"""


def bench_start(path, repetitions):
    for figure, code, what in (
        ("python.import", IMPORT, "processor time beyond the import of NumPy"),
        ("python.first_query", FIRST_QUERY, "open a volume and query one position"),
    ):
        run_python(code, path)  # compiles the modules
        times = [run_python(code, path) for _ in range(max(repetitions, 15))]
        report(figure, 1000 * statistics.median(times), "ms", what=what)


def bench_size():
    folder = Path(tetralight.__file__).parent
    sources = sum(file.stat().st_size for file in folder.rglob("*.py"))
    library = Path(os.environ["TETRALIGHT_LIBRARY"]).resolve().stat().st_size
    report("python.size", (sources + library) / 1e6, "MB", library=round(library / 1e6, 3))


def main(path, repetitions):
    bench_start(path, repetitions)
    bench_query(path, repetitions)
    bench_one(path, repetitions)
    bench_size()


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 9)
