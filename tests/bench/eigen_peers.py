#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""eigen_peers.py FOLDER [COUNT]: the peers of `perimode modal --matrices`. Lowest COUNT (20) modes of the K.mtx and
M.mtx in FOLDER by slepc4py's Krylov-Schur on a MUMPS Cholesky factor (tolerance 1e-12), where it is installed, and by
SciPy's eigsh without a factor (ARPACK, which='SA'): CPU seconds beside those in the folder's summary.json (rigid
modes, solver and certificate; without reading and assembly), and the largest difference of the frequencies.
Debian: python3-slepc4py. Run both with OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1, alternating."""
import glob
import json
import sys
import time

import numpy as np
import scipy.io
import scipy.sparse
import scipy.sparse.linalg


def by_slepc(a, count):
    sys.path += glob.glob("/usr/lib/petscdir/petsc*/*-real/lib/python3/dist-packages")
    sys.path += glob.glob("/usr/lib/slepcdir/slepc*/*-real/lib/python3/dist-packages")
    from petsc4py import PETSc
    from slepc4py import SLEPc
    matrix = PETSc.Mat().createAIJ(a.shape, csr=(a.indptr.astype(np.int32), a.indices.astype(np.int32), a.data))
    matrix.setOption(PETSc.Mat.Option.SYMMETRIC, True)
    matrix.setOption(PETSc.Mat.Option.SPD, True)
    solver = SLEPc.EPS().create()
    solver.setOperators(matrix)
    solver.setProblemType(SLEPc.EPS.ProblemType.HEP)
    solver.setDimensions(count)
    solver.setTolerances(1e-12, 1000)
    solver.setTarget(0.0)
    solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
    transform = solver.getST()
    transform.setType("sinvert")
    transform.getKSP().setType("preonly")
    transform.getKSP().getPC().setType("cholesky")
    transform.getKSP().getPC().setFactorSolverType("mumps")
    solver.solve()
    return [solver.getEigenvalue(i).real for i in range(count)]


def by_scipy(a, count):
    return scipy.sparse.linalg.eigsh(a, count, which="SA", return_eigenvectors=True)[0]


folder, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 20
k = scipy.io.mmread(f"{folder}/K.mtx").tocsr()
root = np.sqrt(scipy.io.mmread(f"{folder}/M.mtx").diagonal())
a = (scipy.sparse.diags(1 / root) @ k @ scipy.sparse.diags(1 / root)).tocsr()
summary = json.load(open(f"{folder}/summary.json", encoding="utf-8"))
ours = np.array([mode["frequency_hz"] for mode in summary["modes"]])[:count]
t = summary["timings_s"]
took = t["analyse"] + t["factor"] + t["iterate"] + t["certificate"]
print(f"perimode ({summary['solver']}): {took:.2f} s (one thread: wall), certificate included")

for name, solve in (("slepc4py + MUMPS", by_slepc), ("SciPy eigsh 'SA', no factor", by_scipy)):
    start = time.process_time()
    try:
        values = np.sort(solve(a, count))
    except ImportError:
        print(f"{name}: not installed")
        continue
    seconds = time.process_time() - start
    difference = np.max(np.abs(ours / (np.sqrt(values) / (2 * np.pi)) - 1))
    print(f"{name}: {seconds:.2f} s CPU, ratio {took / seconds:.3f}; frequencies differ by {difference:.1e}")
