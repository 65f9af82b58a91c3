# SPDX-License-Identifier: Apache-2.0
import threading
import unittest

from tetralight._gate import Gate
from tetralight._threads import parallel_for


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
                gate.enter()
                inside.append(1)
                inside.pop()
                gate.leave()

        def change():
            for _ in range(50):
                gate.close()
                seen.append(len(inside))
                gate.open()

        threads = [threading.Thread(target=work) for work in (read, read, change, change)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(seen, [0] * 100)

    def test_an_interrupted_change_lets_others_in(self):
        class Interrupted(threading.Condition):
            def wait(self, timeout=None):
                raise KeyboardInterrupt

        gate = Gate()
        gate.enter()
        waiting, gate._condition = gate._condition, Interrupted(threading.Lock())
        with self.assertRaises(KeyboardInterrupt):
            gate.close()
        gate._condition = waiting
        gate.leave()
        self.assertFalse(gate._is_closed)
