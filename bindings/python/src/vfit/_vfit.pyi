"""Types of the extension module; use it through the package vfit."""

from enum import IntEnum
from os import PathLike
from types import TracebackType
from typing import (
    Any,
    Final,
    Iterable,
    Iterator,
    List,
    Literal,
    Mapping,
    Optional,
    Sequence,
    Tuple,
    Type,
    TypeVar,
    Union,
)

import numpy as np
from numpy.typing import NDArray

from .values import (
    AvatarPart,
    Body,
    CalibratedMeasure,
    Camera,
    CharacterInfo,
    ClothStats,
    Collider,
    ContextStats,
    Crossing,
    Doubt,
    FitZone,
    GarmentInfo,
    GarmentPart,
    Intrinsics,
    Joints,
    LibraryInfo,
    LogLine,
    Measurement,
    PluginInfo,
    Pose,
    RigBone,
    Scale,
    ScanState,
    SensorInfo,
    SensorMode,
    SensorOption,
    SensorStats,
    ShapeValue,
    Size,
    SizeRow,
    SizeZone,
    StageTime,
    WorldPlace,
)

_Path = Union[str, "PathLike[str]"]
_Sex = Union["Sex", str, None]
"""A Sex, "f", "m" or None."""
_Measures = Mapping[str, Union[Measurement, Tuple[float, ...], float]]
_JointsIn = Union[Joints, Mapping[str, Sequence[float]], Mapping["Joint", Sequence[float]]]
_TrackSource = Literal["auto", "built_in", "given"]
_Self = TypeVar("_Self", bound="_Closable")

__version__: Final[str]
BONE_NAMES: Final[Tuple[str, ...]]
"""VRM names, in the order of Bone."""
BONE_PARENTS: Final[Tuple[int, ...]]
"""-1: no parent."""
MEASURES: Final[dict[str, str]]
"""Key -> one-line definition of every measure."""

def info() -> LibraryInfo:
    """Version, instruction set in use and build of the library."""

class ResultCode(IntEnum):
    """Result codes; errors are negative."""

    END_OF_STREAM = 4
    INCOMPLETE = 3
    TIMEOUT = 2
    NOT_READY = 1
    OK = 0
    ERROR_UNKNOWN = -1
    ERROR_ARGUMENT = -2
    ERROR_HANDLE = -3
    ERROR_STATE = -4
    ERROR_BUSY = -5
    ERROR_CAPACITY = -6
    ERROR_UNSUPPORTED = -7
    ERROR_VERSION = -8
    ERROR_OUT_OF_MEMORY = -9
    ERROR_IO = -10
    ERROR_DATA = -11
    ERROR_DEVICE_LOST = -12
    ERROR_PLUGIN = -13
    ERROR_NOT_WEARABLE = -14

class Axes(IntEnum):
    """Convention of everything that a context reads and writes."""

    RH_Y_UP = 0
    UNITY = 1
    UNREAL = 2

class LogLevel(IntEnum):
    """Weight of a log line."""

    ERROR = 0
    WARNING = 1
    INFO = 2
    DEBUG = 3

class Stream(IntEnum):
    """The kinds of data in a frame."""

    DEPTH = 0
    COLOR = 1
    USER_MAP = 2
    POSITION = 16
    NORMAL = 17
    UV = 18
    INDEX = 19
    BONE_MATRIX = 20
    SKIN_BONES = 21
    SKIN_WEIGHTS = 22
    STRAIN = 23
    PRESSURE = 24

class FloorState(IntEnum):
    """Who says where the floor is."""

    DEFAULT = 0
    ESTIMATED = 1
    GIVEN = 2

class JointState(IntEnum):
    """How a joint was found."""

    NOT_SEEN = 0
    INFERRED = 1
    MEASURED = 2

class ActiveState(IntEnum):
    """Why somebody is the active person; LOST: out of sight and waited for."""

    NOBODY = 0
    BY_RULE = 1
    CHOSEN = 2
    LOST = 3

class Sex(IntEnum):
    """Which default body; UNKNOWN: halfway."""

    UNKNOWN = 0
    FEMALE = 1
    MALE = 2

