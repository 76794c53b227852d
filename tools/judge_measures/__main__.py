"""Judges the measures of bodies of other makers, drawn by a renderer of their own.

    build/venv/bin/python tools/judge_measures FOLDER --vfit build/bin/vfit --work WORK

FOLDER holds bare bodies (*.glb, bones named as Mixamo's); a file whose name begins with "female" is a
woman's. docs/measuring.md has what is printed.
"""

import argparse
import json
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "judge_characters"))

from body import Tape, standing  # noqa: E402
from character import Character  # noqa: E402
from glb import BadFile, read_glb  # noqa: E402
from motion import Actor  # noqa: E402
from recording import FPS, Recording  # noqa: E402
from renderer import Camera, room_depth, see, sense  # noqa: E402

# What vfit tells and which true measure it is compared with. A waist by the rig's joints shows what the
# level matters.
MEASURES = {
    "stature_m": "stature_m",
    "chest_girth_m": "chest_girth_m",
    "waist_girth_m": "waist_girth_m",
    "hip_girth_m": "hip_girth_m",
    "waist_minimum_girth_m": "waist_minimum_girth_m",
    "waist_girth_m (rig's)": "waist_of_rig_girth_m",
}
FRONT_FRAMES, SIDE_FRAMES, STILL_FRAMES = 45, 45, 20  # the tracker sees the room first
TURN_FRAMES, TURN_DEG = 160, 375  # once round
AROUND_FRAMES = 70  # of several cameras at once
TURNED = 0.5  # of the ways to face: from there on a turn counts
GIRTHS, DEPTHS = (0.92, 1.0, 1.08, 1.18), (1.0, 0.95, 1.08)
STATURES_M = {"f": (1.52, 1.60, 1.68, 1.76), "m": (1.65, 1.73, 1.81, 1.90)}
SENSORS = [(512, 424, 366.0), (640, 480, 525.0)]  # Kinect v2; of the field of view of Kinect v1
INTERVAL = 1.645
# Between the ankles: feet slightly apart for girths; side by side for stature (ISO 8559-1 5.1.1), where the
# ankles are a foot's breadth apart (ANSUR II: 0.10 m of men, 0.09 of women).
FEET_APART_M, FEET_TOGETHER_M = 0.25, 0.10
ARMS_OUT_DEG = 15.0  # hanging clear of the trunk; raised, they widen it below the armpits


