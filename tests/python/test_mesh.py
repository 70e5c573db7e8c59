"""Meshes that are made once: arrays, lifetimes, inputs of all kinds, files."""
import gc
import importlib.util
import os
import pathlib
import tempfile
import unittest

import numpy as np

import livemesh as lm

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data")
SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
RING = [[0, 1, 2, 3, 0]]
CUBE = np.array([(i & 1, i >> 1 & 1, i >> 2 & 1) for i in range(8)], float)
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def areas(points, cells):
    a, b, c = (points[cells[:, i]] for i in range(3))
    u, v = b - a, c - a
    return (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2


class Plane(unittest.TestCase):
    def test_periodic_sides(self):
        rng = np.random.default_rng(5)
        points = np.vstack((SQUARE, [(x * x, y) for x, y in .05 + .9 * rng.random((40, 2))]))
        sides = dict(polylines=[[0, 1], [1, 2], [3, 2], [0, 3]], polyline_markers=[1, 2, 3, 4])
        for order in (1, 2):
            m = lm.mesh(points, **sides, periodic=[(4, 2), (1, 3)], order=order)
            self.assertEqual([p.markers for p in m.periodic], [(4, 2), (1, 3)])
            for pair, by in zip(m.periodic, ((1, 0), (0, 1))):
                self.assertEqual(pair.translation.tolist(), list(by))
                a, b = m.points[pair.points.T]
                np.testing.assert_array_equal(a + by, b)
                self.assertGreater(len(pair.points), 5)
                for marker, column in zip(pair.markers, pair.points.T):
                    of_marker = m.facets[m.facet_markers == marker][:, :2]
                    self.assertEqual(set(of_marker.ravel().tolist()), set(column.tolist()))
            self.assertTrue(all(f.holds for f in m.check(lm.Graph(points, **sides), rho=1.4143)))
        self.assertEqual(lm.mesh(points, **sides).periodic, [])
        with self.assertRaisesRegex(lm.GeometryError, "no line has the marker 77") as e:
            lm.mesh(points, **sides, periodic=[(4, 77)])
        self.assertEqual(e.exception.code, "bad_option")
        for wrong, error in (([(1, 2, 3)], ValueError), ([1], ValueError), ("ab", TypeError),
                             ([(1., 2.)], TypeError)):
            with self.assertRaises(error):
                lm.mesh(points, **sides, periodic=wrong)
        with self.assertRaisesRegex(ValueError, "for the plane"):
            lm.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], periodic=[(1, 2)])

    def test_growth(self):
        points = np.concatenate((SQUARE, [(.5, .5), (.51, .5)]))
        counts = [len(lm.mesh(points, polylines=RING, growth=g).cells) for g in (None, 1.5, 1.2)]
        self.assertTrue(counts[0] < counts[1] < counts[2], counts)
        with self.assertRaises(lm.Error):
            lm.mesh(points, growth=1.01)

    def test_out_of_core(self):
        points = np.random.default_rng(3).random((3000, 2))
        whole = lm.mesh(points, algorithm="gap_balls")
        with tempfile.TemporaryDirectory() as folder:
            scratch = pathlib.Path(folder, "scratch")
            for tiles, threads in ((0, 1), (3, 1), (5, 2)):
                m = lm.mesh(points, out_of_core=scratch, tiles=tiles, threads=threads)
                np.testing.assert_array_equal(m.points, whole.points)
                np.testing.assert_array_equal(m.cells, whole.cells)
                np.testing.assert_array_equal(m.point_kinds, whole.point_kinds)

            steps = 0

            def stop(_):
                nonlocal steps
                steps += 1
                return steps < 3

            with self.assertRaises(lm.Cancelled):
                lm.mesh(points, out_of_core=scratch, tiles=4, progress=stop)
            again = lm.mesh(points, out_of_core=scratch, tiles=4)
            np.testing.assert_array_equal(again.cells, whole.cells)

            for code, more in (("bad_option", dict(max_area=.01)), ("bad_option", dict(growth=2)),
                               ("bad_option", dict(algorithm="svr")),
                               ("unsupported", dict(segments=[(0, 1)]))):
                with self.subTest(code, **more), self.assertRaises(lm.GeometryError) as e:
                    lm.mesh(points, out_of_core=scratch, **more)
                self.assertEqual(e.exception.code, code)
            twice = np.concatenate((points, points[7:8]))
            with self.assertRaises(lm.GeometryError) as e:
                lm.mesh(twice, out_of_core=scratch)
            self.assertEqual(e.exception.code, "duplicate_point")
            file = pathlib.Path(folder, "file")
            file.write_text("x")
            with self.assertRaises(lm.FileError):
                lm.mesh(points, out_of_core=file, tiles=2)
            self.assertEqual(file.read_text(), "x")

    def test_out_of_core_in_space(self):
        points = np.random.default_rng(3).random((300, 3))
        for no_flat in (False, True):
            whole = lm.mesh(points, algorithm="gap_balls", no_flat=no_flat)
            with tempfile.TemporaryDirectory() as folder:
                m = lm.mesh(points, out_of_core=folder, tiles=2, no_flat=no_flat)
            np.testing.assert_array_equal(m.points, whole.points)
            np.testing.assert_array_equal(m.cells, whole.cells)

    def test_example_of_the_package(self):
        rng = np.random.default_rng(1)
        inner = rng.uniform(0.05, 0.95, (40, 2))
        points = np.concatenate((SQUARE, [(.45, .45), (.55, .45), (.55, .55), (.45, .55)], inner))
        segments = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]
        m = lm.mesh(points, segments=segments, segment_markers=[7, 1, 1, 1, 2, 2, 2, 2],
                    holes=[(.5, .5)], regions=[(.1, .1, 7, 1e-3)], min_angle=28, max_area=.01,
                    size=lambda xy: .02 + .1 * np.hypot(*xy.T), repair=True, order=1)
        self.assertGreaterEqual(m.quality("min_angle").min(), 20)
        self.assertAlmostEqual(areas(m.points, m.cells).sum(), 1 - .01)
        self.assertLessEqual(areas(m.points, m.cells).max(), 1e-3)
        self.assertEqual(set(m.cell_regions), {7})
        m.name(facets={"inlet": 7}, cells={"rock": 7})
        inlet = m.facets_named("inlet")
        self.assertTrue((m.points[inlet][..., 1] == 0).all())
        self.assertEqual(len(m.cells_named("rock")), len(m.cells))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "lake.msh")
            m.write(path, version=2.2)
            np.testing.assert_array_equal(lm.Mesh.read(path).cells, m.cells)

    def test_arrays_fit_together(self):
        m = lm.mesh(SQUARE, polylines=RING, polyline_markers=5, max_area=.003)
        self.assertEqual(m.points.dtype, np.float64)
        self.assertEqual(m.cells.dtype, np.uint32)
        self.assertTrue((areas(m.points, m.cells) > 0).all())
        for i, around in enumerate(m.neighbors):
            for k, j in enumerate(around):
                side = set(m.cells[i]) - {m.cells[i, k]}
                if j == lm.NO_CELL:
                    self.assertIn(side, [set(f) for f in m.facets])
                else:
                    self.assertTrue(side <= set(m.cells[j]))
        self.assertEqual(set(m.facet_markers), {5})
        self.assertEqual(set(m.facet_ids), {0})
        self.assertEqual(sorted(m.point_ids[m.point_ids >= 0]), [0, 1, 2, 3])
        for i in range(4):
            np.testing.assert_array_equal(m.points[m.point_ids == i][0], SQUARE[i])
        np.testing.assert_allclose(m.quality("area"), areas(m.points, m.cells))
        self.assertTrue((m.quality("radius_edge") < 1.4143).all())
        self.assertTrue((m.quality("max_angle") + 2 * m.quality("min_angle") <= 180 + 1e-9).all())

    def test_points_alone_are_found_among_the_vertices(self):
        points = np.random.default_rng(2).uniform(0, 1, (100, 2))
        m = lm.mesh(points)
        self.assertFalse(m.encloses)
        ids = m.point_ids
        np.testing.assert_array_equal(points[ids[ids >= 0]], m.points[ids >= 0])
        self.assertEqual((ids >= 0).sum(), 100)
        self.assertGreater(len(m.facets), 0)

    def test_arrays_outlive_the_mesh_and_are_not_copies(self):
        m = lm.mesh(SQUARE, polylines=RING, max_area=1e-4)
        points, cells = m.points, m.cells
        self.assertEqual(points.ctypes.data, m.points.ctypes.data)
        self.assertFalse(points.flags.writeable)
        total = points.sum()
        del m
        gc.collect()
        for _ in range(20):
            lm.mesh(SQUARE, polylines=RING, max_area=1e-3)
        self.assertEqual(points.sum(), total)
        self.assertLess(cells.max(), len(points))

    def test_objects_are_freed(self):
        gc.collect()
        before = lm._c.c.objects()
        for _ in range(10):
            m = lm.mesh(SQUARE, polylines=RING, size=.1)
            array = m.cells
        del m, array
        gc.collect()
        self.assertEqual(lm._c.c.objects(), before)

    def test_sizes(self):
        for size in (lambda xy: .02 + .1 * np.hypot(*xy.T), lm.Sizes.function(
                lambda xy: .02 + .1 * np.hypot(*xy.T), slope=.1, least=.02, dimension=2)):
            m = lm.mesh(SQUARE, polylines=RING, size=size)
            h = .02 + .1 * np.hypot(*m.points[m.cells].mean(1).T)
            self.assertLess((m.quality("area") / (np.sqrt(3) / 4 * h**2)).max(), 1.15)
        few = lm.mesh(SQUARE, polylines=RING, size=.2)
        h = .2
        self.assertLessEqual(few.quality("area").max(), np.sqrt(3) / 4 * h**2)
        m = lm.mesh(SQUARE, polylines=RING, size=([(0, 0), (1, 1)], [.05, .3]))
        self.assertGreater(len(m.cells), len(few.cells))

    def test_crossing_lines_are_an_error_with_ids_and_places_or_are_repaired(self):
        lines = dict(segments=[(0, 1), (2, 3)])
        points = [(0, 0), (2, 2), (0, 2), (2, 0)]
        with self.assertRaises(lm.GeometryError) as caught:
            lm.mesh(points, **lines)
        error = caught.exception
        self.assertEqual(error.code, "crossing_segments")
        self.assertEqual(set(error.features), {lm.Feature("line", 0), lm.Feature("line", 1)})
        self.assertEqual(error.at.shape[1], 2)
        graph = lm.Graph(points, **lines).repaired()
        self.assertGreater(len(graph.notes), 0)
        self.assertIn((1, 1), [tuple(p) for p in graph.points])
        near = lm.Graph([(0, 0), (2, 0), (1, 0.001)], segments=[(0, 1)])
        self.assertEqual(near.repaired().notes, [])
        self.assertEqual(len(near.repaired(tolerance=0.01).notes), 1)
        with self.assertRaises(lm.GeometryError):
            near.repaired(tolerance=-1.0)
        m = lm.mesh(points, **lines, repair=True)
        self.assertIn((1, 1), [tuple(p) for p in m.points])

    def test_check(self):
        graph = lm.Graph(SQUARE, polylines=RING)
        m = lm.mesh(graph, min_angle=25)
        findings = m.check(graph, rho=1.1832)
        self.assertGreater(len(findings), 5)
        self.assertTrue(all(f.holds for f in findings), findings)
        self.assertFalse(all(f.holds for f in m.check(graph, rho=0.5)))

    def test_seeds_without_a_region_are_told(self):
        m = lm.mesh(SQUARE, polylines=RING, regions=[(3, 3, 1)])
        self.assertEqual(len(m.faults), 1)


