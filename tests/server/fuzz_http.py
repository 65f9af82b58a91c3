# SPDX-License-Identifier: Apache-2.0
"""Sends randomly changed requests to a real server.

    fuzz_http.py SECONDS [FIRST_SEED]

runs cases until the time is over and prints one JSON line. The first case that goes wrong ends it, with
its seed on stderr; `fuzz_http.py 0 SEED` runs that case alone. `./run fuzz http` builds the server with
sanitizers."""
import ast
import concurrent.futures
import glob
import json
import os
import re
import socket
import struct
import subprocess
import sys
import time
import unittest

import http_answers
from http_cases import Case, sound_requests
from service import BINARY, COMMAND, COURTYARD, ServiceTest, read, triangle_scene

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
CORPUS = os.path.join(ROOT, "tests", "fuzz", "corpus", "http")
THREADS = 8
# No request of the cases may take longer.
LONGEST = 40
OPTIONS = ("--header-seconds", "0.5", "--idle-seconds", "0.5", "--transfer-seconds", "0.5", "--tool-seconds",
           "10", "--max-bakes", "4", "--drain-seconds", "5")


def documented():
    """Statuses and their codes as docs/server.md lists them."""
    found = {}
    with open(os.path.join(ROOT, "docs", "server.md"), encoding="utf-8") as file:
        for statuses, codes in re.findall(r"^\| ((?:\d{3}(?:, )?)+) \| ((?:`\w+`(?:, )?)+) \|", file.read(), re.M):
            for status in re.findall(r"\d+", statuses):
                found.setdefault(int(status), set()).update(re.findall(r"\w+", codes))
    return found


def allowed():
    """Statuses with their codes. No case makes the disk fail, so that nothing else may."""
    with open(os.path.join(ROOT, "server", "openapi.json"), encoding="utf-8") as file:
        paths = json.load(file)["paths"]
    good = {int(status): set() for path in paths.values() for method in path.values() if "responses" in method
            for status in method["responses"] if status.isdigit()}
    return good | {status: codes for status, codes in documented().items() if status not in (500, 507)}


SKY = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + b"\x80\x80\x80\x81" * 2
GROUPS = b'{"groups": [{"name": "g", "positions": [[0,0,0],[1,0,0],[0,1,0],[0,0,1],[2,2,2]]}]}'


