# SPDX-License-Identifier: Apache-2.0
"""The test's side of tests/support/fault_shim.h: which system call fails, and what was recorded."""
import errno
import mmap
import os
import struct

# Empty if the build has sanitizers.
SHIM = os.environ.get("TETRALIGHT_FAULT_SHIM", "")
CALLS = ("open", "read", "write", "sync", "rename", "unlink", "truncate", "map", "accept", "fork",
         "link", "mkdir")
SHORT = 0xFFFF
# What each call may fail with.
ERRORS = {
    "open": (errno.EIO, errno.EMFILE, errno.EACCES, errno.ESTALE, errno.ENOSPC, errno.EINTR),
    "read": (errno.EIO, errno.ESTALE, errno.EINTR),
    "write": (errno.EIO, errno.ENOSPC, errno.ESTALE, errno.EINTR, SHORT),
    "sync": (errno.EIO, errno.ENOSPC, errno.ESTALE),
    "rename": (errno.EIO, errno.ENOSPC, errno.EACCES, errno.ESTALE),
    "unlink": (errno.EIO, errno.EACCES, errno.ESTALE),
    "truncate": (errno.EIO, errno.ENOSPC, errno.ESTALE, errno.EINTR),
    "map": (errno.ENOMEM, errno.EACCES),
    "accept": (errno.EMFILE, errno.ECONNABORTED, errno.EINTR),
    "fork": (errno.EAGAIN, errno.ENOMEM),
    "link": (errno.EIO, errno.ENOSPC, errno.EMLINK),
    "mkdir": (errno.EIO, errno.ENOSPC, errno.EACCES),
}


def error_name(error):
    return "SHORT" if error == SHORT else errno.errorcode[error]


class Faults:
    """The state that all processes under test share."""

    def __init__(self, root, folder, with_log=False):
        state, self.log = os.path.join(folder, "fault.state"), os.path.join(folder, "fault.log")
        size = 4 * (7 + len(CALLS))
        with open(state, "wb") as file:
            file.write(bytes(size))
        with open(state, "r+b") as file:
            self.memory = mmap.mmap(file.fileno(), size)
        self.env = {"LD_PRELOAD": SHIM, "TETRALIGHT_FAULT_ROOT": root,
                    "TETRALIGHT_FAULT_STATE": state}
        if with_log:
            self.env["TETRALIGHT_FAULT_LOG"] = self.log

    def _set(self, index, value):
        self.memory[4 * index:4 * index + 4] = struct.pack("<I", value)

    def _get(self, index):
        return struct.unpack("<I", self.memory[4 * index:4 * index + 4])[0]

    def arm(self, call=None, number=0, error=0):
        """Counts from here; lets the `number`-th call of a kind fail once."""
        for index in range(6 + len(CALLS)):
            self._set(index, 0)
        self._set(3, error)
        self._set(2, number)
        self._set(1, 0 if call is None else 1 + CALLS.index(call))
        self._set(0, 1)

    def hang(self, is_hanging):
        """Whether the disk gives no answers."""
        self._set(6 + len(CALLS), int(is_hanging))

    def disarm(self):
        self._set(1, 0)

    def has_fired(self):
        return self._get(4) > 0

    def unlock(self):
        """After a process was killed."""
        self._set(5, 0)

    def counts(self):
        return {call: self._get(6 + index) for index, call in enumerate(CALLS)}

    def recorded(self):
        return os.path.getsize(self.log)
