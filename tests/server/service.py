# SPDX-License-Identifier: Apache-2.0
"""A running server on a port of its own, and a client for it."""
import http.client
import json
import os
import shutil
import signal
import socket
import struct
import subprocess
import tempfile
import time
import unittest

COMMAND = os.environ["TETRALIGHT_COMMAND"]
COURTYARD = os.environ["TETRALIGHT_COURTYARD"]
BINARY = "application/octet-stream"
# How long a bake may take: it gives way to all other programs of the machine.
PATIENCE = 1200


class Answer:
    def __init__(self, response, body):
        self.status = response.status
        self.headers = response.headers
        self.body = body

    def json(self):
        return json.loads(self.body)


class Server:
    """`tetralight serve` on a folder; `kill` is what a power cut leaves of it."""

    def __init__(self, data, *options, env=None, program=COMMAND, stderr=None):
        self.data = data
        self.log_path = data + ".log"
        self.log = open(self.log_path, "a")
        listen = () if "--listen" in options else ("--listen", "127.0.0.1:0")
        self.process = subprocess.Popen(
            [program, "serve", "--data", data, *listen, *options],
            stdout=subprocess.PIPE, stderr=stderr or self.log, text=True, env={**os.environ, **(env or {})})
        line = self.process.stdout.readline()
        if not line:
            self.process.wait()
            raise RuntimeError("the server did not start: " + open(self.log_path).read()[-2000:])
        self.port = int(line.rsplit(":", 1)[1])

    def connect(self, timeout=60):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)

    def request(self, method, path, body=None, headers=None):
        headers = dict(headers or {})
        if isinstance(body, (dict, list)):
            body = json.dumps(body)
            headers.setdefault("Content-Type", "application/json")
        connection = self.connect()
        try:
            connection.request(method, path, body, headers)
            response = connection.getresponse()
            return Answer(response, response.read())
        finally:
            connection.close()

    def get(self, path, **headers):
        return self.request("GET", path, headers={k.replace("_", "-"): v for k, v in headers.items()})

    def post(self, path, body=None, content_type=None):
        return self.request("POST", path, body, {"Content-Type": content_type} if content_type else {})

    def raw(self, data, timeout=20, pause=0):
        """Sends bytes as they are; gives all that comes back until the server closes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=timeout) as connection:
            connection.settimeout(timeout)
            try:
                for piece in data if isinstance(data, list) else [data]:
                    connection.sendall(piece)
                    time.sleep(pause)
            except (BrokenPipeError, ConnectionResetError):
                pass
            answer = b""
            try:
                while piece := connection.recv(65536):
                    answer += piece
            except ConnectionResetError:
                pass
            return answer

    def children(self):
        """Programs that it runs."""
        found = []
        for task in os.listdir(f"/proc/{self.process.pid}/task"):
            with open(f"/proc/{self.process.pid}/task/{task}/children") as file:
                found += map(int, file.read().split())
        return found

    def logged(self):
        """Lines of the log so far; requests are gathered for a tenth of a second."""
        with open(self.log_path) as file:
            return [json.loads(line) for line in file.read().splitlines()]

    def wait_for(self, bake, seconds=PATIENCE):
        """A bake that is over."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            answer = self.get("/v1/bakes/" + bake).json()
            if answer["state"] not in ("queued", "running"):
                return answer
            time.sleep(0.05)
        raise AssertionError("the bake is not over: " + json.dumps(answer))

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        self.close()

    def stop(self, seconds=60):
        self.process.send_signal(signal.SIGTERM)
        code = self.process.wait(timeout=seconds)
        self.close()
        return code

    def close(self):
        self.process.stdout.close()
        self.log.close()

    def is_running(self):
        return self.process.poll() is None


