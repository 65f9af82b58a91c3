# SPDX-License-Identifier: Apache-2.0
"""What a power cut may leave of the changes that tests/support/fault_shim.cpp recorded.

Bytes are on the disk once their file is synced, names once their folder is. Of what is not synced a
disk keeps any part: each file has some of its later writes, the last of them perhaps torn, and each
folder some of its later changes."""
import os
from dataclasses import dataclass, field

SECTOR = 512


@dataclass
class Change:
    kind: str
    inode: int
    path: str
    other: str
    offset: int
    data: bytes
    end: int  # where its record ends


def read_log(path):
    with open(path, "rb") as file:
        log = file.read()
    changes, at = [], 0
    while at < len(log):
        line_end = log.index(b"\n", at)
        kind, inode, first, other, offset, size = log[at:line_end].decode().split("\t")
        at = line_end + 1 + int(size)
        data = log[line_end + 1:at]
        if not first.endswith("-shm"):  # SQLite writes it through memory, and anew at the start
            changes.append(Change(kind, int(inode), first, other, int(offset), data, at))
    return changes


def apply(content, change, size=None):
    if change.kind == "truncate":
        del content[change.offset:]
        content.extend(bytes(change.offset - len(content)))
        return
    data = change.data[:size]
    content.extend(bytes(max(0, change.offset - len(content))))
    content[change.offset:change.offset + len(data)] = data


@dataclass
class File:
    safe: bytearray = field(default_factory=bytearray)
    later: list = field(default_factory=list)

    def sync(self):
        for change in self.later:
            apply(self.safe, change)
        self.later = []

    def write(self, path, choose):
        content = bytearray(self.safe)
        kept = choose(len(self.later))
        for change in self.later[:kept]:
            apply(content, change)
        if kept < len(self.later) and self.later[kept].kind == "write":
            torn = self.later[kept]
            apply(content, torn, SECTOR * choose(len(torn.data) // SECTOR))
        with open(path, "wb") as file:
            file.write(content)
        os.utime(path, (1, 1))  # written before all that the server remembers


@dataclass
class Folder:
    safe: dict = field(default_factory=dict)
    later: list = field(default_factory=list)  # of {name: file, folder or None}

    def names(self, count=None):
        names = dict(self.safe)
        for change in self.later[:count]:
            names.update(change)
        return {name: one for name, one in names.items() if one is not None}

    def sync(self):
        self.safe = self.names()
        self.later = []

    def write(self, path, choose):
        os.mkdir(path)
        for name, one in self.names(choose(len(self.later))).items():
            one.write(os.path.join(path, name), choose)


class Disk:
    """Follows the changes below a folder that is there from the start."""

    def __init__(self, root):
        self.root, self.top = root, Folder()
        self.files = {}  # by number, which the system gives again after a deletion

    def _folder(self, path):
        folder = self.top
        for name in os.path.relpath(path, self.root).split("/"):
            folder = folder if name == "." else folder.names()[name]
        return folder

    def _rename(self, change):
        source, target = (self._folder(os.path.dirname(p)) for p in (change.path, change.other))
        old, new = os.path.basename(change.path), os.path.basename(change.other)
        moved = source.names()[old]
        if source is target:
            source.later.append({old: None, new: moved})
        else:
            source.later.append({old: None})
            target.later.append({new: moved})

    def follow(self, change):
        kind = change.kind
        if kind == "rename":
            self._rename(change)
        elif kind in ("create", "unnamed"):
            self.files[change.inode] = File()
        elif kind in ("write", "truncate"):
            self.files[change.inode].later.append(change)
        elif kind == "sync":
            is_folder = change.inode not in self.files or change.path == self.root
            one = self._folder(change.path) if is_folder else self.files[change.inode]
            one.sync()
        if kind in ("create", "link", "mkdir", "unlink"):
            one = {"mkdir": Folder, "unlink": lambda: None}.get(
                kind, lambda: self.files[change.inode])()
            if kind == "mkdir":
                self.files.pop(change.inode, None)
            folder = self._folder(os.path.dirname(change.path))
            folder.later.append({os.path.basename(change.path): one})

    def crash(self, path, choose):
        """Writes what is left to a new folder. `choose(n)` says how many of n unsafe things are."""
        self.top.write(path, choose)
