"""Continuous integration runs what a developer runs: .ci/run and the workflow call scripts/test."""

import re

from tree import Breach

RUN = ".ci/run"
WORKFLOW = ".github/workflows/ci.yml"
SCRIPT = re.compile(r"(?<![\w.-])(?:\./|\.\./)?scripts/([\w-]+)")


def _called(tree, path):
    """(line, name) of every script that a file calls, comments left out."""
    for number, line in enumerate(tree.lines(path), 1):
        for name in SCRIPT.findall(line.split("#")[0]):
            yield number, name


def check(tree):
    for path in (RUN, WORKFLOW):
        if path not in tree.files:
            yield Breach(path, 1, "missing")
            continue
        called = list(_called(tree, path))
        if "test" not in [name for _, name in called]:
            yield Breach(path, 1, "does not call scripts/test")
        for number, name in called:
            if f"scripts/{name}" not in tree.files:
                yield Breach(path, number, f"scripts/{name} does not exist")
