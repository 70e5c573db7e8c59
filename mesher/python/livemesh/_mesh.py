"""Meshes that are made once."""
from __future__ import annotations

import ctypes
import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from ctypes import byref, c_size_t, c_uint64
from typing import Any, NamedTuple, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _c
from ._c import Handle, address, c, check, dimension_of, integer, integers, path_of
from ._graph import Graph, graph_of
from ._sizes import Sizes, sizes_of

_ALGORITHMS = ("automatic", "refine", "svr", "gap_balls")
_EXTENTS = ("enclosed", "box")
_MEASURES = {"area": 0, "volume": 0, "measure": 0, "radius_edge": 1, "min_angle": 2,
             "max_angle": 3, "min_dihedral": 4, "max_dihedral": 5}
_NONE, _INPUT_POINT = _c.NONE, 1
_NAMED = ("facets", "edges", "cells")  # lm_name_kind
_MSH_VERSIONS = {"4.1": 41, "2.2": 22}


class Finding(NamedTuple):
    """One property that check() looked at: whether it holds, and the first violation."""

    property: str
    holds: bool
    detail: str


class PeriodicSides(NamedTuple):
    """Two sides that fit together. markers: of the first and of the second; translation: d float64,
    from the first to the second; points: k x 2 uint32, of the first and their twins."""

    markers: Tuple[int, int]
    translation: NDArray[np.float64]
    points: NDArray[np.uint32]


