"""Pictures by matplotlib: what is drawn is the mesh. Skipped without matplotlib."""
import importlib.util
import os
import tempfile
import unittest

import numpy as np

import livemesh as lm

HAS = importlib.util.find_spec("matplotlib") is not None
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


@unittest.skipUnless(HAS, "matplotlib is not there")
class Plot(unittest.TestCase):
    def setUp(self):
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as pyplot

        self.pyplot = pyplot
        self.addCleanup(pyplot.close, "all")
        self.m = lm.mesh(SQUARE, polylines=[[0, 1, 2, 3, 0]], max_area=.01,
                         regions=[(.5, .5, 3)])

    def drawn(self, axes):
        """The triangles in a picture, and their values."""
        (patches,) = axes.collections
        return [path.vertices[:3] for path in patches.get_paths()], patches.get_array()

    def same(self, triangles, m):
        np.testing.assert_array_equal(triangles, m.points[m.cells[:, :3]])

    def test_regions(self):
        axes = self.m.plot(cmap="viridis")
        self.assertIs(axes, self.pyplot.gca())
        triangles, values = self.drawn(axes)
        self.same(triangles, self.m)
        np.testing.assert_array_equal(values, self.m.cell_regions)
        self.assertEqual(axes.collections[0].get_cmap().name, "viridis")
        lines = sorted(line.get_xydata().tolist() for line in axes.lines)
        self.assertEqual(lines, sorted(self.m.points[f].tolist() for f in self.m.facets))

    def test_values_of_cells_and_of_points_in_given_axes(self):
        _, (left, right) = self.pyplot.subplots(1, 2)
        self.assertIs(self.m.plot(self.m.quality(), ax=left), left)
        triangles, values = self.drawn(left)
        self.same(triangles, self.m)
        np.testing.assert_array_equal(values, self.m.quality())
        x = self.m.points[:, 0]
        self.assertIs(self.m.plot(x.tolist(), ax=right), right)
        np.testing.assert_allclose(self.drawn(right)[1], x[self.m.cells].mean(1))
        self.assertRaises(ValueError, self.m.plot, [1., 2.])

    def test_second_order(self):
        second = self.m.second_order()
        axes = second.plot(second.points[:, 1])
        triangles, values = self.drawn(axes)
        self.same(triangles, second)
        np.testing.assert_allclose(values, second.points[second.cells[:, :3], 1].mean(1))

    def test_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh.png")
            self.m.plot().figure.savefig(path)
            self.assertGreater(os.path.getsize(path), 5000)


if __name__ == "__main__":
    unittest.main()
