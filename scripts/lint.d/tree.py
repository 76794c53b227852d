"""The tree under check: its tracked files, their texts, and what a change adds to them."""

import collections
import os
import pathlib
import re
import subprocess

Breach = collections.namedtuple("Breach", "path line what")

# Folders of an unpacked archive that hold no source.
NOT_SOURCE = {".git", "build", "out", "__pycache__", ".ruff_cache"}
# Written by programs, which decide their layout.
GENERATED = re.compile(
    r"^(tests/abi/(offsets\.c|vfit\.abi)|sdk/motion/contact_weights\.inc|bindings/csharp/.*/Generated/.*)$"
)
# White space, and the marks of comments and strings, which a formatter moves.
LAYOUT = re.compile(r"[\s/*#\"]+")
NO_COMMIT = "0" * 40
PROJECT = pathlib.Path(__file__).resolve().parent.parent.parent


class Tree:
    """The files below a root, by their paths relative to it."""

    def __init__(self, root, files=None, everything=False):
        self.root = pathlib.Path(root).resolve()
        self.everything = everything  # also what a change does not touch
        self.is_repository = self._git("rev-parse", "--show-toplevel") == str(self.root)
        self.files = sorted(files) if files is not None else self._list()
        self.skipped = []  # checks, or parts of them, that could not run, with the reason
        self.warnings = []
        self._texts = {}
        self._words = {}

    def _git(self, *arguments, strip=True):
        """The output of a git command, None where it fails or git is absent."""
        command = ["git", "-c", "core.quotePath=off", *arguments]
        try:
            run = subprocess.run(
                command, cwd=self.root, capture_output=True, encoding="utf-8", errors="replace"
            )
        except FileNotFoundError:
            return None
        if run.returncode:
            return None
        return run.stdout.strip() if strip else run.stdout

    def _list(self):
        if self.is_repository:
            paths = self._git("ls-files", "-z", strip=False).split("\0")
        else:
            paths = []
            for folder, below, names in os.walk(self.root):
                below[:] = [name for name in below if name not in NOT_SOURCE]
                paths += [pathlib.Path(folder, name).relative_to(self.root).as_posix() for name in names]
        # A file that is removed but not committed, and a link, have no text of their own.
        return sorted(
            p for p in paths if p and (self.root / p).is_file() and not (self.root / p).is_symlink()
        )

    def data(self, path):
        return (self.root / path).read_bytes()

    def text(self, path):
        """The text of a file; None where it is binary or not UTF-8."""
        if path not in self._texts:
            data = self.data(path)
            try:
                self._texts[path] = None if b"\0" in data else data.decode("utf-8")
            except UnicodeDecodeError:
                self._texts[path] = None
        return self._texts[path]

    def lines(self, path):
        return (self.text(path) or "").split("\n")

    def _shebang(self, path):
        first = self.lines(path)[0] if "." not in path.rsplit("/", 1)[-1] else ""
        return first if first.startswith("#!") else ""

    def is_python(self, path):
        return path.endswith((".py", ".pyi")) or "python" in self._shebang(path)

    def is_shell(self, path):
        return path.endswith(".sh") or bool(re.search(r"\b(ba|da)?sh\b", self._shebang(path)))

    def is_c_family(self, path):
        return path.endswith((".c", ".h", ".cpp", ".hpp", ".inc"))

    def is_generated(self, path):
        return bool(GENERATED.match(path))

    def config(self, name):
        """The numbered lines of a list in scripts/lint.d, without comments and empty ones."""
        path = f"scripts/lint.d/{name}"
        if not (self.root / path).is_file():
            return []
        numbered = enumerate(self.lines(path), 1)
        return [(n, line.rstrip()) for n, line in numbered if line.strip() and not line.startswith("#")]

    def skip(self, check, reason):
        self.skipped.append((check, reason))

    # ---- what a change adds --------------------------------------------------------------------------

    def base(self):
        """The commit that a change is compared with; None where there is no history to compare with."""
        if not self.is_repository:
            return None
        head = self._commit("HEAD")
        named = os.environ.get("VFIT_LINT_BASE", "")
        if named and named != NO_COMMIT and self._commit(named):
            base = self._git("merge-base", "HEAD", named)
        else:
            main = self._commit("refs/remotes/origin/main") or self._commit("refs/heads/main")
            base = self._git("merge-base", "HEAD", main) if main else None
        if base and base == head:
            base = self._commit("HEAD~1")
        return base

    def _commit(self, name):
        return self._git("rev-parse", "--verify", "--quiet", f"{name}^{{commit}}")

    def added_lines(self, base):
        """{path: numbers of the lines} that the commits since the base and the working tree add or change."""
        diff = self._git(
            "diff", "-M", "--unified=0", "--no-color", "--no-ext-diff", "--no-prefix", base, strip=False
        )
        added = collections.defaultdict(set)
        path, left = None, 0
        for line in (diff or "").split("\n"):
            hunk = re.match(r"@@ -\d+(?:,(\d+))? \+(\d+)(?:,(\d+))? @@", line)
            if left > 0:
                left -= not line.startswith("\\")
            elif hunk:
                removed, first, count = (int(n) if n else 1 for n in hunk.groups())
                added[path].update(range(first, first + count))
                left = removed + count
            elif line.startswith("+++ "):
                path = line[4:].split("\t")[0]
        tracked = set(self.files)
        new = {p: self._without_layout(base, p, numbers) for p, numbers in added.items() if p in tracked}
        return {p: numbers for p, numbers in new.items() if numbers}

    def _without_layout(self, base, path, numbers):
        """The lines whose text the file at the base does not have: a formatter's new breaks add no text."""
        before = self._git("show", f"{base}:{path}", strip=False)
        if before is None:
            return numbers
        old, lines = LAYOUT.sub("", before), self.lines(path)
        return {n for n in numbers if n <= len(lines) and LAYOUT.sub("", lines[n - 1]) not in old}

    def changed_files(self, base):
        """The files that the commits since the base and the working tree change, add or remove."""
        return set(
            (self._git("diff", "--no-renames", "--name-only", "-z", base, strip=False) or "").split("\0")
        )

    def has_word(self, commit, word):
        """Whether any file of a commit has this word."""
        key = commit, word
        if key not in self._words:
            found = self._git("grep", "--word-regexp", "--fixed-strings", "--quiet", "-e", word, commit)
            self._words[key] = found is not None
        return self._words[key]

    def commits(self, base):
        """Commits since the base, oldest first: (hash, number of parents, day of writing, subject)."""
        log = self._git("log", "--reverse", "--format=%h%x00%P%x00%as%x00%s", f"{base}..HEAD") or ""
        entries = [line.split("\0") for line in log.split("\n") if line]
        return [(name, len(parents.split()), day, subject) for name, parents, day, subject in entries]
