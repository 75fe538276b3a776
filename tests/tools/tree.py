# SPDX-License-Identifier: BSL-1.0
"""Small repositories for the tests of the tools, and a way to run a tool on them."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest

TOOLS = pathlib.Path(__file__).resolve().parent.parent.parent / "tools"
HAS_CTAGS = shutil.which("ctags") is not None


class TreeTest(unittest.TestCase):
    """A test with an empty folder `self.root`."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(textwrap.dedent(text), encoding="utf-8")

    def run_tool(self, name, *arguments):
        """(exit status, what it printed)"""
        done = subprocess.run([sys.executable, TOOLS / name, *map(str, arguments)],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout
