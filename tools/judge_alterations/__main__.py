#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Alters vfit's own garments in several sizes for bodies of several shapes (synthetic), and tells how far the
ease that vfit_cloth_fit measures after the change is from the goal.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

BODIES = ("", "weight=0.8", "height=0.65,weight=0.4", "height=0.4,weight=0.7")
WITHIN_M = 0.005


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--vfit", default="build/bin/vfit")
    parser.add_argument("--garments", type=pathlib.Path, default="build/lib/vfit_data/garments")
    parser.add_argument("--sizes", default="S,L")
    arguments = parser.parse_args()
    errors, refused, unknown = [], 0, 0
    for path in sorted(arguments.garments.glob("*.json")):
        garment = json.loads(path.read_text())
        if "flat" not in garment:
            continue
        for size in arguments.sizes.split(","):
            for shape in BODIES:
                with tempfile.TemporaryDirectory() as out:
                    command = [arguments.vfit, "alter", str(path), "--size", size, "--out", out]
                    command += ["--sex", garment["body_sex"], "--draft", "--json"]
                    command += ["--shape", shape] if shape else []
                    done = subprocess.run(command, capture_output=True, text=True, check=False)
                if done.returncode != 0:
                    refused += 1
                    print(f"{path.stem} {size} {shape}: {done.stderr.strip()}", flush=True)
                    continue
                for change in json.loads(done.stdout)["changes"]:
                    if "ease_goal_m" not in change:
                        continue
                    if change["ease_after_m"] is None:
                        unknown += 1
                        continue
                    error = change["ease_after_m"] - change["ease_goal_m"]
                    errors.append(abs(error))
                    if abs(error) > WITHIN_M:
                        print(
                            f"{path.stem} {size} {shape or 'default body'}: {change['place']} by "
                            f"{100 * change['by_m']:.1f} cm, {1000 * error:.1f} mm off",
                            flush=True,
                        )
    if not errors:
        parser.error(f"{arguments.garments}: no garment with flat panels was altered")
    inside = sum(error <= WITHIN_M for error in errors)
    print(
        f"changes: {len(errors)}; at a hem that moved off the girth: {unknown}; garments refused: {refused}"
    )
    print(
        f"ease after the change, off the goal: median {1000 * statistics.median(errors):.1f} mm, worst "
        f"{1000 * max(errors):.1f} mm; within 5 mm: {inside} of {len(errors)}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
