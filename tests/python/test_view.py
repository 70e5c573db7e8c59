"""The page of a live mesh: what it shows, what is pulled and pushed, how it ends.

Pages are web sockets of the test's own, as those of tests/mesher/view.
"""
import gc
import os
import pathlib
import random
import signal
import subprocess
import sys
import threading
import time
import types
import unittest
import urllib.parse

import numpy as np

import livemesh as lm

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "mesher" / "view"))
from client import Client, Mirror  # noqa: E402

TOOL = os.environ.get("LIVEMESH_TOOL", "")
BOX = [(0, 0), (4, 0), (4, 4), (0, 4)]


def room(**options):
    d = lm.LiveMesh(bounds=((0, 0), (4, 4)), min_angle=28, **options)
    p = d.add_points([*BOX, (1, 1), (2, 1.2), (3, 1)], markers=[0, 0, 0, 0, 5, 0, 0])
    d.add_polyline([0, 1, 2, 3, 0], marker=1)
    d.add_polyline(p[4:], marker=9)
    d.update()
    return d


def cube(**options):
    d = lm.LiveMesh(bounds=((-1, -1, -1), (2, 2, 2)), **options)
    d.add_points([(i & 1, i >> 1 & 1, i >> 2 & 1) for i in range(8)])
    for loop in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
        d.add_polygon(loop, marker=4)
    d.add_regions([(.5, .5, .5, 7)])
    d.update()
    return d


def shown(d, **options):
    return d.view(browser=False, tool=TOOL, **options)


def simplices_of_page(page):
    """By places, with whether they are kept."""
    mirror = Mirror(page.ask(do="snapshot"))
    return sorted((sorted(mirror.places[v] for v in corners), label != 0)
                  for corners, label in mirror.simplices.values())


def simplices_of(d):
    at = list(map(tuple, d.points.tolist()))
    kept = d.cell_kept
    return sorted((sorted(at[v] for v in d.cells[s]), bool(kept[s]))
                  for s in np.flatnonzero(d.cell_used))


