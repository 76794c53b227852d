"""Includes follow the arrows between folders. Breaches of today are debts: they may only become fewer.

scripts/lint.d/arrows has the table, scripts/lint.d/include-debts the debts, one line a pair of folders:
    fit -> avatar: 1
"""

import collections
import fnmatch
import posixpath
import re

from include_graph import IncludeGraph
from tree import Breach

ARROWS = "scripts/lint.d/arrows"
DEBTS = "scripts/lint.d/include-debts"
SUBJECT = "SUBJECT"
DEBTS_HEAD = """\
# Includes against the arrows (see "arrows"), by pair of folders, with their number. The list may only shrink:
# after a change that removes some, run scripts/lint --update-debts.
"""


class Arrows:
    """The table: which folder may include which."""

    def __init__(self, tree):
        self.targets = {}  # folder, perhaps with a *: what it may include
        sets = {}
        for number, line in tree.config("arrows"):
            match = re.match(r"(\S+)\s*(=|->)\s*(.*)$", line)
            if not match:
                raise SystemExit(f"{ARROWS}:{number}: neither 'name = ...' nor 'folder -> ...'")
            words = [w for word in match[3].split() for w in sets.get(word, [word])]
            (sets if match[2] == "=" else self.targets)[match[1]] = words

    def row(self, folder):
        """The line of the table that a folder has, by its name or by a pattern; None where there is none."""
        if folder in self.targets:
            return folder
        return next((name for name in self.targets if "*" in name and _matches(folder, name)), None)

    def folder(self, path):
        """The nearest folder around a file that the table knows; modules of sdk/ go without that prefix."""
        folder = posixpath.dirname(path)
        folder = folder[len("sdk/") :] if folder.startswith("sdk/") else folder
        while folder and not self.row(folder):
            folder = posixpath.dirname(folder)
        return folder or None

    def allows(self, source, target, header):
        """Whether a file of one folder may include this header of another."""
        name = header[len("sdk/") :] if header.startswith("sdk/") else header
        return any(
            name == word if word.endswith(".h") else _matches(target, word)
            for word in self.targets[self.row(source)]
        )

    def reach(self, start, debts, folders):
        """The folders that some folders get to by arrows and debts, themselves included."""
        reached, waiting = set(start), list(start)
        while waiting:
            source = waiting.pop()
            words = self.targets[self.row(source)]
            aims = {posixpath.dirname(word) if word.endswith(".h") else word for word in words}
            aims |= {target for from_, target in debts if from_ == source}
            for folder in folders:
                if folder not in reached and any(_matches(folder, aim) for aim in aims):
                    reached.add(folder)
                    waiting.append(folder)
        return reached


def _matches(folder, pattern):
    return folder.count("/") == pattern.count("/") and fnmatch.fnmatchcase(folder, pattern)


def _debts(tree):
    """{(from, to): (line, count)} of the list."""
    listed = {}
    for number, line in tree.config("include-debts"):
        match = re.match(r"(\S+)\s+-> (\S+): (\d+)$", line)
        if not match:
            raise SystemExit(f"{DEBTS}:{number}: not 'from -> to: count'")
        listed[match[1], match[2]] = number, int(match[3])
    return listed


def _crossings(tree, arrows):
    """(path, line, from, to, header) of every include that goes from one folder to another."""
    graph = IncludeGraph(tree)
    for path in tree.files:
        if not tree.is_c_family(path) or tree.is_generated(path):
            continue
        source = arrows.folder(path)
        for include in graph.includes(path):
            target = arrows.folder(include.target) if include.target else None
            if target != source and include.target:
                yield path, include.line, source, target, include.target


def _against(tree):
    """{(from, to): [(path, line)]} of includes that no arrow allows; breaches of folders without a row."""
    arrows = Arrows(tree)
    folders = {arrows.folder(path) for path in tree.files if tree.is_c_family(path)} - {None}
    against, unknown, of_tests = collections.defaultdict(list), [], []
    for path, line, source, target, header in _crossings(tree, arrows):
        if not source or not target:
            missing = posixpath.dirname(header if source else path)
            unknown.append(Breach(path, line, f"folder {missing} is not in {ARROWS}"))
        elif arrows.allows(source, target, header):
            continue
        elif SUBJECT in arrows.targets[arrows.row(source)]:
            of_tests.append((path, line, source, target))
        else:
            against[source, target].append((path, line))
    # Tests come last: what they may see depends on the debts of what they test.
    reached = {}
    for path, line, source, target in of_tests:
        if source not in reached:
            subject = posixpath.basename(source)
            own = [f for f in folders if f == subject or f.startswith(subject + "/")]
            reached[source] = arrows.reach(own, against, folders)
        if target not in reached[source]:
            against[source, target].append((path, line))
    return against, unknown


def _growth(against, listed):
    for pair, places in sorted(against.items()):
        allowed = listed.get(pair, (0, 0))[1]
        if len(places) > allowed:
            for path, line in places:
                known = (
                    f"{len(places)} includes, the list has {allowed}" if allowed else f"no arrow in {ARROWS}"
                )
                yield Breach(path, line, f"{pair[0]} -> {pair[1]}: {known}")


def check(tree):
    against, unknown = _against(tree)
    listed = _debts(tree)
    yield from unknown
    yield from _growth(against, listed)
    for pair, (number, count) in listed.items():
        now = len(against.get(pair, []))
        if now < count:
            what = f"{pair[0]} -> {pair[1]}: {count} listed, {now} left: run scripts/lint --update-debts"
            yield Breach(DEBTS, number, what)


def update_debts(tree):
    """Writes the list anew where it shrinks; returns the breaches that it would have to grow by."""
    against, unknown = _against(tree)
    grown = unknown + list(_growth(against, _debts(tree)))
    if not grown:
        lines = [
            f"{source} -> {target}: {len(places)}\n" for (source, target), places in sorted(against.items())
        ]
        (tree.root / DEBTS).write_text(DEBTS_HEAD + "".join(lines), encoding="utf-8")
    return grown
