"""Checks that look at files alone: text, columns, syntax, places, ci, format."""

import os
import stat
import unittest

from repository import RepositoryTest

import formatters


class TextTest(RepositoryTest):
    def test_plain_text_passes(self):
        self.write("a.cpp", "int a;\n")
        self.write("empty.txt", "")
        self.write("picture.png", b"\x89PNG\0")
        self.write("Unity.cs.meta", "guid: 1\n  userData: \n")
        self.assert_clean("text")

    def test_each_fault_is_named(self):
        for text, line, what in (
            (b"int a;", 1, "no newline at the end"),
            (b"int a;\n\n", 2, "empty line at the end"),
            (b"int a;\n \nint b;\n", 2, "trailing white space"),
            (b"\n\tint a;\n", 2, "tab"),
            (b"int a;\r\nint b;\r\n", 1, "carriage return"),
            (b"// caf\xe9\n", 1, "neither UTF-8 text"),
            (b"a\0b\n", 1, "neither UTF-8 text"),
        ):
            with self.subTest(what):
                self.write("a.cpp", text)
                self.assert_breach("text", f"a.cpp:{line}: {what}")


class ColumnsTest(RepositoryTest):
    def test_110_columns_pass_and_111_do_not(self):
        self.write("a.py", "#" * 110 + "\n")
        self.assert_clean("columns")
        self.write("a.py", "\n" + "#" * 111 + "\n")
        self.assert_breach("columns", "a.py:2: 111 columns")

    def test_columns_are_characters(self):
        self.write("a.cs", "// " + "é" * 107 + "\n")
        self.assert_clean("columns")

    def test_generated_files_and_markdown_are_left_out(self):
        self.write("tests/abi/offsets.c", "/" * 200 + "\n")
        self.write("README.md", "a" * 200 + "\n")
        self.assert_clean("columns")

    def test_generated_csharp_counts(self):
        self.write("bindings/csharp/a/Generated/Calls.cs", "/" * 111 + "\n")
        self.assert_breach("columns", "bindings/csharp/a/Generated/Calls.cs:1:")

    def test_programs_without_a_suffix_count(self):
        self.write("scripts/run", "#!/usr/bin/env bash\n" + "#" * 111 + "\n")
        self.assert_breach("columns", "scripts/run:2:")


class SyntaxTest(RepositoryTest):
    def test_what_parses_passes(self):
        self.write("a.py", "print('a')\n")
        self.write("run", "#!/usr/bin/env bash\nif true; then echo a; fi\n")
        self.write("make", "#!/usr/bin/env python3\nprint('a')\n")
        self.write("a.json", "{}\n")
        self.assert_clean("syntax")

    def test_what_does_not_parse_is_named(self):
        for path, text, line in (
            ("a.py", "\nprint('a'\n", 2),
            ("escape.py", "\na = '\\d'\n", 2),
            ("run", "#!/usr/bin/env bash\necho )\n", 2),
            ("make", "#!/usr/bin/env python3\ndef\n", 2),
            ("a.json", '{\n"a": 1\n"b": 2\n}\n', 3),
            ("a.asmdef", "[\n", 2),
        ):
            with self.subTest(path):
                self.write(path, text)
                self.assert_breach("syntax", f"{path}:{line}:")
                self.git("rm", "--quiet", "--force", path)


class PlacesTest(RepositoryTest):
    def setUp(self):
        super().setUp()
        self.copy_list("places")

    def test_relative_places_pass(self):
        self.write("run", 'root="$HOME/work"\ncp "$work/root/a" ~/home/b\n# https://example.org/work/\n')
        self.assert_clean("places")

    def test_places_of_one_machine_are_named(self):
        for text in (
            "/home" + "/ann/vfit",
            "/Users" + "/ann",
            "cd /wo" + "rk/vfit",
            '"C:\\' + 'Users\\ann"',
            "https://py" + "pi.org/simple",
            "http:/" + "/mirror.example.org/debian",
            "https://build.ex" + "ample.internal/x",
        ):
            with self.subTest(text):
                self.write("a.md", f"\nsee {text}\n")
                self.assert_breach("places", "a.md:2:")


class CiTest(RepositoryTest):
    def setUp(self):
        super().setUp()
        self.write("scripts/test", "#!/usr/bin/env bash\n")
        self.write(".ci/run", '#!/usr/bin/env bash\nexec "$(dirname "$0")/../scripts/test"\n')

    def test_the_same_script_passes(self):
        self.write(".github/workflows/ci.yml", "jobs:\n  - run: ./scripts/test\n")
        self.assert_clean("ci")

    def test_another_script_does_not(self):
        self.write(".github/workflows/ci.yml", "jobs:\n  - run: ctest  # not scripts/test\n")
        self.assert_breach("ci", ".github/workflows/ci.yml:1: does not call scripts/test")

    def test_nor_a_script_that_is_gone(self):
        self.write(".github/workflows/ci.yml", "jobs:\n  - run: ./scripts/test\n  - run: ./scripts/gone\n")
        self.assert_breach("ci", ".github/workflows/ci.yml:3: scripts/gone does not exist")

    def test_nor_a_workflow_that_is_missing(self):
        self.assert_breach("ci", ".github/workflows/ci.yml:1: missing")


@unittest.skipUnless(formatters.present(), "the formatters are not installed: scripts/format installs them")
class FormatTest(RepositoryTest):
    def setUp(self):
        super().setUp()
        self.write(".clang-format", "BasedOnStyle: Google\n")
        self.write("ruff.toml", "line-length = 110\n")

    def test_formatted_files_pass(self):
        self.write("a.cpp", "int a = 1;\n")
        self.write("a.py", 'print("a")\n')
        self.assert_clean("format")

    def test_others_are_named_by_their_first_line(self):
        self.write("a.cpp", "int a = 1;\nint   b = 2;\nint  c = 3;\n")
        self.assert_breach("format", "a.cpp:2: not formatted")
        self.git("rm", "--quiet", "--force", "a.cpp")
        self.write("make", "#!/usr/bin/env python3\nprint( 'a' )\n")
        self.assert_breach("format", "make:1: not formatted")

    def test_generated_files_are_left_out(self):
        self.write("tests/abi/offsets.c", "int   a;\n")
        self.assert_clean("format")

    def test_apply_does_what_the_check_wants(self):
        self.write("a.cpp", "int   a;\n")
        self.write("a.py", "print( 1 )\n")
        formatters.apply(self.tree())
        self.assert_clean("format")
        self.assertEqual((self.root / "a.cpp").read_text(), "int a;\n")
        self.assertEqual((self.root / "a.py").read_text(), "print(1)\n")


class FormattersTest(RepositoryTest):
    def test_without_network_the_check_is_skipped_and_says_what_to_do(self):
        os.environ["VFIT_FORMATTERS"] = str(self.root)
        self.addCleanup(os.environ.pop, "VFIT_FORMATTERS")
        tree = self.tree()
        self.assert_clean("format", tree)
        self.assertEqual([name for name, _ in tree.skipped], ["format"])

    def test_other_versions_are_not_used(self):
        for name in formatters.PINNED:
            program = self.root / name
            program.write_text("#!/bin/sh\necho version 1.2.3\n")
            program.chmod(program.stat().st_mode | stat.S_IXUSR)
        os.environ["VFIT_FORMATTERS"] = str(self.root)
        self.addCleanup(os.environ.pop, "VFIT_FORMATTERS")
        with self.assertRaisesRegex(formatters.Missing, "does not hold clang-format 19"):
            formatters.find()


if __name__ == "__main__":
    unittest.main()
