"""Linear finite elements on tetrahedra, for heat and for elasticity, with known solutions.

A mesh is (points, cells): n x 3 doubles, and m x 4 indices, of positive volume. A problem has an
exact solution u of 1 or 3 components, and the stress of a gradient: the gradient itself for heat,
Hooke's law for elasticity. The load of the basis function v is a(u, v), by a rule of degree 5,
which is the sum of the body force and of the traction on the part of the boundary that is free; so
the discrete solution is the one nearest to u in energy among those with u's values at the fixed
vertices.
"""
import numpy as np
from scipy import sparse

# Weights, and barycentric coordinates: 14 points, exact for degree 5 (Walkington).
_A, _B, _C = 0.31088591926330060980, 0.092735250310891226402, 0.045503704125649649492
RULE = [(w, np.roll([1 - 3 * a, a, a, a], k))
        for w, a in ((0.11268792571801585080, _A), (0.073493043116361949544, _B))
        for k in range(4)]
RULE += [(0.042546020777081466438, np.where(np.isin(range(4), (i, j)), _C, 0.5 - _C))
         for i in range(4) for j in range(i + 1, 4)]

CHUNK = 20000  # elements whose matrices are in memory at a time: 12 x 12 doubles each, 23 MB


class Heat:
    """u = sin x cos y exp z; -laplace u = u."""

    name, components = "heat", 1

    def exact(self, x):
        return (np.sin(x[:, 0]) * np.cos(x[:, 1]) * np.exp(x[:, 2]))[:, None]

    def gradient(self, x):
        s, c = np.sin(x), np.cos(x)
        e = np.exp(x[:, 2])
        return np.stack([c[:, 0] * c[:, 1] * e, -s[:, 0] * s[:, 1] * e, s[:, 0] * c[:, 1] * e],
                        axis=1)[:, None, :]

    def stress(self, gradient):
        return gradient


class Elasticity:
    """u = (sin x cos y exp z, cos x sin z, sin y cos z), Young's modulus 1, Poisson's ratio 0.3."""

    name, components, young, poisson = "elasticity", 3, 1.0, 0.3

    def exact(self, x):
        s, c = np.sin(x), np.cos(x)
        return np.stack([s[:, 0] * c[:, 1] * np.exp(x[:, 2]), c[:, 0] * s[:, 2], s[:, 1] * c[:, 2]],
                        axis=1)

    def gradient(self, x):
        s, c = np.sin(x), np.cos(x)
        found = np.zeros((len(x), 3, 3))
        found[:, :1] = Heat().gradient(x)
        found[:, 1, 0], found[:, 1, 2] = -s[:, 0] * s[:, 2], c[:, 0] * c[:, 2]
        found[:, 2, 1], found[:, 2, 2] = c[:, 1] * c[:, 2], -s[:, 1] * s[:, 2]
        return found

    def stress(self, gradient):
        shear = self.young / 2 / (1 + self.poisson)
        first = 2 * shear * self.poisson / (1 - 2 * self.poisson)
        trace = np.trace(gradient, axis1=-2, axis2=-1)[..., None, None]
        return first * trace * np.eye(3) + shear * (gradient + np.swapaxes(gradient, -1, -2))


def shapes(mesh):
    """Volumes, m, and gradients of the four basis functions, m x 4 x 3."""
    points, cells = mesh
    p = points[cells]
    edges = p[:, 1:] - p[:, :1]
    volumes = np.linalg.det(edges) / 6
    if not (volumes > 0).all():
        raise ValueError(f"{(volumes <= 0).sum()} tetrahedra without volume")
    gradients = np.empty((len(cells), 4, 3))
    gradients[:, 1:] = np.swapaxes(np.linalg.inv(edges), 1, 2)
    gradients[:, 0] = -gradients[:, 1:].sum(axis=1)
    return volumes, gradients


def least_dihedral_angles(mesh):
    """Of each tetrahedron, in degrees."""
    gradients = shapes(mesh)[1]
    normals = gradients / np.linalg.norm(gradients, axis=2)[:, :, None]
    i, j = np.triu_indices(4, 1)
    cosines = -np.einsum("mek,mek->me", normals[:, i], normals[:, j])
    sines = np.linalg.norm(np.cross(normals[:, i], normals[:, j]), axis=2)  # exact at small angles
    return np.degrees(np.arctan2(sines, cosines)).min(axis=1)


def boundary_faces(cells):
    """The faces of one tetrahedron alone, k x 3."""
    faces = np.concatenate([cells[:, [1, 3, 2]], cells[:, [0, 2, 3]], cells[:, [0, 3, 1]],
                            cells[:, [0, 1, 2]]])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True,
                                return_counts=True)
    return faces[first[count == 1]]


def freedoms(vertices, components):
    """The indices in the system of all components at vertices."""
    return (np.asarray(vertices)[..., None] * components + np.arange(components)).reshape(
        *np.shape(vertices)[:-1], -1)


def assemble(problem, mesh):
    """The matrix of all vertices, fixed ones too, and the load."""
    points, cells = mesh
    volumes, gradients = shapes(mesh)
    c = problem.components
    size = c * len(points)
    matrix, load = sparse.csr_matrix((size, size)), np.zeros(size)
    for begin in range(0, len(cells), CHUNK):
        part = slice(begin, begin + CHUNK)
        v, g, at = volumes[part], gradients[part], freedoms(cells[part], c)
        basis = np.einsum("ab,mjk->mjbak", np.eye(c), g)  # of (j, b): its gradient
        local = np.einsum("m,mjbak,mik->miajb", v, problem.stress(basis), g)
        rows = np.repeat(at, 4 * c, axis=1).ravel()
        columns = np.tile(at, (1, 4 * c)).ravel()
        matrix += sparse.csr_matrix((local.ravel(), (rows, columns)), (size, size))
        mean = sum(w * problem.stress(problem.gradient(place)) for w, place in places(mesh, part))
        forces = np.einsum("m,mak,mik->mia", v, mean, g)
        load += np.bincount(at.ravel(), forces.ravel(), size)
    return matrix, load


def places(mesh, part):
    """The weight and the positions of each point of the rule in the tetrahedra of a slice."""
    points, cells = mesh
    p = points[cells[part]]
    for weight, coordinates in RULE:
        yield weight, np.einsum("i,mik->mk", coordinates, p)


def errors(problem, mesh, solution):
    """In L2 and in energy, relative to the norms of the exact solution."""
    volumes, gradients = shapes(mesh)
    nodal = solution.reshape(-1, problem.components)[mesh[1]]
    slope = np.einsum("mia,mik->mak", nodal, gradients)
    sums = np.zeros(4)
    for (weight, place), (_, coordinates) in zip(places(mesh, slice(None)), RULE):
        u, s = problem.exact(place), problem.gradient(place)
        wrong, off = np.einsum("i,mia->ma", coordinates, nodal) - u, slope - s
        for k, density in enumerate(((wrong**2).sum(1), (u**2).sum(1), _energy(problem, off),
                                     _energy(problem, s))):
            sums[k] += weight * volumes @ density
    return float(np.sqrt(sums[0] / sums[1])), float(np.sqrt(sums[2] / sums[3]))


def _energy(problem, gradient):
    return np.einsum("mak,mak->m", problem.stress(gradient), gradient)
