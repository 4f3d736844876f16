#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""slepc_peer.py FOLDER [COUNT]: the peer of `perimode modal --matrices`. Lowest COUNT (20) modes of the K.mtx and
M.mtx in FOLDER by slepc4py's Krylov-Schur on a MUMPS Cholesky factor (tolerance 1e-12), CPU seconds of factorisation
and iteration beside those in the folder's summary.json, and the largest difference of the frequencies.
Debian: python3-slepc4py. Run both with OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1, alternating."""
import glob
import json
import sys
import time

import numpy as np
import scipy.io
import scipy.sparse

sys.path += glob.glob("/usr/lib/petscdir/petsc*/*-real/lib/python3/dist-packages")
sys.path += glob.glob("/usr/lib/slepcdir/slepc*/*-real/lib/python3/dist-packages")
from petsc4py import PETSc  # noqa: E402
from slepc4py import SLEPc  # noqa: E402

folder, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 20
k = scipy.io.mmread(f"{folder}/K.mtx").tocsr()
root = np.sqrt(scipy.io.mmread(f"{folder}/M.mtx").diagonal())
a = scipy.sparse.diags(1 / root) @ k @ scipy.sparse.diags(1 / root)
a = a.tocsr()
start = time.process_time()
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
seconds = time.process_time() - start
hertz = np.sort([np.sqrt(solver.getEigenvalue(i).real) for i in range(count)]) / (2 * np.pi)

summary = json.load(open(f"{folder}/summary.json", encoding="utf-8"))
ours = np.array([mode["frequency_hz"] for mode in summary["modes"]])[:count]
t = summary["timings_s"]
took = t["analyse"] + t["factor"] + t["iterate"] + t["certificate"]
print(f"slepc4py + MUMPS {seconds:.2f} s CPU; perimode {took:.2f} s (one thread: wall), certificate included; "
      f"ratio {took / seconds:.2f}; frequencies differ by {np.max(np.abs(ours / hertz - 1)):.1e}")
