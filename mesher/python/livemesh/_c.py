"""The C interface by ctypes: functions, handles, arrays, errors, and runs that can be stopped.

Nothing here is public. ctypes releases the GIL during every call of the library, and takes it again
for callbacks.
"""
from __future__ import annotations

import atexit
import ctypes
import operator
import os
import pathlib
import signal as _signals
import sys
import threading
import time
from collections.abc import Callable
from ctypes import POINTER, Structure, byref, c_char_p, c_double, c_int, c_int32, c_int64, c_size_t
from ctypes import c_uint32, c_uint64, c_void_p
from types import FrameType
from typing import Any, NoReturn, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from ._errors import raise_error

ABI_VERSION = 1
NONE = 0xFFFFFFFF


def _library_path() -> str:
    names = {"win32": "livemesh.dll", "darwin": "liblivemesh.dylib"}
    own = pathlib.Path(__file__).parent / names.get(sys.platform, "liblivemesh.so")
    return os.environ.get("LIVEMESH_LIBRARY") or str(own)


_library = ctypes.CDLL(_library_path())


class Error(Structure):
    _fields_ = [("size", c_size_t), ("status", c_int32), ("reserved", c_int32), ("name", c_char_p),
                ("message", c_char_p), ("file", c_char_p), ("line", c_int64), ("column", c_int64),
                ("features", c_size_t), ("feature_kinds", POINTER(c_int32)),
                ("feature_ids", POINTER(c_int64)), ("places", c_size_t), ("at", POINTER(c_double))]


class ArrayStruct(Structure):
    _fields_ = [("size", c_size_t), ("data", c_void_p), ("rows", c_uint64), ("stride", c_uint64),
                ("columns", c_uint32), ("type", c_uint32)]


class ProgressStruct(Structure):
    _fields_ = [("size", c_size_t), ("phase", c_int32), ("reserved", c_int32), ("done", c_uint64),
                ("of", c_uint64)]


PROGRESS = ctypes.CFUNCTYPE(c_int, POINTER(ProgressStruct), c_void_p)
SIZE = ctypes.CFUNCTYPE(c_double, POINTER(c_double), c_void_p)


class Control(Structure):
    _fields_ = [("size", c_size_t), ("progress", PROGRESS), ("user", c_void_p),
                ("interval", c_double), ("timeout", c_double), ("stop", c_uint64)]


class Polygon(Structure):
    _fields_ = [("size", c_size_t), ("loops", c_size_t), ("loop_sizes", c_void_p),
                ("points", c_void_p), ("inner_edges", c_size_t), ("edges", c_void_p),
                ("inner_points", c_size_t), ("loose_points", c_void_p), ("marker", c_int64)]


class Options(Structure):
    _fields_ = [("size", c_size_t), ("domain_lo", c_double * 3), ("domain_hi", c_double * 3),
                ("rho", c_double), ("min_angle", c_double), ("min_dihedral", c_double),
                ("max_measure", c_double), ("sizes", c_uint64), ("max_vertices", c_uint64),
                ("extent", c_int32), ("algorithm", c_int32), ("rule", c_int32),
                ("region_limits", c_int32), ("no_flat", c_int32),
                ("threads", c_int32), ("box_limits_count", c_size_t),
                ("box_limits", c_void_p), ("growth", c_double), ("periodic_count", c_size_t),
                ("periodic", c_void_p), ("out_of_core", c_char_p), ("tiles", c_uint64)]


class MeshInfo(Structure):
    _fields_ = [("size", c_size_t), ("dimension", c_int32), ("algorithm", c_int32),
                ("points", c_uint64), ("cells", c_uint64), ("keeps_all", c_int32),
                ("order", c_int32)]


class Name(Structure):
    _fields_ = [("size", c_size_t), ("kind", c_int32), ("reserved", c_int32),
                ("marker", c_int64), ("region", c_double), ("name", c_char_p)]


class WriteOptions(Structure):
    _fields_ = [("size", c_size_t), ("msh_version", c_int32), ("only_these", c_int32),
                ("names_count", c_size_t), ("names", c_void_p)]


