# SPDX-License-Identifier: Apache-2.0
"""The client of the service, with a real `tetralight serve`."""
import contextlib
import hashlib
import http.server
import json
import os
import re
import shutil
import signal
import subprocess
import threading
import unittest
from pathlib import Path

import numpy

import tetralight
from command_case import COURTYARD, SECONDS, CommandCase, end

QUICK = {"samples": 16, "bounces": 1}
ENDLESS = {"samples": 16777216, "bounces": 4}
TOKEN = "0123456789abcdef0123456789abcdef"


class Server:
    """`tetralight serve` on a folder."""

    def __init__(self, folder, *options, port=0):
        self.log = open(folder / "server.log", "a")
        self.process = subprocess.Popen(
            [os.environ["TETRALIGHT_COMMAND"], "serve", "--data", folder / "data", "--listen", f"127.0.0.1:{port}",
             *options], stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.port = int(self.process.stdout.readline().rsplit(":", 1)[1])
        self.url = f"http://127.0.0.1:{self.port}"

    def stop(self):
        end(self.process)
        self.log.close()


class ServiceCase(CommandCase):
    def start(self, *options, port=0):
        server = Server(self.folder, *options, port=port)
        self.addCleanup(server.stop)
        return server

    def client(self, *options, **more):
        self.server = self.start(*options)
        return tetralight.Client(self.server.url, **more)

    def volume_file(self, *options):
        path = self.folder / f"volume{len(os.listdir(self.folder))}.probes"
        tetralight.bake(COURTYARD, output=path, **QUICK)
        return path

    def assert_problem(self, kind, code, field, call):
        with self.assertRaises(kind) as caught:
            call()
        self.assertEqual((caught.exception.code, caught.exception.field), (code, field), caught.exception)
        self.assertIn("127.0.0.1", str(caught.exception))
        return caught.exception


class Bakes(ServiceCase):
    def test_gives_the_volume_of_the_command(self):
        client = self.client()
        seen = []
        bake = client.bake(Path(COURTYARD), name="court", **QUICK)
        volume = bake.wait(progress=lambda fraction, text: seen.append(fraction))
        self.assertEqual(client.download("court"), self.volume_file().read_bytes())
        self.assertEqual(volume.probe_count, bake.facts["probe_count"])
        self.assertEqual((bake.state, seen[-1]), ("done", 1.0))
        self.assertEqual([entry["names"] for entry in client.scenes()], [["court"]])
        self.assertEqual([entry["id"] for entry in client.volumes()], [bake.facts["volume"]])
        self.assertEqual([other.id for other in client.bakes()], [bake.id])
        numpy.testing.assert_array_equal(client.open("court").positions, volume.positions)
        self.assert_nothing_is_left()

    def test_positions_are_all_its_probes(self):
        client = self.client()
        positions = numpy.array([[x, 1.0, z] for x in (-1.0, 1.5) for z in (3.0, 5.0, 6.25)])
        volume = client.bake(COURTYARD, positions=positions, **QUICK).wait()
        self.assertEqual(sorted(numpy.asarray(volume.positions).tolist()), sorted(positions.tolist()))
        again = client.bake(client.scenes()[0]["id"], groups={"few": positions}, only_given_groups=True, **QUICK)
        numpy.testing.assert_array_equal(again.wait().positions, volume.positions)
        self.assert_nothing_is_left()

    def test_is_cancelled(self):
        client = self.client()
        bake = client.bake(COURTYARD, **ENDLESS)
        with self.assertRaises(TimeoutError):
            bake.wait(timeout=0.1)
        bake.cancel()
        self.assertEqual(bake.state, "cancelled")
        bake.cancel()  # is over
        with self.assertRaises(tetralight.Cancelled):
            bake.wait()
        with self.assertRaises(tetralight.Cancelled):
            client.bakes()[0].volume()

    def test_is_not_over(self):
        bake = self.client().bake(COURTYARD, **ENDLESS)
        with self.assertRaises(tetralight.Unavailable) as caught:
            bake.volume()
        self.assertEqual(caught.exception.code, "not_over")

    def test_fails_with_the_reason_of_the_service(self):
        client = self.client()
        bake = client.bake(COURTYARD, **ENDLESS)

        def is_killed():
            for path in Path(f"/proc/{self.server.process.pid}/task").glob("*/children"):
                with contextlib.suppress(OSError):  # a thread or a program that has ended
                    for child in path.read_text().split():
                        os.kill(int(child), signal.SIGKILL)
            return bake.look().is_over

        self.eventually(is_killed)
        with self.assertRaises(tetralight.Error) as caught:
            bake.wait()
        self.assertEqual(caught.exception.code, "bake_failed")
        self.assertIn(bake.facts["error"], str(caught.exception))

    def test_unknown_settings_suggest_the_nearest(self):
        with self.assertRaisesRegex(TypeError, "did you mean 'samples'"):
            self.client().bake(COURTYARD, sample=3)

    def test_wrong_orders_name_the_setting(self):
        client = self.client()
        scene = client.upload("scenes", Path(COURTYARD))
        self.assert_problem(tetralight.BadValue, "invalid_value", "samples", lambda: client.bake(scene, samples=0))
        self.assert_problem(tetralight.BadValue, "bad_data", "layers[0]", lambda: client.bake(scene, layers=["none"]))
        self.assert_problem(tetralight.NotFound, "not_found", "scene", lambda: client.bake("none", **QUICK))
        with self.assertRaises(tetralight.BadValue):
            client.bake(scene, samples=numpy.nan)
        with self.assertRaises(tetralight.BadValue):
            client.bake(scene, positions=[[0, numpy.inf, 0]])
        self.assertEqual(client.bakes(), [])

    def test_ctrl_c_ends_the_wait_and_not_the_bake(self):
        client = self.client()
        process = self.python(
            f"import tetralight\nbake = tetralight.Client({self.server.url!r}).bake({COURTYARD!r}, samples=16777216)\n"
            "bake.wait(progress=lambda fraction, text: print(fraction, flush=True))")
        self.assertNotEqual(process.stdout.readline(), "")
        code, messages = self.interrupt(process)
        self.assertEqual((code, messages.strip().splitlines()[-1]), (-2, "KeyboardInterrupt"))
        (bake,) = client.bakes()
        self.assertFalse(bake.is_over)
        self.assert_nothing_is_left()


class Queries(ServiceCase):
    def setUp(self):
        super().setUp()
        self.path = self.volume_file()
        self.remote = self.client()
        self.remote.upload("volumes", self.path, "court")
        self.local = tetralight.open(self.path)
        self.positions = numpy.random.default_rng(1).uniform(-12, 12, (4, 250, 3))

    def test_are_those_of_the_library(self):
        for settings in ({}, {"format": "packed"}, {"format": "half"}, {"outside": "clamp"}, {"walls": "ignore"},
                         {"outside": "ambient", "fade_distance": 2.0}):
            with self.subTest(settings=settings):
                here = self.local.query(self.positions.astype(numpy.float32), **settings)
                there = self.remote.query("court", self.positions, **settings)
                numpy.testing.assert_array_equal(there.sh, here.sh)
                numpy.testing.assert_array_equal(there.occlusion, here.occlusion)
                self.assertEqual((there.sh.dtype, there.cells.shape), (here.sh.dtype, (4, 250)))
        normals = numpy.array([0.0, 1.0, 0.0])
        numpy.testing.assert_array_equal(self.remote.query("court", self.positions).irradiance(normals),
                                         self.local.query(self.positions).irradiance(normals))

    def test_many_positions_are_sent_in_parts(self):
        tetralight.client.POSITIONS_AT_ONCE, before = 300, tetralight.client.POSITIONS_AT_ONCE
        self.addCleanup(setattr, tetralight.client, "POSITIONS_AT_ONCE", before)
        there = self.remote.query("court", self.positions)
        numpy.testing.assert_array_equal(there.sh, self.local.query(self.positions).sh)

    def test_none_and_one_position(self):
        self.assertEqual(self.remote.query("court", numpy.empty((0, 3))).sh.shape, (0, 9, 3))
        self.assertEqual(self.remote.query("court", [0, 1, 0]).sh.shape, (9, 3))

    def test_wrong_arguments_are_refused_before_they_are_sent(self):
        bad = self.positions.copy()
        bad[1, 3, 2] = numpy.nan
        for field, positions, settings in (
                ("positions[253]", bad, {}), ("positions", [[1, 2]], {}), ("positions", 3, {}),
                ("positions", [["a", "b", "c"]], {}), ("positions[0]", [[1e300, 0, 0]], {}),
                ("format", [[0, 0, 0]], {"format": "double"}), ("outside", [[0, 0, 0]], {"outside": "none"}),
                ("fade_distance", [[0, 0, 0]], {"fade_distance": -1})):
            with self.subTest(field=field), self.assertRaises(tetralight.BadValue) as caught:
                self.remote.query("court", positions, **settings)
            self.assertEqual(caught.exception.field, field)

    def test_problems_of_the_service(self):
        position = [[0, 1, 0]]
        self.assert_problem(tetralight.NotFound, "not_found", "volume", lambda: self.remote.query("none", position))


class Files(ServiceCase):
    def test_come_back_as_they_were(self):
        client, path = self.client(), self.volume_file()
        data = path.read_bytes()
        identity = client.upload("volumes", path)
        self.assertEqual(identity, hashlib.sha256(data).hexdigest())
        self.assertEqual(client.upload("volumes", data, "a b c?"), identity)
        self.assertEqual([client.download(identity), client.download("a b c?")], [data, data])
        client.delete("volumes", "a b c?")
        self.assertEqual(client.volumes(), [])

    def test_lists_have_more_than_one_page(self):
        client = self.client()
        paths = [json.dumps({"groups": [{"name": "a", "positions": [[i, 0, 0]]}]}).encode() for i in range(3)]
        identities = {client.upload("groups", data) for data in paths}
        get = client._service.get
        client._service.get = lambda path: get(path + ("&" if "?" in path else "?") + "limit=1")
        self.assertEqual({entry["id"] for entry in client.files("groups")}, identities)

    def test_damaged_and_too_large_uploads(self):
        client = self.client("--max-upload", "1000000")
        self.assert_problem(tetralight.BadValue, "bad_data", "body", lambda: client.upload("volumes", b"nothing"))
        self.assert_problem(tetralight.BadValue, "too_large", "body", lambda: client.upload("volumes", bytes(20_000_000)))
        with self.assertRaises(tetralight.Unavailable):
            client.upload("volumes", self.folder / "none")
        with self.assertRaises(tetralight.BadValue):
            client.upload("rooms", b"")


class Access(ServiceCase):
    def test_tokens(self):
        token = self.folder / "token"
        token.write_text(TOKEN)
        client = self.client("--token-file", token, token=TOKEN)
        self.assertEqual(client.volumes(), [])
        self.assertNotIn(TOKEN, repr(client))
        for wrong in (None, "f" * 32):
            self.assert_problem(tetralight.Error, "unauthorized", "authorization",
                                lambda: tetralight.Client(client.url, wrong).volumes())
        with self.assertRaises(tetralight.BadValue) as caught:
            tetralight.Client(client.url, "secret\nsecret")
        self.assertNotIn("secret", str(caught.exception))

    def test_addresses(self):
        for url in ("127.0.0.1", "ftp://127.0.0.1", "http://", "http://a:b@127.0.0.1", "http://127.0.0.1:x", ""):
            with self.assertRaises(tetralight.BadValue) as caught:
                tetralight.Client(url)
            self.assertEqual(caught.exception.field, "url")


class Page(ServiceCase):
    def test_its_code_runs(self):
        page = Path(__file__).resolve().parents[2] / "docs/python.md"
        blocks = re.findall(r"^```py\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
        self.assertEqual(len(blocks), 2)
        shutil.copyfile(COURTYARD, self.folder / "courtyard.glb")
        url = self.client().url
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder)
        names = {"tetralight": tetralight}
        for block in blocks:
            exec(compile(block.replace("http://127.0.0.1:8080", url), str(page), "exec"), names)
        self.assertEqual(names["volume"].probe_count, tetralight.bake(COURTYARD, **QUICK).probe_count)
        self.assertEqual(names["light"].sh.shape, (2, 9, 3))
        self.assert_nothing_is_left()


class ServersThatGo(ServiceCase):
    def test_a_bake_survives_a_restart(self):
        client = self.client(retry_seconds=SECONDS)
        settings = {"samples": 2048, "bounces": 4}
        expected = tetralight.bake(COURTYARD, **settings)
        bake = client.bake(COURTYARD, **settings)
        self.eventually(lambda: bake.look().state != "queued")
        self.server.process.kill()
        self.server.process.wait()
        again = threading.Timer(0.5, lambda: self.start(port=self.server.port))
        again.start()
        self.addCleanup(again.join)
        numpy.testing.assert_array_equal(numpy.asarray(bake.wait().irradiance), numpy.asarray(expected.irradiance))

    def test_one_that_stays_away_is_one_error(self):
        client = self.client(retry_seconds=0.3)
        bake = client.bake(COURTYARD, **ENDLESS)
        self.server.process.kill()
        self.server.process.wait()
        for call in (bake.wait, bake.cancel, client.volumes, lambda: client.query("court", [[0, 0, 0]]),
                     lambda: client.bake("court"), lambda: client.upload("scenes", b"x")):
            with self.assertRaises(tetralight.Unavailable) as caught:
                call()
            self.assertIn("cannot be reached", str(caught.exception))
        self.assert_nothing_is_left()


class Answers(CommandCase):
    """Answers that Tetralight does not give, or not at once."""

    def client_of(self, *answers, **settings):
        """`answers`: functions of a handler, the last of which answers all later requests."""
        self.requests = []
        case = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def answer(self):
                case.requests.append(self.command + " " + self.path)
                self.rfile.read(int(self.headers.get("Content-Length", 0)))
                answers[min(len(case.requests), len(answers)) - 1](self)

            do_GET = do_POST = answer

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        self.addCleanup(thread.join)
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        return tetralight.Client(f"http://127.0.0.1:{server.server_port}", **{"retry_seconds": 5, **settings})

    def test_busy_services_are_asked_again(self):
        client = self.client_of(problem(503), problem(503), ok({"id": "x"}))
        self.assertEqual(client._service.post("/v1/bakes", {}), {"id": "x"})
        self.assertEqual(len(self.requests), 3)

    def test_a_wait_that_is_too_long_is_an_error(self):
        client = self.client_of(problem(503, {"Retry-After": "100"}))
        with self.assertRaises(tetralight.Unavailable) as caught:
            client.volumes()
        self.assertEqual((caught.exception.code, caught.exception.report["retry_after"]), ("busy", 100))
        self.assertEqual(len(self.requests), 1)

    def test_a_lost_answer_is_asked_for_again(self):
        client = self.client_of(short, close, ok({"volumes": [{"id": "x"}], "next": None}))
        self.assertEqual(client.volumes(), [{"id": "x"}])

    def test_an_order_whose_answer_is_lost_is_not_repeated(self):
        client = self.client_of(close)
        with self.assertRaises(tetralight.Unavailable):
            client._service.post("/v1/bakes", {})
        self.assertEqual(len(self.requests), 1)

    def test_other_answers(self):
        for answer, code in ((ok([]), "bad_answer"), (text(200, b"<html>"), "bad_answer"), (text(200, b"{"), "bad_answer"),
                             (text(404, b"<html>"), "bad_answer"), (text(302, b""), "bad_answer"),
                             (text(500, b"[]"), "bad_answer")):
            with self.assertRaises(tetralight.Error) as caught:
                self.client_of(answer).volumes()
            self.assertEqual(caught.exception.code, code)
        for answer in (text(200, b""), text(200, b"TLA1" + bytes(12)), text(200, b"x" * 1000)):
            with self.assertRaises(tetralight.Error) as caught:
                self.client_of(answer).query("a", [[0, 0, 0]])
            self.assertEqual(caught.exception.code, "bad_answer")

    def test_wrong_bytes_of_a_file(self):
        with self.assertRaises(tetralight.Corrupt):
            self.client_of(text(200, b"other bytes")).download("0" * 64)

    def test_no_answer_is_an_error_after_the_timeout(self):
        release = threading.Event()
        client = self.client_of(lambda handler: release.wait(SECONDS), timeout=0.2, retry_seconds=0)
        with self.assertRaises(tetralight.Unavailable):
            client.volumes()
        release.set()


def text(status, body, headers=None):
    def answer(handler):
        handler.send_response(status)
        for name, value in (headers or {}).items():
            handler.send_header(name, value)
        handler.send_header("Content-Length", str(len(body)))
        handler.end_headers()
        handler.wfile.write(body)

    return answer


def ok(value):
    return text(200, json.dumps(value).encode())


def problem(status, headers=None):
    body = json.dumps({"status": status, "code": "busy", "detail": "too many requests wait"}).encode()
    return text(status, body, {"Retry-After": "0", **(headers or {})})


def short(handler):
    handler.send_response(200)
    handler.send_header("Content-Length", "1000")
    handler.end_headers()
    handler.wfile.write(b"{")


def close(handler):
    handler.close_connection = True
    handler.connection.close()


if __name__ == "__main__":
    unittest.main()
