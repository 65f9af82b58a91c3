# SPDX-License-Identifier: Apache-2.0
"""What docs/server.md shows is what happens."""
import http.client
import json
import os
import re
import shutil
import socket
import subprocess
import threading
import unittest

from service import COMMAND, COURTYARD, Answer, ServiceTest, lattice, read, write_groups

DOCS = os.path.join(os.path.dirname(__file__), "..", "..", "docs", "server.md")


def block(language):
    """The page's lines in a language."""
    return re.search(rf"```{language}\n(.*?)```", open(DOCS).read(), re.S).group(1)


class Docs(ServiceTest):
    @unittest.skipUnless(shutil.which("curl"), "there is no curl")
    def test_the_walk(self):
        server = self.start()
        walk = block("sh").replace("127.0.0.1:8080", f"127.0.0.1:{server.port}")
        shutil.copy(COURTYARD, os.path.join(self.folder, "courtyard.glb"))
        # --json is younger than some curls.
        walk = walk.replace("--json", '-H "Content-Type: application/json" --data-binary')
        result = subprocess.run(["bash", "-euo", "pipefail", "-c", walk], cwd=self.folder,
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("event: end", result.stdout)
        self.assertIn('{"answers":[{"position":[0,1.5,0]', result.stdout.replace(".0,", ","))
        for name, magic in (("beam.vdb", b" BDV"), ("dusk.png", b"\x89PNG")):
            self.assertEqual(open(os.path.join(self.folder, name), "rb").read(4), magic)
        names = {volume["name"] for volume in server.get("/v1/volumes").json()["volumes"]}
        self.assertEqual(names, {"court", "dusk"})

    @unittest.skipUnless(shutil.which("haproxy"), "there is no haproxy")
    def test_behind_haproxy_a_reader_may_end_while_clients_query(self):
        token = {"TETRALIGHT_TOKEN": "many-secret-words"}
        writer = self.start(env=token)
        readers = [self.start("--read-only", "--drain-notice-seconds", "5", env=token)
                   for _ in range(2)]
        port = self.start_haproxy(writer, *readers)
        self.assertTrue(self.eventually(lambda: self.ask(port, "GET", "/readyz").status == 200))
        path = os.path.join(self.folder, "groups.json")
        write_groups(path, lattice(2))
        self.assertEqual(self.ask(port, "POST", "/v1/groups?name=few", read(path)).status, 201)
        self.assertEqual(self.ask(port, "POST", "/v1/tetrahedralize", json.dumps(
            {"groups": ["few"], "name": "few"}).encode()).status, 201)
        self.assertEqual(self.ask(port, "GET", "/metrics").status, 403)
        query_at = lambda at: self.ask(at, "POST", "/v1/volumes/few/query",
                                       b'{"positions":[[0,0,0]]}')
        query = lambda: query_at(port)
        self.assertTrue(self.eventually(lambda: all(
            query_at(reader.port).status == 200 for reader in readers)))
        statuses, is_over = [], threading.Event()

        def ask_on():
            while not is_over.is_set():
                statuses.append(query().status)

        askers = [threading.Thread(target=ask_on) for _ in range(4)]
        for asker in askers:
            asker.start()
        counted = 'request_duration_seconds_count{route="/v1/volumes/{volume}/query"'
        self.assertTrue(self.eventually(lambda: all(
            counted in self.ask(reader.port, "GET", "/metrics").body.decode()
            for reader in readers)))
        code = readers[0].stop()
        count = len(statuses)
        self.assertTrue(self.eventually(lambda: len(statuses) > count + 10))
        is_over.set()
        for asker in askers:
            asker.join()
        self.assertEqual(code, 0)
        self.assertEqual(set(statuses), {200})

    @unittest.skipUnless(shutil.which("haproxy"), "there is no haproxy")
    def test_behind_haproxy_programs_end_when_nobody_waits(self):
        writer = self.start()
        port = self.start_haproxy(writer, writer, writer)
        order = json.dumps(self.order_of_hours(writer)).encode()
        with socket.create_connection(("127.0.0.1", port)) as client:
            client.sendall(b"POST /v1/render HTTP/1.1\r\nHost: localhost\r\n"
                           b"Content-Length: %d\r\n\r\n" % len(order) + order)
            self.assertTrue(self.eventually(writer.children))
        self.assertTrue(self.eventually(lambda: not writer.children()))

    def ask(self, port, method, path, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
        connection.request(method, path, body, {"Host": "light.example.com",
                                                "Authorization": "Bearer many-secret-words"})
        response = connection.getresponse()
        answer = Answer(response, response.read())
        connection.close()
        return answer

    def start_haproxy(self, writer, *readers):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        config = re.sub("bind .*", f"bind 127.0.0.1:{port}", block("haproxy"))
        for i, server in enumerate((writer, *readers)):
            config = config.replace(f"10.0.0.{10 + i}:8080", f"127.0.0.1:{server.port}")
        path = os.path.join(self.folder, "haproxy.cfg")
        with open(path, "w") as file:
            file.write(config)
        proxy = subprocess.Popen(["haproxy", "-db", "-f", path], stderr=subprocess.DEVNULL)
        self.addCleanup(proxy.wait)
        self.addCleanup(proxy.kill)

        def is_up():
            try:
                return self.ask(port, "GET", "/healthz").status > 0
            except OSError:
                return False

        self.assertTrue(self.eventually(is_up))
        return port

    def test_the_help_names_every_option_of_the_page(self):
        help = subprocess.run([COMMAND, "serve", "--help"], capture_output=True, text=True).stdout
        own = re.sub(r"```.*?```", "", open(DOCS).read(), flags=re.S)
        for option in set(re.findall(r"`(--[a-z-]+)", own)):
            self.assertIn(option, help)


if __name__ == "__main__":
    unittest.main()
