// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/assembly/model.hpp"
#include "perimode/core/sink.hpp"
#include "perimode/geometry/crack.hpp"
#include "perimode/modal/modes.hpp"

namespace perimode {

/// Whether the factor of a longer crack is that of the shorter one updated, or made afresh.
enum class GrowthFactor { automatic, updated, fresh };

/// Modes at one length of the cracks.
struct CrackGrowthStep {
  double fraction = 0.0;                      ///< of the case's pre-cracks, 0: intact
  double crack_length = 0.0;                  ///< m (3D: area, m2)
  Offset cut = 0;                             ///< bonds cut in all
  GrowthFactor factor = GrowthFactor::fresh;  ///< updated or fresh
  std::vector<double> frequency;              ///< Hz, ascending, rigid ones 0
  double residual = 0.0;                      ///< the largest
  double seconds_factor = 0.0;                ///< making or updating the factor
  double seconds_modes = 0.0;
};

struct CrackGrowthResult {
  bool converged = false;  ///< every step
  std::string message;     ///< why not
  Index dofs = 0;
  Offset factor_nonzeros = 0;
  std::vector<CrackGrowthStep> steps;  ///< n + 1, from the intact body to the whole pre-cracks
};

/// The pre-cracks of a model grown to a fraction of what they are, 0 < fraction <= 1: the `to` end of a
/// segment is drawn to its `from` end, every corner of a polygon to the line of its first edge.
template <int Dim>
[[nodiscard]] std::vector<Crack<Dim>> grown_precracks(const Model& model, double fraction);

/// The lowest frequencies of a body while its pre-cracks grow in n equal steps from nothing to what the model
/// says (grown_precracks): a factor of the intact body's K - sigma M, sigma < 0, is updated by the bonds that
/// each step cuts, or made afresh, whichever a cost model of measured times finds cheaper; both give the same
/// modes. Bonds once cut stay cut. docs/theory/14_quasistatic.md. A certificate `automatic` is by restart.
/// Throws invalid_input: no pre-crack or one in 1D, one that cuts nothing, n < 1, an unsymmetric boundary, a
/// range, a shift, a solver other than automatic and lanczos, more modes than dofs. A calibration after
/// pre-cracks (discrete_cut) changes all bonds near them, so its factors are fresh.
template <int Dim>
[[nodiscard]] CrackGrowthResult crack_growth_modes(const Model& model, const ModalOptions& options, int n,
                                                   GrowthFactor factor = GrowthFactor::automatic,
                                                   const Sink& sink = {});

}  // namespace perimode
