"""The meshes that vfit-bench writes of generated people have the girths that it tells of them."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools" / name) for name in ("judge_measures", "judge_characters")]

from body import WAIST, hull_perimeter  # noqa: E402

BENCH = Path(os.environ.get("VFIT_BUILD_DIR", ROOT / "build")) / "bin" / "vfit-bench"


def read(path):
    """Vertices, faces by group, and joints."""
    vertices, faces, joints, group = [], {}, {}, None
    for line in path.read_text().splitlines():
        word, *rest = line.split()
        if word == "v":
            vertices.append([float(x) for x in rest])
        elif word == "f":
            faces[group].append([int(i) - 1 for i in rest])
        elif word == "g":
            group = rest[0]
            faces[group] = []
        elif word == "#":
            joints[rest[1]] = np.array([float(x) for x in rest[2:]])
    return np.array(vertices), {name: np.array(of) for name, of in faces.items()}, joints


class PopulationMeshesTest(unittest.TestCase):
    def test_girths_are_those_of_the_mesh(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [BENCH, "population", "--space", "varied", "--count", "1", "--json", "--meshes", folder]
            done = subprocess.run(command, capture_output=True, text=True, check=True)
            (person,) = json.loads(done.stdout)["people"]
            points, faces, joints = read(Path(folder) / "0.obj")
        hips = 0.5 * (joints["LEFT_HIP"] + joints["RIGHT_HIP"])[1]
        level = hips + WAIST[person["sex"]] * (joints["NECK"][1] - hips)
        self.assertGreater(len(faces["arms"]), 1000)
        edges = np.concatenate([faces["body"][:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
        a, b = points[edges[:, 0]], points[edges[:, 1]]
        cut = (a[:, 1] > level) != (b[:, 1] > level)
        a, b = a[cut], b[cut]
        way = (level - a[:, 1]) / (b[:, 1] - a[:, 1])
        section = (a + way[:, None] * (b - a))[:, [0, 2]]
        self.assertAlmostEqual(hull_perimeter(section), person["measures"]["waist_girth_m"], delta=5e-4)
        self.assertLess(abs(np.ptp(points[:, 1]) - person["measures"]["stature_m"]), 0.01)


if __name__ == "__main__":
    unittest.main()
