# SPDX-License-Identifier: Apache-2.0
"""Queries that fail while replicas behind HAProxy stop, die and restart: one JSON object a line."""
import json
import signal
import sys
import time
import unittest

from balancer import NAMES, Load, Query, ReplicaTest, has_haproxy
from test_query import FLOATS, OCCLUSION

ROUNDS = 3
# Positions. The first two fit in a buffer of HAProxy, and their answers in one write of the server.
SMALL, LARGE, TOO_LARGE = 50, 3500, 20000


@unittest.skipUnless(has_haproxy(), "there is no haproxy")
class Bench(ReplicaTest):
    def measure(self, signal_number, *counts):
        """Stops and restarts each replica several times under load."""
        self.start_balancer()
        load = Load(self.balancer.port, [Query(self.writer.port, name, count, 0 if count > SMALL else FLOATS, OCCLUSION)
                                         for count in counts for name in NAMES])
        for number in [0, 1, 2] * ROUNDS:
            time.sleep(1)
            self.stop_reader(number, signal_number)
            self.restart_reader(number)
        load.stop()
        self.balancer.stop()
        print(*load.failures, sep="\n", file=sys.stderr)
        return load

    def report(self, name, load, **more):
        print(json.dumps({"figure": "farm.replicas." + name, "ours": len(load.failures), "unit": "failed queries",
                          "queries": load.count(), "queries_per_second": round(load.count() / load.seconds),
                          **more}), flush=True)

    def test_sigterm(self):
        self.report("sigterm", self.measure(signal.SIGTERM, SMALL, LARGE, TOO_LARGE), stops=3 * ROUNDS)

    def test_sigkill(self):
        load = self.measure(signal.SIGKILL, SMALL, LARGE)
        self.balancer.replace("retry-on conn-failure empty-response junk-response response-timeout 503",
                              "retry-on conn-failure")
        baseline = self.measure(signal.SIGKILL, SMALL, LARGE)
        self.report("sigkill", load, baseline=len(baseline.failures), baseline_queries=baseline.count(),
                    baseline_is="HAProxy retries connections only", kills=3 * ROUNDS)

    def test_sigkill_above_the_buffer(self):
        load = self.measure(signal.SIGKILL, TOO_LARGE)
        self.report("sigkill_above_the_buffer", load, kills=3 * ROUNDS, in_flight=len(load.counts))


if __name__ == "__main__":
    unittest.main()
