"""What livemesh uses of pyvista, which Debian 12 does not have: surfaces, grids that look at what
they are given as those of pyvista do, and accessors as in pyvista 0.48."""
import numpy as np

__version__ = "0.48.0"
CORNERS = {5: 3, 10: 4, 22: 6, 24: 10}  # of kinds of cells of VTK


class PolyData:
    """points: n x 3, kept as float32 by default; faces: k, then k numbers of points, and so on."""

    def __init__(self, points, faces):
        self.points = np.asarray(points, np.float32)
        self.faces = np.asarray(faces, np.int64)


class Part(PolyData):
    """A subclass, which has the accessors, too."""


class UnstructuredGrid:
    def __init__(self, cells, points):
        ((self.kind, rows),) = cells.items()
        self.points = np.asarray(points)
        if self.points.ndim != 2 or self.points.shape[1] != 3:
            raise ValueError("points must be n x 3")
        if rows.ndim != 2 or rows.shape[1] != CORNERS[self.kind] or rows.dtype.kind != "i":
            raise ValueError("cells do not fit their kind")
        if rows.min() < 0 or rows.max() >= len(self.points):
            raise ValueError("a cell has a point that is not there")
        self.cells = rows
        self.cell_data, self.point_data = _Data(len(rows)), _Data(len(self.points))

    def plot(self, **options):
        return options


class _Data(dict):
    def __init__(self, rows):
        super().__init__()
        self.rows = rows

    def __setitem__(self, name, values):
        if len(values) != self.rows:
            raise ValueError(f"{name} has {len(values)} rows, not {self.rows}")
        super().__setitem__(name, values)


class _Accessor:
    """Made at the first access of an instance, and kept in it."""

    def __init__(self, name, made):
        self.name, self.made = name, made

    def __get__(self, instance, owner):
        if instance is None:
            return self.made
        instance.__dict__[self.name] = made = self.made(instance)
        return made


def register_dataset_accessor(name, target_cls, *, override=False):
    if hasattr(target_cls, name) and not override:
        raise ValueError(f"{name} is an attribute already")

    def register(accessor):
        setattr(target_cls, name, _Accessor(name, accessor))
        return accessor

    return register
