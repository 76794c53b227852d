"""The judge on characters of other makers reads, moves, draws and scores a figure whose answers are known."""

import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "judge_characters"
sys.path.insert(0, str(TOOL))

from character import JOINTS, Character  # noqa: E402
from glb import BadFile, Glb, quaternion_of, matrix_of  # noqa: E402
from motion import Actor, carried_motion, own_motions, still  # noqa: E402
from recording import Recording  # noqa: E402
from renderer import Camera, rasterise, room_depth, see, sense  # noqa: E402
from score import MIRRORED, Tracked, fit_offsets, summary  # noqa: E402

VFIT = Path(os.environ.get("VFIT_BUILD_DIR", ROOT / "build")) / "bin" / "vfit"

# Places of the bones of a figure of 1.8 m in the T-pose, facing +Z.
BONES = {
    "Hips": (None, (0, 1.0, 0)),
    "Neck": ("Hips", (0, 1.5, 0)),
    "Head": ("Neck", (0, 1.6, 0)),
    "HeadTop_End": ("Head", (0, 1.8, 0)),
}
for side, x in (("Left", 1), ("Right", -1)):
    BONES[side + "Arm"] = ("Neck", (0.2 * x, 1.45, 0))
    BONES[side + "ForeArm"] = (side + "Arm", (0.5 * x, 1.45, 0))
    BONES[side + "Hand"] = (side + "ForeArm", (0.75 * x, 1.45, 0))
    BONES[side + "UpLeg"] = ("Hips", (0.1 * x, 0.95, 0))
    BONES[side + "Leg"] = (side + "UpLeg", (0.1 * x, 0.5, 0))
    BONES[side + "Foot"] = (side + "Leg", (0.1 * x, 0.08, 0))