class ScanMethod(IntEnum):
    """How a scan measures; PROPORTIONS is the paper's way, FIT a body fitted to all frames."""

    DEFAULT = 0
    PROPORTIONS = 1
    PROPORTIONS_AS_PRINTED = 2
    FIT = 3

class DoubtKind(IntEnum):
    UNLIKELY = 0
    INCHES = 1
    POUNDS = 2
    DIGIT = 3
    SWAPPED = 4

class Guidance(IntEnum):
    """Why a scan did not take a frame."""

    NONE = 0
    STEP_BACK = 1
    STEP_CLOSER = 2
    ARMS_OUT = 3
    HOLD_STILL = 4
    TURN_SIDEWAYS = 5
    FEET_NOT_VISIBLE = 6
    ONE_PERSON_ONLY = 7
    NOBODY = 8
    JOINTS_MISSING = 9
    FACE_CAMERA = 10
    TURN_ROUND = 11
    TURN_SLOWER = 12
    ARMS_FORWARD = 13

class Joint(IntEnum):
    """What a sensor sees. LEFT is the person's own left."""

    HEAD = 0
    NECK = 1
    TORSO = 2
    LEFT_SHOULDER = 3
    RIGHT_SHOULDER = 4
    LEFT_ELBOW = 5
    RIGHT_ELBOW = 6
    LEFT_HAND = 7
    RIGHT_HAND = 8
    LEFT_HIP = 9
    RIGHT_HIP = 10
    LEFT_KNEE = 11
    RIGHT_KNEE = 12
    LEFT_FOOT = 13
    RIGHT_FOOT = 14
    PELVIS = 15
    CHEST = 16
    LEFT_CLAVICLE = 17
    RIGHT_CLAVICLE = 18
    LEFT_WRIST = 19
    RIGHT_WRIST = 20
    LEFT_TOES = 21
    RIGHT_TOES = 22

class Bone(IntEnum):
    """Humanoid bones by their VRM names, parents before children."""

    HIPS = 0
    SPINE = 1
    CHEST = 2
    UPPER_CHEST = 3
    NECK = 4
    HEAD = 5
    LEFT_SHOULDER = 6
    LEFT_UPPER_ARM = 7
    LEFT_LOWER_ARM = 8
    LEFT_HAND = 9
    RIGHT_SHOULDER = 10
    RIGHT_UPPER_ARM = 11
    RIGHT_LOWER_ARM = 12
    RIGHT_HAND = 13
    LEFT_UPPER_LEG = 14
    LEFT_LOWER_LEG = 15
    LEFT_FOOT = 16
    LEFT_TOES = 17
    RIGHT_UPPER_LEG = 18
    RIGHT_LOWER_LEG = 19
    RIGHT_FOOT = 20
    RIGHT_TOES = 21

class _Closable:
    @property
    def closed(self) -> bool: ...
    def close(self) -> None: ...
    def __enter__(self: _Self) -> _Self: ...
    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        error: Optional[BaseException],
        trace: Optional[TracebackType],
        /,
    ) -> None: ...

class Context(_Closable):
    """All that vfit does happens in a context; contexts share nothing. Closing it closes every object of it,
    except frames and arrays: those stay valid, and the last of them frees the rest."""

    def __init__(
        self,
        *,
        axes: Axes = ...,
        validate: bool = False,
        deterministic: bool = False,
        mirror: bool = False,
        workers: int = 0,
        plugin_dir: Optional[_Path] = None,
        data_dir: Optional[_Path] = None,
    ) -> None: ...
    @property
    def time_ns(self) -> int:
        """Now, on the clock of all time stamps of this context."""
    def open(self, uri: _Path, **options: object) -> Sensor:
        """A sensor by its URI ("recording:PATH", "virtual:motion=demo") or a recording's path."""
    def sensors(self) -> list[SensorInfo]: ...
    def sensor_changes(self) -> int:
        """Rises when sensors() may tell something else: a USB camera came or went, a plug-in was loaded."""
    def plugins(self) -> list[PluginInfo]: ...
    def garments(self) -> list[str]:
        """Names that Garment.open takes."""
    def size_charts(self) -> list[str]:
        """Names that SizeChart.open takes."""
    def populations(self) -> list[str]:
        """Names that Population.open takes."""
    def load_plugin(self, path: _Path) -> None: ...
    def shape_values(self) -> dict[str, ShapeValue]: ...
    def pack_pose(self, pose: Pose) -> bytes:
        """A pose for the network, at most 120 bytes."""
    def unpack_pose(self, packet: bytes) -> Pose: ...
    def pose_osc(self, pose: Pose, kind: str = "vmc") -> bytes:
        """A pose as one UDP packet of Open Sound Control: 'vmc' or 'vrchat' (docs/motion.md)."""
    def pose_bvh(self, poses: Iterable[Pose], frame_time_s: float = 0.0) -> str:
        """Poses in order of time as the text of a BVH file. frame_time_s 0: 1/30 s."""
    def stats(self) -> ContextStats: ...
    def profile(self) -> dict[str, StageTime]: ...
    def reset_profile(self) -> None: ...
    def log(self) -> list[LogLine]:
        """The log lines since the last call; the library keeps the newest 256."""

