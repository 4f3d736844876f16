// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/transient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/stopwatch.hpp"
#include "dynamics/instability.hpp"
#include "dynamics/probes.hpp"
#include "dynamics/transient_plan.hpp"
#include "perimode/dynamics/central_difference.hpp"
#include "perimode/modal/modes.hpp"

namespace perimode {

namespace {

template <int Dim>
Eigen::VectorXd free_part(const BoundaryMap<Dim>& boundary, const Eigen::VectorXd& all) {
  Eigen::VectorXd part = Eigen::VectorXd::Zero(boundary.free);
  for (Eigen::Index d = 0; d < all.size(); ++d) {
    const Index number = boundary.free_number[static_cast<std::size_t>(d)];
    if (number >= 0) part[number] = all[d];
  }
  return part;
}

/// Displacements and velocities of all particle dofs from the free ones and the given ones at an instant.
template <int Dim>
class Everywhere {
 public:
  Everywhere(const BoundaryMap<Dim>& boundary, double dt, double end)
      : boundary_(&boundary), dt_(dt), end_(end) {}

  void move_to(double t) {
    h_.clear();
    rate_.clear();
    // Functions of time are asked about the time of the run alone.
    const double before = std::max(t - dt_, 0.0);
    const double after = std::max(std::min(t + dt_, end_), t);
    for (const TimeFunction& f : boundary_->time) {
      h_.push_back(value_at(f, t));
      rate_.push_back((value_at(f, after) - value_at(f, before)) / (after - before));
    }
  }

  [[nodiscard]] double displacement(const Eigen::VectorXd& q, std::size_t dof) const {
    const Index number = boundary_->free_number[dof];
    return number >= 0 ? q[number] : boundary_->given[dof] * h_[function(dof)];
  }
  [[nodiscard]] double velocity(const Eigen::VectorXd& v, std::size_t dof) const {
    const Index number = boundary_->free_number[dof];
    return number >= 0 ? v[number] : boundary_->given[dof] * rate_[function(dof)];
  }

  [[nodiscard]] Eigen::VectorXd all_displacements(const Eigen::VectorXd& q) const {
    return all([&](std::size_t d) { return displacement(q, d); });
  }
  [[nodiscard]] Eigen::VectorXd all_velocities(const Eigen::VectorXd& v) const {
    return all([&](std::size_t d) { return velocity(v, d); });
  }

 private:
  [[nodiscard]] std::size_t function(std::size_t dof) const {
    return boundary_->given_time.empty() ? 0 : static_cast<std::size_t>(boundary_->given_time[dof]);
  }
  template <class Value>
  [[nodiscard]] Eigen::VectorXd all(const Value& value) const {
    const std::size_t dofs = boundary_->free_number.size();
    Eigen::VectorXd u(static_cast<Eigen::Index>(dofs));
    for (std::size_t d = 0; d < dofs; ++d) u[static_cast<Eigen::Index>(d)] = value(d);
    return u;
  }