class FuzzedServer:
    """A server with one file of each kind, and what must be as before at the end."""

    def __init__(self, test):
        self.test = test
        self.server = test.start(*OPTIONS)
        groups, volume = (os.path.join(test.folder, name) for name in ("few.json", "level.probes"))
        with open(groups, "wb") as file:
            file.write(GROUPS)
        subprocess.run([COMMAND, "tetrahedralize", groups, "-o", volume, "--quiet"], check=True)
        self.files = {"volumes": read(volume), "groups": GROUPS, "scenes": triangle_scene(), "skies": SKY,
                      "lightmaps": read(test.lightmap_file()), "reflections": read(test.reflection_file())}
        self.names = {"volumes": "level", "groups": "few", "scenes": "court", "skies": "white",
                      "lightmaps": "floor", "reflections": "room"}
        self.sound = sound_requests(self.files)
        self.allowed = allowed()
        self.keep_files()
        self.descriptors = self.open_descriptors()

    def keep_files(self):
        """Cases may delete and rename what others need."""
        for kind, data in self.files.items():
            if self.server.get(f"/v1/{kind}/{self.names[kind]}").status == 200:
                continue
            answer = self.server.post(f"/v1/{kind}?name={self.names[kind]}", data, BINARY)
            assert answer.status in (200, 201, 503), answer.body

    def open_descriptors(self):
        return len(os.listdir(f"/proc/{self.server.process.pid}/fd"))

    def fault_of_case(self, seed):
        case = Case(seed, self.sound)
        try:
            fault = self.fault_of_bytes(case)
        except ConnectionRefusedError:
            fault = "the server does not accept connections"
        return f"seed {seed}: {fault}\n{case.pieces!r}" if fault else None

    def fault_of_bytes(self, case):
        received, has_ended = self.exchange(case)
        if received is None:
            return None
        try:
            answers = http_answers.read_answers(received, b"HEAD" in case.data.upper())
        except http_answers.Malformed as error:
            return f"{error}: {received[:500]!r}"
        except http_answers.Torn:
            # Who leaves early may get less; so may a stream whose reader leaves.
            is_complete = case.end == "wait" and b"text/event-stream" not in received
            return f"the connection ended within an answer: {received[-500:]!r}" if is_complete else None
        for answer in answers:
            if fault := self.fault_of_answer(answer):
                return fault
        return None if has_ended else f"the connection hangs: {received[-300:]!r}"

    def fault_of_answer(self, answer):
        if answer.status == 100 and not answer.headers:
            return None
        fault = http_answers.fault_of(answer, self.allowed)
        if fault is None and answer.headers.get("content-type") == "application/problem+json" and answer.body:
            code = json.loads(answer.body)["code"]
            if code not in self.allowed[answer.status]:
                fault = f"{answer.status} {code} is not documented"
        return fault

    def exchange(self, case):
        """What came back, and whether the connection ended or all that was expected came; None if the
        case does not look."""
        received = b""
        with socket.create_connection(("127.0.0.1", self.server.port), timeout=LONGEST) as connection:
            try:
                for piece in case.pieces:
                    connection.sendall(piece)
                    time.sleep(case.pause)
                if case.end == "reset":
                    connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                    return None, True
                if case.end == "half":
                    connection.shutdown(socket.SHUT_WR)
            except OSError:
                pass  # the server has closed
            try:
                while piece := connection.recv(1 << 20):
                    received += piece
                    if b"text/event-stream" in received or (case.leaves and self.has_all(case, received)):
                        return received, True
            except ConnectionError:
                pass
            except TimeoutError:
                return received, False
        return received, True

    @staticmethod
    def has_all(case, received):
        try:
            answers = http_answers.read_answers(received, b"HEAD" in case.data.upper())
        except (http_answers.Malformed, http_answers.Torn):
            return False
        return sum(answer.status >= 200 for answer in answers) >= case.count

    def fault_at_the_end(self):
        """What the cases have left."""
        server = self.server
        if not server.is_running():
            return f"the server ended: {server.process.returncode}"
        if server.get("/healthz").status != 200:
            return "/healthz fails"
        for bake in server.get("/v1/bakes?limit=1000").json()["bakes"]:
            server.post(f"/v1/bakes/{bake['id']}/cancel")
        if not self.test.eventually(lambda: not server.children(), seconds=60):
            return "programs are left"
        if not self.test.eventually(lambda: self.open_descriptors() <= self.descriptors + 1, seconds=20):
            folder = f"/proc/{server.process.pid}/fd"
            links = [os.readlink(os.path.join(folder, name)) for name in os.listdir(folder)]
            return f"{len(links)} descriptors instead of {self.descriptors}: {sorted(links)}"
        return self.fault_of_folder() or self.fault_of_end()

    def fault_of_folder(self):
        """Files that no list has."""
        data = self.server.data
        for folder in ("work", "bakes", "quarantine"):
            if not self.test.eventually(lambda: not os.listdir(os.path.join(data, folder))):
                return f"{folder} has {os.listdir(os.path.join(data, folder))}"
        for kind in self.files:
            known = {file["id"] for file in self.server.get(f"/v1/{kind}?limit=1000").json()[kind]}
            present = {name.split(".")[0] for name in os.listdir(os.path.join(data, kind))}
            if known != present:
                return f"{kind} has {present - known}, and lacks {known - present}"
        return None

    def fault_of_end(self):
        code = self.server.stop()
        with open(self.server.log_path, encoding="utf-8", errors="replace") as file:
            log = file.read()
        for line in log.splitlines():
            if not line.startswith("{") or json.loads(line)["level"] == "error":
                return f"the log has {line[:300]}\n{log[-3000:]}"
        return f"exit code {code}" if code != 0 else None


def corpus():
    """Requests that were answered wrongly once: NAME to (pieces, statuses). In a file, lines that begin
    with # are comments, `# status: 400 400` tells the answers; each other line is sent, with the
    escapes of Python."""
    cases = {}
    for path in sorted(glob.glob(os.path.join(CORPUS, "*.txt"))):
        with open(path, encoding="ascii") as file:
            lines = file.read().splitlines()
        statuses = [list(map(int, line.split(":")[1].split())) for line in lines if line.startswith("# status:")]
        pieces = [ast.literal_eval(f'b"""{line}"""') for line in lines if not line.startswith("#")]
        cases[os.path.basename(path)] = (pieces, statuses[0])
    return cases


def run_cases(fuzzed, seeds, is_over):
    """The number of cases, and the first fault."""
    count = 0
    with concurrent.futures.ThreadPoolExecutor(THREADS) as pool:
        while not is_over(count):
            batch = [next(seeds) for _ in range(THREADS * 8)]
            for fault in pool.map(fuzzed.fault_of_case, batch):
                count += 1
                if fault:
                    return count, fault
            fuzzed.keep_files()
    return count, None


class Alone(ServiceTest):
    """The folder and the servers of a run outside the tests."""

    def runTest(self):
        pass


def main(arguments):
    seconds, first = float(arguments[0]), int(arguments[1]) if len(arguments) > 1 else 1
    test = Alone()
    test.setUp()
    begin = time.monotonic()
    try:
        fuzzed = FuzzedServer(test)
        if seconds == 0:
            count, fault = 1, fuzzed.fault_of_case(first)
        else:
            count, fault = run_cases(fuzzed, iter(range(first, sys.maxsize)),
                                     lambda _: time.monotonic() - begin >= seconds)
        fault = fault or fuzzed.fault_at_the_end()
        if fault:
            sys.stderr.write(f"http: {fault}\n" + read(fuzzed.server.log_path).decode(errors="replace")[-3000:])
            return 1
    finally:
        test.tearDown()
    print(json.dumps({"name": "fuzz.http", "cases": count, "seconds": round(time.monotonic() - begin, 2),
                      "first_seed": first, "failures": 0}))
    return 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
