"""A periodic cell: a square with a hole whose opposite sides have the same vertices, so that copies
of it fit together to the right and upward.

    periodic_cell.py [OUTPUT]
"""
import sys

import numpy as np

import livemesh as lm

RADIUS = .3
CENTRE = np.array([.55, .5])


def hole(n=24):
    angle = 2 * np.pi * np.arange(n) / n
    return CENTRE + RADIUS * np.column_stack((np.cos(angle), np.sin(angle)))


def cell():
    ring = hole()
    points = np.vstack(([(0, 0), (1, 0), (1, 1), (0, 1)], ring))
    around = list(range(4, 4 + len(ring)))
    mesh = lm.mesh(points, polylines=[[0, 1], [1, 2], [3, 2], [0, 3], [*around, around[0]]],
                   polyline_markers=[1, 2, 3, 4, 5], holes=[CENTRE], min_angle=25,
                   size=lambda at: .02 + .1 * np.abs(at[:, 0] - .9), periodic=[(4, 2), (1, 3)])
    return mesh.name(facets={"left": 4, "right": 2, "bottom": 1, "top": 3, "hole": 5})


def unknowns(mesh):
    """For each point the number of its unknown: twins have one."""
    number = np.arange(len(mesh.points))
    for sides in mesh.periodic:
        first, second = number[sides.points.T]
        for a, b in zip(first, second):  # corners are in two pairs of sides
            number[number == b] = a
    return np.unique(number, return_inverse=True)[1]


def main():
    mesh = cell()
    for sides in mesh.periodic:
        print(f"{len(sides.points)} twins, {sides.translation.tolist()} from each other")
    print(f"{len(mesh.cells)} triangles, {len(mesh.points)} vertices, "
          f"{unknowns(mesh).max() + 1} unknowns")
    if len(sys.argv) > 1:
        mesh.write(sys.argv[1])


if __name__ == "__main__":
    main()
