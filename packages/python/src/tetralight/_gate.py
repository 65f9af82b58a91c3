# SPDX-License-Identifier: Apache-2.0
"""Lets calls that read a volume run side by side, and calls that change it run alone."""
from __future__ import annotations

import threading


class Gate:
    """`enter` and `leave` surround a call that reads; `close` and `open` one that runs alone."""

    def __init__(self) -> None:
        self._condition = threading.Condition(threading.Lock())
        self._inside = 0
        self._is_closed = False

    def enter(self) -> None:
        with self._condition:
            while self._is_closed:
                self._condition.wait()
            self._inside += 1

    def leave(self) -> None:
        with self._condition:
            self._inside -= 1
            if self._inside == 0:
                self._condition.notify_all()

    def close(self) -> None:
        """Waits for calls that read, and keeps new ones waiting."""
        with self._condition:
            while self._is_closed:
                self._condition.wait()
            self._is_closed = True
            try:
                while self._inside > 0:
                    self._condition.wait()
            except BaseException:  # an interrupt: the call that would open the gate does not begin
                self._is_closed = False
                self._condition.notify_all()
                raise

    def open(self) -> None:
        with self._condition:
            self._is_closed = False
            self._condition.notify_all()
