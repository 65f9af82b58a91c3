# SPDX-License-Identifier: Apache-2.0
"""Runs the tasks of one call on several threads; calls of the library release the interpreter lock."""
from __future__ import annotations

import itertools
import os
import threading
import time
from typing import Callable

from tetralight._arguments import integer

SECONDS_BETWEEN_LOOKS = 0.0001


def thread_count(threads: int | None) -> int:
    """What the caller chose, or the processors that this process may use."""
    if threads is None:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return integer("threads", threads, 1)


def parallel_for(count: int, task: Callable[[int], None], threads: int) -> None:
    """Calls task(0) .. task(count - 1). Returns when all are done, and raises the first exception."""
    if count <= 1 or threads <= 1:
        for i in range(count):
            task(i)
        return
    numbers = itertools.count()  # next() is one step of the interpreter: no number comes twice
    failures: list[BaseException] = []
    working: set[object] = set()

    def work() -> None:
        worker = object()
        try:
            working.add(worker)
            for i in numbers:
                if i >= count or failures:
                    return
                task(i)
        except BaseException as failure:
            failures.append(failure)
        finally:
            working.discard(worker)

    is_begun = False
    while True:  # until no thread works: the memory is in use until then, also after an interrupt
        try:
            if not is_begun:
                is_begun = True
                start(work, min(threads, count) - 1)
                work()
            while working:
                time.sleep(SECONDS_BETWEEN_LOOKS)
            break
        except BaseException as failure:
            failures.append(failure)
    if failures:
        raise failures[0]


def start(work: Callable[[], None], count: int) -> None:
    """As many threads as the system gives. One that begins after the work finds no task, or the failure."""
    for _ in range(count):
        try:
            threading.Thread(target=work, daemon=True).start()
        except RuntimeError:
            break
