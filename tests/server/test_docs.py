# SPDX-License-Identifier: Apache-2.0
"""What docs/server.md shows is what happens."""
import os
import re
import shutil
import subprocess
import unittest

from service import COMMAND, COURTYARD, ServiceTest

DOCS = os.path.join(os.path.dirname(__file__), "..", "..", "docs", "server.md")


def block(language):
    """The page's lines in a language."""
    return re.search(rf"```{language}\n(.*?)```", open(DOCS).read(), re.S).group(1)


class Docs(ServiceTest):
    @unittest.skipUnless(shutil.which("curl"), "there is no curl")
    def test_the_walk(self):
        server = self.start()
        walk = block("sh").replace("127.0.0.1:8080", f"127.0.0.1:{server.port}")
        shutil.copy(COURTYARD, os.path.join(self.folder, "courtyard.glb"))
        # --json is younger than some curls.
        walk = walk.replace("--json", '-H "Content-Type: application/json" --data-binary')
        result = subprocess.run(["bash", "-euo", "pipefail", "-c", walk], cwd=self.folder,
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("event: end", result.stdout)
        self.assertIn('{"answers":[{"position":[0,1.5,0]', result.stdout.replace(".0,", ","))
        for name, magic in (("beam.vdb", b" BDV"), ("dusk.png", b"\x89PNG")):
            self.assertEqual(open(os.path.join(self.folder, name), "rb").read(4), magic)
        names = {volume["name"] for volume in server.get("/v1/volumes").json()["volumes"]}
        self.assertEqual(names, {"court", "dusk"})

    def test_the_help_names_every_option_of_the_page(self):
        help = subprocess.run([COMMAND, "serve", "--help"], capture_output=True, text=True).stdout
        own = re.sub(r"```.*?```", "", open(DOCS).read(), flags=re.S)
        for option in set(re.findall(r"`(--[a-z-]+)", own)):
            self.assertIn(option, help)


if __name__ == "__main__":
    unittest.main()
