// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>

#include "perimode/linalg/eigen.hpp"

namespace perimode {

/// lanczos: block Lanczos with full reorthogonalisation on CHOLMOD's factor. arpack: ARPACK on
/// the same factor. dense: LAPACK, all modes. chebyshev: block Lanczos on a Chebyshev polynomial of K,
/// nothing assembled or factored. inverse: block Lanczos on the inverse by conjugate gradients with multigrid
/// (grids). slepc: Krylov-Schur on a factor of MUMPS, where built in.
using ModalSolver = EigenEngine;

/// How the set of modes is shown to be complete. inertia: the count of negative pivots of
/// K - sigma M. restart: a deflated random block finds nothing new below the last mode.
using CertificateMethod = CompletenessCheck;

enum class ReferenceKind { none, closed_form };

/// The case file's `analysis.modal`. At most one of modes, range, shift is given.
struct ModalOptions {
  std::optional<int> modes = {};                        ///< lowest, rigid ones counted
  std::optional<std::pair<double, double>> range = {};  ///< all in [f1, f2], Hz
  std::optional<double> shift = {};                     ///< the `modes` nearest to f, Hz
  ModalSolver solver = ModalSolver::automatic;
  CertificateMethod certificate = CertificateMethod::automatic;
  ReferenceKind reference = ReferenceKind::none;
  int block_size = 0;       ///< of block Lanczos; 0: 4, and 8 from 20,000 dofs on with a factor
  double memory_limit = 0;  ///< bytes a solver chosen automatically may take; 0: any
};

}  // namespace perimode
