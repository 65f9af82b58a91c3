# SPDX-License-Identifier: Apache-2.0
"""HAProxy with the configuration of the docs, and clients that query through it."""
import csv
import http.client
import http.server
import os
import random
import re
import shutil
import signal
import socket
import socketserver
import subprocess
import tempfile
import threading
import time

from free_ports import free_ports
from service import BINARY, COMMAND, COURTYARD, Answer, ServiceTest, lattice, read, write_groups
from test_query import CELLS, FLOATS, OCCLUSION, binary_query

CONFIG = os.path.join(os.path.dirname(__file__), "..", "..", "docs", "haproxy.cfg")
TOKEN = {"TETRALIGHT_TOKEN": "many-secret-words"}
# The name of the service, which its clients use.
HEADERS = {"Host": "light.example.com", "Authorization": "Bearer many-secret-words"}
# So many that each reader serves some.
NAMES = [f"room{i}" for i in range(24)]


def has_haproxy():
    return shutil.which("haproxy") is not None


class Balancer:
    """HAProxy in front of a writer and of three readers, given by their ports."""

    def __init__(self, folder, writer_port, reader_ports):
        self.port, = free_ports(1)
        self.socket_path = os.path.join(folder, "haproxy.sock")
        text = read(CONFIG).decode()
        changes = [("bind :443 .*", f"bind 127.0.0.1:{self.port}"),
                   ("stats socket .* level admin", f"stats socket {self.socket_path} level admin")]
        ports = (writer_port, *reader_ports)
        changes += [(rf"10\.0\.0\.{10 + i}:8080", f"127.0.0.1:{port}") for i, port in enumerate(ports)]
        for pattern, replacement in changes:
            text, count = re.subn(pattern, replacement, text)
            assert count == 1, f"{CONFIG}: {pattern} is there {count} times"
        self.path = os.path.join(folder, "haproxy.cfg")
        self.text = text
        self.process = None
        self.write()

    def write(self):
        with open(self.path, "w") as file:
            file.write(self.text)

    def replace(self, old, new):
        assert self.text.count(old) == 1, old
        self.text = self.text.replace(old, new)
        self.write()

    def buffer_size(self):
        return int(re.search(r"tune\.bufsize (\d+)", self.text).group(1))

    def check(self):
        """What HAProxy says of the configuration."""
        return subprocess.run(["haproxy", "-c", "-f", self.path], capture_output=True, text=True)

    def start(self):
        self.process = subprocess.Popen(["haproxy", "-db", "-f", self.path], stderr=subprocess.DEVNULL)

    def stop(self):
        if self.process:
            self.process.kill()
            self.process.wait()

    def command(self, text):
        """The answer of the administration socket."""
        with socket.socket(socket.AF_UNIX) as connection:
            connection.connect(self.socket_path)
            connection.sendall(text.encode() + b"\n")
            answer = b""
            while piece := connection.recv(65536):
                answer += piece
        return answer.decode()

    def statistics(self):
        """Rows of `show stat` by backend and server."""
        lines = self.command("show stat").lstrip("# ").splitlines()
        return {(row["pxname"], row["svname"]): row for row in csv.DictReader(lines)}

    def are_up(self, *servers):
        """Whether HAProxy sends requests to these servers of the backend of readers."""
        try:
            rows = self.statistics()
        except OSError:  # not started yet
            return False
        return all(rows["readers", server]["status"] == "UP" for server in servers)

    def retries(self):
        row = self.statistics()["readers", "BACKEND"]
        return int(row["wretr"]) + int(row["wredis"])


def ask(port, method, path, body=None, content_type=BINARY):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    try:
        connection.request(method, path, body, {**HEADERS, "Content-Type": content_type})
        response = connection.getresponse()
        return Answer(response, response.read())
    finally:
        connection.close()


class Query:
    """A query of positions in binary form, and the bytes of its only right answer."""

    def __init__(self, writer_port, name, count, sh=FLOATS, wants=OCCLUSION | CELLS):
        generator = random.Random(f"{name} {count}")
        positions = [[generator.uniform(-1, 9) for _ in range(3)] for _ in range(count)]
        self.count = count
        self.path = f"/v1/volumes/{name}/query"
        self.body = binary_query(positions, sh, wants)
        answer = ask(writer_port, "POST", self.path, self.body)
        assert answer.status == 200, answer.body
        self.answer = answer.body

    def ask(self, connection):
        connection.request("POST", self.path, self.body, {**HEADERS, "Content-Type": BINARY})
        response = connection.getresponse()
        return response.status, response.read()


