# SPDX-License-Identifier: Apache-2.0
"""Runs the tasks of one call on several threads; calls of the library release the interpreter lock."""
from __future__ import annotations

import itertools
import os
import threading
from typing import Callable

from tetralight.errors import BadValue


def thread_count(threads: int | None) -> int:
    """What the caller chose, or the processors that this process may use."""
    if threads is None:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if threads < 1:
        raise BadValue(f"threads: expected at least 1, given {threads}")
    return threads


def parallel_for(count: int, task: Callable[[int], None], threads: int) -> None:
    """Calls task(0) .. task(count - 1). Returns when all are done, and raises the first exception."""
    if count <= 1 or threads <= 1:
        for i in range(count):
            task(i)
        return
    numbers = itertools.count()  # next() is one step of the interpreter: no number comes twice
    failures: list[BaseException] = []

    def work() -> None:
        try:
            for i in numbers:
                if i >= count or failures:
                    return
                task(i)
        except BaseException as failure:
            failures.append(failure)

    helpers = started(work, min(threads, count) - 1)
    work()
    for helper in helpers:
        while helper.is_alive():
            try:
                helper.join()
            except BaseException as failure:  # an interrupt: the memory is in use until all have ended
                failures.append(failure)
    if failures:
        raise failures[0]


def started(work: Callable[[], None], count: int) -> list[threading.Thread]:
    """As many threads as the system gives."""
    helpers: list[threading.Thread] = []
    for _ in range(count):
        helper = threading.Thread(target=work, daemon=True)
        try:
            helper.start()
        except RuntimeError:
            break
        helpers.append(helper)
    return helpers
