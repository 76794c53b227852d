#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cooks every GarmentCode specification below a folder, as a user would, and counts what became of them: worn
without a crossing, worn with crossings, refused. Measures that lie beside a pattern are used (vfit cook).
"""

import argparse
import collections
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile


def cook(vfit, pattern, out, more, limit_s):
    command = [vfit, "cook", str(pattern), "--json", "--out", str(out), *more]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit_s, check=False)
    except subprocess.TimeoutExpired:
        return None, f"takes more than {limit_s} s"
    if done.returncode != 0:
        return None, done.stderr.strip()
    return json.loads(done.stdout), ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--vfit", default="build/bin/vfit")
    parser.add_argument("--measures", help="of all patterns that have none beside them")
    parser.add_argument("--limit", type=float, default=60.0, help="seconds a pattern (default 60)")
    arguments = parser.parse_args()
    patterns = sorted(arguments.folder.rglob("*_specification.json"))
    if not patterns:
        sys.exit(f"judge_patterns: no *_specification.json in {arguments.folder}")
    counts, seconds = collections.Counter(), []
    with tempfile.TemporaryDirectory() as folder:
        for pattern in patterns:
            beside = list(pattern.parent.glob("*body_measurements.yaml"))
            more = ["--measures", arguments.measures] if arguments.measures and not beside else []
            report, error = cook(
                arguments.vfit, pattern, pathlib.Path(folder) / "made.json", more, arguments.limit
            )
            name = pattern.name.removesuffix("_specification.json")
            if report is None:
                counts["refused"] += 1
                print(f"{name}: {error}", flush=True)
                continue
            crossings = report["skin_crossings"] + report["self_crossings"]
            counts["worn with crossings" if crossings else "worn without a crossing"] += 1
            seconds.append(report["seconds"])
            print(
                f"{name}: from the {report['hangs_on']}, round {', '.join(report['goes_round'])}; "
                f"{report['skin_crossings']} crossings with the skin, {report['self_crossings']} with "
                f"itself; strain {report['strain_p99']:.2f}; {report['seconds']:.1f} s",
                flush=True,
            )
    for what in ("worn without a crossing", "worn with crossings", "refused"):
        print(f"{what}: {counts[what]} of {len(patterns)} ({100 * counts[what] / len(patterns):.0f} %)")
    if seconds:
        print(f"median {statistics.median(seconds):.1f} s, longest {max(seconds):.1f} s")


if __name__ == "__main__":
    main()
