# SPDX-License-Identifier: BSL-1.0
"""check_references.py finds names, files, links and numbers that do not exist."""

import unittest

from tree import HAS_CTAGS, TreeTest


@unittest.skipUnless(HAS_CTAGS, "needs ctags")
class References(TreeTest):
    def setUp(self):
        super().setUp()
        self.write("include/gnomon/core/point.hpp", """\
            #if GNOMON_SWITCH
            #endif
            namespace gnomon {
            struct point { int member; };
            enum class kind { good };
            template <class Proj>
            concept thing = true;
            inline int made(int argument) { int local = argument; return local; }
            }
            """)
        self.write("examples/show.cpp", 'int main() { parse("--merge"); write("out.ply"); }\n')

    def problems(self):
        status, output = self.run_tool("check_references.py", "--root", self.root)
        lines = output.splitlines()[:-1]
        self.assertEqual(status, 1 if lines else 0)
        return lines

    def of_page(self, text):
        self.write("docs/page.md", text)
        return [line.removeprefix("docs/page.md:1: ") for line in self.problems()]

    def test_names_that_are_there(self):
        self.assertEqual(self.of_page("`point`, `point::member`, `made(argument)`, `kind::good`, `thing`, "
                                      "`std::nowhere`, `Eigen::Nothing`, `point{.member = 3e-4}`, `show`, "
                                      "`GNOMON_SWITCH`, `show --merge all`"), [])

    def test_names_that_are_not(self):
        self.assertEqual(self.of_page("`pointless`"), ["there is no name 'pointless'"])
        self.assertEqual(self.of_page("`point{.membre = 3}`"), ["there is no name 'membre'"])
        self.assertEqual(self.of_page("`local`"), ["there is no name 'local'"])
        self.assertEqual(self.of_page("`sh run.sh --marge`"), ["no program has the option --marge"])

    def test_comments_may_name_what_is_in_their_file(self):
        self.write("include/gnomon/a.hpp", "// `local_a`, `local_b`\nint f() { int local_a; }\n")
        self.assertEqual(self.problems(), ["include/gnomon/a.hpp:1: there is no name 'local_b'"])

    def test_of_the_terms_the_first_column(self):
        self.write("docs/terms.md", "| `point` | `pcl_point` |\n| `pint` | |\n")
        self.assertEqual(self.problems(), ["docs/terms.md:2: there is no name 'pint'"])

    def test_of_the_changelog_all_but_the_first_column(self):
        self.write("CHANGELOG.md", "| `former` | `point` |\n| `former` | `pint` |\n")
        self.assertEqual(self.problems(), ["CHANGELOG.md:2: there is no name 'pint'"])

    def test_files(self):
        self.assertEqual(self.of_page("`examples/show.cpp`, `core/point.hpp`, point.hpp, examples/, "
                                      "`<gnomon/core/point.hpp>`, `out.ply`, DIR/NAME.json"), [])
        self.assertEqual(self.of_page("`examples/shown.cpp`"), ["there is no file examples/shown.cpp"])
        self.assertEqual(self.of_page("see detail/point.hpp"), ["there is no detail/point.hpp"])
        self.assertEqual(self.of_page("see tests/"), ["there is no tests/"])
        self.assertEqual(self.of_page("`<gnomon/point.hpp>`"), ["there is no <gnomon/point.hpp>"])

    def test_links(self):
        self.write("docs/other.md", "## On `point`, again\n")
        self.assertEqual(self.of_page("[a](other.md) [b](other.md#on-point-again) [c](https://x.y/z)"), [])
        self.assertEqual(self.of_page("[a](others.md)"), ["the link leads to no file: others.md"])
        self.assertEqual(self.of_page("[a](other.md#on)"),
                         ["the link leads to no heading: other.md#on"])

    def test_numbers_of_the_thesis(self):
        self.assertEqual(self.of_page("Eqs. (3.9)-(3.11), Eq. 3.19, Secs. 4.2.4 and 4.2.5, Fig. 4.2 (b), "
                                      "Tabs. 3.1 and 3.2, Algs. 4.1 to 4.3, App. A.1, Eq. (A.1)"), [])
        for cited, kind in [("Eq. (3.29)", "Eq 3.29"), ("Eqs. (3.9) and (3.99)", "Eq 3.99"),
                            ("Sec. 3.7", "Sec 3.7"), ("Figs. 4.1 to 4.15", "Fig 4.15"),
                            ("Table 4.2", "Table 4.2"), ("Alg. 4.4", "Alg 4.4")]:
            self.assertEqual(self.of_page(cited), [f"the thesis has no {kind}"])

    def test_numbers_of_notes(self):
        self.write("docs/thesis-notes.md", "## A34: Surface variation\n")
        self.assertEqual(self.of_page("docs/thesis-notes.md, A34"), [])
        self.assertEqual(self.of_page("docs/thesis-notes.md, A35"), ["'A35' is not in the repository"])
        self.assertEqual(self.of_page("see A34"), ["'A34' is not in the repository"])

    def test_numbers_of_other_works(self):
        self.assertEqual(self.of_page("Golub and Van Loan, Sec. 8.5"), [])
        self.assertEqual(self.of_page("Sec. 8.5"), ["the thesis has no Sec 8.5"])

    def test_documents_that_are_not_in_the_repository(self):
        self.assertEqual(self.of_page("the specification of a format; F1, A4, F 0.91"), [])
        self.assertEqual(len(self.of_page("(specification of it, A19)")), 2)
        self.assertEqual(len(self.of_page("(A5), F12")), 2)
        self.assertEqual(len(self.of_page("see ../shared/design")), 1)


if __name__ == "__main__":
    unittest.main()