NAMES = list(BONES)
BOX = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
BOX_FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)]
BOX_FACES += [(2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


class Writer:
    """Collects accessors of a binary glTF."""

    def __init__(self):
        self.binary, self.views, self.accessors = b"", [], []

    def add(self, values, kind, width, normalized=False, gap=0):
        """Values (count, n) with `gap` bytes between two."""
        values = np.asarray(values).reshape(len(values), -1).astype(kind)
        rows = b"".join(row.tobytes() + b"\xee" * gap for row in values)
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(rows)}
        if gap:
            view["byteStride"] = len(rows) // len(values)
        self.views.append(view)
        self.binary += rows
        codes = {"u1": 5121, "<u2": 5123, "<f4": 5126}
        self.accessors.append(
            {"bufferView": len(self.views) - 1, "componentType": codes[kind], "count": len(values)}
        )
        self.accessors[-1].update({"type": width, **({"normalized": True} if normalized else {})})
        return len(self.accessors) - 1

    def file(self, parts):
        self.binary += b"\0" * (-len(self.binary) % 4)
        text = dict(parts, asset={"version": "2.0"}, bufferViews=self.views, accessors=self.accessors)
        text = json.dumps(dict(text, buffers=[{"byteLength": len(self.binary)}])).encode()
        text += b" " * (-len(text) % 4)
        size = 28 + len(text) + len(self.binary)
        head = struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON")
        return head + text + struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary


def nodes_of(prefix, size):
    nodes = []
    for name, (parent, place) in BONES.items():
        start = BONES[parent][1] if parent else (0, 0, 0)
        own = [size * (a - b) for a, b in zip(place, start)]
        children = [i for i, other in enumerate(NAMES) if BONES[other][0] == name]
        nodes.append(
            {"name": prefix + name, "translation": own, **({"children": children} if children else {})}
        )
    return nodes


def arm_lowered(writer, hips_drop):
    """An animation that lowers the left arm by 90 degrees, and the hips, within a second."""
    keys = writer.add([0.0, 1.0], "<f4", "SCALAR")
    turns = [[0, 0, 0, 1], [0, 0, -np.sqrt(0.5), np.sqrt(0.5)]]
    turn = writer.add(turns, "<f4", "VEC4")
    hips = np.array(BONES["Hips"][1])
    drop = writer.add([hips, hips - [0, hips_drop, 0]], "<f4", "VEC3")
    paths = [(NAMES.index("LeftArm"), "rotation"), (NAMES.index("Hips"), "translation")]
    return {
        "name": "lower",
        "samplers": [{"input": keys, "output": turn}, {"input": keys, "output": drop}],
        "channels": [{"sampler": k, "target": {"node": n, "path": p}} for k, (n, p) in enumerate(paths)],
    }


def box_man(prefix="rig:", size=1.0, animated=False, without=None):
    """A figure of one box for each bone, skinned, as a file."""
    writer = Writer()
    points, faces, joints = [], [], []
    for i, (parent, place) in enumerate(BONES.values()):
        half = np.array([0.05, 0.05, 0.05]) if i else np.array([0.15, 0.3, 0.1])
        faces += [[a + 8 * i for a in face] for face in BOX_FACES]
        points += list(size * (BOX * half + place))
        joints += [[i, 0, 0, 0]] * 8
    inverse = np.repeat(np.eye(4)[None], len(NAMES), 0)
    inverse[:, :3, 3] = [[-size * x for x in place] for _, place in BONES.values()]
    attributes = {
        "POSITION": writer.add(points, "<f4", "VEC3", gap=4),
        "JOINTS_0": writer.add(joints, "u1", "VEC4"),
        "WEIGHTS_0": writer.add([[255, 0, 0, 0]] * len(joints), "u1", "VEC4", normalized=True),
    }
    indices = writer.add(np.array(faces).reshape(-1, 1), "<u2", "SCALAR")
    skin = {"joints": list(range(len(NAMES)))}
    skin["inverseBindMatrices"] = writer.add(inverse.transpose(0, 2, 1), "<f4", "MAT4")
    nodes = nodes_of(prefix, size) + [{"name": "skin", "mesh": 0, "skin": 0}]
    if without:
        nodes[NAMES.index(without)]["name"] = "other"
    parts = {"nodes": nodes, "meshes": [{"primitives": [{"attributes": attributes, "indices": indices}]}]}
    parts["skins"] = [skin]
    if animated:
        parts["animations"] = [arm_lowered(writer, 0.1)]
    return writer.file(parts)


def clip():
    writer = Writer()
    return writer.file({"nodes": nodes_of("", 1.0), "animations": [arm_lowered(writer, 0.1)]})


def straight_frames(count):
    """True joints (count, joints, 3) of the figure 3 m before a camera at 1 m."""
    character = Character(Glb("man", box_man()))
    joints = Actor(still(character), np.zeros(1), 1.8, 1.0).joints(0)
    camera = Camera(64, 48, 50.0, 1.0, 0.0)
    one = np.array([camera.to_camera(joints[name] + [0, 0, -3]) for name in JOINTS])
    return np.repeat(one[None], count, 0)


def tracked(truth, found):
    out = Tracked.__new__(Tracked)
    out.truth, out.found, out.kind, out.character = truth, found, "turn", "man"
    out.labels = ["turn"] * len(truth)
    return out


class Reader(unittest.TestCase):
    def test_strided_and_normalised_accessors_are_read(self):
        glb = Glb("man", box_man())
        character = Character(glb)
        self.assertAlmostEqual(character.points[:, 1].max(), 1.85, 6)
        self.assertTrue(np.all(character.weights[:, 0] == 1.0))
        np.testing.assert_allclose(
            character.skin(still(character).world([0])[0]), character.points, atol=1e-6
        )

    def test_a_cut_file_and_a_missing_bone_are_named(self):
        with self.assertRaisesRegex(BadFile, "man: is no readable"):
            Glb("man", box_man()[:100])
        with self.assertRaisesRegex(BadFile, "man: has no bone LeftHand"):
            Character(Glb("man", box_man(without="LeftHand")))

    def test_quaternions_of_matrices_are_those_they_were_made_of(self):
        for own in ([0.5, 0.5, -0.5, 0.5], [1, 0, 0, 0], [0, 0.6, 0, 0.8], [0, 0, 0.8, -0.6], [0, 1, 0, 0.1]):
            own = np.array(own) / np.linalg.norm(own)
            back = quaternion_of(matrix_of(np.zeros(3), own, np.ones(3))[:3, :3])
            self.assertAlmostEqual(abs(float(own @ back)), 1.0, 6)


class Motions(unittest.TestCase):
    def test_an_animation_moves_skin_and_joints(self):
        character = Character(Glb("man", box_man(animated=True)))
        motion = own_motions(character)[0]
        world = motion.world([0.0, 0.999999])
        joints = character.joints(world)
        np.testing.assert_allclose(joints["LEFT_ELBOW"][0], [0.5, 1.45, 0], atol=1e-4)
        np.testing.assert_allclose(joints["LEFT_ELBOW"][1], [0.2, 1.05, 0], atol=1e-4)
        np.testing.assert_allclose(joints["LEFT_HAND"][1], [0.2, 1.35 - 0.55 - 0.07, 0], atol=1e-4)
        np.testing.assert_allclose(joints["HEAD"][0], [0, 1.7, 0], atol=1e-6)
        hand = character.skin(world[1])[8 * NAMES.index("LeftHand") :][:8]
        np.testing.assert_allclose(hand.mean(0), [0.2, 0.8, 0], atol=1e-4)

    def test_a_clip_is_carried_over_to_a_figure_of_another_size(self):
        character = Character(Glb("man", box_man(size=2.0)))
        rest, moves = Glb("rest", box_man()), Glb("clip", clip())
        joints = character.joints(carried_motion("lower", character, moves, rest).world([0.999999]))
        np.testing.assert_allclose(joints["LEFT_ELBOW"][0], [0.4, 2.1, 0], atol=1e-4)
        np.testing.assert_allclose(joints["RIGHT_ELBOW"][0], [-1.0, 2.7, 0], atol=1e-4)

    def test_people_stand_on_the_floor_with_their_stature_and_girth(self):
        character = Character(Glb("man", box_man(size=3.0)))
        actor = Actor(still(character), np.zeros(2), 1.5, 1.2)
        skin = actor.skin(0)
        self.assertAlmostEqual(skin[:, 1].min(), 0.0, 6)
        joints = actor.joints(0)
        tall, wide = (
            joints["NECK"][1] - joints["LEFT_KNEE"][1],
            joints["LEFT_HIP"][0] - joints["RIGHT_HIP"][0],
        )
        # From ankle to crown the bones are 1.72 m long, which is 95.5 % of a stature; from knee to neck 1 m.
        self.assertAlmostEqual(tall, 1.5 * 0.955 / 1.72, 6)
        self.assertAlmostEqual(wide / tall, 1.2 * 0.2 / 1.0, 6)
        self.assertGreater(joints["LEFT_HIP"][0], 0.0)


class Pictures(unittest.TestCase):
    def test_depth_is_that_of_the_plane_on_each_ray(self):
        camera = Camera(64, 48, 50.0, 0.0, 0.0)
        points = np.array([[-8.0, -8.0, 2.0], [8.0, -8.0, 6.0], [0.0, 9.0, 4.0]])
        normal = np.cross(points[1] - points[0], points[2] - points[0])
        depth = 1.0 / rasterise(points, np.array([[0, 1, 2]]), camera)
        for u, v in ((32, 24), (20, 10), (50, 30)):
            ray = np.array([(u - camera.cx) / 50, (v - camera.cy) / 50, 1.0])
            self.assertAlmostEqual(depth[v, u], normal @ points[0] / (normal @ ray), 6)

    def test_the_nearer_triangle_hides_the_other_in_any_order(self):
        camera = Camera(64, 48, 50.0, 0.0, 0.0)
        front = np.array([[-3.0, -3, 2], [3, -3, 2], [0, 4, 2]])
        points = np.concatenate([front, front + [0, 0, 1]])
        for faces in ([[0, 1, 2], [3, 4, 5]], [[3, 4, 5], [0, 2, 1]]):
            self.assertAlmostEqual(1.0 / rasterise(points, np.array(faces), camera)[24, 32], 2.0, 6)

    def test_the_camera_sees_floor_and_person_where_they_are(self):
        camera = Camera(64, 48, 50.0, 1.2, 15.0, 3.0)
        ahead = np.array([0, 1.2 - 3 * np.sin(np.radians(15)), -3 * np.cos(np.radians(15))])
        np.testing.assert_allclose(camera.to_camera(ahead), [0, 0, 3], atol=1e-9)
        room = room_depth(camera, 50.0, 50.0)
        floor = room[-1, 32] * camera.rays()[-1, 32] + [0, 1.2, 0]
        self.assertAlmostEqual(floor[1], 0.0, 6)
        self.assertGreater(camera.to_camera(np.array([0.5, 1.0, -3.0]))[0], 0.4)  # +X is on the right

    def test_noise_grows_with_the_distance_and_edges_have_holes(self):
        rng = np.random.default_rng(1)
        flat = [sense(np.full((100, 100), z), 366.0, rng).astype(float) for z in (1.0, 3.0)]
        sigma = [np.std(image[image > 0]) for image in flat]
        self.assertAlmostEqual(sigma[0], 1.5, delta=0.15)
        self.assertAlmostEqual(sigma[1], 9.5, delta=0.95)
        image = np.full((100, 100), 3.0)
        image[:, 50:] = 2.0
        seen = sense(image, 366.0, rng)
        self.assertGreater((seen[:, 49:51] == 0).mean(), 0.2)
        self.assertGreater(((seen[:, 49:51] > 2100) & (seen[:, 49:51] < 2900)).mean(), 0.1)


class Scores(unittest.TestCase):
    def test_exchanged_sides_are_wrong_and_flips_are_counted_once(self):
        truth = straight_frames(10)
        found = truth.copy()
        found[3:5] = found[3:5, MIRRORED]
        found[7:9] = found[7:9, MIRRORED]
        found[9] = np.nan
        f = summary([tracked(truth, found)], lambda r: np.ones(10, bool))
        self.assertEqual((f["frames"], f["missed"], f["wrong"], f["flips"]), (10, 1, 4, 2))
        # In a wrong frame the three joints without a side are right, and the hips, 0.2 m apart, are not.
        self.assertAlmostEqual(f["map"], (5 * 15 + 4 * 3) / 150)

    def test_offsets_carry_one_definition_to_the_other_at_any_heading(self):
        truth = straight_frames(8)
        middle = truth.mean((0, 1))
        for i, yaw in enumerate(np.arange(8) * np.pi / 4):
            c, s = np.cos(yaw), np.sin(yaw)
            truth[i] = (truth[i] - middle) @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]).T + middle
        found = truth.copy()
        across = truth[:, 3] - truth[:, 4]
        found[:, 11] += 0.2 * across / np.linalg.norm(across, axis=-1, keepdims=True)
        whole = tracked(truth, found)
        self.assertFalse(whole.within()[:, 11].any())
        self.assertTrue(whole.within(fit_offsets([whole])).all())

    def test_side_views_are_those_from_a_side(self):
        truth = straight_frames(2)
        truth[1] = truth[1][:, [2, 1, 0]]  # turned by a quarter
        np.testing.assert_array_equal(tracked(truth, truth).from_the_side(), [False, True])


