"""What users of the package `triangle` write: triangulate(dict(vertices=..., ...), "pq30a0.1").

The vertices of the input come first, in their order, as Triangle has them; the mesh is another one.
Departures: without "q", triangles may be very thin but there may be new vertices; vertices without
segments, and "c", are meshed to their convex hull; the bound on angles is at most 29.6 degrees,
which "q30" gets with a warning. Boundary edges have the marker 1, as in Triangle.
"""
from __future__ import annotations

import re
import warnings
from collections.abc import Mapping
from typing import Any, Dict, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from .._c import NONE
from .._graph import Graph
from .._mesh import Mesh, mesh

_SWITCHES = re.compile(r"p|q(\d*\.?\d*)|a(\d*\.?\d*)|A|e|n|c|z|Q|D|i|j")
_LOOSE_RHO = 100.0  # no bound to speak of
_LARGEST_ANGLE = 29.6  # degrees: the largest bound with which meshes are known to end


def _parse(opts: str) -> Dict[str, str]:
    given: Dict[str, str] = {}
    at = 0
    while at < len(opts):
        found = _SWITCHES.match(opts, at)
        if found is None:
            raise ValueError(f"switch {opts[at:]!r} is not supported")
        given[opts[at]] = found.group(1) or found.group(2) or ""
        at = found.end()
    return given


def _hull(points: NDArray[Any]) -> NDArray[Any]:
    """The numbers of the points on the convex hull, counterclockwise, those on its sides
    included."""
    order = np.lexsort((points[:, 1], points[:, 0]))

    def half(numbers: NDArray[Any]) -> list[int]:
        chain: list[int] = []
        for i in numbers:
            while len(chain) > 1:
                (ax, ay), (bx, by), (x, y) = points[chain[-2]], points[chain[-1]], points[i]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0:
                    break
                chain.pop()
            chain.append(int(i))
        return chain[:-1]

    return np.array(half(order) + half(order[::-1]))


def _renumbered(m: Mesh, count: int) -> NDArray[Any]:
    """For each point of the mesh its number with the input's first."""
    ids = m.point_ids
    number = np.where(ids >= 0, ids, 0)
    new = np.flatnonzero(ids < 0)
    number[new] = count + np.arange(len(new))
    return number


def _min_angle(text: str) -> Optional[float]:
    """Of q with this number. Triangle takes more degrees than we do, and may then not end."""
    angle = float(text or 20)
    if angle > _LARGEST_ANGLE:
        warnings.warn(f"q{text}: the bound on angles is {_LARGEST_ANGLE} degrees, the largest that "
                      "livemesh takes; angles may be below what was asked for", stacklevel=3)
        return _LARGEST_ANGLE
    return angle or None


def triangulate(tri: Mapping[str, Any], opts: str = "") -> Dict[str, NDArray[Any]]:
    """tri: "vertices" n x 2, and perhaps "segments" s x 2, "holes" h x 2, "regions" r x 4 (x, y,
    attribute, area), "vertex_markers", "segment_markers".

    opts: p (segments count), q or q28 (smallest angle, 20 by default, 29.6 at most), a0.1 (largest
    area), a (that of regions), A (attributes of regions), c (the convex hull is meshed), e (edges),
    n (neighbors). z, Q, D, i, j say what is the case anyway.

    Warns: UserWarning, if q asks for more than 29.6 degrees; the bound is then 29.6.

    Returns a dict with "vertices", "triangles", "vertex_markers", and what the switches ask for.

    >>> square = dict(vertices=[(0, 0), (1, 0), (1, 1), (0, 1)],
    ...               segments=[(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> t = triangulate(square, "pq28a0.01")
    >>> t["vertices"][:2].tolist(), len(t["triangles"]) > 100
    ([[0.0, 0.0], [1.0, 0.0]], True)
    """
    switches = _parse(opts)
    points = np.asarray(tri["vertices"], dtype=np.float64)
    segments = np.asarray(tri.get("segments", ()), dtype=np.int64).reshape(-1, 2)
    markers = tri.get("segment_markers")
    marks = (np.zeros(len(segments), np.int64) if markers is None
             else np.asarray(markers, dtype=np.int64).reshape(-1))
    if "p" not in switches:
        segments, marks = segments[:0], marks[:0]
    if "p" not in switches or "c" in switches:
        hull = _hull(points)
        segments = np.concatenate((segments, np.column_stack((hull, np.roll(hull, -1)))))
        marks = np.concatenate((marks, np.ones(len(hull), np.int64)))
    vertex_markers = tri.get("vertex_markers")
    graph = Graph(points, segments=segments, segment_markers=marks,
                  holes=tri.get("holes") if "p" in switches else None,
                  regions=tri.get("regions") if "p" in switches else None,
                  point_markers=None if vertex_markers is None
                  else np.asarray(vertex_markers, dtype=np.int64).reshape(-1))
    if "p" not in switches or "c" in switches:
        graph = graph.repaired()  # sides of the hull may overlap segments, or pass by points
    angle = _min_angle(switches["q"]) if "q" in switches else None
    area: Optional[float] = float(switches["a"]) if switches.get("a") else None
    m = mesh(graph, min_angle=angle, rho=None if angle else _LOOSE_RHO, max_area=area,
             region_limits=switches.get("a") == "")
    return _result(m, len(points), points, tri, switches)


def _result(m: Mesh, count: int, points: NDArray[Any], tri: Mapping[str, Any],
            switches: Mapping[str, str]) -> Dict[str, NDArray[Any]]:
    number = _renumbered(m, count)
    inside = number[number < count]
    vertices = np.empty((max(count, int(number.max(initial=-1)) + 1), 2))
    vertices[:count] = points  # those in holes are in no triangle, but keep their numbers
    vertices[number] = m.points
    markers = np.zeros((len(vertices), 1), np.int32)
    markers[number, 0] = m.point_markers
    found: Dict[str, NDArray[Any]] = {
        "vertices": vertices, "vertex_markers": markers,
        "triangles": number[m.cells].astype(np.int32)}
    del inside
    if "p" in switches:
        found["segments"] = number[m.facets].astype(np.int32)
        found["segment_markers"] = m.facet_markers.astype(np.int32).reshape(-1, 1)
        for name in ("holes", "regions"):
            if name in tri:
                found[name] = np.asarray(tri[name], dtype=np.float64)
    if "A" in switches:
        found["triangle_attributes"] = m.cell_regions.reshape(-1, 1).copy()
    if "n" in switches:
        found["neighbors"] = np.where(m.neighbors == NONE, -1, m.neighbors.astype(np.int64))
    if "e" in switches:
        found["edges"], found["edge_markers"] = _edges(m, number)
    return found


def _edges(m: Mesh, number: NDArray[Any]) -> Tuple[NDArray[Any], NDArray[Any]]:
    sides = np.sort(m.cells[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).astype(np.int64), axis=1)
    edges = np.unique(sides, axis=0)
    size = len(m.points)
    keys = edges[:, 0] * size + edges[:, 1]
    facets = np.sort(m.facets.astype(np.int64), axis=1)
    markers = np.zeros((len(edges), 1), np.int32)
    markers[np.searchsorted(keys, facets[:, 0] * size + facets[:, 1]), 0] = m.facet_markers
    return number[edges].astype(np.int32), markers
