"""Delaunay meshes of good quality that follow edits of their input.

>>> import livemesh as lm
>>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
>>> m = lm.mesh(square, polylines=[[0, 1, 2, 3, 0]], min_angle=28, max_area=0.01)
>>> bool(m.quality("min_angle").min() >= 28)
True

`mesh` makes a `Mesh` once; a `LiveMesh` follows edits. Lengths are in the units of the input,
angles in degrees. Points and cells are numbered from 0.
"""
from . import _c
from ._c import Progress
from ._errors import Busy, Cancelled, Error, Feature, FileError, GeometryError
from ._graph import Graph
from ._live import Change, Compact, LiveMesh
from ._mesh import Finding, Mesh, PeriodicSides, mesh
from ._sizes import Sizes
from ._view import View

__version__: str = _c.c.version
NO_CELL: int = _c.NONE

__all__ = ["Busy", "Cancelled", "Change", "Compact", "Error", "Feature", "FileError", "Finding",
           "GeometryError", "Graph", "LiveMesh", "Mesh", "NO_CELL", "PeriodicSides",
           "Progress", "Sizes", "View", "mesh"]
