"""Plain values that come out of vfit or go into it. Lengths in metres, times in nanoseconds where a name ends
in _ns, angles in radians, quaternions as x, y, z, w."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Iterator, Mapping, NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from ._vfit import (
    BONE_NAMES,
    Bone,
    DoubtKind,
    FloorState,
    Guidance,
    Joint,
    JointState,
    LogLevel,
    ResultCode,
    Sex,
)

__all__ = [
    "AvatarPart",
    "Body",
    "CalibratedMeasure",
    "Camera",
    "CharacterInfo",
    "ClothStats",
    "Collider",
    "ContextStats",
    "Crossing",
    "Doubt",
    "FitZone",
    "GarmentInfo",
    "GarmentPart",
    "Intrinsics",
    "JointPoint",
    "Joints",
    "LibraryInfo",
    "LogLine",
    "Measurement",
    "PluginInfo",
    "Pose",
    "RigBone",
    "Scale",
    "ScanState",
    "SensorInfo",
    "SensorMode",
    "SensorOption",
    "SensorStats",
    "ShapeValue",
    "Size",
    "SizeRow",
    "SizeZone",
    "StageTime",
    "WorldPlace",
]

Vector = Tuple[float, float, float]


class LibraryInfo(NamedTuple):
    version: str
    simd: str
    """Instruction set in use: "AVX2", "SSE4", "SCALAR", ..."""
    build: str


class PluginInfo(NamedTuple):
    name: str
    version: str
    schemes: str
    path: str


class ContextStats(NamedTuple):
    handle_count: int
    frame_count: int
    """Frames that the host holds."""
    worker_count: int
    frame_bytes: int


class StageTime(NamedTuple):
    calls: int
    last_ms: float
    mean_ms: float
    max_ms: float


class LogLine(NamedTuple):
    level: LogLevel
    message: str


class SensorInfo(NamedTuple):
    uri: str
    name: str
    plugin: str
    caps: int


class SensorMode(NamedTuple):
    name: str
    width: int
    height: int
    rate_hz: float


class SensorOption(NamedTuple):
    value: str
    text: str
    """What the option means."""


class SensorStats(NamedTuple):
    running: bool
    state: ResultCode
    received: int
    taken: int
    dropped: int
    latency_ns: int


class Intrinsics(NamedTuple):
    """Pinhole camera in pixels. Width and height 0: those of the image."""

    fx: float
    fy: float
    cx: float
    cy: float
    width: int = 0
    height: int = 0
    distortion: Tuple[float, ...] = ()

    def project(self, points: NDArray[np.float32]) -> NDArray[np.float32]:
        """Pixels (n, 2) of camera-space points (n, 3). Pixel centres lie at whole coordinates."""
        p = np.asarray(points, np.float32)
        focal, centre = np.array((self.fx, self.fy), np.float32), np.array((self.cx, self.cy), np.float32)
        return (p[..., :2] / p[..., 2:] * focal + centre).astype(np.float32)


class Camera(NamedTuple):
    """Where a camera stands. To give a floor: Camera.over(normal, distance_m)."""

    floor_state: FloorState = FloorState.DEFAULT
    depth_unit_m: float = 0.001
    height_m: float = 0.0
    tilt_rad: float = 0.0
    """Above 0 it looks down."""
    roll_rad: float = 0.0
    floor_normal: Vector = (0.0, 0.0, 0.0)
    floor_distance_m: float = 0.0
    world_from_camera: Optional[NDArray[np.float32]] = None
    """4 x 4, world = world_from_camera @ (x, y, z, 1)."""

    @classmethod
    def over(cls, normal: Vector, distance_m: float, depth_unit_m: float = 0.001) -> "Camera":
        """Of a known floor: normal . p + distance = 0 in camera space, the normal pointing up."""
        return cls(FloorState.GIVEN, depth_unit_m, floor_normal=normal, floor_distance_m=distance_m)

    def from_world(self, points: NDArray[np.float32]) -> NDArray[np.float32]:
        """World-space points (n, 3), such as Joints.positions, in camera space: x right, y down, z forward.
        World space is that of a context with the default axes."""
        if self.world_from_camera is None:
            raise ValueError("this camera is none of a frame: it has no world_from_camera")
        turn, shift = self.world_from_camera[:3, :3], self.world_from_camera[:3, 3]
        return ((np.asarray(points, np.float32) - shift) @ turn).astype(np.float32)


class JointPoint(NamedTuple):
    x: float
    y: float
    z: float
    confidence: float


class Joints(Mapping[str, JointPoint]):
    """Joints by name ("LEFT_ELBOW": (x, y, z, confidence)), and as arrays with one row a joint."""

    __slots__ = ("ids", "positions", "confidence", "states", "rotations", "_rows")

    def __init__(
        self,
        ids: NDArray[np.int32],
        positions: NDArray[np.float32],
        confidence: NDArray[np.float32],
        states: NDArray[np.int32],
        rotations: NDArray[np.float32],
    ) -> None:
        self.ids = ids
        self.positions = positions
        self.confidence = confidence
        self.states = states
        self.rotations = rotations
        """In world space relative to a T-pose that faces +Z; all zero: unknown."""
        self._rows = {Joint(int(joint)).name: row for row, joint in enumerate(ids)}

    def __getitem__(self, name: str) -> JointPoint:
        row = self._rows[name.name if isinstance(name, Joint) else name]
        x, y, z = self.positions[row].tolist()
        return JointPoint(x, y, z, float(self.confidence[row]))

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def state(self, name: str) -> JointState:
        """How the joint was found."""
        return JointState(int(self.states[self._rows[name]]))

    def __repr__(self) -> str:
        return f"Joints({dict(self)})"


class Body(NamedTuple):
    id: int
    time_ns: int
    partly_out_of_view: bool
    joints: Joints


class ScanState(NamedTuple):
    taken: bool
    """The frame counts; else guidance says why not."""
    complete: bool
    frames_taken: int
    frames_wanted: int
    guidance: Guidance
    correction_m: float
    """Mean absolute change of depth by the filter (Fig. 9)."""
    compute_ms: float
    side_frames_taken: int
    side_frames_wanted: int
    turn_seen: int
    """Of a turn, a bit for each way to face: bit i is i times 15 degrees to the person's left."""
    turn_wanted: int


