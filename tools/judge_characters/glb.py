"""Reads binary glTF 2.0: nodes, meshes, skins and animations."""

import json
import struct

import numpy as np

COMPONENTS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
TRIANGLES = 4


class BadFile(Exception):
    """The file is no glTF that can be read; the text names the file and the fault."""


def matrix_of(translation, rotation, scale):
    """Affine matrices (..., 4, 4) from translations, quaternions x y z w and scales."""
    x, y, z, w = np.moveaxis(np.asarray(rotation, float), -1, 0)
    turn = np.stack(
        [
            np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], -1),
            np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], -1),
            np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], -1),
        ],
        -2,
    )
    out = np.zeros(turn.shape[:-2] + (4, 4))
    out[..., :3, :3] = turn * np.asarray(scale, float)[..., None, :]
    out[..., :3, 3] = translation
    out[..., 3, 3] = 1
    return out


def parts_of(matrix):
    """Translation, quaternion x y z w and scale of an affine matrix without shear."""
    scale = np.linalg.norm(matrix[:3, :3], axis=0)
    return matrix[:3, 3], quaternion_of(matrix[:3, :3] / scale), scale


def quaternion_of(turn):
    """The quaternion of one rotation matrix (Shepperd 1978: the largest component first)."""
    xx, yy, zz = np.diag(turn)
    squares = np.array([1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz, 1 + xx + yy + zz])
    k = int(np.argmax(squares))
    antisymmetric = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    out = np.empty(4)
    if k == 3:
        out[:3], out[3] = antisymmetric, squares[3]
    else:
        out[:3] = turn[k] + turn[:, k]
        out[k], out[3] = squares[k], antisymmetric[k]
    return out / np.linalg.norm(out)


class Glb:
    """One file. Nodes keep the order of the file; `parent` is -1 for a root."""

    def __init__(self, path, data):
        self.path = path
        try:
            self._split(data)
            self._read_nodes()
        except (KeyError, IndexError, TypeError, ValueError, struct.error) as error:
            raise BadFile(f"{path}: is no readable binary glTF: {error!r}") from error

    def _split(self, data):
        magic, version, _ = struct.unpack_from("<4sII", data)
        if magic != b"glTF" or version != 2:
            raise ValueError("does not start with the header of binary glTF 2")
        size = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20 : 20 + size])
        self.binary = data[20 + size + 8 :]

    def _read_nodes(self):
        nodes = self.json["nodes"]
        self.names = [node.get("name", "").split(":")[-1] for node in nodes]
        self.parent = [-1] * len(nodes)
        for i, node in enumerate(nodes):
            for child in node.get("children", []):
                self.parent[child] = i
        self.translation, self.rotation, self.scale = (np.zeros((len(nodes), n)) for n in (3, 4, 3))
        for i, node in enumerate(nodes):
            if "matrix" in node:
                parts = parts_of(np.array(node["matrix"], float).reshape(4, 4).T)
            else:
                parts = (
                    node.get("translation", [0, 0, 0]),
                    node.get("rotation", [0, 0, 0, 1]),
                    node.get("scale", [1, 1, 1]),
                )
            self.translation[i], self.rotation[i], self.scale[i] = parts
        self.order = self._parents_first()

    def _parents_first(self):
        order, seen = [], set()
        for i in range(len(self.parent)):
            chain = []
            while i >= 0 and i not in seen:
                seen.add(i)
                chain.append(i)
                i = self.parent[i]
            order.extend(reversed(chain))
        return order

    def accessor(self, index):
        """Values as an array (count, width); normalised integers as fractions."""
        a = self.json["accessors"][index]
        if "sparse" in a or "bufferView" not in a:
            raise BadFile(f"{self.path}: accessor {index} is sparse or empty, which is not read")
        view = self.json["bufferViews"][a["bufferView"]]
        kind, width = np.dtype(COMPONENTS[a["componentType"]]), WIDTHS[a["type"]]
        start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        stride = view.get("byteStride") or kind.itemsize * width
        values = np.ndarray((a["count"], width), kind, self.binary, start, strides=(stride, kind.itemsize))
        if not a.get("normalized"):
            return values
        return np.maximum(values / np.iinfo(kind).max, -1.0)

    def world_matrices(self, translation, rotation, scale):
        """World matrices (..., nodes, 4, 4) of local parts (..., nodes, n)."""
        local = matrix_of(translation, rotation, scale)
        world = np.empty_like(local)
        for i in self.order:
            p = self.parent[i]
            world[..., i, :, :] = local[..., i, :, :] if p < 0 else world[..., p, :, :] @ local[..., i, :, :]
        return world

    def primitives(self):
        """(node, primitive) of each list of triangles in the scene."""
        for i, node in enumerate(self.json["nodes"]):
            if "mesh" in node:
                for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                    if primitive.get("mode", TRIANGLES) == TRIANGLES:
                        yield i, primitive

    def animations(self):
        return [a.get("name", f"animation {i}") for i, a in enumerate(self.json.get("animations", []))]

    def duration_s(self, animation):
        samplers = self.json["animations"][animation]["samplers"]
        return max((float(self.accessor(s["input"])[-1, 0]) for s in samplers), default=0.0)

    def sample(self, animation, times_s):
        """Local translations, rotations and scales (times, nodes, n) at these times."""
        count = len(times_s)
        parts = {
            "translation": np.repeat(self.translation[None], count, 0),
            "rotation": np.repeat(self.rotation[None], count, 0),
            "scale": np.repeat(self.scale[None], count, 0),
        }
        a = self.json["animations"][animation]
        for channel in a["channels"]:
            target = channel["target"]
            if "node" not in target or target["path"] not in parts:
                continue  # weights of morph targets
            sampler = a["samplers"][channel["sampler"]]
            keys = self.accessor(sampler["input"])[:, 0].astype(float)
            values = self.accessor(sampler["output"]).astype(float)
            way = sampler.get("interpolation", "LINEAR")
            if way == "CUBICSPLINE":
                values = values.reshape(len(keys), 3, -1)[:, 1]  # keys alone, without their tangents
            parts[target["path"]][:, target["node"]] = _between(keys, values, times_s, way == "STEP")
        parts["rotation"] /= np.linalg.norm(parts["rotation"], axis=-1, keepdims=True)
        return parts["translation"], parts["rotation"], parts["scale"]


def _between(keys, values, times_s, step):
    first = np.clip(np.searchsorted(keys, times_s, "right") - 1, 0, len(keys) - 1)
    second = np.minimum(first + 1, len(keys) - 1)
    span = np.where(second > first, keys[second] - keys[first], 1.0)
    share = np.clip((times_s - keys[first]) / span, 0, 1)[:, None]
    if step:
        share = np.zeros_like(share)
    a, b = values[first], values[second]
    if values.shape[1] == 4:  # the shorter way round
        b = b * np.where(np.sum(a * b, -1, keepdims=True) < 0, -1, 1)
    return a + share * (b - a)


def read_glb(path):
    with open(path, "rb") as file:
        return Glb(str(path), file.read())