@unittest.skipUnless(VFIT.exists(), f"{VFIT} is not built")
class Program(unittest.TestCase):
    def test_vfit_reads_the_recording_and_its_true_joints(self):
        with tempfile.TemporaryDirectory() as folder:
            camera = Camera(128, 96, 90.0, 1.0, 0.0)
            character = Character(Glb("man", box_man()))
            actor = Actor(still(character), np.zeros(1), 1.8, 1.0)
            recording = Recording(Path(folder) / "rec", camera, ["turn"])
            room = room_depth(camera, 4.0, 2.0)
            depth = see(actor.skin(0) + [0, 0, -3], character.faces, camera, room)
            joints = {n: camera.to_camera(p + [0, 0, -3]) for n, p in actor.joints(0).items()}
            recording.add(sense(depth, camera.focal, np.random.default_rng(1)), joints)
            recording.close()
            command = [VFIT, "track", str(Path(folder) / "rec"), "--json", "--joints", "recorded"]
            done = subprocess.run(command, capture_output=True, text=True, check=True)
            read = json.loads(done.stdout.splitlines()[0])["bodies"][0]["joints"]
            for name in JOINTS:
                np.testing.assert_allclose(read[name][:3], joints[name], atol=1e-3)

    def test_the_command_prints_its_figures(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "man.glb").write_bytes(box_man())
            figures = Path(folder) / "figures.json"
            command = [sys.executable, TOOL, folder, "--work", f"{folder}/work", "--people", "1"]
            command += ["--only", "cuts", "--vfit", VFIT, "--json", figures]
            subprocess.run(command, check=True, capture_output=True)
            rows = {row["what"]: row for row in json.loads(figures.read_text())}
            self.assertEqual(rows["all views"]["frames"], 150)
            self.assertEqual(rows["cuts, the side views"]["frames"], 60)

    def test_an_empty_folder_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, TOOL, folder, "--work", f"{folder}/work"]
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("holds no .glb", done.stderr)


if __name__ == "__main__":
    unittest.main()
