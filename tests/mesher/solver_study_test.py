#!/usr/bin/python3
"""The finite elements of mesher/bench/solver_study are right: on boxes, where answers are known.

    solver_study_test.py REPOSITORY [MESHER]

With MESHER also on meshes of the tool; GetDP and CalculiX, where they are, agree. Exit code 77:
scipy is not installed.
"""
import itertools
import os
import shutil
import sys
import tempfile
import unittest

try:
    import numpy as np
    import scipy  # noqa: F401, pylint: disable=unused-import
except ImportError:
    sys.exit(77)

sys.path.insert(0, os.path.join(os.path.abspath(sys.argv[1]), "mesher/bench/solver_study"))
import debian_solvers  # noqa: E402, pylint: disable=wrong-import-position
import elements  # noqa: E402, pylint: disable=wrong-import-position
import iterate  # noqa: E402, pylint: disable=wrong-import-position
import solver_study  # noqa: E402, pylint: disable=wrong-import-position

MESHER = os.path.abspath(sys.argv[2]) if len(sys.argv) > 2 else None
CORNERS = list(itertools.product((0, 1), repeat=3))
FACES = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]


def cube(n, shake=0.0):
    """The unit cube in n^3 cubes of six tetrahedra; inner vertices move by up to shake / n."""
    at = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    points = np.stack(np.meshgrid(*3 * [np.arange(n + 1) / n], indexing="ij"), -1).reshape(-1, 3)
    inner = ((points > 0) & (points < 1)).all(axis=1)
    moves = np.random.default_rng(5).uniform(-shake / n, shake / n, points.shape)
    points[inner] += moves[inner]
    low, cells = at[:-1, :-1, :-1].ravel(), []
    for order in itertools.permutations(((n + 1) ** 2, n + 1, 1)):
        way = np.cumsum((0, *order))
        turned = order in (((n + 1) ** 2, 1, n + 1), (n + 1, (n + 1) ** 2, 1),
                           (1, n + 1, (n + 1) ** 2))
        cells.append(low[:, None] + (way[[0, 2, 1, 3]] if turned else way))
    return points, np.concatenate(cells)


class LinearHeat(elements.Heat):
    def exact(self, x):
        return (1 + x @ (2, -3, 5))[:, None]

    def gradient(self, x):
        return np.broadcast_to(np.array([2.0, -3, 5]), (len(x), 1, 3))


class LinearElasticity(elements.Elasticity):
    slope = np.array([[0.1, 0.2, -0.3], [0.5, -0.4, 0.1], [0.3, 0.7, 0.2]])

    def exact(self, x):
        return x @ self.slope.T + (1, 2, 3)

    def gradient(self, x):
        return np.broadcast_to(self.slope, (len(x), 3, 3))


def system_of(problem, mesh, which):
    return solver_study.System(problem, mesh, solver_study.fixed_vertices(mesh, which))


def solved(problem, mesh, which):
    system = system_of(problem, mesh, which)
    diagonal = system.matrix.diagonal()
    x, _, _ = iterate.conjugate_gradients(system.matrix, system.right, lambda r: r / diagonal,
                                          1e-13)
    return system.solution(x)


class Elements(unittest.TestCase):
    def test_the_rule_of_integration_is_exact_to_degree_5(self):
        corner = (np.vstack([np.zeros(3), np.eye(3)]), np.array([[0, 1, 2, 3]]))
        factorial = [1, 1, 2, 6, 24, 120, 720, 5040, 40320]
        for i, j, k in itertools.product(range(6), repeat=3):
            if i + j + k <= 5:
                found = sum(w * (p[0, 0]**i * p[0, 1]**j * p[0, 2]**k)
                            for w, p in elements.places(corner, slice(None))) / 6
                exact = factorial[i] * factorial[j] * factorial[k] / factorial[i + j + k + 3]
                self.assertAlmostEqual(found, exact, delta=1e-14)

    def test_gradients_are_those_of_the_solutions(self):
        x, h = np.random.default_rng(3).uniform(-1, 1, (20, 3)), 1e-6
        for problem in (elements.Heat(), elements.Elasticity()):
            for k in range(3):
                step = h * np.eye(3)[k]
                slope = (problem.exact(x + step) - problem.exact(x - step)) / 2 / h
                self.assertLess(abs(slope - problem.gradient(x)[:, :, k]).max(), 1e-8)

    def test_linear_fields_are_exact(self):  # the patch test
        for problem, which in itertools.product((LinearHeat(), LinearElasticity()), ("all", "end")):
            mesh = cube(4, shake=0.2)
            solution = solved(problem, mesh, which)
            self.assertLess(abs(solution - problem.exact(mesh[0]).ravel()).max(), 1e-11)
            self.assertLess(max(elements.errors(problem, mesh, solution)), 1e-11)

    def test_rigid_motions_take_no_energy(self):
        points, cells = cube(3, shake=0.2)
        matrix, _ = elements.assemble(elements.Elasticity(), (points, cells))
        x, y, z = points.T
        turn = np.stack([1 - y, 2 + x, 3 + 0 * z], axis=1).ravel()
        self.assertLess(abs(matrix @ turn).max(), 1e-13)
        self.assertLess(abs(matrix - matrix.T).max(), 1e-14)

    def test_errors_converge_by_order_2_in_l2_and_1_in_energy(self):
        for problem, which in itertools.product((elements.Heat(), elements.Elasticity()),
                                                ("all", "end")):
            coarse, fine = (elements.errors(problem, mesh, solved(problem, mesh, which))
                            for mesh in (cube(6), cube(12)))
            orders = np.log2(np.array(coarse) / fine)
            self.assertTrue(1.8 < orders[0] < 2.2 and 0.9 < orders[1] < 1.1, orders)

    def test_dihedral_angles_of_a_corner_and_of_a_flat_tetrahedron(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0], [1, 1, 1e-9]])
        angles = elements.least_dihedral_angles((points, np.array([[0, 1, 2, 3], [0, 1, 2, 4]])))
        self.assertAlmostEqual(angles[0], np.degrees(np.arctan(2**0.5)), delta=1e-12)
        self.assertAlmostEqual(angles[1] / np.degrees(1e-9), 1, delta=1e-6)


