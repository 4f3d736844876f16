// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/assembly/model.hpp"
#include "perimode/core/sink.hpp"
#include "perimode/modal/modes.hpp"

namespace perimode {

/// Whether the factor of a longer crack is that of the shorter one updated, or made afresh.
enum class GrowthFactor { automatic, updated, fresh };

/// Modes at one length of the cracks.
struct CrackGrowthStep {
  double fraction = 0.0;      ///< of the case's pre-cracks, 0: intact
  double crack_length = 0.0;  ///< m (3D: area, m2)
  Offset cut = 0;             ///< bonds cut in all
  GrowthFactor factor = GrowthFactor::fresh;
  std::vector<double> frequency;  ///< Hz, ascending, rigid ones 0
  double residual = 0.0;          ///< the largest
  double seconds_factor = 0.0, seconds_modes = 0.0;
};

struct CrackGrowthResult {
  bool converged = false;
  std::string message;
  std::vector<CrackGrowthStep> steps;  ///< n + 1, from the intact body to the whole pre-cracks
};

/// Frequencies of a body while its pre-cracks grow in n equal steps from nothing to what the model says, each
/// straight from its `from` end (3D: from its first edge): the factor of the intact body is updated by the
/// bonds that each step cuts, or made afresh, whichever a cost model finds cheaper; both give the same modes.
/// docs/theory/14_quasistatic.md. Throws invalid_input: no pre-crack, one that cuts nothing, n < 1, an
/// unsymmetric boundary. A calibration after pre-cracks (discrete_cut) changes all bonds near them, so its
/// factors are fresh.
template <int Dim>
[[nodiscard]] CrackGrowthResult crack_growth_modes(const Model& model, const ModalOptions& options, int n,
                                                   GrowthFactor factor = GrowthFactor::automatic,
                                                   const Sink& sink = {});

}  // namespace perimode
