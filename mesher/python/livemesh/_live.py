"""Meshes that follow edits."""
from __future__ import annotations

import ctypes
import math
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from ctypes import byref, c_int64, c_uint64
from types import TracebackType
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, NoReturn, Optional, Tuple, Type

import numpy as np
from numpy.typing import NDArray

from . import _c
from ._c import Handle, address, c, check, floats, integer, integers, numbers, one_each
from ._errors import Busy
from ._graph import Graph, graph_of, polygon_struct, split_regions
from ._mesh import Mesh, options_of
from ._sizes import Sizes, sizes_of
from ._view import Limit, View

_FIELDS = {"points": 0, "point_kinds": 1, "cells": 2, "neighbors": 3, "point_used": 4,
           "cell_used": 5, "cell_kept": 6, "facets": 7, "facet_ids": 9, "facet_used": 10}
# By field: the lists of a change that name the slots that are different after it.
_DIRTY = {"points": ("points_added",), "point_kinds": ("points_added", "points_changed"),
          "cells": ("all_cells_added",), "neighbors": ("all_cells_added",),
          "point_used": ("points_added", "points_removed"),
          "cell_used": ("all_cells_added", "all_cells_removed"),
          "cell_kept": ("cells_added", "cells_removed"), "facets": ("facets_added",),
          "facet_ids": ("facets_added",), "facet_used": ("facets_added", "facets_removed")}
_MOST_UNSEEN = 256  # changes that arrays have not followed yet; beyond, arrays are copied anew


class Compact(NamedTuple):
    """A mesh without free slots: points n x d, cells m x (d + 1), slot_of n (by point)."""

    points: NDArray[np.float64]
    cells: NDArray[np.uint32]
    slot_of: NDArray[np.uint32]


