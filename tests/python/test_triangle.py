"""livemesh.compat.triangle: what users of the package `triangle` rely on."""
import unittest
import warnings

import numpy as np

from livemesh.compat.triangle import triangulate

SQUARE = dict(vertices=np.array([(0, 0), (1, 0), (1, 1), (0, 1), (.4, .4), (.6, .4), (.6, .6),
                                 (.4, .6)], float),
              segments=[(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)],
              segment_markers=[[2]] * 4 + [[3]] * 4, vertex_markers=[[5]] + [[0]] * 7)


def areas(t):
    a, b, c = (t["vertices"][t["triangles"][:, i]] for i in range(3))
    u, v = b - a, c - a
    return (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2


class Triangle(unittest.TestCase):
    def test_input_comes_first_and_lines_hold(self):
        t = triangulate(dict(SQUARE, holes=[(.5, .5)], regions=[(.1, .1, 7, .01)]), "pq28aAen")
        np.testing.assert_array_equal(t["vertices"][:8], SQUARE["vertices"])
        self.assertAlmostEqual(areas(t).sum(), .96)
        self.assertLessEqual(areas(t).max(), .01)
        self.assertEqual(t["vertex_markers"][0, 0], 5)
        self.assertEqual(set(t["triangle_attributes"].ravel()), {7})
        self.assertEqual(set(t["segment_markers"].ravel()), {2, 3})
        edges, markers = t["edges"], t["edge_markers"].ravel()
        self.assertEqual(len(t["segments"]), (markers > 0).sum())
        self.assertEqual(len(np.unique(np.sort(edges, axis=1), axis=0)), len(edges))
        # Euler: one hole
        self.assertEqual(len(np.unique(t["triangles"])) - len(edges) + len(t["triangles"]), 0)
        for i, around in enumerate(t["neighbors"]):
            for k, j in enumerate(around):
                if j >= 0:
                    side = set(t["triangles"][i]) - {t["triangles"][i, k]}
                    self.assertTrue(side <= set(t["triangles"][j]))

    def test_area_and_angle(self):
        t = triangulate(SQUARE, "pq29a0.01")
        self.assertLessEqual(areas(t).max(), .01)
        few = triangulate(SQUARE, "p")
        self.assertLess(len(few["triangles"]), len(t["triangles"]))

    def test_more_degrees_than_there_are_bounds_for_are_a_warning(self):
        bound = triangulate(SQUARE, "pq29.6a0.1")
        for angle in ("30", "33.8", "34"):
            with self.assertWarnsRegex(UserWarning, f"q{angle}: the bound .* 29.6 degrees") as said:
                t = triangulate(SQUARE, f"pq{angle}a0.1")
            self.assertEqual(said.filename, __file__)
            np.testing.assert_array_equal(t["vertices"], bound["vertices"])
            np.testing.assert_array_equal(t["triangles"], bound["triangles"])
        a, b, c = (bound["vertices"][bound["triangles"][:, i]] for i in range(3))
        for p, q, r in ((a, b, c), (b, c, a), (c, a, b)):
            u, v = q - p, r - p
            angles = np.degrees(np.arctan2(abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]),
                                           (u * v).sum(1)))
            self.assertGreaterEqual(angles.min(), 29.6 - 1e-9)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            triangulate(SQUARE, "pq29.6a0.1")
            no_bound = triangulate(SQUARE, "pq0")
        np.testing.assert_array_equal(no_bound["triangles"], triangulate(SQUARE, "p")["triangles"])

    def test_points_alone_are_meshed_to_their_hull(self):
        points = np.random.default_rng(6).uniform(0, 1, (50, 2))
        points = np.concatenate((points, [(0, 0), (1, 0), (.5, 0), (1, 1), (0, 1)]))
        t = triangulate(dict(vertices=points), "q")
        np.testing.assert_array_equal(t["vertices"][:55], points)
        self.assertAlmostEqual(areas(t).sum(), 1)

    def test_unknown_switches(self):
        with self.assertRaises(ValueError):
            triangulate(SQUARE, "pY")


if __name__ == "__main__":
    unittest.main()
