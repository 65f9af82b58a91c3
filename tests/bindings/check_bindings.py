# SPDX-License-Identifier: Apache-2.0
"""Checks the shared library and the declarations for other languages.

check_bindings.py symbols SOURCES LIBRARY   it exports what the list names, which is what the header declares
check_bindings.py parser SOURCES            C that the generator does not know is an error
check_bindings.py current SOURCES           the generated files are what the header gives
check_bindings.py c SOURCES LIBRARY VOLUME
check_bindings.py rust SOURCES LIBRARY VOLUME
check_bindings.py csharp SOURCES LIBRARY VOLUME
    programs in these languages have the layouts of C, and answer as a program in C. They end with 77
    if there is no compiler.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
POSITIONS = [("0", "0.5", "0"), ("0.25", "0.5", "-0.125"), ("40", "2", "-30")]
C_QUERY = r"""
#include <stdio.h>
#include <stdlib.h>
#include <tetralight/runtime/tetralight.h>

int main(int count, char** arguments) {
    const float up[3] = {0.0f, 1.0f, 0.0f};
    float position[3], rgb[3];
    tetralight_error error;
    tetralight_volume* volume = NULL;
    tetralight_light light;
    tetralight_info info;
    int i;
    if (count != 5 || tetralight_open(arguments[1], &volume, &error) != TETRALIGHT_OK) return 1;
    for (i = 0; i < 3; ++i) position[i] = strtof(arguments[2 + i], NULL);
    if (tetralight_query(volume, position, NULL, &light, &error) != TETRALIGHT_OK) return 2;
    if (tetralight_sample_sh9(light.packed, up, rgb, &error) != TETRALIGHT_OK) return 3;
    if (tetralight_get_info(volume, &info, &error) != TETRALIGHT_OK) return 4;
    printf("%u %.6f %.6f %.6f %u\n", (unsigned)light.cell, rgb[0], rgb[1], rgb[2],
           (unsigned)info.probe_count);
    tetralight_close(volume);
    return 0;
}
"""


def run(command, folder, library=None, is_wrong=False):
    """What a command prints; ends the check when it fails, or succeeds where it is wrong."""
    environment = dict(os.environ)
    if library:
        environment["LD_LIBRARY_PATH"] = str(Path(library).parent)
    done = subprocess.run([str(part) for part in command], cwd=folder, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if (done.returncode != 0) != is_wrong:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def compiler(*names):
    for name in names:
        if shutil.which(name):
            return name
    print(f"there is no {' or '.join(names)} here")
    sys.exit(SKIPPED)


def read_list(sources):
    lines = Path(sources, "runtime/tetralight.symbols").read_text().splitlines()
    return [line for line in lines if not line.startswith("#")]


def check_symbols(sources, library):
    listed = read_list(sources)
    assert listed == sorted(set(listed)), "the list is not sorted"
    sys.path.insert(0, str(Path(sources, "packages/bindings")))
    import c_header
    header = c_header.read_header(Path(sources, "runtime/tetralight.h").read_text())
    declared = sorted(function.name for function in header.functions)
    assert declared == listed, sorted(set(declared) ^ set(listed))

    abi = re.search(r"\.so\.(\d+)$", library)[1]
    node = f"TETRALIGHT_{abi}"
    lines = run(["nm", "-D", "--defined-only", library], ".").splitlines()
    exported = sorted(name.split()[2] for name in lines if name.split()[1] != "A")
    wrong = sorted(set(exported) ^ {f"{name}@@{node}" for name in listed})
    assert not wrong, wrong
    dynamic = run(["readelf", "-d", library], ".")
    assert f"soname: [libtetralight.so.{abi}]" in dynamic, dynamic
    assert "TEXTREL" not in dynamic, "its code is not independent of its position"
    print(f"{len(exported)} functions, {os.path.getsize(library)} bytes")
    print(*re.findall(r"NEEDED.*\[(.*)\]", dynamic))


def check_parser(sources):
    """Declarations that the generator cannot read are errors that name their line."""
    sys.path.insert(0, str(Path(sources, "packages/bindings")))
    import c_header
    text = Path(sources, "runtime/tetralight.h").read_text()
    line = text.count("\n", 0, text.index(c_header.BEGIN) + len(c_header.BEGIN)) + 1
    wrong = ["typedef union tetralight_u { float x; } tetralight_u;", "int tetralight_f(void);",
             "typedef struct tetralight_s { float x[]; } tetralight_s;",
             "typedef struct tetralight_s { long x; } tetralight_s;",
             "typedef enum tetralight_e { TETRALIGHT_A } tetralight_e;",
             "#define TETRALIGHT_A (1 + 2)", "static int a;", "@",
             "TETRALIGHT_API void tetralight_f(void);",
             "TETRALIGHT_API void tetralight_f(void (*call)(void)) TETRALIGHT_NOEXCEPT;"]
    for declaration in wrong:
        changed = text.replace(c_header.BEGIN, f"{c_header.BEGIN}{declaration}\n")
        try:
            c_header.read_header(changed)
        except c_header.HeaderError as error:
            assert str(error).startswith(f"line {line}: "), error
        else:
            sys.exit(f"this was read: {declaration}")
    try:
        c_header.read_header(text.replace("TETRALIGHT_NOEXCEPT\n#endif", "NOEXCEPT\n#endif"))
    except c_header.HeaderError:
        return
    sys.exit("a header with other macros was read")


def generate(sources, *arguments):
    return run([sys.executable, Path(sources, "packages/bindings/generate.py"), *arguments], ".")


def check_current(sources):
    generate(sources, "--check")
    # A header that changes makes them old.
    with tempfile.TemporaryDirectory() as folder:
        for part in ("packages/bindings", "packages/rust", "packages/csharp", "runtime"):
            shutil.copytree(Path(sources, part), Path(folder, part))
        shutil.copy(Path(sources, "CMakeLists.txt"), folder)
        header = Path(folder, "runtime/tetralight.h")
        header.write_text(header.read_text().replace("uint32_t layer_count;", "uint64_t layer_count;"))
        command = [sys.executable, Path(folder, "packages/bindings/generate.py")]
        printed = run([*command, "--check"], folder, is_wrong=True)
        assert "packages/rust/src/lib.rs is not current" in printed, printed
        run(command, folder)
        run([*command, "--check"], folder)


def build_c(sources, library, folder):
    """Programs in C against the shared library: queries and layouts."""
    include = Path(folder, "include/tetralight")
    include.mkdir(parents=True)
    (include / "runtime").symlink_to(Path(sources, "runtime"))
    Path(folder, "query.c").write_text(C_QUERY)
    generate(sources, "--layout", folder)
    flags = ["-DTETRALIGHT_SHARED", "-I", Path(folder, "include"), "-Wall", "-Wextra", "-Werror"]
    run(["cc", "-std=c99", "-pedantic", *flags, "query.c", "-o", "query_c", library], folder)
    run(["cc", "-std=c11", "-pedantic", *flags, "layout.c", "-o", "layout_c"], folder)


def answers(command, folder, library, volume):
    return [run([*command, volume, *position], folder, library) for position in POSITIONS]


def compare_answers(command, folder, library, volume):
    expected = answers(["./query_c"], folder, library, volume)
    found = answers(command, folder, library, volume)
    for mine, c in zip(found, expected):
        assert mine.split()[0::4] == c.split()[0::4], (mine, c)
        for a, b in zip(mine.split()[1:4], c.split()[1:4]):
            assert abs(float(a) - float(b)) <= 2e-6 * max(1.0, abs(float(b))), (mine, c)
    assert len(set(expected)) == len(POSITIONS), expected
    message = run([*command, sys.executable, "0", "0", "0"], folder, library, is_wrong=True)
    assert message.startswith("memory: not a probe file"), message
    print(*found, sep="", end="")


def check_c(sources, library, volume):
    with tempfile.TemporaryDirectory() as folder:
        build_c(sources, library, folder)
        print(*answers(["./query_c"], folder, library, volume), sep="", end="")
        shutil.copytree(Path(sources, "tests/runtime"), Path(folder, "tests/runtime"))
        Path(folder, "main.c").write_text(
            '#include "tests/runtime/c_api_consumer.h"\n'
            "int main(int count, char** arguments) {\n"
            "    return count == 2 ? run_c_api_consumer(arguments[1]) : 99;\n}\n")
        run(["cc", "-std=c99", "-pedantic", "-DTETRALIGHT_SHARED", "-I", "include", "-I", ".", "main.c",
             "tests/runtime/c_api_consumer.c", "-o", "consumer", library, "-lm"], folder)
        run(["./consumer", volume], folder, library)


def check_rust(sources, library, volume):
    rustc = compiler("rustc")
    crate = Path(sources, "packages/rust")
    with tempfile.TemporaryDirectory() as folder:
        build_c(sources, library, folder)
        # The linker looks for libtetralight.so.
        Path(folder, "libtetralight.so").symlink_to(library)
        options = ["--edition", "2021", "-D", "warnings", "-L", folder]
        run([rustc, *options, "--crate-type", "rlib", "--crate-name", "tetralight_sys",
             crate / "src/lib.rs", "-o", "libtetralight_sys.rlib"], folder)
        linked = ["--extern", "tetralight_sys=libtetralight_sys.rlib"]
        run([rustc, *options, *linked, "layout.rs", "-o", "layout_rust"], folder)
        run([rustc, *options, *linked, crate / "examples/query.rs", "-o", "query_rust"], folder)
        expected = run(["./layout_c"], folder)
        found = run(["./layout_rust"], folder, library)
        assert found == expected, "other layouts than in C:\n" + found
        assert len(expected.splitlines()) > 100, expected
        compare_answers(["./query_rust"], folder, library, volume)
        check_cargo(crate, folder)


def check_cargo(crate, folder):
    """The crate builds by cargo, which needs nothing from a network."""
    if not shutil.which("cargo"):
        print("there is no cargo here")
        return
    copy = Path(folder, "crate")
    shutil.copytree(crate, copy, ignore=shutil.ignore_patterns("target", "Cargo.lock"))
    os.environ["TETRALIGHT_LIB_DIR"] = str(folder)
    run(["cargo", "build", "--offline", "--quiet", "--example", "query"], copy)
    assert Path(copy, "target/debug/examples/query").exists()


def check_csharp(sources, library, volume):
    mcs, mono = compiler("mcs"), compiler("mono")
    package = Path(sources, "packages/csharp")
    with tempfile.TemporaryDirectory() as folder:
        build_c(sources, library, folder)
        options = [mcs, "-unsafe", "-nologo", "-warnaserror", package / "Tetralight.cs"]
        run([*options, "layout.cs", "-out:layout.exe"], folder)
        run([*options, package / "Query.cs", "-out:query.exe"], folder)
        # Mono says no alignments.
        expected = [line.split()[:2] for line in run(["./layout_c"], folder).splitlines()]
        found = run([mono, "layout.exe"], folder, library)
        assert [line.split() for line in found.splitlines()] == expected, found
        compare_answers([mono, "query.exe"], folder, library, volume)


if __name__ == "__main__":
    checks = {"symbols": check_symbols, "parser": check_parser, "current": check_current,
              "c": check_c, "rust": check_rust, "csharp": check_csharp}
    checks[sys.argv[1]](*sys.argv[2:])