class Change:
    """What an update did, in slots. Its arrays are the library's memory, read-only; they never
    change and stay valid for as long as they are referenced.

    A slot is the number of a point or a cell for as long as it exists. Points are those of the mesh
    of the box; `cells_added` and `cells_removed` are of the enclosed part, the lists that begin
    with `all_` of the whole box. Inside a `with d.edit() as c`, `c` is empty.
    """

    def __init__(self) -> None:
        self._handle: Optional[Handle] = None
        self._slots: Optional[Tuple[int, int]] = None  # before and after

    def _array(self, field: int) -> NDArray[Any]:
        if self._handle is None:
            raise ValueError("the change is not there yet: the edits are not made")
        return _c.array(c.change_array, self._handle, field)

    @property
    def points_added(self) -> NDArray[np.uint32]:
        """k uint32."""
        return self._array(0)

    @property
    def points_removed(self) -> NDArray[np.uint32]:
        """k uint32. Their slots become free at the next update."""
        return self._array(1)

    @property
    def points_changed(self) -> NDArray[np.uint32]:
        """k uint32: points that stay, with another kind."""
        return self._array(12)

    @property
    def all_cells_added(self) -> NDArray[np.uint32]:
        """k uint32, in the whole box."""
        return self._array(2)

    @property
    def all_cells_removed(self) -> NDArray[np.uint32]:
        """k uint32, in the whole box."""
        return self._array(3)

    @property
    def cells_added(self) -> NDArray[np.uint32]:
        """k uint32: cells that are enclosed now, and were not there or not enclosed before."""
        return self._array(4)

    @property
    def cells_removed(self) -> NDArray[np.uint32]:
        """k uint32: cells that were enclosed before, and are not there or not enclosed now."""
        return self._array(5)

    @property
    def facets_added(self) -> NDArray[np.uint32]:
        """k uint32: edges (in space faces) on lines (polygons)."""
        return self._array(6)

    @property
    def facets_removed(self) -> NDArray[np.uint32]:
        """k uint32."""
        return self._array(7)

    @property
    def added_at(self) -> NDArray[np.float64]:
        """k x d float64: the positions of points_added."""
        return self._array(10)

    @property
    def removed_at(self) -> NDArray[np.float64]:
        """k x d float64: the positions that points_removed had."""
        return self._array(11)

    @property
    def weights(self) -> Tuple[NDArray[Any], NDArray[Any]]:
        """k x (d + 1) uint32 and float64: for each of points_added, the points of the mesh before
        around it and their weights, with sum 1. 2^32 - 1 and 0 if there was no mesh before."""
        return self._array(8), self._array(9)

    @property
    def _info(self) -> _c.ChangeInfo:
        if self._handle is None:
            raise ValueError("the change is not there yet: the edits are not made")
        info = _c.ChangeInfo(ctypes.sizeof(_c.ChangeInfo))
        check(c.change_describe(self._handle.value, byref(info)))
        return info

    def _point_slots(self) -> Tuple[int, int]:
        if self._slots is None:
            info = self._info
            self._slots = (int(info.point_slots_before), int(info.point_slots))
        return self._slots

    @property
    def point_slots_before(self) -> int:
        """The length of arrays by point slot before the update."""
        return self._point_slots()[0]

    @property
    def point_slots(self) -> int:
        """The length of arrays by point slot after the update."""
        return self._point_slots()[1]

    def transfer(self, u: Any) -> NDArray[Any]:
        """Carries a field by point slots through the change: points that stay keep their values,
        new ones get values interpolated in the mesh before. u: n or n x k numbers (made float64,
        or complex128), where n is point_slots_before; or point_slots, of which the rows of new
        points are written.

        Costs what changed: `u` is changed in place and returned if it is writeable and has room,
        else a larger array is returned, with room for more, so write `u = c.transfer(u)`.

        Raises: ValueError for another n, so that no change of a sequence is left out unnoticed.
        """
        slots_before, slots = self._point_slots()
        before = np.asarray(u)
        if before.dtype.kind not in "biufc":
            raise TypeError(f"a field has numbers, not {before.dtype}")
        if before.ndim == 0:
            raise ValueError("a field has a row for each point slot; this is a single number")
        rows = len(before)
        if rows not in (slots_before, slots):
            raise ValueError(f"the field has {rows} rows; there were {slots_before} point slots "
                             f"before the update, and are {slots} after it")
        kind = np.complex128 if before.dtype.kind == "c" else np.float64
        before = np.ascontiguousarray(before, dtype=kind)
        after = _with_rows(before, slots)
        columns = math.prod(after.shape[1:]) * (2 if kind is np.complex128 else 1)
        assert self._handle is not None
        if columns > 0:
            check(c.change_transfer(self._handle.value, columns, address(after), rows,
                                    address(after), len(after)))
        return after

    def __repr__(self) -> str:
        if self._handle is None:
            return "<Change: not made yet>"
        return (f"<Change: {len(self.points_added)} points and {len(self.cells_added)} cells "
                f"added, {len(self.points_removed)} and {len(self.cells_removed)} removed>")


if TYPE_CHECKING:
    _Array = NDArray[Any]
else:
    _Array = np.ndarray


class _Room(_Array):
    """The memory behind a result of _with_rows: nothing else is in it."""


def _beginning(room: _Room, rows: int) -> NDArray[Any]:
    return np.ndarray((rows,) + room.shape[1:], room.dtype, buffer=room)  # its base: `room`


