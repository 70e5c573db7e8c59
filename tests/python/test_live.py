"""Live meshes: changes by slots, transfer, undo, batches, compaction."""
import gc
import os
import tempfile
import unittest

import numpy as np

import livemesh as lm

BOX = [(0, 0), (4, 0), (4, 4), (0, 4)]


def room(**options):
    d = lm.LiveMesh(bounds=((0, 0), (4, 4)), min_angle=28, **options)
    p = d.add_points(BOX + [(1, 1), (2, 1.2), (3, 1)])
    d.add_polyline([0, 1, 2, 3, 0], marker=1)
    wall = d.add_polyline(p[4:], marker=9)
    return d, p, wall


class Twin:
    """Everything that a live mesh says of itself, kept by its changes alone."""

    def __init__(self, live):
        self.live, self.points, self.cells, self.kept = live, {}, {}, set()

    def follow(self, change):
        for s in change.points_removed:
            del self.points[s]
        for s in change.all_cells_removed:
            del self.cells[s]
        self.kept -= set(change.cells_removed.tolist())
        at, cells = self.live.points, self.live.cells
        for s, p in zip(change.points_added, change.added_at):
            assert s not in self.points
            self.points[s] = tuple(at[s])
            assert tuple(p) == tuple(at[s])
        for s in change.all_cells_added:
            self.cells[s] = tuple(cells[s])
        self.kept |= set(change.cells_added.tolist())

    def check(self, test):
        d = self.live
        test.assertEqual(sorted(self.points), np.flatnonzero(d.point_used).tolist())
        test.assertEqual(sorted(self.cells), np.flatnonzero(d.cell_used).tolist())
        test.assertEqual(sorted(self.kept), np.flatnonzero(d.cell_kept).tolist())
        at, cells = d.points, d.cells
        for s, p in self.points.items():
            test.assertEqual(tuple(at[s]), p)
        for s, t in self.cells.items():
            test.assertEqual(tuple(cells[s]), t)
        fresh = {name: lm._c.array(lm._c.c.live_array, d._handle, field).copy()
                 for name, field in lm._live._FIELDS.items()}
        for name, raw in fresh.items():
            used = {"point": d.point_used, "cells": d.cell_used, "neigh": d.cell_used,
                    "facet": d.facet_used}.get(name[:5])
            rows = slice(None) if name.endswith(("used", "kept")) else used
            np.testing.assert_array_equal(np.asarray(getattr(d, name))[rows].astype(raw.dtype),
                                          raw[rows], name)


