// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/assembly/bond_limits.hpp"
#include "perimode/boundary/loads.hpp"
#include "perimode/core/sink.hpp"
#include "perimode/dynamics/motion.hpp"
#include "perimode/fracture/crack_area.hpp"
#include "perimode/geometry/region.hpp"
#include "perimode/linalg/updated_solver.hpp"

namespace perimode {

/// event: the load factor of every break is found exactly (sequentially linear). steps: loads and given
/// motion follow their functions of time; bonds break within a step until none is over-stretched.
enum class QuasistaticControl { event, steps };

/// What becomes of a piece that the breaks leave without support: held by springs where it could move, or,
/// where no bond ties it to the rest, removed: its loads dropped, all of it at rest, its bonds left alone.
enum class LoosePieces { hold, remove };

struct QuasistaticStop {
  /// Once a piece that carries load has lost its support, or no bond is stretched any more. false: such a
  /// piece is held or removed like any other, and the run goes on while a bond can break.
  bool separated = true;
  std::int64_t events = 0;  ///< after so many events; 0: no limit
  double load_drop = 0.0;   ///< once the load has fallen by this share of its largest value; 0: never
};

/// The case file's `analysis.quasistatic`.
struct QuasistaticOptions {
  QuasistaticControl control = QuasistaticControl::event;
  /// event: times the load factor. steps: times their functions of time.
  std::vector<Load> loads = {};
  /// event: loads in full at every load factor, also at zero. Given motion stands in full as well where there
  /// are loads, and is what the load factor scales where there are none.
  std::vector<Load> dead_loads = {};
  std::vector<Region> no_fail = {};  ///< particles none of whose bonds break
  QuasistaticStop stop = {};
  LoosePieces loose = LoosePieces::hold;
  double end = 1.0;          ///< steps: time of the last one
  std::int64_t steps = 100;  ///< steps: their number
  Index break_at_once = 1;  ///< steps: the worst so many over-stretched bonds break between solutions; 0: all
  UpdatedSolverOptions solver = {};
  bool matrix_free = false;  ///< no factor: conjugate gradients on the operator (also chosen where none fits)
  bool griffith = false;     ///< for the program: also griffith_load (griffith.hpp); a run does not read it
  std::int64_t fields_every = 0;              ///< events (steps); 0: the first and last state alone
  std::int64_t checkpoint_every = 0;          ///< events (steps); 0: none but at an interruption
  std::vector<double> critical_stretch = {};  ///< per block
  CrackAreaScale area = {};                   ///< of broken bonds (crack_area_scale)
  Where where = {};
};

/// A line of load_curve.csv: the state at an event before its bonds break (steps: at the end of a step).
struct QuasistaticRow {
  std::int64_t event = 0;     ///< from 1; steps: number of the step
  double time = 0.0;          ///< steps
  double load_factor = 0.0;   ///< steps: of the loads (without loads, the given motion) in full
  double displacement = 0.0;  ///< f.u/|f| of the loads; without loads, load_factor |g| of the given motion, m
  double force = 0.0;         ///< the force that works along it: load_factor |f|; without loads r.g/|g|, N
  /// Sum of the magnitudes of the loads now (without loads: of the reaction along the given motion), N, and
  /// the mean displacement along them, m: force and displacement times and over |d|_1, d the direction of the
  /// curve.
  double total_force = 0.0;
  double mean_displacement = 0.0;
  double stored_energy = 0.0;         ///< J, bond by bond
  double dissipated_energy = 0.0;     ///< J, chord: (F_n U_n+1 - F_n+1 U_n)/2 summed, docs/theory/14
  double bond_energy_released = 0.0;  ///< J, of bonds as they broke
  double relaxation_energy = 0.0;     ///< J, work of the broken bonds' forces as they are let go
  double external_work = 0.0;         ///< J, along the chords
  Offset broken_bonds = 0;            ///< before this event
  Offset breaking_bonds = 0;          ///< at this event (steps: within the step)
  double crack_length = 0.0;          ///< m (3D: area, m2; 1D: number of cuts), pre-cracks included
  int iterations = 0;                 ///< steps: solutions within the step
  /// stored + released + relaxation - work, J: round-off
  [[nodiscard]] double balance() const {
    return stored_energy + bond_energy_released + relaxation_energy - external_work;
  }
};

/// A bond that broke.
template <int Dim>
struct BrokenBond {
  std::int64_t event = 0;
  Index first = 0, second = 0;             ///< particles (a ghost's: its image)
  Point<Dim> middle = Point<Dim>::Zero();  ///< m
  double energy = 0.0;                     ///< J
};

/// A piece without support.
struct LoosePiece {
  std::int64_t event = 0;
  Index particles = 0;
  std::vector<double> centre;  ///< m
  bool loaded = false;         ///< it carries load
};

template <int Dim>
struct QuasistaticFrame {
  std::int64_t event = 0;
  double load_factor = 0.0;      ///< steps: the time
  Eigen::VectorXd displacement;  ///< of all particle dofs, m
  const Body<Dim>* body = nullptr;
};

/// What `perimode check` prints and summary.json keeps of the set-up.
struct QuasistaticPlan {
  Index dofs = 0;
  Offset bonds = 0;
  std::string solver;         ///< "cholesky, updated", "conjugate gradients", with the reason
  int rigid_modes = 0;        ///< free rigid motions, projected out
  double memory_bytes = 0.0;  ///< predicted peak; by plan_quasistatic alone
  std::vector<std::string> warnings = {};
};

/// Whom a run tells what happens; empty functions are not called.
template <int Dim>
struct QuasistaticObserver {
  std::function<void(const QuasistaticPlan&)> begin;
  std::function<void(const QuasistaticRow&)> row;
  std::function<void(const std::vector<BrokenBond<Dim>>&)> broken;  ///< of one event, after its row
  std::function<void(const QuasistaticFrame<Dim>&)> fields;
  std::function<void(const LoosePiece&)> loose;
  std::function<void(const IntegratorState&)> checkpoint;
  /// Asked after every event; true: a checkpoint is made and the run ends as interrupted.
  std::function<bool()> stop;
};

/// separated, events, load_drop: as QuasistaticStop. done: the last step. unstretched: no bond that may break
/// is stretched (all is in compression, or protected). dead_loads: the dead loads alone break the body.
/// not_converged: a residual, or a mechanism that was not found.
enum class QuasistaticStatus {
  separated,
  events,
  load_drop,
  done,
  unstretched,
  dead_loads,
  not_converged,
  interrupted
};

struct QuasistaticResult {
  QuasistaticStatus status = QuasistaticStatus::not_converged;
  std::string message;
  QuasistaticPlan plan;
  std::int64_t events = 0;  ///< rows so far (steps: steps)
  double first_load = 0.0;  ///< load factor of the first event
  double peak_load = 0.0;   ///< the largest one (steps: largest force)
  std::int64_t peak_event = 0;
  Offset broken_bonds = 0;
  double crack_length = 0.0;  ///< m (3D: area, m2; 1D: number of cuts), at the end
  QuasistaticRow last;        ///< energies at the last row
  std::vector<LoosePiece> loose;
  std::array<WayTotals, solve_ways> ways = {};
  double worst_residual = 0.0;
  double worst_balance = 0.0;  ///< largest |balance| / external_work
  double seconds_setup = 0.0, seconds_search = 0.0, seconds_output = 0.0, seconds_total = 0.0;
  double factor_seconds = 0.0;
  Eigen::VectorXd displacement;  ///< of all particle dofs at the last row, m
};

/// Grows cracks in `body`, whose bonds break, under loads that never outrun equilibrium. Rigid motion left
/// free under self-equilibrated loads is projected out. docs/theory/14_quasistatic.md. `resume`: goes on from
/// a state an observer was given by the same run. Throws invalid_input: nothing that loads or moves the body,
/// supports that do not hold it against its loads, no bond that may break, a critical stretch exceeded at
/// zero load, pre-cracks that cut nothing, an unsymmetric boundary, functions of time in event control.
template <int Dim>
[[nodiscard]] QuasistaticResult run_quasistatic(Body<Dim>& body, const QuasistaticOptions& options,
                                                const QuasistaticObserver<Dim>& observer = {},
                                                const IntegratorState* resume = nullptr,
                                                const Sink& sink = {});

/// Solver and memory of a run, without running it. Throws as run_quasistatic does before its first solution.
template <int Dim>
[[nodiscard]] QuasistaticPlan plan_quasistatic(const Body<Dim>& body, const QuasistaticOptions& options);

}  // namespace perimode
