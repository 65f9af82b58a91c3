# SPDX-License-Identifier: Apache-2.0
"""Builds the ship set for other platforms, runs its portable test where that is possible, prints a table.

usage: portability.py [--list] [PLATFORM...]

Exit code 1 if a build has a warning or anything fails. `./run portability` calls this.
"""
import argparse
import dataclasses
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import write_cases

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "portability"
VECTORS = BUILD / "vectors"
MOST_SECONDS = 600  # of a program


@dataclasses.dataclass
class Platform:
    """A row of the table."""

    name: str
    about: str
    compiler: str  # the command of the C++ compiler
    toolchain: str = ""  # a file of cmake/toolchains
    options: tuple = ()  # of CMake
    target: str = "portability_test"
    program: str = "tests/portability/portability_test"  # in the folder of the build
    # The program that uses the shared library; empty: that library is not built.
    shared_program: str = ""
    # The command that runs the program, before it; None: it is only compiled.
    runner: tuple | None = ()
    environment: dict = dataclasses.field(default_factory=dict)
    # Highway's namespace of the processor, which functions of the program must be in.
    vectors: str = ""
    # In Node: a script of this folder that takes the program.
    script: str = ""


PLATFORMS = [
    Platform("linux", "Linux, x86-64, Highway", "g++", shared_program="tests/portability/portability_shared"),
    Platform("clang14", "Linux, x86-64, Highway", "clang++-14"),
    Platform("clang16", "Linux, x86-64, Highway", "clang++-16"),
    Platform("libcxx", "Linux, x86-64, Highway, libc++", "clang++-16", options=("-DCMAKE_CXX_FLAGS=-stdlib=libc++",)),
    Platform("linux32", "Linux, x86, 32 bits", "g++-12", toolchain="linux32"),
    Platform("aarch64", "Linux, ARM, 64 bits, NEON by Highway", "aarch64-linux-gnu-g++", toolchain="aarch64",
             runner=("qemu-aarch64-static",), vectors="N_NEON"),
    Platform("mingw64", "Windows, 64 bits", "x86_64-w64-mingw32-g++-posix", toolchain="mingw64",
             program="tests/portability/portability_test.exe",
             shared_program="tests/portability/portability_shared.exe", runner=("/usr/lib/wine/wine64",),
             environment={"WINEPREFIX": str(BUILD / "wine"), "WINEDEBUG": "-all", "DISPLAY": "",
                          "WINEDLLOVERRIDES": "mscoree,mshtml="}),
    Platform("mingw32", "Windows, 32 bits", "i686-w64-mingw32-g++-posix", toolchain="mingw32",
             program="tests/portability/portability_test.exe",
             shared_program="tests/portability/portability_shared.exe", runner=None),
    Platform("wasm32", "WebAssembly, 128-bit vectors by Highway", "clang++-16", toolchain="wasm32",
             target="tetralight_wasm", program="runtime/wasm/tetralight.wasm", script="wasm_test.mjs"),
]


@dataclasses.dataclass
class Outcome:
    compiler: str = "missing"
    built: str = "no"
    warnings: int = 0
    ran: str = "–"
    failed: bool = True


def call(command, log, **options):
    """Runs a command; what it prints goes to the log. True if it succeeded."""
    log.write(f"$ {' '.join(map(str, command))}\n")
    log.flush()
    return subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, **options).returncode == 0


def compiler_version(platform):
    text = subprocess.run([platform.compiler, "--version"], capture_output=True, text=True).stdout
    # "g++ (Debian 12.2.0-14) 12.2.0", "x86_64-w64-mingw32-g++-posix (GCC) 12-posix", "clang version 16.0.6 (15)"
    number = re.search(r"(?:\) |version )(\d+(\.\d+)*)", text)
    return f"{platform.compiler} {number[1]}" if number else platform.compiler


def build(platform, folder, log):
    command = ["cmake", "--fresh", "--preset", "ship", "-B", folder, "-Wno-dev", f"-DCMAKE_CXX_COMPILER={platform.compiler}",
               "-DTETRALIGHT_BUILD_TESTS=OFF", "-DTETRALIGHT_INSTALL=OFF", "-DTETRALIGHT_WARNINGS_AS_ERRORS=ON",
               "-DTETRALIGHT_BUILD_PORTABILITY_TEST=ON", *platform.options]
    if platform.toolchain:
        command += ["--toolchain", ROOT / "cmake" / "toolchains" / f"{platform.toolchain}.cmake"]
    targets = [platform.target, *(["portability_shared"] if platform.shared_program else [])]
    return (call(command, log, cwd=ROOT) and
            call(["cmake", "--build", folder, "--parallel", str(os.cpu_count()), "--target", *targets], log))


