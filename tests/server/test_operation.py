# SPDX-License-Identifier: Apache-2.0
"""What those who run the server see of it: its log, readiness and metrics."""
import http.client
import json
import os
import re
import shutil
import subprocess
import threading
import unittest

from faults import SHIM, Faults
from free_ports import free_ports
from service import COMMAND, COURTYARD, ServiceTest, lattice, write_groups


class Log(ServiceTest):
    def long_requests(self, server, count):
        """Requests whose lines of the log are long."""
        connection = server.connect()
        for _ in range(count):
            connection.request("GET", "/" + "x" * 8000)
            connection.getresponse().read()
        connection.close()

    def test_an_unread_pipe_delays_neither_requests_nor_the_end(self):
        server = self.start(stderr=subprocess.PIPE)
        self.long_requests(server, 300)  # more than the pipe and the server keep
        metrics = server.get("/metrics").body.decode()
        dropped = re.search(r"^tetralight_log_dropped_lines_total (\d+)$", metrics, re.M)
        self.assertGreater(int(dropped[1]), 0)
        self.assertEqual(server.get("/healthz").status, 200)
        self.assertEqual(server.stop(), 0)
        server.process.stderr.close()

    def test_dropped_lines_are_reported_once_the_pipe_is_read(self):
        server = self.start(stderr=subprocess.PIPE)
        self.long_requests(server, 300)
        lines = []
        for line in server.process.stderr:
            lines.append(json.loads(line))  # no line is torn
            if "dropped" in lines[-1]["message"]:
                break
        server.stop()
        lines += [json.loads(line) for line in server.process.stderr]
        server.process.stderr.close()
        reports = [line for line in lines if "dropped" in line["message"]]
        self.assertEqual([report["level"] for report in reports], ["warning"])
        written = sum(line["message"] == "request" for line in lines)
        self.assertEqual(written + reports[0]["count"], 300)
        self.assertEqual(lines[-1]["message"], "ended")

    def test_all_lines_are_in_the_log_at_the_end(self):
        server = self.start()
        for _ in range(50):
            server.get("/healthz")
        server.stop()
        logged = server.logged()
        self.assertEqual(sum(line["message"] == "request" for line in logged), 50)
        self.assertEqual(logged[-1]["message"], "ended")


