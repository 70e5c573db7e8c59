"""Graphs: the input of a mesh, from arrays, files, geometries and surfaces."""
from __future__ import annotations

import ctypes
import json
import os
import tempfile
from collections.abc import Sequence
from ctypes import byref, c_int32, c_int64
from typing import Any, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _c
from ._c import address, c, check, dimension_of, floats, integers, numbers, one_each, path_of

_SURFACES = (".off", ".stl", ".ply", ".obj")


class Graph:
    """Points, and what is between them: in the plane lines, in space also polygons.

    points: n x 2 or n x 3, input length units; a point's number is its row. segments: s x 2 numbers
    of points. polylines: sequences of numbers; closed if the last is the first. polygons (in
    space): sequences of 3 or more numbers, or an array f x k; a polygon with holes is a sequence
    of such loops, the outer one first. holes: h x d positions; what encloses them is not meshed.
    regions: rows of a position, an attribute, and perhaps the largest area (volume) of a cell, 0
    for none. Markers are integers, one for all or one for each; 0 is none.

    >>> g = Graph([(0, 0), (1, 0), (1, 1)], polylines=[[0, 1, 2, 0]], polyline_markers=7)
    >>> g.dimension, len(g.points)
    (2, 3)
    """

    def __init__(self, points: Any, *, segments: Any = None, segment_markers: Any = None,
                 polylines: Optional[Sequence[Any]] = None, polyline_markers: Any = None,
                 polygons: Any = None, polygon_markers: Any = None, holes: Any = None,
                 regions: Any = None, point_markers: Any = None) -> None:
        at = numbers(points, "points")
        if at.ndim != 2 or at.shape[1] not in (2, 3):
            raise ValueError(f"points has the shape {at.shape}, not n x 2 or n x 3")
        self.dimension = int(at.shape[1])
        self._handle = _c.new(c.graph_new, self.dimension)
        at = floats(at, self.dimension, "points")
        markers = one_each(point_markers, len(at), "point_markers")
        self._call(c.graph_add_points, len(at), address(at), None, address(markers), None)
        if segments is not None:
            ends = integers(segments, 2, "segments")
            marks = one_each(segment_markers, len(ends), "segment_markers")
            self._call(c.graph_add_segments, len(ends), address(ends), None, address(marks), None)
        self._add_polylines(polylines, polyline_markers)
        self._add_polygons(polygons, polygon_markers)
        if holes is not None:
            places = floats(holes, self.dimension, "holes")
            self._call(c.graph_add_holes, len(places), address(places), None, None)
        if regions is not None:
            places, attributes, limits = split_regions(regions, self.dimension)
            self._call(c.graph_add_regions, len(places), address(places), address(attributes),
                       address(limits), None, None)

    @classmethod
    def _of(cls, handle: _c.Handle) -> "Graph":
        graph = cls.__new__(cls)
        graph._handle = handle
        dimension = c_int32()
        check(c.graph_dimension(handle.value, byref(dimension)))
        graph.dimension = dimension.value
        return graph

    def _call(self, function: Any, *arguments: Any) -> None:
        check(function(self._handle.value, *arguments), self.dimension)

    def _add_polylines(self, polylines: Optional[Sequence[Any]], markers: Any) -> None:
        if polylines is None:
            return
        marks = one_each(markers, len(polylines), "polyline_markers")
        for i, line in enumerate(polylines):
            corners = integers(line, None, f"polylines[{i}]")
            self._call(c.graph_add_polyline, len(corners), address(corners), None,
                       0 if marks is None else int(marks[i]), None)

    def _add_polygons(self, polygons: Any, markers: Any) -> None:
        if polygons is None:
            return
        marks = one_each(markers, len(polygons), "polygon_markers")
        if isinstance(polygons, np.ndarray) and polygons.ndim == 2:
            corners = integers(polygons, polygons.shape[1], "polygons")
            sizes = np.full(len(corners), corners.shape[1], np.uintp)
            self._call(c.graph_add_faces, len(corners), address(sizes), address(corners), None,
                       address(marks), None)
            return
        for i, polygon in enumerate(polygons):
            keep, struct = polygon_struct(polygon, 0 if marks is None else int(marks[i]))
            self._call(c.graph_add_polygon, byref(struct), None, None)
            del keep

    # --- Files and repairs -----------------------------------------------------------------------

    @classmethod
    def read(cls, path: Union[str, "os.PathLike[str]"], dimension: int = 0,
             points_alone: bool = False) -> "Graph":
        """The graph in a file: .poly, .node, .geojson, .obj, .vtu, .xyz, .csv, in space also
        .smesh, .off, .ply, .stl, .vtk. dimension: 2, 3, or 0: that of the file. points_alone:
        whether only the vertices of a surface are read. Ids are those of the file."""
        return cls._of(_c.new(c.graph_read, path_of(path), dimension_of(dimension), int(points_alone)))

    def write(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes .poly, in the plane also .obj, in space .smesh: whole, or not at all."""
        self._call(c.graph_write, path_of(path))

    def repaired(self, tolerance: Optional[float] = None) -> "Graph":
        """A graph whose lines and polygons meet only at common points, from one where they cross,
        touch or overlap. Its `notes` say what was done.

        tolerance: what is closer is made to touch; 0: what rounding does not tell apart; None: 0,
        in space 2**-20 of the side of the meshing box."""
        at = None if tolerance is None else byref(ctypes.c_double(tolerance))
        return Graph._of(_c.new(c.graph_repair, self._handle.value, None, at))

    def merged(self) -> "Graph":
        """In space: adjacent polygons of one plane and one marker are one polygon."""
        return Graph._of(_c.new(c.graph_merge, self._handle.value))

    @property
    def notes(self) -> list[str]:
        """What a repair did, or what of a file is not used; sentences."""
        return _c.texts(self._handle)

    # --- Arrays: copies, since a graph may grow --------------------------------------------------

    def _array(self, field: int) -> NDArray[Any]:
        return _c.array(c.graph_array, self._handle, field).copy()

    @property
    def points(self) -> NDArray[np.float64]:
        """n x d float64, input length units."""
        return self._array(0)

    @property
    def point_ids(self) -> NDArray[np.int64]:
        """n int64."""
        return self._array(1)

    @property
    def point_markers(self) -> NDArray[np.int64]:
        """n int64; 0: none."""
        return self._array(2)

    @property
    def segments(self) -> NDArray[np.int64]:
        """s x 2 int64: ids of points."""
        return self._array(3).reshape(-1, 2)

    @property
    def segment_markers(self) -> NDArray[np.int64]:
        """s int64."""
        return self._array(5)

    @property
    def polylines(self) -> list[NDArray[Any]]:
        """Arrays of ids of points."""
        return np.split(self._array(7), self._array(6)[1:-1]) if len(self._array(8)) else []

    @property
    def polyline_markers(self) -> NDArray[np.int64]:
        """l int64."""
        return self._array(9)

    @property
    def polygons(self) -> list[list[NDArray[Any]]]:
        """For each polygon its loops, arrays of ids of points."""
        loops = np.split(self._array(12), self._array(11)[1:-1])
        ends = self._array(10)
        return [loops[ends[i]:ends[i + 1]] for i in range(len(ends) - 1)]

    @property
    def polygon_markers(self) -> NDArray[np.int64]:
        """p int64."""
        return self._array(14)

    @property
    def holes(self) -> NDArray[np.float64]:
        """h x d float64."""
        return self._array(15).reshape(-1, self.dimension)

    @property
    def regions(self) -> NDArray[np.float64]:
        """r x (d + 2) float64: position, attribute, and limit (0: none)."""
        at = self._array(17).reshape(-1, self.dimension)
        return np.column_stack((at, self._array(19), self._array(20)))

    def __repr__(self) -> str:
        return f"<Graph: {len(self._array(1))} points in {self.dimension}D>"


def split_regions(regions: Any, dimension: int) -> Tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Positions, attributes and limits of rows that may leave out the latter two."""
    rows = [list(r) for r in regions]
    for r in rows:
        if not dimension <= len(r) <= dimension + 2:
            raise ValueError(f"a region has {len(r)} numbers, not {dimension} to {dimension + 2}")
        r.extend([0.0] * (dimension + 2 - len(r)))
    all_ = floats(rows, dimension + 2, "regions")
    return (np.ascontiguousarray(all_[:, :dimension]), np.ascontiguousarray(all_[:, dimension]),
            np.ascontiguousarray(all_[:, dimension + 1]))


def polygon_struct(polygon: Any, marker: int, inner_edges: Any = (),
                   inner_points: Any = ()) -> Tuple[Any, _c.Polygon]:
    """A polygon for the C interface, and what to keep meanwhile."""
    is_loop = len(polygon) == 0 or np.ndim(polygon[0]) == 0
    loops = [integers(loop, None, "a loop") for loop in ([polygon] if is_loop else polygon)]
    sizes = np.array([len(loop) for loop in loops], np.uintp)
    points = np.concatenate(loops)
    edges = np.array(inner_edges, np.int64).reshape(-1, 2)
    inner = np.array(inner_points, np.int64)
    struct = _c.Polygon(ctypes.sizeof(_c.Polygon), len(loops), address(sizes), address(points),
                        len(edges), address(edges), len(inner), address(inner), marker)
    return (sizes, points, edges, inner), struct


# --- Geometries of others ------------------------------------------------------------------------


def graph_of(source: Any, merge: bool = True, **parts: Any) -> Graph:
    """The graph of anything that mesh() takes."""
    given = {name: value for name, value in parts.items() if value is not None}
    if isinstance(source, Graph):
        found = source
    elif isinstance(source, (str, os.PathLike)):
        found = Graph.read(source)
        if found.dimension == 3 and merge and os.fspath(source).lower().endswith(_SURFACES):
            found = found.merged()
    elif hasattr(source, "__geo_interface__") or (isinstance(source, dict) and "type" in source):
        found = _geometry(getattr(source, "__geo_interface__", source))
    elif hasattr(source, "faces") and (hasattr(source, "points") or hasattr(source, "vertices")):
        surface: Any = source
        at = surface.points if hasattr(surface, "points") else surface.vertices
        found = _surface(at, surface.faces, merge, given)
    elif isinstance(source, tuple) and len(source) == 2 and np.ndim(source[0]) == 2:
        found = _surface(source[0], source[1], merge, given)
    else:
        return Graph(source, **given)
    if given:
        raise TypeError(f"with this input, {', '.join(given)} cannot be given too")
    return found


def _geometry(geometry: Any) -> Graph:
    """By the reader of GeoJSON: rings that share borders, holes and regions are its matter."""
    path = ""
    try:
        with tempfile.NamedTemporaryFile("w", suffix=".geojson", delete=False) as file:
            path = file.name
            json.dump(geometry, file, default=_plain)
        return Graph.read(path, 2)
    finally:
        if path:
            os.unlink(path)


def _plain(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if hasattr(value, "__geo_interface__"):
        return value.__geo_interface__
    return str(value)


def _surface(points: Any, faces: Any, merge: bool, given: dict[str, Any]) -> Graph:
    """points: n x 3; faces: f x k numbers, a list of them, or as VTK has them: k, then k
    numbers."""
    at = floats(points, 3, "points")
    corners: Any = faces if isinstance(faces, list) else np.asarray(faces)
    if isinstance(corners, np.ndarray) and corners.ndim == 1:
        flat, corners, i = integers(corners, None, "faces"), [], 0
        while i < len(flat):
            if flat[i] < 3 or i + 1 + flat[i] > len(flat):
                raise ValueError("faces is not a list of counts and numbers of points")
            corners.append(flat[i + 1:i + 1 + flat[i]])
            i += 1 + int(flat[i])
    if isinstance(corners, list) and len({len(face) for face in corners}) == 1:
        corners = np.asarray(corners)
    markers = given.pop("polygon_markers", None)
    parts = {name: given.pop(name) for name in ("holes", "regions") if name in given}
    graph = Graph(at, polygons=corners, polygon_markers=markers, **parts)
    return graph.merged() if merge else graph
