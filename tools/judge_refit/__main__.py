#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts garments on characters of other makers (vfit refit), moves each by a motion, and counts the frames in
which the cloth crosses what else of the character is seen.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import time

SUFFIXES = {".vrm", ".glb", ".gltf"}


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)


def judge(arguments, character, garment):
    """What became of one garment on one character: a line to print, and (at rest, in motion) or None."""
    name = pathlib.Path(garment).stem
    suffix = ".vrm" if character.suffix == ".vrm" else ".glb"
    worn = arguments.out / f"{character.stem}-{name}{suffix}"
    start = time.monotonic()
    fitted = run(
        arguments.bin / "vfit",
        "refit",
        garment,
        character,
        "--out",
        worn,
        "--picture",
        worn.with_suffix(".png"),
        "--json",
    )
    seconds = time.monotonic() - start
    if fitted.returncode != 0:
        return f"refused: {fitted.stderr.strip()[:160]}", None
    report = json.loads(fitted.stdout)
    at_rest = report["garments"][0]
    moved = run(
        arguments.bin / "vfit-bench",
        "refit",
        worn,
        "--garments",
        at_rest["mesh"],
        "--scale",
        report["file_scale"],
        "--motion",
        arguments.motion,
        "--every",
        arguments.every,
        "--picture",
        worn.with_name(f"{worn.stem}_moved.png"),
        "--json",
    )
    if moved.returncode != 0:
        return f"not moved: {moved.stderr.strip()[:160]}", None
    motion = json.loads(moved.stdout)[0]
    line = (
        f"at rest {at_rest['skin_crossings']} crossings, with itself {at_rest['self_crossings']}; moved "
        f"{motion['frames_crossing']} of {motion['frames']} frames {motion['frames_by_place']}, at most "
        f"{motion['pairs_in_the_worst']}; {seconds:.1f} s"
    )
    return line, (at_rest["skin_crossings"], motion["frames_crossing"], motion["frames"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("characters", type=pathlib.Path, help="folder of .vrm, .glb and .gltf files")
    parser.add_argument("motion", help="recording, file of joints or BVH file of a person who walks")
    parser.add_argument("--garments", default="shirt_men,jeans_women,sundress,vest,duster")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("refitted"))
    parser.add_argument("--bin", type=pathlib.Path, default=pathlib.Path("build/bin"))
    parser.add_argument("--every", type=int, default=3, help="of the motion's frames each so many is judged")
    arguments = parser.parse_args()
    files = sorted(f for f in arguments.characters.iterdir() if f.suffix in SUFFIXES)
    if not files:
        parser.error(f"{arguments.characters}: no characters")
    arguments.out.mkdir(parents=True, exist_ok=True)
    results, refused = [], 0
    for character in files:
        for garment in arguments.garments.split(","):
            line, result = judge(arguments, character, garment)
            print(f"{character.stem} {pathlib.Path(garment).stem}: {line}", flush=True)
            results += [result] if result else []
            refused += result is None
    print(
        f"garments on characters: {len(results) + refused}; refused: {refused}; without a crossing at rest: "
        f"{sum(r[0] == 0 for r in results)}; in no frame: {sum(r[1] == 0 for r in results)}; in at most a "
        f"tenth of the frames: {sum(10 * r[1] <= r[2] for r in results)}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