class Frame(_Closable):
    """Immutable bundle of images or vertex data with one time stamp. Arrays are read-only views without a
    copy and stay valid for as long as you hold them, also after close() of the frame or its context. A stream
    that the frame does not have raises ArgumentError; `Stream.COLOR in frame` asks first."""

    @staticmethod
    def from_numpy(
        context: Context,
        depth: NDArray[np.uint16],
        intrinsics: Union[Intrinsics, Sequence[Any]],
        *,
        users: Union[NDArray[np.uint8], NDArray[np.bool_], None] = None,
        color: Optional[NDArray[np.uint8]] = None,
        camera: Optional[Camera] = None,
        time_ns: int = 0,
    ) -> Frame:
        """A frame from your own pixels, which are copied: depth (h, w), users (h, w), color (h, w, 4)."""
    @property
    def streams(self) -> Tuple[Stream, ...]: ...
    def __contains__(self, stream: Union[Stream, int]) -> bool: ...
    def view(self, stream: Union[Stream, int]) -> NDArray[Any]: ...
    def serial(self, stream: Union[Stream, int]) -> int: ...
    def write(self, stream: Union[Stream, int], out: NDArray[Any], serial: int = 0) -> int:
        """Copies a stream into your array, at its own type and stride, unless serial is already the stream's;
        returns the stream's serial."""
    @property
    def time_ns(self) -> int: ...
    @property
    def depth(self) -> NDArray[np.uint16]: ...
    @property
    def color(self) -> NDArray[np.uint8]: ...
    @property
    def users(self) -> NDArray[np.uint8]: ...
    @property
    def positions(self) -> NDArray[np.float32]: ...
    @property
    def normals(self) -> NDArray[np.float32]: ...
    @property
    def uvs(self) -> NDArray[np.float32]: ...
    @property
    def triangles(self) -> NDArray[np.uint32]: ...
    @property
    def bone_matrices(self) -> NDArray[np.float32]: ...
    @property
    def skin_bones(self) -> NDArray[np.uint16]: ...
    @property
    def skin_weights(self) -> NDArray[np.float32]: ...
    @property
    def strain(self) -> NDArray[np.float32]: ...
    @property
    def pressure(self) -> NDArray[np.float32]: ...
    @property
    def intrinsics(self) -> Intrinsics: ...
    @property
    def camera(self) -> Camera: ...
    def meta(self, key: str) -> Any:
        """What the source says beside the pixels ("measures", "contacts", "index"), or None."""
    def bodies(self) -> list[Body]: ...
    def joints(self, body_id: Optional[int] = None) -> Joints:
        """Of one body, by default of the active one."""
    @property
    def active_body(self) -> Optional[int]:
        """The id of the person to follow, who may be out of sight (ActiveState.LOST); None: no person. What
        Scan.add and Motion.step take by default. Of a frame that no tracker made: the first body."""
    @property
    def active_state(self) -> ActiveState: ...

class Sensor(_Closable):
    """A camera, a recording or a virtual person; iterate it for its frames. Its pool holds few frames: copy
    what you keep."""

    def __iter__(self) -> Iterator[Frame]: ...
    def __next__(self) -> Frame: ...
    def start(self) -> None: ...
    def stop(self) -> None: ...
    def acquire(self, timeout_s: Optional[float] = None) -> Optional[Frame]:
        """The newest frame; None where none came in time, or the stream has ended. 0 never waits."""
    @property
    def ended(self) -> bool: ...
    def set_option(self, key: str, value: object) -> None: ...
    def options(self) -> dict[str, SensorOption]: ...
    def modes(self) -> list[SensorMode]: ...
    def stats(self) -> SensorStats: ...

