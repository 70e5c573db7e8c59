"""A periodic cell: a square with a hole whose left and right sides have the same vertices.

    periodic_cell.py [OUTPUT]

Mesh, give both sides the vertices that either has, and mesh again, until they agree.
"""
import sys

import numpy as np

import livemesh as lm

RADIUS = .3
CENTRE = np.array([.55, .5])


def hole(n=24):
    angle = 2 * np.pi * np.arange(n) / n
    return CENTRE + RADIUS * np.column_stack((np.cos(angle), np.sin(angle)))


def cell(heights):
    """The mesh of the square whose left and right sides have points at these heights."""
    sides = [np.column_stack((np.full(len(heights), x), heights)) for x in (0., 1.)]
    ring = hole()
    points = np.vstack(([(0, 0), (1, 0), (1, 1), (0, 1)], *sides, ring))
    left = range(4, 4 + len(heights))
    right = range(4 + len(heights), 4 + 2 * len(heights))
    around = list(range(len(points) - len(ring), len(points)))
    return lm.mesh(points, polylines=[[0, 1], [1, *right, 2], [2, 3], [0, *left, 3],
                                      [*around, around[0]]],
                   polyline_markers=[1, 2, 3, 4, 5], holes=[CENTRE], min_angle=25,
                   size=lambda at: .02 + .1 * np.abs(at[:, 0] - .9))


def heights_on(mesh, marker):
    """The heights of the vertices inside a side, ascending."""
    y = mesh.points[np.unique(mesh.facets[mesh.facet_markers == marker]), 1]
    return np.unique(y[(y > 0) & (y < 1)])


def periodic(most=20):
    heights = np.empty(0)
    for rounds in range(1, most + 1):
        mesh = cell(heights)
        right, left = heights_on(mesh, 2), heights_on(mesh, 4)
        if np.array_equal(left, right):
            return mesh.name(facets={"right": 2, "left": 4, "hole": 5}), rounds
        heights = np.union1d(left, right)
    raise RuntimeError(f"the sides differ after {most} rounds")


def main():
    mesh, rounds = periodic()
    print(f"{len(mesh.cells)} triangles, {len(heights_on(mesh, 2))} vertices in each side, "
          f"after {rounds} rounds")
    if len(sys.argv) > 1:
        mesh.write(sys.argv[1])


if __name__ == "__main__":
    main()
