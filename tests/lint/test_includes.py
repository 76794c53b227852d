"""Checks that follow #include lines: arrows between folders, debts, headers that compile by themselves."""

import unittest

from repository import RepositoryTest

import check_headers
import check_includes

ARROWS = """# a comment
low     = core
core    ->
fit     -> low size/value.h
size    -> low
tests/unit/* -> SUBJECT
"""


class ArrowsTest(RepositoryTest):
    def setUp(self):
        super().setUp()
        self.write("scripts/lint.d/arrows", ARROWS)
        self.debts()
        for path in ("sdk/core/a.h", "sdk/fit/a.h", "sdk/size/a.h", "sdk/size/value.h"):
            self.write(path, "#pragma once\n")

    def debts(self, text=""):
        self.write("scripts/lint.d/include-debts", "# debts\n" + text)

    def test_includes_along_arrows_pass(self):
        self.write("sdk/fit/b.cpp", '#include "fit/a.h"\n#include "core/a.h"\n#include <vector>\n')
        self.assert_clean("includes")

    def test_an_include_against_them_does_not(self):
        self.write("sdk/core/b.cpp", '\n  #  include "fit/a.h"\n')
        self.assert_breach("includes", "sdk/core/b.cpp:2: core -> fit: no arrow")

    def test_an_arrow_to_a_header_opens_that_header_alone(self):
        self.write("sdk/fit/b.cpp", '#include "size/value.h"\n')
        self.assert_clean("includes")
        self.write("sdk/fit/b.cpp", '#include "size/value.h"\n#include "size/a.h"\n')
        self.assert_breach("includes", "sdk/fit/b.cpp:2: fit -> size: no arrow")

    def test_a_folder_without_a_row_is_named(self):
        self.write("sdk/new/b.cpp", '#include "core/a.h"\n')
        self.assert_breach("includes", "sdk/new/b.cpp:1: folder sdk/new is not in")

    def test_debts_are_allowed_in_their_number(self):
        self.debts("core -> fit: 1\n")
        self.write("sdk/core/b.cpp", '#include "fit/a.h"\n')
        self.assert_clean("includes")
        self.write("sdk/core/c.cpp", '#include "fit/a.h"\n')
        found = self.breaches("includes")
        self.assertEqual(len(found), 2, found)
        self.assertIn("sdk/core/c.cpp:1: core -> fit: 2 includes, the list has 1", found)

    def test_a_paid_debt_has_to_leave_the_list(self):
        self.debts("core -> fit: 2\n")
        self.write("sdk/core/b.cpp", '#include "fit/a.h"\n')
        self.assert_breach("includes", "scripts/lint.d/include-debts:2: core -> fit: 2 listed, 1 left")
        self.assertEqual(check_includes.update_debts(self.tree()), [])
        self.assertIn("core -> fit: 1\n", (self.root / check_includes.DEBTS).read_text())
        self.assert_clean("includes")

    def test_the_list_does_not_grow(self):
        self.debts("core -> fit: 1\ncore -> size: 1\n")
        before = (self.root / check_includes.DEBTS).read_text()
        self.write("sdk/core/b.cpp", '#include "fit/a.h"\n')
        self.write("sdk/core/c.cpp", '#include "fit/a.h"\n')
        self.assertEqual(len(check_includes.update_debts(self.tree())), 2)
        self.assertEqual((self.root / check_includes.DEBTS).read_text(), before)

    def test_a_unit_test_sees_what_its_module_sees(self):
        self.write("tests/unit/fit/a_test.cpp", '#include "fit/a.h"\n#include "core/a.h"\n')
        self.assert_clean("includes")
        self.write("tests/unit/core/a_test.cpp", '#include "core/a.h"\n#include "fit/a.h"\n')
        self.assert_breach("includes", "tests/unit/core/a_test.cpp:2: tests/unit/core -> fit: no arrow")

    def test_a_debt_of_its_module_too(self):
        self.debts("core -> fit: 1\n")
        self.write("sdk/core/b.cpp", '#include "fit/a.h"\n')
        self.write("tests/unit/core/a_test.cpp", '#include "fit/a.h"\n')
        self.assert_clean("includes")


class HeadersTest(RepositoryTest):
    def setUp(self):
        super().setUp()
        self.commit_base()

    def test_a_header_that_asks_for_what_it_uses_passes(self):
        self.write("sdk/core/a.h", "#pragma once\n#include <vector>\nstruct A { std::vector<int> v; };\n")
        self.write("sdk/fit/b.h", '#pragma once\n#include "core/a.h"\nstruct B { A a; };\n')
        self.assert_clean("headers")

    def test_one_that_does_not_is_named_by_its_line(self):
        self.write("sdk/core/a.h", "#pragma once\nstruct A { std::vector<int> v; };\n")
        self.assert_breach("headers", "sdk/core/a.h:2: does not compile by itself")

    def test_a_use_of_a_type_that_is_only_declared_is_found(self):
        # Whatever completes the type comes later in every real source.
        self.write("sdk/core/a.h", "#pragma once\nclass B;\ninline int size() { return sizeof(B); }\n")
        self.write("sdk/core/b.h", '#pragma once\nclass B {};\n#include "core/a.h"\n')
        self.assert_breach("headers", "sdk/core/a.h:3:")

    def test_precompiled_sets_give_nothing_away(self):
        # As many that include <string> as make lint precompile it, and one that uses it without.
        for n in range(check_headers.USERS):
            self.write(f"sdk/core/a{n}.h", f"#pragma once\n#include <string>\nstd::string a{n}();\n")
        self.assert_clean("headers")
        self.assertTrue((self.root / check_headers.PRECOMPILED / "0.h.gch").exists())
        self.write("sdk/core/b.h", "#pragma once\nstd::string b();\n")
        (self.root / check_headers.PASSED).unlink()
        self.assert_breach("headers", "sdk/core/b.h:2:")

    def test_public_headers_are_c99(self):
        self.write("include/vfit.h", "typedef struct vfit_a { int a; } vfit_a;\n")
        self.assert_clean("headers")
        self.write("include/vfit.h", "struct vfit_a { int a = 0; };\n")
        self.assert_breach("headers", "include/vfit.h:1:")

    def test_a_header_breaks_by_what_it_includes(self):
        self.write("sdk/core/a.h", "#pragma once\nstruct A {};\n")
        self.write("sdk/core/b.h", '#pragma once\n#include "core/a.h"\nstruct B : A {};\n')
        self.assert_clean("headers")
        self.write("sdk/core/a.h", "#pragma once\nstruct C {};\n")  # b.h is as it was and in the cache
        self.assert_breach("headers", "sdk/core/b.h:3:")

    def test_only_what_the_change_touches_is_compiled(self):
        self.write("sdk/core/broken.h", "#pragma once\nA a;\n")
        self.write("sdk/core/a.h", "#pragma once\n")
        self.commit_base()
        self.write("sdk/core/a.h", "#pragma once\nstruct A {};\n")
        self.assert_clean("headers")
        self.assert_breach("headers", "sdk/core/broken.h:2:", self.tree(everything=True))

    def test_a_library_that_is_not_installed_is_said(self):
        self.write("sdk/core/a.h", "#pragma once\n#include <no_such_library.h>\n")
        tree = self.tree()
        self.assert_clean("headers", tree)
        self.assertIn("no_such_library.h", tree.skipped[0][1])


if __name__ == "__main__":
    unittest.main()
