"""What livemesh gives to pyvista and takes from it, with a stand-in: Debian 12 has no pyvista."""
import importlib
import os
import subprocess
import sys
import unittest

import numpy as np

STAND_INS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "stand_ins")
sys.path.insert(0, STAND_INS)

import pyvista  # noqa: E402

import livemesh as lm  # noqa: E402

CUBE = np.array([(i & 1, i >> 1 & 1, i >> 2 & 1) for i in range(8)], float)
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [(3, *t) for a, b, c, d in SIDES for t in ((a, b, c), (a, c, d))]
SQUARE = dict(source=CUBE[[0, 1, 3, 2], :2], polylines=[[0, 1, 2, 3, 0]], max_area=.1,
              regions=[(.5, .5, 3)], point_markers=[5, 0, 0, 0])


class Accessor(unittest.TestCase):
    def test_a_surface_has_it_once_the_module_is_imported(self):
        surface = pyvista.PolyData(CUBE, np.ravel(TRIANGLES))
        self.assertFalse(hasattr(surface, "livemesh"))
        module = importlib.import_module("livemesh.compat.pyvista")
        for made in (surface, pyvista.Part(CUBE, [n for s in SIDES for n in (4, *s)])):
            m = made.livemesh.mesh(max_volume=1e-3, min_dihedral=12)
            self.assertIsInstance(m, lm.Mesh)
            self.assertAlmostEqual(m.quality("volume").sum(), 1)
            self.assertLessEqual(m.quality("volume").max(), 1e-3)
            self.assertEqual(len(set(m.facet_ids)), 6)
            self.assertIs(made.livemesh, made.livemesh)
            self.assertIsInstance(made.livemesh, module.SurfaceAccessor)
        with self.assertRaises(TypeError):
            surface.livemesh.mesh(wrong=1)
        self.assertFalse(hasattr(pyvista.UnstructuredGrid, "livemesh"))

    def test_the_package_does_not_import_pyvista_by_itself(self):
        program = "import sys, livemesh; assert 'pyvista' not in sys.modules"
        subprocess.run([sys.executable, "-c", program], check=True)

    def test_older_versions_are_refused(self):
        program = ("import pyvista; del pyvista.register_dataset_accessor; "
                   "pyvista.__version__ = '0.47.0'; import livemesh.compat.pyvista")
        paths = os.pathsep.join((STAND_INS, os.environ.get("PYTHONPATH", "")))
        process = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                                 env={**os.environ, "PYTHONPATH": paths})
        self.assertIn("ImportError: accessors need pyvista 0.48 or later, this is 0.47.0",
                      process.stderr)


class Grid(unittest.TestCase):
    def test_cells_points_and_data(self):
        space = dict(source=CUBE, polygons=SIDES, polygon_markers=range(1, 7), max_volume=.05,
                     regions=[(.5, .5, .5, 3)])
        for options, order, kind in ((SQUARE, 1, 5), (SQUARE, 2, 22), (space, 1, 10),
                                     (space, 2, 24)):
            m = lm.mesh(**options, order=order)
            grid = m.to_pyvista()
            self.assertEqual(grid.kind, kind)
            np.testing.assert_array_equal(grid.cells, m.cells)
            np.testing.assert_array_equal(grid.points[:, :m.dimension], m.points)
            self.assertFalse(grid.points[:, m.dimension:].any())
            np.testing.assert_array_equal(grid.cell_data["region"], m.cell_regions)
            self.assertEqual(set(grid.cell_data["region"]), {3})
            np.testing.assert_array_equal(grid.point_data["marker"], m.point_markers)

    def test_plot_of_tetrahedra(self):
        m = lm.mesh(CUBE, polygons=SIDES)
        values = m.quality("min_dihedral")
        shown = m.plot(values, cmap="viridis")
        self.assertIs(shown.pop("scalars"), values)
        self.assertEqual(shown, {"show_edges": True, "cmap": "viridis"})


if __name__ == "__main__":
    unittest.main()
