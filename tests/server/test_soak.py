# SPDX-License-Identifier: Apache-2.0
"""Mixed work for some time: memory and descriptors stay as they are."""
import os
import re
import threading
import time
import unittest

from service import BINARY, COURTYARD, ServiceTest, lattice, write_groups
from test_query import binary_query

# Seconds; half an hour for a release.
SOAK = float(os.environ.get("TETRALIGHT_SOAK", "20"))


class Soak(ServiceTest):
    def gauge(self, server, name):
        text = server.get("/metrics").body.decode()
        return float(re.search(rf"^tetralight_{name} (\S+)$", text, re.M).group(1))

    def test_nothing_grows(self):
        server = self.start("--log", "warning")
        paths = []
        for count in (2, 5, 9):
            groups = os.path.join(self.folder, "groups.json")
            write_groups(groups, lattice(count))
            paths.append(os.path.join(self.folder, f"{count}.probes"))
            self.command("tetrahedralize", groups, "-o", paths[-1])
        scene = self.upload(server, "scenes", COURTYARD)
        volume = self.upload(server, "volumes", paths[-1])
        is_over = threading.Event()
        failures = []

        def work(step):
            while not is_over.is_set():
                try:
                    step()
                except Exception as error:  # whatever it is, the test is to fail by it
                    failures.append(repr(error))
                    return

        def query():
            positions = [[i * 0.01, 0.5, 0.5] for i in range(1000)]
            answer = server.post(f"/v1/volumes/{volume}/query", binary_query(positions, wants=3),
                                 BINARY)
            assert answer.status == 200
            assert server.get("/v1/nothing").status == 404
            time.sleep(0.005)

        def store():
            other = self.upload(server, "volumes", paths[0], "other")
            assert server.post("/v1/volumes/other/query", {"positions": [[0, 0, 0]]}).status == 200
            assert server.request("DELETE", "/v1/volumes/" + other).status == 204

        def bake():
            answer = server.post("/v1/bakes", {"scene": scene, "samples": 16, "bounces": 1})
            server.wait_for(answer.json()["id"])
            assert server.request("DELETE", "/v1/bakes/" + answer.json()["id"]).status == 204

        workers = [threading.Thread(target=work, args=(step,)) for step in (query, query, store, bake)]
        for worker in workers:
            worker.start()
        time.sleep(SOAK / 4)
        memory = self.gauge(server, "process_resident_bytes")
        time.sleep(SOAK * 3 / 4)
        grown = self.gauge(server, "process_resident_bytes") / memory - 1
        is_over.set()
        for worker in workers:
            worker.join()
        self.assertEqual(failures, [])
        print(f'{{"figure":"server.soak_growth","ours":{grown:.4f},"unit":"of the memory after '
              f'warm-up","seconds":{SOAK}}}')
        # A short run still warms up.
        self.assertLess(grown, 0.02 if SOAK >= 120 else 0.15)
        time.sleep(1)
        connections = self.gauge(server, "connections")
        self.assertLessEqual(connections, 2)
        # The database, its log, the lock, stdio, epoll and the like, and this connection.
        self.assertLess(self.gauge(server, "process_open_descriptors"), 30)


if __name__ == "__main__":
    unittest.main()
