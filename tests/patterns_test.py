#!/usr/bin/env python3
"""Each pattern of tests that a sanitized build leaves out names a test of the program.

patterns_test.py PROGRAM PATTERN...
"""

import os
import subprocess
import sys

program, *patterns = sys.argv[1:]
# With GTEST_OUTPUT the list would be written to the report as well.
environment = {name: value for name, value in os.environ.items() if not name.startswith("GTEST_")}
empty = []
for pattern in patterns:
    command = [program, "--gtest_list_tests", f"--gtest_filter={pattern}"]
    listed = subprocess.run(command, capture_output=True, text=True, check=True, env=environment).stdout
    tests = [line for line in listed.splitlines() if line.startswith("  ")]
    print(f"tests of {pattern}: {len(tests)}")
    if not tests:
        empty.append(pattern)
if empty or not patterns:
    sys.exit(f"{program} has no test of the name {' or '.join(empty)}")
