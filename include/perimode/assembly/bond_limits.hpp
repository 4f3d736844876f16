// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/assembly/breakable_stiffness.hpp"

namespace perimode {

/// When bonds break: the critical stretch of every block (bonds between blocks take the smaller one;
/// infinity: unbreakable) and the particles none of whose bonds break.
struct BondLimits {
  std::vector<double> critical_stretch;
  std::vector<std::uint8_t> no_fail = {};  ///< per particle; empty: none
};

/// The first break along u(lambda) = u_0 + lambda u_1, linear kinematics: s_b = n . (u_j - u_i) / |xi|.
struct FirstBreak {
  /// The smallest lambda at which a bond with s_1 > 0 reaches its critical stretch, (s_c - s_0)/s_1;
  /// infinity: none ever does. Negative where one is beyond it at lambda = 0 already.
  double factor = 0.0;
  /// The bond of the smallest factor and all that are within `tie` of their critical stretch there,
  /// s >= s_c (1 - tie), images included (with_images).
  std::vector<BondRef> bonds;
  /// Largest s/s_c at `factor` (infinity: at lambda = 0; 0: nothing is stretched): above 1 + tie, bonds with
  /// s_1 <= 0 are beyond theirs.
  double worst = 0.0;
  /// Strain energies of all alive bonds, J: those of u_0, of both ((1/2) sum_b k l^2 s_0 s_1), of u_1.
  /// U(lambda) = energy[0] + 2 lambda energy[1] + lambda^2 energy[2].
  std::array<double, 3> energy = {};
};

/// Displacements of all particle dofs (m); `u_0` may be empty (zero). Ghosts follow by the linear part of the
/// boundary's map: walls of symmetric boundaries give no values. The same for any number of threads; a tie
/// below 1e-12 counts as 1e-12. Cost O(bonds): one pass, with u_0 a second one at `factor`, and one by one
/// the bonds of the particles near the ties.
template <int Dim>
[[nodiscard]] FirstBreak first_break(const Body<Dim>& body, const BondLimits& limits,
                                     const Eigen::VectorXd& u_0, const Eigen::VectorXd& u_1, double tie);

/// Bonds beyond their critical stretch, s > s_c (1 + 1e-12), with s/s_c; images included, equal ones next to
/// each other. The worst `most` (0: all) by s/s_c, a bond and its image counted once, those within `tie` of
/// the last one included.
struct OverstretchedBonds {
  std::vector<BondRef> bonds;
  double worst = 0.0;   ///< largest s/s_c of all alive breakable bonds; 0: none is stretched
  double energy = 0.0;  ///< strain energy of all alive bonds, J
};
template <int Dim>
[[nodiscard]] OverstretchedBonds overstretched(const Body<Dim>& body, const BondLimits& limits,
                                               const Eigen::VectorXd& displacement, Index most, double tie);

/// Force along and elongation of a bond, l s = n . (u_j - u_i): k l s (N) and l s (m), for each of `bonds`.
struct BondState {
  double stiffness = 0.0;   ///< k_b, N/m
  double elongation = 0.0;  ///< m
  double share = 1.0;  ///< of the bond's energy that is the body's: 1/2 for a bond to a ghost that follows
};
template <int Dim>
[[nodiscard]] std::vector<BondState> bond_states(const Body<Dim>& body, std::span<const BondRef> bonds,
                                                 const Eigen::VectorXd& displacement);

}  // namespace perimode
