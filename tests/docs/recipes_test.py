#!/usr/bin/env python3
"""The recipes of docs/recipes stay true: their files are made, their commands run, their output compared.

    recipes_test.py VFIT [TEST ...]

Each page runs in a folder that looks like a built clone, up to its heading "For a pull request". A file is a
block below "Create `NAME`". An sh block whose commands are all in RUN is run. A text block behind it is its
output: "..." stands for any lines, or for the rest of a line, and numbers may differ by a tenth.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest

VFIT = pathlib.Path(sys.argv[1]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs" / "recipes"
RUN = ("build/bin/vfit", "cc", "python3", "echo")
FOLDERS = "assets bindings cmake docs include plugins samples scripts sdk tests tools training".split()
NUMBER = re.compile(r"(\d+(?:\.\d+)?)")


def page_text(name):
    """A page without its part on pull requests."""
    return (PAGES / name).read_text(encoding="utf-8").split("\n## For a pull request\n")[0]


def blocks(text):
    """Language and text of each block, with the text since the block before."""
    end = 0
    for match in re.finditer(r"^( *)```(\w+)\n(.*?)^\1```$", text, re.M | re.S):
        yield match[2], textwrap.dedent(match[3]), text[end : match.start()]
        end = match.end()


def same_number(expected, actual):
    last_digit = 10.0 ** -len(expected.partition(".")[2])
    value = float(expected)
    return abs(float(actual) - value) <= (0.1 * value + last_digit if value else 0.0)


def same_word(expected, actual, is_time):
    wanted, found = NUMBER.split(expected), NUMBER.split(actual)
    return wanted[::2] == found[::2] and (is_time or all(map(same_number, wanted[1::2], found[1::2])))


def same_line(expected, actual):
    open_end = expected.endswith("...")
    wanted, found = expected.removesuffix("...").split(), actual.split()
    if len(wanted) > len(found) or (len(wanted) < len(found) and not open_end):
        return False
    if open_end and wanted and not expected.endswith(" ..."):
        found[len(wanted) - 1] = found[len(wanted) - 1][: len(wanted[-1])]  # cut within the word
    times = [follower.rstrip(",") in ("s", "ms") for follower in wanted[1:]] + [False]
    return all(map(same_word, wanted, found, times))


def same_lines(expected, actual):
    if not expected:
        return not actual
    if expected[0].strip() == "...":
        return any(same_lines(expected[1:], actual[i:]) for i in range(len(actual) + 1))
    return bool(actual) and same_line(expected[0], actual[0]) and same_lines(expected[1:], actual[1:])


def built_clone(folder):
    """Links to the tree and a copy of the library, which looks for plug-ins and data beside itself."""
    for name in FOLDERS:
        (folder / name).symlink_to(ROOT / name)
    (folder / "build" / "bin").mkdir(parents=True)
    (folder / "build" / "bin" / "vfit").symlink_to(VFIT)
    lib, built = folder / "build" / "lib", VFIT.parents[1] / "lib"
    (lib / "vfit_plugins").mkdir(parents=True)
    shutil.copy(built / "libvfit.so.0", lib)
    (lib / "libvfit.so").symlink_to("libvfit.so.0")
    for name in ("vfit_data", "vfit_modules"):
        (lib / name).symlink_to(built / name)
    for path in (built / "vfit_plugins").iterdir():
        (lib / "vfit_plugins" / path.name).symlink_to(path)


class Matching(unittest.TestCase):
    """A comparison that takes everything would prove nothing."""

    def test_words_and_numbers_are_compared(self):
        self.assertTrue(same_lines(["hip  1.00 m, in 2 s"], ["hip 1.05  m, in 30 s"]))
        for other in ("hip 1.2 m, in 2 s", "hop 1.00 m, in 2 s", "hip 1.00 m", "hip 1.00 m, in 2 s, so"):
            self.assertFalse(same_lines(["hip  1.00 m, in 2 s"], [other]), other)
        self.assertFalse(same_lines(["0 crossings"], ["1 crossings"]))

    def test_dots_stand_for_lines_and_ends(self):
        self.assertTrue(same_lines(["a", "...", "d e..."], ["a", "b", "c", "d efg h"]))
        self.assertTrue(same_lines(["...", "a"], ["a"]))
        self.assertFalse(same_lines(["a", "...", "d"], ["a", "b"]))
        self.assertFalse(same_lines(["a e..."], ["a"]))


class Recipes(unittest.TestCase):
    maxDiff = None

    def follow(self, name, least):
        """Makes the files and runs the commands of a page, `least` outputs of which are compared."""
        compared = 0
        with tempfile.TemporaryDirectory() as path:
            folder = pathlib.Path(path)
            built_clone(folder)
            environment = {
                **os.environ,
                "LC_ALL": "C.UTF-8",
                "LD_LIBRARY_PATH": str(folder / "build" / "lib"),
            }
            page = list(blocks(page_text(name)))
            for (language, text, above), following in zip(page, [*page[1:], ("", "", "text")]):
                created = re.findall(r"[Cc]reate `([\w.]+)`", above)
                if language == "sh" and all(line.split()[0] in RUN for line in text.splitlines()):
                    done = subprocess.run(
                        ["bash", "-c", text],
                        cwd=folder,
                        env=environment,
                        stdout=subprocess.PIPE,
                        stderr=subprocess.STDOUT,
                        text=True,
                        timeout=120,
                    )
                    if following[0] != "text" or following[2].strip():
                        self.assertEqual((done.stdout, done.returncode), ("", 0), text)
                        continue
                    wanted = following[1].rstrip().splitlines()
                    found = done.stdout.rstrip().splitlines()
                    if not same_lines(wanted, found):
                        self.assertEqual(wanted, found, f"{name}: what this prints:\n{text}")
                    compared += 1
                elif created and language in ("json", "python", "c"):
                    (folder / created[-1]).write_text(text, encoding="utf-8")
        self.assertGreaterEqual(compared, least)

    @unittest.skipUnless(shutil.which("cc"), "no C compiler named cc")
    def test_sensor(self):
        self.follow("sensor.md", 3)

    def test_measure(self):
        self.follow("measure.md", 2)

    def test_garment(self):
        self.follow("garment.md", 3)

    def test_size_chart(self):
        self.follow("size-chart.md", 2)

    def test_binding(self):
        self.follow("binding.md", 2)


class Pages(unittest.TestCase):
    def test_links_and_paths_exist(self):
        for page in PAGES.glob("*.md"):
            text = page.read_text(encoding="utf-8")
            prose = re.sub(r"^( *)```.*?^\1```$", "", text, flags=re.M | re.S)
            for link in re.findall(r"\]\(([^)#]+)[^)]*\)", prose):
                self.assertTrue((PAGES / link).exists(), f"{page.name}: {link}")
            for path in re.findall(r"`((?:" + "|".join(FOLDERS) + r")/[\w./-]+)`", page_text(page.name)):
                self.assertTrue((ROOT / path).exists(), f"{page.name}: {path}")

    @unittest.skipUnless(shutil.which("git"), "no git")
    def test_changes_apply(self):
        count = 0
        for page in PAGES.glob("*.md"):
            for language, text, _ in blocks(page_text(page.name)):
                if language != "diff":
                    continue
                done = subprocess.run(
                    ["git", "apply", "--check", "-"], cwd=ROOT, input=text, capture_output=True, text=True
                )
                self.assertEqual((done.stderr, done.returncode), ("", 0), page.name)
                count += 1
        self.assertGreater(count, 0)


def write_report(result, path):
    """Skipped tests by name, for scripts/skipped-tests."""
    failed = [test for test, _ in result.failures + result.errors]
    named = {"failed": [(t, "") for t in failed], "skipped": result.skipped, "passed": result.passed}
    report = {
        kind: [{"name": test.id().removeprefix("__main__."), "reason": reason} for test, reason in tests]
        for kind, tests in named.items()
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(report, indent=2))


class Result(unittest.TextTestResult):
    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.passed = []

    def addSuccess(self, test):
        super().addSuccess(test)
        self.passed.append((test, ""))


if __name__ == "__main__":
    runner = unittest.TextTestRunner(verbosity=2, resultclass=Result)
    result = unittest.main(argv=[sys.argv[0], *sys.argv[2:]], testRunner=runner, exit=False).result
    if folder := os.environ.get("VFIT_TEST_REPORTS"):
        write_report(result, pathlib.Path(folder) / "docs_recipes.json")
    sys.exit(not result.wasSuccessful())