def _with_rows(u: NDArray[Any], rows: int) -> NDArray[Any]:
    """`u` with at least so many rows: itself, more of the room that was left behind it, or a copy
    with some room behind it. A part of a larger array has no room, nor has what is read-only."""
    if u.flags.writeable:
        if len(u) >= rows:
            return u
        room = u.base
        if (isinstance(room, _Room) and room.dtype == u.dtype and room.shape[1:] == u.shape[1:]
                and address(room) == address(u) and len(room) >= rows):
            return _beginning(room, rows)
    wanted = max(rows, len(u))
    room = _Room((wanted * 5 // 4 + 16,) + u.shape[1:], u.dtype)
    room[:len(u)] = u
    return _beginning(room, wanted)


class _Followed:
    """A copy of an array of the library that follows changes at their cost."""

    def __init__(self, field: str) -> None:
        self.field = field
        self.memory: Optional[NDArray[Any]] = None
        self.rows = 0

    def refresh(self, raw: NDArray[Any], changes: Sequence[Change]) -> None:
        if self.memory is None or len(self.memory) < len(raw):
            self.memory = np.empty((len(raw) * 5 // 4 + 16,) + raw.shape[1:], raw.dtype)
            self.memory[:len(raw)] = raw
        else:
            self.memory[self.rows:len(raw)] = raw[self.rows:]
            for change in changes:
                self._follow(raw, change)
        self.rows = len(raw)

    def _follow(self, raw: NDArray[Any], change: Change) -> None:
        assert self.memory is not None
        for name in _DIRTY[self.field]:
            slots = getattr(change, name)
            self.memory[slots] = raw[slots]
            if self.field == "neighbors" and len(slots):
                beside = raw[slots].ravel()
                beside = beside[beside != _c.NONE]
                self.memory[beside] = raw[beside]

    def view(self) -> NDArray[Any]:
        assert self.memory is not None
        shown = self.memory[:self.rows]
        shown.flags.writeable = False
        return shown


class LiveMesh:
    """A mesh that follows edits of its input, at the cost of the change.

    bounds: 2 x d, the box in which points may lie, now and later. The other options are those of
    `mesh`. undo: how many updates can be undone. threads: the mesh
    is made and updated on so many threads (at most 256); it is that of one.

    Edits (`add_...`, `move`, `remove_...`) are announced; `update` makes all of them, or raises,
    and none is made. Points, lines (segments and polylines), polygons, holes and regions have ids,
    consecutive numbers by default. A mesh may be used by several threads in turn; a call while
    another one runs raises `Busy`.

    Arrays by slot (`points`, `cells`, ...) are copies that follow changes at their cost. What was
    returned shows the state of its time or a later one, and never becomes invalid: ask again after
    an update. Free slots show what they held last; `point_used` and `cell_used` tell them.

    >>> d = LiveMesh(bounds=((0, 0), (4, 4)), min_angle=28)
    >>> p = d.add_points([(0, 0), (4, 0), (4, 4), (0, 4), (1, 1), (2, 1)])
    >>> wall = d.add_polyline([0, 1, 2, 3, 0], marker=9)
    >>> len(d.update().points_added) == d.point_used.sum()
    True
    >>> with d.edit() as change:
    ...     d.move(p[4:], [(1.5, 1.5), (2.5, 1.5)])
    >>> len(change.points_removed) > 0
    True
    """

    def __init__(self, bounds: Any, *, min_angle: Optional[float] = None,
                 rho: Optional[float] = None, min_dihedral: Optional[float] = None,
                 max_area: Optional[float] = None, max_volume: Optional[float] = None,
                 size: Any = None, region_limits: bool = True, extent: str = "enclosed",
                 max_vertices: int = 0, undo: int = 32, threads: int = 1) -> None:
        box = numbers(bounds, "bounds")
        if box.ndim != 2 or box.shape not in ((2, 2), (2, 3)):
            raise ValueError(f"bounds has the shape {box.shape}, not 2 x 2 or 2 x 3")
        self.dimension = int(box.shape[1])
        self.bounds = box
        options, sizes = options_of(self.dimension, box[0], box[1], box, min_angle, rho,
                                    min_dihedral, max_area, max_volume, size, region_limits,
                                    max_vertices, extent, "automatic")
        options.threads = integer(threads, "threads", 1, 256)
        self._sizes: List[Optional[Sizes]] = [sizes]  # callbacks live as long as they may be called
        # For views: the limits of size, everywhere and then in boxes, those announced, and the
        # options of the command line tool.
        self._limits = [Limit(float(options.max_measure), sizes, None)]
        self._limits_announced: List[Limit] = []
        self._tool_options = [
            word for name, value in (("--min-angle", min_angle),
                                     ("--rho", None if min_angle else rho),
                                     ("--min-dihedral", min_dihedral),
                                     ("--max-vertices", max_vertices or None),
                                     ("--threads", threads if threads > 1 else None))
            if value is not None for word in (name, repr(value))]
        self._tool_options += ["--region-areas"] if region_limits else []
        self._tool_options += ["--box"] if extent == "box" else []
        self._handle = _c.new(c.live_new, self.dimension, byref(options))
        self._value = self._handle.value
        check(c.live_keep_undo(self._value, integer(undo, "undo", 0, sys.maxsize)))
        self._lock = threading.Lock()
        self._arrays: Dict[str, _Followed] = {}
        self._unseen: List[Change] = []

    def __reduce_ex__(self, _: Any) -> NoReturn:
        raise TypeError("a LiveMesh cannot be copied or pickled; graph() and mesh() are copies")

    @contextmanager
    def _alone(self) -> Iterator[None]:
        if not self._lock.acquire(blocking=False):
            raise Busy("the mesh is in use: by another thread, or by the call that called back",
                       "busy")
        try:
            yield
        finally:
            self._lock.release()

    def _call(self, function: Any, *arguments: Any) -> None:
        if not self._lock.acquire(blocking=False):
            raise Busy("the mesh is in use: by another thread, or by the call that called back",
                       "busy")
        try:
            status = function(self._value, *arguments)
        finally:
            self._lock.release()
        if status:
            check(status, self.dimension)

    # --- Edits -----------------------------------------------------------------------------------

    def _ids(self, ids: Any, n: int, what: str) -> Optional[NDArray[Any]]:
        if ids is None:
            return None
        return one_each([ids] if isinstance(ids, int) else np.atleast_1d(ids), n, what)

    def _named(self, function: Any, n: int, ids: Optional[NDArray[Any]],
               *arguments: Any) -> NDArray[Any]:
        """Adds n features; their ids."""
        if ids is not None:
            self._call(function, n, *arguments, None)
            return ids
        first = c_int64()
        self._call(function, n, *arguments, byref(first))
        return np.arange(first.value, first.value + n)

    def add_points(self, points: Any, ids: Any = None, markers: Any = None) -> NDArray[np.int64]:
        """Announces points, n x d, input length units. Returns their ids, n int64."""
        at = floats(points, self.dimension, "points")
        named = self._ids(ids, len(at), "ids")
        marks = one_each(markers, len(at), "markers")
        return self._named(c.live_add_points, len(at), named, address(at), address(named),
                           address(marks))

    def move(self, ids: Any, points: Any) -> None:
        """Announces that points move. ids: n; points: n x d. Points may swap positions."""
        at = floats(points, self.dimension, "points")
        named = np.ascontiguousarray(one_each(np.atleast_1d(ids), len(at), "ids"))
        self._call(c.live_move_points, len(at), address(named), address(at))

    def _remove(self, function: Any, ids: Any) -> None:
        named = integers(np.atleast_1d(ids), None, "ids")
        self._call(function, len(named), address(named))

    def remove_points(self, ids: Any) -> None:
        """Announces that points go; no line may end at them."""
        self._remove(c.live_remove_points, ids)

    def add_segments(self, ends: Any, ids: Any = None, markers: Any = None) -> NDArray[np.int64]:
        """Announces segments, n x 2 ids of points. Returns their ids, n int64."""
        pairs = integers(ends, 2, "ends")
        named = self._ids(ids, len(pairs), "ids")
        marks = one_each(markers, len(pairs), "markers")
        return self._named(c.live_add_segments, len(pairs), named, address(pairs), address(named),
                           address(marks))

    def add_segment(self, start: int, end: int, marker: int = 0, id: Optional[int] = None) -> int:
        """Announces a segment between two points. Returns its id."""
        return int(self.add_segments([(start, end)], None if id is None else [id], marker)[0])

    def add_polyline(self, points: Any, marker: int = 0, id: Optional[int] = None) -> int:
        """Announces a line through points, by ids; closed if the last is the first. Returns its id;
        lines and segments are numbered together."""
        corners = integers(points, None, "points")
        added, wanted = c_int64(), c_int64(0 if id is None else integer(id, "id"))
        self._call(c.live_add_polyline, len(corners), address(corners),
                   None if id is None else byref(wanted), integer(marker, "marker"), byref(added))
        return added.value

    def remove_lines(self, ids: Any) -> None:
        """Announces that segments and polylines go."""
        self._remove(c.live_remove_lines, ids)

    def add_polygon(self, loops: Any, marker: int = 0, id: Optional[int] = None) -> int:
        """Announces a flat polygon in space: ids of points around it, or a sequence of such loops,
        the outer one first. Returns its id."""
        keep, struct = polygon_struct(loops, integer(marker, "marker"))
        added, wanted = c_int64(), c_int64(0 if id is None else integer(id, "id"))
        self._call(c.live_add_polygon, byref(struct), None if id is None else byref(wanted),
                   byref(added))
        del keep
        return added.value

    def remove_polygons(self, ids: Any) -> None:
        """Announces that polygons go."""
        self._remove(c.live_remove_polygons, ids)

    def add_holes(self, points: Any, ids: Any = None) -> NDArray[Any]:
        """Announces holes: what lines (polygons) enclose around these positions, n x d, is not
        meshed. Returns their ids."""
        at = floats(points, self.dimension, "points")
        named = self._ids(ids, len(at), "ids")
        return self._named(c.live_add_holes, len(at), named, address(at), address(named))

    def remove_holes(self, ids: Any) -> None:
        """Announces that holes are filled."""
        self._remove(c.live_remove_holes, ids)

    def add_regions(self, regions: Any, ids: Any = None) -> NDArray[Any]:
        """Announces regions: rows of a position, an attribute, and perhaps the largest area
        (volume) of a cell. Returns their ids."""
        at, attributes, limits = split_regions(regions, self.dimension)
        named = self._ids(ids, len(at), "ids")
        return self._named(c.live_add_regions, len(at), named, address(at), address(attributes),
                           address(limits), address(named))

    def remove_regions(self, ids: Any) -> None:
        """Announces that the marks of regions go."""
        self._remove(c.live_remove_regions, ids)

    def add(self, source: Any, **parts: Any) -> None:
        """Announces all of what `mesh` takes, with its ids; a failure discards all
        announcements."""
        graph = graph_of(source, **parts)
        self._call(c.live_add_graph, graph._handle.value)

    def limit(self, *, max_area: Optional[float] = None, max_volume: Optional[float] = None,
              size: Any = None, box: Any = None) -> None:
        """Announces limits of size in place of all earlier ones; in a box, 2 x d, if it is
        given."""
        place = None if box is None else floats(box, self.dimension, "box")
        if place is not None and place.shape != (2, self.dimension):
            raise ValueError(f"box has the shape {place.shape}, not 2 x {self.dimension}")
        lo, hi = self.bounds if place is None else place
        if (max_area if self.dimension == 3 else max_volume) is not None:
            raise TypeError("max_area is for the plane, max_volume for space")
        limit, sizes = sizes_of(size, lo, hi)
        given = max_area if self.dimension == 2 else max_volume
        largest = limit if given is None else float(given)
        self._call(c.live_limit, largest, 0 if sizes is None else sizes._handle.value,
                   address(place))
        self._sizes.append(sizes)
        self._limits_announced.append(
            Limit(largest, sizes, None if place is None else tuple(place.ravel().tolist())))

    def discard(self) -> None:
        """Discards all announcements."""
        self._call(c.live_discard)
        self._limits_announced.clear()

    # --- Updates ---------------------------------------------------------------------------------

    def _run(self, function: Any, progress: Optional[Callable[[_c.Progress], Any]],
             timeout: Optional[float], change: Change) -> Change:
        value = c_uint64()
        if not self._lock.acquire(blocking=False):
            raise Busy("the mesh is in use: by another thread, or by the call that called back",
                       "busy")
        try:
            with _c.Run(progress) as run:
                at_control, keep = _c.control(run, timeout)
                status = function(self._value, at_control, byref(value))
                if value.value:
                    self._take_limits()
                    change._handle = Handle(value.value)
                    if self._arrays:
                        self._remember(change)
                elif status:
                    self._drop_limits_discarded()
                    run.check(status, self.dimension)
                else:
                    self._take_limits()
                    self._arrays.clear()
                    self._unseen.clear()
                    raise MemoryError("the edits were made; there is no memory for their change")
                if run.error is not None or run.interrupt is not None:
                    run.check(0, self.dimension)
                del keep
        finally:
            self._lock.release()
        return change

    def _take_limits(self) -> None:
        """Limits that were announced are those of now."""
        for limit in self._limits_announced:
            if limit.box is None:
                self._limits.clear()
            self._limits.append(limit)
        self._limits_announced.clear()

    def _drop_limits_discarded(self) -> None:
        info = _c.LiveInfo(ctypes.sizeof(_c.LiveInfo))
        if c.live_describe(self._value, byref(info)) == 0 and not info.pending:
            self._limits_announced.clear()

    def _limits_now(self) -> Tuple[Limit, ...]:
        return tuple(self._limits)

    def _remember(self, change: Change) -> None:
        self._unseen.append(change)
        if len(self._unseen) > _MOST_UNSEEN:
            self._arrays.clear()
            self._unseen.clear()

    def update(self, progress: Optional[Callable[[_c.Progress], Any]] = None,
               timeout: Optional[float] = None) -> Change:
        """Makes the announced edits. progress: called with a `Progress`; the update stops if it
        returns False. timeout: seconds.

        Raises: Cancelled, KeyboardInterrupt, or what `progress` raises: the mesh is as before, and
        the edits stay announced for another update or discard(). GeometryError, MemoryError: the
        mesh is as before, and the edits are discarded. A Ctrl-C that comes when the edits are made
        leaves them made; `pending` tells.
        """
        return self._run(c.live_update, progress, timeout, Change())

    def undo(self, progress: Optional[Callable[[_c.Progress], Any]] = None,
             timeout: Optional[float] = None) -> Change:
        """Undoes the last update that is not undone yet, except for limits of size. Requires: no
        announced edits. Raises: ValueError if there is none; as update, but discards the edits."""
        return self._run(c.live_undo, progress, timeout, Change())

    @property
    def undoable(self) -> int:
        """How many updates can be undone."""
        return int(self._info.undoable)

    def edit(self, progress: Optional[Callable[[_c.Progress], Any]] = None,
             timeout: Optional[float] = None) -> "Edit":
        """A batch: `with d.edit() as change:` makes the edits of its block at its end, all or
        none. An exception in the block, or in the update, discards them. Raises: ValueError if
        edits are announced already."""
        return Edit(self, progress, timeout)

    # --- What there is ---------------------------------------------------------------------------

    @property
    def _info(self) -> _c.LiveInfo:
        info = _c.LiveInfo(ctypes.sizeof(_c.LiveInfo))
        self._call(c.live_describe, byref(info))
        return info

    @property
    def pending(self) -> bool:
        """Whether edits are announced."""
        return bool(self._info.pending)

    def _array(self, field: str) -> NDArray[Any]:
        with self._alone():
            wanted = self._arrays.get(field)
            if wanted is None:
                wanted = self._arrays[field] = _Followed(field)
                wanted.refresh(_c.array(c.live_array, self._handle, _FIELDS[field]), ())
            if self._unseen:
                for each in self._arrays.values():
                    each.refresh(_c.array(c.live_array, self._handle, _FIELDS[each.field]),
                                 self._unseen)
                self._unseen.clear()
            return wanted.view()

    @property
    def points(self) -> NDArray[np.float64]:
        """n x d float64 by point slot, input length units."""
        return self._array("points")

    @property
    def point_kinds(self) -> NDArray[np.uint8]:
        """n uint8 by point slot, as in Mesh."""
        return self._array("point_kinds")

    @property
    def cells(self) -> NDArray[np.uint32]:
        """m x (d + 1) uint32 by cell slot: slots of points, in the whole box."""
        return self._array("cells")

    @property
    def neighbors(self) -> NDArray[np.uint32]:
        """m x (d + 1) uint32 by cell slot: slots of the cells across from the corners, or
        `NO_CELL`."""
        return self._array("neighbors")

    @property
    def point_used(self) -> NDArray[np.bool_]:
        """n bool by point slot: whether it is in use."""
        return self._array("point_used").view(bool)

    @property
    def cell_used(self) -> NDArray[np.bool_]:
        """m bool by cell slot."""
        return self._array("cell_used").view(bool)

    @property
    def cell_kept(self) -> NDArray[np.bool_]:
        """m bool by cell slot: whether it is in use, and lines (polygons) enclose it."""
        return self._array("cell_kept").view(bool)

    @property
    def facets(self) -> NDArray[np.uint32]:
        """f x d uint32 by facet slot: edges (in space faces) on lines (polygons)."""
        return self._array("facets")

    @property
    def facet_ids(self) -> NDArray[np.int64]:
        """f int64 by facet slot: the id of the line (polygon)."""
        return self._array("facet_ids")

    @property
    def facet_used(self) -> NDArray[np.bool_]:
        """f bool by facet slot."""
        return self._array("facet_used").view(bool)

    def regions_of(self, cells: Any) -> NDArray[np.float64]:
        """k float64: the attributes of the regions of cells, by slot; 0: none."""
        wide = integers(cells, None, "cells")
        if len(wide) and not 0 <= wide.min() <= wide.max() <= _c.NONE:
            raise ValueError("cells has what is not a slot")
        slots = np.ascontiguousarray(wide, dtype=np.uint32)
        found = np.empty(len(slots))
        self._call(c.live_regions, len(slots), address(slots), address(found))
        return found

    def find(self, points: Any) -> NDArray[np.uint32]:
        """n uint32: the slots of the points at positions, n x d; 2^32 - 1 where there is none."""
        at = floats(points, self.dimension, "points")
        slots = np.empty(len(at), np.uint32)
        self._call(c.live_find, len(at), address(at), address(slots))
        return slots

    def mesh(self) -> Mesh:
        """The enclosed part as a Mesh of its own, with `point_slots` and `cell_slots`."""
        with self._alone():
            return Mesh(_c.new(c.live_mesh, self._value))

    def graph(self) -> Graph:
        """The input as of the last update."""
        with self._alone():
            return Graph._of(_c.new(c.live_graph, self._value))

    def compact(self) -> Compact:
        """The enclosed part without free slots, for a solver: a field u by slots has the values
        u[slot_of] on it. Costs the mesh, not the change."""
        mesh = self.mesh()
        return Compact(mesh.points, mesh.cells, mesh.point_slots)

    def view(self, *, browser: bool = True, port: int = 0, tool: str = "mesher") -> View:
        """Opens a page in a browser where this mesh can be edited with the mouse: see `View`.

        browser: whether to open the address; `view().address` has it. port: of 127.0.0.1; 0: any
        that is free. tool: the command line tool `mesher`, a name or a path. Limits of size by
        `Sizes.function` and `Sizes.read` cannot be shown. Takes the time of a first run, on the
        input as of the last update.

        Raises: FileNotFoundError if there is no such tool; Error if it does not start; ValueError
        for limits of size that cannot be shown.
        """
        return View(self, tool, integer(port, "port", 0, 65535), browser)

    @property
    def faults(self) -> list[str]:
        """Holes and regions that have no part of the mesh of their own; sentences."""
        with self._alone():
            return _c.texts(self._handle)

    def __repr__(self) -> str:
        info = self._info
        return f"<LiveMesh: {info.points} points, {info.cells} cells in {self.dimension}D>"


class Edit:
    """The context manager of LiveMesh.edit()."""

    def __init__(self, live: LiveMesh, progress: Optional[Callable[[_c.Progress], Any]],
                 timeout: Optional[float]) -> None:
        self._live = live
        self._progress = progress
        self._timeout = timeout
        self._change = Change()

    def __enter__(self) -> Change:
        if self._live.pending:
            raise ValueError("edits are announced: update() or discard() them first")
        return self._change

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        if kind is not None:
            self._live.discard()
            return
        try:
            self._live._run(c.live_update, self._progress, self._timeout, self._change)
        except BaseException:
            self._live.discard()
            raise
