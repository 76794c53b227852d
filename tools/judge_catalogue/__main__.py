#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cooks a catalogue of designs (vfit's own, with other eases, in all their sizes) by one process and by two,
then kills it again and again and takes it up with --resume, and tells what that cost (synthetic).
"""

import argparse
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

ASSETS = pathlib.Path(__file__).resolve().parents[2] / "assets" / "garments"


def write_designs(folder, count, seed):
    """Designs that differ in each of their eases, by up to 2 cm."""
    draw = random.Random(seed)
    bundled = [json.loads(path.read_text()) for path in sorted(ASSETS.glob("*.json"))]
    bundled = [design for design in bundled if design["format"] == "vfit-design"]
    for i in range(count):
        design = json.loads(json.dumps(bundled[i % len(bundled)]))
        design["name"] = f"{design['name']}_{i:03}"
        for part in design.values():
            if isinstance(part, dict):
                for key in part:
                    if key.endswith("_ease_m"):
                        part[key] = round(part[key] + draw.uniform(0.0, 0.02), 4)
        (folder / f"{design['name']}.json").write_text(json.dumps(design))


def start(vfit, designs, out, *more):
    # A group of its own, which a kill reaches whole, as it does when a terminal or a machine goes away.
    return subprocess.Popen(
        [vfit, "cook", str(designs), "--out", str(out), *more],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def timed(vfit, designs, out, jobs):
    began = time.monotonic()
    process = start(vfit, designs, out, "--jobs", str(jobs))
    error = process.communicate()[1]
    return time.monotonic() - began, error.strip()


def rows_of(out):
    """Of the journal; the last line may have been cut off."""
    journal = out / "designs.jsonl"
    lines = journal.read_text().splitlines(keepends=True) if journal.exists() else []
    return [json.loads(line) for line in lines if line.endswith("\n")]


def finished(out):
    """Garment files whose design is in the journal."""
    return [pathlib.Path(g["file"]).name for row in rows_of(out) for g in row.get("garments", [])]


def children(pid):
    tasks = pathlib.Path(f"/proc/{pid}/task").glob("*/children")
    return [child for task in tasks for child in task.read_text().split()]


def files_of(out):
    return {path.name: path.read_bytes() for path in out.glob("*.json") if path.name != "report.json"}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--vfit", default="build/bin/vfit")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    draw = random.Random(arguments.seed)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        designs = folder / "designs"
        designs.mkdir()
        write_designs(designs, arguments.count, arguments.seed)
        seconds = {}
        for jobs in (1, 2):
            seconds[jobs], error = timed(arguments.vfit, designs, folder / f"by_{jobs}", jobs)
            print(f"{arguments.count} designs, {jobs} at once: {seconds[jobs]:.1f} s {error}", flush=True)
        print(f"two at once are {seconds[1] / seconds[2]:.2f} times as fast")
        report = json.loads((folder / "by_1" / "report.json").read_text())
        sizes = {len(garment["sizes"]) for garment in report["cooked"]}
        print(
            f"cooked {len(report['cooked'])}, sizes of each {sorted(sizes)}, failed {len(report['failed'])}"
        )
        same = files_of(folder / "by_1") == files_of(folder / "by_2")
        print(f"the files are the same: {'yes' if same else 'NO'}")

        out = folder / "killed"
        damaged = again = in_work = 0
        stamps = {}
        for run in range(arguments.kills + 1):
            process = start(arguments.vfit, designs, out, "--jobs", "1", "--resume")
            if run < arguments.kills:
                time.sleep(draw.uniform(0.2, 1.5 * seconds[1] / arguments.kills))
                in_work = max(in_work, len(children(process.pid)))
                os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            for path in out.glob("*.json"):
                try:
                    json.loads(path.read_text())
                except json.JSONDecodeError:
                    damaged += 1
            again += sum((out / name).stat().st_mtime_ns != at for name, at in stamps.items())
            stamps = {name: (out / name).stat().st_mtime_ns for name in finished(out)}
            print(f"{len(rows_of(out))} of {arguments.count} are done", flush=True)
        whole = files_of(out) == files_of(folder / "by_1")
        print(
            f"{arguments.kills} kills: designs in work at each, at most {in_work}; finished ones that were "
            f"cooked again, {again}; damaged files, {damaged}"
        )
        print(f"after all kills the files are those of the first run: {'yes' if whole else 'NO'}")
        return 0 if same and whole and damaged == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
