"""What can go wrong: one exception for each error code of the library, all of them vfit.Error."""

from __future__ import annotations

from typing import Dict, Type

from ._vfit import ResultCode


class Error(Exception):
    """A failed call: str(error) is the library's sentence, error.code its result code."""

    code: ResultCode

    def __init__(self, message: str, code: ResultCode = ResultCode.ERROR_UNKNOWN) -> None:
        super().__init__(message)
        self.code = code


class ArgumentError(Error, ValueError):
    """An argument that cannot be right."""


class HandleError(Error):
    """The object was closed, or its context or avatar was."""


class StateError(Error):
    """The right call at the wrong moment."""


class BusyError(Error):
    """Another thread is inside the object, or too many frames are held."""


class CapacityError(Error):
    """An array is too small."""


class UnsupportedError(Error):
    """This version, sensor or frame cannot do that."""


class VersionError(Error):
    """Library and binding do not belong together."""


class OutOfMemoryError(Error, MemoryError):
    """Memory is short."""


class FileError(Error):
    """A file or folder cannot be read or written."""


class DataError(Error, ValueError):
    """A file, frame, joint or garment has malformed content."""


class DeviceLostError(Error):
    """The sensor was unplugged."""


class PluginError(Error):
    """A sensor plug-in failed."""


class NotWearableError(Error):
    """A garment in that size does not close around the body."""


_CLASSES: Dict[int, Type[Error]] = {
    ResultCode.ERROR_ARGUMENT: ArgumentError,
    ResultCode.ERROR_HANDLE: HandleError,
    ResultCode.ERROR_STATE: StateError,
    ResultCode.ERROR_BUSY: BusyError,
    ResultCode.ERROR_CAPACITY: CapacityError,
    ResultCode.ERROR_UNSUPPORTED: UnsupportedError,
    ResultCode.ERROR_VERSION: VersionError,
    ResultCode.ERROR_OUT_OF_MEMORY: OutOfMemoryError,
    ResultCode.ERROR_IO: FileError,
    ResultCode.ERROR_DATA: DataError,
    ResultCode.ERROR_DEVICE_LOST: DeviceLostError,
    ResultCode.ERROR_PLUGIN: PluginError,
    ResultCode.ERROR_NOT_WEARABLE: NotWearableError,
}


def from_result(result: int, message: str) -> Error:
    """The exception of a result code; the extension module raises it."""
    return _CLASSES.get(result, Error)(message, ResultCode(result))