class ServiceTest(unittest.TestCase):
    """Each test has a folder, and ends the servers that it began."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="tetralight_server_")
        self.data = os.path.join(self.folder, "data")
        self.servers = []

    @staticmethod
    def eventually(is_so, seconds=20):
        """Whether it becomes so."""
        end = time.monotonic() + seconds
        while not is_so():
            if time.monotonic() > end:
                return False
            time.sleep(0.02)
        return True

    def tearDown(self):
        for server in self.servers:
            if server.is_running():
                server.kill()
        shutil.rmtree(self.folder, ignore_errors=True)

    def start(self, *options, data=None, **more):
        server = Server(data or self.data, *options, **more)
        self.servers.append(server)
        return server

    def command(self, *arguments):
        return subprocess.run([COMMAND, *arguments], cwd=self.folder, check=True,
                              capture_output=True, text=True).stdout

    def lightmap_file(self, density=2):
        """Lightmaps of `triangle_scene` under a grey sky."""
        scene = os.path.join(self.folder, "triangle.glb")
        with open(scene, "wb") as file:
            file.write(triangle_scene())
        path = os.path.join(self.folder, f"maps{density}.lightmaps")
        self.command("lightmap", scene, "-o", path, "--texels-per-meter", str(density), "--page-size", "32",
                     "--samples", "16", "--sky", "1", "--layers", "sky")
        return path

    def reflection_file(self, sky=1):
        """The reflection probe of `room_scene` under a grey sky."""
        scene = os.path.join(self.folder, "room.glb")
        with open(scene, "wb") as file:
            file.write(room_scene())
        path = os.path.join(self.folder, f"room{sky}.ktx2")
        self.command("reflect", scene, "-o", path, "--cube-size", "8", "--samples", "1", "--sky", str(sky))
        return path

    def upload(self, server, kind, path, name=""):
        with open(path, "rb") as file:
            answer = server.post(f"/v1/{kind}?name={name}", file.read(), BINARY)
        self.assertIn(answer.status, (200, 201), answer.body)
        return answer.json()["id"]

    def refuse(self, server, kind, data):
        """The one error of an upload that leaves nothing behind."""
        problem = self.assert_problem(server.post(f"/v1/{kind}?name=bad", data, BINARY), 422, "bad_data")
        self.assertEqual(problem["field"], "body")
        # The folder of a request is deleted after its answer.
        self.assertTrue(self.eventually(lambda: os.listdir(os.path.join(self.data, "work")) == []))
        for folder in (kind, "quarantine"):
            self.assertEqual(os.listdir(os.path.join(self.data, folder)), [], problem)
        self.assertEqual(server.get("/v1/" + kind).json()[kind], [])
        return problem["detail"]

    def order_of_hours(self, server):
        """A picture that takes longer than any test."""
        self.upload(server, "scenes", COURTYARD, "court")
        groups = os.path.join(self.folder, "groups.json")
        write_groups(groups, lattice(2))
        with open(groups, "rb") as file:
            server.post("/v1/groups?name=few", file.read())
        server.post("/v1/tetrahedralize", {"groups": ["few"], "name": "few"})
        return {"scene": "court", "volume": "few", "width": 16384, "height": 16384, "antialias": 16}

    def assert_problem(self, answer, status, code):
        self.assertEqual(answer.status, status, answer.body[:500])
        self.assertEqual(answer.headers["Content-Type"], "application/problem+json")
        problem = answer.json()
        self.assertEqual(problem["code"], code, problem)
        self.assertEqual(problem["status"], status)
        return problem


def read(path):
    with open(path, "rb") as file:
        return file.read()


def write_groups(path, positions, name="group"):
    with open(path, "w") as file:
        json.dump({"groups": [{"name": name, "positions": positions}]}, file)


def lattice(count, spacing=1.0):
    return [[x * spacing, y * spacing, z * spacing]
            for x in range(count) for y in range(count) for z in range(count)]


def room_scene():
    """A triangle and a reflection probe above it."""
    probe = {"name": "room", "translation": [1, 1, 1], "extras": {"reflection_probe": {"size": [4, 3, 4]}}}
    return triangle_scene([probe])


def triangle_scene(more_nodes=()):
    """One triangle, and nodes without meshes, as binary glTF."""
    positions = struct.pack("<9f", 0, 0, 0, 4, 0, 0, 0, 0, 4)
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(1 + len(more_nodes)))}],
        "nodes": [{"mesh": 0}, *more_nodes],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [4, 0, 4]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}]}).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", 36, 0x004E4942) + positions
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
