"""C, C++ and Python are laid out as scripts/format does it."""

import formatters
from tree import Breach


def check(tree):
    try:
        found = formatters.differences(tree)
    except formatters.Missing as reason:
        tree.skip("format", str(reason))
        return
    for path, line in found.items():
        yield Breach(path, line, f"not formatted: run scripts/format {path}")