class Recorder(_Closable):
    """Writes a recording folder (docs/recording.md)."""

    def __init__(
        self,
        context: Context,
        path: _Path,
        *,
        sensor_name: Optional[str] = None,
        rate_hz: float = 30.0,
        segmented: bool = False,
    ) -> None: ...
    def write(self, frame: Frame) -> None: ...

class Tracker(_Closable):
    """Makes tracked frames: images, user map and bodies.

    floor says where the floor is, if the frames do not. joints and user_map say whose are taken: "auto" is
    the source's where it tells them, else the tracker's own; "given" is the source's alone (UnsupportedError
    where it tells none). follow is the rule of the active person: "nearest" to the camera, most "centred",
    who came "first", or only the one "chosen". filter: joints are steadied over time and their states
    follow their confidence, "auto" for the tracker's own and submitted ones, "on" for the source's too,
    "off". fit: the body model fitted to depth and outline moves the joints that the tracker finds and gives
    them rotations; "auto" is the active person's."""

    def __init__(
        self,
        context: Context,
        *,
        floor: Optional[Camera] = None,
        joints: _TrackSource = "auto",
        user_map: _TrackSource = "auto",
        follow: Literal["nearest", "centred", "first", "chosen"] = "nearest",
        filter: Literal["auto", "on", "off"] = "auto",
        fit: Literal["auto", "off", "everybody"] = "auto",
    ) -> None: ...
    def update(self, frame: Frame) -> Frame:
        """The frame with the bodies that its source supplies, or those that the tracker finds."""
    def track(
        self,
        depth: NDArray[np.uint16],
        intrinsics: Union[Intrinsics, Sequence[Any]],
        *,
        users: Union[NDArray[np.uint8], NDArray[np.bool_], None] = None,
        camera: Optional[Camera] = None,
        time_ns: int = 0,
    ) -> Frame:
        """User map (`.users`) and people (`.bodies()`) of a depth image (h, w) in millimetres, 0 where there
        is no reading; intrinsics are fx, fy, cx, cy in pixels. Images that follow each other want their time
        stamps: people keep their ids and joints are steadied over time. time_ns 0: now."""
    def hint(
        self,
        hints: Union[Mapping[str, Sequence[float]], Mapping[Joint, Sequence[float]]],
        *,
        body_id: int = 0,
    ) -> None:
        """Joints that you see in the image, as (x, y) or (x, y, confidence) in pixels of the depth image, for
        the next update or track alone. body_id 0: of whose pixel each is."""
    def hint_from(
        self,
        seen: Frame,
        position: Tuple[float, float, float],
        rotation: Tuple[float, float, float, float] = ...,
        body_id: Optional[int] = None,
    ) -> None:
        """A person as the tracker of another camera saw them at most about 50 ms ago, for the next update
        alone: it tells which way they face. position and rotation (xyzw): its world space in this one's
        (align_worlds). Default: its active body."""
    def choose(self, body_id: Optional[int]) -> None:
        """That person is the active one from the next frame on; when they have left for two seconds the rule
        holds again. None: by the rule again."""
    def submit(
        self,
        frame: Frame,
        joints: _JointsIn,
        *,
        body_id: int = 1,
        time_ns: int = 0,
        camera_space: bool = False,
        partly_out_of_view: bool = False,
    ) -> Frame:
        """The frame with a body of your own; submit to the result to add a second one."""
    def reset(self) -> None: ...

def align_worlds(context: Context, here: NDArray[np.float32], there: NDArray[np.float32]) -> WorldPlace:
    """Where another camera's world space lies in this one's, from points (n, 3) that both saw at the same
    times: middle joints (PELVIS, CHEST, NECK, HEAD) of a person who walks about."""