  const BoundaryMap<Dim>* boundary_;
  double dt_, end_;
  std::vector<double> h_, rate_;
};

/// What a run is made of. The order matters: later ones refer to earlier ones.
template <int Dim>
struct Run {
  Motion motion;
  std::unique_ptr<BondForces<Dim>> forces;  ///< of explicit steps, if bonds turn or break
  std::unique_ptr<StepBreaking> breaking;   ///< of implicit steps, if bonds break
  std::shared_ptr<Offset> iterations = std::make_shared<Offset>(0);
  std::unique_ptr<Integrator> integrator;
};

constexpr const char* iterations_name = "iterations of the solver";

/// The integrator's state and the count of iterations so far.
template <int Dim>
IntegratorState saved(const Run<Dim>& run) {
  IntegratorState state = run.integrator->save();
  state.bits[iterations_name] = {static_cast<std::uint64_t>(*run.iterations)};
  return state;
}

template <int Dim>
void restore(Run<Dim>& run, IntegratorState state) {
  const auto counted = state.bits.extract(iterations_name);
  if (!counted.empty()) *run.iterations = static_cast<Offset>(counted.mapped().at(0));
  run.integrator->restore(state);
}

template <int Dim>
BondLimits limits(const Body<Dim>& body, const TransientOptions& options) {
  BondLimits result{options.critical_stretch};
  const std::vector<Index> held = unbreakable(body, options);
  if (held.empty()) return result;
  result.no_fail.assign(static_cast<std::size_t>(body.count()), 0);
  for (const Index i : held) result.no_fail[static_cast<std::size_t>(i)] = 1;
  return result;
}

/// The solver of implicit steps; with bonds that break, that of run.breaking.
template <int Dim>
ShiftedSolver implicit_solver(Body<Dim>& body, const TransientOptions& options, Run<Dim>& run,
                              TransientPlan& plan) {
  const double ratio = plan.dt / plan.stable.limit;
  if (!may_break(options)) {
    return make_shifted_solver(body, as_operator(run.motion.stiffness), run.motion.symmetric, options.solver,
                               ratio, options.tolerance, plan.solver);
  }
  const ImplicitSolver solver = choose_shifted_solver(body, run.motion.symmetric, options.solver, ratio,
                                                      options.tolerance, plan.solver);
  run.breaking = step_breaking(
      body, run.motion,
      {limits(body, options), options.form, solver == ImplicitSolver::factor, options.tolerance});
  return [breaking = run.breaking.get()](const Eigen::VectorXd& d) { return breaking->solver(d); };
}

template <int Dim>
std::unique_ptr<Integrator> implicit_integrator(Body<Dim>& body, const TransientOptions& options,
                                                Run<Dim>& run, TransientPlan& plan) {
  ShiftedSolver solver = implicit_solver(body, options, run, plan);
  // Counts the iterations of all steps on their way.
  const auto counted = [solver = std::move(solver), total = run.iterations](const Eigen::VectorXd& d) {
    return ShiftedSolve([solve = solver(d), total](const Eigen::VectorXd& b, const Eigen::VectorXd& guess,
                                                   Eigen::VectorXd& x) {
      const int iterations = solve(b, guess, x);
      *total += iterations;
      return iterations;
    });
  };
  NewmarkOptions newmark_options = options.newmark;
  if (options.method == TimeMethod::newmark) newmark_options.alpha = 0.0;
  return newmark(run.motion, plan.dt, newmark_options, counted, run.breaking.get());
}

template <int Dim>
std::unique_ptr<Integrator> modal_integrator(const Body<Dim>& body, const TransientOptions& options,
                                             const Motion& motion, const Eigen::VectorXd& q,
                                             const Eigen::VectorXd& v, double dt, TransientResult& result,
                                             const Sink& sink) {
  if (!motion.symmetric) {
    invalid_input({"a symmetric body for method: modal", "surface nodes, or odd or even walls",
                   "use central_difference or newmark", options.where});
  }
  ModalOptions modal;
  modal.modes = std::min<int>(options.modes, body.boundary.free);
  const ModalResult modes = solve_modes(body, modal, sink);
  if (modes.status == EigenStatus::not_converged)
    throw Error(ErrorKind::solver_failure, "the modes did not converge: " + modes.message);
  if (modes.unstable > 0) {
    Eigen::Index lowest = 0;
    const double lambda = modes.eigenvalue.minCoeff(&lowest);
    refuse_instability(body, modes.shape.col(lowest), lambda);
  }
  result.truncation = truncation(motion, modes.shape, modes.eigenvalue, q, v);
  const double left_out = std::max(result.truncation.initial_energy, result.truncation.load);
  constexpr double much = 0.1;
  if (left_out > much) {
    sink.warn(fmt::format("{} modes leave out {:.0f} % of the {}; take more of them, or another method",
                          modes.count(), 100.0 * left_out,
                          result.truncation.load > result.truncation.initial_energy ? "loads or given motions"
                                                                                    : "initial energy"));
  }
  return modal_superposition(motion, dt, modes.shape, modes.eigenvalue);
}

/// Reports a share of the steps now and then, seldom enough to cost nothing.
class Progress {
 public:
  Progress(const Sink& sink, std::int64_t steps) : sink_(&sink), steps_(steps) {}
  void at(std::int64_t step) {
    if (step % 16 != 0 && step != steps_) return;
    const auto now = Clock::now();
    if (std::chrono::duration<double>(now - last_).count() < 0.2) return;
    last_ = now;
    sink_->report(fmt::format("step {} of {}", step, steps_),
                  static_cast<double>(step) / static_cast<double>(steps_));
  }