class Readiness(ServiceTest):
    def assert_not_ready(self, server, words):
        """Soon: the server looks four times a second."""
        self.assertTrue(self.eventually(lambda: words in server.get("/readyz").body.decode()))
        self.assertEqual(server.get("/readyz").status, 503)
        self.assertIn("\ntetralight_ready 0\n", server.get("/metrics").body.decode())
        self.assertEqual(server.get("/healthz").status, 200)

    def assert_ready(self, server):
        self.assertTrue(self.eventually(lambda: server.get("/readyz").status == 200))

    def test_another_folder_under_the_same_path_is_not_ready(self):
        server = self.start()
        self.assertEqual(server.get("/readyz").status, 200)
        self.assertIn("\ntetralight_ready 1\n", server.get("/metrics").body.decode())
        aside = self.data + ".aside"
        os.rename(self.data, aside)
        self.assert_not_ready(server, "gone")
        os.mkdir(self.data)  # as an empty mount point
        self.assert_not_ready(server, "not the one")
        os.rmdir(self.data)
        shutil.copytree(aside, self.data)  # the same names in other files
        self.assert_not_ready(server, "not the one")
        shutil.rmtree(self.data)
        os.rename(aside, self.data)
        self.assert_ready(server)

    def test_without_its_database_a_server_is_not_ready(self):
        server = self.start()
        database = os.path.join(self.data, "tetralight.db")
        os.rename(database, database + ".aside")
        self.assert_not_ready(server, "the database is gone")
        shutil.copy(database + ".aside", database)
        self.assert_not_ready(server, "not the one")
        os.replace(database + ".aside", database)
        self.assert_ready(server)

    def test_each_folder_of_the_store_must_be_there(self):
        server = self.start()
        for name in ("scenes", "skies", "groups", "volumes", "lightmaps", "reflections", "bakes", "work", "quarantine"):
            folder = os.path.join(self.data, name)
            os.rename(folder, folder + ".aside")
            self.assert_not_ready(server, name + " cannot be written")
            with open(folder, "wb"):
                pass
            self.assert_not_ready(server, "Not a directory")
            os.remove(folder)
            os.rename(folder + ".aside", folder)
            self.assert_ready(server)

    def test_a_reader_needs_its_volumes(self):
        self.start()
        server = self.start("--read-only")
        folder = os.path.join(self.data, "volumes")
        os.rename(folder, folder + ".aside")
        self.assert_not_ready(server, "volumes cannot be read")
        os.rename(folder + ".aside", folder)
        self.assert_ready(server)

    @unittest.skipUnless(os.geteuid() == 0, "only root can start a server as another user")
    def test_each_folder_of_the_store_must_be_open_to_the_server(self):
        os.chmod(self.folder, 0o755)
        os.mkdir(self.data)
        os.chown(self.data, 65534, 65534)
        program = os.path.join(self.folder, "as_nobody")
        with open(program, "w", encoding="utf-8") as file:
            file.write(f'#!/bin/sh\nexec setpriv --reuid 65534 --regid 65534 --clear-groups "{COMMAND}" "$@"\n')
        os.chmod(program, 0o755)
        server = self.start(program=program)
        self.assertEqual(server.get("/readyz").status, 200)
        for mode in (0o000, 0o300, 0o500):
            os.chmod(os.path.join(self.data, "volumes"), mode)
            self.assert_not_ready(server, "volumes cannot be written: Permission denied")
        os.chmod(os.path.join(self.data, "volumes"), 0o700)
        self.assert_ready(server)

    def test_a_reader_is_ready_where_there_is_an_index(self):
        self.start()
        server = self.start("--read-only")
        self.assertEqual(server.get("/readyz").status, 200)
        aside = self.data + ".aside"
        os.rename(self.data, aside)
        self.assert_not_ready(server, "gone")
        os.mkdir(self.data)
        self.assert_not_ready(server, "index.json")
        os.rmdir(self.data)
        os.rename(aside, self.data)
        self.assert_ready(server)

    @unittest.skipUnless(SHIM, "sanitizers do not go with preloaded libraries")
    def test_a_disk_that_does_not_answer_stops_no_thread_of_the_network(self):
        groups = os.path.join(self.folder, "groups.json")
        write_groups(groups, lattice(2))
        self.command("tetrahedralize", groups, "-o", self.data + ".probes")
        os.mkdir(self.data)
        faults = Faults(self.data, self.folder)
        server = self.start("--threads", "1", env=faults.env)
        self.upload(server, "volumes", self.data + ".probes", "level")
        query = lambda: server.post("/v1/volumes/level/query", {"positions": [[0.5, 0.5, 0.5]]}).body
        light = query()
        faults.hang(True)
        try:
            self.assert_not_ready(server, "does not answer")
            for path in ("/healthz", "/metrics", "/v1/volumes/level", "/v1/bakes"):
                self.assertEqual(server.get(path).status, 200, path)
            self.assertEqual(query(), light)
        finally:
            faults.hang(False)
        self.assert_ready(server)


