# SPDX-License-Identifier: BSL-1.0
"""public_names.py counts what a user can name, once each, and fails above its limit."""

import unittest

from tree import HAS_CTAGS, TreeTest


@unittest.skipUnless(HAS_CTAGS, "needs ctags")
class PublicNames(TreeTest):
    def names(self):
        status, output = self.run_tool("public_names.py", "--list", "--include", self.root)
        listed = [line.split() for line in output.splitlines() if line.startswith("    ")]
        return status, {name: kind for name, kind in listed}

    def test_each_kind_of_name_counts_once(self):
        self.write("gnomon/core/all.hpp", """\
            #define GNOMON_MACRO 1
            namespace gnomon {
            struct first {
                int member;
                void function_of_first() const;
            };
            template <class T>
            class second;
            template <class T>
                requires(sizeof(T) > 1)
            class second<T*> {};
            enum class third { enumerator };
            using fourth = int;
            inline constexpr int fifth = 1;
            template <class T>
            concept sixth = requires(T estimate) {
                { estimate.x } -> sixth_of<int>;
            } && requires { typename T::y; };
            template <class T>
                requires sixth<T> && (!requires(T t) { t.z; })
            [[nodiscard]] auto seventh(const T& a) -> decltype(a.x);
            int seventh(int);
            bool operator<(first, first);
            second(int) -> second<int>;
            }  // namespace gnomon
            """)
        self.assertEqual(self.names(), (0, {
            "first": "struct", "second": "class", "third": "enum", "fourth": "typedef",
            "fifth": "variable", "sixth": "concept", "seventh": "prototype"}))

    def test_what_is_not_public_does_not_count(self):
        self.write("gnomon/core/detail/a.hpp", "namespace gnomon { struct a; }\n")
        self.write("gnomon/adapters/b.hpp", "namespace gnomon { struct b {}; }\n")
        self.write("gnomon/io/c.hpp", "namespace gnomon::io { struct c {}; }\n")
        self.write("gnomon/simulation/d.hpp", """\
            namespace gnomon {
            namespace simulation {
            struct d {};
            template <class T>
            concept e = true;
            }
            namespace detail { struct f {}; }
            // struct g {};
            inline const char* h() { return "struct i {};"; }
            struct j {
                friend int k(j) { return 0; }
            };
            }
            """)
        self.assertEqual(self.names(), (0, {"h": "function", "j": "struct"}))

    def test_fails_above_the_limit(self):
        many = "\n".join(f"struct name_{i} {{}};" for i in range(160))
        self.write("gnomon/core/a.hpp", f"namespace gnomon {{\n{many}\n}}\n")
        self.assertEqual(self.names()[0], 0)
        self.write("gnomon/core/b.hpp", "namespace gnomon { struct one_more {}; }\n")
        self.assertEqual(self.names()[0], 1)


if __name__ == "__main__":
    unittest.main()
