"""The pinned formatters: where they are, how they are installed, and what they say of a file."""

import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

from tree import PROJECT

PINNED = {"clang-format": "19.1.7", "ruff": "0.8.4"}
FOLDER = PROJECT / "build/formatters"
FILES_A_RUN = 40  # few enough that two cores finish together, many enough that start-up does not count

VERSIONS = ", ".join(f"{name} {version}" for name, version in PINNED.items())
WITHOUT_NETWORK = f"""could not install {VERSIONS} into build/formatters.
With a network or a package mirror (pip's own configuration is honoured), run it again. Without one, either
  - set PIP_FIND_LINKS to a folder with the wheels of both and PIP_NO_INDEX to 1, or
  - set VFIT_FORMATTERS to a folder that holds both programs in these versions."""


class Missing(Exception):
    """The formatters are not here and cannot be installed."""


def _version(program):
    try:
        run = subprocess.run([program, "--version"], capture_output=True, text=True)
    except OSError:
        return None
    found = re.search(r"\d+\.\d+\.\d+", run.stdout)
    return found and found.group()


def _usable(folder):
    """Paths of both programs in a folder (None: on PATH), where both have the pinned versions."""
    paths = {name: str(pathlib.Path(folder, name)) if folder else shutil.which(name) for name in PINNED}
    right = all(paths[name] and _version(paths[name]) == version for name, version in PINNED.items())
    return paths if right else None


def _install():
    """Makes the virtual environment anew."""
    print("format: installing the pinned formatters into build/formatters", file=sys.stderr)
    packages = [f"{name}=={version}" for name, version in PINNED.items()]
    for command in (
        [sys.executable, "-m", "venv", "--clear", str(FOLDER)],
        [str(FOLDER / "bin/python"), "-m", "pip", "install", "--quiet", *packages],
    ):
        run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if run.returncode:
            last = run.stdout.strip().split("\n")[-1]
            raise Missing(f"{WITHOUT_NETWORK}\npip: {last}")


def present():
    """Paths of both programs where they are here; None where they have to be installed."""
    own = os.environ.get("VFIT_FORMATTERS")
    if own:
        paths = _usable(own)
        if not paths:
            raise Missing(f"VFIT_FORMATTERS={own} does not hold {VERSIONS}")
        return paths
    return _usable(FOLDER / "bin") or _usable(None)


def find():
    """Paths of both programs, installed where they are not here yet."""
    paths = present()
    if not paths:
        _install()
        paths = _usable(FOLDER / "bin")
    if not paths:
        raise Missing(f"build/formatters does not run; remove it and try again. {WITHOUT_NETWORK}")
    return paths


def files_of(tree):
    """The files that each formatter owns."""
    own = [path for path in tree.files if not tree.is_generated(path)]
    return [p for p in own if tree.is_c_family(p)], [p for p in own if tree.is_python(p)]


def _runs(command, files, root):
    """Runs a command on portions of the files, as many at a time as there are cores."""
    portions = [files[i : i + FILES_A_RUN] for i in range(0, len(files), FILES_A_RUN)]

    def run(portion):
        return subprocess.run([*command, *portion], cwd=root, capture_output=True, text=True)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(run, portions))


def _must(run):
    if run.returncode:
        raise SystemExit(f"{run.args[0]} failed:\n{run.stderr}")


def apply(tree):
    programs = find()
    c_family, python = files_of(tree)
    for run in _runs([programs["clang-format"], "-i"], c_family, tree.root):
        _must(run)
    for run in _runs([programs["ruff"], "format", "--quiet", "--no-cache"], python, tree.root):
        _must(run)
    return len(c_family) + len(python)


def differences(tree):
    """{path: first line} that the formatters would change; line 1 where a file cannot be parsed."""
    programs = find()
    c_family, python = files_of(tree)
    found = {}
    for run in _runs([programs["clang-format"], "--dry-run", "--Werror"], c_family, tree.root):
        places = re.findall(
            r"^(.+?):(\d+):\d+: error: code should be clang-formatted", run.stderr, flags=re.M
        )
        if run.returncode and not places:
            _must(run)
        for path, line in places:
            found.setdefault(path, int(line))
    for run in _runs([programs["ruff"], "format", "--diff", "--no-cache"], python, tree.root):
        for path, line in re.findall(r"^--- (.+)\n\+\+\+ .+\n@@ -(\d+)", run.stdout, flags=re.M):
            found.setdefault(path, int(line))
        for path, line in re.findall(r"^error: Failed to parse (.+?):(\d+):", run.stderr, flags=re.M):
            found.setdefault(path, int(line))
        if run.returncode not in (0, 1, 2):
            _must(run)
    return found
