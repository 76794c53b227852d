"""A temporary git repository with files of a test, and what the checks of scripts/lint say of it."""

import importlib
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
PROJECT = pathlib.Path(__file__).resolve().parents[2]
LINT = PROJECT / "scripts/lint.d"
sys.path.insert(0, str(LINT))

from tree import Tree  # noqa: E402  (after the path)

# No configuration of the machine, no repository around the test, no base of the run that tests are part of.
GIT = {
    "GIT_CONFIG_GLOBAL": os.devnull,
    "GIT_CONFIG_NOSYSTEM": "1",
    "GIT_AUTHOR_NAME": "Test",
    "GIT_AUTHOR_EMAIL": "test@example.invalid",
    "GIT_COMMITTER_NAME": "Test",
    "GIT_COMMITTER_EMAIL": "test@example.invalid",
    "GIT_AUTHOR_DATE": "2026-12-01T12:00:00+00:00",
    "GIT_COMMITTER_DATE": "2026-12-01T12:00:00+00:00",
}
UNSET = ("GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "VFIT_LINT_BASE")


class RepositoryTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        saved = {name: os.environ.get(name) for name in (*GIT, *UNSET)}
        self.addCleanup(self._restore, saved)
        os.environ.update(GIT)
        for name in UNSET:
            os.environ.pop(name, None)
        self.git("init", "--quiet")
        self.git("symbolic-ref", "HEAD", "refs/heads/main")

    @staticmethod
    def _restore(saved):
        for name, value in saved.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value

    def git(self, *arguments):
        run = subprocess.run(["git", *arguments], cwd=self.root, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout.strip()

    def write(self, path, text):
        """Writes a file, text or bytes, and tells git of it."""
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        self.git("add", "--force", path)

    def commit(self, subject="test: add files"):
        self.git("commit", "--quiet", "--allow-empty", "-m", subject)

    def commit_base(self):
        """Commits what is there, and makes that the base: on main, the commit before the last."""
        self.commit()
        self.commit()

    def copy_list(self, name):
        self.write(f"scripts/lint.d/{name}", (LINT / name).read_text())

    def tree(self, **options):
        return Tree(self.root, **options)

    def breaches(self, check, tree=None):
        """What a check says: sorted "path:line: what"."""
        found = importlib.import_module(f"check_{check}").check(tree or self.tree())
        return [f"{b.path}:{b.line}: {b.what}" for b in sorted(found)]

    def assert_clean(self, check, tree=None):
        self.assertEqual(self.breaches(check, tree), [])

    def assert_breach(self, check, start, tree=None):
        """One breach alone, which begins like this."""
        found = self.breaches(check, tree)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(start), found[0])
