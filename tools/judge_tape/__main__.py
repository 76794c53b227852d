"""Judges vfit's tape by another one, of the Python package clad-body, on the same meshes.

    build/venv/bin/pip install trimesh scipy networkx shapely
    build/venv/bin/pip install --no-deps --ignore-requires-python clad-body
    build/venv/bin/python tools/judge_tape --people 20

The meshes are generated people (vfit-bench population --meshes) in the stance of vfit's girths. "at vfit's
level": the other tape lies where vfit's definition puts it. Else it finds its own place. docs/measuring.md
says what the differences come from.
"""

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

try:
    import trimesh
    from clad_body.measure import _circumferences as tape
    from clad_body.measure._lengths import measure_inseam
    from clad_body.measure._slicer import MeshSlicer
except ImportError as error:
    raise SystemExit(f"judge_tape: {error}: install what `python tools/judge_tape/__main__.py` begins with")

# Of the way from the hip joints to the foot of the neck: sdk/anthropometry/tape_trunk.cpp.
WAIST, NAVEL = {"f": 0.328, "m": 0.308}, {"f": 0.245, "m": 0.252}
RIB_ARCH = 0.2  # of the way from the waist to the neck
HIGHEST_BUST = 0.75  # of the way from the hip joints to the neck
WIDEST_TRUNK_M = 0.9
STEP_M = 0.002


class Body:
    """A mesh as the other tape takes it: Z up, its front at -Y."""

    def __init__(self, path, sex):
        vertices, faces, group, self.joints = [], {"body": [], "arms": []}, "body", {}
        for line in path.read_text().splitlines():
            word, *rest = line.split()
            if word == "v":
                x, y, z = map(float, rest)
                vertices.append((x, -z, y))
            elif word == "f":
                faces[group].append([int(i) - 1 for i in rest])
            elif word == "g":
                group = rest[0]
            elif rest[:1] == ["joint"]:
                self.joints[rest[1]] = np.array([float(rest[2]), -float(rest[4]), float(rest[3])])
        vertices = np.array(vertices)
        self.floor = vertices[:, 2].min()
        vertices[:, 2] -= self.floor
        for joint in self.joints.values():
            joint[2] -= self.floor
        self.sex, self.height = sex, float(vertices[:, 2].max())
        self.mesh = self._mesh(vertices, faces["body"] + faces["arms"])
        self.trunk = self._mesh(vertices, faces["body"])
        self.hips = 0.5 * (self.joints["LEFT_HIP"] + self.joints["RIGHT_HIP"])[2]

    @staticmethod
    def _mesh(vertices, faces):
        mesh = trimesh.Trimesh(vertices, np.array(faces), process=False)
        mesh.merge_vertices(merge_tex=True, merge_norm=True)
        return mesh

    def at(self, fraction):
        """Of the way from the hip joints to the foot of the neck."""
        return self.hips + fraction * (self.joints["NECK"][2] - self.hips)

    def bust(self):
        """Where the front stands out most on either side."""
        p = self.trunk.vertices
        arch = WAIST[self.sex] + RIB_ARCH * (1 - WAIST[self.sex])
        chest = p[(p[:, 2] > self.at(arch)) & (p[:, 2] < self.at(HIGHEST_BUST))]
        sides = chest[chest[:, 0] > 0], chest[chest[:, 0] < 0]
        return float(np.mean([side[np.argmin(side[:, 1]), 2] for side in sides]))


def other_tape(body):
    """Measures of clad-body, metres, by vfit's keys."""
    slicer = MeshSlicer(body.trunk)

    def girth(level):
        return slicer.circumference_at_z(level, max_x_extent=WIDEST_TRUNK_M, combine_fragments=True)

    waist = body.at(WAIST[body.sex])
    narrow = np.arange(body.at(NAVEL[body.sex]), waist + RIB_ARCH * (body.joints["NECK"][2] - waist), STEP_M)
    _, crotch, _ = measure_inseam(body.mesh, body.height)
    hips = np.arange(crotch + STEP_M, 0.5 * (body.hips + waist), STEP_M)
    legs = MeshSlicer(body.mesh)

    def thigh(level):
        """Of both legs, level; what is smaller than a leg is a hand."""
        loops = sorted((loop[0] for loop in legs.limb_contours_at_z(level)), reverse=True)[:2]
        return 0.5 * sum(loops) if len(loops) == 2 else 0.0

    out = {
        "waist_girth_m at vfit's level": girth(waist),
        "waist_navel_girth_m at vfit's level": girth(body.at(NAVEL[body.sex])),
        "waist_minimum_girth_m between vfit's levels": min(map(girth, narrow)),
        "hip_girth_m between vfit's levels": max(map(girth, hips)),
        "hip_girth_m": 0.01 * tape.torso_sweep_bust_hips(body.mesh, body.trunk, waist, body.height)[2],
        "thigh_girth_m up to 43 % of stature": 0.01 * tape.measure_thigh(body.mesh, body.height)[0],
        "thigh_girth_m up to the crotch": max(map(thigh, np.arange(crotch - 0.1, crotch, STEP_M))),
        "upper_arm_girth_m": 0.01 * tape.measure_upperarm(body.mesh, body.height)[0],
        "inside_leg_m": crotch,
    }
    if body.sex == "f":
        out["chest_girth_m at the foremost points"] = girth(body.bust())
    return {key: value for key, value in out.items() if value > 0}


def main():
    parser = argparse.ArgumentParser(
        prog="judge_tape", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--people", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--bench", default="build/bin/vfit-bench", help="the program (build/bin/vfit-bench)")
    options = parser.parse_args()
    differences = {}
    with tempfile.TemporaryDirectory() as folder:
        command = [options.bench, "population", "--space", "varied", "--json", "--meshes", folder]
        command += ["--count", str(options.people), "--seed", str(options.seed)]
        drawn = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        for person in drawn["people"]:
            body = Body(Path(folder) / f"{person['number']}.obj", person["sex"])
            for key, value in other_tape(body).items():
                own = person["measures"][key.split()[0]]
                differences.setdefault(key, []).append(1000 * (own - value))
    print(f"vfit's tape less clad-body's, {options.people} generated people, mm: mean, deviation, largest")
    for key, values in differences.items():
        d = np.array(values)
        print(f"  {key:46}{len(d):4}{d.mean():8.1f}{d.std():7.1f}{np.abs(d).max():7.1f}")


if __name__ == "__main__":
    main()
