# SPDX-License-Identifier: Apache-2.0
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy

import tetralight
from support import vector_path
from tetralight._gate import Gate
from tetralight._threads import parallel_for, start

SECONDS = 60


class ParallelFor(unittest.TestCase):
    def test_calls_each_task_once(self):
        for count in (0, 1, 2, 1000):
            for threads in (1, 2, 7):
                called = []
                parallel_for(count, called.append, threads)
                self.assertEqual(sorted(called), list(range(count)))

    def test_raises_what_a_task_raises(self):
        def task(number):
            if number == 5:
                raise KeyError(number)

        for threads in (1, 3):
            with self.assertRaises(KeyError):
                parallel_for(100, task, threads)


class Gates(unittest.TestCase):
    def test_one_call_runs_alone(self):
        gate, inside, seen = Gate(), [], []

        def read():
            for _ in range(200):
                gate.run(lambda: (inside.append(1), inside.pop()))

        def change():
            for _ in range(50):
                gate.run_alone(lambda: seen.append(len(inside)))

        threads = [threading.Thread(target=work) for work in (read, read, change, change)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(seen, [0] * 100)

    def test_returns_and_raises_what_the_call_does(self):
        gate = Gate()
        for run in (gate.run, gate.run_alone):
            self.assertEqual(run(lambda: 5), 5)
            with self.assertRaises(KeyError):
                run({}.popitem)
        self.assertEqual(gate.run_alone(lambda: 5), 5)


class Interrupts(unittest.TestCase):
    def test_no_task_runs_after_an_interrupt_at_any_step(self):
        step = 0
        while True:
            step += 1
            running = set()

            def task(number):
                running.add(number)
                time.sleep(0.002)
                running.discard(number)

            is_interrupted = interrupted(step, lambda: parallel_for(12, task, 3), (parallel_for.__code__, start.__code__))
            self.assertEqual(running, set(), f"step {step}")
            if not is_interrupted:
                break
        self.assertGreater(step, 10)


def interrupted(step, call, codes):
    """Calls a function, and raises KeyboardInterrupt before a line of this thread, counted over the functions of
    these codes. False if it has fewer lines."""
    count = 0

    def trace(frame, event, _):
        nonlocal count
        if frame.f_code not in codes:
            return None
        if event == "line":
            count += 1
            if count == step:
                raise KeyboardInterrupt
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        call()
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
    return False


class Volumes(unittest.TestCase):
    def test_queries_run_beside_changes_and_closing(self):
        volume = tetralight.open(vector_path("layers"))
        positions = numpy.random.default_rng(1).uniform(-1, 1, (40_000, 3))
        count = len(volume.layers)
        failures = []

        def ask():
            try:
                while True:
                    volume.query(positions, threads=2)
                    volume.irradiance.sum(), volume.layers, volume.positions.sum()
            except tetralight.Closed:
                pass
            except BaseException as failure:
                failures.append(failure)

        threads = [threading.Thread(target=ask, daemon=True) for _ in range(8)]
        for thread in threads:
            thread.start()
        for step in range(20):
            volume.recombine(numpy.full(count, 1 + step % 2))
        volume.close()
        for thread in threads:
            thread.join(SECONDS)
            self.assertFalse(thread.is_alive())
        self.assertEqual(failures, [])

    def test_ctrl_c_in_a_loop_of_queries(self):
        """Interrupts come at random steps. The volume can be changed and queried after each."""
        code = (
            "import sys, numpy, tetralight\n"
            f"volume = tetralight.open({vector_path('layers')!r})\n"
            "small, large = numpy.zeros((1, 3)), numpy.zeros((40_000, 3))\n"
            "for i in range(40):\n"
            "    try:\n"
            "        print('ready', flush=True)\n"
            "        while True:\n"
            "            volume.query(small if i % 2 else large, threads=2)\n"
            "    except KeyboardInterrupt:\n"
            "        volume.recombine([1.0] * len(volume.layers))\n"
            "        volume.query(large)\n"
            "print('end', flush=True)\n"
        )
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
            timer = threading.Timer(SECONDS, process.kill)
            timer.start()
            random = numpy.random.default_rng(1)
            for line in process.stdout:
                if line == "ready\n":
                    time.sleep(random.uniform(0.002, 0.02))
                    process.send_signal(signal.SIGINT)
            timer.cancel()
        self.assertEqual((line, process.returncode), ("end\n", 0))
