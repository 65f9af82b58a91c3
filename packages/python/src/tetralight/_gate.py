# SPDX-License-Identifier: Apache-2.0
"""Lets calls that read a volume run side by side, and calls that change it run alone."""
from __future__ import annotations

import threading
import time
from typing import Callable, TypeVar

Result = TypeVar("Result")

SECONDS_BETWEEN_LOOKS = 0.0005


class Gate:
    """KeyboardInterrupt can come between any two steps of the interpreter. What must not be left undone is
    therefore one step each: adding to a set, removing from it, and assigning. A condition variable has
    several: an interrupt between them would block all later calls."""

    def __init__(self) -> None:
        self._readers: set[object] = set()
        self._is_closed = False
        self._turn = threading.Lock()  # of calls that run alone

    def run(self, work: Callable[[], Result]) -> Result:
        """Runs a call that reads."""
        reader = object()
        try:
            self._readers.add(reader)
            # A call that runs alone closes the gate before it looks at the readers, so that one of both
            # sees the other.
            if self._is_closed:
                self._readers.discard(reader)
                with self._turn:
                    self._readers.add(reader)
            return work()
        finally:
            self._readers.discard(reader)

    def run_alone(self, work: Callable[[], Result]) -> Result:
        """Runs a call once no other runs. New ones wait."""
        with self._turn:
            try:
                self._is_closed = True
                while self._readers:
                    time.sleep(SECONDS_BETWEEN_LOOKS)
                return work()
            finally:
                self._is_closed = False
