# SPDX-License-Identifier: Apache-2.0
"""Files come in, go out, get names and survive."""
import contextlib
import hashlib
import http.client
import json
import os
import random
import re
import shutil
import sqlite3
import threading
import time
import unittest

from service import BINARY, COURTYARD, ServiceTest, lattice, write_groups, read


# Uploads with some bytes changed, of each kind.
MUTATIONS = int(os.environ.get("TETRALIGHT_MUTATIONS", "25"))

# What the first servers kept.
FIRST_SCHEMA = """
    PRAGMA user_version = 1;
    CREATE TABLE files (
        id TEXT NOT NULL,
        kind TEXT NOT NULL CHECK (kind IN ('scenes', 'skies', 'groups', 'volumes')),
        name TEXT NOT NULL,
        bytes INTEGER NOT NULL,
        created REAL NOT NULL,
        facts TEXT NOT NULL,
        damage TEXT NOT NULL DEFAULT '',
        PRIMARY KEY (kind, id)
    ) STRICT;
    CREATE UNIQUE INDEX file_names ON files (kind, name) WHERE name <> '';
    CREATE TABLE bakes (
        number INTEGER PRIMARY KEY AUTOINCREMENT,
        id TEXT NOT NULL UNIQUE,
        request TEXT NOT NULL,
        arguments TEXT NOT NULL,
        name TEXT NOT NULL,
        priority INTEGER NOT NULL,
        state TEXT NOT NULL
            CHECK (state IN ('queued', 'running', 'done', 'failed', 'cancelled')),
        volume TEXT NOT NULL DEFAULT '',
        error TEXT NOT NULL DEFAULT '',
        report TEXT NOT NULL DEFAULT '',
        created REAL NOT NULL,
        ended REAL NOT NULL DEFAULT 0
    ) STRICT;
    CREATE TABLE bake_inputs (
        bake TEXT NOT NULL REFERENCES bakes (id) ON DELETE CASCADE,
        kind TEXT NOT NULL,
        file TEXT NOT NULL
    ) STRICT;
"""


class VolumeTest(ServiceTest):
    def groups_file(self, positions, name="group"):
        path = os.path.join(self.folder, "groups.json")
        write_groups(path, positions, name)
        return path

    def volume_file(self, count=3):
        groups = self.groups_file(lattice(count))
        path = os.path.join(self.folder, f"volume{count}.probes")
        self.command("tetrahedralize", groups, "-o", path)
        return path


# Some groups, and the id that versions before 0.1 gave them: their XXH128.
OLD_GROUPS = b'{"groups":[{"name":"old","positions":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]]}]}'
OLD_ID = "cd2cf9876de9280db971a4c07ab60353"


class OldIds(VolumeTest):
    def setUp(self):
        super().setUp()
        os.makedirs(os.path.join(self.data, "groups"))
        self.path = os.path.join(self.data, "groups", OLD_ID + ".json")
        with open(self.path, "wb") as file:
            file.write(OLD_GROUPS)
        entry = {"id": OLD_ID, "names": ["old"], "bytes": len(OLD_GROUPS), "created": 1.0,
                 "state": "ready", "kind": "groups", "facts": {}}
        with open(os.path.join(self.data, "index.json"), "w", encoding="utf-8") as file:
            json.dump({"files": [entry]}, file)

    def test_files_with_old_ids_are_served_and_used(self):
        server = self.start()
        for reference in (OLD_ID, "old"):
            self.assertEqual(server.get(f"/v1/groups/{reference}/file").body, OLD_GROUPS)
        answer = server.post("/v1/tetrahedralize", {"groups": [OLD_ID]})
        self.assertEqual(answer.status, 201, answer.body)
        again = server.post("/v1/groups", OLD_GROUPS, BINARY)
        self.assertEqual((again.status, again.json()["id"]), (200, OLD_ID))

    def test_a_changed_file_with_an_old_id_is_not_used(self):
        server = self.start()
        with open(self.path, "wb") as file:
            file.write(OLD_GROUPS.replace(b"old", b"new"))
        self.assert_problem(server.post("/v1/tetrahedralize", {"groups": [OLD_ID]}), 410,
                            "quarantined")