class CheckOptions(Structure):
    _fields_ = [("size", c_size_t), ("graph", c_uint64), ("rho", c_double),
                ("max_measure", c_double), ("boundary", c_int32), ("near_delaunay", c_int32)]


class Finding(Structure):
    _fields_ = [("size", c_size_t), ("property", c_char_p), ("detail", c_char_p),
                ("holds", c_int32), ("reserved", c_int32)]


class LiveInfo(Structure):
    _fields_ = [("size", c_size_t), ("dimension", c_int32), ("pending", c_int32),
                ("point_slots", c_uint64), ("cell_slots", c_uint64), ("points", c_uint64),
                ("cells", c_uint64), ("updates", c_uint64), ("undoable", c_uint64),
                ("trace_bytes", c_uint64), ("domain_lo", c_double * 3),
                ("domain_hi", c_double * 3)]


class ChangeInfo(Structure):
    _fields_ = [("size", c_size_t), ("dimension", c_int32), ("reserved", c_int32),
                ("point_slots", c_uint64), ("cell_slots", c_uint64), ("executed", c_uint64),
                ("reused", c_uint64), ("point_slots_before", c_uint64)]


# Pointers to arrays are passed as addresses. h: handle, p: pointer, z: size_t, i: int32, q: int64,
# d: double, s: string.
_TYPES = {"h": c_uint64, "p": c_void_p, "z": c_size_t, "i": c_int32, "q": c_int64, "d": c_double,
          "s": c_char_p, "S": SIZE}
_SIGNATURES = {
    "free": "h", "last_error": "p", "stop_new": "p", "stop_request": "h",
    "graph_new": "ip", "graph_add_points": "hzpppp", "graph_add_segments": "hzpppp",
    "graph_add_polyline": "hzppqp", "graph_add_polygon": "hppp", "graph_add_faces": "hzppppp",
    "graph_add_soup": "hzppp", "graph_add_holes": "hzppp", "graph_add_regions": "hzppppp",
    "graph_dimension": "hp", "graph_array": "hip", "graph_read": "siip", "graph_write": "hs",
    "graph_repair": "hppp", "graph_merge": "hp",
    "sizes_samples": "izppp", "sizes_function": "iSpddp", "sizes_read": "sip",
    "mesh_make": "hppp", "mesh_describe": "hp", "mesh_array": "hip", "mesh_quality": "hip",
    "mesh_write": "hs", "mesh_write_as": "hsp", "mesh_name_count": "hp", "mesh_name_get": "hzp",
    "mesh_second_order": "hp", "mesh_read": "sip", "mesh_check": "hppp", "finding_get": "hzp",
    "live_new": "ipp", "live_add_points": "hzpppp", "live_move_points": "hzpp",
    "live_remove_points": "hzp", "live_add_segments": "hzpppp", "live_add_polyline": "hzppqp",
    "live_remove_lines": "hzp", "live_add_polygon": "hppp", "live_remove_polygons": "hzp",
    "live_add_holes": "hzppp", "live_remove_holes": "hzp", "live_add_regions": "hzppppp",
    "live_remove_regions": "hzp", "live_add_graph": "hh", "live_limit": "hdhp",
    "live_discard": "h", "live_update": "hpp", "live_keep_undo": "hz", "live_undo": "hpp",
    "live_describe": "hp", "live_array": "hip", "live_regions": "hzpp", "live_find": "hzpp",
    "live_contains": "hizpp", "live_mesh": "hp", "live_graph": "hp",
    "change_describe": "hp", "change_array": "hip", "change_transfer": "hzpzpz",
    "text_count": "hp", "text_get": "hzp",
}


class _Functions:
    """The functions of the library, without the prefix lm_."""

    def __init__(self) -> None:
        for name, signature in _SIGNATURES.items():
            function = getattr(_library, "lm_" + name)
            function.argtypes = [_TYPES[c] for c in signature]
            function.restype = c_int32
            setattr(self, name, function)
        self.objects = _library.lm_objects
        self.objects.restype = c_uint64
        self.measure_of_size = _library.lm_measure_of_size
        self.measure_of_size.argtypes = [c_int32, c_double]
        self.measure_of_size.restype = c_double
        _library.lm_version.restype = c_char_p
        self.version: str = _library.lm_version().decode()

    def __getattr__(self, name: str) -> Any:  # for those who read types: what __init__ sets
        raise AttributeError(name)