class Person:
    """A body at a stature, a girth (across and ahead) and a depth (ahead alone)."""

    def __init__(self, path, number):
        self.name = f"{path.stem}-{number:03}"
        self.sex = "f" if path.stem.startswith("female") else "m"
        self.character = Character(read_glb(path))
        self.rng = np.random.default_rng(zlib.crc32(self.name.encode()))
        self.stature_m = float(self.rng.choice(STATURES_M[self.sex]) + self.rng.uniform(-0.02, 0.02))
        self.girth, self.depth = float(self.rng.choice(GIRTHS)), float(self.rng.choice(DEPTHS))

    def actor(self, arms_out_deg, arms_ahead_deg, feet_apart_m=None):
        metre = self.character.stature(_world(self.character)) / self.stature_m
        motion = standing(self.character, arms_out_deg, arms_ahead_deg, feet_apart_m, metre)
        actor = Actor(motion, np.zeros(1), self.stature_m, self.girth)
        actor.turn = np.diag([1.0, 1.0, self.depth]) @ actor.turn
        actor.way = actor.way * [1, 1, self.depth]
        actor.joint_points = {n: p * [1, 1, self.depth] for n, p in actor.joint_points.items()}
        return actor

    def truth(self):
        """Each measure in the stance of its definition; files stand as their makers left them."""
        out = Tape(self.actor(ARMS_OUT_DEG, 0.0, FEET_APART_M), self.sex).measures()
        together = Tape(self.actor(ARMS_OUT_DEG, 0.0, FEET_TOGETHER_M), self.sex).measures()
        return out | {"stature_m": together["stature_m"]}

    def record(self, folder, turn_deg):
        """From the front, then from the side or so far round on the spot, with small movements."""
        rng = self.rng
        sensor = Sensor(rng, self.stature_m)
        feet_m = rng.uniform(0.25, 0.35)
        front = self.actor(rng.uniform(30, 43), 0.0, feet_m), rng.uniform(-8, 8)
        side = self.actor(rng.uniform(6, 12), rng.uniform(30, 43), feet_m), 90 + rng.uniform(-8, 8)
        # Actor and heading of every frame.
        views = [(front[0].skin(0), front[0].joints(0), front[1])] * FRONT_FRAMES
        if turn_deg:
            turning = self.actor(rng.uniform(36, 48), 0.0, feet_m)
            turning = turning.skin(0), turning.joints(0)
            frames = TURN_FRAMES * turn_deg // TURN_DEG
            views += [(*turning, front[1] + TURN_DEG * i / TURN_FRAMES) for i in range(frames)]
        else:
            views += [(side[0].skin(0), side[0].joints(0), side[1])] * SIDE_FRAMES
        self._draw(folder, sensor, views)

    def record_around(self, folder, cameras):
        """By so many cameras at once, all around: a recording each, and how they stand to each other."""
        rng = self.rng
        actor = self.actor(rng.uniform(36, 48), 0.0, rng.uniform(0.25, 0.35))
        actor, heading = (actor.skin(0), actor.joints(0)), rng.uniform(-8, 8)
        places = []
        for i in range(cameras):
            sensor, around = Sensor(rng, self.stature_m), 360 * i / cameras + rng.uniform(-8, 8) * (i > 0)
            self._draw(folder / str(i), sensor, [(*actor, heading + around)] * AROUND_FRAMES)
            # The person stands as far before each; as roughly as people walking about would tell it.
            turned = -around + rng.uniform(-3, 3)
            at = np.array([0, 0, -sensor.distance_m])
            if i == 0:
                first = at
            place = first - _about_up(turned) @ at + rng.uniform(-0.03, 0.03, 3)
            places.append({"position": place.tolist(), "turned_deg": turned})
        places[0] = {"position": [0, 0, 0], "turned_deg": 0}
        text = json.dumps({"format": "vfit-cameras", "version": 1, "cameras": places}, indent=1)
        (folder / "places.json").write_text(text + "\n")

    def _draw(self, folder, sensor, views):
        """`views`: skin, joints and heading of every frame."""
        rng, camera, room, focal = self.rng, sensor.camera, sensor.room, sensor.focal
        recording = Recording(folder, camera, ["empty"] * STILL_FRAMES + ["scan"] * len(views))
        for _ in range(STILL_FRAMES):
            recording.add(sense(room, focal, rng), views[0][1])
        for frame, (skin, joints, heading) in enumerate(views):
            t = frame / FPS
            turn = _about_up(heading + 0.7 * np.sin(1.1 * t))
            at = np.array([0.004 * np.sin(2.1 * t), 0, 0.006 * np.sin(1.4 * t + 1) - sensor.distance_m])
            depth = see(skin @ turn.T + at, self.character.faces, camera, room)
            moved = {name: camera.to_camera(p @ turn.T + at) for name, p in joints.items()}
            recording.add(sense(depth, focal, rng), moved)
        recording.close()


class Sensor:
    """A camera before a person of that stature, and the room behind."""

    def __init__(self, rng, stature_m):
        width, height, self.focal = SENSORS[rng.integers(len(SENSORS))]
        height_m = rng.uniform(0.6, 1.6)
        self.distance_m = rng.uniform(2.4, 3.1) + 0.35 * (self.focal > 500)
        tilt = np.degrees(np.arctan2(height_m - 0.5 * stature_m, self.distance_m)) + rng.uniform(-1.5, 1.5)
        self.camera = Camera(width, height, self.focal, height_m, tilt)
        self.room = room_depth(self.camera, self.distance_m + rng.uniform(0.8, 1.6), rng.uniform(1.4, 2.2))


def _world(character):
    g = character.glb
    return g.world_matrices(g.translation, g.rotation, g.scale)[None]


