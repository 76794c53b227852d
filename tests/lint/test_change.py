"""Checks that look at what a change adds: words, commit subjects, and how the base is found."""

import os
import pathlib
import re
import shutil
import tempfile
import unittest

from repository import PROJECT, RepositoryTest

import check_commits
import check_words
from tree import Tree

# One line or more for every pattern of the list, in the order of the list.
OLD = {
    "prose": """
Nobody is in view.
For whoever builds it.
Vertices who are pinned stay.
Who is pushed by the body pushes back.
The sum of who moves.
The same, but for rounding.
It is not there as yet.
It moves by so much.
That which counts is added.
Those that contact does not move, or not all of.
What lies beyond an end counts to the layer there.
The last word on layers.
The list may have become another.
Takes as long as some 35 steps.
A step takes some ten milliseconds.
It was what a person is that moved.
The chance that it is right.
The share of the bodies.
The mean body is scaled.
Its tallness is known.
A circumference of the waist.
It turns in the world.
Two layers go through each other.
Stillness is kept.
A room of the library.
The library's own rooms.
""",
    "code": """
constexpr int kMostLayers = 3;
constexpr float kLeastStep_s = 1e-4f;
int most_layers = 3;
int least_layers = 3;
int kNobody = -1;
bool for_whoever = true;
float tallness_m = 1.8f;
""",
    "c++": """
float near = 0.1f;
""",
}
GOOD = """
// The source ended without a person in view.
// This is for cuffs, not for hems but for sleeves.
// Some of ten bones; the file that holds them.
// A vertex whose neighbors move, for which the host asks. Who are we?
// By chance, a chance to rest, lines that share a base.
// What is the ease? What follows is measured.
// Least squares in world space; most of it is nearer, far away.
constexpr int kLeastSquares = 1;
int least_squares = almost_there + kMostly, nearest = far_m + near_plane;
const char* text = "near and far";
"""


def fragments(text):
    return [line for line in text.split("\n") if line]


class WordsTest(RepositoryTest):
    def setUp(self):
        super().setUp()
        self.copy_list("words")
        self.commit_base()

    def test_good_lines_pass(self):
        self.write("sdk/a.cpp", GOOD)
        self.assert_clean("words")

    def test_every_pattern_has_an_old_line_and_every_old_line_a_pattern(self):
        listed = list(check_words.words(self.tree()))
        for scope, text in OLD.items():
            words = [word for word in listed if word.scope == scope]
            for line in fragments(text):
                self.assertTrue(any(w.pattern.search(line) for w in words), line)
            for word in words:
                self.assertTrue(any(word.pattern.search(x) for x in fragments(text)), word.pattern.pattern)
        self.assertEqual({word.scope for word in listed}, set(OLD))

    def test_the_replacements_of_the_style_guide_pass(self):
        rows = re.findall(r"^\| (.+) \| (.+) \|$", (PROJECT / "docs/style.md").read_text(), flags=re.M)
        after = [new for old, new in rows if old.endswith(".")]
        self.assertGreater(len(after), 8)
        self.write("docs/a.md", "\n".join(after) + "\n")
        self.assert_clean("words")

    def test_old_words_are_named_with_what_to_say(self):
        self.write("docs/a.md", "A line.\nNobody is in view.\n")
        self.assert_breach("words", "docs/a.md:2: 'Nobody': say \"person\"")

    def test_only_added_lines_count(self):
        self.write("docs/a.md", "Nobody is in view.\nA line.\n")
        self.commit_base()
        self.write("docs/a.md", "Nobody is in view.\nAnother line.\n")
        self.assert_clean("words")
        self.commit()
        self.assert_clean("words")
        self.write("docs/a.md", "Nobody is in view.\nAnother line, but for this.\n")
        self.assert_breach("words", "docs/a.md:2: 'but for'")

    def test_new_line_breaks_add_no_words(self):
        self.write("sdk/a.cpp", '// Nobody is in view.\nconst char* a = "nobody is here";\n')
        self.commit_base()
        self.write("sdk/a.cpp", '// Nobody\n// is in view.\nconst char* a =\n    "nobody "\n    "is here";\n')
        self.assert_clean("words")
        self.write(
            "sdk/a.cpp", '// Nobody\n// is out of view.\nconst char* a = "nobody is here";\n// But for\n'
        )
        self.assert_breach("words", "sdk/a.cpp:4: 'But for'")

    def test_moved_files_do_not_count(self):
        self.write("docs/a.md", "Nobody is in view.\n" + "A line.\n" * 9)
        self.commit_base()
        self.git("mv", "docs/a.md", "docs/b.md")
        self.assert_clean("words")

    def test_code_and_prose_are_apart(self):
        self.write("sdk/a.cpp", "int a;  // near, kMostLayers\nint b = far(1);\n")
        self.assert_breach("words", "sdk/a.cpp:2: 'far'")
        self.write("sdk/a.cpp", "int a;\n")
        self.write("a.py", "near = 1  # but for this\n")
        self.assert_breach("words", "a.py:1: 'but for'")

    def test_an_identifier_that_the_base_has_may_be_used(self):
        self.write("sdk/a.h", "constexpr int kMostLayers = 3;\n")
        self.commit_base()
        self.write("sdk/a.cpp", "int a = kMostLayers;\n")
        self.assert_clean("words")
        self.write("sdk/a.cpp", "int a = kMostLayers + kMostGarments;\n")
        self.assert_breach("words", "sdk/a.cpp:1: 'kMostGarments'")