c = _Functions()
if _library.lm_abi_version() != ABI_VERSION:
    raise ImportError(f"{_library_path()} has version {_library.lm_abi_version()} of the C "
                      f"interface, not {ABI_VERSION}")


def check(status: int, dimension: int = 3) -> None:
    """Raises what a status says. dimension: that of the positions of an error."""
    if status == 0:
        return
    error = Error(ctypes.sizeof(Error))
    c.last_error(byref(error))
    features = [(error.feature_kinds[i], error.feature_ids[i]) for i in range(error.features)]
    at = np.array([error.at[i] for i in range(3 * error.places)]).reshape(-1, 3)[:, :dimension]
    raise_error(status, error.name.decode(), error.message.decode(errors="replace"), features, at,
                error.file.decode(errors="replace"), error.line)


_free = c.free


class Handle:
    """An object of the library; freed with the last reference to it. Copies of what has it share
    it, for it is not changed through them; nothing is pickled."""

    __slots__ = ("value", "__weakref__")

    def __init__(self, value: int) -> None:
        self.value = value

    def __copy__(self) -> "Handle":
        return self

    def __deepcopy__(self, _: Any) -> "Handle":
        return self

    def __reduce_ex__(self, _: Any) -> NoReturn:
        raise TypeError("objects of livemesh cannot be pickled; write them to a file")

    def __del__(self, free: Callable[[int], Any] = _free) -> None:
        free(self.value)  # which an interpreter that ends has no name for any more


def new(function: Callable[..., int], *arguments: Any) -> Handle:
    """The object that a function makes; its last parameter is where the handle goes."""
    value = c_uint64()
    check(function(*arguments, byref(value)))
    return Handle(value.value)


# --- Arrays --------------------------------------------------------------------------------------

_TYPE_CODES = ("<f8", "<i8", "<u4", "|u1")


class _Memory:
    """What NumPy keeps as the base of an array: it keeps the owner of the memory."""

    __slots__ = ("__array_interface__", "owner")

    def __init__(self, interface: dict[str, Any], owner: Any) -> None:
        self.__array_interface__ = interface
        self.owner = owner


def array(function: Callable[..., int], handle: Handle, field: int) -> NDArray[Any]:
    """An array of the library's memory, without a copy, read-only; it keeps `handle` alive."""
    a = ArrayStruct(ctypes.sizeof(ArrayStruct))
    check(function(handle.value, field, byref(a)))
    code = _TYPE_CODES[a.type]
    shape: Tuple[int, ...] = (a.rows,) if a.columns == 1 else (a.rows, a.columns)
    if a.rows == 0:
        return np.empty(shape, code)
    strides = (a.stride,) if a.columns == 1 else (a.stride, int(code[2]))
    return np.asarray(_Memory({"version": 3, "shape": shape, "typestr": code,
                               "data": (a.data, True), "strides": strides}, handle))


