"""What can go wrong. Programming mistakes raise TypeError or ValueError, running out of memory
MemoryError."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, List, NamedTuple, NoReturn, Tuple

import numpy as np
from numpy.typing import NDArray

_KINDS = ("none", "point", "line", "polygon", "hole", "region")
_FILE_CODES = frozenset(("wrong_count", "truncated", "bad_number", "bad_header", "bad_syntax",
                         "unsupported", "bad_mesh", "unknown_format", "cannot_read",
                         "cannot_write"))


class Feature(NamedTuple):
    """A part of the input. kind: "point", "line" (a segment or polyline), "polygon", "hole" or
    "region"; id: its number."""

    kind: str
    id: int


class Error(Exception):
    """Base of the errors of this package. code: a word, such as "crossing_segments"."""

    def __init__(self, message: str, code: str = "") -> None:
        super().__init__(message)
        self.code = code


class GeometryError(Error, ValueError):
    """Input that cannot be meshed.

    code: a word, such as "crossing_segments"; features: the parts of the input concerned, the one
    at fault first; at: k x d, their positions, where known; file and line: where they are in a
    file, or "" and 0.
    """

    def __init__(self, message: str, code: str = "", features: Sequence[Feature] = (),
                 at: Any = None, file: str = "", line: int = 0) -> None:
        super().__init__(message, code)
        self.features: List[Feature] = list(features)
        self.at: NDArray[Any] = np.empty((0, 0)) if at is None else at
        self.file = file
        self.line = line


class FileError(GeometryError):
    """A file that cannot be read or written, or is not what it should be."""


class Cancelled(Error):
    """A run was stopped by its progress function or its timeout; everything is as before."""


class Busy(Error, RuntimeError):
    """An object was used while another thread, or a caller further up, is changing it."""


def raise_error(status: int, name: str, message: str, features: Sequence[Tuple[int, int]],
                at: NDArray[Any], file: str, line: int) -> NoReturn:
    if name == "out_of_memory":
        raise MemoryError("out of memory in livemesh")
    if name == "cancelled":
        raise Cancelled(message, name)
    if name == "busy":
        raise Busy(message, name)
    if status < 100:
        raise (RuntimeError if name == "internal" else ValueError)(message)
    where = f"{file}:{line}: " if line else f"{file}: " if file else ""
    kind = FileError if name in _FILE_CODES else GeometryError
    raise kind(where + message, name, [Feature(_KINDS[k], i) for k, i in features], at, file, line)
