"""The shape of least resistance: the corner of an L-shaped duct is moved until the mesh's first
Dirichlet energy of a potential between the two ends is least. Gradient-free, one corner of freedom:
each trial is an update, and a trial that is worse is undone.

    optimise_shape.py [TRIALS]
"""
import sys

import numpy as np

import livemesh as lm

DUCT = np.array([(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (0, 1)], float)
CORNER = 4  # the inner one, whose position is free


def energy(d, sweeps=200):
    """Of the harmonic function that is 0 at the left end and 1 at the upper one, on linear
    elements, by conjugate gradients."""
    points, cells, _ = d.compact()
    x = points[cells]
    edges = x[:, [2, 0, 1]] - x[:, [1, 2, 0]]
    area = .5 * (edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
    stiff = np.einsum("eik,ejk->eij", edges, edges) / (4 * area[:, None, None])

    def apply(u):
        return np.bincount(cells.ravel(), np.einsum("eij,ej->ei", stiff, u[cells]).ravel(),
                           len(points))

    fixed = (points[:, 0] == 0) | (points[:, 1] == 3)
    u = np.where(points[:, 1] == 3, 1.0, 0.0)
    r = np.where(fixed, 0, -apply(u))
    p, rr = r.copy(), r @ r
    for _ in range(sweeps):
        if rr < 1e-20:
            break
        ap = np.where(fixed, 0, apply(p))
        step = rr / (p @ ap)
        u, r = u + step * p, r - step * ap
        rr, old = r @ r, rr
        p = r + rr / old * p
    return u @ apply(u)


def optimise(trials=30):
    """The best corner found, and the energies of the start and of the best."""
    d = lm.LiveMesh(bounds=((0, 0), (3, 3)), min_angle=25, max_area=.02)
    ids = d.add_points(DUCT)
    d.add_polyline(list(range(6)) + [0])
    d.update()
    first = best = energy(d)
    corner, stride = DUCT[CORNER].copy(), .2
    directions = np.array([(1, 0), (0, 1), (-1, 0), (0, -1)])
    for trial in range(trials):
        to = np.clip(corner + stride * directions[trial % 4], .3, 2.7)
        try:
            with d.edit():
                d.move(ids[[CORNER]], to)
        except lm.GeometryError:  # the duct would cross itself
            continue
        value = energy(d)
        if value > best:  # a wider duct conducts more: the energy is its conductance
            best, corner = value, to
        else:
            d.undo()
        if trial % 4 == 3:
            stride *= .9
    return corner, first, best


if __name__ == "__main__":
    at, before, after = optimise(int(sys.argv[1]) if len(sys.argv) > 1 else 30)
    print(f"corner at ({at[0]:.2f}, {at[1]:.2f}): conductance {before:.3f}, then {after:.3f}")
    assert after >= before
