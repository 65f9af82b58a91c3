# SPDX-License-Identifier: Apache-2.0
"""Tests with the command: a folder for temporary files that must be empty at the end, and stand-ins for the command."""
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

COURTYARD = os.environ["TETRALIGHT_COURTYARD"]
SECONDS = 60


class CommandCase(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="tetralight_python_")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.temporary = self.folder / "temporary"
        self.temporary.mkdir()
        for patch in (mock.patch.object(tempfile, "tempdir", str(self.temporary)),
                      mock.patch.dict(os.environ, TMPDIR=str(self.temporary))):
            patch.start()
            self.addCleanup(patch.stop)

    def assert_nothing_is_left(self):
        """No temporary file, and no program that was started with one."""
        self.assertEqual(os.listdir(self.temporary), [])
        self.assertEqual(processes_with(str(self.temporary)), [])

    def program(self, text):
        """A stand-in for the command: a shell script that has no settings."""
        path = self.folder / "command"
        path.write_text('#!/bin/sh\n[ "$2" != --help ] || exit 0\n' + text)
        path.chmod(0o755)
        return path

    def python(self, text):
        """Another Python that runs a program, whose output is read line by line."""
        process = subprocess.Popen([sys.executable, "-c", text], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(end, process)
        return process

    def interrupt(self, process):
        """What Ctrl-C does to a program alone: its exit code and what it wrote."""
        process.send_signal(signal.SIGINT)
        _, messages = process.communicate(timeout=SECONDS)
        return process.returncode, messages

    def eventually(self, is_so):
        end_time = time.monotonic() + SECONDS
        while not is_so():
            self.assertLess(time.monotonic(), end_time, "it did not happen")
            time.sleep(0.02)


def end(process):
    if process.poll() is None:
        process.kill()
    process.communicate()


def processes_with(text):
    """Numbers of running processes whose command line contains a text."""
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            line = path.read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue  # it has ended
        if text in line and int(path.parent.name) != os.getpid():
            found.append(int(path.parent.name))
    return found