class Scan(_Closable):
    """Measures one person over several frames; closing it wipes the body data."""

    def __init__(
        self,
        context: Context,
        *,
        frames: int = 0,
        sex: _Sex = None,
        method: ScanMethod = ...,
        side_frames: int = 0,
        bare: bool = False,
        tight: bool = False,
        turn: bool = False,
        cameras: int = 1,
    ) -> None: ...
    def add(self, frame: Frame, body_id: Optional[int] = None, camera: int = 0) -> ScanState:
        """camera: which of several saw the frame, each with a tracker of its own."""
    def measure(self) -> dict[str, Measurement]: ...
    def sex(self) -> Tuple[Sex, float]:
        """(sex, probability): as the scan was told, else as it infers from the fitted body."""
    def colliders(self) -> list[Collider]: ...
    def scale(self, garment_kind: str) -> Scale: ...
    def extend(self, frames: int, side_frames: int = 0) -> None:
        """Asks for more frames, also of a complete scan."""
    def reset(self) -> None: ...

class SizeChart(_Closable):
    @staticmethod
    def open(context: Context, name: str) -> SizeChart: ...
    @staticmethod
    def load(context: Context, json: Union[str, bytes]) -> SizeChart: ...
    def rows(self) -> list[SizeRow]: ...
    def recommend(self, garment_kind: str, measurements: _Measures) -> list[Size]:
        """Every label of that kind with its probability, best first."""
    def zones(self, garment_kind: str, label: str, measurements: _Measures) -> list[SizeZone]:
        """How that size sits, by measure."""

class Population(_Closable):
    @staticmethod
    def open(context: Context, name: str) -> Population: ...
    @staticmethod
    def load(context: Context, json: Union[str, bytes]) -> Population: ...
    def estimate(
        self, known: _Measures, sex: _Sex = None, age: Optional[float] = None
    ) -> dict[str, Measurement]:
        """Every measure of a person of whom these are known: typed (sigma 0), taped or scanned."""
    def check(self, known: _Measures, sex: _Sex = None, age: Optional[float] = None) -> list[Doubt]:
        """Measures that do not go with the others, the worst first."""

def write_measurements(measurements: _Measures, sex: _Sex = None) -> str:
    """As JSON text, for an app that keeps them with the person's consent."""

def read_measurements(json: Union[str, bytes]) -> tuple[dict[str, Measurement], Sex]:
    """Of such a text, a report of vfit measure, or {"stature_m": 1.7}."""

def merge_measurements(a: _Measures, b: _Measures) -> dict[str, Measurement]:
    """Two scans of one person in one."""

def add_to_calibration(text: Union[str, bytes, None], scanned: _Measures, taped: _Measures) -> str:
    """A calibration to a tape of your own, with one more person; text None: the first one."""

def calibrated_measures(text: Union[str, bytes]) -> dict[str, CalibratedMeasure]:
    """What a calibration says of each measure."""

def calibrate(text: Union[str, bytes], measurements: _Measures) -> dict[str, Measurement]:
    """Measures of a scan as the calibration's tape would tell them."""