class Mesh:
    """Triangles, or tetrahedra. It never changes.

    Its arrays are the library's memory, not copies, and read-only; they stay valid for as long as
    they are referenced, even after the mesh. d is the dimension.

    Of second order (`order` is 2), `points` are followed by the midpoints of edges, which are
    straight, and `cells`, `facets` and `edges` have midpoints behind their corners, in the order of
    VTK: m x 6 or m x 10, f x 3 or f x 6, and e x 3.
    """

    def __init__(self, handle: Handle) -> None:
        self._handle = handle
        info = _c.MeshInfo(ctypes.sizeof(_c.MeshInfo))
        check(c.mesh_describe(handle.value, byref(info)))
        self.dimension: int = info.dimension
        self.algorithm: str = _ALGORITHMS[info.algorithm]
        self.encloses: bool = not info.keeps_all
        self.order: int = info.order
        self.names: dict[str, dict[str, Any]] = {kind: {} for kind in _NAMED}
        self._read_names()

    @classmethod
    def read(cls, path: Union[str, "os.PathLike[str]"], dimension: int = 0) -> "Mesh":
        """The mesh in a file: .node or .ele, .vtu, .vtk, .msh, .mesh, .off, .obj."""
        return cls(_c.new(c.mesh_read, path_of(path), dimension_of(dimension)))

    def _read_names(self) -> None:
        count = c_size_t()
        check(c.mesh_name_count(self._handle.value, byref(count)))
        name = _c.Name(ctypes.sizeof(_c.Name))
        for i in range(count.value):
            check(c.mesh_name_get(self._handle.value, i, byref(name)))
            kind = _NAMED[name.kind]
            number = _plain(name.region) if kind == "cells" else name.marker
            self.names[kind][name.name.decode(errors="replace")] = number

    def write(self, path: Union[str, "os.PathLike[str]"],
              version: Union[str, float] = "4.1") -> None:
        """Writes .node (with .ele and others beside it), .vtu, .vtk, .msh, .inp (Abaqus, CalculiX),
        .su2, .mesh, .off, .obj, .svg, in space also .stl: whole, or not at all. Names of groups go
        to .msh, .inp and .su2, those of faces in space to .stl and .obj; of several names of a
        number, the last. A mesh of second order goes to .msh, .inp, .vtu, .vtk and .node. version:
        of .msh, 4.1 or 2.2, a number or text."""
        msh_version = _MSH_VERSIONS.get(str(version))
        if msh_version is None:
            raise ValueError(f"version is {version!r}, not one of {', '.join(_MSH_VERSIONS)}")
        names = [(kind, {number: name for name, number in self.names[kind_name].items()})
                 for kind, kind_name in enumerate(_NAMED)]
        rows = [_c.Name(ctypes.sizeof(_c.Name), kind, 0, 0 if kind == 2 else number,
                        float(number) if kind == 2 else 0., _c.text_of(name))
                for kind, by_number in names for number, name in by_number.items()]
        array = (_c.Name * len(rows))(*rows)
        options = _c.WriteOptions(ctypes.sizeof(_c.WriteOptions), msh_version, 1, len(rows),
                                  ctypes.addressof(array))
        check(c.mesh_write_as(self._handle.value, path_of(path), byref(options)), self.dimension)

    def second_order(self) -> "Mesh":
        """The mesh with midpoints of edges, with the same names."""
        made = Mesh(_c.new(c.mesh_second_order, self._handle.value))
        made.names = {kind: dict(names) for kind, names in self.names.items()}
        return made

    def _array(self, field: int) -> NDArray[Any]:
        return _c.array(c.mesh_array, self._handle, field)

    @property
    def points(self) -> NDArray[np.float64]:
        """n x d float64, input length units, in lexicographic order."""
        return self._array(0)

    @property
    def cells(self) -> NDArray[np.uint32]:
        """m x (d + 1) uint32: numbers of points, positively oriented."""
        return self._array(1)

    @property
    def neighbors(self) -> NDArray[np.uint32]:
        """m x (d + 1) uint32: the cell across from each corner, `NO_CELL` (2^32 - 1) at the
        boundary."""
        return self._array(2)

    @property
    def point_kinds(self) -> NDArray[np.uint8]:
        """n uint8: 0 added by the mesher, 1 on the boundary grid, 2 of the input, 3 on a line."""
        return self._array(3)

    @property
    def point_markers(self) -> NDArray[np.int64]:
        """n int64: the marker of the point, or of the line or polygon that it is on; 0: none."""
        return self._array(4)

    @property
    def point_ids(self) -> NDArray[np.int64]:
        """n int64: the number of the input's point that it is; -1: none."""
        return np.where(self._array(5) == _INPUT_POINT, self._array(6), -1)

    @property
    def cell_regions(self) -> NDArray[np.float64]:
        """m float64: the attribute of the region; 0: none."""
        return self._array(7)

    @property
    def facets(self) -> NDArray[np.uint32]:
        """f x d uint32: edges (in space faces) on lines (polygons) of the input, and on the
        boundary."""
        return self._array(8)

    @property
    def facet_markers(self) -> NDArray[np.int64]:
        """f int64: of the line (polygon); 1 on the boundary without another."""
        return self._array(9)

    @property
    def facet_ids(self) -> NDArray[np.int64]:
        """f int64: the number of the line (polygon); -1: not known."""
        return np.where(self._array(10) != 0, self._array(11), -1)

    @property
    def edges(self) -> NDArray[np.uint32]:
        """e x 2 uint32: edges on lines; in the plane the facets."""
        return self._array(12)

    @property
    def edge_markers(self) -> NDArray[np.int64]:
        """e int64."""
        return self._array(13)

    @property
    def periodic(self) -> list[PeriodicSides]:
        """Of a mesh made with periodic sides, the pairs."""
        markers, by, ends, points = map(self._array, (18, 19, 20, 21))
        return [PeriodicSides((int(m[0]), int(m[1])), by[i, :self.dimension],
                              points[ends[i]:ends[i + 1]]) for i, m in enumerate(markers)]

    @property
    def point_slots(self) -> NDArray[np.uint32]:
        """n uint32: of a mesh from LiveMesh.mesh(), the slot of each point; else empty."""
        return self._array(16)

    @property
    def cell_slots(self) -> NDArray[np.uint32]:
        """m uint32: likewise of each cell."""
        return self._array(17)

    def quality(self, measure: str = "min_angle") -> NDArray[np.float64]:
        """m float64: one for each cell. measure: "min_angle", "max_angle" (degrees; of a
        tetrahedron those of its faces), "radius_edge" (circumradius over shortest edge), "area" or
        "volume", in space "min_dihedral", "max_dihedral" (degrees)."""
        if measure not in _MEASURES:
            raise ValueError(f"measure is {measure!r}, not one of {', '.join(_MEASURES)}")
        return _c.array(c.mesh_quality, self._handle, _MEASURES[measure])

    def check(self, graph: Optional[Graph] = None, rho: float = 0,
              max_measure: float = 0) -> list[Finding]:
        """Checks the mesh by means that share nothing with those that made it: is it a Delaunay
        mesh, does it have all of the graph, no cell with circumradius over shortest edge above rho
        (0: not checked), none larger than max_measure (0: not checked)?"""
        options = _c.CheckOptions(ctypes.sizeof(_c.CheckOptions),
                                  0 if graph is None else graph._handle.value, rho, max_measure,
                                  0, int(self.dimension == 3))
        count = c_size_t()
        value = c_uint64()
        check(c.mesh_check(self._handle.value, byref(options), byref(value), byref(count)))
        found = Handle(value.value)
        finding = _c.Finding(ctypes.sizeof(_c.Finding))
        findings = []
        for i in range(count.value):
            check(c.finding_get(found.value, i, byref(finding)))
            findings.append(Finding(finding.property.decode(), bool(finding.holds),
                                    finding.detail.decode(errors="replace")))
        return findings

    @property
    def faults(self) -> list[str]:
        """Holes and regions that have no part of the mesh of their own; sentences."""
        return _c.texts(self._handle)

    # --- Names, and the formats of others --------------------------------------------------------

    def name(self, facets: Optional[Mapping[str, int]] = None,
             cells: Optional[Mapping[str, float]] = None,
             edges: Optional[Mapping[str, int]] = None) -> "Mesh":
        """Names facets by their markers, cells by their regions, and in space edges by their
        markers, for write, to_meshio, facets_named and cells_named. A name has no blanks, and is
        that of one group. Returns the mesh."""
        self.names["facets"].update({name: int(v) for name, v in (facets or {}).items()})
        self.names["edges"].update({name: int(v) for name, v in (edges or {}).items()})
        self.names["cells"].update({name: _plain(v) for name, v in (cells or {}).items()})
        return self

    def facets_named(self, name: str) -> NDArray[np.uint32]:
        """k x d uint32: the facets with that name."""
        named: NDArray[np.uint32] = self.facets[self.facet_markers == self.names["facets"][name]]
        return named

    def cells_named(self, name: str) -> NDArray[Any]:
        """Numbers of the cells with that name."""
        return np.flatnonzero(self.cell_regions == self.names["cells"][name])

    def to_meshio(self) -> Any:
        """A meshio.Mesh: cells and facets, with the cell data "region" and "marker" and
        "gmsh:physical", and names as field data."""
        import meshio  # type: ignore[import]

        kinds = _MESHIO[self.dimension, self.order]
        blocks = [(kinds[0], self.cells), (kinds[1], self.facets)]
        regions = self.cell_regions.astype(np.int64)
        markers = np.asarray(self.facet_markers)
        data = {"region": [np.asarray(self.cell_regions), np.zeros(len(markers))],
                "marker": [np.zeros(len(regions), np.int64), markers],
                "gmsh:physical": [regions, markers]}
        fields = {}
        for kind, dimension in (("cells", self.dimension), ("facets", self.dimension - 1)):
            for name, value in self.names[kind].items():
                fields[name] = np.array([value, dimension])
        return meshio.Mesh(np.asarray(self.points), blocks, cell_data=data, field_data=fields,
                           point_data={"marker": np.asarray(self.point_markers)})

    def to_pyvista(self) -> Any:
        """A pyvista.UnstructuredGrid of the cells, with the cell data "region" and the point data
        "marker"."""
        import pyvista  # type: ignore[import]

        points = np.zeros((len(self.points), 3))
        points[:, :self.dimension] = self.points
        kind = _VTK[self.dimension, self.order]
        grid = pyvista.UnstructuredGrid({kind: self.cells.astype(np.int64)}, points)
        grid.cell_data["region"] = np.asarray(self.cell_regions)
        grid.point_data["marker"] = np.asarray(self.point_markers)
        return grid

    def plot(self, values: Any = None, ax: Any = None, **options: Any) -> Any:
        """Draws triangles by matplotlib, coloured by `values` of points or cells, else by region;
        tetrahedra by pyvista. Returns what they return."""
        if self.dimension == 3:
            return self.to_pyvista().plot(scalars=values, show_edges=True, **options)
        import matplotlib.pyplot as pyplot  # type: ignore[import]

        ax = ax or pyplot.gca()
        ax.set_aspect("equal")
        x, y = self.points.T
        cells = self.cells[:, :3]  # of second order, too, edges are straight
        if values is None:
            ax.tripcolor(x, y, cells, facecolors=np.asarray(self.cell_regions),
                         edgecolors="k", linewidth=0.2, **options)
        else:
            ax.tripcolor(x, y, cells, np.asarray(values), **options)
        for edge in self.facets[:, :2]:
            ax.plot(x[edge], y[edge], color="k", linewidth=1)
        return ax

    def __repr__(self) -> str:
        cells = "triangles" if self.dimension == 2 else "tetrahedra"
        return f"<Mesh: {len(self.points)} points, {len(self.cells)} {cells}>"


