"""The judge of measures poses a figure whose girths are known, and reads them off."""

import importlib.util
import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools" / name) for name in ("judge_measures", "judge_characters")]
sys.path.insert(0, str(Path(__file__).resolve().parent))

from body import Tape, hull_perimeter, standing  # noqa: E402
from character import Character  # noqa: E402
from glb import Glb  # noqa: E402
from judge_characters_test import BONES, box_man  # noqa: E402
from motion import Actor, still  # noqa: E402


def judge():
    """The program itself, as a module."""
    path = ROOT / "tools/judge_measures/__main__.py"
    spec = importlib.util.spec_from_file_location("judge_measures", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def man():
    return Character(Glb("man", box_man()))


class Column:
    """An elliptic trunk without arms, in the place of an actor: half axes by height."""

    def __init__(self, half_axes):
        levels, around = np.linspace(0.0, 1.8, 181), np.linspace(0, 2 * np.pi, 90, endpoint=False)
        rings = [
            np.stack([a * np.cos(around), np.full_like(around, y), b * np.sin(around)], 1)
            for y in levels
            for a, b in [half_axes(y)]
        ]
        count, ring = len(levels), len(around)
        self.points = np.concatenate(rings)
        quads = [
            (i * ring + j, i * ring + (j + 1) % ring, (i + 1) * ring + j, (i + 1) * ring + (j + 1) % ring)
            for i in range(count - 1)
            for j in range(ring)
        ]
        self.character = man()
        self.character.faces = np.array(
            [[a, b, c] for a, b, c, _ in quads] + [[b, d, c] for _, b, c, d in quads]
        )
        hips = self.character.node_of["Hips"]
        self.character.which = np.full((len(self.points), 1), list(self.character.nodes).index(hips))
        self.character.weights = np.ones((len(self.points), 1))
        # A sliver of an arm, from which the armpit is known.
        arm = list(self.character.nodes).index(self.character.node_of["LeftArm"])
        self.character.which[np.argmin(np.abs(self.points - [0.1, 1.4, 0]).sum(1))] = arm

    def skin(self, _):
        return self.points

    def joints(self, _):
        at = {f"{side}_HIP": np.array([x, 0.95, 0]) for side, x in (("LEFT", 0.1), ("RIGHT", -0.1))}
        return {**at, "NECK": np.array([0, 1.4, 0.0])}


def ellipse(a, b):
    h = ((a - b) / (a + b)) ** 2
    return np.pi * (a + b) * (1 + 3 * h / (10 + np.sqrt(4 - 3 * h)))


class TapeTest(unittest.TestCase):
    def test_a_tape_is_taut(self):
        notched = np.array([[0, 0], [2, 0], [2, 1], [1, 0.5], [0, 1], [1, 0]], float)
        self.assertAlmostEqual(hull_perimeter(notched), 6.0)
        self.assertEqual(hull_perimeter(notched[:2]), 0.0)

    def test_girths_are_taken_at_their_levels(self):
        hips, neck = 0.513 * 1.8, 0.864 * 1.8  # trochanterion and cervicale of men; not the rig's joints
        waist, of_rig = hips + 0.308 * (neck - hips), 0.95 + 0.308 * 0.45

        def half_axes(y):  # narrowest at the waist, widest at the hip joints, and deeper at the chest
            scale = (
                1.0 - 0.3 * np.exp(-(((y - waist) / 0.06) ** 2)) + 0.1 * np.exp(-(((y - 0.95) / 0.04) ** 2))
            )
            return 0.18 * scale, 0.12 * scale + 0.03 * np.exp(-(((y - 1.3) / 0.03) ** 2))

        told = Tape(Column(half_axes), "m").measures()
        self.assertAlmostEqual(told["stature_m"], 1.8, 6)
        self.assertAlmostEqual(told["waist_girth_m"], ellipse(*half_axes(waist)), delta=0.004)
        self.assertAlmostEqual(told["waist_of_rig_girth_m"], ellipse(*half_axes(of_rig)), delta=0.004)
        self.assertGreater(told["waist_of_rig_girth_m"], told["waist_girth_m"])
        self.assertAlmostEqual(told["hip_girth_m"], ellipse(*half_axes(0.95)), delta=0.004)
        self.assertAlmostEqual(told["chest_girth_m"], ellipse(*half_axes(1.3)), delta=0.004)
        self.assertAlmostEqual(told["waist_minimum_girth_m"], told["waist_girth_m"], delta=0.002)
        self.assertAlmostEqual(told["waist_breadth_m"], 2 * half_axes(waist)[0], delta=0.004)
        self.assertAlmostEqual(told["chest_depth_m"], 2 * half_axes(1.3)[1], delta=0.004)

    def test_the_narrowest_waist_is_sought_between_navel_and_rib_arch(self):
        narrow = 1.18  # above the waist's level, 1.12, below the rib arch, 1.21

        def half_axes(y):
            scale = 1.0 - 0.3 * np.exp(-(((y - narrow) / 0.03) ** 2)) - 0.5 * (y < 1.0)  # legs are thinner
            return 0.18 * scale, 0.12 * scale

        tape = Tape(Column(half_axes), "m")
        self.assertAlmostEqual(tape.narrowest_height(), narrow, delta=0.004)
        told = tape.measures()
        self.assertAlmostEqual(told["waist_minimum_girth_m"], ellipse(*half_axes(narrow)), delta=0.004)
        self.assertGreater(told["waist_girth_m"], told["waist_minimum_girth_m"] + 0.03)


class PostureTest(unittest.TestCase):
    def direction(self, actor, start, end):
        joints = actor.joints(0)
        along = joints[end] - joints[start]
        return along / np.linalg.norm(along)

    def test_arms_hang_as_far_out_and_ahead_as_asked(self):
        actor = Actor(standing(man(), 40.0, 0.0), np.zeros(1), 1.8, 1.0)
        out = self.direction(actor, "LEFT_SHOULDER", "LEFT_ELBOW")
        np.testing.assert_allclose(out, [np.sin(np.radians(40)), -np.cos(np.radians(40)), 0], atol=1e-6)
        np.testing.assert_allclose(self.direction(actor, "LEFT_ELBOW", "LEFT_HAND"), out, atol=1e-6)
        ahead = Actor(standing(man(), 0.0, 35.0), np.zeros(1), 1.8, 1.0)
        np.testing.assert_allclose(
            self.direction(ahead, "RIGHT_SHOULDER", "RIGHT_ELBOW"),
            [0, -np.cos(np.radians(35)), np.sin(np.radians(35))],
            atol=1e-6,
        )

    def test_feet_stand_apart_as_asked(self):
        joints = Actor(standing(man(), 40.0, 0.0, 0.3), np.zeros(1), 1.8, 1.0).joints(0)
        self.assertAlmostEqual(joints["LEFT_FOOT"][0] - joints["RIGHT_FOOT"][0], 0.3, delta=0.001)
        as_they_are = Actor(still(man()), np.zeros(1), 1.8, 1.0).joints(0)
        apart = BONES["LeftFoot"][1][0] - BONES["RightFoot"][1][0]
        self.assertAlmostEqual(as_they_are["LEFT_FOOT"][0] - as_they_are["RIGHT_FOOT"][0], apart, delta=0.001)

    def test_each_measure_is_taken_in_the_stance_of_its_definition(self):
        module = judge()
        person = object.__new__(module.Person)
        person.sex = "m"
        asked = []

        def actor(out_deg, ahead_deg, feet_m=None):
            asked.append(feet_m)
            return Actor(standing(man(), out_deg, ahead_deg, feet_m), np.zeros(1), 1.8, 1.0)

        class Extent:  # of a figure of boxes, which has no trunk to lay a tape about
            def __init__(self, figure, sex):
                self.stature_m = float(np.ptp(figure.skin(0)[:, 1]))

            def measures(self):
                return {"stature_m": self.stature_m, "hip_girth_m": self.stature_m}

        person.actor, module.Tape = actor, Extent
        truth = person.truth()
        self.assertEqual(asked, [module.FEET_APART_M, module.FEET_TOGETHER_M])
        self.assertGreater(truth["stature_m"], truth["hip_girth_m"], "feet together stand taller")


if __name__ == "__main__":
    unittest.main()
