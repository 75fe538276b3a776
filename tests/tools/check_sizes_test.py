# SPDX-License-Identifier: BSL-1.0
"""check_sizes.py finds functions and headers that are too long, of whatever form."""

import unittest

from tree import TreeTest

BODY = "    ++x;\n" * 49  # with the two lines of the braces one too many


class Sizes(TreeTest):
    def problems(self, text):
        self.write("gnomon/a.hpp", "")
        (self.root / "gnomon/a.hpp").write_text(text, encoding="utf-8")
        status, output = self.run_tool("check_sizes.py", "--include", self.root)
        lines = output.splitlines()[:-1]
        self.assertEqual(status, 1 if lines else 0)
        return lines

    def test_fifty_lines_are_allowed(self):
        self.assertEqual(self.problems("void f()\n{\n" + "    ++x;\n" * 48 + "}\n"), [])

    def test_functions_of_all_forms(self):
        for head, name in [("void f()", "f"),
                           ("template <class T>\n    requires(sizeof(T) > 1)\nauto g(T a) -> int", "g"),
                           ("struct s {\n    s(int a) noexcept : a_{a}, b_(a)", "s"),
                           ("struct t {\n    bool operator()(int a) const", "operator()"),
                           ("bool operator<(int a, int b)", "operator<"),
                           ("struct alignas(64) u {\n    ~u()", "~u"),
                           ("namespace a {\nnamespace b {\nvoid h(char c = '}')", "h")]:
            with self.subTest(head):
                found = self.problems(f"{head} {{\n{BODY}}}\n")
                self.assertEqual(len(found), 1)
                self.assertIn(f"'{name}' has 51 lines", found[0])

    def test_a_lambda_counts_to_its_function(self):
        half = "    ++x;\n" * 24
        found = self.problems(f"void f() {{\n{half}    auto g = [] {{\n{half}    }};\n}}\n")
        self.assertEqual(len(found), 1)

    def test_braces_in_comments_and_literals_are_no_braces(self):
        self.assertEqual(self.problems('void f() {\n    g("{"); // {\n    /* { */\n    h(R"({)");\n}\n'
                                       + "void g() {}\n" * 60), [])

    def test_classes_may_be_longer(self):
        members = "    int f() { return 1; }\n" * 60
        self.assertEqual(self.problems(f"class c : public b<int> {{\n{members}}};\n"), [])

    def test_headers(self):
        self.assertEqual(self.problems("\n" * 250), [])
        found = self.problems("\n" * 251)
        self.assertEqual(len(found), 1)
        self.assertIn("the header has 251 lines", found[0])


if __name__ == "__main__":
    unittest.main()