class CommitsTest(RepositoryTest):
    def setUp(self):
        super().setUp()
        self.commit("test: begin")

    def test_good_subjects_pass(self):
        for subject in (
            "contact: bound displacement per vertex",
            "README: Say what runs",
            "api, docs: process each frame once",
            "sdk/core: embed the table",
            "c++: need no RTTI",
            'Revert "contact: bound displacement"',
            "a: " + "b" * 69,
        ):
            self.assertEqual(list(check_commits.faults(subject)), [], subject)
            self.commit(subject)
            self.assert_clean("commits")

    def test_bad_subjects_do_not(self):
        for subject, fault in (
            ("a: " + "b" * 70, "73 characters"),
            ("contact: bound displacement.", "a period"),
            ("Bound displacement per vertex", "no area"),
            ("fixup! contact: bound displacement", "no area"),
            ("contact: bounds displacement", "'bounds' is no imperative"),
            ("contact: Added a bound", "'added' is no imperative"),
            ("contact: mapping of vertices", "'mapping' is no imperative"),
            ("contact: the bound per vertex", "'the' is no imperative"),
        ):
            self.commit(subject)
            self.assert_breach("commits", f"commit {self.git('rev-parse', '--short', 'HEAD')}:1: {fault}")

    def test_every_commit_of_a_branch_counts(self):
        self.git("checkout", "--quiet", "-b", "change")
        self.commit("Bad one")
        self.commit("Bad two")
        self.assertEqual(len(self.breaches("commits")), 2)

    def test_what_was_written_before_the_rule_is_exempt(self):
        os.environ["GIT_AUTHOR_DATE"] = "2026-11-24T12:00:00+00:00"
        self.commit("Old words, written long ago.")
        self.assert_clean("commits")

    def test_a_merge_is_warned_of(self):
        self.git("checkout", "--quiet", "-b", "change")
        self.commit("test: add a")
        self.git("checkout", "--quiet", "main")
        self.git("merge", "--quiet", "--no-ff", "-m", "Merge branch change", "change")
        tree = self.tree()
        self.assert_clean("commits", tree)
        self.assertIn("no area", tree.warnings[0])


class BaseTest(RepositoryTest):
    def setUp(self):
        super().setUp()
        for n in range(3):
            self.commit(f"test: add {n}")

    def id(self, name):
        return self.git("rev-parse", name)

    def test_on_main_it_is_the_commit_before(self):
        self.assertEqual(self.tree().base(), self.id("HEAD~1"))

    def test_on_a_branch_it_is_where_the_branch_left_main(self):
        left = self.id("HEAD")
        self.git("checkout", "--quiet", "-b", "change")
        self.commit("test: change")
        self.commit("test: change more")
        self.assertEqual(self.tree().base(), left)

    def test_main_of_origin_comes_before_that_of_the_clone(self):
        self.git("update-ref", "refs/remotes/origin/main", "HEAD~2")
        self.assertEqual(self.tree().base(), self.id("HEAD~2"))

    def test_the_environment_comes_before_both(self):
        os.environ["VFIT_LINT_BASE"] = self.id("HEAD~2")
        self.assertEqual(self.tree().base(), self.id("HEAD~2"))

    def test_a_base_that_is_not_there_is_passed_over(self):
        for named in ("0" * 40, "1" * 40, ""):
            os.environ["VFIT_LINT_BASE"] = named
            self.assertEqual(self.tree().base(), self.id("HEAD~1"))

    def test_without_history_checks_of_a_change_are_skipped(self):
        with tempfile.TemporaryDirectory() as folder:
            shallow, archive = pathlib.Path(folder, "shallow"), pathlib.Path(folder, "archive")
            self.write("a.md", "Nobody.\n")
            self.commit("Bad")
            self.git("clone", "--quiet", "--depth", "1", self.root.as_uri(), str(shallow))
            shutil.copytree(shallow, archive, ignore=shutil.ignore_patterns(".git"))
            for root in (shallow, archive):
                for check in ("words", "commits", "headers"):
                    tree = Tree(root)
                    self.assertEqual(tree.files, ["a.md"])
                    self.assert_clean(check, tree)
                    self.assertEqual([name for name, _ in tree.skipped], [check])


if __name__ == "__main__":
    unittest.main()
