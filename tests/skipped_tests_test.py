#!/usr/bin/env python3
"""scripts/skipped-tests reads the reports of every kind of test, and tells what has run nowhere.

skipped_tests_test.py
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).parents[1] / "scripts" / "skipped-tests"
GOOGLETEST = """<testsuites><testsuite name="Real">
<testcase name="One" status="run" result="completed" classname="Real"/>
<testcase name="Two" status="run" result="skipped" classname="Real">
<skipped message="/src/real_test.cpp:9&#x0A;no pictures in &quot;/data&quot;"/></testcase>
<testcase name="Three" status="notrun" result="suppressed" classname="Real"/>
</testsuite></testsuites>"""
RUN = GOOGLETEST.replace("skipped message", "properties name")  # elsewhere the second has run
PYTEST = """<testsuites><testsuite><testcase classname="test_chain" name="test_one"/>
<testcase classname="test_chain" name="test_two"><skipped type="pytest.skip" message="no mypy">x</skipped>
</testcase></testsuite></testsuites>"""
CTEST = """<testsuite><testcase name="unit_real" classname="unit_real" status="run"/>
<testcase name="room" classname="room" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/></testcase>
</testsuite>"""


class SkippedTests(unittest.TestCase):
    def say(self, files, *options):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(exist_ok=True)
                path.write_text(text)
            done = subprocess.run(
                [sys.executable, SCRIPT, *options, folder], capture_output=True, text=True, timeout=60
            )
        self.assertEqual(done.stdout.count("\n"), 0 if done.returncode == 2 else 1, done.stdout + done.stderr)
        return done.returncode, done.stdout

    def test_names_what_was_skipped_by_reason(self):
        csharp = {
            "passed": [{"name": "A", "reason": ""}],
            "failed": [],
            "skipped": [{"name": "B", "reason": "no mypy"}],
        }
        files = {
            "release/unit_real.xml": GOOGLETEST,
            "release/ctest.xml": CTEST,
            "python.xml": PYTEST,
            "csharp.json": json.dumps(csharp),
        }
        code, line = self.say(files)
        self.assertEqual(code, 0)
        self.assertIn("3 tests ran, 5 not", line)
        for part in (
            'no pictures in "/data": Real.Two',
            "disabled: Real.Three",
            "no mypy: B, test_chain.test_two",
            "SKIP_RETURN_CODE=77: room",
        ):
            self.assertIn(part, line)
        self.assertNotIn("real_test.cpp", line)
        self.assertEqual(self.say(files, "--none-allowed")[0], 1)

    def test_what_the_distribution_does_not_have_is_told_and_allowed(self):
        test = {"name": "scripts/test-csharp", "reason": "no Mono here", "unavailable": True}
        report = {"passed": [], "failed": [], "skipped": [test]}
        code, line = self.say({"csharp.json": json.dumps(report)}, "--none-allowed")
        self.assertEqual(
            (code, line), (0, "skipped-tests: 0 tests ran, 1 not: no Mono here: scripts/test-csharp\n")
        )
        report["skipped"].append({"name": "A", "reason": "no pictures"})
        self.assertEqual(self.say({"csharp.json": json.dumps(report)}, "--none-allowed")[0], 1)

    def test_what_runs_in_one_of_two_builds_has_run(self):
        code, line = self.say(
            {"release/unit_real.xml": GOOGLETEST, "asan/unit_real.xml": RUN}, "--none-allowed"
        )
        self.assertEqual(code, 1)
        self.assertIn("2 tests ran, 1 not: disabled: Real.Three", line)

    def test_all_have_run(self):
        case = '<testcase name="One" classname="Real" status="run"/>'
        one = f"<testsuites><testsuite>{case}</testsuite></testsuites>"
        self.assertEqual(
            self.say({"unit.xml": one}, "--none-allowed"),
            (0, "skipped-tests: 1 tests ran, none was skipped\n"),
        )

    def test_no_report_is_an_error(self):
        self.assertEqual(self.say({"notes.txt": "x"})[0], 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
