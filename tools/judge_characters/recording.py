"""Writes frames as a recording of vfit (docs/recording.md), with the true joints in joints.csv."""

import json
import struct
import zlib

from character import JOINTS

FPS = 30


def png16(image):
    """A grey image of 16 bits as PNG."""
    height, width = image.shape
    rows = b"".join(b"\0" + row.tobytes() for row in image.astype(">u2"))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(rows, 1))
        + chunk(b"IEND", b"")
    )


class Recording:
    """A folder that becomes a complete recording with close()."""

    def __init__(self, folder, camera, labels):
        """`labels`: one text a frame, kept for the score."""
        self.folder, self.labels, self.rows = folder, labels, []
        (folder / "depth").mkdir(parents=True, exist_ok=True)
        self.camera = {
            "format": "vfit-recording",
            "version": 1,
            "sensor": "characters",
            "width": camera.width,
            "height": camera.height,
            "fx": camera.focal,
            "fy": camera.focal,
            "cx": camera.cx,
            "cy": camera.cy,
            "fps": FPS,
            "depth_unit_m": 0.001,
        }

    def add(self, depth, joints):
        """Depth in millimetres and joints by name in camera space."""
        frame = len(self.rows)
        (self.folder / "depth" / f"{frame:06}.png").write_bytes(png16(depth))
        places = [f"{x:.4f}" for name in JOINTS for x in joints[name]]
        self.rows.append(",".join([str(frame)] + places) + "\n")

    def close(self):
        names = ",".join(f"{name}_{axis}" for name in JOINTS for axis in "xyz")
        (self.folder / "joints.csv").write_text(f"frame,{names}\n" + "".join(self.rows))
        (self.folder / "labels.json").write_text(json.dumps(self.labels))
        (self.folder / "camera.json").write_text(json.dumps(self.camera, indent=1) + "\n")