def _about_up(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def measured(vfit, folder, flags):
    """What vfit tells of a recording: measures by key, or the reason why there are none."""
    others = []
    if (folder / "places.json").exists():
        cameras = sorted(path for path in folder.iterdir() if path.is_dir())
        folder, others = cameras[0], ["--places", str(folder / "places.json")]
        for camera in cameras[1:]:
            others += ["--camera", str(camera)]
    command = [
        vfit,
        "measure",
        str(folder),
        "--json",
        "--joints",
        "tracked",
        "--user-map",
        "tracked",
        "--bare",
    ]
    done = subprocess.run(command + others + flags, capture_output=True, text=True)
    if done.returncode:
        return None, done.stderr.strip()
    out = json.loads(done.stdout)
    if out["method"] != "fit":
        return None, out.get("note", "")
    if not (others or out.get("side_frames") or out.get("turned", 0) >= TURNED):
        return None, "no side view, or no half turn: " + out.get("note", "")
    return out["measurements"], ""


def report(title, rows):
    """`rows`: truth and told measures of each person."""
    print(f"\n{title}: {len(rows)} people; mean absolute error with 95 % confidence, bias (mm), within 90 %")
    figures = {}
    for key, true_key in MEASURES.items():
        told_key = key.split()[0]
        error = np.array([1000 * (told[told_key]["value"] - truth[true_key]) for truth, told in rows])
        sigma = np.array([1000 * told[told_key]["sigma"] for _, told in rows])
        off, inside = np.abs(error), np.abs(error) <= INTERVAL * sigma
        confidence = 1.96 * off.std() / np.sqrt(len(off))
        print(
            f"  {key:22}{off.mean():7.1f} +-{confidence:5.1f}{error.mean():8.1f}{100 * inside.mean():6.0f} %"
        )
        figures[key] = {"mean_mm": off.mean(), "bias_mm": error.mean(), "inside": float(inside.mean())}
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="bare bodies (*.glb)")
    parser.add_argument("--vfit", default="build/bin/vfit", help="the program (build/bin/vfit)")
    parser.add_argument("--work", type=Path, required=True, help="recordings are kept there")
    parser.add_argument("--people", type=int, default=48, help="how many (48)")
    parser.add_argument(
        "--turn",
        type=int,
        nargs="?",
        const=TURN_DEG,
        default=0,
        metavar="DEGREES",
        help="a turn on the spot instead of the side view (all round)",
    )
    parser.add_argument(
        "--cameras",
        type=int,
        default=1,
        help="so many, all around at the same time, instead of the side view (1)",
    )
    parser.add_argument("--list", action="store_true", help="a line for each person")
    parser.add_argument("--json", type=Path, help="write the figures there")
    options = parser.parse_args()
    files = sorted(options.folder.glob("*.glb"))
    if not files:
        raise SystemExit(f"judge_measures: {options.folder}: holds no .glb")
    turn = ["--turn"] if options.turn else []
    around = options.cameras > 1
    if around and options.turn:
        raise SystemExit("judge_measures: --turn is seen by one camera: leave --cameras out")
    suffix = ""
    if around:
        suffix = f"-around{options.cameras}"
    elif options.turn:
        suffix = "-turn" if options.turn == TURN_DEG else f"-turn{options.turn}"
    told = {"told nothing": (turn, []), "told tight": (turn + ["--tight"], [])}
    for number in range(options.people):
        try:
            person = Person(files[number % len(files)], number)
            truth = person.truth()
            folder = options.work / (person.name + suffix)
            if around:
                if not (folder / "places.json").exists():
                    person.record_around(folder, options.cameras)
            elif not (folder / "camera.json").exists():
                person.record(folder, options.turn)
            (folder / "truth.json").write_text(json.dumps({"sex": person.sex, "measures": truth}))
        except (BadFile, OSError) as error:
            raise SystemExit(f"judge_measures: {error}") from None
        for title, (flags, rows) in told.items():
            measures, why = measured(options.vfit, folder, flags)
            if measures is None:
                print(f"{person.name}, {title}: {why}", file=sys.stderr)
                continue
            rows.append((truth, measures))
            if options.list:
                pairs = [(measures[key.split()[0]]["value"], truth[own]) for key, own in MEASURES.items()]
                off = [round(1000 * (value - own)) for value, own in pairs]
                own = [round(1000 * own) for _, own in pairs]
                print(f"  {person.name:14} {title:13} true {own} off {off} mm")
        print(f"\rmeasured {number + 1} of {options.people}", end="", file=sys.stderr)
    print(file=sys.stderr)
    figures = {
        title: report(f"BODIES OF OTHER MAKERS, {title}", rows) for title, (_, rows) in told.items() if rows
    }
    if options.json:
        options.json.write_text(json.dumps(figures, indent=1) + "\n")


if __name__ == "__main__":
    main()