# By dimension and order.
_MESHIO = {(2, 1): ("triangle", "line"), (2, 2): ("triangle6", "line3"),
           (3, 1): ("tetra", "triangle"), (3, 2): ("tetra10", "triangle6")}
_VTK = {(2, 1): 5, (2, 2): 22, (3, 1): 10, (3, 2): 24}


def _plain(region: float) -> Union[int, float]:
    number = float(region)
    return int(number) if number.is_integer() else number


def _at(values: Any, default: float, what: str) -> float:
    if values is None:
        return default
    number = float(values)
    if not number > 0 or not math.isfinite(number):
        raise ValueError(f"{what} must be above 0 and finite")
    return number


def _index(value: str, names: Sequence[str], what: str) -> int:
    if value not in names:
        raise ValueError(f"{what} is {value!r}, not one of {', '.join(names)}")
    return names.index(value)


def options_of(dimension: int, lo: NDArray[Any], hi: NDArray[Any], bounds: Any, min_angle: Any,
               rho: Any, min_dihedral: Any, max_area: Any, max_volume: Any, size: Any,
               region_limits: bool, max_vertices: int, extent: str, algorithm: str,
               deadline: float = math.inf) -> tuple[_c.Options, Optional[Sizes]]:
    """Options for the C interface, and the sizes that they refer to. lo, hi: the box for which a
    function is sampled, if there are no bounds. Raises: Cancelled at the deadline."""
    if dimension == 2 and (max_volume is not None or min_dihedral is not None):
        raise TypeError("max_volume and min_dihedral are for space; in the plane there is max_area")
    if dimension == 3 and max_area is not None:
        raise TypeError("max_area is for the plane; in space there is max_volume")
    options = _c.Options(ctypes.sizeof(_c.Options))
    if bounds is not None:
        box = _c.floats(bounds, dimension, "bounds")
        if box.shape != (2, dimension):
            raise ValueError(f"bounds has the shape {box.shape}, not 2 x {dimension}")
        options.domain_lo[:dimension] = list(box[0])
        options.domain_hi[:dimension] = list(box[1])
        if np.all(np.isfinite(box)) and np.all(box[0] < box[1]):  # else it is an error of the run
            lo, hi = box
    options.min_angle = _at(min_angle, 0, "min_angle")
    options.rho = _at(rho, 0, "rho")
    options.min_dihedral = _at(min_dihedral, 0, "min_dihedral")
    limit, sizes = sizes_of(size, lo, hi, deadline)
    if sizes is not None and sizes.dimension != dimension:
        raise ValueError(f"size is for {sizes.dimension} dimensions, not {dimension}")
    given = _at(max_area if dimension == 2 else max_volume, 0, "max_area or max_volume")
    options.max_measure = min(limit, given) if limit and given else limit or given
    options.sizes = 0 if sizes is None else sizes._handle.value
    options.max_vertices = integer(max_vertices, "max_vertices", 0)
    options.region_limits = int(region_limits)
    options.extent = _index(extent, _EXTENTS, "extent")
    options.algorithm = _index(algorithm, _ALGORITHMS, "algorithm")
    return options, sizes


