// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/linalg/eigen.hpp"

namespace perimode {

/// The modes by SLEPc: Krylov-Schur on MUMPS's LDL^T, counted by inertia. Throws Error(environment) where the
/// library was built without SLEPc (PERIMODE_WITH_SLEPC) or its module cannot be loaded.
/// docs/adr/0010-slepc.md.
[[nodiscard]] EigenResult solve_slepc(const EigenProblem& problem, const EigenOptions& options,
                                      const Sink& sink);

}  // namespace perimode