class StandardDescriptors(ServiceTest):
    def test_closed_ones_are_opened(self):
        for closed in ("<&-", ">&-", "2>&-", "<&- >&- 2>&-"):
            with self.subTest(closed=closed):
                port, = free_ports(1)
                process = subprocess.Popen(
                    ["sh", "-c", f'exec "$0" "$@" {closed}', COMMAND, "serve", "--data", self.data,
                     "--listen", f"127.0.0.1:{port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                self.addCleanup(process.kill)
                self.assertTrue(self.eventually(lambda: self.answers(port)))
                links = [os.readlink(f"/proc/{process.pid}/fd/{file}") for file in range(3)]
                self.assertFalse([link for link in links if "socket:" in link or self.data in link], links)
                process.terminate()
                self.assertEqual(process.wait(timeout=60), 0)

    @staticmethod
    def answers(port):
        try:
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
            connection.request("GET", "/healthz")
            return connection.getresponse().status == 200
        except OSError:
            return False
        finally:
            connection.close()


@unittest.skipUnless(SHIM, "sanitizers reserve more memory than the limits")
class Programs(ServiceTest):
    """Limits of the programs that read what clients upload."""

    def facts_of_a_program(self, *options):
        """The limits and the state of a program that draws a picture."""
        server = self.start(*options)
        order = self.order_of_hours(server)
        thread = threading.Thread(target=self.ask_and_lose, args=(server, order))
        thread.start()
        found = []

        def is_read():
            for child in server.children():
                try:
                    with open(f"/proc/{child}/limits") as limits, open(f"/proc/{child}/status") as state:
                        found[:] = [limits.read(), state.read()]
                except (FileNotFoundError, ProcessLookupError):
                    continue
            return found and re.search(r"^NoNewPrivs:\s+1$", found[1], re.M)

        self.assertTrue(self.eventually(is_read))
        server.kill()
        thread.join()
        return {match[1]: match[2]
                for match in re.finditer(r"^(Max [a-z ]+?)  +(\S+) ", found[0], re.M)}

    def ask_and_lose(self, server, order):
        try:
            server.post("/v1/render", order)
        except (ConnectionError, http.client.HTTPException):
            pass

    def test_programs_have_limits_that_options_set(self):
        limits = self.facts_of_a_program("--tool-address-space", "70000000000",
                                         "--tool-processor-seconds", "500")
        self.assertEqual(limits["Max address space"], "70000000000")
        self.assertEqual(limits["Max cpu time"], "500")
        self.assertEqual(limits["Max core file size"], "0")

    def test_programs_have_limits_without_options(self):
        limits = self.facts_of_a_program("--tool-seconds", "100", "--tool-threads", "3")
        self.assertGreaterEqual(int(limits["Max address space"]), 64 << 30)
        self.assertGreaterEqual(int(limits["Max cpu time"]), 300)

    def test_a_program_beyond_its_address_space_fails_alone(self):
        server = self.start("--tool-address-space", "90000000")
        with open(COURTYARD, "rb") as file:
            answer = server.post("/v1/scenes", file.read())
        self.assertIn(answer.status, (500, 503), answer.body)
        self.assertEqual(server.get("/healthz").status, 200)


REACH_PROBE = os.environ.get("TETRALIGHT_REACH_PROBE", "")


@unittest.skipUnless(REACH_PROBE, "sanitizers do not go with preloaded libraries")
class FilesOfPrograms(ServiceTest):
    """What programs that read uploads may open."""

    CAN_READ_OTHER_FILES, CAN_WRITE_THE_UPLOAD, CAN_WRITE_RESULTS = 1, 2, 4

    def test_programs_reach_their_own_files_only(self):
        secret = os.path.join(self.folder, "secret")
        with open(secret, "w", encoding="utf-8") as file:
            file.write("secret")
        server = self.start(env={"LD_PRELOAD": REACH_PROBE, "TETRALIGHT_REACH_FILE": secret})
        answer = server.post("/v1/volumes", b"any bytes")
        problem = self.assert_problem(answer, 500, "tool_failed")
        code = int(re.search(r"exit code (\d+)", problem["detail"])[1]) - 64
        self.assertTrue(code & self.CAN_WRITE_RESULTS)
        versions = lambda: [line["landlock"] for line in server.logged() if line["message"] == "serving"]
        self.assertTrue(self.eventually(versions))
        if versions() == [0]:
            self.skipTest("the kernel has no Landlock, as the log says")
        self.assertFalse(code & self.CAN_READ_OTHER_FILES)
        self.assertFalse(code & self.CAN_WRITE_THE_UPLOAD)


class MetricsOfRequests(ServiceTest):
    def value(self, server, name):
        found = re.search(rf"^tetralight_{re.escape(name)} (\S+)$",
                          server.get("/metrics").body.decode(), re.M)
        return float(found[1]) if found else None

    def assert_becomes(self, server, name, value):
        self.assertTrue(self.eventually(lambda: self.value(server, name) == value),
                        server.get("/metrics").body.decode())

    def test_requests_are_counted_by_method_and_status(self):
        server = self.start()
        server.get("/v1/scenes/a")
        server.request("PATCH", "/v1/scenes/a", {"name": "b"})
        server.request("DELETE", "/v1/scenes/a")
        server.request("BREW", "/v1/scenes/a")
        for method in ("GET", "PATCH", "DELETE"):
            self.assert_becomes(
                server, f'requests_total{{route="/v1/scenes/{{scene}}",method="{method}",status="404"}}', 1)
        self.assert_becomes(server, 'requests_total{route="none",method="other",status="405"}', 1)

    def test_waits_for_threads_are_counted(self):
        server = self.start()
        server.request("DELETE", "/v1/scenes/a")
        self.assert_becomes(server, 'queue_wait_seconds_count{route="/v1/scenes/{scene}"}', 1)
        server.get("/v1/scenes/a")  # needs no worker
        self.assertEqual(self.value(server, 'queue_wait_seconds_count{route="/v1/scenes/{scene}"}'), 1)

    def test_disk_build_and_last_bake_are_told(self):
        server = self.start()
        disk = os.statvfs(self.data)
        self.assertEqual(self.value(server, "disk_size_bytes"), disk.f_blocks * disk.f_frsize)
        self.assertGreater(self.value(server, "disk_free_bytes"), 0)
        self.assertEqual(self.value(server, "last_bake_timestamp_seconds"), 0)
        version = server.get("/version").json()["version"]
        self.assertRegex(server.get("/metrics").body.decode(),
                         rf'\ntetralight_build_info\{{version="{re.escape(version)}",[^}}]*\}} 1\n')
        self.upload(server, "scenes", COURTYARD, "court")
        groups = os.path.join(self.folder, "groups.json")
        write_groups(groups, lattice(2))
        self.upload(server, "groups", groups, "few")
        bake = server.post("/v1/bakes", {"scene": "court", "groups": ["few"], "samples": 8}).json()
        ended = server.wait_for(bake["id"])["ended"]
        self.assertAlmostEqual(self.value(server, "last_bake_timestamp_seconds"), ended, delta=1e-3)

    def test_alerts_and_the_dashboard_use_metrics_that_exist(self):
        types = dict(re.findall(r"^# TYPE (\S+) (\S+)$",
                                self.start().get("/metrics").body.decode(), re.M))
        names = set(types)
        for name, kind in types.items():
            if kind == "histogram":
                names |= {name + end for end in ("_bucket", "_sum", "_count")}
        folder = os.path.join(os.path.dirname(__file__), "..", "..", "docs", "monitoring")
        for file in ("alerts.yml", "dashboard.json"):
            with open(os.path.join(folder, file), encoding="utf-8") as opened:
                used = set(re.findall(r"tetralight_[a-z_]+", opened.read()))
            self.assertGreater(len(used), 5)
            self.assertLessEqual(used, names, file)
        with open(os.path.join(folder, "dashboard.json"), encoding="utf-8") as opened:
            panels = json.load(opened)["panels"]
        self.assertTrue(all(panel["targets"] for panel in panels))

    def test_each_name_has_one_head(self):
        text = self.start().get("/metrics").body.decode()
        names = re.findall(r"^# TYPE (\S+) ", text, re.M)
        self.assertEqual(len(names), len(set(names)))


if __name__ == "__main__":
    unittest.main()
