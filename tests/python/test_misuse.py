"""Misuse raises; it never ends the interpreter. What could end it runs in a process of its own."""
import os
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import unittest
import warnings

import numpy as np

import livemesh as lm

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
RING = [[0, 1, 2, 3, 0]]


def run(program, **environment):
    """The end of a Python program that has lm and np; its exit code must be 0."""
    text = "import livemesh as lm, numpy as np, os, signal, sys, threading, time\n"
    process = subprocess.run([sys.executable, "-c", text + textwrap.dedent(program)], timeout=300,
                             capture_output=True, text=True, env={**os.environ, **environment})
    if process.returncode != 0:
        raise AssertionError(f"exit code {process.returncode}\n{process.stdout}{process.stderr}")
    return process.stdout, process.stderr


class Arguments(unittest.TestCase):
    def test_shapes_and_types(self):
        d = lm.LiveMesh(bounds=((0, 0), (1, 1)))
        mistakes = (
                lambda: lm.mesh([1, 2, 3]), lambda: lm.mesh(np.zeros((3, 4))),
                lambda: lm.mesh(SQUARE, segments=[(0, 1, 2)]),
                lambda: lm.mesh(SQUARE, segments=[(0.5, 1.5)]),
                lambda: lm.mesh(SQUARE, segments=[(0, 1)], segment_markers=[1, 2]),
                lambda: lm.mesh(SQUARE, polylines=[[0]]),
                lambda: lm.mesh(SQUARE, holes=[(1, 2, 3)]),
                lambda: lm.mesh(SQUARE, regions=[(1,)]),
                lambda: lm.mesh("x.poly", segments=[(0, 1)]),
                lambda: lm.mesh(SQUARE, max_volume=1), lambda: lm.mesh(SQUARE, size=-1),
                lambda: lm.mesh(SQUARE, extent="all"), lambda: lm.mesh(SQUARE, algorithm="best"),
                lambda: lm.mesh(SQUARE, min_angle=np.nan), lambda: lm.mesh(SQUARE, max_area=0),
                lambda: lm.mesh(SQUARE, timeout=-1), lambda: lm.mesh(SQUARE, timeout=np.nan),
                lambda: lm.mesh(SQUARE, bounds=(0, 1)), lambda: lm.mesh(SQUARE, wrong=1),
                lambda: lm.mesh(SQUARE, polygons=[(0, 1, 2)]), lambda: lm.mesh(object()),
                lambda: lm.mesh({"type": "Nonsense"}), lambda: lm.mesh((SQUARE, [3, 0, 1])),
                lambda: lm.mesh(SQUARE).quality("beauty"),
                lambda: lm.mesh(SQUARE).quality("min_dihedral"),
                lambda: d.add_points([(1, 2, 3)]), lambda: d.move([0, 1], [(0, 0)]),
                lambda: d.add_points([("a", "b")]), lambda: d.add_polygon([0, 1, 2]),
                lambda: d.add_polyline([0]), lambda: d.remove_points([0.5]),
                lambda: d.regions_of([10**9]), lambda: d.limit(box=(0, 1)),
                lambda: d.add_points([(.5, .5)], ids=[2**63]),
                lambda: lm.LiveMesh(bounds=(0, 1)), lambda: d.undo(),
                lambda: lm.Change().transfer([1.0]))
        for i, mistake in enumerate(mistakes):
            with self.subTest(i), self.assertRaises((ValueError, TypeError, OverflowError)):
                mistake()

    def test_numbers_that_would_wrap(self):
        d = lm.LiveMesh(bounds=((0, 0), (1, 1)))
        p = d.add_points(SQUARE)
        d.update()
        space = lm.LiveMesh(bounds=((0, 0, 0), (1, 1, 1)))
        space.add_points([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
        space.update()
        kept = int(np.flatnonzero(d.cell_used)[0])
        complex_points = np.array(SQUARE) + 0j
        mistakes = [lambda: d.regions_of([2**32 + kept]), lambda: d.regions_of([kept - 2**32]),
                    lambda: lm.mesh(SQUARE, max_vertices=-1),
                    lambda: lm.mesh(SQUARE, max_vertices=2**64 + 5),
                    lambda: lm.LiveMesh(bounds=((0, 0), (1, 1)), max_vertices=-1),
                    lambda: lm.LiveMesh(bounds=((0, 0), (1, 1)), undo=-1),
                    lambda: lm.mesh(SQUARE, tiles=2), lambda: lm.mesh(SQUARE, threads=2),
                    lambda: lm.mesh(SQUARE, out_of_core="tiles", tiles=-1),
                    lambda: lm.mesh(SQUARE, out_of_core="tiles", threads=257),
                    lambda: lm.mesh(SQUARE, out_of_core="tiles", tiles="2"),
                    lambda: lm.mesh(SQUARE, out_of_core=""),
                    lambda: lm.mesh(SQUARE, out_of_core="a\0b"),
                    lambda: lm.mesh(SQUARE, out_of_core=7),
                    lambda: lm.mesh(SQUARE, out_of_core="tiles", periodic=[(1, 2)]),
                    lambda: lm.LiveMesh(bounds=((0, 0), (1, 1)), threads=0),
                    lambda: lm.LiveMesh(bounds=((0, 0), (1, 1)), threads=257),
                    lambda: lm.LiveMesh(bounds=((0, 0), (1, 1)), undo="3"),
                    lambda: lm.LiveMesh(bounds=np.array(((0, 0), (1, 1 + 1j)))),
                    lambda: lm.mesh(complex_points), lambda: d.add_points(complex_points),
                    lambda: d.find(list(complex_points)), lambda: lm.mesh([("0", "1")]),
                    lambda: lm.mesh(SQUARE, size=lambda at: at[:, 0] + 1 + 0j),
                    lambda: lm.mesh(SQUARE, point_markers=2**64 + 5),
                    lambda: lm.Graph(SQUARE, polylines=RING, polyline_markers=2**63),
                    lambda: lm.Sizes.function(lambda _: 1., "x", .1, 2),
                    lambda: lm.Sizes.function(lambda _: 1., 1, .1, "2")]
        for wrong in (2**63, 2**64 + 5, -2**63 - 1, "x", 1.5, np.uint64(2**63)):
            mistakes += [lambda w=wrong: d.add_polyline([0, 1], id=w),
                         lambda w=wrong: d.add_polyline([0, 1], marker=w),
                         lambda w=wrong: d.add_segment(0, 1, marker=w),
                         lambda w=wrong: d.add_segment(0, 1, id=w),
                         lambda w=wrong: space.add_polygon([0, 1, 2], marker=w),
                         lambda w=wrong: space.add_polygon([0, 1, 2], id=w)]
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "nul.vtu")
            m = lm.mesh(SQUARE)
            m.write(name)
            for path in (name + "\0.node", name.encode() + b"\0.vtu"):
                mistakes += [lambda p=path: m.write(p), lambda p=path: lm.Mesh.read(p),
                             lambda p=path: lm.Graph.read(p), lambda p=path: lm.mesh(os.fsdecode(p)),
                             lambda p=path: lm.Graph(SQUARE).write(p),
                             lambda p=path: lm.Sizes.read(p, 2)]
            for wrong in ("2", 2.0, 2**32 + 2, -1):
                mistakes += [lambda w=wrong: lm.Graph.read(name, dimension=w),
                             lambda w=wrong: lm.Mesh.read(name, dimension=w),
                             lambda w=wrong: lm.Sizes.read(name, w)]
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                for i, mistake in enumerate(mistakes):
                    with self.subTest(i), self.assertRaises((ValueError, TypeError)) as caught:
                        mistake()
                    self.assertNotIsInstance(caught.exception, lm.Error, i)
        self.assertFalse(d.pending or space.pending)
        self.assertEqual(d.add_polyline(p[:2], id=np.int32(7), marker=np.uint8(3)), 7)

    def test_values(self):
        for mistake, code in (
                (lambda: lm.mesh([(0, 0), (np.nan, 1)]), "not_finite"),
                (lambda: lm.mesh([(0, 0), (np.inf, 1)]), "not_finite"),
                (lambda: lm.mesh([(0, 0), (1e-40, 1)]), "magnitude"),
                (lambda: lm.mesh([(0, 0), (0, 0)]), "duplicate_point"),
                (lambda: lm.mesh(SQUARE, segments=[(0, 9)]), "unknown_id"),
                (lambda: lm.mesh(SQUARE, segments=[(0, 0)]), "zero_length"),
                (lambda: lm.mesh(SQUARE, min_angle=40), "bad_option"),
                (lambda: lm.mesh(SQUARE, rho=1), "bad_option"),
                (lambda: lm.mesh(SQUARE, regions=[(.5, .5, np.nan)]), "bad_number"),
                (lambda: lm.mesh(SQUARE, regions=[(.5, .5, 1, -1)]), "bad_number"),
                (lambda: lm.mesh(SQUARE, bounds=((0, 0), (.5, .5))), "outside_domain"),
                (lambda: lm.mesh(SQUARE, polylines=RING, max_area=1e-6, max_vertices=100),
                 "too_many"),
                (lambda: lm.LiveMesh(bounds=((0, 0), (0, 0))), "bad_option"),
                (lambda: lm.LiveMesh(bounds=((0, 0), (np.nan, 1))), "bad_option")):
            with self.assertRaises(lm.GeometryError) as caught:
                mistake()
            self.assertEqual(caught.exception.code, code)

    def test_empty_input(self):
        self.assertEqual(lm.mesh(np.empty((0, 2)), polylines=[]).dimension, 2)
        d = lm.LiveMesh(bounds=((0, 0), (1, 1)))
        d.add_points(np.empty((0, 2)))
        self.assertFalse(d.pending)
        self.assertEqual(len(d.points), 0)
        d.update()
        self.assertGreater(len(d.points), 0)

    def test_freed_and_forged_handles(self):
        c = lm._c.c
        m = lm.mesh(SQUARE)
        value = m._handle.value
        for forged in (0, 1, 2**32 + 77, 2**63, value + 2**32, value + 1, value):
            if forged == value:
                c.free(value)  # the mesh does not know
            status = c.mesh_write(forged, b"/tmp/x.vtu")
            self.assertEqual(status, 1, forged)
        with self.assertRaises(ValueError):
            m.points
        self.assertEqual(c.free(value), 1)


class Copies(unittest.TestCase):
    def test_copies_share_what_is_never_changed(self):
        run("""
            import copy, dataclasses, pickle

            @dataclasses.dataclass
            class Case:
                mesh: object

            d = lm.LiveMesh(bounds=((0, 0), (1, 1)))
            d.add_points([(.5, .5)])
            square = [(0, 0), (1, 0), (1, 1), (0, 1)]
            made = (lm.mesh(square).name({"a": 1}), lm.Graph(square), d.update(),
                    lm.Sizes.samples(square, [1, 1, 1, 1]),
                    lm.Sizes.function(lambda _: 1., 1, .1, 2))
            for m in made:
                for of in (copy.copy, copy.deepcopy,
                           lambda m: dataclasses.asdict(Case(m))["mesh"]):
                    before = lm._c.c.objects()
                    c = of(m)
                    assert type(c) is type(m)
                    assert lm._c.c.objects() == before
                    del c
                    assert lm._c.c.objects() == before
                for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
                    try:
                        pickle.dumps(m, protocol)
                        sys.exit(2)
                    except TypeError:
                        pass
            m = made[0]
            p = m.points
            c = copy.deepcopy(m)
            c.name({"b": 2})
            assert m.names["facets"] == {"a": 1}
            del m, made
            assert c.points.sum() == p.sum()
            del c
            assert p.sum() > 0
            for of in (copy.copy, copy.deepcopy, pickle.dumps):
                try:
                    of(d)
                    sys.exit(3)
                except TypeError:
                    pass
            d.update()
        """)


class Callbacks(unittest.TestCase):
    def test_progress_stops(self):
        seen = []

        def progress(p):
            seen.append(p)
            return len(seen) < 3

        with self.assertRaises(lm.Cancelled):
            lm.mesh(SQUARE, polylines=RING, max_area=1e-6, progress=progress)
        self.assertEqual(len(seen), 3)
        self.assertIn(seen[0].phase, lm.Progress.PHASES)

    def test_timeout(self):
        start = time.monotonic()
        with self.assertRaises(lm.Cancelled):
            lm.mesh(SQUARE, polylines=RING, max_area=1e-7, timeout=.2)
        self.assertLess(time.monotonic() - start, 5)

    def test_timeout_counts_the_samples_of_a_size(self):
        calls = []

        def slow(at):
            calls.append(len(at))
            time.sleep(.1)
            return .01 + np.abs(np.sin(20 * at[:, 0] * at[:, 1]))

        start = time.monotonic()
        with self.assertRaises(lm.Cancelled):
            lm.mesh(SQUARE, polylines=RING, size=slow, timeout=.15)
        self.assertLess(time.monotonic() - start, 5)
        self.assertLessEqual(len(calls), 3)
        calls.clear()
        with self.assertRaises(lm.Cancelled):
            lm.mesh(SQUARE, polylines=RING, size=slow, timeout=0)
        with self.assertRaises(ValueError):
            lm.mesh(SQUARE, polylines=RING, size=slow, timeout=-1)
        self.assertEqual(calls, [])
        with self.assertRaises(lm.Cancelled):  # what is left of it is for the run
            lm.mesh(SQUARE, polylines=RING, max_area=1e-7, timeout=.5,
                    size=lambda at: time.sleep(.1) or np.ones(len(at)))

    def test_sizes_are_sampled_in_the_bounds(self):
        seen = []

        def size(at):
            seen.append(at.copy())
            return .05 + .2 * np.abs(at[:, 0])

        m = lm.mesh(SQUARE, size=size, bounds=((-2, -3), (3, 4)), extent="box")
        self.assertLessEqual(m.points[:, 0].min(), -2)
        at = np.concatenate(seen)
        self.assertLess(max(len(each) for each in seen), 20000)
        np.testing.assert_array_equal(at.min(0), (-2, -3))
        self.assertTrue((at.max(0) >= (3, 4)).all())
        with self.assertRaises(lm.GeometryError):
            lm.mesh(SQUARE, size=size, bounds=((0, 0), (np.nan, 1)))

    def test_exceptions_are_carried_over(self):
        class Mine(Exception):
            pass

        def fail(_):
            raise Mine("x")

        with self.assertRaises(Mine):
            lm.mesh(SQUARE, polylines=RING, max_area=1e-5, progress=fail)
        with self.assertRaises(Mine):
            lm.mesh(SQUARE, polylines=RING, size=fail)
        sizes = lm.Sizes.function(fail, 1, .1, 2)
        with self.assertRaises(Mine):
            lm.mesh(SQUARE, polylines=RING, size=sizes)
        d = lm.LiveMesh(bounds=((0, 0), (1, 1)), max_area=1e-4)
        d.add_points(SQUARE)
        with self.assertRaises(Mine):
            d.update(progress=fail)
        self.assertTrue(d.pending)
        d.update()
        self.assertGreater(d.point_used.sum(), 1000)

    def test_sizes_that_are_none(self):
        for bad in (0, -1, np.nan):
            sizes = lm.Sizes.function(lambda _: bad, 1, .1, 2)
            with self.assertRaises(lm.GeometryError):
                lm.mesh(SQUARE, polylines=RING, size=sizes)
            with self.assertRaises(ValueError):
                lm.mesh(SQUARE, polylines=RING, size=lambda xy: bad + 0 * xy[:, 0])

    def test_cancelled_update_goes_on(self):
        d = lm.LiveMesh(bounds=((0, 0), (1, 1)), max_area=1e-4)
        d.add_points(SQUARE)
        d.update()
        before = d.points.copy()
        d.limit(max_area=2e-5)
        with self.assertRaises(lm.Cancelled):
            d.update(timeout=0)
        self.assertTrue(d.pending)
        np.testing.assert_array_equal(d.points, before)
        d.update()
        self.assertGreater(len(d.points), 2 * len(before))
        with self.assertRaises(lm.Cancelled):
            with d.edit(timeout=0):
                d.limit(max_area=1e-5)
        self.assertFalse(d.pending)

    def test_a_callback_cannot_use_its_own_mesh(self):
        d = lm.LiveMesh(bounds=((0, 0), (1, 1)), max_area=1e-4)
        d.add_points(SQUARE)
        found = []

        def progress(_):
            for use in (lambda: d.points, lambda: d.update(), lambda: d.add_points([(.5, .5)]),
                        lambda: d.mesh(), lambda: d.discard()):
                try:
                    use()
                except lm.Busy:
                    found.append(1)
            lm.mesh(SQUARE)  # another one it can

        d.update(progress=progress)
        self.assertGreaterEqual(len(found), 5)


class Threads(unittest.TestCase):
    def test_a_second_thread_gets_an_error_or_its_turn(self):
        d = lm.LiveMesh(bounds=((0, 0), (1, 1)), max_area=1e-3)
        d.add_points(SQUARE)
        d.update()
        busy, wrong = [], []

        def work(seed):
            rng = np.random.default_rng(seed)
            for _ in range(60):
                try:
                    ids = d.add_points(rng.uniform(.1, .9, (1, 2)))
                    d.update()
                    d.points.sum()
                    d.cells.max()
                    d.remove_points(ids)
                except lm.Busy:
                    busy.append(1)
                except lm.GeometryError:  # the other's update made a point of ours, or removed it
                    pass
                except BaseException as error:
                    wrong.append(error)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        self.assertEqual(wrong, [])
        d.discard()
        d.update()

    def test_two_meshes_in_two_threads_run_at_a_time(self):
        results = [None, None]

        def work(i):
            results[i] = lm.mesh(SQUARE, polylines=RING, max_area=1e-5).points

        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        np.testing.assert_array_equal(*results)

    def test_the_gil_is_free_meanwhile(self):
        count, done = [0], threading.Event()

        def tick():
            while not done.is_set():
                count[0] += 1
                time.sleep(.001)

        ticker = threading.Thread(target=tick)
        ticker.start()
        lm.mesh(SQUARE, polylines=RING, max_area=1e-5)
        done.set()
        ticker.join()
        self.assertGreater(count[0], 20)


@unittest.skipUnless(hasattr(signal, "SIGKILL"), "POSIX alone")
class Processes(unittest.TestCase):
    def test_ctrl_c_stops_a_mesh(self):
        _, errors = run("""
            threading.Timer(.4, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            start = time.monotonic()
            square = [(0, 0), (1, 0), (1, 1), (0, 1)]
            try:
                lm.mesh(square, polylines=[[0, 1, 2, 3, 0]], max_area=1e-7)
                sys.exit(2)
            except KeyboardInterrupt:
                pass
            assert time.monotonic() - start < 5
            assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
            lm.mesh(square)
        """)
        self.assertEqual(errors, "")

    def test_ctrl_c_stops_the_sampling_of_a_size(self):
        _, errors = run("""
            calls = []
            def size(at):
                calls.append(1)
                time.sleep(.3)
                return .01 + np.abs(np.sin(20 * at[:, 0] * at[:, 1]))
            threading.Timer(.4, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            try:
                lm.mesh([(0, 0), (1, 0), (1, 1), (0, 1)], polylines=[[0, 1, 2, 3, 0]], size=size)
                sys.exit(2)
            except KeyboardInterrupt:
                pass
            assert len(calls) <= 3, len(calls)
        """)
        self.assertEqual(errors, "")

    def test_ctrl_c_stops_an_update_and_the_handler_of_the_program_counts(self):
        _, errors = run("""
            d = lm.LiveMesh(bounds=((0, 0), (1, 1)), max_area=1e-6)
            d.add_points([(0, 0), (1, 1)])
            threading.Timer(.4, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            try:
                d.update()
                sys.exit(2)
            except KeyboardInterrupt:
                pass
            assert d.pending and len(d.points) == 0
            seen = []
            signal.signal(signal.SIGINT, lambda *_: seen.append(1))
            threading.Timer(.4, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            try:
                d.update()
                sys.exit(3)
            except lm.Cancelled:
                pass
            assert seen == [1]
            d.discard()
            d.limit(max_area=1e-2)
            d.update()
        """)
        self.assertEqual(errors, "")

    def test_out_of_memory(self):
        run("""
            import resource
            square = [(0, 0), (1, 0), (1, 1), (0, 1)]
            d = lm.LiveMesh(bounds=((0, 0), (1, 1)))
            d.add_points(square)
            d.update()
            used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
            resource.setrlimit(resource.RLIMIT_AS, (used + (96 << 20), -1))
            for _ in range(3):
                try:
                    lm.mesh(square, polylines=[[0, 1, 2, 3, 0]], max_area=1e-7)
                    sys.exit(2)
                except MemoryError:
                    pass
            d.limit(max_area=1e-6)
            try:
                d.update()
                sys.exit(3)
            except MemoryError:
                pass
            assert not d.pending
            resource.setrlimit(resource.RLIMIT_AS, (-1, -1))
            d.add_points([(.5, .5)])
            d.update()
            assert len(d.mesh().points) > 5
        """)

    def test_an_interpreter_that_ends_amid_objects(self):
        run("""
            m = lm.mesh([(0, 0), (1, 0), (0, 1)])
            a = m.points
            d = lm.LiveMesh(bounds=((0, 0), (1, 1)))
            d.add_points([(.5, .5)])
            c = d.update()
            for algorithm in ("automatic", "gap_balls"):
                threading.Thread(target=lambda: lm.mesh(np.random.rand(100000, 2), progress=print,
                                                        algorithm=algorithm), daemon=True).start()
            time.sleep(.1)
        """)


if __name__ == "__main__":
    unittest.main()
