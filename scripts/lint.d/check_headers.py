"""Every header compiles by itself; the two public ones as C99 and as C++17.

A change can only break the headers that it touches and those that include them, so only these are compiled
(about 0.3 s each); scripts/lint --all compiles every one. A header that passed is not compiled again until
it, something that it includes, or the compiler changes: build/lint/headers.json has the hashes.
"""

import collections
import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys

from include_graph import IncludeGraph, roots
from tree import Breach

COMPILER = os.environ.get("CXX", "g++")
CXX = ("-x", "c++", "-std=gnu++20")
PUBLIC_CXX = ("-x", "c++", "-std=c++17", "-pedantic-errors")
PUBLIC_C = ("-x", "c", "-std=c99", "-pedantic-errors")
# Below the tree under check.
PASSED = "build/lint/headers.json"
WRITTEN = "build/lint/written"
PRECOMPILED = "build/lint/precompiled"
# Libraries' headers that take most of the time, from light to heavy sets. A set is precompiled for the
# headers that include all of it anyway, themselves or by what they include: they get nothing that they do not
# ask for. Never add a header of the tree, or one that is included under a condition.
GLM = ("glm/glm.hpp", "glm/gtc/quaternion.hpp")
SETS = (
    ("string",),
    GLM,
    (*GLM, "vector"),
    (*GLM, "vector", "memory"),
    ("nlohmann/json.hpp", "string", "vector"),
)
USERS = 8  # of a set, for its compilation to pay
FOLDERS = ("sdk/", "include/", "tools/", "plugins/", "samples/", "tests/", "training/")
# Headers of libraries that are not on the compiler's own path, by their pkg-config names.
LIBRARIES = ("libusb-1.0", "libopenni2", "opencv4", "imgui")
OPENCV_WITHOUT_PKG_CONFIG = "/usr/include/opencv4"
# What CMake defines for every program of tests.
DEFINITIONS = ['-DVFIT_SOURCE_DIR="."', '-DVFIT_DATA_DIR="."', '-DVFIT_PLUGIN_DIR="."']
# Headers that the build writes, and some headers include: by whom they are written.
WRITER, WRITER_INPUT = "tests/storm/make_calls.py", "include/vfit.h"


def _library_flags():
    flags = ["-isystem", OPENCV_WITHOUT_PKG_CONFIG]
    for name in LIBRARIES:
        try:
            run = subprocess.run(["pkg-config", "--cflags-only-I", name], capture_output=True, text=True)
        except FileNotFoundError:
            break
        flags += [word for flag in run.stdout.split() for word in ("-isystem", flag[2:])]
    return flags


def _write_headers(tree):
    if WRITER in tree.files:
        subprocess.run([sys.executable, "-B", WRITER, WRITER_INPUT, WRITTEN], cwd=tree.root, check=True)


class Compiler:
    """Compiles one header at a time with the flags of the build, in the folder of the tree."""

    def __init__(self, root):
        self.root = root
        self.flags = ["-fsyntax-only", "-w", *DEFINITIONS, *_library_flags(), f"-I{WRITTEN}", "-I."]
        self.version = subprocess.run([COMPILER, "--version"], capture_output=True, text=True).stdout

    def precompile(self, names, path):
        """Compiles a set of libraries' headers; where it fails, each header reads what it includes."""
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("".join(f"#include <{name}>\n" for name in names))
        flags = [flag for flag in self.flags if flag != "-fsyntax-only"]
        command = [COMPILER, "-std=gnu++20", *flags, "-x", "c++-header", path, "-o", f"{path}.gch"]
        subprocess.run(command, cwd=self.root, capture_output=True)

    def errors(self, header, precompiled=None):
        """What the compiler says of a file that includes nothing else; empty where it compiles."""
        languages = (PUBLIC_C, PUBLIC_CXX) if header.startswith("include/") else (CXX,)
        folders = [f"-I{folder}" for folder in roots(header)]
        if precompiled:
            folders += ["-include", precompiled]
        for language in languages:
            command = [COMPILER, *language, *self.flags, *folders, "-"]
            source = f'#include "{header}"\n'
            run = subprocess.run(command, cwd=self.root, input=source, capture_output=True, text=True)
            if run.returncode:
                return run.stderr
        return ""


def _digest(compiler, graph, header):
    """A hash of all that decides whether a header compiles, except the system's own headers."""
    parts = hashlib.sha256(repr((compiler.version, compiler.flags, header, roots(header))).encode())
    for path in sorted(graph.closure(header) | {header}):
        parts.update(path.encode() + b"\0" + graph.tree.data(path) + b"\0")
    return parts.hexdigest()


def _read_passed(tree):
    try:
        return set(json.loads((tree.root / PASSED).read_text()))
    except (OSError, ValueError):
        return set()


def _keep_passed(tree, digests):
    file = tree.root / PASSED
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(sorted(digests), indent=0))


def _breach(header, errors):
    found = re.search(r"^(\S+?):(\d+):(?:\d+:)? (?:fatal )?error: (.*)", errors, flags=re.M)
    if found and found[1] == header:
        return Breach(header, int(found[2]), f"does not compile by itself: {found[3]}")
    where = f"{found[1]}:{found[2]}: {found[3]}" if found else errors.strip()
    return Breach(header, 1, f"does not compile by itself: {where}")


def _absent_library(errors):
    """The name of a header in <> that is not installed: then nothing can be said."""
    name = re.search(r"fatal error: (\S+): No such file or directory\n.*#\s*include\s*<", errors)
    return name and name[1]


def _precompiled(graph, headers):
    """{header: the set that is precompiled for it}, of sets with enough users."""
    chosen = {}
    for header in headers:
        if not header.startswith("include/"):
            files = graph.closure(header) | {header}
            names = {i.name[1:] for file in files for i in graph.includes(file) if not i.target}
            chosen[header] = next((s for s in reversed(SETS) if names.issuperset(s)), None)
    users = collections.Counter(chosen.values())
    return {header: names for header, names in chosen.items() if names and users[names] >= USERS}


def _to_compile(tree, graph):
    """The headers that the change can break, or all; None where no base tells what the change is."""
    headers = [path for path in tree.files if path.endswith(".h") and path.startswith(FOLDERS)]
    if tree.everything:
        return headers
    base = tree.base()
    if not base:
        return None
    changed = tree.changed_files(base)
    return [header for header in headers if changed & (graph.closure(header) | {header})]


def check(tree):
    graph = IncludeGraph(tree)
    headers = _to_compile(tree, graph)
    if headers is None:
        tree.skip("headers", "no history to compare with; scripts/lint --all compiles every header")
        return
    compiler = Compiler(tree.root)
    _write_headers(tree)
    digests = {header: _digest(compiler, graph, header) for header in headers}
    passed = _read_passed(tree)
    waiting = [header for header in headers if digests[header] not in passed]
    chosen = _precompiled(graph, waiting)
    paths = {names: f"{PRECOMPILED}/{SETS.index(names)}.h" for names in set(chosen.values())}
    absent = set()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(compiler.precompile, paths.keys(), paths.values()))
        prefixes = [paths.get(chosen.get(header)) for header in waiting]
        for header, errors in zip(waiting, pool.map(compiler.errors, waiting, prefixes)):
            if not errors:
                passed.add(digests[header])
            elif _absent_library(errors):
                absent.add(_absent_library(errors))
            else:
                yield _breach(header, errors)
    _keep_passed(tree, passed)
    if absent:
        tree.skip("headers", f"not installed (scripts/setup): {', '.join(sorted(absent))}")
