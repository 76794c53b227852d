"""The programs scripts/lint and scripts/format as a developer calls them."""

import shutil
import subprocess
import sys
import unittest

from repository import PROJECT, RepositoryTest


class LintTest(RepositoryTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(PROJECT / "scripts/lint.d", self.root / "scripts/lint.d")
        for name in ("lint", "format"):
            shutil.copy(PROJECT / "scripts" / name, self.root / "scripts" / name)
        self.write("scripts/lint.d/include-debts", "# none\n")
        self.git("add", "--all")
        self.commit_base()

    def run_script(self, name, *arguments):
        command = [sys.executable, "-B", self.root / "scripts" / name, *arguments]
        return subprocess.run(command, cwd="/", capture_output=True, text=True)

    def test_a_clean_tree_ends_with_0(self):
        run = self.run_script("lint", "text", "columns", "syntax", "places", "includes", "words", "commits")
        self.assertEqual((run.returncode, run.stdout), (0, ""), run.stderr)
        self.assertIn("lint: no breaches", run.stderr)

    def test_a_breach_is_printed_with_file_and_line_and_ends_with_1(self):
        self.write("a.py", "a = 1 \n")
        run = self.run_script("lint", "text", "columns")
        self.assertEqual((run.returncode, run.stdout), (1, "a.py:1: trailing white space\n"))

    def test_what_is_skipped_fails_only_when_strict(self):
        shutil.rmtree(self.root / ".git")
        run = self.run_script("lint", "words")
        self.assertEqual(run.returncode, 0)
        self.assertIn("lint: skipped words", run.stderr)
        self.assertEqual(self.run_script("lint", "--strict", "words").returncode, 1)

    def test_all_checks_are_listed(self):
        files = sorted(p.stem[len("check_") :] for p in (PROJECT / "scripts/lint.d").glob("check_*.py"))
        run = self.run_script("lint", "--list")
        self.assertEqual(sorted(line.split()[0] for line in run.stdout.splitlines()), files)

    def test_an_unknown_check_is_refused(self):
        self.assertEqual(self.run_script("lint", "nothing").returncode, 1)

    def test_debts_are_updated_but_never_added(self):
        self.write("scripts/lint.d/include-debts", "fit -> avatar: 1\n")
        self.assertEqual(self.run_script("lint", "includes").returncode, 1)
        self.assertEqual(self.run_script("lint", "--update-debts").returncode, 0)
        self.assertEqual(self.run_script("lint", "includes").returncode, 0)
        self.write("sdk/avatar/a.h", "#pragma once\n")
        self.write("sdk/fit/a.h", '#pragma once\n#include "avatar/a.h"\n')
        run = self.run_script("lint", "--update-debts")
        self.assertEqual(run.returncode, 1)
        self.assertIn("sdk/fit/a.h:2: fit -> avatar", run.stdout)

    def test_format_refuses_files_that_are_not_there(self):
        run = self.run_script("format", self.root / "gone.cpp")
        self.assertEqual(run.returncode, 1)
        self.assertIn("is not a file", run.stderr)


if __name__ == "__main__":
    unittest.main()