class Load:
    """Clients that ask all the time, each on connections that serve some queries."""

    def __init__(self, port, queries, clients=4, per_connection=50):
        self.port = port
        self.queries = queries
        self.per_connection = per_connection
        self.counts = [0] * clients
        self.failures = []
        self.is_over = threading.Event()
        self.threads = [threading.Thread(target=self.run, args=(i,)) for i in range(clients)]
        self.start = time.monotonic()
        for thread in self.threads:
            thread.start()

    def run(self, client):
        number = client
        while not self.is_over.is_set():
            connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=120)
            try:
                for _ in range(self.per_connection):
                    if self.is_over.is_set():
                        break
                    query = self.queries[number % len(self.queries)]
                    number += 1
                    self.counts[client] += 1
                    status, answer = query.ask(connection)
                    if status != 200:
                        raise ValueError(f"status {status}: {answer[:200]}")
                    if answer != query.answer:
                        raise ValueError("another answer than that of the writer")
            except Exception as error:  # whatever it is, this query failed
                self.failures.append(f"{time.monotonic() - self.start:.3f} s: {query.path}, "
                                     f"{len(query.body)} bytes: {error!r}")
            finally:
                connection.close()

    def count(self):
        return sum(self.counts)

    def stop(self):
        self.is_over.set()
        for thread in self.threads:
            thread.join()
        self.seconds = time.monotonic() - self.start


class DyingReader(socketserver.ThreadingTCPServer):
    """A reader that is always ready, and dies whenever it has received a query."""

    daemon_threads = True

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            self.send_response(200)
            self.end_headers()

        def do_POST(self):
            self.rfile.read(int(self.headers["Content-Length"]))
            self.server.killed += 1

        def log_message(self, *arguments):
            pass

    def __init__(self):
        super().__init__(("127.0.0.1", 0), self.Handler)
        self.killed = 0
        threading.Thread(target=self.serve_forever, daemon=True).start()


class ReplicaTest(ServiceTest):
    """A writer with volumes of different light, three readers, and HAProxy in front of them."""

    def setUp(self):
        super().setUp()
        self.writer = self.start("--log", "warning", env=TOKEN)
        self.store_volumes()
        self.readers = [self.start_reader(number) for number in range(3)]
        self.make_balancer([reader.port for reader in self.readers])

    def make_balancer(self, reader_ports):
        self.balancer = Balancer(self.folder, self.writer.port, reader_ports)
        self.addCleanup(self.balancer.stop)

    @classmethod
    def setUpClass(cls):
        cls.files = tempfile.mkdtemp(prefix="tetralight_replicas_")
        cls.addClassCleanup(shutil.rmtree, cls.files, ignore_errors=True)
        groups, baked = (os.path.join(cls.files, name) for name in ("groups.json", "baked.probes"))
        write_groups(groups, lattice(5, 2.0))
        run = lambda *arguments: subprocess.run([COMMAND, *arguments, "--quiet"], check=True)
        run("bake", COURTYARD, "-g", groups, "--only-given-groups", "--samples", "16", "-b", "1",
            "--layers", "sun", "-o", baked)
        for i, name in enumerate(NAMES):
            run("relight", baked, "-o", cls.file_of(name), "--weights", f"sun={i + 1}")

    @classmethod
    def file_of(cls, name):
        return os.path.join(cls.files, name + ".probes")

    def store_volumes(self):
        for name in NAMES:
            answer = ask(self.writer.port, "POST", "/v1/volumes?name=" + name, read(self.file_of(name)))
            self.assertEqual(answer.status, 201, answer.body)

    def start_reader(self, number, port=0):
        mount = f"{self.data}_of_reader{number + 1}"  # each has a log of its own beside it
        if not os.path.islink(mount):
            os.symlink(self.data, mount)
        return self.start("--read-only", "--drain-notice-seconds", "5", "--listen", f"127.0.0.1:{port}",
                          data=mount, env=TOKEN)

    def start_balancer(self):
        self.balancer.start()
        servers = ("reader1", "reader2", "reader3")
        self.assertTrue(self.eventually(lambda: self.balancer.are_up(*servers)))

    def stop_reader(self, number, signal_number=signal.SIGTERM):
        """Its exit code."""
        self.readers[number].process.send_signal(signal_number)
        code = self.readers[number].process.wait(timeout=60)
        self.readers[number].close()
        return code

    def restart_reader(self, number):
        """Waits until it is asked again."""
        self.readers[number] = self.start_reader(number, self.readers[number].port)
        self.assertTrue(self.eventually(lambda: self.queries_of(number) > 0, 60))

    def queries_of(self, number):
        """How many queries a reader has answered since its start."""
        text = ask(self.readers[number].port, "GET", "/metrics").body.decode()
        counts = re.findall(r'^tetralight_requests_total\{route="/v1/volumes/\{volume\}/query",.*\} (\d+)$',
                            text, re.M)
        return sum(map(int, counts))
