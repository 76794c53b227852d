"""Source lines have at most 110 columns. Markdown is left out: its paragraphs may be one line each."""

from tree import Breach

COLUMNS = 110
SUFFIXES = (".c", ".h", ".cpp", ".hpp", ".inc", ".cs", ".py", ".pyi", ".sh", ".cmake", ".in", ".yml", ".toml")


def is_source(tree, path):
    # Generated C# is wrapped by its generator.
    if tree.is_generated(path) and not path.endswith(".cs"):
        return False
    name = path.rsplit("/", 1)[-1]
    return name == "CMakeLists.txt" or name.endswith(SUFFIXES) or tree.is_python(path) or tree.is_shell(path)


def check(tree):
    for path in tree.files:
        if not is_source(tree, path):
            continue
        for number, line in enumerate(tree.lines(path), 1):
            if len(line) > COLUMNS:
                yield Breach(path, number, f"{len(line)} columns, at most {COLUMNS}")
