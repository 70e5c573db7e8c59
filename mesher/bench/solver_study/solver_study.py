#!/usr/bin/python3
"""What bounds of dihedral angles (`mesher mesh --min-dihedral`) do to a solver: linear elements for
heat and elasticity on the tetrahedra that closed surfaces enclose. One JSON line a figure.

    solver_study.py MESHER MODEL... [--algorithms svr,refine] [--bounds 0,10,12,15] [--max-size H]
                    [--tetgen 0,10,15] [--fixed all,end] [--solvers]

MODEL is an .obj, .off, .stl or .ply that `mesher mesh --surface` takes; TetGen needs .obj. Each is
meshed with rho = 2 by each algorithm and with each bound (0: none), and by `tetgen -pq2.0/BOUND`
(1.5). Models are moved and scaled to a longest side of 2, where the solutions are smooth; H is in
that scale. Fixed are all vertices on the boundary (`all`), or only those in the first tenth of the
longest side, where a part is clamped, and the rest of the boundary is free (`end`).

    mesh    vertices, tetrahedra, those under 5 and 10 degrees, the least dihedral angle
    solve   relative errors in L2 and energy; the largest eigenvalue of the matrix over the median
            of its diagonal, and of the matrix scaled to a diagonal of 1; conditions of both, as
            conjugate gradients met them; iterations to a residual of 10^-8 without preconditioner,
            with the diagonal (Jacobi), and with incomplete Cholesky without fill, and by which part
            its diagonal was raised; processor seconds of these, without making the preconditioner
    getdp, calculix   with --solvers, on meshes by svr: the same systems by these programs
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

import debian_solvers
from elements import (Elasticity, Heat, assemble, boundary_faces, errors, freedoms,
                      least_dihedral_angles)
from iterate import conjugate_gradients, incomplete_cholesky, largest_eigenvalue, scaled


def line(figure, **values):
    rounded = {k: float(f"{v:.5g}") if isinstance(v, float) else v for k, v in values.items()}
    print(json.dumps({"bench": "solver_study", "figure": figure, **rounded}), flush=True)


# --- Meshes --------------------------------------------------------------------------------------


def read_mesh(stem):
    """Of .node and .ele, in orders of positive volume."""
    points = _rows(stem + ".node", 4)
    first = int(points[0, 0])
    cells = _rows(stem + ".ele", 5)[:, 1:].astype(int) - first
    p = points[:, 1:][cells]
    turned = np.linalg.det(p[:, 1:] - p[:, :1]) < 0
    cells[turned] = cells[turned][:, [0, 1, 3, 2]]
    return points[:, 1:], cells


def _rows(path, width):
    with open(path, encoding="ascii") as lines:
        fields = [row.split() for row in lines if not row.startswith("#")]
    return np.array([row[:width] for row in fields[1:] if row], float)


def fitted(mesh, box):
    """The mesh moved and scaled as the model's box: low corner, and its longest side."""
    low, side = box
    return (mesh[0] - low) * (2 / side) - 1, mesh[1]


def mesh_by_mesher(mesher, model, algorithm, bound, max_size):
    command = [mesher, "mesh", model, "--surface", "--algorithm", algorithm, "--quiet",
               "-o", "ours.node"]
    command += ["--min-dihedral", str(bound)] if bound else []
    command += ["--max-size", str(max_size)] if max_size else []
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return read_mesh("ours")


def mesh_by_tetgen(model, bound):
    corners, faces = read_obj(model)
    with open("theirs.smesh", "w", encoding="ascii") as file:
        print(len(corners), 3, 0, 0, file=file)
        for i, corner in enumerate(corners):
            print(i, *corner, file=file)
        print(len(faces), 0, file=file)
        for face in faces:
            print(len(face), *face, file=file)
        print("0\n0", file=file)
    subprocess.run(["tetgen", f"-pq2.0/{bound}Q", "theirs.smesh"], check=True,
                   stdout=subprocess.DEVNULL)
    return read_mesh("theirs.1")


def read_obj(path):
    corners, faces = [], []
    with open(path, encoding="utf-8") as lines:
        for row in map(str.split, lines):
            if row[:1] == ["v"]:
                corners.append(row[1:4])
            elif row[:1] == ["f"]:
                faces.append([int(corner.split("/")[0]) - 1 for corner in row[1:]])
    return corners, faces


# --- Figures -------------------------------------------------------------------------------------


def describe_mesh(mesh, name):
    angles = least_dihedral_angles(mesh)
    line("mesh", **name, vertices=len(mesh[0]), tetrahedra=len(mesh[1]),
         below_5=int((angles < 5).sum()), below_10=int((angles < 10).sum()),
         least_dihedral_deg=float(angles.min()))


