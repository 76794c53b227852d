"""A body in the posture of a scan, and what an independent tape reads off it."""

import numpy as np

from character import SIDES
from motion import Motion

ARM_BONES = ("Arm", "ForeArm", "Hand")
OF_ARM = 0.5  # of a vertex's weight: from there on it is the arm's
# Mean heights of real people's landmarks as fractions of stature (ANSUR II). A rig's joints are no landmarks:
# MB-Lab's hip joints lie at 0.53 to 0.54 and its neck joints at 0.81 to 0.83, as it suits its skin.
TROCHANTERION, CERVICALE = {"f": 0.519, "m": 0.513}, {"f": 0.857, "m": 0.864}
RIB_ARCH = 0.2  # of the way from the waist to the neck
# Waist and navel, of the way from trochanterion to cervicale, as sdk/anthropometry/tape_trunk.cpp has them:
# the mean of tenth rib and iliac crest, and the navel, of the same survey.
WAIST, NAVEL = {"f": 0.328, "m": 0.308}, {"f": 0.245, "m": 0.252}
BELOW_HIPS = 0.12  # of that way, below trochanterion: the hip's lowest level
TAPE_HALF_WIDTH_M = 0.01
STEP_M = 0.002


def _below(glb, node):
    """The node and all that hang from it."""
    out = {node}
    for i in glb.order:
        if glb.parent[i] in out:
            out.add(i)
    return sorted(out)


def _turn_between(a, b):
    """The shortest turn (3, 3) from the direction of a to that of b: Rodrigues' formula."""
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    v = np.cross(a, b)
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.eye(3) + cross + cross @ cross / (1 + a @ b)


def _hanging(out_deg, ahead_deg, way):
    """The direction of a limb that far from hanging: outwards, and ahead."""
    out, ahead = np.radians(out_deg), np.radians(ahead_deg)
    return np.array([way * np.sin(out), -np.cos(out) * np.cos(ahead), np.cos(out) * np.sin(ahead)])


def standing(character, arms_out_deg, arms_ahead_deg, feet_apart_m=None, metre=1.0):
    """A motion without movement: upper arms that far from hanging, forearms in line with them; legs as they
    are in the file, or the feet that far apart."""
    g = character.glb
    world = g.world_matrices(g.translation, g.rotation, g.scale)

    def turn(bone, towards, direction):
        node, place = character.node_of[bone], character.bone(world, bone)
        moved = np.eye(4)
        moved[:3, :3] = _turn_between(character.bone(world, towards) - place, direction)
        moved[:3, 3] = place - moved[:3, :3] @ place
        for i in _below(g, node):
            world[i] = moved @ world[i]

    for side, way in zip(SIDES, (1.0, -1.0)):
        direction = _hanging(arms_out_deg, arms_ahead_deg, way)
        turn(side + "Arm", side + "ForeArm", direction)
        turn(side + "ForeArm", side + "Hand", direction)
        if feet_apart_m is not None:
            hip, foot = (character.bone(world, side + bone) for bone in ("UpLeg", "Foot"))
            length = np.linalg.norm(foot - hip)
            across = (way * 0.5 * feet_apart_m * metre - hip[0]) / length
            ahead = (foot - hip)[2] / length
            down = np.sqrt(1 - across**2 - ahead**2)
            turn(side + "UpLeg", side + "Foot", np.array([across, -down, ahead]))
    return Motion("standing", character, 0.0, lambda times: np.repeat(world[None], len(times), 0))


def hull_perimeter(points):
    """Of the convex hull of points (n, 2): Andrew 1979."""
    points = np.unique(points, axis=0)
    if len(points) < 3:
        return 0.0

    def turns_right(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) <= (b[1] - a[1]) * (c[0] - a[0])

    def half(ordered):
        out = []
        for p in ordered.tolist():
            while len(out) > 1 and turns_right(out[-2], out[-1], p):
                out.pop()
            out.append(p)
        return out[:-1]

    hull = np.array(half(points) + half(points[::-1]))
    return float(np.linalg.norm(hull - np.roll(hull, 1, 0), axis=1).sum())


