"""What Python costs: the work of mesher/bench/facade_bench.cpp by the package. One JSON line a figure:

    python_bench.py [N]...          default: 10000 100000 1000000

    mesh      seconds of mesh() of an array; of them in the C interface's lm_mesh_make; and the round
              trip: arrays to a graph, and the arrays of the mesh
    update    the median of updates of a LiveMesh, microseconds: each adds a point, and the next one
              removes it; `follow`: the same, and a field is carried over
    transfer  the median to carry a field through such an update, microseconds

Times are of the process, all threads.
"""
import json
import statistics
import sys
import time

import numpy as np

import livemesh as lm
from livemesh import _c

_MASK = 2**64 - 1


class SplitMix64:
    """As mesher::SplitMix64."""

    def __init__(self, seed):
        self.state = seed

    def units(self, n):
        i = np.arange(1, n + 1, dtype=np.uint64)
        with np.errstate(over="ignore"):
            z = np.uint64(self.state) + i * np.uint64(0x9e3779b97f4a7c15)
            z = (z ^ (z >> np.uint64(30))) * np.uint64(0xbf58476d1ce4e5b9)
            z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94d049bb133111eb)
            z ^= z >> np.uint64(31)
        self.state = (self.state + n * 0x9e3779b97f4a7c15) & _MASK
        return (z >> np.uint64(11)).astype(float) * 2.0**-53


def line(figure, **values):
    print(json.dumps({"bench": "python", "figure": figure, **values}), flush=True)


def mesh_once(points):
    make, inside = _c.c.mesh_make, [0.0]

    def timed(*arguments):
        start = time.process_time()
        status = make(*arguments)
        inside[0] = time.process_time() - start
        return status

    _c.c.mesh_make = timed
    start = time.process_time()
    m = lm.mesh(points)
    shapes = m.points.shape, m.cells.shape, m.point_kinds.shape
    seconds = time.process_time() - start
    _c.c.mesh_make = make
    line("mesh", n=len(points), vertices=shapes[0][0], seconds=round(seconds, 4),
         in_library=round(inside[0], 4), round_trip=round(seconds - inside[0], 4),
         round_trip_share=round((seconds - inside[0]) / inside[0], 4))


def updates(points, random):
    n = len(points)
    for follow in (False, True):
        d = lm.LiveMesh(bounds=((0, 0), (1, 1)))
        d.add_points(points)
        d.update()
        places = random.units(1000).reshape(-1, 2)
        u = d.points[:, 0] + d.points[:, 1] if follow else None
        times, transfers = [], []
        for i, p in enumerate(places):
            for edit in (lambda: d.add_points(p, ids=n), lambda: d.remove_points(n)):
                start = time.process_time()
                edit()
                change = d.update()
                if follow:
                    middle = time.process_time()
                    u = change.transfer(u)
                    transfers.append(1e6 * (time.process_time() - middle))
                times.append(1e6 * (time.process_time() - start))
        line("update", n=n, follow=follow, median_us=round(statistics.median(times), 1))
        if follow:
            line("transfer", n=n, median_us=round(statistics.median(transfers), 1))
            assert np.allclose(u[d.point_used], d.points.sum(1)[d.point_used])


def main():
    for n in [int(a) for a in sys.argv[1:]] or [10000, 100000, 1000000]:
        random = SplitMix64(1)
        points = random.units(2 * n).reshape(-1, 2)
        mesh_once(points)
        updates(points, random)


if __name__ == "__main__":
    main()