class Files(VolumeTest):
    def test_an_id_is_the_sha_256_of_the_bytes(self):
        server = self.start()
        answer = server.post("/v1/groups", OLD_GROUPS, BINARY)
        self.assertEqual(answer.json()["id"], hashlib.sha256(OLD_GROUPS).hexdigest())

    def test_a_scene_comes_back_byte_for_byte(self):
        server = self.start()
        scene = self.upload(server, "scenes", COURTYARD, "court")
        self.assertEqual(server.get("/v1/scenes/court/file").body, read(COURTYARD))
        facts = server.get(f"/v1/scenes/{scene}").json()["facts"]
        self.assertEqual(facts["probes"], 255)
        self.assertGreater(facts["triangles"], 100)
        self.assertIn("triangles", [part["name"] for part in facts["parts"]])

    def test_the_same_bytes_are_stored_once(self):
        server = self.start()
        path = self.volume_file()
        first = server.post("/v1/volumes", read(path), BINARY)
        second = server.post("/v1/volumes", read(path), BINARY)
        self.assertEqual((first.status, second.status), (201, 200))
        self.assertEqual(first.json()["id"], second.json()["id"])
        self.assertEqual(len(server.get("/v1/volumes").json()["volumes"]), 1)

    def test_what_is_no_such_file_is_refused_with_its_reason(self):
        server = self.start()
        glb = read(COURTYARD)
        for kind, body in (("scenes", b"nonsense"), ("scenes", glb[:1000]), ("skies", b"nonsense"),
                           ("skies", b"#?RADIANCE\n\nbroken"), ("groups", b"{}"),
                           ("groups", b'{"groups":[{"name":"a","positions":[[0,0,1e999]]}]}'),
                           ("volumes", b"nonsense"), ("volumes", glb), ("lightmaps", b"nonsense"),
                           ("reflections", b"nonsense"),
                           ("scenes", b"glTF" + b"\xff" * 100)):
            with self.subTest(kind=kind, body=body[:20]):
                problem = self.assert_problem(server.post(f"/v1/{kind}", body, BINARY), 422,
                                              "bad_data")
                self.assertNotIn(self.folder, json.dumps(problem))
        self.assert_problem(server.post("/v1/scenes", b"", BINARY), 400, "missing_value")
        for kind in ("scenes", "skies", "groups", "volumes", "lightmaps", "reflections"):
            self.assertEqual(server.get(f"/v1/{kind}").json()[kind], [])
        self.assertEqual(os.listdir(os.path.join(self.data, "work")), [])

    def test_uploads_with_a_byte_changed_are_stored_whole_or_not_at_all(self):
        server = self.start()
        good = bytearray(read(self.volume_file()))
        for i in range(0, len(good), len(good) // 40):
            bad = bytearray(good)
            bad[i] ^= 0x55
            answer = server.post("/v1/volumes", bytes(bad), BINARY)
            self.assertIn(answer.status, (201, 422), i)  # padding is no part of any section
        self.assertEqual(server.get("/healthz").status, 200)

    def test_mutated_uploads_never_end_the_server(self):
        server = self.start()
        generator = random.Random(int(os.environ.get("TETRALIGHT_SEED", "0")))
        groups = open(self.groups_file(lattice(2)), "rb").read()
        for kind, good in (("scenes", read(COURTYARD)), ("groups", groups)):
            for _ in range(MUTATIONS):
                bad = bytearray(good)
                for _ in range(generator.randint(1, 8)):
                    # The head is where structure is.
                    bad[int(len(bad) * generator.random() ** 3)] = generator.randrange(256)
                if generator.random() < 0.3:
                    del bad[generator.randrange(len(bad)):]
                answer = server.post(f"/v1/{kind}", bytes(bad), BINARY)
                self.assertIn(answer.status, (200, 201, 400, 422), answer.body)
        self.assertEqual(server.get("/healthz").status, 200)

    def test_edits_may_depend_on_the_state_that_the_client_has_seen(self):
        server = self.start()
        path = "/v1/volumes/" + self.upload(server, "volumes", self.volume_file(2), "first")
        tag = server.get(path).headers["ETag"]
        self.assertEqual(server.get(path, If_None_Match=tag).status, 304)
        renamed = server.request("PATCH", path, {"name": "second"}, {"If-Match": tag})
        self.assertEqual(renamed.status, 200)
        newer = renamed.headers["ETag"]
        self.assertEqual(server.get(path).headers["ETag"], newer)
        for method, body in (("PATCH", {"name": "third"}), ("DELETE", None)):
            for known in (tag, "W/" + newer, '"other"'):
                answer = server.request(method, path, body, {"If-Match": known})
                problem = self.assert_problem(answer, 412, "changed")
                self.assertEqual((problem["field"], problem["value"]), ("if-match", known))
        self.assertEqual(server.get(path).json()["names"], ["first", "second"])
        self.assertEqual(server.get(path, If_None_Match=tag).status, 200)
        for known, status in (('"other", ' + newer, 204), ("*", 404)):
            self.assertEqual(server.request("DELETE", path, headers={"If-Match": known}).status, status)

    def test_an_empty_condition_is_an_error(self):
        server = self.start()
        path = "/v1/volumes/" + self.upload(server, "volumes", self.volume_file(2), "first")
        for method, body in (("PATCH", {"name": "third"}), ("DELETE", None)):
            for known in ("", " "):
                answer = server.request(method, path, body, {"If-Match": known})
                self.assertEqual(self.assert_problem(answer, 400, "invalid_header")["field"], "if-match")
        self.assertEqual(server.get(path).json()["names"], ["first"])

    def test_lists_of_files_begin_after_an_id(self):
        server = self.start()
        volumes = sorted(self.upload(server, "volumes", self.volume_file(count)) for count in (2, 3, 4))
        first = server.get("/v1/volumes?limit=1").json()
        self.assertEqual(first["next"], volumes[0])
        self.assertEqual(server.request("DELETE", "/v1/volumes/" + volumes[0]).status, 204)
        rest = server.get("/v1/volumes?after=" + first["next"]).json()
        self.assertEqual([file["id"] for file in rest["volumes"]], volumes[1:])
        for after in ("nonsense", volumes[1][:-1], "a/b", "%20"):
            self.assert_problem(server.get("/v1/volumes?after=" + after), 400, "invalid_value")

    def test_scenes_beyond_a_limit_are_refused(self):
        server = self.start("--max-triangles", "10")
        answer = server.post("/v1/scenes", read(COURTYARD), BINARY)
        self.assert_problem(answer, 413, "too_large")

    def test_the_quota_holds(self):
        server = self.start("--quota", "100000")
        self.assert_problem(server.post("/v1/scenes", b"glTF" + bytes(200000), BINARY), 507, "quota")

    def test_ranges_and_tags(self):
        server = self.start()
        path = self.volume_file()
        whole = read(path)
        file = f"/v1/volumes/{self.upload(server, 'volumes', path)}/file"
        answer = server.get(file)
        self.assertEqual(answer.body, whole)
        tag = answer.headers["ETag"]
        size = len(whole)
        for asked, begin, end in (("bytes=0-9", 0, 10), ("bytes=100-", 100, size),
                                  ("bytes=-7", size - 7, size), (f"bytes=5-{size * 2}", 5, size)):
            part = server.get(file, Range=asked)
            self.assertEqual(part.status, 206)
            self.assertEqual(part.body, whole[begin:end])
            self.assertEqual(part.headers["Content-Range"], f"bytes {begin}-{end - 1}/{size}")
        for ignored in ("bytes=5-2", "lines=1-2", "bytes=0-1,4-5", "bytes=a-b"):
            self.assertEqual(server.get(file, Range=ignored).status, 200)
        beyond = server.get(file, Range=f"bytes={size}-")
        self.assert_problem(beyond, 416, "invalid_range")
        self.assertEqual(beyond.headers["Content-Range"], f"bytes */{size}")
        for known in (tag, "*"):
            self.assertEqual(server.get(file, If_None_Match=known).status, 304)
        self.assertEqual(server.get(file, Range="bytes=0-9", If_Range='"other"').status, 200)
        self.assertEqual(server.get(file, Range="bytes=0-9", If_Range=tag).status, 206)

    def test_bytes_of_an_id_are_kept_for_ever_and_those_of_a_name_are_asked_for_again(self):
        server = self.start()
        path = self.volume_file(2)
        volume = self.upload(server, "volumes", path, "level")
        for part in ("file", "sections/positions"):
            by_id = server.get(f"/v1/volumes/{volume}/{part}")
            self.assertIn("immutable", by_id.headers["Cache-Control"])
            by_name = server.get(f"/v1/volumes/level/{part}")
            self.assertEqual(by_name.headers["Cache-Control"], "private, no-cache")
            tag = by_name.headers["ETag"]
            self.assertEqual(by_id.headers["ETag"], tag)
            same = server.get(f"/v1/volumes/level/{part}", If_None_Match=tag)
            self.assertEqual((same.status, same.headers["Cache-Control"]), (304, "private, no-cache"))
            self.upload(server, "volumes", self.volume_file(3), "level")
            other = server.get(f"/v1/volumes/level/{part}", If_None_Match=tag)
            self.assertEqual(other.status, 200)
            self.assertNotEqual(other.body, by_name.body)
            self.upload(server, "volumes", path, "level")

    def test_sections_are_what_the_file_holds(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(3))
        positions = server.get(f"/v1/volumes/{volume}/sections/positions")
        self.assertEqual(len(positions.body), 27 * 12)
        self.assertEqual(server.get(f"/v1/volumes/{volume}/sections/nothing").status, 404)

    def names(self, server, volume):
        return server.get("/v1/volumes/" + volume).json()["names"]

    def test_the_same_bytes_have_each_name_they_came_in_under(self):
        server = self.start()
        path = self.volume_file(2)
        volume = self.upload(server, "volumes", path, "release")
        for name in ("nightly", "release", ""):
            self.assertEqual(self.upload(server, "volumes", path, name), volume)
        for name in ("nightly", "release"):
            file = server.get("/v1/volumes/" + name).json()
            self.assertEqual(file["id"], volume)
            self.assertEqual(file["names"], ["nightly", "release"])
            self.assertEqual(file["name"], "nightly")
            listed = server.get("/v1/volumes?name=" + name).json()["volumes"]
            self.assertEqual([file["id"] for file in listed], [volume])
        server.kill()
        self.assertEqual(self.names(self.start(), volume), ["nightly", "release"])

    def test_a_name_alone_moves(self):
        server = self.start()
        first = self.upload(server, "volumes", self.volume_file(2), "level")
        self.upload(server, "volumes", self.volume_file(2), "nightly")
        second = self.upload(server, "volumes", self.volume_file(3), "level")
        self.assertEqual(self.names(server, first), ["nightly"])
        self.assertEqual(self.names(server, second), ["level"])

    def test_renaming_by_name_and_by_id(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(2), "a")
        for reference, name, names in (("a", "b", ["b"]), (volume, "c", ["b", "c"]),
                                       (volume, "c", ["b", "c"]), ("b", "b", ["b", "c"]),
                                       ("b", "c", ["c"]), (volume, "d", ["c", "d"]),
                                       ("c", "", ["d"]), (volume, "e", ["d", "e"]), (volume, "", [])):
            answer = server.request("PATCH", "/v1/volumes/" + reference, {"name": name})
            self.assertEqual(answer.json()["names"], names, (reference, name))
            self.assertEqual(self.names(server, volume), names)
        self.assert_problem(server.get("/v1/volumes/d"), 404, "not_found")

    def test_deleting_by_name_takes_the_name_and_the_file_with_its_last(self):
        server = self.start()
        path = self.volume_file(2)
        volume = self.upload(server, "volumes", path, "a")
        for name in ("b", "c"):
            self.upload(server, "volumes", path, name)
        self.assertEqual(server.request("DELETE", "/v1/volumes/a").status, 204)
        self.assert_problem(server.get("/v1/volumes/a"), 404, "not_found")
        self.assertEqual(self.names(server, volume), ["b", "c"])
        for name in ("b", "c"):
            self.assertEqual(server.request("DELETE", "/v1/volumes/" + name).status, 204)
        self.assert_problem(server.get("/v1/volumes/" + volume), 404, "not_found")
        self.assertEqual(os.listdir(os.path.join(self.data, "volumes")), [])

    def test_deleting_by_id_takes_all_names(self):
        server = self.start()
        path = self.volume_file(2)
        volume = self.upload(server, "volumes", path, "a")
        self.upload(server, "volumes", path, "b")
        self.assertEqual(server.request("DELETE", "/v1/volumes/" + volume).status, 204)
        for reference in ("a", "b", volume):
            self.assert_problem(server.get("/v1/volumes/" + reference), 404, "not_found")
        # Nor do they come back with the file.
        self.assertEqual(self.upload(server, "volumes", path), volume)
        self.assertEqual(self.names(server, volume), [])

    def test_a_database_of_the_first_version(self):
        server = self.start()
        named = self.upload(server, "volumes", self.volume_file(2), "level")
        plain = self.upload(server, "volumes", self.volume_file(3))
        server.stop()
        path = os.path.join(self.data, "tetralight.db")
        with contextlib.closing(sqlite3.connect(path)) as database:
            files = database.execute("SELECT id, kind, bytes, created, facts FROM files").fetchall()
        os.remove(path)
        with contextlib.closing(sqlite3.connect(path)) as database:
            database.executescript(FIRST_SCHEMA)
            for file in files:
                database.execute(
                    "INSERT INTO files (id, kind, bytes, created, facts, name) VALUES (?,?,?,?,?,?)",
                    (*file, "level" if file[0] == named else ""))
            database.execute(
                "INSERT INTO bakes (id, request, arguments, name, priority, state, report, created) "
                "VALUES ('0123', '{}', '[]', '', 0, 'done', '{\"probes\": 7}', 1)")
            database.commit()
        again = self.start()
        bake = again.get("/v1/bakes/0123").json()
        self.assertEqual((bake["probes_done"], bake["probe_count"]), (7, 7))
        self.assertEqual(again.get("/v1/volumes/level").json()["id"], named)
        self.assertEqual(self.names(again, named), ["level"])
        self.assertEqual(self.names(again, plain), [])
        maps = self.upload(again, "lightmaps", self.lightmap_file(), "level")
        self.assertEqual(again.get("/v1/lightmaps/level").json()["id"], maps)
        cubes = self.upload(again, "reflections", self.reflection_file(), "level")
        self.assertEqual(again.get("/v1/reflections/level").json()["id"], cubes)

    def test_names_move(self):
        server = self.start()
        first = self.upload(server, "volumes", self.volume_file(2), "level")
        second = self.upload(server, "volumes", self.volume_file(3), "level")
        self.assertEqual(server.get("/v1/volumes/level").json()["id"], second)
        self.assertEqual(server.get(f"/v1/volumes/{first}").json()["name"], "")
        answer = server.request("PATCH", f"/v1/volumes/{first}", {"name": "level"})
        self.assertEqual(answer.json()["name"], "level")
        self.assertEqual(server.get("/v1/volumes/level").json()["id"], first)
        for bad in ("a/b", "x" * 201, "a\u0001", first):
            answer = server.request("PATCH", f"/v1/volumes/{first}", {"name": bad})
            self.assert_problem(answer, 400, "invalid_value")

    def test_lists_come_in_pages(self):
        server = self.start()
        ids = sorted(self.upload(server, "volumes", self.volume_file(n)) for n in (2, 3, 4))
        page = server.get("/v1/volumes?limit=2").json()
        self.assertEqual([v["id"] for v in page["volumes"]], ids[:2])
        rest = server.get("/v1/volumes?after=" + page["next"]).json()
        self.assertEqual([v["id"] for v in rest["volumes"]], ids[2:])
        self.assertIsNone(rest["next"])
        self.assert_problem(server.get("/v1/volumes?limit=0"), 400, "invalid_value")

    def test_deleted_files_are_gone(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file())
        self.assertEqual(server.request("DELETE", f"/v1/volumes/{volume}").status, 204)
        self.assert_problem(server.get(f"/v1/volumes/{volume}"), 404, "not_found")
        self.assert_problem(server.request("DELETE", f"/v1/volumes/{volume}"), 404, "not_found")
        self.assertEqual(os.listdir(os.path.join(self.data, "volumes")), [])

    def test_what_was_acknowledged_survives_kill_9(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(), "level")
        server.kill()
        open(os.path.join(self.data, "volumes", "0" * 32 + ".probes"), "w").write("torn upload")
        again = self.start()
        self.assertEqual(again.get("/v1/volumes/level").json()["id"], volume)
        self.assertEqual(len(again.get("/v1/volumes").json()["volumes"]), 1)
        self.assertEqual(len(os.listdir(os.path.join(self.data, "volumes"))), 1)

    def test_many_upload_at_once(self):
        server = self.start()
        paths = [self.volume_file(n) for n in (2, 3)]
        ids = []
        threads = [threading.Thread(
            target=lambda p=paths[i % 2]: ids.append(self.upload(server, "volumes", p, "same")))
            for i in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(set(ids)), 2)
        named = [v for v in server.get("/v1/volumes").json()["volumes"] if v["name"] == "same"]
        self.assertEqual(len(named), 1)


class Damage(VolumeTest):
    """A damaged file is put aside with its reason; the rest is served."""

    def test_a_damaged_volume(self):
        server = self.start()
        good = self.upload(server, "volumes", self.volume_file(2))
        bad = self.upload(server, "volumes", self.volume_file(3), "bad")
        server.stop()
        path = os.path.join(self.data, "volumes", bad + ".probes")
        size = os.path.getsize(path)
        with open(path, "r+b") as file:
            file.seek(size // 2)
            file.write(b"\xff" * 64)
        again = self.start()
        query = {"positions": [[0, 0, 0]]}
        problem = self.assert_problem(again.post(f"/v1/volumes/{bad}/query", query), 410,
                                      "quarantined")
        self.assertIn("checksum", problem["detail"])
        self.assertEqual(again.post(f"/v1/volumes/{good}/query", query).status, 200)
        self.assertEqual(again.get(f"/v1/volumes/{bad}").json()["state"], "quarantined")
        self.assertEqual(os.listdir(os.path.join(self.data, "quarantine")), [f"volumes-{bad}.probes"])
        self.assertIn("tetralight_quarantined_total 1", again.get("/metrics").body.decode())
        # It can come in again, and has its name still.
        self.assertEqual(self.upload(again, "volumes", self.volume_file(3)), bad)
        self.assertEqual(again.get("/v1/volumes/bad").json()["id"], bad)
        self.assertEqual(again.post(f"/v1/volumes/{bad}/query", query).status, 200)

    def test_a_missing_file(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file())
        server.stop()
        os.remove(os.path.join(self.data, "volumes", volume + ".probes"))
        again = self.start()
        self.assert_problem(again.get(f"/v1/volumes/{volume}/file"), 503, "unavailable")
        self.assertEqual(os.listdir(os.path.join(self.data, "quarantine")), [])

    def test_a_damaged_scene(self):
        server = self.start()
        scene = self.upload(server, "scenes", COURTYARD)
        with open(os.path.join(self.data, "scenes", scene + ".glb"), "r+b") as file:
            file.seek(5000)
            file.write(b"\xff" * 8)
        self.assert_problem(server.post("/v1/bakes", {"scene": scene}), 410, "quarantined")

    def test_a_damaged_database(self):
        server = self.start()
        volume = self.upload(server, "volumes", self.volume_file(), "level")
        self.upload(server, "volumes", self.volume_file(), "nightly")
        server.stop()
        database = os.path.join(self.data, "tetralight.db")
        for damage in (lambda f: f.write(b"\0" * 100), lambda f: (f.seek(4096), f.write(b"\xff" * 4096)),
                       lambda f: f.truncate(3000)):
            with open(database, "r+b") as file:
                damage(file)
            again = self.start()
            self.assertEqual(again.get("/v1/volumes/" + volume).json()["names"],
                             ["level", "nightly"])
            self.assertEqual(again.post("/v1/volumes/level/query", {"positions": [[0, 0, 0]]}).status,
                             200)
            self.assertIn("the database was damaged", read(again.log_path).decode())
            again.stop()
        aside = os.listdir(os.path.join(self.data, "quarantine"))
        self.assertTrue(any(name.endswith("tetralight.db") for name in aside))


class Downloads(VolumeTest):
    """Bytes that are served under an id have it."""

    def stored(self, kind, id, extension):
        return os.path.join(self.data, kind, id + extension)

    def damage_by_zeros(self, path):
        with open(path, "r+b") as file:
            file.seek(1000)
            file.write(bytes(100))

    def damage_by_cutting(self, path):
        os.truncate(path, os.path.getsize(path) - 1)

    def damage_by_replacing(self, path):
        with open(path + ".new", "wb") as file:
            file.write(b"x" * os.path.getsize(path))
        os.replace(path + ".new", path)

    def damage_with_the_old_time(self, path):
        before = os.stat(path)
        self.damage_by_zeros(path)
        os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))

    def check_damage(self, kind, path, extension, damage):
        server = self.start()
        id = self.upload(server, kind, path, "name")
        self.assertEqual(server.get(f"/v1/{kind}/{id}/file").body, read(path))
        damage(self.stored(kind, id, extension))
        for reference in (id, "name"):
            for headers in ({}, {"Range": "bytes=0-9"}, {"If-None-Match": f'"{id}"'}):
                answer = server.request("GET", f"/v1/{kind}/{reference}/file", headers=headers)
                self.assert_problem(answer, 410, "quarantined")
                self.assertNotIn("ETag", answer.headers)
        self.assertEqual(os.listdir(os.path.join(self.data, "quarantine")), [f"{kind}-{id}{extension}"])
        self.assertEqual(self.upload(server, kind, path), id)
        self.assertEqual(server.get(f"/v1/{kind}/name/file").body, read(path))
        server.stop()
        shutil.rmtree(self.data)

    def test_damaged_files_are_not_sent(self):
        for kind, path, extension in (("volumes", self.volume_file(3), ".probes"), ("scenes", COURTYARD, ".glb"),
                                      ("lightmaps", self.lightmap_file(), ".lightmaps"),
                                      ("reflections", self.reflection_file(), ".ktx2")):
            for damage in (self.damage_by_zeros, self.damage_by_cutting, self.damage_by_replacing,
                           self.damage_with_the_old_time):
                with self.subTest(kind=kind, damage=damage.__name__):
                    self.check_damage(kind, path, extension, damage)

    def server_with_bytes(self, data, *options):
        """A file of any bytes; the start takes it in."""
        os.makedirs(os.path.join(self.data, "scenes"), exist_ok=True)
        id = hashlib.sha256(data).hexdigest()
        path = self.stored("scenes", id, ".glb")
        with open(path, "wb") as file:
            file.write(data)
        long_ago = time.time() - 100
        os.utime(path, (long_ago, long_ago))
        return self.start(*options), id, path

    def read_bytes(self, server):
        """How much the server has read from files and sockets."""
        with open(f"/proc/{server.process.pid}/io") as file:
            return int(re.search(r"rchar: (\d+)", file.read())[1])

    def test_a_file_is_hashed_once_until_something_about_it_changes(self):
        server, id, path = self.server_with_bytes(os.urandom(8 << 20), "--recheck-seconds", "3600")
        time.sleep(3)  # a file that has just changed is not trusted
        get = lambda: server.get(f"/v1/scenes/{id}/file", Range="bytes=0-9").status
        self.assertEqual(get(), 206)
        before = self.read_bytes(server)
        self.assertEqual(get(), 206)
        self.assertLess(self.read_bytes(server) - before, 1 << 20)
        os.link(path, path + ".link")
        self.assertEqual(get(), 206)
        self.assertGreaterEqual(self.read_bytes(server) - before, 8 << 20)
        time.sleep(3)
        self.assertEqual(get(), 206)
        self.damage_with_the_old_time(path)
        self.assertEqual(get(), 410)

    def test_a_file_is_hashed_again_after_a_time(self):
        server, id, _ = self.server_with_bytes(os.urandom(8 << 20), "--recheck-seconds", "0.1")
        time.sleep(3)
        server.get(f"/v1/scenes/{id}/file", Range="bytes=0-9")
        before = self.read_bytes(server)
        time.sleep(0.2)
        server.get(f"/v1/scenes/{id}/file", Range="bytes=0-9")
        self.assertGreaterEqual(self.read_bytes(server) - before, 8 << 20)

    def test_a_file_that_is_written_to_while_it_is_sent_ends_early(self):
        server, id, path = self.server_with_bytes(os.urandom(64 << 20))
        connection = server.connect()
        connection.request("GET", f"/v1/scenes/{id}/file")
        response = connection.getresponse()
        received = len(response.read(65536))
        with open(path, "r+b") as file:
            file.seek(-1, os.SEEK_END)
            file.write(b"!")
        with self.assertRaises((http.client.IncompleteRead, ConnectionError)):
            while piece := response.read(1 << 20):
                received += len(piece)
            if received < 64 << 20:
                raise http.client.IncompleteRead(b"")
        connection.close()
        self.assert_problem(server.get(f"/v1/scenes/{id}/file"), 410, "quarantined")

    def test_a_file_that_is_deleted_while_it_is_sent_arrives(self):
        data = os.urandom(32 << 20)
        server, id, _ = self.server_with_bytes(data)
        connection = server.connect()
        connection.request("GET", f"/v1/scenes/{id}/file")
        response = connection.getresponse()
        self.assertEqual(server.request("DELETE", f"/v1/scenes/{id}").status, 204)
        self.assertTrue(response.read() == data)
        connection.close()
        self.assert_problem(server.get(f"/v1/scenes/{id}/file"), 404, "not_found")