class Measurement(NamedTuple):
    value: float
    sigma: float = 0.0
    """One standard deviation of value; 0: unknown."""
    observed: bool = True
    """False: inferred from other measures."""


class Collider(NamedTuple):
    """A sphere, or the tapered capsule of two spheres."""

    joint: Joint
    center: Vector
    radius: float
    joint_b: Optional[Joint]
    center_b: Optional[Vector]
    radius_b: float


class Scale(NamedTuple):
    x: float
    y: float
    sigma_x: float
    sigma_y: float
    width_m: float
    height_m: float


class Size(NamedTuple):
    label: str
    probability: float


class WorldPlace(NamedTuple):
    """Where another camera's world space lies in this one's."""

    position: Tuple[float, float, float]
    rotation: Tuple[float, float, float, float]
    """x, y, z, w."""
    rms: float
    """What is left between the points that told it."""


class CalibratedMeasure(NamedTuple):
    """What a tape of your own says of scans of the same people, by one measure."""

    people: int
    enough: bool
    """People; else nothing is changed."""
    offset: float
    """Of the tape from the scan, in the measure's unit."""
    widening: float
    """Of sigma."""


class Doubt(NamedTuple):
    """A measure that does not go with the others of its list."""

    key: str
    kind: DoubtKind
    value: float
    """As it was given."""
    suggested: float
    """What the slip makes of it; of UNLIKELY: as expected."""
    expected: float
    """By the others."""
    sigma: float
    """Of expected."""
    other_key: str
    """Of SWAPPED; else empty."""


class SizeRow(NamedTuple):
    garment_kind: str
    label: str
    measure_count: int


