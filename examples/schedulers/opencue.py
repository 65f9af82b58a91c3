# SPDX-License-Identifier: Apache-2.0
"""Sends a job of `tetralight plan` to OpenCue. Untried: written from OpenCue's documentation.

    python3 opencue.py /shared/job SHOW SHOT USER

A layer for each phase, whose frames are the numbers of its tasks; a layer that joins the results at the end.
"""
import json
import os
import sys

import outline
import outline.cuerun
from outline.modules.shell import Shell


def main(job, show, shot, user):
    job = os.path.abspath(job)
    with open(os.path.join(job, "plan.json")) as file:
        phases = json.load(file)["phases"]
    bake = outline.Outline("tetralight", show=show, shot=shot, user=user)
    before = None
    for number, phase in enumerate(phases):
        # Commands are lists of words. OpenCue replaces #IFRAME# by the number of the frame.
        layer = Shell(f"phase_{number}", command=["tetralight", "task", job, "#IFRAME#"],
                      range=f"{phase['begin']}-{phase['end'] - 1}", chunk=1)
        if before is not None:
            layer.depend_all(before)
        bake.add_layer(layer)
        before = layer
    collect = Shell("collect", command=["tetralight", "collect", job], range="1-1")
    collect.depend_all(before)
    bake.add_layer(collect)
    outline.cuerun.launch(bake, use_pycuerun=False)


if __name__ == "__main__":
    main(*sys.argv[1:])