def numbers(values: Any, what: str) -> NDArray[np.float64]:
    """C-contiguous float64 of any shape. Raises: TypeError."""
    try:
        a = np.asarray(values)
        if a.dtype.kind in "biufO":
            return np.ascontiguousarray(a, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{what} must be an array of numbers: {error}") from None
    raise TypeError(f"{what} must be an array of real numbers, not of {a.dtype}")


def _rows(a: NDArray[Any], columns: Optional[int], what: str) -> NDArray[Any]:
    """n or n x columns; one row may come without its axis. Raises: ValueError."""
    if columns is not None and a.ndim == 1 and a.size == columns:
        a = a.reshape(1, columns)
    if a.ndim != (1 if columns is None else 2) or (columns is not None and a.shape[1] != columns):
        want = "n" if columns is None else f"n x {columns}"
        raise ValueError(f"{what} has the shape {a.shape}, not {want}")
    return a


def floats(values: Any, columns: Optional[int], what: str) -> NDArray[np.float64]:
    """C-contiguous float64, n or n x columns. Raises: TypeError, ValueError."""
    a = numbers(values, what)
    if columns is not None and a.size == 0:
        a = a.reshape(0, columns)
    return _rows(a, columns, what)


def integers(values: Any, columns: Optional[int], what: str) -> NDArray[np.int64]:
    """C-contiguous int64, likewise."""
    a = np.asarray(values)
    if a.dtype == np.int64 and columns is None and a.ndim == 1 and a.flags.c_contiguous:
        return a
    if a.size == 0:
        a = a.astype(np.int64).reshape((0,) if columns is None else (0, columns))
    if a.dtype.kind not in "iu" or (a.dtype == np.uint64 and a.size and int(a.max()) > 2**63 - 1):
        raise TypeError(f"{what} must be an array of integers, not of {a.dtype}")
    a = np.ascontiguousarray(a, dtype=np.int64)
    return _rows(a, columns, what)


def integer(value: Any, what: str, least: int = -2**63, most: int = 2**63 - 1) -> int:
    """A number that a parameter of the library can be: ctypes would take it modulo 2^64. Raises:
    TypeError, ValueError."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{what} must be an integer, not {type(value).__name__}") from None
    if not least <= number <= most:
        raise ValueError(f"{what} is {number}, not one of {least} to {most}")
    return number


def dimension_of(value: Any) -> int:
    return integer(value, "dimension", 0, 3)


def path_of(path: Union[str, "os.PathLike[str]"]) -> bytes:
    """The name of a file. Raises: TypeError, ValueError."""
    name = os.fsencode(path)
    if b"\0" in name:  # where it would end to the library
        raise ValueError("the name of a file has a null character")
    return name


def text_of(text: str) -> bytes:
    """A name of a group. Raises: TypeError, ValueError."""
    if not isinstance(text, str):
        raise TypeError(f"a name must be a str, not {type(text).__name__}")
    name = text.encode()
    if b"\0" in name:
        raise ValueError("a name has a null character")
    return name


def one_each(values: Any, n: int, what: str) -> Optional[NDArray[Any]]:
    """n integers, from one for all or one for each; None stays None."""
    if values is None:
        return None
    a = np.full(n, integer(values, what)) if isinstance(values, int) else np.asarray(values)
    if a.ndim == 0:
        a = np.full(n, a)
    a = integers(a, None, what)
    if len(a) != n:
        raise ValueError(f"{what} has {len(a)} elements, not {n}")
    return a


def address(a: Optional[NDArray[Any]]) -> Optional[int]:
    return None if a is None else a.__array_interface__["data"][0]


def texts(handle: Handle) -> list[str]:
    count = c_size_t()
    check(c.text_count(handle.value, byref(count)))
    text = c_char_p()
    found = []
    for i in range(count.value):
        check(c.text_get(handle.value, i, byref(text)))
        found.append((text.value or b"").decode(errors="replace"))
    return found


# --- Runs ----------------------------------------------------------------------------------------


class Progress:
    """How far a run is: `phase` ("quadtree", "steiner", "triangulate", "update"), `done` steps of
    the phase, and `of` that are known to be needed (0: not known)."""

    __slots__ = ("phase", "done", "of")
    PHASES = ("quadtree", "steiner", "triangulate", "update")

    def __init__(self, phase: int, done: int, of: int) -> None:
        self.phase = self.PHASES[phase]
        self.done = done
        self.of = of

    def __repr__(self) -> str:
        return f"Progress(phase={self.phase!r}, done={self.done}, of={self.of})"


class Run:
    """A call of the library that can be stopped: by a function, a timeout, or Ctrl-C.

    An exception in a callback stops the run, and leaves it. Ctrl-C is noted by a handler that
    raises nothing, for an exception must not begin in the middle of a callback; after the run, the
    former handler gets it.
    """

    __slots__ = ("progress", "error", "interrupt", "_former", "_outer")

    def __init__(self, progress: Optional[Callable[[Progress], Any]] = None) -> None:
        self.progress = progress
        self.error: Optional[BaseException] = None
        self.interrupt: Optional[tuple[int, Optional[FrameType]]] = None

    def __enter__(self) -> "Run":
        self._outer = _active.run
        _active.run = self
        _running.add(self)
        self._former = None
        if self._outer is None and threading.get_ident() == _MAIN_THREAD:
            former = _get_handler(_SIGINT)
            if callable(former):
                self._former = former
                _set_handler(_SIGINT, self._note)
        return self

    def __exit__(self, *_: Any) -> None:
        _active.run = self._outer
        _running.discard(self)
        if self._former is not None:
            _set_handler(_SIGINT, self._former)

    def _note(self, number: int, frame: Optional[FrameType]) -> None:
        self.interrupt = (number, frame)

    def check(self, status: int, dimension: int) -> None:
        """Raises what has stopped the run, or the error of its status."""
        if self.error is not None:
            raise self.error
        if self.interrupt is not None and self._former is not None:
            self._former(*self.interrupt)  # raises KeyboardInterrupt, by default
        check(status, dimension)


class _Active(threading.local):
    run: Optional[Run] = None


_active = _Active()
_running: set[Run] = set()
_SIGINT = int(_signals.SIGINT)
# The functions behind those of the module, which turn numbers into enumerators, for 10 us a run.
_plain = sys.modules.get("_signal", _signals)
_get_handler: Callable[[int], Any] = _plain.getsignal
_set_handler: Callable[[int, Any], Any] = _plain.signal
_MAIN_THREAD = threading.main_thread().ident


def _watch_run(state: Any, _: Any) -> int:
    run = _active.run
    if run is None or run.interrupt is not None or run.error is not None:
        return 1
    if run.progress is None:
        return 0
    try:
        s = state[0]
        go_on = run.progress(Progress(s.phase, s.done, s.of))
        return 1 if go_on is not None and not go_on else 0
    except BaseException as error:  # carried over the C interface, and raised behind it
        run.error = error
        return 1


_watch = PROGRESS(_watch_run)
_end = new(c.stop_new)  # stops the runs of daemon threads when the interpreter ends


@atexit.register
def _stop_all() -> None:
    """An interpreter that has ended cannot be called back: wait until nobody will."""
    c.stop_request(_end.value)
    until = time.monotonic() + 5
    while _running and time.monotonic() < until:
        time.sleep(.001)


_INTERVAL = 0.02  # seconds between callbacks: an answer to Ctrl-C is soon enough, and GIL is free
_WATCHED = Control(ctypes.sizeof(Control), _watch, None, _INTERVAL, 0.0, _end.value)
_WATCHED_ADDRESS = ctypes.addressof(_WATCHED)


def seconds_of(timeout: float) -> float:
    """Raises: TypeError, ValueError."""
    if not timeout >= 0:
        raise ValueError("timeout must be 0 or above")
    return float(timeout)


def control(run: Run, timeout: Optional[float]) -> tuple[int, Any]:
    """The address of a control for this run, and what to keep meanwhile."""
    if timeout is None and run.progress is None:
        return _WATCHED_ADDRESS, _WATCHED
    seconds = 0.0 if timeout is None else max(seconds_of(timeout), 1e-9)  # 0: none to the library
    made = Control(ctypes.sizeof(Control), _watch, None, 0.0 if run.progress else _INTERVAL,
                   seconds, _end.value)
    return ctypes.addressof(made), made


def size_callback(function: Callable[[NDArray[Any]], Any], dimension: int) -> Any:
    """A size function of one position at a time. What it raises stops the run."""

    def at(position: Any, _: Any) -> float:
        run = _active.run
        try:
            if run is not None and run.error is not None:
                return float("nan")
            return float(np.asarray(function(np.array([position[:dimension]]))).reshape(-1)[0])
        except BaseException as error:
            if run is not None:
                run.error = error
            return float("nan")

    return SIZE(at)
