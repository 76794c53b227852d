"""Text files are UTF-8 with LF, end with one newline, and hold no tab and no trailing white space."""

from tree import Breach

BINARY = (".png", ".onnx", ".bin", ".glb", ".vrm", ".ico", ".jpg", ".gz", ".xz", ".zip", ".whl")
# Unity writes its .meta files with trailing spaces, and abidw its own XML.
WRITTEN_BY_OTHERS = (".meta", ".abi")


def _white_space(path, lines):
    for number, line in enumerate(lines, 1):
        if "\r" in line:
            yield Breach(path, number, "carriage return: lines end with LF alone")
            return  # one is enough: a file has them on every line
        if "\t" in line:
            yield Breach(path, number, "tab: indent with spaces")
        if line != line.rstrip():
            yield Breach(path, number, "trailing white space")


def check(tree):
    for path in tree.files:
        if path.endswith(BINARY):
            continue
        text = tree.text(path)
        if text is None:
            yield Breach(path, 1, "neither UTF-8 text nor a known binary format")
        elif text and not path.endswith(WRITTEN_BY_OTHERS):
            lines = text.split("\n")
            yield from _white_space(path, lines)
            if lines[-1] or not text.strip("\n"):
                yield Breach(path, len(lines), "no newline at the end")
            elif len(lines) > 2 and not lines[-2]:
                yield Breach(path, len(lines) - 1, "empty line at the end")
