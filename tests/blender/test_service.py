# SPDX-License-Identifier: Apache-2.0
"""Bakes by a real service, and by servers that are none."""
import hashlib
import http.server
import json
import os
import subprocess
import threading
import time

import bpy
from blender_test import TETRALIGHT, BlenderTest, add_lamp, add_plane, add_probes
from tetralight import operators
from tetralight.service import Service, ServiceError

TOKEN = "a-token-that-only-the-preferences-know"
PLACES = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (1, 2)]


class ServiceTest(BlenderTest):
    def setUp(self):
        super().setUp()
        add_plane()
        add_lamp("POINT", 100)
        add_probes(*PLACES)
        self.preferences.bake_with = "SERVICE"

    def use(self, address, token=""):
        self.preferences.address = address
        self.preferences.token = token

    def refused(self):
        self.output.write_bytes(b"old")
        error = self.refusal(bpy.ops.tetralight.bake)
        self.assertEqual(self.output.read_bytes(), b"old")
        self.assertIsNone(operators.running)
        self.assertNotIn(TOKEN, error)
        return error


class RealService(ServiceTest):
    """`tetralight serve` on a port of its own, with a token."""

    @staticmethod
    def stop(server):
        server.terminate()
        server.wait()
        server.stdout.close()

    def setUp(self):
        super().setUp()
        token_file = self.folder / "token"
        token_file.write_text(TOKEN)
        arguments = ["serve", "--data", str(self.folder / "data"), "--listen", "127.0.0.1:0",
                     "--token-file", str(token_file)]
        with open(self.folder / "log", "w") as log:
            server = subprocess.Popen([TETRALIGHT, *arguments], stdout=subprocess.PIPE, stderr=log, text=True)
        self.addCleanup(self.stop, server)
        line = server.stdout.readline()
        self.address = "http://127.0.0.1:" + line.rsplit(":", 1)[1].strip()
        self.use(self.address, TOKEN)
        self.service = Service(self.address, TOKEN)

    def test_the_volume_is_that_of_the_command(self):
        self.assertEqual(bpy.ops.tetralight.bake(), {"FINISHED"})
        of_service = self.output.read_bytes()
        self.preferences.bake_with = "COMMAND"
        bpy.ops.tetralight.bake()
        self.assertEqual(hashlib.sha256(of_service).digest(), hashlib.sha256(self.output.read_bytes()).digest())

    def test_names(self):
        self.settings.service_name = "hall & co"
        bpy.ops.tetralight.bake()
        for kind in ("scenes", "volumes"):
            stored, = self.service.get("/v1/" + kind)[kind]
            self.assertEqual(stored["name"], "hall & co")

    def test_probes_are_placed(self):
        bpy.ops.mesh.primitive_cube_add(size=4, location=(0, 0, 2))
        self.settings.places_probes = True
        self.settings.spacing = 3
        bpy.ops.tetralight.bake()
        self.assertGreater(self.info(self.output)["probes"], len(PLACES))

    def test_the_token_may_be_in_the_environment(self):
        self.use(self.address, "")
        os.environ["TETRALIGHT_TOKEN"] = TOKEN
        self.addCleanup(os.environ.pop, "TETRALIGHT_TOKEN")
        self.assertEqual(bpy.ops.tetralight.bake(), {"FINISHED"})

    def test_a_wrong_token(self):
        for token in ("wrong-token-of-the-right-length", ""):
            with self.subTest(token):
                self.use(self.address, token)
                self.assertIn("refuses the token: set it in the preferences", self.refused())

    def test_the_reason_of_a_failed_bake(self):
        bpy.data.lights["point"]["mode"] = "dim"
        self.assertIn('"dim"', self.refused())

    def test_cancelling_ends_the_bake_of_the_service(self):
        self.settings.samples = 16777216
        self.output.write_bytes(b"old")
        operators.start_bake(bpy.context)
        bake = operators.running.bake
        end = time.monotonic() + 300
        while bake.progress.fraction is None:
            self.assertLess(time.monotonic(), end, bake.progress)
            time.sleep(0.05)
        operators.cancel_bake()
        self.assertTrue(bake.is_over())
        self.assertFalse(bake.scene.parent.exists())
        self.assertEqual(self.output.read_bytes(), b"old")
        state = self.service.get("/v1/bakes")["bakes"][0]["state"]
        self.assertEqual(state, "cancelled")

    def test_the_token_is_in_no_blend_file(self):
        self.settings.service_name = "hall"
        bpy.ops.tetralight.bake()
        path = self.folder / "hall.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=False)
        data = path.read_bytes()
        self.assertEqual(data[:7], b"BLENDER")
        found = [text for text in ("service_name", TOKEN, self.address, TETRALIGHT) if text.encode() in data]
        self.assertEqual(found, ["service_name"])  # a setting of the scene


