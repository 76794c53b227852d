"""Added lines use the language of docs/style.md: the list "words" has the old words and the new ones."""

import collections
import re

from tree import Breach

Word = collections.namedtuple("Word", "scope pattern advice")

LIST = "scripts/lint.d/words"
# Where the old dialect is quoted.
EXEMPT = (LIST, "docs/style.md", "tests/lint/")
NO_PROSE = (".abi", ".meta", ".csv", ".map", "LICENSE")

# What a language writes for people to read, strings included; the rest of it is code.
STRING = r"""(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])*'|"(?:\\.|[^"\\\n])*\""""
C_PROSE = re.compile(r'//[^\n]*|/\*.*?\*/|R"([^()\s]*)\(.*?\)\1"|@"(?:""|[^"])*"|' + STRING, re.DOTALL)
PYTHON_PROSE = re.compile(r'#[^\n]*|""".*?"""|\'\'\'.*?\'\'\'|' + STRING, re.DOTALL)


def words(tree):
    scope = "prose"
    for number, line in tree.config("words"):
        if line.startswith("["):
            scope = line.strip("[]")
            continue
        pattern, _, advice = line.rpartition(" -> ")
        if not pattern:
            raise SystemExit(f"{LIST}:{number}: no ' -> '")
        yield Word(scope, re.compile(pattern, re.IGNORECASE), advice)


def _split(text, prose):
    """The prose and the code of a text, each with as many lines as it has."""

    def blank(part):
        return re.sub(r"[^\n]", " ", part)

    parts, end = [], 0
    for found in prose.finditer(text):
        parts += [(False, text[end : found.start()]), (True, found.group())]
        end = found.end()
    parts.append((False, text[end:]))
    return (
        "".join(part if is_prose else blank(part) for is_prose, part in parts).split("\n"),
        "".join(blank(part) if is_prose else part for is_prose, part in parts).split("\n"),
    )


def lines_by_scope(tree, path):
    """{scope: lines} of a file: what a reader reads, and identifiers."""
    if tree.is_c_family(path) or path.endswith(".cs"):
        prose, code = _split(tree.text(path), C_PROSE)
        return {"prose": prose, "code": code, "c++": [] if path.endswith(".cs") else code}
    if tree.is_python(path):
        prose, code = _split(tree.text(path), PYTHON_PROSE)
        return {"prose": prose, "code": code}
    return {"prose": tree.lines(path)}


def check(tree):
    base = tree.base()
    if not base:
        tree.skip("words", "no history to compare with")
        return
    listed = list(words(tree))
    for path, numbers in tree.added_lines(base).items():
        if path.startswith(EXEMPT) or path.endswith(NO_PROSE) or tree.is_generated(path):
            continue
        if tree.text(path) is None:
            continue
        scopes = lines_by_scope(tree, path)
        for number in sorted(numbers):
            for word in listed:
                lines = scopes.get(word.scope, [])
                for found in word.pattern.finditer(lines[number - 1] if lines else ""):
                    text = (found.groupdict().get("word") or found.group()).strip()
                    if word.scope != "code" or not tree.has_word(base, text):
                        yield Breach(path, number, f"'{text}': say {word.advice}")