class Inputs(unittest.TestCase):
    def test_geo_interface(self):
        class Geometry:
            __geo_interface__ = {
                "type": "Polygon",
                "coordinates": [[(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)],
                                [(1, 1), (2, 1), (2, 2), (1, 2), (1, 1)]]}

        for source in (Geometry(), Geometry.__geo_interface__,
                       {"type": "FeatureCollection", "features": [
                           {"type": "Feature", "properties": {"x": np.float64(1)},
                            "geometry": Geometry()}]}):
            m = lm.mesh(source, min_angle=28)
            self.assertAlmostEqual(areas(m.points, m.cells).sum(), 15)

    @unittest.skipUnless(importlib.util.find_spec("shapely"), "shapely is not there")
    def test_shapely(self):
        from shapely import geometry

        ring = geometry.Polygon([(0, 0), (4, 0), (4, 4), (0, 4)],
                                [[(1, 1), (2, 1), (2, 2), (1, 2)]])
        island = geometry.box(6, 0, 7, 2)
        for source, area in ((ring, 15), (geometry.MultiPolygon([ring, island]), 17),
                             (geometry.Point(0, 0).buffer(1, 16), None),
                             ({"type": "FeatureCollection", "features": [
                                 {"type": "Feature", "geometry": ring, "properties": {}},
                                 {"type": "Feature", "geometry": island, "properties": {}}]}, 17)):
            m = lm.mesh(source, min_angle=28)
            area = area or source.area
            self.assertAlmostEqual(areas(m.points, m.cells).sum(), area)
        m = lm.mesh(ring, min_angle=28)
        corners = {tuple(p) for r in (ring.exterior, *ring.interiors) for p in r.coords}
        self.assertTrue(corners <= {tuple(p) for p in m.points})
        inside = ring.buffer(1e-9)
        self.assertTrue(all(inside.contains(geometry.Polygon(t)) for t in m.points[m.cells]))
        line = geometry.LineString([(.5, 3), (3.5, 3)])
        split = lm.mesh(geometry.GeometryCollection([ring, line]), min_angle=28)
        on = split.points[split.facets]
        on = on[(on[..., 1] == 3).all(1) & (on[..., 0] >= .5).all(1) & (on[..., 0] <= 3.5).all(1)]
        self.assertAlmostEqual(abs(on[:, 0, 0] - on[:, 1, 0]).sum(), 3)

    def test_files(self):
        m = lm.mesh(os.path.join(DATA, "great_lakes.poly"), min_angle=25)
        self.assertGreater(len(m.cells), 10000)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("lake.vtu", "lake.msh", "lake.1.node"):
                path = os.path.join(folder, name)
                m.write(path)
                again = lm.Mesh.read(path)
                np.testing.assert_array_equal(again.points, m.points)
                np.testing.assert_array_equal(again.cells, m.cells)
            graph = lm.Graph.read(os.path.join(DATA, "great_lakes.poly"))
            path = os.path.join(folder, "lake.poly")
            graph.write(path)
            np.testing.assert_array_equal(lm.Graph.read(path).points, graph.points)
            self.assertEqual(lm.Graph.read(path).segments.shape, graph.segments.shape)

    def test_errors_of_files(self):
        with self.assertRaises(lm.FileError) as caught:
            lm.mesh("/nowhere/at/all.poly")
        self.assertEqual(caught.exception.code, "cannot_read")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "bad.poly")
            with open(path, "w") as file:
                file.write("2 2 0 0\n1 0 0\n2 nonsense 0\n")
            with self.assertRaises(lm.FileError) as caught:
                lm.mesh(path)
            self.assertEqual((caught.exception.file, caught.exception.line), (path, 3))
            m = lm.mesh(SQUARE)
            with self.assertRaises(lm.FileError):
                m.write(os.path.join(folder, "no", "such", "folder.vtu"))

    def test_surfaces(self):
        triangles = np.array([t for a, b, c, d in SIDES for t in ((a, b, c), (a, c, d))])

        class Surface:  # as pyvista and trimesh have them
            pass

        vtk, trimesh = Surface(), Surface()
        vtk.points, vtk.faces = CUBE, np.column_stack((np.full(12, 3), triangles)).ravel()
        trimesh.vertices, trimesh.faces = CUBE, triangles
        for source in ((CUBE, triangles), (CUBE, SIDES), vtk, trimesh):
            m = lm.mesh(source, max_volume=1e-3)
            self.assertEqual(m.dimension, 3)
            self.assertAlmostEqual(m.quality("volume").sum(), 1)
            self.assertLessEqual(m.quality("volume").max(), 1e-3)
            self.assertEqual(len(set(m.facet_ids)), 6)

    def test_space(self):
        m = lm.mesh(CUBE, polygons=SIDES, polygon_markers=range(1, 7), regions=[(.5, .5, .5, 3)])
        self.assertEqual(set(m.facet_markers), set(range(1, 7)))
        self.assertEqual(set(m.cell_regions), {3})
        self.assertTrue((m.quality("radius_edge") <= 2 + 1e-9).all())
        self.assertTrue((m.quality("min_dihedral") > 0).all())
        self.assertTrue((m.quality("max_dihedral") < 180).all())
        volume = m.quality("volume")
        a, b, c, d = (m.points[m.cells[:, i]] for i in range(4))
        np.testing.assert_allclose(np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)) / 6,
                                   volume)
        for i, around in enumerate(m.neighbors):
            for k, j in enumerate(around):
                if j != lm.NO_CELL:
                    self.assertTrue(set(m.cells[i]) - {m.cells[i, k]} <= set(m.cells[j]))

    def test_graph_arrays(self):
        g = lm.Graph(CUBE, polygons=[[list(f) for f in SIDES[:1]], SIDES[1]],
                     segments=[(0, 7)], segment_markers=3, polylines=[[1, 2, 4]],
                     regions=[(.1, .1, .1, 2, .5)], holes=[(.9, .9, .9)])
        self.assertEqual([len(p) for p in g.polygons], [1, 1])
        self.assertEqual(g.polygons[0][0].tolist(), list(SIDES[0]))
        self.assertEqual(g.segments.tolist(), [[0, 7]])
        self.assertEqual(g.segment_markers.tolist(), [3])
        self.assertEqual([p.tolist() for p in g.polylines], [[1, 2, 4]])
        self.assertEqual(g.regions.tolist(), [[.1, .1, .1, 2, .5]])
        self.assertEqual(g.holes.tolist(), [[.9, .9, .9]])

    def test_names_go_to_files_and_come_from_them(self):
        m = lm.mesh(SQUARE, polylines=RING, polyline_markers=[7], regions=[(.5, .5, 3)])
        self.assertIs(m.name(facets={"inlet": 7}, cells={"rock": 3}), m)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "m.msh")
            for version in ("4.1", "2.2", 4.1, 2.2, np.float64(2.2), np.float32(4.1)):
                m.write(path, version=version)
                with open(path) as file:
                    text = file.read()
                self.assertIn(f"\n{version!s} 0 8\n", text)
                self.assertIn('1 7 "inlet"', text)
                self.assertIn('2 3 "rock"', text)
                again = lm.Mesh.read(path)
                self.assertEqual(again.names,
                                 {"facets": {"inlet": 7}, "edges": {}, "cells": {"rock": 3}})
                self.assertEqual(len(again.facets_named("inlet")), len(m.facets))
            again.names["facets"] = {"outlet": 7, "rock": 8}
            again.names["cells"] = {}
            again.write(path)
            self.assertEqual(lm.Mesh.read(path).names["facets"], {"outlet": 7})
            for wrong in ("a b", "", "marker_1", "rock"):
                with self.assertRaises(lm.Error) as caught:
                    lm.Mesh.read(path).name(facets={wrong: 7}, cells={"rock": 3}).write(path)
                self.assertEqual(caught.exception.code, "bad_option")
            for wrong in ("3", 3, 2.1, 22, 4, None, float("nan"), "2.2 "):
                with self.assertRaisesRegex(ValueError, "not one of 4.1, 2.2"):
                    m.write(path, version=wrong)
            self.assertRaises(TypeError, m.name(facets={1: 7}).write, path)
            stl = os.path.join(folder, "two.stl")
            with open(stl, "w") as file:
                for name, faces in (("floor", SIDES[:1]), ("rest", SIDES[1:])):
                    file.write(f"solid {name}\n")
                    for a, b, c, d in faces:
                        for t in ((a, b, c), (a, c, d)):
                            file.write("facet normal 0 0 0\nouter loop\n" + "".join(
                                "vertex {} {} {}\n".format(*CUBE[i]) for i in t) +
                                "endloop\nendfacet\n")
                    file.write("endsolid\n")
            solid = lm.mesh(stl)
            self.assertEqual(solid.names["facets"], {"floor": 1, "rest": 2})
            self.assertEqual(len(set(map(tuple, solid.facets_named("floor")))),
                             int((solid.facet_markers == 1).sum()))

    def test_second_order(self):
        plane = dict(polylines=RING, polyline_markers=[7], regions=[(.5, .5, 3)], max_area=.1)
        space = dict(polygons=SIDES, polygon_markers=range(1, 7), max_volume=.05)
        pairs = {6: [(0, 1), (1, 2), (2, 0)], 3: [(0, 1)],
                 10: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]}
        for points, options in ((SQUARE, plane), (CUBE, space), (SQUARE, {}), (CUBE, {})):
            first, m = lm.mesh(points, **options), lm.mesh(points, order=2, **options)
            n = len(first.points)
            self.assertEqual((first.order, m.order), (1, 2))
            np.testing.assert_array_equal(m.points[:n], first.points)
            corners = m.dimension + 1
            np.testing.assert_array_equal(m.cells[:, :corners], first.cells)
            np.testing.assert_array_equal(m.facets[:, :corners - 1], first.facets)
            np.testing.assert_array_equal(m.neighbors, first.neighbors)
            np.testing.assert_array_equal(m.quality(), first.quality())
            np.testing.assert_array_equal(m.facet_markers, first.facet_markers)
            np.testing.assert_array_equal(m.point_ids[:n], first.point_ids)
            self.assertEqual(len(np.unique(m.cells)), len(m.points))
            for array in (m.point_kinds, m.point_markers, m.point_ids):
                self.assertEqual(len(array), len(m.points))
            for rows in (m.cells, m.facets):
                both = pairs[rows.shape[1]]
                for k, (a, b) in enumerate(both, rows.shape[1] - len(both)):
                    np.testing.assert_array_equal(
                        m.points[rows[:, k]],
                        (m.points[rows[:, a]] + m.points[rows[:, b]]) / 2)
            self.assertTrue(all(f.holds for f in m.check()))
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "m.vtu")
                m.write(path)
                np.testing.assert_array_equal(lm.Mesh.read(path).points, first.points)
                with self.assertRaises(lm.Error) as caught:
                    m.write(os.path.join(folder, "m.su2"))
                self.assertEqual(caught.exception.code, "bad_option")
            self.assertEqual(m.second_order().cells.shape, m.cells.shape)
        self.assertRaises(ValueError, lm.mesh, SQUARE, order=3)

    def test_conversions_ask_for_their_package_only_when_called(self):
        m = lm.mesh(SQUARE, polylines=RING, regions=[(.5, .5, 3)]).name(cells={"rock": 3})
        try:
            import meshio  # noqa: F401
        except ImportError:
            self.assertRaises(ImportError, m.to_meshio)
            return
        converted = m.to_meshio()
        np.testing.assert_array_equal(converted.points, m.points)
        np.testing.assert_array_equal(converted.cells_dict["triangle"], m.cells)
        self.assertEqual(converted.field_data["rock"].tolist(), [3, 2])


if __name__ == "__main__":
    unittest.main()
