"""Heat in a room around an obstacle that moves: the temperature stays where the mesh stays.

Each step moves the obstacle, carries the temperature over by slots, and makes one implicit step of
the heat equation by linear elements. With `--anew` every step meshes anew, and interpolates in the
whole mesh. Needs scipy.

    heat_around_obstacle.py [--anew] [STEPS]
"""
import sys
import time

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

import livemesh as lm

ROOM = np.array([(0, 0), (4, 0), (4, 2), (0, 2)], float)
OBSTACLE = np.array([(.6, .7), (1, .7), (1, 1.3), (.6, 1.3)])
OPTIONS = dict(min_angle=28, max_area=2e-3)
STEP, CONDUCTIVITY = .02, .1


def heat_step(points, cells, u):
    """One implicit step; cold at the left of the room, warm at the right."""
    x = points[cells]
    edges = x[:, [2, 0, 1]] - x[:, [1, 2, 0]]  # across from each corner
    area = .5 * (edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
    stiff = CONDUCTIVITY * np.einsum("eik,ejk->eij", edges, edges) / (4 * area[:, None, None])
    mass = area[:, None, None] / 12 * (1 + np.eye(3)) / STEP
    rows, columns = np.repeat(cells, 3, 1).ravel(), np.tile(cells, 3).ravel()
    n = len(points)
    matrix = scipy.sparse.csr_matrix(((stiff + mass).ravel(), (rows, columns)), (n, n))
    right = scipy.sparse.csr_matrix((mass.ravel(), (rows, columns)), (n, n)) @ u
    fixed = (points[:, 0] == 0) | (points[:, 0] == 4)
    values = np.where(points[:, 0] == 4, 1.0, 0.0)
    free = np.flatnonzero(~fixed)
    right -= matrix @ np.where(fixed, values, 0)
    u = values.copy()
    u[free] = scipy.sparse.linalg.spsolve(matrix[free][:, free], right[free])
    return u


def at_step(i):
    return OBSTACLE + (.02 * i, 0)


def follow(steps):
    """The mesh follows; returns the solver's mesh, the temperature, and the time of meshing."""
    d = lm.LiveMesh(bounds=((0, 0), (4, 2)), **OPTIONS)
    p = d.add_points(np.concatenate((ROOM, OBSTACLE)))
    d.add_polyline([0, 1, 2, 3, 0])
    d.add_polyline([4, 5, 6, 7, 4])
    hole = d.add_holes([OBSTACLE.mean(0)])
    d.update()
    u = d.points[:, 0] / 4
    meshing = 0.0
    for i in range(1, steps + 1):
        start = time.perf_counter()
        with d.edit() as change:
            d.move(p[4:], at_step(i))
            d.remove_holes(hole)
            d.add_holes([at_step(i).mean(0)], ids=hole)
        u = change.transfer(u)
        meshing += time.perf_counter() - start
        points, cells, slot_of = d.compact()
        u[slot_of] = heat_step(points, cells, u[slot_of])
    points, cells, slot_of = d.compact()
    return points, cells, u[slot_of], meshing


def mesh_anew(steps):
    """The same with a new mesh in each step."""
    import scipy.interpolate

    def at(i):
        corners = at_step(i)
        return lm.mesh(np.concatenate((ROOM, corners)), holes=[corners.mean(0)],
                       polylines=[[0, 1, 2, 3, 0], [4, 5, 6, 7, 4]], **OPTIONS)

    m = at(0)
    u = m.points[:, 0] / 4
    meshing = 0.0
    for i in range(1, steps + 1):
        start = time.perf_counter()
        new = at(i)
        near = scipy.interpolate.NearestNDInterpolator(m.points, u)
        values = scipy.interpolate.LinearNDInterpolator(m.points, u)(new.points)
        u = np.where(np.isnan(values), near(new.points), values)
        m = new
        meshing += time.perf_counter() - start
        u = heat_step(m.points, m.cells, u)
    return m.points, m.cells, u, meshing


def main():
    anew = "--anew" in sys.argv
    steps = int(next((a for a in sys.argv[1:] if a.isdigit()), 40))
    points, cells, u, meshing = (mesh_anew if anew else follow)(steps)
    assert -1e-9 <= u.min() and u.max() <= 1 + 1e-9, "the maximum principle"
    print(f"{steps} steps, {len(cells)} triangles, mean temperature {u.mean():.4f}, meshing and "
          f"transfer {1e3 * meshing / steps:.2f} ms a step")


if __name__ == "__main__":
    main()