def fixed_vertices(mesh, which):
    if which == "all":
        return np.unique(boundary_faces(mesh[1]))
    along = mesh[0][:, np.argmax(np.ptp(mesh[0], axis=0))]
    return np.flatnonzero(along < along.min() + 0.1 * np.ptp(along))


class System:
    """The free part of a problem on a mesh: matrix and right side, and the fixed values."""

    def __init__(self, problem, mesh, fixed):
        whole, self.load = assemble(problem, mesh)
        self.values = np.zeros(len(self.load))
        held = freedoms(fixed, problem.components)
        self.values[held] = problem.exact(mesh[0][fixed]).ravel()
        self.free = np.setdiff1d(np.arange(len(self.load)), held)
        self.right = (self.load - whole @ self.values)[self.free]
        self.matrix = whole[self.free][:, self.free].tocsr()

    def solution(self, x):
        all_of_it = self.values.copy()
        all_of_it[self.free] = x
        return all_of_it


def timed(matrix, right, precondition):
    start = time.process_time()
    found = conjugate_gradients(matrix, right, precondition)
    return *found, time.process_time() - start


def solve(problem, mesh, which, name):
    system = System(problem, mesh, fixed_vertices(mesh, which))
    a, b, d = system.matrix, system.right, system.matrix.diagonal()
    _, plain, ritz, plain_s = timed(a, b, lambda r: r)
    _, jacobi, scaled_ritz, jacobi_s = timed(a, b, lambda r: r / d)
    precondition, shift = incomplete_cholesky(a)
    x, cholesky, _, cholesky_s = timed(a, b, precondition)
    l2, energy = errors(problem, mesh, system.solution(x))
    line("solve", **name, problem=problem.name, fixed=which, unknowns=len(b), l2_error=l2,
         energy_error=energy, largest_eigenvalue=largest_eigenvalue(a) / float(np.median(d)),
         largest_scaled=largest_eigenvalue(scaled(a)), condition=ritz[1] / ritz[0],
         condition_scaled=scaled_ritz[1] / scaled_ritz[0], iterations=plain,
         iterations_jacobi=jacobi, iterations_cholesky=cholesky, shift=shift,
         seconds=plain_s, seconds_jacobi=jacobi_s, seconds_cholesky=cholesky_s)
    return system, system.solution(x)


def compare_solvers(mesh, name):
    for preconditioner in debian_solvers.GETDP_OPTIONS:
        line("getdp", **name, **debian_solvers.getdp(mesh, preconditioner))
    problem, fixed = Elasticity(), fixed_vertices(mesh, "end")
    load, values = assemble(problem, mesh)[1], problem.exact(mesh[0][fixed])
    for solver in debian_solvers.CALCULIX_SOLVERS:
        solution, told = debian_solvers.calculix(mesh, problem, fixed, values, load, solver)
        l2, energy = errors(problem, mesh, solution)
        line("calculix", **name, solver=solver, **told, l2_error=l2, energy_error=energy)


def meshes(arguments, model):
    """(mesher, bound, mesh) of all that was asked for."""
    for algorithm in filter(None, arguments.algorithms.split(",")):
        for bound in map(int, arguments.bounds.split(",")):
            yield algorithm, bound, mesh_by_mesher(arguments.mesher, model, algorithm, bound,
                                                   arguments.max_size * arguments.side / 2)
    for bound in filter(None, arguments.tetgen.split(",")):
        yield "tetgen", int(bound), mesh_by_tetgen(model, int(bound))


def study(arguments, models):
    for model in models:
        corners = mesh_by_mesher(arguments.mesher, model, "refine", 0, 0)[0]
        low, arguments.side = corners.min(axis=0), float(np.ptp(corners, axis=0).max())
        for algorithm, bound, mesh in meshes(arguments, model):
            mesh = fitted(mesh, (low, arguments.side))
            name = {"model": os.path.splitext(os.path.basename(model))[0], "mesher": algorithm,
                    "bound": bound}
            describe_mesh(mesh, name)
            for problem in (Heat(), Elasticity()):
                for which in arguments.fixed.split(","):
                    solve(problem, mesh, which, name)
            if arguments.solvers and algorithm == "svr":
                compare_solvers(mesh, name)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesher")
    parser.add_argument("models", nargs="+")
    parser.add_argument("--algorithms", default="svr,refine")
    parser.add_argument("--bounds", default="0,10,12,15")
    parser.add_argument("--max-size", type=float, default=0)
    parser.add_argument("--tetgen", default="")
    parser.add_argument("--fixed", default="all,end")
    parser.add_argument("--solvers", action="store_true")
    arguments = parser.parse_args()
    arguments.mesher = os.path.abspath(arguments.mesher)
    models = [os.path.abspath(model) for model in arguments.models]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        study(arguments, models)
        os.chdir("/")


if __name__ == "__main__":
    sys.exit(main())