class Live(unittest.TestCase):
    def test_arrays_follow_random_edits(self):
        rng = np.random.default_rng(3)
        d, p, wall = room()
        twin = Twin(d)
        twin.follow(d.update())
        twin.check(self)
        loose = d.add_points(rng.uniform(.2, 3.8, (30, 2)) * (1, .2) + (0, 2))
        twin.follow(d.update())
        for step in range(25):
            with d.edit() as change:
                d.move(p[4:], np.array([(1, 1), (2, 1.2), (3, 1)]) + rng.uniform(-.2, .2, (3, 2)))
                if step % 3 == 0:
                    d.remove_points(loose[:1])
                    loose = np.append(loose[1:], d.add_points([rng.uniform(1.6, 1.9, 2)]))
                if step == 10:
                    d.remove_lines(wall)
                if step == 15:
                    d.add_segments([(p[4], p[5])], markers=3)
            twin.follow(change)
            if step % 2 == 0:  # arrays are not asked for after every change
                twin.check(self)

    def test_views_that_were_returned_stay_valid(self):
        d, p, _ = room()
        d.update()
        old, before = d.points, d.points.copy()
        for i in range(40):
            d.add_points([(.3 + .09 * i, 2.5)])
            d.update()
            d.points
        gc.collect()
        self.assertEqual(old.shape, before.shape)
        self.assertTrue(np.isfinite(old).all())

    def test_mesh_and_compact_are_those_of_mesh(self):
        d, p, _ = room(max_area=.1)
        d.update()
        d.move(p[4:], [(1.5, 1.5), (2, 1.9), (2.5, 1.5)])
        d.update()
        m = d.mesh()
        once = lm.mesh(d.graph(), min_angle=28, max_area=.1, bounds=((0, 0), (4, 4)),
                       algorithm="gap_balls")
        np.testing.assert_array_equal(m.points, once.points)
        np.testing.assert_array_equal(m.cells, once.cells)
        points, cells, slot_of = d.compact()
        np.testing.assert_array_equal(points, d.points[slot_of])
        self.assertEqual(sorted(m.cell_slots), np.flatnonzero(d.cell_kept).tolist())
        np.testing.assert_array_equal(np.sort(slot_of[cells], axis=1),
                                      np.sort(d.cells[m.cell_slots], axis=1))
        np.testing.assert_array_equal(d.find(points), slot_of)
        self.assertEqual(d.find([(.123, .456)])[0], lm.NO_CELL)

    def test_what_the_tool_reads_of_its_graph_has_the_same_mesh(self):
        d, p, _ = room()
        d.update()
        d.move(p[4:5], [(1.05, 1)])
        d.update()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "now.poly")
            d.graph().write(path)
            again = lm.mesh(path, bounds=((0, 0), (4, 4)), min_angle=28, algorithm="gap_balls")
        np.testing.assert_array_equal(again.points, d.mesh().points)
        np.testing.assert_array_equal(again.cells, d.mesh().cells)
        self.assertGreater(len(again.cells), 10)

    def test_transfer_writes_to_no_memory_but_that_of_the_field(self):
        d, p, _ = room()
        d.update()
        n = len(d.points)
        state = np.arange(2. * n)
        u, v = state[:n], state[n:]
        d.add_points([(.5 + .1 * i, 3) for i in range(9)])
        change = d.update()
        self.assertGreater(change.point_slots, n)
        before = v.copy()
        after = change.transfer(u)
        np.testing.assert_array_equal(v, before)
        self.assertFalse(np.shares_memory(after, state))
        np.testing.assert_array_equal(after[:n], np.arange(n))
        frozen = after.copy()
        frozen.flags.writeable = False
        for fixed in (d.points, frozen, d.points[:n]):
            before = fixed.copy()
            x = change.transfer(fixed)
            self.assertFalse(np.shares_memory(x, fixed))
            x[:] = -1
            np.testing.assert_array_equal(fixed, before)
            self.assertFalse(fixed.flags.writeable)

    def test_transfer_of_a_field_that_does_not_fit_is_an_error(self):
        d, p, _ = room(max_area=.05)
        first = d.update()
        before = len(d.points)
        self.assertEqual((first.point_slots_before, first.point_slots), (0, before))
        d.add_points([(.5 + .1 * i, 3) for i in range(9)])
        change = d.update()
        after = len(d.points)
        self.assertEqual((change.point_slots_before, change.point_slots), (before, after))
        self.assertGreater(after, before + 1)
        for rows in (0, 1, before - 1, before + 1, after - 1, after + 1, 10 * after):
            for field in (np.ones(rows), np.ones((rows, 3)), np.ones(rows, complex)):
                with self.assertRaisesRegex(
                        ValueError, rf"has {rows} rows; .* {before} point slots .* {after} after"):
                    change.transfer(field)
        self.assertRaises(ValueError, change.transfer, np.ones((2, before)))
        self.assertRaises(ValueError, change.transfer, 7.)
        self.assertRaises(ValueError, change.transfer, [[1.], [1., 2.]])
        for kind in ("U3", object, "datetime64[s]", [("x", float)]):
            self.assertRaises(TypeError, change.transfer, np.zeros(before, kind))
        for kind in (np.float32, np.int8, bool, np.float64, complex):
            for shape in ((before,), (before, 2), (before, 2, 3), (before, 0)):
                u = change.transfer(np.ones(shape, kind))
                self.assertEqual(u.shape, (after,) + shape[1:])
                self.assertEqual(u.dtype, complex if kind is complex else float)
                self.assertTrue((abs(u[d.point_used] - 1) < 1e-12).all())
        with d.edit() as later:
            d.move(p[4:], [(1, 2), (2, 2.2), (3, 2)])
        if later.point_slots_before != before:
            self.assertRaises(ValueError, later.transfer, np.ones(before))  # `change` is left out
        self.assertEqual(d.undo().transfer(np.ones(later.point_slots)).shape, (len(d.points),))

    def test_transfer_grows_in_its_own_room(self):
        d, p, _ = room()
        u = d.update().transfer(np.zeros(0))
        grown = 0
        for i in range(8):
            d.add_points([(.5 + .1 * i, 3)])
            w = d.update().transfer(u)
            self.assertIs(type(w), np.ndarray)
            grown += len(w) > len(u) and np.shares_memory(w, u)
            part = w[:len(w) // 2]
            self.assertFalse(np.shares_memory(lm._live._with_rows(part, len(w)), w))
            u = w
        self.assertGreater(grown, 0)

    def test_transfer_keeps_values_and_interpolates(self):
        rng = np.random.default_rng(4)
        d, p, _ = room(max_area=.05)
        first = d.update()
        f = lambda at: np.column_stack((1 + at[:, 0] - 2 * at[:, 1], at[:, 1]))
        u = f(d.points)
        complex_u = u[:, 0] + 1j * u[:, 1]
        self.assertEqual(first.transfer(np.zeros(0)).shape, (d.points.shape[0],))
        for _ in range(15):
            kept = u.copy()
            with d.edit() as change:
                d.move(p[4:], np.array([(1, 1), (2, 1.2), (3, 1)]) + rng.uniform(-.4, .4, (3, 2)))
            u = change.transfer(u)
            complex_u = change.transfer(complex_u)
            self.assertEqual(len(u), len(d.points))
            used = d.point_used
            np.testing.assert_allclose(u[used], f(d.points)[used], atol=1e-9)
            np.testing.assert_allclose(complex_u.real[used], u[used, 0], atol=1e-12)
            stay = np.setdiff1d(np.arange(len(kept)), change.points_added)
            np.testing.assert_array_equal(u[stay], kept[stay])
            around, weights = change.weights
            np.testing.assert_allclose(weights.sum(1), 1)
            self.assertLess(around.max(initial=0), len(kept))

    def test_undo(self):
        d, p, wall = room(undo=50)
        d.update()
        states = [d.mesh()]
        steps = [
            lambda: d.move(p[4:], [(1, 2), (2, 2.2), (3, 2)]),
            lambda: d.add_points([(2, 3)], ids=[77], markers=5),
            lambda: (d.remove_points(77), d.remove_lines(wall)),
            lambda: (d.add_polyline([p[4], p[6]], marker=4, id=wall), d.add_holes([(.1, 3.9)])),
            lambda: (d.remove_lines(wall), d.move(p[4:], [(2, 2.2), (1, 2), (3.1, 2)])),
            lambda: d.add_regions([(.1, .1, 4)]),
        ]
        for step in steps:
            step()
            d.update()
            states.append(d.mesh())
        self.assertEqual(d.undoable, len(steps) + 1)
        for state in states[-2::-1]:
            change = d.undo()
            self.assertIsInstance(change, lm.Change)
            now = d.mesh()
            for name in ("points", "cells", "facets", "point_markers", "facet_markers",
                         "cell_regions"):
                np.testing.assert_array_equal(getattr(now, name), getattr(state, name), name)
        d.undo()
        self.assertEqual(len(d.graph().points), 0)
        with self.assertRaises(ValueError):
            d.undo()

    def test_a_batch_is_made_or_not(self):
        d, p, _ = room()
        d.update()
        before = d.mesh().points.copy()
        with self.assertRaises(lm.GeometryError) as caught:
            with d.edit():
                d.move(p[5:6], [(2, 3)])
                d.add_segment(p[0], d.add_points([(2.5, 3)])[0])
        self.assertEqual(caught.exception.code, "crossing_segments")
        self.assertIn("line", [f.kind for f in caught.exception.features])
        self.assertFalse(d.pending)
        np.testing.assert_array_equal(d.mesh().points, before)
        with self.assertRaises(ZeroDivisionError):
            with d.edit() as change:
                d.move(p[5:6], [(2, 3)])
                1 / 0
        self.assertFalse(d.pending)
        with self.assertRaises(ValueError):
            change.points_added
        d.move(p[5:6], [(2, 3)])
        with self.assertRaises(ValueError):
            with d.edit():
                pass
        d.discard()

    def test_a_call_with_a_mistake_announces_nothing(self):
        d, p, _ = room()
        d.update()
        for mistake, code in (
                (lambda: d.add_points([(3, 3), (9, 9)]), "outside_domain"),
                (lambda: d.add_points([(3, 3), (np.nan, 1)]), "not_finite"),
                (lambda: d.add_points([(3, 3), (3, 3)]), "duplicate_point"),
                (lambda: d.add_points([(3, 3), (3, 2)], ids=[50, 50]), "repeated_id"),
                (lambda: d.move(p[:2], [(1, .5), (9, 9)]), "outside_domain"),
                (lambda: d.move([p[0], p[0]], [(1, .5), (.5, .5)]), "repeated_id"),
                (lambda: d.move([99], [(1, .5)]), "unknown_id"),
                (lambda: d.remove_points([p[0], 99]), "unknown_id"),
                (lambda: d.remove_lines([99]), "unknown_id"),
                (lambda: d.add_segments([(0, 5), (3, 3)]), "zero_length"),
                (lambda: d.remove_holes([0]), "unknown_id")):
            with self.assertRaises(lm.GeometryError) as caught:
                mistake()
            self.assertEqual(caught.exception.code, code)
            self.assertFalse(d.pending, code)
        self.assertEqual(len(d.update().points_added), 0)
        self.assertEqual(d.add_points([(3, 3)])[0], 7)  # no id was lost

    def test_limits_and_regions(self):
        d, p, _ = room()
        d.add_regions([(.1, 3.9, 6)])
        d.update()
        few = d.cell_kept.sum()
        d.limit(max_area=.01, box=((0, 0), (1, 1)))
        d.update()
        self.assertGreater(d.cell_kept.sum(), few)
        d.limit(size=lambda xy: .3 + 0 * xy[:, 0])
        d.update()
        self.assertEqual(set(d.regions_of(np.flatnonzero(d.cell_kept))), {6})

    def test_threads(self):
        points = np.random.default_rng(4).random((300, 2))
        meshes = []
        for threads in (1, 3):
            d = lm.LiveMesh(bounds=((0, 0), (1, 1)), threads=threads)
            p = d.add_points(points)
            d.update()
            d.move(p[:20], points[:20] * .9)
            d.update()
            meshes.append([d.mesh()])
            d.add_segment(p[0], p[1], marker=3)  # one thread from here on
            d.update()
            d.remove_points(p[5:9])
            d.update()
            meshes[-1].append(d.mesh())
        for one, many in zip(*meshes):
            self.assertTrue(np.array_equal(one.points, many.points))
            self.assertTrue(np.array_equal(one.cells, many.cells))
            self.assertTrue(np.array_equal(one.facets, many.facets))

    def test_space(self):
        d = lm.LiveMesh(bounds=((0, 0, 0), (1, 1, 1)))
        corners = [(i & 1, i >> 1 & 1, i >> 2 & 1) for i in range(8)]
        p = d.add_points(np.array(corners) * .5 + .25)
        sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        for i, side in enumerate(sides):
            self.assertEqual(d.add_polygon(p[list(side)], marker=i + 1), i)
        d.update()
        u = d.points @ (1, 2, 3)
        self.assertAlmostEqual(d.mesh().quality("volume").sum(), .125)
        inner = d.add_points([(.5, .5, .5)])
        u = d.update().transfer(u)
        d.move(inner, [(.4, .6, .5)])
        u = d.update().transfer(u)
        used = d.point_used
        np.testing.assert_allclose(u[used], (d.points @ (1, 2, 3))[used])
        self.assertEqual(set(d.facet_ids[d.facet_used]), set(range(6)))
        d.undo()
        d.undo()
        self.assertEqual(len(d.graph().points), 8)
        d.remove_polygons(range(6))
        d.update()
        self.assertEqual(d.cell_kept.sum(), d.cell_used.sum())


if __name__ == "__main__":
    unittest.main()