 private:
  const Sink* sink_;
  std::int64_t steps_;
  Clock::time_point last_ = Clock::now();
};

template <int Dim>
class Stepper {
 public:
  Stepper(Body<Dim>& body, const TransientOptions& options, const TransientObserver<Dim>& observer,
          TransientResult& result, Run<Dim>& run)
      : body_(&body),
        options_(&options),
        observer_(&observer),
        result_(&result),
        run_(&run),
        probes_(place_probes(body, options.probes)),
        field_steps_(field_steps(options, result.plan)),
        everywhere_(body.boundary, result.plan.dt, result.plan.dt * static_cast<double>(result.plan.steps)) {
    needs_velocity_ = std::any_of(probes_.begin(), probes_.end(), [](const PlacedProbe<Dim>& p) {
      return p.kind == TransientProbe::Kind::velocity;
    });
  }

  [[nodiscard]] bool is_row(std::int64_t step) const {
    return step % options_->history_every == 0 || step == result_->plan.steps;
  }

  /// Takes over the integrator's step and time.
  void settle() {
    result_->step = run_->integrator->step();
    result_->time = static_cast<double>(result_->step) * result_->plan.dt;
    everywhere_.move_to(result_->time);
  }

  /// What is due at the present step. False: the displacements are numbers no more.
  bool report() {
    settle();
    const std::int64_t step = result_->step;
    if (is_row(step) && !row(step)) return false;
    const bool framed =
        observer_->fields && std::binary_search(field_steps_.begin(), field_steps_.end(), step);
    const bool kept = observer_->checkpoint && options_->checkpoint_every > 0 &&
                      step % options_->checkpoint_every == 0 && step > result_->first_step &&
                      step < result_->plan.steps;
    if ((framed || kept) && !run_->integrator->displacement().allFinite()) return false;
    if (framed) frame(step);
    if (kept) observer_->checkpoint(saved(*run_));
    return true;
  }

  [[nodiscard]] Eigen::VectorXd displacement() const {
    return everywhere_.all_displacements(run_->integrator->displacement());
  }
  [[nodiscard]] Eigen::VectorXd velocity() const {
    return everywhere_.all_velocities(run_->integrator->velocity());
  }

 private:
  bool row(std::int64_t step) {
    HistoryRow row;
    row.step = step;
    row.time = result_->time;
    row.energies = run_->integrator->energies();
    row.broken_bonds = run_->integrator->broken_bonds();
    result_->energies = row.energies;
    result_->broken_bonds = row.broken_bonds;
    const double held = row.energies.kinetic + row.energies.strain;
    if (!std::isfinite(held)) return false;
    put_in_ = std::max(put_in_, row.energies.initial + std::abs(row.energies.external_work));
    if (fed_by_boundary(held)) return false;
    if (observer_->history) {
      const Eigen::VectorXd& q = run_->integrator->displacement();
      const Eigen::VectorXd v = needs_velocity_ ? run_->integrator->velocity() : Eigen::VectorXd();
      const auto dof = [](Index particle, int a) { return static_cast<std::size_t>(particle) * Dim + a; };
      row.probes = read_probes<Dim>(
          probes_, [&](Index i, int a) { return everywhere_.displacement(q, dof(i, a)); },
          [&](Index i, int a) { return everywhere_.velocity(v, dof(i, a)); });
      observer_->history(row);
    }
    return true;
  }

  /// Whether waves that the boundary feeds have had the time to outgrow everything else, and have.
  [[nodiscard]] bool fed_by_boundary(double held) const {
    constexpr double hundredfold = 4.6;  // exp of it
    constexpr double beyond_belief = 1e4;
    return result_->plan.stable.growth * result_->time > hundredfold && put_in_ > 0.0 &&
           held > beyond_belief * put_in_;
  }

