// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/linalg/row_product.hpp"

namespace perimode {

/// linear: f = k_b n (n . eta). large_rotation: the bond's own direction and stretch at every instant,
///   f = c beta V_i V_j s y/|y|,  y = xi + eta,  s = (|y| - |xi|)/|xi|,
/// evaluated without cancellation as s = eta . (xi + y) / (|xi| (|y| + |xi|)).
enum class Kinematics { linear, large_rotation };

/// Forces of a body whose bonds may turn and break: the internal force on the free dofs, piece by piece.
/// A bond whose stretch exceeds its critical stretch carries no force from that evaluation on, is cleared in
/// the body at both ends when the evaluation ends, and never heals. Both ends see the same stretch to the
/// last bit, so the forces of a bond stay opposite. Grids: rows of cells in SIMD on the alive bits; clouds:
/// their list. The same bits for any number of threads, and on any processor. Bonds to ghosts break at their
/// particle's end, and hold half the energy of a bond (all of it where the ghost stands still): the other
/// half belongs to the image.
template <int Dim>
class BondForces {
 public:
  /// `body` has to outlive the object, which breaks bonds in it. `critical_stretch` per block (bonds between
  /// blocks take the smaller one); empty or infinite: unbreakable. `no_fail`: particles none of whose bonds
  /// break. Throws invalid_input: a number of critical stretches that is not that of the blocks, one that is
  /// not > 0.
  BondForces(Body<Dim>& body, Kinematics kinematics, std::vector<double> critical_stretch,
             const std::vector<Index>& no_fail = {});
  ~BondForces();
  BondForces(BondForces&&) noexcept;
  BondForces& operator=(BondForces&&) noexcept;
  BondForces(const BondForces&) = delete;
  BondForces& operator=(const BondForces&) = delete;

  /// The internal force as a (nonlinear) row product of the free displacements q, with given displacements at
  /// their values at time `t` (set_time).
  [[nodiscard]] const RowProduct& product() const;
  /// The instant of the next evaluations; 0 at first. Cost O(given dofs and ghosts that move).
  void set_time(double t);

  /// The given dofs that vary in time, by number: their displacement now (m) and the internal force on them
  /// at the last evaluation (N), of which the work of given motion is made.
  [[nodiscard]] const std::vector<double>& moving_displacement() const;
  [[nodiscard]] const std::vector<double>& moving_force() const;

  /// Bonds broken so far (each once) and the energy they held when they broke, J.
  [[nodiscard]] Offset broken() const;
  [[nodiscard]] double broken_energy() const;
  /// Energy that the bonds broken in the last evaluation held at other displacements q (set_time), J.
  [[nodiscard]] double last_broken_energy(const double* q) const;
  /// Whether evaluations of the product sum the strain energy of the bonds they leave alive on their way, for
  /// a few per cent of their cost; and that of the last one, J.
  void follow_energy(bool wanted);
  [[nodiscard]] double last_strain_energy() const;

  /// For a checkpoint: alive bits of the body, and the two counts above.
  struct State {
    std::vector<std::uint64_t> alive;
    Offset broken = 0;
    double energy = 0.0;
  };
  [[nodiscard]] State save() const;
  void restore(const State& state);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace perimode