def count_warnings(path):
    """Warnings of a build that takes them for errors."""
    return len(re.findall(r"(?m)^\S+:\d+:\d+: (?:error|warning): .*\[-W", path.read_text(errors="replace")))


def run_program(platform, folder, program, names):
    """Returns whether a program passed, and its last line."""
    work = folder / "work"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    command = [*platform.runner, folder / program, "work", VECTORS, *names]
    if platform.script:
        command = ["node", ROOT / "tests" / "portability" / platform.script, folder / program, VECTORS, *names]
    try:
        ended = subprocess.run(command, cwd=folder, env={**os.environ, **platform.environment}, text=True,
                               capture_output=True, timeout=MOST_SECONDS)
    except subprocess.TimeoutExpired:
        return False, f"did not end in {MOST_SECONDS} s"
    lines = ended.stdout.strip().splitlines() or [f"ended with code {ended.returncode}"]
    if ended.returncode != 0:
        print(ended.stdout, ended.stderr, sep="", file=sys.stderr)
    return ended.returncode == 0, lines[-1]


def run_programs(platform, folder, names):
    """Returns whether all programs passed, and their last lines."""
    programs = [platform.program, *([platform.shared_program] if platform.shared_program else [])]
    results = [run_program(platform, folder, program, names) for program in programs]
    return all(is_right for is_right, _ in results), "; ".join(line for _, line in results)


def missing_command(platform):
    """The name of a command that is not installed; None if all are."""
    for command in (platform.compiler, *(platform.runner or ())[:1], *(["node"] if platform.script else [])):
        if not shutil.which(command):
            return command
    return None


def try_platform(platform, names):
    outcome = Outcome()
    if missing := missing_command(platform):
        print(f"{missing} is not installed", file=sys.stderr)
        return outcome
    outcome.compiler = compiler_version(platform)
    folder = BUILD / platform.name
    folder.mkdir(parents=True, exist_ok=True)
    log_path = folder / "log.txt"
    start = time.monotonic()
    with log_path.open("w") as log:
        has_built = build(platform, folder, log)
    outcome.warnings = count_warnings(log_path)
    if not has_built:
        print(log_path.read_text(errors="replace")[-4000:], file=sys.stderr)
        return outcome
    outcome.built = f"{time.monotonic() - start:.0f} s"
    if platform.runner is None:
        outcome.ran = "compiled only"
        outcome.failed = False
        return outcome
    if platform.vectors and platform.vectors.encode() not in (folder / platform.program).read_bytes():
        outcome.ran = f"lacks the vector code {platform.vectors}"
        return outcome
    is_right, outcome.ran = run_programs(platform, folder, names)
    outcome.failed = not is_right
    return outcome


def print_table(rows):
    head = ("platform", "compiler", "built", "warnings", "ran")
    widths = [max(len(row[i]) for row in [head, *rows]) for i in range(len(head))]
    for row in [head, tuple("-" * width for width in widths), *rows]:
        print("| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths)) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--list", action="store_true", help="print the names of the platforms")
    parser.add_argument("platforms", nargs="*", help="only these")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(platform.name for platform in PLATFORMS))
        return 0
    unknown = set(arguments.platforms) - {platform.name for platform in PLATFORMS}
    if unknown:
        parser.error(f"unknown platform {', '.join(sorted(unknown))}")
    names = write_cases.write_cases(ROOT / "tests" / "conformance" / "vectors", VECTORS)
    rows, failed = [], False
    for platform in PLATFORMS:
        if arguments.platforms and platform.name not in arguments.platforms:
            continue
        print(f"== {platform.name}: {platform.about}", flush=True)
        outcome = try_platform(platform, names)
        failed = failed or outcome.failed
        rows.append((platform.about, outcome.compiler, outcome.built, str(outcome.warnings), outcome.ran))
    print_table(rows)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