class SizeZone(NamedTuple):
    """How a size sits by one measure: the room beyond the body in the middle of the size's range, and
    probabilities."""

    key: str
    ease: float
    sigma: float
    tight: float
    regular: float
    loose: float


class ShapeValue(NamedTuple):
    value: float
    minimum: float
    maximum: float


class RigBone(NamedTuple):
    name: str
    parent: int
    """-1: root."""
    bone: Optional[Bone]
    rest_position: Vector
    rest_rotation: Tuple[float, float, float, float]
    """xyzw, of the bone's own axes."""
    node: Optional[int]
    """Of the character's file."""


class CharacterInfo(NamedTuple):
    kind: str
    """'body', 'gltf', 'vrm0' or 'vrm1'."""
    name: str
    stature_m: float
    vertex_count: int
    index_count: int
    bone_count: int
    from_file: np.ndarray
    """(4, 4), m[row, column]: the rest mesh is m times the file's world."""


class AvatarPart(NamedTuple):
    mesh: str
    material: str
    material_index: Optional[int]
    first_index: int
    index_count: int


class GarmentInfo(NamedTuple):
    name: str
    garment_kind: str
    fabric: str
    vertex_count: int
    simulated_count: int
    sizes: Tuple[str, ...]
    size_chart: str  # name of the chart that the sizes follow; empty: the file states none
    body_sex: Sex  # of the default body that it was made on


class GarmentPart(NamedTuple):
    """Triangles of one look."""

    material: str
    texture: str  #: path of a picture as the garment's author gave it, or empty
    color: Vector  #: linear RGB
    first_index: int
    index_count: int


class FitZone(NamedTuple):
    """How a garment sits at one girth of the trunk."""

    key: str
    fit: str  #: "right", "tight" or "loose"
    body_m: float
    garment_m: float  #: of the cloth around it, unstretched
    ease_m: float
    strain: float
    pressure_pa: float
    opening_m: float  #: across an open front, beside garment_m


class Crossing(NamedTuple):
    """Two surfaces of an outfit of which triangles cross."""

    kind: str  #: "self", "skin", "cloth" or "prop": what the cloth crosses
    cloth: int  #: index in the list
    other: int  #: index of the other cloth; number of the prop among the cloth's; else as cloth
    pair_count: int  #: pairs of triangles that cross
    triangle: int  #: of the first pair: one of the cloth's triangles
    other_triangle: int  #: one of the cloth's own, of the avatar's, or of the other cloth's, by kind


class ClothStats(NamedTuple):
    vertex_count: int
    simulated_count: int
    constraint_count: int
    strain_mean: float
    strain_p99: float
    strain_max: float
    step_ms: float
    substeps: int  #: of the last step; 0: the cloth slept
    collider_count: int  #: spheres and capsules that it met
    sleeves_taken_up_m: float  #: by so much too long for the arms
    legs_taken_up_m: float


def _rest_rotations() -> NDArray[np.float32]:
    rotations = np.zeros((len(BONE_NAMES), 4), np.float32)
    rotations[:, 3] = 1.0
    return rotations


def _rest_positions() -> NDArray[np.float32]:
    return np.zeros((len(BONE_NAMES), 3), np.float32)


@dataclass(eq=False)
class Pose:
    """One row a bone, in the order of vfit.Bone. The default is the T-pose with the hips in the origin."""

    rotations: NDArray[np.float32] = field(default_factory=_rest_rotations)
    """Local to the parent, relative to a T-pose in which every bone has the axes of the world."""
    positions: NDArray[np.float32] = field(default_factory=_rest_positions)
    """The hips' in world space; of other bones the offset from the parent in the T-pose."""
    time_ns: int = 0
    contacts: Tuple[bool, bool] = (False, False)
    """Left and right foot are planted."""
    root_correction: Vector = (0.0, 0.0, 0.0)
    foot_correction_m: float = 0.0

    def as_dict(self) -> "dict[str, Tuple[float, ...]]":
        """VRM bone name -> rotation."""
        return {name: tuple(row) for name, row in zip(BONE_NAMES, self.rotations.tolist())}
