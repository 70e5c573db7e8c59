"""Sizes that vary with position."""
from __future__ import annotations

import math
import os
import time
from collections.abc import Callable
from typing import Any, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _c
from ._c import address, c, dimension_of, floats, numbers, path_of
from ._errors import Cancelled

_MOST_SAMPLES = 200_000
_MOST_AT_A_TIME = 1 << 14  # positions: the deadline is looked at between calls of a function


class Sizes:
    """The size of cells, i.e. the edge length of the largest regular cell, by position.

    Made by one of the functions below; `mesh` and `LiveMesh` make one of a callable themselves.

    >>> s = Sizes.samples([(0, 0), (1, 0)], [0.1, 0.4])       # linear between the two
    >>> s = Sizes.function(lambda xy: 0.1 + 0.2 * xy[:, 0], slope=0.2, least=0.1, dimension=2)
    """

    def __init__(self, handle: _c.Handle, dimension: int, keep: Any = None,
                 samples: Optional[Tuple[NDArray[Any], NDArray[Any]]] = None) -> None:
        self._handle = handle
        self._samples = samples  # those that it was made of
        self._keep = keep  # a callback, for as long as the library may call it
        self.dimension = dimension

    def __copy__(self) -> "Sizes":
        return self

    def __deepcopy__(self, _: Any) -> "Sizes":
        return self

    @classmethod
    def samples(cls, points: Any, sizes: Any) -> "Sizes":
        """Linear between samples. points: n x d; sizes: n, above 0, input length units."""
        dimension = np.shape(points)[-1] if np.ndim(points) == 2 else 2
        at = floats(points, dimension, "points")
        h = floats(sizes, None, "sizes")
        if len(h) != len(at):
            raise ValueError(f"{len(at)} points, but {len(h)} sizes")
        return cls(_c.new(c.sizes_samples, dimension, len(at), address(at), address(h)), dimension,
                   samples=(at.copy(), h.copy()))

    @classmethod
    def function(cls, size: Callable[[NDArray[Any]], Any], slope: float, least: float,
                 dimension: int) -> "Sizes":
        """A function of a 1 x d array that is called at every position where the mesher wants to
        know: exact, and slow. It must always return the same, at least `least`, and change by at
        most `slope` per unit of length."""
        dimension = dimension_of(dimension)
        callback = _c.size_callback(size, dimension)
        handle = _c.new(c.sizes_function, dimension, callback, None, float(slope), float(least))
        return cls(handle, dimension, callback)

    @classmethod
    def sampled(cls, size: Callable[[NDArray[Any]], Any], lo: Any, hi: Any,
                tolerance: float = 0.05) -> "Sizes":
        """Samples of a function of n x d arrays, dense where it is not linear: between them the
        size is off by about `tolerance` of itself at most. lo, hi: corners of the box of
        interest."""
        return cls._sampled(size, floats(lo, None, "lo"), floats(hi, None, "hi"), tolerance)

    @classmethod
    def _sampled(cls, size: Callable[[NDArray[Any]], Any], lo: NDArray[Any], hi: NDArray[Any],
                 tolerance: float = 0.05, deadline: float = math.inf) -> "Sizes":
        return cls.samples(*_sample(size, lo, hi, tolerance, deadline))

    @classmethod
    def read(cls, path: Union[str, "os.PathLike[str]"], dimension: int) -> "Sizes":
        """Samples from a file: .node with one attribute, or .csv with x, y, (z,) h."""
        dimension = dimension_of(dimension)
        return cls(_c.new(c.sizes_read, path_of(path), dimension), dimension)


def _evaluate(size: Callable[[NDArray[Any]], Any], at: NDArray[Any],
              deadline: float) -> NDArray[Any]:
    h = np.empty(len(at))
    for i in range(0, len(at), _MOST_AT_A_TIME):
        if time.monotonic() >= deadline:
            raise Cancelled("the timeout is over", "cancelled")
        part = at[i:i + _MOST_AT_A_TIME]
        h[i:i + len(part)] = numbers(size(part), "a size").reshape(-1)
    if not np.all((h > 0) & np.isfinite(h)):
        raise ValueError(f"the size at {at[np.argmin((h > 0) & np.isfinite(h))]} is not above 0")
    return h


def _sample(size: Callable[[NDArray[Any]], Any], lo: NDArray[Any], hi: NDArray[Any],
            tolerance: float, deadline: float) -> Tuple[NDArray[Any], NDArray[Any]]:
    """Halves cells of a grid until the middle of each is near the mean of its corners, or it is
    smaller than its size. Raises: Cancelled at the deadline, by time.monotonic()."""
    dimension, finest = len(lo), 1 << 20
    side = float(np.max(hi - lo)) or 1.0
    step = finest // 8
    cells = np.stack(np.meshgrid(*[np.arange(8) * step] * dimension, indexing="ij"), -1)
    cells = cells.reshape(-1, dimension)
    corners = np.stack(np.meshgrid(*[[0, 1]] * dimension, indexing="ij"), -1)
    corners = corners.reshape(-1, dimension)
    nodes = np.empty((0, dimension), int)
    while len(cells) and step > 1:
        around = (cells[:, None, :] + corners * step).reshape(-1, dimension)
        nodes = np.unique(np.concatenate((nodes, around)), axis=0)
        if len(nodes) > _MOST_SAMPLES:
            break
        of_cells = _evaluate(size, lo + around * (side / finest), deadline).reshape(len(cells), -1)
        middle = _evaluate(size, lo + (cells + step / 2) * (side / finest), deadline)
        bends = np.abs(middle - of_cells.mean(1)) > tolerance * middle
        bends |= np.ptp(of_cells, axis=1) > 8 * tolerance * of_cells.min(1)
        bends &= step * (side / finest) > of_cells.min(1) / 2
        step //= 2
        cells = (cells[bends][:, None, :] + corners * step).reshape(-1, dimension)
    at = lo + nodes * (side / finest)
    return at, _evaluate(size, at, deadline)


def sizes_of(size: Any, lo: NDArray[Any], hi: NDArray[Any],
             deadline: float = math.inf) -> Tuple[float, Optional[Sizes]]:
    """What `size=` of mesh() means: the largest measure of a cell (0: no limit), and sizes. Raises:
    Cancelled at the deadline, by time.monotonic()."""
    if size is None:
        return 0.0, None
    if isinstance(size, Sizes):
        return 0.0, size
    if callable(size):
        return 0.0, Sizes._sampled(size, lo, hi, deadline=deadline)
    if isinstance(size, tuple) and len(size) == 2:
        return 0.0, Sizes.samples(*size)
    h = float(size)
    if not h > 0:
        raise ValueError("size must be above 0")
    return float(c.measure_of_size(len(lo), h)), None
