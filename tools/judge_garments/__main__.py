#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cooks every GarmentCode specification and mesh below a folder, as a user would, and counts what became of
them: worn without a crossing, worn with crossings, worn otherwise than its kind is, refused. Measures that
lie beside a pattern are used (vfit cook).
"""

import argparse
import collections
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

MESHES = {".obj", ".glb", ".gltf"}
ON_SHOULDERS = {"shirt", "t-shirt", "tank", "hoodie", "jacket", "coat"}
NOT_FOR_BODIES = {"hat", "shoe", "sock", "glove", "scarf"}  # vfit wears none of these


def cook(vfit, design, out, more, limit_s):
    """The garments that were made of a design, or what is wrong with it."""
    command = [vfit, "cook", str(design), "--json", "--out", str(out), *more]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit_s, check=False)
    except subprocess.TimeoutExpired:
        return None, f"takes more than {limit_s} s"
    if done.returncode != 0:
        return None, done.stderr.strip()
    report = json.loads(done.stdout)
    return report.get("garments", [report]), ""


def is_worn_as(kind, garments):
    """Whether these go round what a garment of that kind does; of an unknown kind, always."""
    round_ = {part for garment in garments for part in garment["goes_round"]}
    hangs_on = {garment["hangs_on"] for garment in garments}
    if kind in ON_SHOULDERS:
        return "shoulders" in hangs_on and "chest" in round_
    if kind == "dress":
        return bool(round_ & {"waist", "hips"})
    if kind == "skirt":
        return hangs_on == {"waist"} and bool(round_ & {"waist", "hips"})
    if kind in {"trousers", "shorts"}:
        return hangs_on == {"waist"} and "hips" in round_ and (kind == "shorts" or "left leg" in round_)
    if kind in {"jumpsuit", "suit"}:
        return "shoulders" in hangs_on and bool(round_ & {"hips", "left leg"})
    return kind not in NOT_FOR_BODIES


def line_of(garment):
    return (
        f"from the {garment['hangs_on']}, round {', '.join(garment['goes_round'])}; "
        f"{garment['skin_crossings']} crossings with the skin, {garment['self_crossings']} with itself; "
        f"strain {garment['strain_p99']:.2f}; {garment['seconds']:.1f} s"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--vfit", default="build/bin/vfit")
    parser.add_argument("--measures", help="of all patterns that have none beside them")
    parser.add_argument(
        "--kinds",
        type=pathlib.Path,
        help="table with a path (its end counts) and a kind a line, tabs between",
    )
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the garment files (default: not kept)")
    parser.add_argument("--limit", type=float, default=60.0, help="seconds a design (default 60)")
    arguments = parser.parse_args()
    designs = sorted(
        path
        for path in arguments.folder.rglob("*")
        if path.name.endswith("_specification.json") or path.suffix.lower() in MESHES
    )
    if not designs:
        sys.exit(f"judge_garments: no *_specification.json and no mesh in {arguments.folder}")
    kinds = {}
    if arguments.kinds:
        with arguments.kinds.open() as table:
            for row in csv.DictReader(table, delimiter="\t"):
                kinds[row["path"]] = row["kind"]
    counts, seconds = collections.Counter(), []
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for design in designs:
            beside = list(design.parent.glob("*body_measurements.yaml"))
            more = ["--measures", arguments.measures] if arguments.measures and not beside else []
            name = str(design.relative_to(arguments.folder)).removesuffix("_specification.json")
            out = folder / (name.replace("/", "_").rsplit(".", 1)[0] + ".json")
            start = time.monotonic()
            garments, error = cook(arguments.vfit, design, out, more, arguments.limit)
            seconds.append(time.monotonic() - start)
            kind = next((kinds[path] for path in kinds if str(design).endswith(path)), None)
            label = f"{name} ({kind})" if kind else name
            if garments is None:
                counts["refused"] += 1
                counts["of them no garment for a body"] += kind in NOT_FOR_BODIES
                print(f"{label}: {error}", flush=True)
                continue
            crossings = sum(garment["skin_crossings"] + garment["self_crossings"] for garment in garments)
            what = (
                "worn otherwise than its kind is"
                if kind and not is_worn_as(kind, garments)
                else "worn with crossings"
                if crossings
                else "worn without a crossing"
            )
            counts[what] += 1
            lines = "\n    ".join(line_of(garment) for garment in garments)
            print(f"{label}: {what}\n    {lines}", flush=True)
    for what in (
        "worn without a crossing",
        "worn with crossings",
        "worn otherwise than its kind is",
        "refused",
    ):
        print(f"{what}: {counts[what]} of {len(designs)} ({100 * counts[what] / len(designs):.0f} %)")
    if counts["of them no garment for a body"]:
        print(f"  of them no garment for a body: {counts['of them no garment for a body']}")
    if seconds:
        print(f"with all tries: median {statistics.median(seconds):.1f} s, longest {max(seconds):.1f} s")


if __name__ == "__main__":
    main()
