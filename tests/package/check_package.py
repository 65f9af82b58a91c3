# SPDX-License-Identifier: Apache-2.0
"""Uses the installed package as its users do, each time in an empty folder.

check_package.py headers PREFIX SOURCES
check_package.py consumer PREFIX VOLUME SOURCES
check_package.py guide PREFIX VOLUME GUIDE
check_package.py example PREFIX VOLUME SOURCE
check_package.py components PREFIX
check_package.py shared PREFIX VOLUME SOURCES
check_package.py debian PREFIX SHIP_BUILD
check_package.py folders PREFIX
check_package.py subproject SOURCES
check_package.py alone SOURCES BUILD
check_package.py prefix SOURCES
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def environment(prefix):
    """Where a package of one's own prefix is found, and nothing of the build."""
    found = dict(os.environ, CMAKE_PREFIX_PATH=prefix)
    folders = [str(p) for p in Path(prefix).glob("**/pkgconfig")]
    found["PKG_CONFIG_PATH"] = ":".join(folders)
    return found


def run(command, folder, prefix):
    """Runs a command and gives what it printed; ends the check when it fails."""
    done = subprocess.run(command, cwd=folder, env=environment(prefix), text=True,
                          shell=isinstance(command, str), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{command}\nfailed with {done.returncode}:\n{done.stdout}")
    return done.stdout


def is_first_of_its_source(header, sources):
    """Whether a source of this name includes the header first: building it proves that the header
    needs no other before it."""
    source = Path(sources, *Path(header).parts[1:]).with_suffix(".cpp")
    first = source.exists() and re.search(r"^#include [<\"](.*)[>\"]", source.read_text(), re.M)
    return bool(first) and first[1] == header


def check_headers(prefix, sources):
    """Compiles all headers as one, each twice, and those alone that no source includes first."""
    include = Path(prefix) / "include"
    headers = sorted(str(p.relative_to(include)) for p in include.rglob("*.h"))
    assert len(headers) > 20, headers
    alone = [header for header in headers if not is_first_of_its_source(header, sources)]
    assert 0 < len(alone) < len(headers), alone
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "one.cpp"
        for group in (headers, *([header] for header in alone)):
            source.write_text("".join(f"#include <{header}>\n" for header in group * 2))
            run(["c++", "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wconversion", "-Werror",
                 f"-I{include}", str(source)], folder, prefix)
    print(f"{len(headers)} headers, {len(alone)} of them alone")


def report_size(program, name):
    subprocess.run(["strip", program], check=True)
    print(f"{name}: {os.path.getsize(program)} bytes, stripped")


def copy_consumer(sources, folder):
    """main.c and the consumer of the C API, which it runs."""
    for name in ("c_api_consumer.c", "c_api_consumer.h"):
        target = Path(folder) / "tests/runtime" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(Path(sources) / "tests/runtime" / name, target)
    (Path(folder) / "main.c").write_text(
        '#include "tests/runtime/c_api_consumer.h"\n'
        "int main(int count, char** arguments) {\n"
        "    return count == 2 ? run_c_api_consumer(arguments[1]) : 99;\n}\n")


def check_consumer(prefix, volume, sources):
    with tempfile.TemporaryDirectory() as folder:
        copy_consumer(sources, folder)
        flags = run("pkg-config --cflags --libs tetralight", folder, prefix).split()
        run(["cc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2", "-I.", "main.c",
             "tests/runtime/c_api_consumer.c", "-o", "consumer"] + flags + ["-Wl,--gc-sections"],
            folder, prefix)
        run(["./consumer", volume], folder, prefix)
        report_size(str(Path(folder) / "consumer"), "C consumer of every query")


def check_guide(prefix, volume, guide):
    blocks = re.findall(r"^```(\w+) ?(\S*)\n(.*?)^```$", Path(guide).read_text(), re.S | re.M)
    commands = [text for language, _, text in blocks if language == "sh"]
    files = [(name, text) for language, name, text in blocks if language != "sh"]
    assert len(commands) == 3 and len(files) == 15, [len(commands), len(files)]
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(volume, Path(folder) / "level.probes")
        for name, text in files:
            (Path(folder) / name).write_text(text)
        printed = ""
        for text in commands:
            if "glslangValidator" in text and not shutil.which("glslangValidator"):
                print("glslangValidator is not here: the shaders of the guide are not compiled")
                continue
            printed += run("set -e\n" + text, folder, prefix)
        assert printed.count("1023 instances lit") == 2, printed
        assert printed.count("bytes, 176 of constants") == 2, printed
        assert printed.count("64 x 2 x 2 texels, 2048 bytes\n") == 2, printed
        lights = re.findall(r"^-?[\d.e-]+ -?[\d.e-]+ -?[\d.e-]+$", printed, re.M)
        assert len(lights) == 4 and len(set(lights)) == 1, printed
        flags = run("pkg-config --cflags --libs tetralight", folder, prefix).strip()
        whole = " ".join(flag for flag in flags.split() if flag.startswith("-ltetralight"))
        run(f"c++ -std=c++20 object.cpp -Wl,--whole-archive {whole} -Wl,--no-whole-archive {flags} "
            "-o all", folder, prefix)
        for name in ("object", "instances", "large", "object_c", "scene_c", "all"):
            report_size(str(Path(folder) / name), f"{name} of the guide")
        print(printed)


def check_example(prefix, volume, source):
    with tempfile.TemporaryDirectory() as folder:
        flags = run("pkg-config --cflags --libs tetralight", folder, prefix).split()
        run(["c++", "-std=c++20", "-O2", source, "-o", "example"] + flags, folder, prefix)
        printed = run(["./example", volume, "ball.ppm"], folder, prefix)
        picture = (Path(folder) / "ball.ppm").read_bytes()
        assert picture.startswith(b"P6\n480 360\n255\n") and len(picture) == 15 + 480 * 360 * 3
        assert len(set(picture[15:])) > 20, "nothing to see"
        print(printed)


def check_components(prefix):
    with tempfile.TemporaryDirectory() as folder:
        project = ("cmake_minimum_required(VERSION 3.25)\nproject(x LANGUAGES CXX)\n"
                   "find_package(tetralight REQUIRED COMPONENTS runtime {})\n"
                   "if(NOT EXISTS ${{tetralight_SHADER_DIR}}/sh.glsl)\n"
                   "  message(FATAL_ERROR \"no shaders\")\nendif()\n")
        lists = Path(folder) / "CMakeLists.txt"
        lists.write_text(project.format("probes lppv base shaders"))
        run("cmake -S . -B build", folder, prefix)
        lists.write_text(project.format("teapot"))
        failed = subprocess.run("cmake -S . -B build", shell=True, cwd=folder, text=True,
                                env=environment(prefix), stderr=subprocess.PIPE,
                                stdout=subprocess.PIPE)
        assert failed.returncode != 0 and "teapot" in failed.stderr, failed.stderr


def check_shared(prefix, volume, sources):
    """The shared library serves programs in C that CMake and pkg-config lead to it."""
    with tempfile.TemporaryDirectory() as folder:
        copy_consumer(sources, folder)
        (Path(folder) / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(x LANGUAGES C CXX)\n"
            "find_package(tetralight REQUIRED COMPONENTS shared)\n"
            "add_executable(x main.c tests/runtime/c_api_consumer.c)\n"
            "target_include_directories(x PRIVATE .)\n"
            "target_link_libraries(x PRIVATE tetralight::shared m)\n")
        run("cmake -S . -B build && cmake --build build", folder, prefix)
        run(["build/x", volume], folder, prefix)
        assert "libtetralight.so.0" in run("readelf -d build/x", folder, prefix)
        flags = run("pkg-config --cflags --libs tetralight-shared", folder, prefix).split()
        folders = [flag[2:] for flag in flags if flag.startswith("-L")]
        run(["cc", "-std=c99", "-I.", "main.c", "tests/runtime/c_api_consumer.c", "-o", "consumer",
             *flags, "-lm"], folder, prefix)
        run(f"LD_LIBRARY_PATH={folders[0]} ./consumer {volume}", folder, prefix)
        library = next(Path(prefix).rglob("libtetralight.so.*.*.*"))
        copy = Path(folder) / library.name
        shutil.copy(library, copy)
        report_size(str(copy), "the shared library")


def check_folders(prefix):
    include = Path(prefix) / "include"
    folders = {str(header.parent.relative_to(include)) for header in include.rglob("*.h")}
    modules = {"base", "probes", "probes/delaunay", "probes/build", "lppv", "lightmap", "reflection", "runtime"}
    allowed = {f"tetralight/{module}{detail}" for module in modules for detail in ("", "/detail")}
    assert {f"tetralight/{module}" for module in modules} <= folders <= allowed, folders


def configure_subproject(sources, folder, *options):
    """Configures a project that adds Tetralight: the printed text and the compile commands."""
    Path(folder, "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(engine LANGUAGES CXX)\n"
        f"add_subdirectory({sources} tetralight)\n")
    shutil.rmtree(Path(folder) / "build", ignore_errors=True)
    printed = run(["cmake", "-S", ".", "-B", "build", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *options],
                  folder, "")
    return printed, Path(folder, "build/compile_commands.json").read_text()


def check_subproject(sources):
    warning = "built without optimization"
    with tempfile.TemporaryDirectory() as folder:
        printed, commands = configure_subproject(sources, folder)
        assert warning in " ".join(printed.split()), printed
        assert "-Wall" in commands and "-Werror" not in commands, commands
        assert "/bake/" not in commands, "only the ship set is built by default"
        for options in ("-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS=-O2"):
            printed, _ = configure_subproject(sources, folder, options)
            assert warning not in " ".join(printed.split()), printed


def is_up_to_date(stamp, depfile, command):
    """Whether a command has succeeded since the files that it reads changed."""
    if not stamp.exists() or stamp.read_text() != command:
        return False
    read = depfile.read_text().replace("\\\n", " ").split()[1:]
    return all(os.path.exists(p) and os.stat(p).st_mtime < stamp.stat().st_mtime for p in read)


def check_alone(sources, folder):
    """Each source of libraries, command and benchmarks compiles by itself: it includes what it needs. The presets
    compile several as one, which does not show that. What is as it was when it last compiled is not compiled again."""
    if os.environ.get("TETRALIGHT_NIGHTLY") != "1":
        print("skipped: needs TETRALIGHT_NIGHTLY=1")
        sys.exit(77)

    def check(entry):
        place = Path(entry["directory"]) / re.search(r" -o (\S+)", entry["command"])[1]
        stamp, depfile = place.with_suffix(".checked"), place.with_suffix(".d")
        command = re.sub(r" -o \S+", "", entry["command"])
        command += f" -fsyntax-only -Werror -MD -MT x -MF {depfile}"
        if is_up_to_date(stamp, depfile, command):
            return 0
        stamp.unlink(missing_ok=True)
        started = place.with_suffix(".started")
        started.parent.mkdir(parents=True, exist_ok=True)
        started.write_text(command)
        run(command, entry["directory"], "")
        started.rename(stamp)
        return 1

    run(["cmake", "--preset", "release", "-B", folder, "-DCMAKE_UNITY_BUILD=OFF",
         "-DTETRALIGHT_BUILD_BENCHMARKS=ON", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"], sources, "")
    entries = json.loads(Path(folder, "compile_commands.json").read_text())
    assert len(entries) > 200 and not any("/Unity/" in entry["file"] for entry in entries), len(entries)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        compiled = sum(pool.map(check, entries))
    print(f"{len(entries)} sources compile by themselves; {compiled} made again")


def check_prefix(sources):
    """pkg-config finds the prefix from any folder of libraries."""
    for libraries in ("lib", "lib64", "lib/x86_64-linux-gnu"):
        with tempfile.TemporaryDirectory() as folder:
            prefix = Path(folder).resolve() / "prefix"
            run(["cmake", "--preset", "ship", "-B", folder, f"-DCMAKE_INSTALL_LIBDIR={libraries}",
                 "-DTETRALIGHT_BUILD_TESTS=OFF"], sources, "")
            packages = prefix / libraries / "pkgconfig"
            packages.mkdir(parents=True)
            for name in ("tetralight", "tetralight-shared"):
                shutil.copy(Path(folder) / f"{name}.pc", packages)
                found = run(["pkg-config", "--variable=prefix", name], folder, str(prefix)).strip()
                assert Path(found).resolve() == prefix, (libraries, name, found)


def listing(folder):
    return sorted(str(p.relative_to(folder)) for p in Path(folder).rglob("*") if p.is_file())


def check_debian(prefix, ship):
    with tempfile.TemporaryDirectory() as folder:
        run(["cpack", "-G", "DEB", "-B", folder, "--config", f"{ship}/CPackConfig.cmake"], ship,
            prefix)
        packages = list(Path(folder).glob("libtetralight-dev_*.deb"))
        assert len(packages) == 1, listing(folder)
        root = Path(folder) / "root"
        for package in Path(folder).glob("libtetralight*.deb"):
            run(["dpkg-deb", "-x", str(package), str(root)], folder, prefix)
        files, installed = set(listing(root / "usr")), set(listing(prefix))
        added = {name for name in files - installed
                 if not name.startswith(("share/doc/libtetralight", "share/lintian/"))}
        assert installed <= files and not added, [installed - files, added]
        fields = run(["dpkg-deb", "-f", str(packages[0])], folder, prefix)
        assert "Package: libtetralight-dev" in fields and "libglm-dev" in fields, fields
        # It works where it lies, too: nothing in it knows the prefix.
        flags = run("pkg-config --cflags --libs tetralight", folder, str(root / "usr"))
        assert str(root) in flags, flags
        print(f"{packages[0].name}: {packages[0].stat().st_size} bytes")


if __name__ == "__main__":
    checks = {"headers": check_headers, "consumer": check_consumer, "guide": check_guide,
              "example": check_example,
              "components": check_components, "shared": check_shared, "debian": check_debian,
              "folders": check_folders, "subproject": check_subproject, "alone": check_alone,
              "prefix": check_prefix}
    checks[sys.argv[1]](*sys.argv[2:])