class Scripted(http.server.BaseHTTPRequestHandler):
    """Answers each request with what the test gave the server, and notes its headers."""

    def answer(self):
        self.rfile.read(int(self.headers.get("Content-Length", 0)))
        self.server.seen.append((self.command, self.path, dict(self.headers)))
        status, headers, body = self.server.answers(self.path)
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    do_GET = do_POST = answer

    def log_message(self, *arguments):
        pass


class OtherServers(ServiceTest):
    def serve(self, answers):
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Scripted)
        server.answers, server.seen = answers, []
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        self.use(f"http://127.0.0.1:{server.server_port}", TOKEN)
        return server

    def test_nobody_answers(self):
        self.use("http://127.0.0.1:1", TOKEN)
        self.assertIn("cannot be reached", self.refused())

    def test_addresses_that_are_wrong(self):
        for address in ("", "localhost:8080", "ftp://host", "http://", "http://host:port", "http://me:secret@host",
                        "http://host/?a=b", "file:///etc/passwd"):
            with self.subTest(address):
                self.use(address, TOKEN)
                self.assertIn("the address of the service", self.refused())

    def test_tokens_that_are_wrong(self):
        for token in ("two words", "line\nbreak", "é"):
            with self.subTest(token):
                with self.assertRaisesRegex(ServiceError, "characters that no token has"):
                    Service("http://127.0.0.1:1", token)

    def test_a_redirection_does_not_get_the_token(self):
        other = self.serve(lambda path: (200, {}, b"{}"))
        first = self.serve(lambda path: (302, {"Location": f"http://127.0.0.1:{other.server_port}/"}, b""))
        self.assertIn("redirects", self.refused())
        self.assertEqual(len(first.seen), 1)
        self.assertEqual(other.seen, [])

    def test_answers_of_other_programs(self):
        for body in (b"<html>", b"[]", b"{}", b'"text"', b""):
            with self.subTest(body):
                self.serve(lambda path: (200, {}, body))
                self.assertRegex(self.refused(), "(does|did) not answer as Tetralight does")

    def test_an_error_without_a_reason(self):
        self.serve(lambda path: (500, {}, b"<html>"))
        self.assertIn("status 500", self.refused())

    def test_a_volume_with_other_bytes(self):
        answers = {"/v1/scenes": {"id": "scene"}, "/v1/bakes": {"id": "bake"},
                   "/v1/bakes/bake": {"state": "done", "volume": "0" * 64}, f"/v1/volumes/{'0' * 64}/file": {}}
        self.serve(lambda path: (200, {}, json.dumps(answers[path]).encode()))
        self.assertIn("do not have its id", self.refused())

    def test_a_bake_survives_a_service_that_is_away(self):
        """503 and a broken answer, then the state."""
        asked = []

        def answers(path):
            if path != "/v1/bakes/bake":
                return 200, {}, json.dumps({"id": "bake"}).encode()
            asked.append(path)
            if len(asked) < 3:
                return 503, {}, b"{}"
            return 200, {}, b'{"state": "failed", "error": "the third wall is missing"}'

        self.serve(answers)
        self.assertIn("the third wall is missing", self.refused())
        self.assertEqual(len(asked), 3)

    def test_the_token_is_sent_to_the_service_as_a_header_only(self):
        server = self.serve(lambda path: (401, {}, b"{}"))
        self.assertIn("refuses the token", self.refused())
        (method, path, headers), = server.seen
        self.assertEqual((method, path, headers["Authorization"]), ("POST", "/v1/scenes", "Bearer " + TOKEN))
