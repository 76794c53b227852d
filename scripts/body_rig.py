# SPDX-License-Identifier: Apache-2.0
"""The rig of the baked body: MakeHuman's default rig without face, tongue, eye, breast and single toe bones.

What a removed bone carried goes to its nearest kept ancestor; the five toes become one bone.
"""

import numpy as np

# Order of VFIT_BONE_* in vfit.h.
HUMANOID = (
    ["root", "spine05", "spine03", "spine01", "neck01", "head"]
    + [bone + side for side in (".L", ".R") for bone in ("clavicle", "upperarm01", "lowerarm01", "wrist")]
    + [bone + side for side in (".L", ".R") for bone in ("upperleg01", "lowerleg01", "foot", "toes")]
)
# Order of BodyPart in body_model.h, and the bones (without digits and side) that make each up.
PARTS = [
    ("head", ""),
    ("torso", ""),
    ("upper_arm", ".L"),
    ("forearm", ".L"),
    ("hand", ".L"),
    ("upper_arm", ".R"),
    ("forearm", ".R"),
    ("hand", ".R"),
    ("thigh", ".L"),
    ("shank", ".L"),
    ("foot", ".L"),
    ("thigh", ".R"),
    ("shank", ".R"),
    ("foot", ".R"),
]
PART_OF = {
    "neck": "head",
    "head": "head",
    "root": "torso",
    "spine": "torso",
    "pelvis": "torso",
    "clavicle": "torso",
    "shoulder": "torso",
    "upperarm": "upper_arm",
    "lowerarm": "forearm",
    "wrist": "hand",
    "metacarpal": "hand",
    "finger": "hand",
    "upperleg": "thigh",
    "lowerleg": "shank",
    "foot": "foot",
    "toes": "foot",
}
MAX_BONES = 8


class Bone:
    def __init__(self, name, parent, head, tail):
        self.name, self.parent = name, parent
        self.head, self.tail = head, tail  # base mesh vertices -> share; they sum to 1


def part_of(name):
    side = name[-2:] if name[-2:] in (".L", ".R") else ""
    stem = name[: len(name) - len(side)].rstrip("0123456789-")
    part = PART_OF[stem]
    return PARTS.index((part, "" if part in ("head", "torso") else side))


def is_removed(name, below_head):
    return below_head or name.startswith(("breast", "toe"))


def mean_of(index_lists):
    shares = {}
    for indices in index_lists:
        for i in indices:
            shares[int(i)] = shares.get(int(i), 0.0) + 1.0 / len(indices) / len(index_lists)
    return shares


def build_rig(data):
    """Bones (parents first) and the bone index that each bone of the file gives its weights to."""
    file_bones = data.rig()
    children = {}
    for name, bone in file_bones.items():
        children.setdefault(bone["parent"], []).append(name)
    place = lambda name, end: data.joint_vertices(file_bones[name][end])
    bones, target = [], {}

    def visit(name, parent, below_head):
        if is_removed(name, below_head):
            target[name] = parent
            index = parent
        else:
            index = target[name] = len(bones)
            bones.append(Bone(name, parent, mean_of([place(name, "head")]), mean_of([place(name, "tail")])))
        toes = sorted(child for child in children.get(name, []) if child.startswith("toe"))
        if toes:  # the row of the ball joints to the row of the tips
            tips = [max(n for n in file_bones if n[:4] == toe[:4] and n[-2:] == toe[-2:]) for toe in toes]
            bones.append(
                Bone(
                    "toes" + name[-2:],
                    index,
                    mean_of([place(toe, "head") for toe in toes]),
                    mean_of([place(tip, "tail") for tip in tips]),
                )
            )
            for toe in file_bones:
                if toe.startswith("toe") and toe[-2:] == name[-2:]:
                    target[toe] = len(bones) - 1
            return
        for child in sorted(children.get(name, [])):
            visit(child, index, below_head or name == "head")

    visit("root", -1, False)
    return bones, target


def skin(data, bones, target, vertices):
    """Bones [n, 8] heaviest first, weights [n, 8] in 1/65535 that sum to 65535, the largest share lost."""
    row_of = {int(v): row for row, v in enumerate(vertices)}
    dense = np.zeros((len(vertices), len(bones)))
    for name, pairs in data.weights().items():
        for vertex, weight in pairs:
            if name in target and vertex in row_of:
                dense[row_of[vertex], target[name]] += weight
    order = np.argsort(-dense, axis=1, kind="stable")[:, :MAX_BONES]
    kept = np.take_along_axis(dense, order, axis=1)
    if (kept[:, 0] <= 0).any():
        raise ValueError("a vertex of the body has no bone")
    lost = 1.0 - kept.sum(axis=1) / dense.sum(axis=1)
    weights = np.floor(kept / kept.sum(axis=1, keepdims=True) * 65535 + 0.5).astype(np.int64)
    weights[:, 0] += 65535 - weights.sum(axis=1)
    order[weights == 0] = 0
    return order, weights, lost.max()
