"""A character in motion: its skin and its true joints, in metres, Y up, the feet on the floor."""

import numpy as np

from glb import BadFile

# Bones by the names of Mixamo, which many makers share.
SIDES = ("Left", "Right")
NEEDED = ["Hips", "Neck", "Head"] + [
    side + bone for side in SIDES for bone in ("Arm", "ForeArm", "Hand", "UpLeg", "Leg", "Foot")
]
PAIRED = {"SHOULDER": "Arm", "ELBOW": "ForeArm", "HIP": "UpLeg", "KNEE": "Leg", "FOOT": "Foot"}
JOINTS = ["HEAD", "NECK", "TORSO"] + [
    f"{side}_{joint}"
    for joint in ("SHOULDER", "ELBOW", "HAND", "HIP", "KNEE", "FOOT")
    for side in ("LEFT", "RIGHT")
]
TORSO_SHARE = 0.72  # of the way from the neck to the hips: where vfit's TORSO is, and the bone Spine
PALM_M = 0.07  # from the wrist to vfit's HAND
ANKLE = 0.045  # its height, of the stature


class Character:
    """Skin and bones of a file. Each part of the skin that a joint matrix moves is one influence."""

    def __init__(self, glb):
        self.glb = glb
        missing = [bone for bone in NEEDED if bone not in glb.names]
        if missing:
            raise BadFile(f"{glb.path}: has no bone {missing[0]}; bones are to have Mixamo's names")
        self.has_skin = "skins" in glb.json
        self.node_of = {name: i for i, name in reversed(list(enumerate(glb.names)))}
        self._read_skin()
        self._find_crown()

    def _read_skin(self):
        nodes, bind, points, faces, which, weights = [], [], [], [], [], []
        count = 0
        for node, primitive in self.glb.primitives():
            at = primitive["attributes"]
            position = self.glb.accessor(at["POSITION"]).astype(float)
            if "indices" in primitive:
                index = self.glb.accessor(primitive["indices"])[:, 0].astype(np.int64)
            else:
                index = np.arange(len(position))
            skin = self.glb.json["nodes"][node].get("skin")
            first = len(nodes)
            if skin is None:  # rigid, moved by its node
                nodes.append(node)
                bind.append(np.eye(4)[None])
                joints = np.full((len(position), 1), first)
                weight = np.ones((len(position), 1))
            else:
                s = self.glb.json["skins"][skin]
                nodes.extend(s["joints"])
                inverse = self.glb.accessor(s["inverseBindMatrices"]).astype(float)
                bind.append(inverse.reshape(-1, 4, 4).transpose(0, 2, 1))
                joints = self.glb.accessor(at["JOINTS_0"]).astype(np.int64) + first
                weight = self.glb.accessor(at["WEIGHTS_0"]).astype(float)
            points.append(position)
            faces.append(index[: len(index) // 3 * 3].reshape(-1, 3) + count)
            which.append(np.pad(joints, ((0, 0), (0, 4 - joints.shape[1]))))
            weights.append(np.pad(weight, ((0, 0), (0, 4 - weight.shape[1]))))
            count += len(position)
        if not count:
            raise BadFile(f"{self.glb.path}: has no triangles")
        self.nodes, self.bind = np.array(nodes), np.concatenate(bind)
        self.points, self.faces = np.concatenate(points), np.concatenate(faces)
        self.which, self.weights = np.concatenate(which), np.concatenate(weights)
        self.weights /= np.maximum(self.weights.sum(1, keepdims=True), 1e-9)

    def _find_crown(self):
        """The crown in the frame of the bone Head: of HeadTop_End, or of the skin that the head moves."""
        g = self.glb
        world = g.world_matrices(g.translation, g.rotation, g.scale)
        head = self.node_of["Head"]
        if "HeadTop_End" in self.node_of:
            top = world[self.node_of["HeadTop_End"], :3, 3]
        else:
            of_head = np.isin(self.nodes, [head])[self.which] * self.weights
            skin = self.skin(world)[of_head.sum(1) > 0.5]
            if not len(skin):
                raise BadFile(f"{g.path}: no skin moves with the bone Head")
            up = world[head, :3, 3] - world[self.node_of["Neck"], :3, 3]
            along = (skin - world[head, :3, 3]) @ (up / np.linalg.norm(up))
            top = world[head, :3, 3] + up / np.linalg.norm(up) * along.max()
        self.crown = (np.linalg.inv(world[head]) @ np.append(top, 1.0))[:3]

    def skin(self, world):
        """Points of the skin (n, 3) with the bones at these world matrices (nodes, 4, 4)."""
        moved = (world[self.nodes] @ self.bind)[:, :3].reshape(-1, 12)
        blended = np.einsum("nk,nkm->nm", self.weights, moved[self.which]).reshape(-1, 3, 4)
        return np.einsum("nij,nj->ni", blended[:, :, :3], self.points) + blended[:, :, 3]

    def bone(self, world, name):
        return world[..., self.node_of[name], :3, 3]

    def crown_at(self, world):
        head = world[..., self.node_of["Head"], :, :]
        return head[..., :3, :3] @ self.crown + head[..., :3, 3]

    def joints(self, world, metre=1.0):
        """vfit's joints by name (..., 3), where the bones are; `metre` is one in the file's units."""
        out = {"NECK": self.bone(world, "Neck")}
        out["HEAD"] = 0.5 * (self.bone(world, "Head") + self.crown_at(world))
        hips = 0.5 * (self.bone(world, "LeftUpLeg") + self.bone(world, "RightUpLeg"))
        lumbar = out["NECK"] + TORSO_SHARE * (hips - out["NECK"])
        out["TORSO"] = self.bone(world, "Spine") if "Spine" in self.node_of else lumbar
        for side in SIDES:
            for joint, bone in PAIRED.items():
                out[f"{side.upper()}_{joint}"] = self.bone(world, side + bone)
            wrist = self.bone(world, side + "Hand")
            if side + "HandMiddle1" in self.node_of:
                along = self.bone(world, side + "HandMiddle1") - wrist
            else:
                along = wrist - self.bone(world, side + "ForeArm")
            length = np.linalg.norm(along, axis=-1, keepdims=True)
            out[side.upper() + "_HAND"] = wrist + PALM_M * metre * along / np.maximum(length, 1e-9)
        return out

    def stature(self, world):
        """In the file's units: the bones from a foot to the crown, straightened, over the ankle's height."""
        hips = 0.5 * (self.bone(world, "LeftUpLeg") + self.bone(world, "RightUpLeg"))
        chain = [hips, self.bone(world, "Neck"), self.crown_at(world)]
        length = sum(np.linalg.norm(b - a, axis=-1) for a, b in zip(chain, chain[1:]))
        for a, b in (("UpLeg", "Leg"), ("Leg", "Foot")):
            for side in SIDES:
                length = length + 0.5 * np.linalg.norm(
                    self.bone(world, side + b) - self.bone(world, side + a), axis=-1
                )
        return float(np.median(length)) / (1 - ANKLE)
