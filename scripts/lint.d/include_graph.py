"""Which files of the tree include which: the one reading of #include lines that all checks share."""

import collections
import posixpath
import re

Include = collections.namedtuple("Include", "line name target")  # target: a path of the tree, None for others

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"][^>"\n]+)[>"]')
# Where a header is looked for beside the includer's own folder, by the includer's path; the longest prefix
# counts. These are the folders of the CMakeLists.txt files, which are not read here: lint runs without cmake.
ROOTS = {
    "include/": ["include"],
    "sdk/": ["sdk", "include"],
    "plugins/": ["plugins", "include"],
    "plugins/openni2/": ["plugins/openni2", "plugins", "include"],
    "plugins/recording/": ["plugins/recording", "plugins", "include"],
    "plugins/virtual_person/": ["plugins/virtual_person", "plugins", "include"],
    "tools/": ["tools", "sdk", "include"],
    "samples/": ["include"],
    "samples/04_fitting_room/": ["samples/04_fitting_room", "include"],
    "samples/paper/": ["samples/paper", "samples/04_fitting_room", "tools", "sdk", "include"],
    "training/": ["tools", "sdk", "include"],
    "bindings/": ["include"],
    "tests/": ["tests", "sdk", "tools", "include"],
    "tests/plugin/": [
        "tests",
        "plugins/virtual_person",
        "plugins",
        "samples/04_fitting_room",
        "sdk",
        "include",
    ],
    "tests/plugin/recording_": ["tests", "plugins/recording", "plugins", "sdk", "include"],
}


def roots(path):
    fitting = [prefix for prefix in ROOTS if path.startswith(prefix)]
    return ROOTS[max(fitting, key=len)] if fitting else []


class IncludeGraph:
    def __init__(self, tree):
        self.tree = tree
        self._known = set(tree.files)
        self._includes = {}
        self._closures = {}

    def _find(self, path, name):
        """The file that an #include means; None for files that are not of the tree."""
        beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), name[1:]))
        candidates = [beside] if name[0] == '"' else []
        candidates += [posixpath.normpath(posixpath.join(root, name[1:])) for root in roots(path)]
        return next((c for c in candidates if c in self._known), None)

    def includes(self, path):
        if path not in self._includes:
            found = []
            for number, line in enumerate(self.tree.lines(path), 1):
                match = INCLUDE.match(line)
                if match:
                    found.append(Include(number, match[1], self._find(path, match[1])))
            self._includes[path] = found
        return self._includes[path]

    def closure(self, path):
        """Every file of the tree that a file includes, however far down."""
        if path not in self._closures:
            reached, waiting = set(), [path]
            while waiting:
                for include in self.includes(waiting.pop()):
                    if include.target and include.target not in reached:
                        reached.add(include.target)
                        waiting.append(include.target)
            self._closures[path] = frozenset(reached - {path})
        return self._closures[path]
