# SPDX-License-Identifier: Apache-2.0
"""The libraries whose headers are compiled into a package: packages/sbom/libraries.json."""
import json
import os
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
OWN_LICENSE = "Apache-2.0"


def table():
    return json.loads((HERE / "libraries.json").read_text())


def compiled_into(package):
    """The rows of the libraries, in the order of their Debian packages, each with its `package`."""
    data = table()
    return [dict(data["libraries"][name], package=name) for name in data["packages"][package]]


def license_of(package):
    """The SPDX licence expression of all files of a package."""
    return table()["licenses"].get(package, OWN_LICENSE)


def run(*command):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE,
                          env=dict(os.environ, LC_ALL="C.UTF-8")).stdout