class Avatar(_Closable):
    """A posable body. detail 0: 13.7k vertices, 1: 54.8k, 2: 219k, 3: 1.0k, for crowds."""

    @staticmethod
    def from_scan(
        scan: Scan,
        *,
        sex: _Sex = None,
        detail: int = 0,
        paper_colliders: bool = False,
        single_bones: bool = False,
        dual_quaternions: bool = False,
        limbs_as_posed: bool = False,
    ) -> Avatar: ...
    @staticmethod
    def from_measures(
        context: Context,
        measurements: _Measures,
        *,
        sex: _Sex = None,
        detail: int = 0,
        paper_colliders: bool = False,
        single_bones: bool = False,
        dual_quaternions: bool = False,
        limbs_as_posed: bool = False,
    ) -> Avatar: ...
    @staticmethod
    def from_shape(
        context: Context,
        shape: Mapping[str, float] = ...,
        *,
        sex: _Sex = None,
        detail: int = 0,
        paper_colliders: bool = False,
        single_bones: bool = False,
        dual_quaternions: bool = False,
        limbs_as_posed: bool = False,
    ) -> Avatar: ...
    @staticmethod
    def load(
        context: Context,
        file: Union[_Path, bytes],
        *,
        bone_map: Optional[Mapping[str, str]] = None,
        scale: float = 1.0,
        paper_colliders: bool = False,
        single_bones: bool = False,
        dual_quaternions: bool = False,
        limbs_as_posed: bool = False,
    ) -> Avatar:
        """A character of yours, glTF 2.0 or VRM. bone_map: {"hips": "name of a node", ...}. scale: metres
        in a unit of the file."""
    @staticmethod
    def unpack(
        context: Context,
        packet: bytes,
        *,
        detail: int = 0,
        paper_colliders: bool = False,
        single_bones: bool = False,
        dual_quaternions: bool = False,
        limbs_as_posed: bool = False,
    ) -> tuple[Avatar, str]:
        """The avatar and the size label of what pack gave."""
    def pack(self, size_label: str = "") -> bytes:
        """Body and size for the network, at most 240 bytes."""
    def describe(self) -> CharacterInfo: ...
    def parts(self) -> list[AvatarPart]: ...
    def pose_into(self, pose: Pose, positions: np.ndarray, normals: Optional[np.ndarray] = None) -> None:
        """Poses, and writes the skin into arrays of yours, (vertices, 3) float32 of any stride."""
    def pose(self, pose: Pose) -> None: ...
    def acquire(self) -> Frame: ...
    def acquire_rest(self) -> Frame: ...
    def rig(self) -> list[RigBone]: ...
    def joints(self) -> Joints: ...
    def colliders(self) -> list[Collider]: ...
    def measure(self) -> dict[str, Measurement]: ...
    def measure_own(self, json: Union[str, bytes]) -> dict[str, Measurement]:
        """Measures of your own (docs/measuring.md), taken on the avatar's mesh."""

class Motion(_Closable):
    """Turns the bodies of tracked frames into clean poses. None: the library's default. filter: True, False,
    'adaptive', 'holt' (with the five names of the Kinect SDK) or 'one_euro'; contact_rule: 'learnt' or
    'thresholds'. range_of_motion: {'knee': {'flexion': 60}} in place of the natural angles, degrees."""

    def __init__(
        self,
        context: Context,
        *,
        filter: Union[bool, str] = True,
        limits: bool = True,
        smooth_rotations: bool = True,
        feet: bool = True,
        smoothing: Optional[float] = None,
        correction: Optional[float] = None,
        prediction: Optional[float] = None,
        jitter_radius_m: Optional[float] = None,
        max_deviation_radius_m: Optional[float] = None,
        rotation_divisor: Optional[float] = None,
        rotation_divisor_switched: Optional[float] = None,
        min_cutoff_hz: Optional[float] = None,
        beta: Optional[float] = None,
        derivative_cutoff_hz: Optional[float] = None,
        prediction_s: Optional[float] = None,
        contact_rule: str = "learnt",
        range_of_motion: Optional[Mapping[str, Mapping[str, float]]] = None,
    ) -> None: ...
    def bind(self, avatar: Avatar) -> None: ...
    def step(
        self, frame: Optional[Frame] = None, body_id: Optional[int] = None, now_ns: Optional[int] = None
    ) -> bool:
        """True where the body was there. No frame: predicts to now_ns."""
    def step_joints(
        self,
        joints: _JointsIn,
        time_ns: Optional[int] = None,
        now_ns: Optional[int] = None,
    ) -> bool:
        """Joints of yours in world space, without a frame. True where they place the trunk."""
    def pose(self) -> Pose: ...
    def joints(self) -> Joints: ...
    def reset(self) -> None: ...

class Garment(_Closable):
    @staticmethod
    def open(context: Context, name: str) -> Garment: ...
    @staticmethod
    def load(context: Context, json: Union[str, bytes]) -> Garment: ...
    @property
    def info(self) -> GarmentInfo: ...
    @property
    def parts(self) -> List[GarmentPart]: ...

