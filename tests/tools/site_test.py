# SPDX-License-Identifier: BSL-1.0
"""The tools of docs/site: header_filter.py gives doxygen what it can read, and check_site.py fails for
links that lead nowhere and names that are not described."""

import unittest

from tree import HAS_CTAGS, TreeTest


class HeaderFilter(TreeTest):
    def filtered(self, text, path="gnomon/core/some.hpp"):
        self.write(f"include/{path}", text)
        status, output = self.run_tool("../docs/site/header_filter.py", self.root / "include",
                                       self.root / "copy")
        self.assertEqual((status, output), (0, ""))
        return (self.root / "copy" / path).read_text(encoding="utf-8")

    def test_lines_keep_their_numbers(self):
        text = """\
            template <class T>
            struct box {
                double u = 0.0, v = 1.0;  ///< edges [m]
                std::size_t size() const { return 1; }
                explicit(false) box(T) {}
            };
            template <class T>
            box(T) -> box<T>;

            /// Refused: two of them.
            template <class T>
            void open(const T&, const T& = {}) {
                static_assert(false);
            }
            int last;
            """
        lines = self.filtered(text).split("\n")
        self.assertEqual(len(lines), len(text.split("\n")))
        self.assertEqual(lines[2].split("; ", 1), ["    /** edges [m] */ double u = 0.0",
                                                   "/** edges [m] */ double v = 1.0;"])
        self.assertIn("/** The number of elements. */ std::size_t size()", lines[3])
        self.assertEqual(lines[4].strip(), "explicit box(T) {}")
        self.assertEqual("".join(lines[6:14]).strip(), "")
        self.assertEqual(lines[14], "int last;")

    def test_comments_of_the_header_stay(self):
        text = "struct box {\n    /// Of the box.\n    std::size_t size() const;\n};\n"
        self.assertEqual(self.filtered(text), text)

    def test_some_texts_are_for_a_floor(self):
        text = "struct box {\n    double mass = 1.0;\n};\n"
        self.assertEqual(self.filtered(text), text)
        self.assertIn("/** ", self.filtered(text, "gnomon/recognition/some.hpp"))


@unittest.skipUnless(HAS_CTAGS, "needs ctags")
class CheckSite(TreeTest):
    def test_what_leads_nowhere_is_reported(self):
        self.write("tags.xml", "<tagfile></tagfile>")
        self.write("index.html", '<a href="other.html#here">1</a><a href="other.html#not">2</a>'
                                 '<a href="none.html">3</a><a href="https://example.org">4</a>')
        self.write("other.html", '<p id="here"></p>')
        status, output = self.run_tool("../docs/site/check_site.py", self.root, self.root / "tags.xml")
        self.assertEqual(status, 1)
        self.assertIn("index.html: no anchor other.html#not\n", output)
        self.assertIn("index.html: no file none.html\n", output)
        self.assertIn("gnomon::knn is described nowhere\n", output)
        self.assertNotIn("#here", output)
        self.assertNotIn("example.org", output)


if __name__ == "__main__":
    unittest.main()
