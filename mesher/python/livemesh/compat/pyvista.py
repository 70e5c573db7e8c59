"""The accessor `livemesh` of surfaces of pyvista, 0.48 or later.

To import this module registers it::

    import pyvista as pv
    import livemesh.compat.pyvista
    part = pv.read("part.stl").livemesh.mesh(max_volume=1e-4, min_dihedral=12)
"""
from __future__ import annotations

from typing import Any

import pyvista  # type: ignore[import]

from .._mesh import Mesh, mesh

if not hasattr(pyvista, "register_dataset_accessor"):
    raise ImportError(f"accessors need pyvista 0.48 or later, this is {pyvista.__version__}")


class SurfaceAccessor:
    """`surface.livemesh`, of a pyvista.PolyData."""

    def __init__(self, surface: Any) -> None:
        self._surface = surface

    def mesh(self, **options: Any) -> Mesh:
        """Meshes what the faces enclose: livemesh.mesh(surface, ...), which has the options. Of the
        result, to_pyvista() is a grid."""
        return mesh(self._surface, **options)


pyvista.register_dataset_accessor("livemesh", pyvista.PolyData)(SurfaceAccessor)