class Views(unittest.TestCase):
    def page_of(self, view):
        place = urllib.parse.urlsplit(view.address)
        page = Client(types.SimpleNamespace(host=place.hostname, port=place.port, path=place.path))
        self.addCleanup(page.close)
        return page

    def require_same(self, d, page):
        self.assertEqual(simplices_of_page(page), simplices_of(d))

    def test_the_page_has_the_mesh_of_the_live_mesh(self):
        fine = room(max_area=.05)
        fine.add_holes([(2.5, 3)], ids=[8])
        fine.add_polyline(fine.add_points([(2, 2.5), (3, 2.5), (3, 3.5), (2, 3.5)])[[0, 1, 2, 3, 0]])
        fine.add_regions([(.5, 3, -2.5, .01)])
        fine.limit(max_area=.08)
        fine.limit(size=.1, box=((0, 0), (1, 1)))
        fine.limit(size=lambda xy: .05 + .1 * xy[:, 0], box=((3, 0), (4, 1)))
        fine.update()
        fine.limit(max_area=1e-5)
        fine.discard()
        by_function = lm.LiveMesh(bounds=((-3e-7, 0), (4, 4)), rho=1.2, extent="box", max_area=.1,
                                  size=lambda xy: .1 + .3 * np.abs(xy[:, 1] - 1), max_vertices=9999)
        by_function.add_points([(1e-5, 1), (2 / 3, 1)])
        by_function.update()
        empty = lm.LiveMesh(bounds=((0, 0), (1, 1)))
        empty.update()
        for d in (room(), fine, by_function, empty, cube(), cube(max_volume=.01, min_dihedral=10)):
            with shown(d) as view:
                page = self.page_of(view)
                self.require_same(d, page)
                self.assertEqual(page.snapshot["state"]["undo"], 0)
                self.assertIsNone(view.pull())
                self.assertFalse(view.push())

    def test_inner_parts_of_polygons(self):
        plates = lm.Graph([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (.5, .5, 0), (.25, .5, 0),
                           (.5, .5, .5), (.25, .5, .5)],
                          polygons=[[0, 1, 2, 3], [4, 5, 7, 6]]).repaired()
        d = lm.LiveMesh(bounds=((-1, -1, -1), (2, 2, 2)))
        self.assertGreater(len(plates._array(22)) + len(plates._array(24)), 0)
        d.add(plates)
        d.update()
        with shown(d) as view:
            page = self.page_of(view)
            self.require_same(d, page)
            self.assertEqual(page.ask(do="delete", features=[["polygon", 0]])["kind"], "change")
            view.pull()
            self.require_same(d, page)
            page.ask(do="undo")
            view.pull()
            self.require_same(d, page)

    def test_what_the_page_edits_is_pulled_as_one_batch(self):
        d = room()
        before = simplices_of(d)
        with shown(d) as view:
            page = self.page_of(view)
            for command in ({"do": "point", "at": [.5, .5], "marker": 3},
                            {"do": "line", "through": [[1, 2], [2, 2.5], 6], "marker": 4},
                            {"do": "line", "through": [[2, 3], [3, 3], [3, 3.5]], "closed": True},
                            {"do": "region", "at": [2.9, 3.1], "attribute": 2.5, "largest": .003},
                            {"do": "hole", "at": [3.9, .1]}, {"do": "undo"},
                            {"do": "delete", "features": [["point", 7]]}, {"do": "undo"},
                            {"do": "drag", "point": 5, "at": [2, 1.5], "drop": True}):
                self.assertNotEqual(page.ask(**command)["kind"], "error")
            self.assertEqual(simplices_of(d), before)
            change = view.pull()
            self.assertGreater(len(change.points_added), 3)
            self.require_same(d, page)
            graph = d.graph()
            self.assertIn(3, graph.point_markers.tolist())
            self.assertEqual(graph.regions.tolist(), [[2.9, 3.1, 2.5, .003]])
            self.assertIsNone(view.pull())
            self.assertFalse(view.push())
            d.undo()
            self.assertEqual(simplices_of(d), before)
            self.assertTrue(view.push())
            self.require_same(d, page)

    def test_what_the_live_mesh_does_is_pushed(self):
        d = room()
        with shown(d) as view:
            page = self.page_of(view)
            d.move([5, 6], [(2, 2), (3, 2)])
            q = d.add_points([(.5, 3), (1.5, 3)], markers=[2, 3])
            d.add_segment(q[0], q[1], marker=6)
            self.assertFalse(view.push())  # not made yet
            d.update()
            self.assertTrue(view.push())
            self.require_same(d, page)
            self.assertEqual(page.ask(do="snapshot")["state"]["undo"], 1)
            d.limit(max_area=.2)
            d.limit(size=.2, box=((0, 0), (1, 1)))
            d.update()
            self.assertTrue(view.push())
            self.assertFalse(view.push())
            self.require_same(d, page)
            # What it has of a line of other points, of a point of another marker.
            d.remove_lines([1])
            d.add_polyline([4, 5], marker=9, id=1)
            d.remove_points([6])
            d.add_points([(3, 2)], ids=[6], markers=[1])
            d.update()
            view.push()
            self.require_same(d, page)
            d.limit(size=lambda xy: .1 + xy[:, 0] ** 2)
            d.update()
            with self.assertRaisesRegex(ValueError, "close it, and open another"):
                view.push()

    def test_a_push_that_is_stopped_in_the_page_changes_nothing_there(self):
        d = room()
        with shown(d) as view:
            page = self.page_of(view)
            before = simplices_of_page(page)
            d.limit(size=.04)
            d.update()

            def stop():
                while True:
                    if view._ask("POST", "stop") == (200, b"stopping\n"):
                        return
            stopping = threading.Thread(target=stop)
            stopping.start()
            with self.assertRaises(lm.Cancelled) as caught:
                view.push()
            stopping.join()
            self.assertEqual(caught.exception.code, "cancelled")
            self.assertEqual(simplices_of_page(page), before)
            self.assertTrue(view.push())
            self.require_same(d, page)

    def test_limits_of_the_page_are_pulled(self):
        d = room()
        with shown(d) as view:
            page = self.page_of(view)
            page.ask(do="limit", largest=.1)
            page.ask(do="limit", size=.1, box=[[0, 0], [1, 1]])
            page.ask(do="limit", box=[[2, 2], [3, 3]])
            view.pull()
            self.require_same(d, page)
            page.ask(do="unlimit", box=[[0, 0], [1, 1]])
            view.pull()
            self.require_same(d, page)
            self.assertIsNone(view.pull())
            d.limit(size=.3)
            d.update()
            page.ask(do="limit", size=.2)
            for way in (view.pull, view.push):
                with self.assertRaisesRegex(lm.GeometryError, "limits of size"):
                    way()
            view.push(force=True)
            self.require_same(d, page)

    def test_both_sides_edit(self):
        seed = int(os.environ.get("SEED", time.time()))
        rng = random.Random(seed)
        d = room(undo=1000)
        place = lambda: [rng.uniform(.05, 3.95), rng.uniform(.05, 3.95)]  # noqa: E731
        with self.subTest(seed=seed), shown(d) as view:
            page = self.page_of(view)
            pulled = pushed = 0
            for _ in range(25):
                mine, theirs = [], []
                for point in d.graph().point_ids.tolist():
                    (mine if rng.random() < .5 else theirs).append(point)
                for _ in range(rng.randrange(3)):
                    page.ask(do="drag", point=rng.choice(theirs or [0]), at=place(), drop=True)
                if rng.random() < .4:
                    page.ask(do="point", at=place())
                elif rng.random() < .3:
                    page.ask(do="region", at=place(), attribute=rng.randrange(5))
                elif rng.random() < .3:
                    page.ask(do="limit", size=rng.uniform(.2, 1),
                             **({} if rng.random() < .5 else {"box": [[1, 1], place()]}))
                try:
                    with d.edit():
                        if mine:
                            d.move([rng.choice(mine)], [place()])
                        if rng.random() < .4:
                            d.add_points([place()], ids=[rng.randrange(1000, 10**6)])
                except lm.GeometryError:
                    pass
                try:
                    pulled += view.pull() is not None
                    pushed += view.push()
                except lm.GeometryError as error:
                    # Both alone were possible, both together are not: one side prevails.
                    self.assertNotEqual(error.code, "conflict", error)
                    d.undo()
                    view.pull()
                    view.push()
                self.require_same(d, page)
                self.assertIsNone(view.pull())
                self.assertFalse(view.push())
            self.assertGreater(min(pulled, pushed), 5)

    def test_edits_of_both_sides_that_differ_are_conflicts(self):
        d = room()
        with shown(d) as view:
            page = self.page_of(view)
            page.ask(do="drag", point=5, at=[2, 1.5], drop=True)
            page.ask(do="point", at=[.5, .5])  # its id is 7
            d.move([5], [(2, .8)])
            self.assertEqual(d.add_points([(.5, 3)]).tolist(), [7])
            d.update()
            was = simplices_of(d), simplices_of_page(page)
            for way in (view.pull, view.push):
                with self.assertRaisesRegex(lm.GeometryError, "point 5, point 7: edited both") as e:
                    way()
                self.assertEqual(e.exception.code, "conflict")
                self.assertEqual(e.exception.features, [("point", 5), ("point", 7)])
            self.assertEqual((simplices_of(d), simplices_of_page(page)), was)
            view.pull(force=True)
            self.assertEqual(d.graph().points[5].tolist(), [2, 1.5])
            self.require_same(d, page)
            page.ask(do="drag", point=5, at=[2, 1.6], drop=True)
            d.move([5], [(2, .8)])
            d.update()
            view.push(force=True)
            self.require_same(d, page)
            self.assertEqual(d.graph().points[5].tolist(), [2, .8])
            # The same on both sides is none.
            page.ask(do="drag", point=5, at=[2, 1.7], drop=True)
            d.move([5], [(2, 1.7)])
            d.update()
            self.assertIsNone(view.pull())

    def test_what_cannot_be_together_changes_nothing(self):
        d = room()
        with shown(d) as view:
            page = self.page_of(view)
            page.ask(do="line", through=[[1, 3], [2, 3]])
            q = d.add_points([(1.5, 2.5), (1.5, 3.5)], ids=[100, 101])
            line = d.add_segment(q[0], q[1], id=50)
            d.update()
            was = simplices_of(d), simplices_of_page(page)
            with self.assertRaises(lm.GeometryError) as pulled:
                view.pull()
            with self.assertRaises(lm.GeometryError) as pushed:
                view.push()
            for error in (pulled.exception, pushed.exception):
                self.assertEqual(error.code, "crossing_segments")
                self.assertIn(("line", line), error.features)
                np.testing.assert_allclose(error.at[0], (1.5, 3))
            self.assertFalse(d.pending)
            self.assertEqual((simplices_of(d), simplices_of_page(page)), was)
            d.undo()
            view.pull()
            self.require_same(d, page)
            d.add_points([(3.5, 3.5)])
            page.ask(do="point", at=[.2, .2])
            with self.assertRaisesRegex(ValueError, "announced"):
                view.pull()
            d.discard()
            view.pull()
            self.require_same(d, page)

    def test_misuse(self):
        d = room()
        with self.assertRaisesRegex(FileNotFoundError, "not in PATH.*command line tool"):
            d.view(tool="no_such_mesher", browser=False)
        with self.assertRaisesRegex(lm.Error, "false view: it has ended without a message"):
            d.view(tool="false", browser=False)
        with self.assertRaises(ValueError):
            d.view(tool=TOOL, browser=False, port=70000)
        with self.assertRaises(TypeError):
            d.view(tool=TOOL, browser=False, port="x")
        odd = lm.LiveMesh(bounds=((0, 0), (1, 1)), size=lm.Sizes.function(
            lambda xy: .1, slope=0, least=.1, dimension=2))
        with self.assertRaisesRegex(ValueError, "only those of samples"):
            shown(odd)
        with shown(d) as view:
            with self.assertRaisesRegex(lm.Error, "cannot listen"):
                shown(d, port=urllib.parse.urlsplit(view.address).port)
        self.assertTrue(view.closed)
        for use in (view.pull, view.push):
            with self.assertRaisesRegex(ValueError, "closed"):
                use()
        view.close()
        view = shown(d)
        view._process.send_signal(signal.SIGKILL)
        view._process.wait()
        self.assertTrue(view.closed)
        with self.assertRaisesRegex(lm.Error, "has ended"):
            view.pull()
        view.close()

    def test_ends(self):
        d = room()
        view = shown(d)
        process, folder = view._process, os.path.dirname(view._errors)
        self.assertTrue(os.path.isdir(folder))
        view.close()
        self.assertEqual(process.returncode, 0)
        self.assertFalse(os.path.exists(folder))
        view = shown(d)
        process = view._process
        del view
        gc.collect()
        self.assertEqual(process.returncode, 0)
        # The live mesh may go before.
        view = shown(d)
        del d
        view.close()
        self.assertEqual(view._process.returncode, 0)

    def test_ends_with_the_interpreter(self):
        program = ("import livemesh as lm, os, signal, sys\n"
                   "d = lm.LiveMesh(bounds=((0, 0), (1, 1)))\n"
                   "d.update()\n"
                   f"v = d.view(browser=False, tool={TOOL!r})\n"
                   "print(v._process.pid, os.path.dirname(v._errors), flush=True)\n"
                   "if sys.argv[1] == 'interrupt':\n"
                   "    try:\n"
                   "        os.killpg(0, signal.SIGINT)\n"
                   "    except KeyboardInterrupt:\n"
                   "        pass\n"
                   "    print(v.closed, v.pull())\n"
                   "if sys.argv[1] == 'kill': os.kill(os.getpid(), signal.SIGKILL)\n"
                   "if sys.argv[1] == 'raise': raise RuntimeError\n")
        for way in ("end", "raise", "interrupt", "kill"):
            ran = subprocess.run([sys.executable, "-c", program, way], capture_output=True,
                                 text=True, timeout=60, start_new_session=True)
            said = ran.stdout.split()
            if way == "interrupt":
                self.assertEqual(said[2:], ["False", "None"], ran.stderr)
            for _ in range(100):
                if not os.path.exists(f"/proc/{said[0]}"):
                    break
                time.sleep(.05)
            else:
                self.fail(f"{way}: the program goes on")
            if way != "kill":
                self.assertFalse(os.path.exists(said[1]), way)


if __name__ == "__main__":
    if not TOOL:
        sys.exit(77)
    unittest.main()
