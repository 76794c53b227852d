"""Motions of a character: its own animations, or clips that are carried over to its bones."""

import numpy as np

from glb import matrix_of

SHORTEST_S = 0.5  # a shorter animation is a pose


class Motion:
    """World matrices of a character at the times of one clip, which is played again and again. The way from
    its start to its end is taken out, so that people walk in place and do not jump back where it starts
    anew."""

    def __init__(self, name, character, duration_s, world_at):
        self.name, self.character, self.duration_s, self._world_at = name, character, duration_s, world_at
        ends = world_at(np.array([0.0, duration_s]))[:, character.node_of["Hips"], :3, 3]
        self._way = (ends[1] - ends[0]) * [1, 0, 1]

    def world(self, times_s):
        times_s = np.asarray(times_s, float)
        if not self.duration_s:
            return self._world_at(np.zeros_like(times_s))
        times_s = times_s % self.duration_s
        world = self._world_at(times_s)
        world[..., :3, 3] -= (times_s / self.duration_s)[:, None, None] * self._way
        return world


def still(character):
    g = character.glb
    world = g.world_matrices(g.translation, g.rotation, g.scale)
    return Motion("still", character, 0.0, lambda times: np.repeat(world[None], len(times), 0))


def own_motions(character):
    g = character.glb
    out = []
    for i, name in enumerate(g.animations()):
        if g.duration_s(i) >= SHORTEST_S:
            out.append(
                Motion(name, character, g.duration_s(i), lambda t, i=i: g.world_matrices(*g.sample(i, t)))
            )
    return out


def carried_motion(name, character, clip, rest):
    """The clip (a Glb with an animation) on another skeleton. `rest` has the clip's bones in the T-pose, as
    the character's nodes are. Bones turn in world space as they do in the clip; hips move by as much, scaled
    by their height."""
    g = character.glb
    pairs = {
        i: (clip.names.index(n), rest.names.index(n))
        for i, n in enumerate(g.names)
        if n in clip.names and n in rest.names and n != "Armature"
    }
    at_rest = g.world_matrices(g.translation, g.rotation, g.scale)
    clip_rest = rest.world_matrices(rest.translation, rest.rotation, rest.scale)
    hips = character.node_of["Hips"]
    tall = at_rest[hips, 1, 3] / clip_rest[rest.names.index("Hips"), 1, 3]

    def world_at(times):
        moved = clip.world_matrices(*clip.sample(0, times))
        world = np.empty((len(times),) + at_rest.shape)
        local = matrix_of(g.translation, g.rotation, g.scale)
        for i in g.order:
            p = g.parent[i]
            world[:, i] = local[i] if p < 0 else world[:, p] @ local[i]
            if i not in pairs:
                continue
            in_clip, in_rest = pairs[i]
            turn = _turn(moved[:, in_clip]) @ np.linalg.inv(_turn(clip_rest[in_rest]))
            world[:, i, :3, :3] = turn @ at_rest[i, :3, :3]
            if i == hips:
                way = moved[:, in_clip, :3, 3] - clip_rest[in_rest, :3, 3]
                world[:, i, :3, 3] = at_rest[i, :3, 3] + tall * way
        return world

    return Motion(name, character, clip.duration_s(0), world_at)


def _turn(matrices):
    return matrices[..., :3, :3] / np.linalg.norm(matrices[..., :3, :3], axis=-2, keepdims=True)


class Actor:
    """One person: a character of a stature and a girth, in one motion, on the floor at the origin, facing +Z
    on the average of the frames."""

    def __init__(self, motion, times_s, stature_m, girth):
        self.character = motion.character
        self.world = motion.world(times_s)
        self.metre = self.character.stature(self.world) / stature_m
        joints = self.character.joints(self.world, self.metre)
        left = (joints["LEFT_HIP"] - joints["RIGHT_HIP"]).mean(0)
        yaw = np.arctan2(left[2], left[0])  # of a person who faces +Z the left is +X
        c, s = np.cos(yaw), np.sin(yaw)
        self.turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) * np.array([girth, 1, girth])[:, None]
        self.turn = self.turn / self.metre
        way = 0.5 * (joints["LEFT_HIP"] + joints["RIGHT_HIP"]) @ self.turn.T
        self.way = np.repeat(way.mean(0, keepdims=True), len(way), 0)
        some = range(0, len(times_s), max(1, len(times_s) // 12))
        heights = [(self.character.skin(self.world[i]) @ self.turn.T)[:, 1] for i in some]
        low = min(y.min() for y in heights)
        self.way[:, 1] = low
        self.top_m = max(y.max() for y in heights) - low
        self.joint_points = {name: at @ self.turn.T - self.way for name, at in joints.items()}

    def skin(self, frame):
        return self.character.skin(self.world[frame]) @ self.turn.T - self.way[frame]

    def joints(self, frame):
        return {name: at[frame] for name, at in self.joint_points.items()}