class Prop(_Closable):
    """A solid beside a body that cloth stays outside of: a chair, a weapon, a bag, hair."""

    @staticmethod
    def sphere(context: Context, radius: float) -> Prop: ...
    @staticmethod
    def capsule(context: Context, radius: float, half_length: float) -> Prop:
        """half_length: from the middle to each of the two centres, along the up axis."""
    @staticmethod
    def box(context: Context, half: Tuple[float, float, float]) -> Prop:
        """half: of each edge."""
    @staticmethod
    def mesh(context: Context, positions: NDArray[np.float32], triangles: NDArray[np.uint32]) -> Prop:
        """positions: (n, 3). triangles: (m, 3), wound as those of a frame."""
    def move(
        self, position: Tuple[float, float, float], rotation: Tuple[float, float, float, float] = ...
    ) -> None:
        """Where it is at the end of the next step. rotation: xyzw."""
    def deform(self, positions: NDArray[np.float32]) -> None:
        """The vertices of a mesh, in its own frame: (n, 3)."""

class Cloth(_Closable):
    """A garment on an avatar. Pose the avatar first, then step."""

    def __init__(
        self,
        avatar: Avatar,
        garment: Garment,
        *,
        size: Optional[str] = None,
        substeps: int = 0,
        gravity: Optional[Tuple[float, float, float]] = None,
        friction: Optional[float] = None,
        damping: Optional[float] = None,
        thickness_m: float = 0.0,
        hands: bool = True,
        skin: bool = False,
        sleeps: bool = True,
        wind: Tuple[float, float, float] = ...,
        drag: float = 0.0,
        lift: float = 0.0,
        inertia: Optional[float] = None,
        self_thickness_m: float = 0.0,
        budget_ms: float = 0.0,
        pressure: bool = False,
        cover_m: float = 0.0,
        virtual_m: float = 0.0,
        any_fit: bool = False,
        carry_speed_m_s: float = 0.0,
        carry_way_m: float = 0.0,
    ) -> None:
        """hands False: forearms and hands pass through all but their own sleeve. skin True: kept out of the
        avatar's skin itself. self_thickness_m: kept between the cloth's own layers. pressure True:
        frames have pressure, in Pa. cover_m: more spheres and capsules, until no skin below the
        garment is so far outside of all. virtual_m: points of triangles so near each other meet the
        body too: for coarse meshes. any_fit True: worn even where it would not close; else
        NotWearableError. carry_speed_m_s, carry_way_m: a body that moves faster or further in a step
        jumps, and the cloth feels nothing of it; 0: 6 and 0.06, below 0: no limit."""
    def teleport(self) -> None:
        """The avatar's pose at the next step is a jump from the last one: the cloth is carried along."""
    def set_wind(self, wind: Tuple[float, float, float]) -> None: ...
    def set_quality(self, substeps: int = 0, budget_ms: float = 0.0) -> None: ...
    def set_size(self, size: Optional[str] = None) -> None:
        """Another size of the garment, from how it hangs now; None: made to the avatar."""
    def add_prop(self, prop: Prop) -> None:
        """Stays outside of that prop from the next step on."""
    def remove_prop(self, prop: Prop) -> None: ...
    def fit(self) -> List[FitZone]:
        """How it sits, by girths of the trunk: let it come to rest first."""
    def fit_map(self) -> NDArray[np.float32]:
        """One value a vertex: above 0 tight, below 0 loose."""
    def wear_over(self, inner: Cloth) -> None:
        """From now on the two push each other and do not cross. The first one that is stepped in a frame
        steps both; the step of the other then finds its own done. Keep inner: closed, it is worn no
        longer."""
    def hide_skin(
        self, margin_m: float = 0.0, hidden: Optional[NDArray[np.bool_]] = None
    ) -> NDArray[np.bool_]:
        """One True a triangle of the avatar's that this garment hides; hidden: of the garments before."""
    def step(self, dt: float = ...) -> None: ...
    def begin_step(self, dt: float = ...) -> None: ...
    def end_step(self) -> None: ...
    def carry(self) -> None: ...
    def reset(self) -> None: ...
    def acquire(self) -> Frame: ...
    def stats(self) -> ClothStats: ...
    def state_hash(self) -> int: ...

def outfit_check(cloths: Sequence[Cloth]) -> List[Crossing]:
    """Tests the last steps of cloths of one avatar for triangles that cross. Empty: none do."""

def outfit_skin(cloths: Sequence[Cloth]) -> Tuple[Frame, int]:
    """The avatar's mesh to draw below an outfit: skin gives way where it would come through a garment.
    And how many pairs of triangles still cross."""
