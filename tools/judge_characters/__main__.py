"""Judges the tracker on characters of other makers, drawn by a renderer of their own.

    build/venv/bin/python tools/judge_characters FOLDER --vfit build/bin/vfit --work WORK

FOLDER holds characters (*.glb, bones named as Mixamo's) and, in FOLDER/clips, motions without skin
(*.glb) that are carried over to characters without their own; clips/rest.glb holds the clips' bones in
the T-pose. docs/tracking.md has what is printed.
"""

import argparse
import json
import re
import shutil
import sys
from pathlib import Path

import numpy as np

from character import Character
from glb import BadFile, read_glb
from motion import carried_motion, own_motions, still
from scenes import Person, scenes_of
from score import Tracked, fit_offsets, joint_table, summary

STATURES_M = (1.52, 1.65, 1.78, 1.91)
GIRTHS = (1.0, 1.08, 0.94)


def people_of(folder, count):
    """People in turn over the characters; those without own motions get the clips."""
    characters = [Character(read_glb(path)) for path in sorted(folder.glob("*.glb"))]
    if not characters:
        raise BadFile(f"{folder}: holds no .glb")
    rest = folder / "clips" / "rest.glb"
    clips = [p for p in sorted((folder / "clips").glob("*.glb")) if p != rest]
    if clips and not rest.exists():
        raise BadFile(f"{rest}: is missing; it holds the clips' bones in the T-pose")
    clips = [(p.stem, read_glb(p)) for p in clips]
    bones = read_glb(rest) if clips else None
    people = []
    for i in range(count):
        character = characters[i % len(characters)]
        motions = own_motions(character)
        if not motions and character.has_skin:
            motions = [carried_motion(name, character, clip, bones) for name, clip in clips]
        name = f"{Path(character.glb.path).stem}-{i:02}"
        stature = STATURES_M[(i + i // len(characters)) % len(STATURES_M)]
        people.append(
            Person(name, motions or [still(character)], stature, GIRTHS[i // len(characters) % len(GIRTHS)])
        )
    return people


def render(scenes, work):
    """Recordings of the scenes; those that are there already stay."""
    out = []
    for i, scene in enumerate(scenes):
        folder = work / re.sub(r"[^A-Za-z0-9._-]", "_", scene.name)
        if not (folder / "camera.json").exists():
            shutil.rmtree(folder, ignore_errors=True)
            scene.write(folder)
        out.append((folder, scene.person.name, Path(scene.motion.character.glb.path).stem))
        print(f"\rrendered {i + 1} of {len(scenes)}", end="", file=sys.stderr)
    print(file=sys.stderr)
    return out


def every(recording):
    return np.ones(len(recording.labels), bool)


def labelled(label):
    return lambda recording: np.array([own == label for own in recording.labels])


def rows_of(recordings, offsets, offsets_of):
    """Rows of the report: title, figures raw, within 10 cm after the offsets on the other characters."""
    kinds = {k: [r for r in recordings if r.kind == k] for k in ("turn", "cuts", "clip")}
    side = Tracked.from_the_side
    for title, chosen, choose in (
        ("all views", recordings, every),
        ("all side views", recordings, side),
        ("a continuous turn", kinds["turn"], every),
        ("cuts, the side views", kinds["cuts"], labelled("side")),
        ("cuts, the front views", kinds["cuts"], labelled("front")),
        ("clips", kinds["clip"], every),
        ("clips, side views", kinds["clip"], side),
    ):
        others = [r for r in chosen if r.character != offsets_of]
        if chosen:
            yield title, summary(chosen, choose), summary(others, choose, offsets)["map"]


def report(recordings, offsets_of):
    fitted = [r for r in recordings if r.character == offsets_of]
    offsets = fit_offsets(fitted)
    print(
        "CHARACTERS of other makers, drawn and tracked; mAP: joints within 10 cm of the true ones;\n"
        f"offset: a constant for each joint, fitted on {offsets_of}, judged on the others\n"
        f"  {'what':24}{'frames':>8}{'no body':>9}{'wrong':>7}{'%':>7}{'flips':>7}{'/1000':>7}"
        f"{'mAP':>8}{'offset':>8}"
    )
    rows = []
    for title, f, after in rows_of(recordings, offsets, offsets_of):
        share = 100 * f["wrong"] / max(1, f["frames"])
        print(
            f"  {title:24}{f['frames']:8}{f['missed']:9}{f['wrong']:7}{share:7.2f}{f['flips']:7}"
            f"{1000 * f['flips'] / max(1, f['frames']):7.1f}{f['map']:8.3f}{after:8.3f}"
        )
        rows.append({"what": title, **f, "map_after_offset": after})
    print(f"\n  {'character':24}{'frames':>8}{'no body':>9}{'wrong':>7}{'flips':>7}{'mAP':>8}{'offset':>8}")
    for name in sorted({r.character for r in recordings}):
        own = [r for r in recordings if r.character == name]
        f, after = summary(own, every), summary(own, every, offsets)["map"]
        counts = f"{f['frames']:8}{f['missed']:9}{f['wrong']:7}{f['flips']:7}"
        print(f"  {name:24}{counts}{f['map']:8.3f}{after:8.3f}")
    print("\n  joint             raw mm    mAP  offset mm    mAP   the offset to the left, up, ahead (mm)")
    others = [r for r in recordings if r.character != offsets_of] or recordings
    for name, raw, raw_map, moved, moved_map, offset in joint_table(others, offsets):
        place = "".join(f"{1000 * x:6.0f}" for x in offset)
        print(f"  {name:16}{1000 * raw:8.0f}{raw_map:7.2f}{1000 * moved:11.0f}{moved_map:7.2f}   {place}")
    return rows


def worst(recordings, count):
    print(f"\n  the {count} worst recordings: wrong, no body, mAP")
    order = sorted(recordings, key=lambda r: (-int(r.wrong().sum()), r.within().mean()))
    lowest = sorted(recordings, key=lambda r: r.within().mean())
    for r in list(dict.fromkeys(order[: count // 2] + lowest[: count // 2])):
        print(
            f"  {int(r.wrong().sum()):5}{int((~r.seen()).sum()):6}{r.within().mean():8.3f}  {r.folder.name}"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="characters (*.glb), and clips/*.glb")
    parser.add_argument("--vfit", default="build/bin/vfit", help="the program (build/bin/vfit)")
    parser.add_argument("--work", type=Path, required=True, help="recordings are kept there")
    parser.add_argument("--people", type=int, default=20, help="how many (20)")
    parser.add_argument("--clips", type=int, default=2, help="of each person, seen from four sides (2)")
    parser.add_argument("--only", choices=("turn", "cuts", "clip"), help="these scenes alone")
    parser.add_argument("--offsets-of", help="the character on which offsets are fitted (the first)")
    parser.add_argument("--worst", type=int, default=0, help="list that many of the worst recordings")
    parser.add_argument("--json", type=Path, help="write the figures there")
    options = parser.parse_args()
    try:
        scenes = scenes_of(people_of(options.folder, options.people), options.clips)
    except (BadFile, OSError) as error:
        raise SystemExit(f"judge_characters: {error}") from None
    if options.only:
        scenes = [s for s in scenes if s.kind == options.only]
    recordings = []
    made = render(scenes, options.work)
    for i, (folder, person, character) in enumerate(made):
        recordings.append(Tracked(folder, person, character))
        recordings[-1].run(options.vfit)
        print(f"\rtracked {i + 1} of {len(made)}", end="", file=sys.stderr)
    print(file=sys.stderr)
    rows = report(recordings, options.offsets_of or min(r.character for r in recordings))
    if options.worst:
        worst(recordings, options.worst)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
