// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "perimode/boundary/time_function.hpp"
#include "perimode/core/types.hpp"
#include "perimode/linalg/operator.hpp"
#include "perimode/linalg/row_product.hpp"

namespace perimode {

/// A force on the free dofs that varies as one function of time, p h(t); p is kept where it is not zero.
struct ForceTerm {
  TimeFunction time;
  std::vector<Index> dof;     ///< ascending
  std::vector<double> value;  ///< N
  /// p = -R K g of given displacements g h(t), not a load: it works through the reaction.
  bool motion = false;
};

/// The equations of motion of the free dofs, docs/theory/11_transient.md:
///   M q'' + C q' + K q = sum_k h_k(t) p_k,   C = diag(damping_rate m) + stiffness_damping K.
struct Motion {
  Eigen::VectorXd mass;          ///< kg, > 0
  RowProduct stiffness;          ///< R K T, N/m
  bool symmetric = true;         ///< of R K T
  Eigen::VectorXd damping_rate;  ///< 1/s per free dof (Rayleigh alpha, nodal, sponges added); empty: none
  double stiffness_damping = 0;  ///< Rayleigh beta, s
  std::vector<ForceTerm> force;
  /// g_k^T K g_l over the terms that are motions (in their order among `force`), J: the strain energy of
  /// given displacements alone. Symmetric.
  Eigen::MatrixXd motion_stiffness;
};

/// Energies at a step, J, as the scheme itself conserves them (docs/theory/11 to 13 say how each scheme
/// defines them). balance = kinetic + strain + broken + damping - external_work - initial.
struct Energies {
  double kinetic = 0.0;
  double strain = 0.0;
  double external_work = 0.0;  ///< of loads and of given displacements, since the start
  double damping = 0.0;        ///< dissipated since the start, algorithmic dissipation included
  double broken = 0.0;         ///< of bonds, at the moment they broke
  double initial = 0.0;        ///< kinetic + strain at the start
  [[nodiscard]] double balance() const {
    return kinetic + strain + broken + damping - external_work - initial;
  }
};

/// Everything an integrator needs to go on as if it had not stopped, to the last bit. Names are its own.
struct IntegratorState {
  std::int64_t step = 0;
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<std::uint64_t>> bits;
};

/// A sum that loses nothing to rounding while small terms come in (Neumaier).
struct CompensatedSum {
  double sum = 0.0;
  double lost = 0.0;
  void add(double term);
  [[nodiscard]] double value() const { return sum + lost; }
};

/// One way to march through the equations of motion with a fixed step. Steps count from 0; after start or
/// restore the object is at a step and knows its displacement, velocity and energies.
class Integrator {
 public:
  virtual ~Integrator() = default;
  /// At step 0 with displacement q (m) and velocity v (m/s) of the free dofs.
  virtual void start(const Eigen::VectorXd& q, const Eigen::VectorXd& v) = 0;
  /// To the next step. Energies are only right after a step that was asked for them (they may cost a little).
  virtual void advance(bool with_energies) = 0;
  [[nodiscard]] virtual std::int64_t step() const = 0;
  [[nodiscard]] virtual const Eigen::VectorXd& displacement() const = 0;  ///< of the free dofs, m
  /// Of the free dofs at the same instant (explicit: extrapolated by half a step with the forces there), m/s.
  [[nodiscard]] virtual Eigen::VectorXd velocity() const = 0;
  [[nodiscard]] virtual Energies energies() const = 0;
  [[nodiscard]] virtual std::int64_t broken_bonds() const { return 0; }
  [[nodiscard]] virtual IntegratorState save() const = 0;
  /// Throws invalid_input where names or sizes are not its own.
  virtual void restore(const IntegratorState& state) = 0;
};

}  // namespace perimode
