"""Judges floors, and bodies where no person is, on depth images of real rooms.

    python3 tools/judge_rooms FOLDER --vfit build/bin/vfit

FOLDER holds recordings (docs/recording.md), each with a truth.json:

    {"maker": "who made the image",
     "floor": {"height_m": 1.3, "tilt_deg": 12.0, "roll_deg": -3.0, "seen": 0.2},
     "people": 0}

`floor` is as `vfit track --json` prints it, null where it is not known; `seen` is the fraction of the image
that shows it. The first and the last image of each recording are judged.
"""

import argparse
import json
import math
import subprocess
import sys
from collections import Counter
from pathlib import Path

OFF_DEG, OFF_M = 10.0, 0.2  # of a floor that is right
LEAST_SEEN = 0.01  # of the image: a floor of less need not be found
KINDS = ("right", "wrong", "missed", "none, rightly", "invented")


def up(floor):
    tilt, roll = (math.radians(floor[key]) for key in ("tilt_deg", "roll_deg"))
    return -math.sin(roll) * math.cos(tilt), -math.cos(roll) * math.cos(tilt), -math.sin(tilt)


def verdict(said, truth):
    """One of KINDS. `said`: the floor as vfit prints it."""
    told = said["state"] != "unknown"
    seen = truth is not None and truth["seen"] >= LEAST_SEEN
    if not told:
        return "missed" if seen else "none, rightly"
    if truth is None:
        return "invented"
    cosine = sum(a * b for a, b in zip(up(said), up(truth)))
    right = cosine >= math.cos(math.radians(OFF_DEG)) and abs(said["height_m"] - truth["height_m"]) <= OFF_M
    return "right" if right else "wrong" if seen else "invented"


def track(vfit, recording):
    """What vfit prints of each image, without calibration, user map or joints of the recording's own."""
    command = [vfit, "track", recording, "--user-map", "tracked", "--joints", "tracked", "--json"]
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    except OSError as error:
        raise SystemExit(f"judge_rooms: {error}") from error
    if done.returncode:
        raise SystemExit(f"judge_rooms: {recording}: {done.stderr.strip()}")
    frames = [json.loads(line) for line in done.stdout.splitlines() if line.startswith('{"frame"')]
    if not frames:
        raise SystemExit(f"judge_rooms: {recording}: vfit track printed no frame")
    return frames


def read_truth(file):
    try:
        truth = json.loads(file.read_text())
        if truth["floor"] is not None:
            numbers = (*up(truth["floor"]), truth["floor"]["height_m"], truth["floor"]["seen"])
            if not all(map(math.isfinite, numbers)):
                raise ValueError("a number of the floor is not finite")
        return str(truth["maker"]), truth["floor"], int(truth["people"])
    except (ValueError, KeyError, TypeError) as error:
        raise SystemExit(f"judge_rooms: {file}: is no truth of a room: {error!r}") from error


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="of recordings with a truth.json each")
    parser.add_argument("--vfit", default="build/bin/vfit", help="the vfit program")
    parser.add_argument("--list", action="store_true", help="print each image that is not right")
    options = parser.parse_args()
    files = sorted(options.folder.glob("*/truth.json"))
    if not files:
        raise SystemExit(f"judge_rooms: {options.folder}: no recording in it has a truth.json")
    floors, empty, haunted = {}, Counter(), Counter()
    for file in files:
        maker, floor, people = read_truth(file)
        frames = track(options.vfit, str(file.parent))
        judged = [frames[0], frames[-1]] if len(frames) > 1 else frames
        for frame in judged:
            kind = verdict(frame["floor"], floor)
            floors.setdefault(maker, Counter())[kind] += 1
            if options.list and kind in ("wrong", "missed", "invented"):
                print(f"{file.parent.name}, image {frame['frame']}: the floor is {kind}: {frame['floor']}")
        if people == 0:
            empty[maker] += 1
            bodies = max(len(frame["bodies"]) for frame in frames)
            haunted[maker] += bodies > 0
            if options.list and bodies:
                print(f"{file.parent.name}: {bodies} bodies and no person")
        print(".", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    print(f"REAL: {len(files)} recordings of rooms; the floor of the first and the last image")
    width = max(map(len, floors))
    print(
        f"  {'maker':{width}}" + "".join(f"{kind:>15}" for kind in KINDS) + "   without a person, with a body"
    )
    floors["all"] = sum(floors.values(), Counter())
    empty["all"], haunted["all"] = empty.total(), haunted.total()
    for maker, kinds in floors.items():
        print(
            f"  {maker:{width}}"
            + "".join(f"{kinds[kind]:15}" for kind in KINDS)
            + f"{haunted[maker]:15} of {empty[maker]}"
        )


if __name__ == "__main__":
    main()
