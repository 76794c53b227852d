"""vfit: one depth camera becomes a fitting room. Measures, sizes, an avatar that follows, cloth on it.

>>> import vfit
>>> with vfit.Context() as ctx:
...     tracker, scan = vfit.Tracker(ctx), vfit.Scan(ctx, sex="f")
...     for frame in ctx.open("virtual:motion=demo&sex=f&frames=60"):
...         if scan.add(tracker.update(frame)).complete:
...             break
...     print(scan.measure()["stature_m"])
"""

from ._vfit import (
    BONE_NAMES,
    BONE_PARENTS,
    MEASURES,
    ActiveState,
    Avatar,
    Axes,
    Bone,
    Cloth,
    Context,
    FloorState,
    Frame,
    Garment,
    Guidance,
    Joint,
    JointState,
    LogLevel,
    Motion,
    Recorder,
    ResultCode,
    Scan,
    ScanMethod,
    Sensor,
    Sex,
    SizeChart,
    Stream,
    Tracker,
    __version__,
    info,
    merge_measurements,
    read_measurements,
    write_measurements,
)
from .errors import (
    ArgumentError,
    BusyError,
    CapacityError,
    DataError,
    DeviceLostError,
    Error,
    FileError,
    HandleError,
    NotWearableError,
    OutOfMemoryError,
    PluginError,
    StateError,
    UnsupportedError,
    VersionError,
)
from .values import (
    AvatarPart,
    Body,
    Camera,
    CharacterInfo,
    ClothStats,
    Collider,
    ContextStats,
    FitZone,
    GarmentInfo,
    GarmentPart,
    Intrinsics,
    JointPoint,
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
)

__all__ = [
    "ActiveState", "ArgumentError", "Avatar", "AvatarPart", "Axes", "BONE_NAMES", "BONE_PARENTS", "Body", "Bone", "BusyError",
    "Camera", "CapacityError", "CharacterInfo", "Cloth", "ClothStats", "Collider", "Context", "ContextStats", "DataError",
    "DeviceLostError", "Error", "FileError", "FitZone", "FloorState", "Frame", "Garment", "GarmentInfo", "GarmentPart", "Guidance",
    "HandleError", "Intrinsics", "Joint", "JointPoint", "JointState", "Joints", "LibraryInfo", "LogLevel",
    "LogLine", "MEASURES", "Measurement", "Motion", "NotWearableError", "OutOfMemoryError", "PluginError", "PluginInfo", "Pose",
    "Recorder", "ResultCode", "RigBone", "Scale", "Scan", "ScanMethod", "ScanState", "Sensor", "SensorInfo",
    "SensorMode", "SensorOption", "SensorStats", "Sex", "ShapeValue", "Size", "SizeChart", "SizeRow",
    "SizeZone", "StageTime", "StateError", "Stream", "Tracker", "UnsupportedError", "VersionError", "__version__", "info",
    "merge_measurements", "read_measurements", "write_measurements",
]