class Iterations(unittest.TestCase):
    def test_conjugate_gradients_end_after_as_many_steps_as_there_are_eigenvalues(self):
        values = np.repeat([1.0, 7.0, 50.0], 9)
        q, _ = np.linalg.qr(np.random.default_rng(2).standard_normal((27, 27)))
        x, count, ritz = iterate.conjugate_gradients((q * values) @ q.T, np.ones(27), lambda r: r)
        self.assertEqual(count, 3)
        self.assertLess(abs((q * values) @ (q.T @ x) - 1).max(), 1e-7)
        np.testing.assert_allclose(ritz, (1, 50), rtol=1e-6)

    def test_eigenvalues_are_those_of_the_dense_matrix(self):
        mesh = cube(5, shake=0.2)
        system = system_of(elements.Heat(), mesh, "end")
        a = iterate.scaled(system.matrix)
        values = np.linalg.eigvalsh(a.toarray())
        self.assertAlmostEqual(iterate.largest_eigenvalue(a) / values[-1], 1, delta=1e-3)
        self.assertLess(values[-1], 4)  # so of the element's, whose trace is 4
        _, _, ritz = iterate.conjugate_gradients(a, np.ones(a.shape[0]), lambda r: r)
        np.testing.assert_allclose(ritz, values[[0, -1]], rtol=1e-2)

    def test_incomplete_cholesky_is_complete_where_nothing_fills(self):
        random = np.random.default_rng(4).standard_normal((30, 30))
        a = scipy.sparse.csr_matrix(random @ random.T + np.eye(30))
        precondition, shift = iterate.incomplete_cholesky(a)
        self.assertEqual(shift, 0)
        self.assertLess(abs(a @ precondition(np.ones(30)) - 1).max(), 1e-9)

    def test_incomplete_cholesky_agrees_with_the_matrix_on_its_pattern(self):
        mesh = cube(4, shake=0.2)
        system = system_of(elements.Heat(), mesh, "all")
        a = iterate.scaled(system.matrix)
        lower = iterate._without_fill(a, 0.0)  # pylint: disable=protected-access
        pattern = a.toarray() != 0
        self.assertLess(abs((lower @ lower.T - a).toarray()[pattern]).max(), 1e-14)


class Programs(unittest.TestCase):
    def setUp(self):
        self.home, self.folder = os.getcwd(), tempfile.TemporaryDirectory()
        os.chdir(self.folder.name)

    def tearDown(self):
        os.chdir(self.home)
        self.folder.cleanup()

    @unittest.skipUnless(MESHER, "no tool")
    def test_linear_fields_are_exact_on_meshes_of_the_tool(self):
        self.write_box()
        for algorithm, bound in itertools.product(("svr", "refine"), (0, 10)):
            mesh = solver_study.mesh_by_mesher(MESHER, "box.obj", algorithm, bound, 0.3)
            for problem in (LinearHeat(), LinearElasticity()):
                solution = solved(problem, mesh, "end")
                self.assertLess(abs(solution - problem.exact(mesh[0]).ravel()).max(), 1e-9)

    @unittest.skipUnless(shutil.which("tetgen"), "no TetGen")
    def test_a_mesh_of_tetgen_fills_the_box(self):
        self.write_box()
        mesh = solver_study.mesh_by_tetgen("box.obj", 10)
        self.assertAlmostEqual(elements.shapes(mesh)[0].sum(), 1, delta=1e-12)

    @unittest.skipUnless(shutil.which("getdp"), "no GetDP")
    def test_getdp_finds_the_same_errors(self):
        mesh = cube(5, shake=0.2)
        ours = elements.errors(elements.Heat(), mesh, solved(elements.Heat(), mesh, "all"))
        told = debian_solvers.getdp(mesh, "jacobi")
        np.testing.assert_allclose((told["l2_error"], told["energy_error"]), ours, rtol=1e-3)

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_calculix_finds_the_same_displacements(self):
        mesh, problem = cube(4, shake=0.2), elements.Elasticity()
        fixed = solver_study.fixed_vertices(mesh, "end")
        found, told = debian_solvers.calculix(
            mesh, problem, fixed, problem.exact(mesh[0][fixed]),
            elements.assemble(problem, mesh)[1], "ITERATIVE CHOLESKY")
        self.assertGreater(told["iterations"], 0)
        self.assertLess(abs(found - solved(problem, mesh, "end")).max(), 0.01)

    def write_box(self):
        with open("box.obj", "w", encoding="ascii") as file:
            file.writelines(f"v {x} {y} {z}\n" for x, y, z in CORNERS)
            file.writelines(f"f {a} {b} {c} {d}\n" for a, b, c, d in FACES)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