class ReadOnly(VolumeTest):
    def test_replicas_answer_from_the_same_folder(self):
        writer = self.start()
        first = self.upload(writer, "volumes", self.volume_file(2), "level")
        reader = self.start("--read-only")
        query = {"positions": [[0.5, 0.5, 0.5]]}
        self.assertEqual(reader.post("/v1/volumes/level/query", query).body,
                         writer.post("/v1/volumes/level/query", query).body)
        self.assert_problem(reader.request("DELETE", f"/v1/volumes/{first}"), 403, "read_only")
        second = self.upload(writer, "volumes", self.volume_file(3), "level")
        self.upload(writer, "volumes", self.volume_file(3), "nightly")
        self.assertTrue(self.eventually(
            lambda: reader.get("/v1/volumes/nightly").status == 200))
        self.assertEqual(reader.get(f"/v1/volumes/{second}").json()["names"], ["level", "nightly"])
        self.assertEqual(reader.get("/v1/volumes/level").json()["id"], second)

    def test_a_damaged_index_changes_nothing(self):
        writer = self.start()
        volume = self.upload(writer, "volumes", self.volume_file(2), "level")
        reader = self.start("--read-only")
        index = os.path.join(self.data, "index.json")
        whole = read(index)
        size = re.compile(rb'"bytes":\d+')
        entry = json.loads(whole)["files"][0]
        damages = (whole[:-20], b"", b"{}", whole.replace(b'"id":"', b'"id":"/'),
                   size.sub(b'"bytes":-1', whole), size.sub(b'"bytes":"7"', whole),
                   size.sub(b'"bytes":1e300', whole), b'{"files": {}}', b'{"files": null}',
                   json.dumps({"files": [entry, entry]}).encode(),
                   json.dumps({"files": [{**entry, "facts": [1]}]}).encode(),
                   json.dumps({"files": [{**entry, "created": "now"}]}).encode())
        for count, damage in enumerate(damages, 1):
            with open(index, "wb") as file:
                file.write(damage)
            metric = f"tetralight_damaged_indexes_total {count}\n"
            # The list is read anew when it is asked for.
            self.assertTrue(self.eventually(
                lambda: reader.get("/v1/volumes/level").json()["id"] == volume
                and metric in reader.get("/metrics").body.decode()))
        for _ in range(3):
            time.sleep(1.1)
            self.assertEqual(reader.get("/v1/volumes/level").json()["id"], volume)
        self.assertEqual(read(reader.log_path).decode().count("index.json is damaged"), len(damages))
        with self.assertRaisesRegex(RuntimeError, "index.json: is damaged"):
            self.start("--read-only", data=shutil.copytree(self.data, self.data + "2"))
        second = self.upload(writer, "volumes", self.volume_file(3), "level")
        self.assertTrue(self.eventually(
            lambda: reader.get("/v1/volumes/level").json()["id"] == second))


if __name__ == "__main__":
    unittest.main()
