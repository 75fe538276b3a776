# SPDX-License-Identifier: BSL-1.0
"""check_concepts.py requires a page for each concept, with five sections, and each type in the terms."""

import unittest

from tree import HAS_CTAGS, TreeTest

PAGE = """\
# `shape`

## Intuition
A thing.

**Minimal complete definition.** One member.

### Laws
None is broken.

## Models
`box`.

## What the compiler says
An error.
"""


@unittest.skipUnless(HAS_CTAGS, "needs ctags")
class Concepts(TreeTest):
    def setUp(self):
        super().setUp()
        self.write("include/gnomon/core/a.hpp", """\
            namespace gnomon {
            template <class T>
            concept shape = true;
            struct box {};
            using size = int;
            void function();
            }
            namespace gnomon::detail {
            template <class T>
            concept hidden = true;
            }
            """)
        self.write("docs/concepts/shape.md", PAGE)
        self.write("docs/terms.md", "| `box` | `shape`, `size` |\n")

    def problems(self):
        status, output = self.run_tool("check_concepts.py", "--root", self.root)
        lines = output.splitlines()[:-1]
        self.assertEqual(status, 1 if lines else 0)
        return lines

    def test_a_complete_page(self):
        self.assertEqual(self.problems(), [])

    def test_no_page(self):
        (self.root / "docs/concepts/shape.md").unlink()
        self.assertIn("concept shape has no page", self.problems()[0])

    def test_a_section_that_is_missing_empty_or_out_of_order(self):
        self.write("docs/concepts/shape.md", PAGE.replace("### Laws\n", ""))
        self.assertIn("has no section 'Laws'", self.problems()[0])
        self.write("docs/concepts/shape.md", PAGE.replace("`box`.\n", ""))
        self.assertIn("has nothing under 'Models'", self.problems()[0])
        swapped = PAGE.replace("Laws", "Law").replace("Models", "Laws").replace("Law\n", "Models\n")
        self.write("docs/concepts/shape.md", swapped)
        self.assertIn("in the order", self.problems()[0])

    def test_a_page_of_no_concept(self):
        self.write("docs/concepts/box.md", PAGE.replace("`shape`", "`box`"))
        self.assertIn("`box` is no public concept", self.problems()[0])

    def test_a_concept_with_two_pages(self):
        self.write("docs/concepts/other.md", PAGE)
        self.assertIn("is in docs/concepts/other.md too", self.problems()[0])

    def test_a_type_that_the_terms_do_not_name(self):
        self.write("docs/terms.md", "`box` and shape, `size`\n")
        self.assertEqual(self.problems(), ["docs/terms.md does not name `shape` of "
                                           "include/gnomon/core/a.hpp"])
        (self.root / "docs/terms.md").unlink()
        self.assertEqual(self.problems(), ["docs/terms.md is missing"])


if __name__ == "__main__":
    unittest.main()
