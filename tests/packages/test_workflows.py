# SPDX-License-Identifier: Apache-2.0
"""The workflows of GitHub: YAML that calls commands of ./run which exist, in the Debian that ./run is for."""
import itertools
import os
import re
import sys
import unittest
from pathlib import Path

sys.path.append("/usr/lib/python3/dist-packages")  # of Debian's python3-yaml, for other Pythons
try:
    import yaml
except ImportError:
    yaml = None

SOURCES = Path(os.environ["TETRALIGHT_SOURCES"])
WORKFLOWS = sorted((SOURCES / ".github/workflows").glob("*.yml"))


def functions():
    """The functions of ./run: {name: text}."""
    return dict(re.findall(r"^(\w+)\(\) \{\n(.*?)^\}$", (SOURCES / "run").read_text(), re.M | re.S))


def commands():
    """The commands of ./run, and the first words that they accept."""
    text = (SOURCES / "run").read_text()
    names = set(re.findall(r"^    (\w+)\) ", text.split('case "${1:-}" in')[-1], re.M))
    kinds = re.search(r"^        ([\w |]+)\) ;;$", functions()["package"], re.M)[1].split(" | ")
    presets = re.findall(r'"name": "(\w+)",\s+"configurePreset"', (SOURCES / "CMakePresets.json").read_text())
    return names, {"package": set(kinds), "test": set(presets)}


def called(job):
    """What a job runs, once for each combination of its matrix."""
    matrix = job.get("strategy", {}).get("matrix", {})
    for values in itertools.product(*matrix.values()):
        for step in job["steps"]:
            text = step.get("run", "")
            for name, value in zip(matrix, values):
                text = text.replace("${{ matrix.%s }}" % name, str(value))
            yield from re.findall(r"\./run ([^\n&|;]+)", text)


@unittest.skipUnless(yaml, "python3-yaml is missing")
class Workflows(unittest.TestCase):
    def jobs(self):
        for path in WORKFLOWS:
            for name, job in yaml.safe_load(path.read_text())["jobs"].items():
                yield f"{path.name}: {name}", job

    def test_they_call_what_run_has(self):
        names, kinds = commands()
        count = 0
        for where, job in self.jobs():
            for words in map(str.split, called(job)):
                count += 1
                self.assertIn(words[0], names, where)
                if len(words) > 1 and words[0] in kinds:
                    self.assertIn(words[1], kinds[words[0]], where)
        self.assertGreaterEqual(count, 2)

    def test_every_kind_of_package_is_built(self):
        built = {words for _, job in self.jobs() for words in called(job)}
        for kind in commands()[1]["package"]:
            self.assertIn(f"package {kind}", built)

    def test_they_run_in_debian_12_without_rights_to_write(self):
        for where, job in self.jobs():
            container = job["container"]
            self.assertEqual(container if isinstance(container, str) else container["image"], "debian:12", where)
        for path in WORKFLOWS:
            self.assertEqual(yaml.safe_load(path.read_text())["permissions"], {"contents": "read"}, path)


if __name__ == "__main__":
    unittest.main()