class Tape:
    """Girths of a posed skin (metres, Y up): a taut tape about horizontal sections without the arms."""

    def __init__(self, actor, sex):
        character = actor.character
        self.sex, self.skin = sex, actor.skin(0)
        arms = [character.node_of[side + bone] for side in SIDES for bone in ARM_BONES]
        arms += [i for arm in arms for i in _below(character.glb, arm)]
        share = (np.isin(character.nodes, arms)[character.which] * character.weights).sum(1)
        self.of_arm = share > OF_ARM
        trunk = character.faces[self.of_arm[character.faces].sum(1) < 2]
        self.edges = np.concatenate([trunk[:, [0, 1]], trunk[:, [1, 2]], trunk[:, [2, 0]]])
        joints = actor.joints(0)
        hips_m, neck_m = 0.5 * (joints["LEFT_HIP"] + joints["RIGHT_HIP"])[1], joints["NECK"][1]
        self.middle = joints["NECK"][0]  # between left and right
        self.waist_of_rig_m = hips_m + WAIST[sex] * (neck_m - hips_m)
        self._find_levels(character)

    def _find_levels(self, character):
        floor, crown = self.skin[:, 1].min(), self.skin[:, 1].max()
        self.hips_m = floor + TROCHANTERION[self.sex] * (crown - floor)
        self.neck_m = floor + CERVICALE[self.sex] * (crown - floor)
        trunk_m = self.neck_m - self.hips_m
        self.waist_m = self.hips_m + WAIST[self.sex] * trunk_m
        self.navel_m = self.hips_m + NAVEL[self.sex] * trunk_m
        self.arch_m = self.waist_m + RIB_ARCH * (self.neck_m - self.waist_m)
        edges = np.concatenate([character.faces[:, [0, 1]], character.faces[:, [1, 2]]])
        borders = edges[self.of_arm[edges].sum(1) == 1]
        self.armpit_m = self.skin[borders].mean(1)[:, 1].min()

    def section(self, y):
        """Points (n, 2) where the trunk's edges pass that height."""
        a, b = self.skin[self.edges[:, 0]], self.skin[self.edges[:, 1]]
        cut = (a[:, 1] > y) != (b[:, 1] > y)
        a, b = a[cut], b[cut]
        share = (y - a[:, 1]) / (b[:, 1] - a[:, 1])
        return (a + share[:, None] * (b - a))[:, [0, 2]]

    def girth(self, y):
        return hull_perimeter(self.section(y))

    def _largest(self, levels):
        return float(levels[int(np.argmax([self.girth(y) for y in levels]))])

    def narrowest_height(self):
        levels = np.arange(self.navel_m, self.arch_m, STEP_M)
        return float(levels[int(np.argmin([self.girth(y) for y in levels]))])

    def chest_height(self):
        """Of a woman where the bust stands out most, of a man where the girth is largest."""
        if self.sex == "m":
            return self._largest(np.arange(self.arch_m, self.armpit_m - TAPE_HALF_WIDTH_M, STEP_M))
        heights = []
        for way in (1, -1):
            own = ~self.of_arm & (way * (self.skin[:, 0] - self.middle) > 0)
            own &= (self.skin[:, 1] > self.arch_m) & (self.skin[:, 1] < self.armpit_m)
            p = self.skin[own]
            heights.append(p[np.argmax(p[:, 2]), 1])
        return float(np.mean(heights))

    def hip_height(self):
        high = 0.5 * (self.hips_m + self.waist_m)
        low = self.hips_m - BELOW_HIPS * (self.neck_m - self.hips_m)
        return self._largest(np.arange(low, high, STEP_M))

    def measures(self):
        y = self.skin[:, 1]
        out = {"stature_m": float(y.max() - y.min())}
        levels = {
            "chest": self.chest_height(),
            "waist": self.waist_m,
            "waist_minimum": self.narrowest_height(),
            "hip": self.hip_height(),
        }
        for name, level in levels.items():
            across, ahead = np.ptp(self.section(level), axis=0)
            out[f"{name}_girth_m"] = self.girth(level)
            out[f"{name}_breadth_m"], out[f"{name}_depth_m"] = float(across), float(ahead)
        out["waist_of_rig_girth_m"] = self.girth(self.waist_of_rig_m)
        return out
