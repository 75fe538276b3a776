# SPDX-License-Identifier: BSL-1.0
"""check_words.py finds words in all kinds of prose, and only there; exceptions are obeyed."""

import unittest

from tree import TreeTest

WORDS = """\
@set = include/x/*, tests/*
wug, so wuggy | occluded |
blick | unlabeled | @set (rewritten); "blick dog" (an animal); docs/dogs.md (animals)
"""


class Words(TreeTest):
    def setUp(self):
        super().setUp()
        self.write("words.txt", WORDS)

    def problems(self, *arguments):
        status, output = self.run_tool("check_words.py", "--root", self.root, "--words",
                                       self.root / "words.txt", *arguments)
        lines = output.splitlines()[:-1]
        self.assertEqual(status, 1 if lines else 0)
        return [line.split(": write")[0] for line in lines]

    def test_comments_and_messages_of_sources(self):
        self.write("include/gnomon/a.hpp", """\
            /// Wug surfaces.
            int wug = f("it is wug apart", "wug", '"');  // of so
                                                          // wuggy
            /* a
             * wug block */
            """)
        self.assertEqual(self.problems(), [
            "include/gnomon/a.hpp:1: 'Wug'", "include/gnomon/a.hpp:2: 'wug'",
            "include/gnomon/a.hpp:2: 'so wuggy'", "include/gnomon/a.hpp:5: 'wug'"])

    def test_messages_of_tests_may_be_anything(self):
        self.write("tests/a_test.cpp", 'TEST(a, b) { ok("it is wug apart"); }\n')
        self.assertEqual(self.problems(), [])

    def test_pages_without_their_code(self):
        self.write("README.md", "# Wug\n\n```cpp\nwug();\n```\n\nIt is `wug`, or Wugado.\n")
        self.write("docs/results/page.md", "wug\n")
        self.write("docs/page.md", "wug\n")
        self.assertEqual(self.problems(), ["README.md:1: 'Wug'", "docs/page.md:1: 'wug'"])

    def test_scripts(self):
        self.write("benchmarks/page.py", '"""All wug."""\nx = "wug"  # wug\ny = "is wug"\n')
        self.write("benchmarks/run.sh", "#!/bin/sh\n# wug\necho wug\n")
        self.assertEqual(self.problems(), [
            "benchmarks/page.py:1: 'wug'", "benchmarks/page.py:2: 'wug'",
            "benchmarks/page.py:3: 'wug'", "benchmarks/run.sh:2: 'wug'"])

    def test_exceptions(self):
        self.write("include/x/a.hpp", "// a blick point\n")
        self.write("include/y/a.hpp", "// a blick\n// dog, and a blick cat\n")
        self.write("docs/dogs.md", "blick\n")
        self.assertEqual(self.problems(), ["include/y/a.hpp:2: 'blick'"])

    def test_folders_and_counts(self):
        self.write("include/gnomon/core/a.hpp", "// wug, wug\n")
        self.write("tests/core/a.cpp", "// wug\n")
        self.assertEqual(self.problems("tests"), ["tests/core/a.cpp:1: 'wug'"])
        self.assertEqual(self.problems("--count"),
                         ["   3  wug: include/gnomon/core 2, tests/core 1"])

    def test_a_list_that_is_not_one(self):
        for line in ("wug | occluded", "wug | | ", "wug | occluded | docs/a.md",
                     "wug | occluded | @unknown (reason)"):
            self.write("words.txt", line + "\n")
            with self.assertRaises(AssertionError):  # what is printed on stderr
                self.problems()


if __name__ == "__main__":
    unittest.main()