  /// Ghosts that move on their own are where they are at that instant.
  void frame(std::int64_t step) {
    const TransientFrame<Dim> now{step, result_->time, displacement(), velocity(), body_};
    const bool moving = !body_->boundary.value_time.empty();
    BoundaryMap<Dim> full;
    if (moving) {
      full = body_->boundary;
      body_->boundary = at_time(full, result_->time);
    }
    observer_->fields(now);
    if (moving) body_->boundary = std::move(full);
  }

  Body<Dim>* body_;
  const TransientOptions* options_;
  const TransientObserver<Dim>* observer_;
  TransientResult* result_;
  Run<Dim>* run_;
  std::vector<PlacedProbe<Dim>> probes_;
  std::vector<std::int64_t> field_steps_;
  Everywhere<Dim> everywhere_;
  bool needs_velocity_ = false;
  double put_in_ = 0.0;  ///< energy that came in so far, J
};

}  // namespace

template <int Dim>
TransientResult run_transient(Body<Dim>& body, const TransientOptions& options, const InitialState& initial,
                              const TransientObserver<Dim>& observer, const IntegratorState* resume,
                              const Sink& sink) {
  const auto start = Clock::now();
  TransientResult result;
  check_options(body, options);
  sink.report("loads and forces");
  Run<Dim> run;
  run.motion = make_motion(body, options);
  sink.report("stable step");
  result.plan = plan_steps(body, options, run.motion);
  for (const std::string& warning : result.plan.warnings) sink.warn(warning);
  const double dt = result.plan.dt;

  const Eigen::VectorXd q = free_part(body.boundary, initial.displacement);
  const Eigen::VectorXd v = free_part(body.boundary, initial.velocity);
  if (needs_bond_forces(options)) {
    run.forces = std::make_unique<BondForces<Dim>>(body, options.kinematics, options.critical_stretch,
                                                   unbreakable(body, options));
    run.integrator = central_difference(run.motion, *run.forces, dt);
  } else if (options.method == TimeMethod::central_difference) {
    run.integrator = central_difference(run.motion, dt);
  } else if (options.method == TimeMethod::modal) {
    run.integrator = modal_integrator(body, options, run.motion, q, v, dt, result, sink);
  } else {
    run.integrator = implicit_integrator(body, options, run, result.plan);
  }

  Stepper<Dim> stepper(body, options, observer, result, run);
  if (resume != nullptr) {
    restore(run, *resume);
    result.first_step = run.integrator->step();
    stepper.settle();
  } else {
    run.integrator->start(q, v);
  }
  result.seconds_setup = seconds_since(start);

  if (observer.begin) observer.begin(result.plan);
  const auto stepping = Clock::now();
  Progress progress(sink, result.plan.steps);
  bool sound = resume != nullptr || stepper.report();
  while (sound && run.integrator->step() < result.plan.steps) {
    if (observer.stop && observer.stop()) {
      if (observer.checkpoint) observer.checkpoint(saved(run));
      result.status = TransientStatus::interrupted;
      break;
    }
    run.integrator->advance(stepper.is_row(run.integrator->step() + 1));
    progress.at(run.integrator->step());
    sound = stepper.report();
  }
  if (!sound) {
    result.status = TransientStatus::unstable;
    result.message = fmt::format(
        "displacements grew beyond all measure by step {}{}", result.step,
        result.plan.symmetric ? "" : ": an unsymmetric boundary can feed waves; use other walls or damping");
  }
  result.seconds_steps = seconds_since(stepping);
  result.iterations = *run.iterations;
  if (run.breaking) result.repeats = run.breaking->repeats();
  result.displacement = stepper.displacement();
  result.velocity = stepper.velocity();
  if (!result.plan.symmetric) result.boundary_work = result.energies.balance();
  return result;
}

#define PERIMODE_TRANSIENT(D)                                                                       \
  template TransientResult run_transient<D>(Body<D>&, const TransientOptions&, const InitialState&, \
                                            const TransientObserver<D>&, const IntegratorState*,    \
                                            const Sink&)
PERIMODE_TRANSIENT(1);
PERIMODE_TRANSIENT(2);
PERIMODE_TRANSIENT(3);
#undef PERIMODE_TRANSIENT

}  // namespace perimode
