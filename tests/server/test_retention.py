# SPDX-License-Identifier: Apache-2.0
"""Only what the operator wants to keep is kept; names protect. Lists of bakes come in pages."""
import unittest

from service import COURTYARD
from test_files import VolumeTest


class Retention(VolumeTest):
    def volumes(self, server):
        return [v["id"] for v in server.get("/v1/volumes").json()["volumes"]]

    def test_the_newest_volumes_without_a_name_are_kept(self):
        server = self.start("--keep", "2")
        named = self.upload(server, "volumes", self.volume_file(2), "level")
        plain = [self.upload(server, "volumes", self.volume_file(n)) for n in (3, 4, 5)]
        groups = self.upload(server, "groups", self.groups_file([[0, 0, 0]]))
        kept = sorted([named, *plain[1:]])
        self.assertTrue(self.eventually(lambda: self.volumes(server) == kept))
        server.request("PATCH", "/v1/volumes/level", {"name": ""})
        self.assertTrue(self.eventually(lambda: self.volumes(server) == sorted(plain[1:])))
        self.assertEqual(server.get("/v1/groups/" + groups).status, 200)

    def test_lightmaps_without_a_name_are_counted_on_their_own(self):
        server = self.start("--keep", "1")
        volume = self.upload(server, "volumes", self.volume_file(2))
        named = self.upload(server, "lightmaps", self.lightmap_file(1), "floor")
        plain = [self.upload(server, "lightmaps", self.lightmap_file(n)) for n in (2, 3)]
        kept = lambda: [m["id"] for m in server.get("/v1/lightmaps").json()["lightmaps"]]
        self.assertTrue(self.eventually(lambda: kept() == sorted([named, plain[1]])))
        self.assertEqual(self.volumes(server), [volume])

    def test_reflection_probes_without_a_name_are_counted_on_their_own(self):
        server = self.start("--keep", "1")
        volume = self.upload(server, "volumes", self.volume_file(2))
        named = self.upload(server, "reflections", self.reflection_file(1), "room")
        plain = [self.upload(server, "reflections", self.reflection_file(sky)) for sky in (2, 3)]
        kept = lambda: [r["id"] for r in server.get("/v1/reflections").json()["reflections"]]
        self.assertTrue(self.eventually(lambda: kept() == sorted([named, plain[1]])))
        self.assertEqual(self.volumes(server), [volume])

    def test_old_ones_go(self):
        server = self.start()
        named = self.upload(server, "volumes", self.volume_file(2), "level")
        self.upload(server, "volumes", self.volume_file(3))
        server.stop()
        server = self.start("--keep", "1s")
        self.assertTrue(self.eventually(lambda: self.volumes(server) == [named]))

    def test_without_a_limit_all_are_kept(self):
        self.assertEqual(self.start().get("/v1/bakes").json(), {"bakes": [], "next": None})
        for text in ("0", "-1", "many", "3w", "1.5d", ""):
            with self.assertRaisesRegex(RuntimeError, "keep"):
                self.start("--keep", text)


class Bakes(VolumeTest):
    def test_pages_of_bakes_and_the_newest_that_ended(self):
        server = self.start()
        scene = self.upload(server, "scenes", COURTYARD)
        groups = self.upload(server, "groups", self.groups_file([[0, 1, 0], [1, 1, 0]]))
        order = {"scene": scene, "groups": [groups], "only_given_groups": True, "samples": 1,
                 "bounces": 1}
        bakes = [server.post("/v1/bakes", {**order, "seed": seed}).json()["id"] for seed in range(3)]
        for bake in bakes:
            self.assertEqual(server.wait_for(bake)["state"], "done")
        first = server.get("/v1/bakes?limit=2").json()
        self.assertEqual([b["id"] for b in first["bakes"]], bakes[:0:-1])
        rest = server.get("/v1/bakes?after=" + first["next"]).json()
        self.assertEqual(([b["id"] for b in rest["bakes"]], rest["next"]), (bakes[:1], None))
        by_id = server.get("/v1/bakes?after=" + bakes[1]).json()
        self.assertEqual(by_id, rest)
        for nonsense in ("none", "before-", "before-x", "before--1", "before-1x", "before-99999999999999999999"):
            self.assert_problem(server.get("/v1/bakes?after=" + nonsense), 404, "not_found")
        self.assert_problem(server.get("/v1/bakes?limit=1001"), 400, "invalid_value")
        # The bake at which a page ends may be deleted before the next page is asked for.
        first = server.get("/v1/bakes?limit=1").json()
        self.assertEqual(server.request("DELETE", "/v1/bakes/" + bakes[2]).status, 204)
        rest = server.get("/v1/bakes?after=" + first["next"]).json()
        self.assertEqual([b["id"] for b in rest["bakes"]], bakes[1::-1])
        server.stop()
        server = self.start("--keep", "1")
        self.assertTrue(self.eventually(
            lambda: [b["id"] for b in server.get("/v1/bakes").json()["bakes"]] == bakes[1:2]))


if __name__ == "__main__":
    unittest.main()
