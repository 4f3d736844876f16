// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "perimode/assembly/bond_forces.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/boundary/loads.hpp"
#include "perimode/core/sink.hpp"
#include "perimode/dynamics/modal_superposition.hpp"
#include "perimode/dynamics/motion.hpp"
#include "perimode/dynamics/newmark.hpp"
#include "perimode/dynamics/shifted_solver.hpp"
#include "perimode/dynamics/stable_step.hpp"
#include "perimode/dynamics/step_breaking.hpp"

namespace perimode {

enum class TimeMethod { central_difference, newmark, hht, modal };

/// One quantity followed through time. displacement, velocity: of the particle nearest to `at` (ties to the
/// higher coordinate). strain: (u_b - u_a) . (x_b - x_a) / |x_b - x_a|^2 of the particles nearest to at and
/// to.
struct TransientProbe {
  enum class Kind { displacement, velocity, strain };
  std::string name;
  Kind kind = Kind::displacement;
  Coordinates at = {};
  Coordinates to = {};  ///< strain only
  Where where = {};
};

/// A layer that damps outgoing waves: inside `width` of each face the damping rate rises from 0 to `rate` as
/// (depth/width)^power.
struct Sponge {
  std::vector<Face> faces;
  double width = 0.0;  ///< m
  /// 1/s; 0: (power + 1) ln(1000) c / width with c the speed of long waves along an axis: a wave that crosses
  /// the layer and comes back keeps a thousandth.
  double rate = 0.0;
  double power = 3.0;
  Where where = {};
};

/// Nodal damping of a region: rate 1/s (C = rate m).
struct NodalDamping {
  double rate = 0.0;
  Region at;
  Where where = {};
};

/// The case file's `analysis.transient`.
struct TransientOptions {
  TimeMethod method = TimeMethod::central_difference;
  double dt = 0.0;   ///< s; 0: automatic, 0.9 of the stable step, shortened to hit `end`
  double end = 0.0;  ///< s
  NewmarkOptions newmark = {};
  ImplicitSolver solver = ImplicitSolver::automatic;
  double tolerance = 1e-12;  ///< of conjugate gradients in a step
  int modes = 20;            ///< of modal superposition
  StiffnessForm form = StiffnessForm::automatic;
  Kinematics kinematics = Kinematics::linear;
  std::vector<Load> loads = {};
  double rayleigh_mass = 0.0;       ///< alpha, 1/s
  double rayleigh_stiffness = 0.0;  ///< beta, s
  std::vector<NodalDamping> damping = {};
  std::optional<Sponge> sponge = {};
  std::vector<TransientProbe> probes = {};
  int history_every = 1;                      ///< steps
  std::vector<double> fields_at = {};         ///< s; nearest steps
  int fields_every = 0;                       ///< steps; 0: none but fields_at
  int checkpoint_every = 0;                   ///< steps; 0: none but at an interruption
  std::vector<double> critical_stretch = {};  ///< per block; empty: unbreakable
  std::vector<Region> no_fail = {};           ///< particles none of whose bonds break
  Where dt_where = {};
  Where where = {};
};

/// A line of history.csv.
struct HistoryRow {
  std::int64_t step = 0;
  double time = 0.0;
  Energies energies;
  std::int64_t broken_bonds = 0;
  std::vector<double> probes;  ///< in the order of probe_columns
};

/// Names of the probes' columns: name_x, name_y, ... (strain: name).
[[nodiscard]] std::vector<std::string> probe_columns(const std::vector<TransientProbe>& probes,
                                                     int dimension);

/// Displacements and velocities of all particle dofs at a step, and the body with its bonds as they are.
template <int Dim>
struct TransientFrame {
  std::int64_t step = 0;
  double time = 0.0;
  Eigen::VectorXd displacement;  ///< m
  Eigen::VectorXd velocity;      ///< m/s
  const Body<Dim>* body = nullptr;
};

/// The run before its first step: what `perimode check` prints.
struct TransientPlan {
  std::string method;
  std::string form;    ///< "stencil", "bonds", "blocks", "turning bonds"
  std::string solver;  ///< of implicit steps, with the reason; empty: none
  StableStep stable;
  bool symmetric = true;  ///< R K T
  /// Energies balance to round-off where K is symmetric: no bond turns, none breaks in explicit steps.
  bool conserves = true;
  double dt = 0.0;
  std::int64_t steps = 0;
  double memory_bytes = 0.0;  ///< predicted peak; by plan_transient alone
  std::vector<std::string> warnings = {};
};

/// Whom a run tells what happens. Empty functions are not called. At one step: history, then fields, then
/// checkpoint, then stop.
template <int Dim>
struct TransientObserver {
  /// Before the first report, of a run and of its resumption.
  std::function<void(const TransientPlan&)> begin;
  std::function<void(const HistoryRow&)> history;
  std::function<void(const TransientFrame<Dim>&)> fields;
  std::function<void(const IntegratorState&)> checkpoint;
  /// Asked after every step; true: a checkpoint is made and the run ends as interrupted.
  std::function<bool()> stop;
};

/// Initial displacement (m) and velocity (m/s) of all particle dofs; those that are fixed or prescribed are
/// not looked at. Empty: zero.
struct InitialState {
  Eigen::VectorXd displacement;
  Eigen::VectorXd velocity;
};

enum class TransientStatus { done, interrupted, unstable };

struct TransientResult {
  TransientStatus status = TransientStatus::done;
  std::string message;
  TransientPlan plan;
  Truncation truncation;  ///< modal superposition
  std::int64_t step = 0;  ///< reached
  double time = 0.0;
  std::int64_t first_step = 0;  ///< of this run: 0, or where it was resumed
  Energies energies;            ///< at the last history row
  std::int64_t broken_bonds = 0;
  double boundary_work = 0.0;  ///< of an unsymmetric boundary, J
  Offset iterations = 0;       ///< of conjugate gradients, all steps
  StepRepeats repeats;         ///< of implicit steps in which bonds broke
  double seconds_setup = 0.0, seconds_steps = 0.0, seconds_output = 0.0;
  Eigen::VectorXd displacement;  ///< of all particle dofs at the end, m
  Eigen::VectorXd velocity;      ///< m/s
};

/// Steps a body through time. Bonds break in `body` where critical_stretch is given. `resume`: goes on from a
/// state an observer was given by the same run. Throws invalid_input: dt <= 0 or beyond the stable step (with
/// both numbers and the bound), end <= 0, a probe outside the body, an empty load region, a method that does
/// not fit (modal superposition of an unsymmetric body, large rotations with an implicit method, bonds that
/// break with modal superposition, or with an implicit method and an unsymmetric boundary or bonds that push
/// when stretched), a material instability. Displacements that are no numbers end a run as unstable, and so
/// does, with an unsymmetric boundary, an energy beyond 10^4 times what was ever put in once
/// StableStep::growth has had the time for it.
template <int Dim>
[[nodiscard]] TransientResult run_transient(Body<Dim>& body, const TransientOptions& options,
                                            const InitialState& initial,
                                            const TransientObserver<Dim>& observer = {},
                                            const IntegratorState* resume = nullptr, const Sink& sink = {});

/// Method, step and memory of a run, without running it. Throws as run_transient. Cost: the stable step.
template <int Dim>
[[nodiscard]] TransientPlan plan_transient(const Body<Dim>& body, const TransientOptions& options);

/// M, C, K and the forces of a transient problem of linear kinematics. `body` has to outlive it.
template <int Dim>
[[nodiscard]] Motion make_motion(const Body<Dim>& body, const TransientOptions& options);

}  // namespace perimode
