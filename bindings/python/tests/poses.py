"""What other programs make of vfit's poses: forward kinematics, and a strict reader of BVH files."""

import numpy as np

import vfit

# Of a bone's parent, by Bone; VRM's hierarchy.
PARENTS = [-1, 0, 1, 2, 3, 4, 3, 6, 7, 8, 3, 10, 11, 12, 0, 14, 15, 16, 0, 18, 19, 20]
NAMES = [name[0].upper() + name[1:] for name in vfit.BONE_NAMES]
MIRROR_X = np.diag([-1.0, 1.0, 1.0])


def matrix(quaternion):
    """Of x, y, z, w."""
    x, y, z, w = (float(v) for v in quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def chained(positions, matrices):
    """Places and rotations of the bones from local ones, in one frame."""
    places, turns = [], []
    for bone, parent in enumerate(PARENTS):
        if parent < 0:
            places.append(np.array(positions[bone], float))
            turns.append(matrices[bone])
        else:
            places.append(places[parent] + turns[parent] @ np.array(positions[bone], float))
            turns.append(turns[parent] @ matrices[bone])
    return np.array(places), np.array(turns)


def posed(pose):
    return chained(pose.positions, [matrix(q) for q in pose.rotations])


def degrees_between(a, b):
    cosine = (np.trace(a @ b.T) - 1) / 2
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))


def about(axis, degrees):
    s, c = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    return {
        "X": np.array([[1, 0, 0], [0, c, -s], [0, s, c]]),
        "Y": np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
        "Z": np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
    }[axis]


class Bvh:
    """A file of one root. frames: local positions and rotations of the joints, by name."""

    def __init__(self, text):
        self.words = iter(text.split())
        self.names, self.parents, self.offsets, self.channels = [], [], [], []
        self.due("HIERARCHY", "ROOT")
        self.joint(-1)
        self.due("MOTION", "Frames:")
        count = int(next(self.words))
        self.due("Frame", "Time:")
        self.frame_time_s = float(next(self.words))
        values = np.array([float(word) for word in self.words])
        self.frames = values.reshape(count, sum(len(c) for c in self.channels))

    def due(self, *words):
        for word in words:
            got = next(self.words)
            assert got == word, f"{got} where {word} is due"

    def numbers(self, count):
        return [float(next(self.words)) for _ in range(count)]

    def joint(self, parent):
        self.names.append(next(self.words))
        index = len(self.names) - 1
        self.parents.append(parent)
        self.due("{", "OFFSET")
        self.offsets.append(np.array(self.numbers(3)))
        self.due("CHANNELS")
        self.channels.append([next(self.words) for _ in range(int(next(self.words)))])
        while (word := next(self.words)) != "}":
            if word == "JOINT":
                self.joint(index)
            else:
                assert word == "End", word
                self.due("Site", "{", "OFFSET")
                self.numbers(3)
                self.due("}")

    def posed(self, frame):
        """Places in the file's unit, and rotations: channels apply in their order, R = R1 R2 R3."""
        values = iter(self.frames[frame])
        positions, matrices = [], []
        for offset, channels in zip(self.offsets, self.channels):
            position, turn = offset.copy(), np.eye(3)
            for channel in channels:
                value = next(values)
                if channel.endswith("position"):
                    position["XYZ".index(channel[0])] += value
                else:
                    turn = turn @ about(channel[0], value)
            positions.append(position)
            matrices.append(turn)
        return chained(positions, matrices)
