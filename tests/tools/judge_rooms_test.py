"""The judge on rooms tells right floors from wrong ones, and runs vfit on recordings."""

import importlib.util
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "judge_rooms"
sys.path.insert(0, str(ROOT / "tools" / "judge_characters"))

from recording import png16  # noqa: E402

VFIT = Path(os.environ.get("VFIT_BUILD_DIR", ROOT / "build")) / "bin" / "vfit"
CAMERA = {"width": 320, "height": 240, "fx": 290.0, "fy": 290.0, "cx": 159.5, "cy": 119.5}
FLOOR = {"height_m": 1.2, "tilt_deg": 15.0, "roll_deg": 4.0, "seen": 0.4}


def load():
    spec = importlib.util.spec_from_file_location("judge_rooms", TOOL / "__main__.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


judge = load()


def said(**changes):
    return {"state": "estimated", "height_m": 1.2, "tilt_deg": 15.0, "roll_deg": 4.0, **changes}


def room(folder, floor):
    """Two images of a floor and of a wall 4 m away."""
    (folder / "depth").mkdir(parents=True)
    v, u = np.mgrid[: CAMERA["height"], : CAMERA["width"]].astype(float)
    rays = np.stack([(u - CAMERA["cx"]) / CAMERA["fx"], (v - CAMERA["cy"]) / CAMERA["fy"], np.ones_like(u)])
    down = -np.tensordot(judge.up(floor), rays, 1)
    z = np.where(down > 0, floor["height_m"] / np.maximum(down, 1e-6), 4.0)
    depth = np.round(1000 * np.minimum(z, 4.0))
    for frame in range(2):
        (folder / "depth" / f"{frame:06}.png").write_bytes(png16(depth))
    text = {"format": "vfit-recording", "version": 1, "sensor": "test", "fps": 30, "depth_unit_m": 0.001}
    (folder / "camera.json").write_text(json.dumps({**text, **CAMERA}))


def run(folder, vfit=VFIT):
    command = [sys.executable, "-B", TOOL, folder, "--vfit", vfit, "--list"]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


class Verdict(unittest.TestCase):
    def test_a_floor_is_right_within_10_degrees_and_20_centimetres(self):
        self.assertEqual(judge.verdict(said(tilt_deg=24.0), FLOOR), "right")
        self.assertEqual(judge.verdict(said(tilt_deg=26.0), FLOOR), "wrong")
        self.assertEqual(judge.verdict(said(roll_deg=-86.0), FLOOR), "wrong")
        self.assertEqual(judge.verdict(said(height_m=1.38), FLOOR), "right")
        self.assertEqual(judge.verdict(said(height_m=1.42), FLOOR), "wrong")

    def test_a_floor_that_is_not_seen_may_be_unknown(self):
        hidden, none = {**FLOOR, "seen": 0.001}, said(state="unknown")
        self.assertEqual(judge.verdict(none, FLOOR), "missed")
        self.assertEqual(judge.verdict(none, hidden), "none, rightly")
        self.assertEqual(judge.verdict(said(), hidden), "right")
        self.assertEqual(judge.verdict(said(height_m=0.5), hidden), "invented")
        self.assertEqual(judge.verdict(said(), None), "invented")


class Tool(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        room(self.folder / "one", FLOOR)

    def tell(self, floor):
        truth = {"maker": "a test", "floor": floor, "people": 0}
        (self.folder / "one" / "truth.json").write_text(json.dumps(truth))

    def test_a_room_is_judged(self):
        self.tell(FLOOR)
        done = run(self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"a test +2 +0 +0 +0 +0 +0 of 1\n")
        self.tell({**FLOOR, "height_m": 0.7})
        done = run(self.folder)
        self.assertRegex(done.stdout, r"all +0 +2 +0 +0 +0 +0 of 1\n")
        self.assertIn("one, image 0: the floor is wrong", done.stdout)

    def test_what_is_no_truth_is_named(self):
        done = run(self.folder)
        self.assertIn("no recording in it has a truth.json", done.stderr)
        for floor in ({"height_m": 1.0}, {**FLOOR, "height_m": math.nan}, {**FLOOR, "seen": "much"}, 7):
            self.tell(floor)
            done = run(self.folder)
            self.assertNotEqual(done.returncode, 0)
            self.assertRegex(done.stderr, "^judge_rooms: .*truth.json: is no truth of a room")

    def test_a_program_that_is_missing_is_named(self):
        self.tell(FLOOR)
        done = run(self.folder, "no_such_vfit")
        self.assertRegex(done.stderr, "^judge_rooms: .*no_such_vfit")


if __name__ == "__main__":
    unittest.main()
