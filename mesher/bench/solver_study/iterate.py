"""Conjugate gradients, what they cost with three preconditioners, and extreme eigenvalues.

`conjugate_gradients` also gives the least and largest Ritz values of the preconditioned matrix,
from its own coefficients (Golub, Van Loan, section 10.2): their ratio is the condition that it met,
a lower bound of the condition number.
"""
import numpy as np
from scipy import sparse
from scipy.linalg import eigvalsh_tridiagonal
from scipy.sparse import linalg

LIMIT = 20000  # iterations


def conjugate_gradients(matrix, right, precondition, tolerance=1e-8):
    """Until the residual is below the tolerance times that of 0: the solution, the number of
    iterations, and the Ritz values' extremes."""
    x, r = np.zeros_like(right), right.copy()
    z = precondition(r)
    p, energy, target = z.copy(), r @ z, tolerance * np.linalg.norm(right)
    alphas, betas = [], []
    while np.linalg.norm(r) > target and len(alphas) < LIMIT:
        q = matrix @ p
        alphas.append(energy / (p @ q))
        x += alphas[-1] * p
        r -= alphas[-1] * q
        z = precondition(r)
        energy, old = r @ z, energy
        betas.append(energy / old)
        p = z + betas[-1] * p
    return x, len(alphas), _ritz(np.array(alphas), np.array(betas))


def _ritz(alphas, betas):
    if len(alphas) == 0:
        return 1.0, 1.0
    diagonal = 1 / alphas
    diagonal[1:] += betas[:-1] / alphas[:-1]
    values = eigvalsh_tridiagonal(diagonal, np.sqrt(betas[:-1]) / alphas[:-1])
    return float(values[0]), float(values[-1])


def largest_eigenvalue(matrix):
    """By Lanczos, to a part in 10^4."""
    start = np.random.default_rng(1).standard_normal(matrix.shape[0])
    return float(linalg.eigsh(matrix, k=1, which="LA", tol=1e-4, v0=start,
                              return_eigenvectors=False)[0])


def scaled(matrix):
    """D^-1/2 A D^-1/2, D the diagonal."""
    d = sparse.diags(1 / np.sqrt(matrix.diagonal()))
    return (d @ matrix @ d).tocsr()


def incomplete_cholesky(matrix):
    """The preconditioner without fill, and the part by which the diagonal was raised for it: 0, or,
    if a pivot was not positive, the first of 0.001, 0.002, 0.004, ... with which all are
    (Manteuffel)."""
    root = np.sqrt(matrix.diagonal())
    shift = 0.0
    while (factor := _without_fill(scaled(matrix), shift)) is None:
        shift = 2 * shift or 0.001
    # A triangle has a factorization without fill: itself, and SuperLU solves with it fast.
    solver = linalg.splu(factor, permc_spec="NATURAL", diag_pivot_thresh=0.0)
    return (lambda r: solver.solve(solver.solve(r / root), "T") / root), shift


def _without_fill(matrix, shift):
    """L, with L L^T = A + shift I on the pattern of A; None if a pivot is not positive. Columns of
    one level do not depend on each other, and are eliminated together."""
    lower = sparse.tril(matrix, format="csc")
    lower.sort_indices()
    n, begins, rows, values = lower.shape[0], lower.indptr, lower.indices, lower.data
    values[begins[:-1]] += shift  # a column begins with its diagonal
    keys = np.repeat(np.arange(n, dtype=np.int64), np.diff(begins)) * n + rows
    for columns in _levels(lower):
        pivots = values[begins[columns]]
        if not (pivots > 0).all():
            return None
        entries, of = _entries(begins, columns)
        values[entries] /= np.sqrt(pivots)[of]
        below, of = _entries(begins + 1, columns, begins[1:])
        # Pairs of entries (j, k), (i, k) with i >= j of a column k update the entry (i, j).
        counts = (begins[columns + 1])[of] - below
        j = np.repeat(below, counts)
        i = j + np.arange(len(j)) - np.repeat(np.cumsum(counts) - counts, counts)
        wanted = rows[j].astype(np.int64) * n + rows[i]
        found = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
        there = keys[found] == wanted
        np.subtract.at(values, found[there], values[i[there]] * values[j[there]])
    return lower


def _entries(begins, columns, ends=None):
    """The positions of the entries of columns, and which of the columns each belongs to."""
    ends = begins[1:] if ends is None else ends
    counts = ends[columns] - begins[columns]
    of = np.repeat(np.arange(len(columns)), counts)
    return begins[columns][of] + np.arange(len(of)) - (np.cumsum(counts) - counts)[of], of


def _levels(lower):
    """The columns, in groups; one that updates another is in an earlier group."""
    n, begins, rows = lower.shape[0], lower.indptr.tolist(), lower.indices.tolist()
    level = [0] * n
    for k in range(n):
        above = level[k] + 1
        for e in range(begins[k] + 1, begins[k + 1]):
            if level[rows[e]] < above:
                level[rows[e]] = above
    level = np.array(level)
    order = np.argsort(level, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(level[order])) + 1)
