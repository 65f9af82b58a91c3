# SPDX-License-Identifier: Apache-2.0
"""Writes the conformance vectors as files of 32-bit words, which a program reads without a JSON reader.

usage: write_cases.py VECTORS OUTPUT

OUTPUT/NAME.cases has little-endian words: the number of cases, and each case as check_answers.h says.
"""
import json
import pathlib
import shutil
import struct
import sys

OUTSIDE = {"extrapolate": 0, "clamp": 1, "ambient": 2}
WALLS = {"hide": 0, "ignore": 1}


def unsigned(*values):
    return struct.pack(f"<{len(values)}I", *values)


def floats(values):
    values = [float(value) for value in values]  # also "nan" and "inf"
    return struct.pack(f"<{len(values)}f", *values)


def answer_words(answer):
    normal = answer.get("normal", [0, 0, 0])
    light = [channel for coefficient in answer["irradiance_sh"] for channel in coefficient]
    return floats([*answer["position"], *normal, *light, *answer["occlusion"]])


def case_words(case, largest_light):
    options = case["options"]
    weights = options.get("layer_weights", [])
    words = floats([largest_light])
    words += unsigned(OUTSIDE[options.get("outside", "extrapolate")])
    words += floats([options.get("fade_distance", 10)])
    words += unsigned(WALLS[options.get("walls", "hide")], options.get("rendering_layers", 0))
    words += floats([options.get("radius", 0), options.get("normal_offset", -1)])
    words += unsigned(len(weights)) + floats(weights)
    words += unsigned(len(case["answers"]))
    return words + b"".join(answer_words(answer) for answer in case["answers"])


def is_of_the_c_api(case):
    """The C API reads halves where a file has them."""
    return case["options"].get("precision") != "full"


def write_cases(vectors, output):
    """Returns the names of the volumes."""
    output.mkdir(parents=True, exist_ok=True)
    names = []
    for path in sorted(vectors.glob("*.json")):
        text = json.loads(path.read_text())
        cases = [case_words(case, text["largest_light"]) for case in text["cases"] if is_of_the_c_api(case)]
        (output / f"{path.stem}.cases").write_bytes(unsigned(len(cases)) + b"".join(cases))
        shutil.copyfile(vectors / text["volume"], output / f"{path.stem}.probes")
        names.append(path.stem)
    return names


if __name__ == "__main__":
    print(" ".join(write_cases(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))))
