# SPDX-License-Identifier: BSL-1.0
"""constants.py finds numbers of all forms, and refuses those without a name or a source."""

import json
import unittest

from tree import TreeTest

PATH = "gnomon/segmentation/a.hpp"


class Constants(TreeTest):
    def run_on(self, text, *arguments):
        self.write(PATH, text)
        return self.run_tool("constants.py", "--include", self.root, *arguments)

    def found(self, text):
        """The numbers, as JSON. All of them have a name and a source."""
        status, output = self.run_on(text, "--json")
        self.assertEqual(status, 0)
        return json.loads(output)

    def problems(self, text):
        status, output = self.run_on(text)
        problems = output.split("\n\n")[1].splitlines()[:-1]
        self.assertEqual(status, 1 if problems else 0)
        return [line.removeprefix(f"include/{PATH}:") for line in problems]

    def test_names(self):
        text = """\
            struct options {
                double gap = 0.05;  ///< chosen
              private:
                static constexpr std::size_t most{7};  // chosen
            };
            void f(int a, int pairs = 6);  // chosen
            inline void g() {
                if (a) b();
                constexpr auto bits = std::size_t{1} << 31;  // chosen
                constexpr double least = 1e-3, margin = 3'000.5;  // chosen
                const auto h = [](int c) -> int {
                    constexpr int more = 8;  // chosen
                    return c + more;
                };
            }
            """
        self.assertEqual([(c["name"], c["value"]) for c in self.found(text)],
                         [("gap", "0.05"), ("most", "7"), ("pairs", "6"), ("bits", "31"),
                          ("least", "1e-3"), ("margin", "3'000.5"), ("more", "8")])

    def test_kinds(self):
        for comment, kind in [("chosen on 40 rooms", "chosen"), ("performance only", "performance"),
                              ("of rounding", "numerical"), ("99.7 %", "formula"), ("a formula", "formula"),
                              ("Eq. (4.6)", "thesis"), ("n_min, noise", "thesis"), ("r, a gap", "thesis"),
                              ("a test (Chow 1960)", "thesis"), ("the thesis's; chosen", "chosen")]:
            for text in (f"constexpr int n = 5;  // {comment}\n", f"// {comment}\nconstexpr int n = 5;\n",
                         f"constexpr int n = 5;  // a number;\n                      // {comment}\n"):
                with self.subTest(text):
                    self.assertEqual([c["kind"] for c in self.found(text)], [kind])

    def test_units_and_places(self):
        text = """\
            constexpr double a = 0.5;  // [m]; chosen
            constexpr angle b = degrees(15);  // chosen
            constexpr double c = 0.5;  // of all, chosen
            constexpr double d = c / 36;  // [rad]; chosen
            """
        self.assertEqual([(c["unit"], c["path"], c["line"], c["column"]) for c in self.found(text)],
                         [("m", PATH, 1, 22), ("degrees", PATH, 2, 29), ("", PATH, 3, 22), ("", PATH, 4, 26)])

    def test_numbers_without_name_or_source(self):
        text = """\
            constexpr int a = 5;

            // chosen
            inline void f() {
                const int b = 6;  // chosen
                g(x7, 8.0f);
            }
            constexpr int c = 9;  // the thesis
            """
        self.assertEqual(self.problems(text), ["1: a 5: needs a source", "5: the number 6: needs a name",
                                               "6: the number 8.0: needs a name and a source"])

    def test_a_comment_belongs_to_what_is_next_to_it(self):
        text = """\
            struct s {
                int a = 5;  ///< chosen,
                            ///< among others
                int b = 6;
                /// Chosen is what is there, as b.
                int c = 7;
            };
            """
        self.assertEqual(self.problems(text), ["4: b 6: needs a source", "6: c 7: needs a source"])

    def test_the_comment_of_a_parameter(self):
        text = """\
            /// @param a  chosen
            /// @param b  a number
            void f(int a = 5,
                   int b = 6);
            """
        self.assertEqual(self.problems(text), ["4: b 6: needs a source"])

    def test_zero_one_and_two_are_no_constants_unless_chosen(self):
        text = """\
            constexpr double a = 1.0, b = 2 * 0;
            constexpr double c = 2.0;  // chosen
            constexpr double d = 2.0 + e;  // chosen
            """
        self.assertEqual([c["name"] for c in self.found(text)], ["c"])

    def test_numbers_of_formulas_and_in_comments(self):
        text = """\
            // 77 of 88
            inline void f() {
                for (int a = 0; a < 3; ++a) say("99", '9');
                h = 1.4826 * k;
            }
            """
        self.assertEqual([c["kind"] for c in self.found(text)], ["formula", "formula"])

    def test_other_folders_are_not_read(self):
        self.write("gnomon/core/b.hpp", "int a = 5;\n")
        self.assertEqual(self.problems(""), [])

    def test_few_are_chosen(self):
        lines = [f"constexpr int a{i} = 5 + 6;  // chosen\n" for i in range(16)]
        self.assertEqual(self.problems("".join(lines[1:])), [])
        self.assertEqual(self.problems("".join(lines)), ["16 constants are chosen, at most 15"])
        plain = "constexpr int b = 2;  // chosen\n"
        self.assertEqual(self.problems("".join(lines[1:]) + plain), [])


if __name__ == "__main__":
    unittest.main()
