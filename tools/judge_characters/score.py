"""Tracked joints against true ones, by the rules of tools/bench/track_score.cpp."""

import csv
import json
import subprocess

import numpy as np

from character import JOINTS

TORSO, SHOULDERS, HIPS, NECK = 2, (3, 4), (9, 10), 1
FIRST_PAIRED = 3
SAME_PERSON_M = 0.5
WITHIN_M = 0.10
SIDE_DEG = (60.0, 120.0)  # of the heading, that is a side view
MIRRORED = list(range(FIRST_PAIRED)) + [
    j + (1 if (j - FIRST_PAIRED) % 2 == 0 else -1) for j in range(FIRST_PAIRED, len(JOINTS))
]


class Tracked:
    """One recording: true and tracked joints (frames, joints, 3), not a number where there are none."""

    def __init__(self, folder, person, character):
        self.folder, self.person, self.character = folder, person, character
        self.kind = folder.name.split("-")[0]
        self.labels = json.loads((folder / "labels.json").read_text())
        with open(folder / "joints.csv", newline="") as file:
            rows = [[float(x) for x in row[1:]] for row in list(csv.reader(file))[1:]]
        self.truth = np.array(rows).reshape(len(rows), len(JOINTS), 3)
        self.found = np.full_like(self.truth, np.nan)

    def run(self, vfit):
        command = [vfit, "track", str(self.folder), "--json", "--joints", "tracked", "--user-map", "tracked"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{self.folder}: vfit track failed: {done.stderr.strip()}")
        for line in done.stdout.splitlines():
            frame = json.loads(line)
            self._take(frame["frame"], frame["bodies"])

    def _take(self, frame, bodies):
        best = SAME_PERSON_M
        for body in bodies:
            if "TORSO" not in body["joints"]:
                continue
            away = np.linalg.norm(np.array(body["joints"]["TORSO"][:3]) - self.truth[frame, TORSO])
            if away < best:
                best = away
                for j, name in enumerate(JOINTS):
                    self.found[frame, j] = body["joints"].get(name, [np.nan] * 3)[:3]

    def heading_deg(self):
        """How far the true hips are turned from the camera, 0 to 180."""
        left = self.truth[:, HIPS[0]] - self.truth[:, HIPS[1]]
        return np.degrees(np.arccos(np.clip(left[:, 0] / np.hypot(left[:, 0], left[:, 2]), -1, 1)))

    def from_the_side(self):
        deg = self.heading_deg()
        return (deg >= SIDE_DEG[0]) & (deg <= SIDE_DEG[1])

    def seen(self):
        return ~np.isnan(self.found[:, TORSO, 0])

    def wrong(self):
        """Frames in which left and right are exchanged."""
        straight = np.linalg.norm(self.found - self.truth, axis=-1)[:, FIRST_PAIRED:]
        exchanged = np.linalg.norm(self.found[:, MIRRORED] - self.truth, axis=-1)[:, FIRST_PAIRED:]
        return self.seen() & (np.nansum(exchanged, 1) < np.nansum(straight, 1))

    def flips(self):
        wrong = self.wrong()
        return int((wrong & ~np.concatenate([[False], wrong[:-1]])).sum())

    def within(self, offsets=None):
        """Of each frame and joint whether it is within 10 cm; a joint that is missing is not."""
        found = self.found if offsets is None else self.found + carried(offsets, self.found)
        return np.linalg.norm(found - self.truth, axis=-1) <= WITHIN_M


def axes_of(joints):
    """The body's own axes (frames, 3, 3), rows: to the left, up the trunk, ahead."""
    left = joints[:, SHOULDERS[0]] - joints[:, SHOULDERS[1]]
    left = left / np.linalg.norm(left, axis=-1, keepdims=True)
    up = joints[:, NECK] - 0.5 * (joints[:, HIPS[0]] + joints[:, HIPS[1]])
    up = up - (up * left).sum(-1, keepdims=True) * left
    up = up / np.linalg.norm(up, axis=-1, keepdims=True)
    return np.stack([left, up, np.cross(left, up)], 1)


def fit_offsets(recordings):
    """The constant place of each joint in the body's axes that carries tracked joints to true ones."""
    own = [np.einsum("fak,fjk->fja", axes_of(r.found), r.truth - r.found) for r in recordings]
    return np.nan_to_num(np.nanmedian(np.concatenate(own), 0))


def carried(offsets, found):
    return np.einsum("fak,ja->fjk", axes_of(found), offsets)


def summary(recordings, choose, offsets=None):
    """Figures of the frames that choose(recording) marks."""
    marks = [choose(r) for r in recordings]
    frames = sum(int(m.sum()) for m in marks)
    inside = sum(int(r.within(offsets)[m].sum()) for r, m in zip(recordings, marks))
    return {
        "frames": frames,
        "missed": sum(int((~r.seen())[m].sum()) for r, m in zip(recordings, marks)),
        "wrong": sum(int(r.wrong()[m].sum()) for r, m in zip(recordings, marks)),
        "flips": sum(r.flips() for r in recordings),
        "map": inside / (frames * len(JOINTS)) if frames else float("nan"),
    }


def joint_table(recordings, offsets):
    """Of each joint: name, raw and with offsets (median error in metres, within 10 cm), and the offset."""
    found = np.concatenate([r.found for r in recordings])
    truth = np.concatenate([r.truth for r in recordings])
    moved = found + carried(offsets, found)
    for j, name in enumerate(JOINTS):
        out = []
        for joints in (found, moved):
            error = np.linalg.norm(joints[:, j] - truth[:, j], axis=-1)
            out += [float(np.nanmedian(error)), float((error <= WITHIN_M).mean())]
        yield name, *out, offsets[j]