def mesh(source: Any, *, segments: Any = None, segment_markers: Any = None,
         polylines: Optional[Sequence[Any]] = None, polyline_markers: Any = None,
         polygons: Any = None, polygon_markers: Any = None, holes: Any = None, regions: Any = None,
         point_markers: Any = None, min_angle: Optional[float] = None,
         rho: Optional[float] = None, min_dihedral: Optional[float] = None,
         max_area: Optional[float] = None, max_volume: Optional[float] = None, size: Any = None,
         growth: Optional[float] = None, periodic: Any = None, repair: bool = False,
         repair_tolerance: Optional[float] = None,
         merge: bool = True, region_limits: bool = True, no_flat: bool = True,
         extent: str = "enclosed", bounds: Any = None,
         algorithm: str = "automatic", order: int = 1,
         max_vertices: int = 0, out_of_core: Union[None, str, "os.PathLike[str]"] = None, tiles: int = 0, threads: int = 1,
         progress: Optional[Callable[[_c.Progress], Any]] = None,
         timeout: Optional[float] = None) -> Mesh:
    """Meshes what lines (in space polygons) enclose; if they enclose nothing, a box around it.

    source: points, n x 2 or n x 3, with segments, polylines, polygons, holes, regions and markers
    as in `Graph`; or a Graph; the name of a file; anything with a `__geo_interface__` (shapely,
    geopandas, a GeoJSON dict); or a surface: (points, faces), or an object with these (pyvista,
    trimesh). Faces of one plane are merged, unless merge is false.

    min_angle: degrees, at most 29.6, 20.7 by default; or rho: bound of circumradius over shortest
    edge. max_area, max_volume: of a cell. size: the edge length of a cell: a number, a function of
    n x d arrays (sampled), (points, sizes), or `Sizes`. region_limits: whether the limits of
    regions count. periodic, in the plane: pairs of markers of lines; those of the second are
    those of the first, moved, and so are their meshes: see `Mesh.periodic`. growth: sizes grow
    by at most this factor from one cell to the next, 1.05 to 100. no_flat: in space, tetrahedra
    without volume, which Delaunay meshes have, are removed where that is possible. extent:
    "enclosed" or "box". bounds: 2 x d, the box in which points may lie. algorithm: "automatic",
    "refine", "svr", "gap_balls". max_vertices: more are an error. order: 2 for a mesh of second
    order, see `Mesh`.

    out_of_core: a folder, for more points than memory holds: points alone are meshed in tiles, that
    many, by default one for each 10^6 points (in space 5 10^5), on so many threads. The mesh is
    that of "gap_balls". A run that was stopped or killed goes on from what it has left there.

    repair: lines and polygons may cross, touch and overlap; repair_tolerance: see
    `Graph.repaired`. progress: called with a `Progress`; the run stops if it returns False.
    timeout: seconds. Ctrl-C stops it, too.

    Raises: GeometryError, Cancelled, MemoryError.

    >>> m = mesh([(0, 0), (1, 0), (1, 1), (0, 1)], polylines=[[0, 1, 2, 3, 0]], max_area=0.01)
    >>> m.dimension, m.cells.shape[1], bool(m.quality("min_angle").min() > 20.7)
    (2, 3, True)
    """
    if order not in (1, 2):
        raise ValueError(f"order is {order!r}, not 1 or 2")
    graph = graph_of(source, merge, segments=segments, segment_markers=segment_markers,
                     polylines=polylines, polyline_markers=polyline_markers, polygons=polygons,
                     polygon_markers=polygon_markers, holes=holes, regions=regions,
                     point_markers=point_markers)
    if repair:
        graph = graph.repaired(repair_tolerance)
    lo = hi = np.zeros(graph.dimension)
    if callable(size) and not isinstance(size, Sizes):
        at = graph.points
        if len(at):
            lo, hi = at.min(0), at.max(0)
    deadline = math.inf if timeout is None else time.monotonic() + _c.seconds_of(timeout)
    # Before the run: an exception, by Ctrl-C too, may leave a function of the program at any time.
    options, sizes = options_of(graph.dimension, lo, hi, bounds, min_angle, rho, min_dihedral,
                                max_area, max_volume, size, region_limits, max_vertices, extent,
                                algorithm, deadline)
    options.growth = _at(growth, 0, "growth")
    options.no_flat = int(no_flat)
    pairs = None if periodic is None else integers(periodic, 2, "periodic")
    if pairs is not None and graph.dimension == 3:
        raise ValueError("periodic sides are for the plane")
    options.periodic_count = 0 if pairs is None else len(pairs)
    options.periodic = address(pairs)
    options.tiles = integer(tiles, "tiles", 0, 2**64 - 1)
    options.threads = integer(threads, "threads", 1, 256)
    if out_of_core is not None:
        options.out_of_core = path_of(out_of_core)
    elif tiles != 0 or threads != 1:
        raise ValueError("tiles and threads are for out_of_core")
    if timeout is not None:
        timeout = max(deadline - time.monotonic(), 0.)
    with _c.Run(progress) as run:
        at_control, keep = _c.control(run, timeout)
        value = c_uint64()
        status = c.mesh_make(graph._handle.value, byref(options), at_control, byref(value))
        made = Handle(value.value) if status == 0 else None
        run.check(status, graph.dimension)
        assert made is not None
        del keep, sizes, pairs
    return Mesh(made) if order == 1 else Mesh(made).second_order()
