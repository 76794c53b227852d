"""Shell scripts pass bash -n, Python compiles, JSON and TOML parse."""

import json
import re
import subprocess
import warnings

from tree import Breach

try:
    import tomllib  # Python 3.11
except ImportError:
    tomllib = None


def _python(path, text):
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # an invalid escape, a comparison by "is" with a literal
            compile(text, path, "exec", dont_inherit=True)
    except (SyntaxError, ValueError) as error:
        yield Breach(path, getattr(error, "lineno", None) or 1, f"Python: {getattr(error, 'msg', error)}")


def _shell(tree, path):
    run = subprocess.run(["bash", "-n", path], cwd=tree.root, capture_output=True, text=True)
    if run.returncode:
        line = re.search(r"line (\d+): (.*)", run.stderr)
        yield Breach(path, int(line[1]) if line else 1, f"bash: {line[2] if line else run.stderr.strip()}")


def _json(path, text):
    try:
        json.loads(text)
    except json.JSONDecodeError as error:
        yield Breach(path, error.lineno, f"JSON: {error.msg}")


def _toml(path, text):
    try:
        tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        line = re.search(r"line (\d+)", str(error))
        yield Breach(path, int(line[1]) if line else 1, f"TOML: {error}")


def check(tree):
    for path in tree.files:
        text = tree.text(path)
        if text is None:
            continue
        if tree.is_python(path):
            yield from _python(path, text)
        elif tree.is_shell(path):
            yield from _shell(tree, path)
        elif path.endswith((".json", ".asmdef")):
            yield from _json(path, text)
        elif path.endswith(".toml") and tomllib:
            yield from _toml(path, text)
