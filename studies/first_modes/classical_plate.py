#!/usr/bin/env python3
"""Classical frequencies of the clamped plate without crack: plane stress, Poisson's ratio 1/3, biquadratic
finite elements with consistent mass. Prints the first six for three meshes; main.cpp holds the finest."""
import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import eigsh

LENGTH, HEIGHT, E, NU, RHO = 1.0, 0.5, 210e9, 1 / 3, 7850.0


def element(hx, hy):
    """Stiffness and mass of a nine-node rectangle, 3 x 3 nodes in the order of np.outer(x, y)."""
    elastic = E / (1 - NU**2) * np.array([[1, NU, 0], [NU, 1, 0], [0, 0, (1 - NU) / 2]])
    stiffness, mass = np.zeros((18, 18)), np.zeros((18, 18))
    points, weights = np.polynomial.legendre.leggauss(3)
    shape = [np.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2]) for x in points]
    slope = [np.array([x - 0.5, -2 * x, x + 0.5]) for x in points]
    for i, wx in enumerate(weights):
        for j, wy in enumerate(weights):
            area = hx * hy / 4 * wx * wy
            dx = np.outer(slope[i], shape[j]).ravel() * 2 / hx
            dy = np.outer(shape[i], slope[j]).ravel() * 2 / hy
            strain = np.zeros((3, 18))
            strain[0, ::2], strain[1, 1::2], strain[2, ::2], strain[2, 1::2] = dx, dy, dy, dx
            value = np.zeros((2, 18))
            value[0, ::2] = value[1, 1::2] = np.outer(shape[i], shape[j]).ravel()
            stiffness += area * strain.T @ elastic @ strain
            mass += area * RHO * value.T @ value
    return stiffness, mass


def frequencies(nx, ny, count=6):
    rows = 2 * ny + 1
    corner = (2 * np.arange(nx)[:, None] * rows + 2 * np.arange(ny)).ravel()
    nodes = corner[:, None] + (np.arange(3)[:, None] * rows + np.arange(3)).ravel()
    dofs = (2 * nodes[:, :, None] + np.arange(2)).reshape(len(nodes), 18)
    i, j = np.repeat(dofs, 18, axis=1).ravel(), np.tile(dofs, 18).ravel()
    free = slice(2 * rows, None)  # the first column of nodes is clamped
    k, m = (sparse.csc_matrix((np.tile(a.ravel(), len(nodes)), (i, j)))[free, free]
            for a in element(LENGTH / nx, HEIGHT / ny))
    return np.sqrt(np.sort(eigsh(k, count, m, sigma=0.0, return_eigenvectors=False))) / (2 * np.pi)


for ny in (20, 40, 60):
    print(f"{2 * ny:4} x {ny:3}  " + "".join(f"{f:12.3f}" for f in frequencies(2 * ny, ny)))
