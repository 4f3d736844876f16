// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "fracture/equilibrium.hpp"
#include "fracture/fracture_ledger.hpp"
#include "fracture/loose_pieces.hpp"
#include "perimode/assembly/bond_limits.hpp"
#include "perimode/fracture/quasistatic.hpp"

namespace perimode {

/// Loads (N) and given displacements (m) on all particle dofs.
struct Driving {
  Eigen::VectorXd load;
  Eigen::VectorXd given;
};

/// What a run starts from, found out and checked before anything breaks.
struct QuasistaticProblem {
  std::vector<Driving> parts;  ///< event: live, and dead where there is any; steps: one per function of time
  std::vector<TimeFunction> time;  ///< steps: of the parts
  bool motion_driven = false;      ///< no loads: given displacements drive the body
  Eigen::VectorXd direction;       ///< of the curve: f or g in full over its norm, all particle dofs
  double size = 0.0;               ///< |f| or |g|
  BondLimits limits;
  Eigen::VectorXd mass;   ///< of the free dofs, kg
  Eigen::MatrixXd rigid;  ///< motions left free, M-orthonormal
};

/// Throws invalid_input as run_quasistatic.
template <int Dim>
[[nodiscard]] QuasistaticProblem pose_quasistatic(const Body<Dim>& body, const QuasistaticOptions& options);

/// Share of the load that springs hold, or a loose piece carries, from which the body counts as separated.
constexpr double separating_share = 0.01;

/// A body whose crack grows: what both controls share.
template <int Dim>
class CrackRun {
 public:
  CrackRun(Body<Dim>& body, const QuasistaticOptions& options, const QuasistaticObserver<Dim>& observer,
           const Sink& sink, QuasistaticProblem problem, bool matrix_free, const IntegratorState* resume);

  /// Displacements (all particle dofs, rigid motions projected out) under each of the drivings, one solution.
  /// Mechanisms are pinned on the way. false: not solved; the result says why.
  [[nodiscard]] bool solve(const std::vector<Driving>& drivings, std::vector<Eigen::VectorXd>& displacement);
  /// Share of the driving's load that springs carry in the last solution, the largest over its columns.
  [[nodiscard]] double spring_share() const { return spring_share_; }

  /// The ledger goes to a state: displacement, driving and strain energy, and the factors by which it is made
  /// of the columns of the last solution.
  void reach(const Eigen::VectorXd& displacement, const Driving& driving, double stored,
             const std::vector<double>& factors);
  /// Bonds break at the state reached; pieces that lose their support are held or removed.
  void break_bonds(const std::vector<BondRef>& bonds);
  /// A row of the state reached, before its bonds break.
  [[nodiscard]] QuasistaticRow row(double load_factor) const;
  /// The row is the run's event (step) from here on, and bonds that break are its own.
  void start_row(const QuasistaticRow& row);
  /// Bonds that break are those of this event (step).
  void label(std::int64_t event) { label_ = event; }
  /// Reports the row, the bonds broken and, when it is their turn, fields and a checkpoint, and asks whether
  /// to stop. true: the run is interrupted.
  [[nodiscard]] bool end_row(const QuasistaticRow& row);
  /// Ends the run: fields of the last row, sums. Returns the result.
  [[nodiscard]] QuasistaticResult finish(QuasistaticStatus status, std::string message);

  [[nodiscard]] const QuasistaticProblem& problem() const { return problem_; }
  [[nodiscard]] std::int64_t event() const { return result_.events; }
  [[nodiscard]] const Body<Dim>& body() const { return *body_; }
  [[nodiscard]] const QuasistaticOptions& options() const { return *options_; }
  [[nodiscard]] const Sink& sink() const { return *sink_; }
  [[nodiscard]] Offset broken() const { return result_.broken_bonds; }
  [[nodiscard]] double peak_force() const { return peak_force_; }
  /// steps: largest strain energy so far per square of the load factor, J: beside which an energy is nothing.
  [[nodiscard]] double unit_energy() const { return unit_energy_; }
  void set_unit_energy(double energy) { unit_energy_ = energy; }
  QuasistaticResult& result() { return result_; }

 private:
  [[nodiscard]] Eigen::VectorXd right_side(const Driving& driving) const;
  [[nodiscard]] Point<Dim> force_on(Index i, const Eigen::VectorXd& displacement) const;
  [[nodiscard]] bool held(Index i) const;
  void clear_bonds(const std::vector<BondRef>& bonds);
  [[nodiscard]] bool held_by_nothing(Index i) const;
  /// `apart`: no bond ties the piece to others. One that hangs by a hinge is held, as it may pass loads on.
  void hold_or_remove(const std::vector<Index>& piece, const std::vector<Index>& dofs, bool apart);
  void pin_mechanism(Index dof);
  void flush_broken();
  void give_fields();
  [[nodiscard]] IntegratorState save() const;
  void restore(const IntegratorState& state);

  Body<Dim>* body_;
  const QuasistaticOptions* options_;
  const QuasistaticObserver<Dim>* observer_;
  const Sink* sink_;
  QuasistaticProblem problem_;
  std::vector<Index> moving_;  ///< particles with a given displacement that is not zero
  std::vector<Index> beside_;  ///< and those with free dofs within reach of them
  std::unique_ptr<Equilibrium<Dim>> equilibrium_;
  LooseSearch<Dim> search_;
  FractureLedger ledger_;
  std::vector<std::uint8_t> removed_;  ///< particles of removed pieces: their loads are gone
  Eigen::MatrixXd q_;  ///< last solution, the next guess (rigid motions as the springs have them)
  double spring_share_ = 0.0;
  std::vector<BondRef> left_;                ///< bonds broken at the state reached
  std::vector<BrokenBond<Dim>> unreported_;  ///< of them
  double broken_area_ = 0.0;
  std::int64_t label_ = 0;
  double peak_force_ = 0.0;
  double unit_energy_ = 0.0;
  bool frame_due_ = false;  ///< fields of the last row were not given out
  QuasistaticResult result_;
};

/// A piece that carries load is without support before anything broke.
[[noreturn]] void not_held();

/// The drivers. Each returns the finished result.
template <int Dim>
[[nodiscard]] QuasistaticResult run_events(CrackRun<Dim>& run);
template <int Dim>
[[nodiscard]] QuasistaticResult run_steps(CrackRun<Dim>& run);

}  // namespace perimode
