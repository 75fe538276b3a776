# SPDX-License-Identifier: BSL-1.0
"""packages.py writes one version and one address into all files of packages, and finds others."""

import shutil
import unittest

from tree import TOOLS, TreeTest

ROOT = TOOLS.parent


class Packages(TreeTest):
    def setUp(self):
        super().setUp()
        for name in ("packaging", "tests/consumer"):
            shutil.copytree(ROOT / name, self.root / name)
        for name in ("CITATION.cff", "CHANGELOG.md", "package.xml", "include/gnomon/version.hpp"):
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.root / name)

    def run_packages(self, *arguments):
        return self.run_tool("packages.py", "--root", self.root, *arguments)

    def replace(self, path, before, now):
        file = self.root / path
        text = file.read_text(encoding="utf-8")
        self.assertIn(before, text)
        file.write_text(text.replace(before, now, 1), encoding="utf-8")

    def files(self):
        return {file: file.read_bytes() for file in self.root.rglob("*") if file.is_file()}

    def test_the_repository_is_fresh(self):
        self.assertEqual(self.run_packages("--check"), (0, ""))

    def test_another_version_in_one_file_is_found(self):
        version = self.run_packages("--version")[1].strip()
        self.replace("package.xml", version, "7.8.9")
        status, output = self.run_packages("--check")
        self.assertEqual((status, output.split(":")[0]), (1, "package.xml"))

    def test_another_version_in_the_header_is_written_everywhere(self):
        self.replace("include/gnomon/version.hpp", "VERSION_MAJOR 0", "VERSION_MAJOR 7")
        status, output = self.run_packages("--check")
        self.assertEqual((status, len(output.splitlines())), (1, 7))  # and the changelog
        self.assertEqual(self.run_packages()[0], 0)
        self.assertEqual(self.run_packages("--check")[1].split(":")[0], "CHANGELOG.md")
        self.assertIn("gnomon (7.", (self.root / "packaging/debian/changelog").read_text())

    def test_an_address_is_written_and_taken_back(self):
        before = self.files()
        self.replace("packaging/address", "homepage =", "homepage = https://gnomon.invalid/")
        self.replace("packaging/address", "releases =", "releases = https://gnomon.invalid/files")
        self.assertEqual(self.run_packages()[0], 0)
        self.assertEqual(self.run_packages("--check"), (0, ""))
        for name in ("package.xml", "packaging/debian/control", "packaging/vcpkg/gnomon/vcpkg.json",
                     "packaging/vcpkg/gnomon/portfile.cmake", "packaging/conan/conandata.yml",
                     "packaging/conan/conanfile.py"):
            self.assertIn("https://gnomon.invalid/", (self.root / name).read_text(), name)
        self.replace("packaging/address", " https://gnomon.invalid/\n", "\n")
        self.replace("packaging/address", " https://gnomon.invalid/files", "")
        self.assertEqual(self.run_packages()[0], 0)
        self.assertEqual(self.files(), before)


if __name__ == "__main__":
    unittest.main()
