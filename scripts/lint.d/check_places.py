"""Nothing in the tree says where it was made: no home or work paths, no host names of package registries."""

import re

from tree import Breach

LIST = "scripts/lint.d/places"


def check(tree):
    patterns = [re.compile(line) for _, line in tree.config("places")]
    for path in tree.files:
        text = tree.text(path)
        if path == LIST or text is None:
            continue
        for pattern in patterns:
            for found in pattern.finditer(text):
                line = text.count("\n", 0, found.start()) + 1
                yield Breach(path, line, f"'{found.group()}' names a place of one machine or network")
