// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/transient_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dynamics/instability.hpp"
#include "dynamics/probes.hpp"
#include "perimode/assembly/critical_stretches.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/modal/plan.hpp"

namespace perimode {

namespace {

constexpr double share_of_limit = 0.9;  ///< of the stable step that an automatic one takes

const char* method_name(TimeMethod method) {
  switch (method) {
    case TimeMethod::central_difference:
      return "central_difference";
    case TimeMethod::newmark:
      return "newmark";
    case TimeMethod::hht:
      return "hht";
    case TimeMethod::modal:
      break;
  }
  return "modal";
}

template <int Dim>
const char* form_name(const Body<Dim>& body, const TransientOptions& options) {
  if (needs_bond_forces(options)) return "bond forces";
  switch (options.form) {
    case StiffnessForm::stencil:
      return "stencil";
    case StiffnessForm::bonds:
      return "bonds";
    case StiffnessForm::blocks:
      return "assembled";
    case StiffnessForm::automatic:
      break;
  }
  return std::holds_alternative<GridBonds<Dim>>(body.bonds) ? "stencil" : "bonds";
}

void refuse_step(const TransientOptions& options, const TransientPlan& plan, double limit) {
  invalid_input(
      {fmt::format("a step dt <= {:.6g} s, the stable step of this body (omega_max = {:.6g} rad/s; "
                   "sufficient: {:.6g} s)",
                   limit, plan.stable.omega_max, plan.stable.bound),
       fmt::format("{:.6g} s", options.dt),
       options.method == TimeMethod::newmark
           ? "use a smaller dt, dt: auto, or beta >= gamma/2, which is stable for every step"
           : "use a smaller dt, dt: auto, or method: newmark",
       options.dt_where.line > 0 || !options.dt_where.file.empty() ? options.dt_where : options.where});
}

/// Largest step that does not let motion grow, s: that of central differences, and of Newmark's method with
/// beta < gamma/2, omega dt <= 1/sqrt(gamma/2 - beta) [hughes2000].
double largest_step(const TransientOptions& options, const StableStep& stable) {
  if (options.method == TimeMethod::central_difference) return stable.limit;
  const double lack = 0.5 * options.newmark.gamma - options.newmark.beta;
  if (options.method != TimeMethod::newmark || lack <= 0.0 || stable.omega_max == 0.0)
    return std::numeric_limits<double>::infinity();
  return 1.0 / (std::sqrt(lack) * stable.omega_max);
}

/// Steps to the end; more than can be counted, let alone waited for, are refused.
std::int64_t counted_steps(double steps, const TransientOptions& options) {
  constexpr double most = 1e12;
  if (!(steps <= most)) {
    invalid_input({fmt::format("at most {:.0e} steps", most), fmt::format("{:.3g}", steps),
                   "make end smaller or dt larger", options.where});
  }
  return std::max<std::int64_t>(static_cast<std::int64_t>(steps), 1);
}

}  // namespace

bool may_break(const TransientOptions& options) {
  return std::any_of(options.critical_stretch.begin(), options.critical_stretch.end(),
                     [](double s) { return std::isfinite(s); });
}

bool needs_bond_forces(const TransientOptions& options) {
  return options.method == TimeMethod::central_difference &&
         (options.kinematics == Kinematics::large_rotation || may_break(options));
}

template <int Dim>
std::vector<Index> unbreakable(const Body<Dim>& body, const TransientOptions& options) {
  std::vector<Index> held;
  for (const Region& region : options.no_fail) {
    const std::vector<Index> here = select(region, body.particles);
    if (here.empty()) {
      invalid_input({"no_fail regions that hold at least one particle", "none", "move or enlarge the region",
                     region.where.line > 0 ? region.where : options.where});
    }
    held.insert(held.end(), here.begin(), here.end());
  }
  for (Index i = 0; i < body.count() && !body.boundary.more_start.empty(); ++i) {
    bool across = false;
    for_each_bond(body.bonds, i, Which::alive,
                  [&](const BondEnd<Dim>& end) { across = across || end.neighbour >= body.count(); });
    if (across) held.push_back(i);
  }
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
  return held;
}

template <int Dim>
void check_options(const Body<Dim>& body, const TransientOptions& options) {
  if (!(options.end > 0.0) || !std::isfinite(options.end)) {
    invalid_input({"an end of the run after its start at t = 0", fmt::format("end = {} s", options.end),
                   "give it in s, for example end: 1.0e-3", options.where});
  }
  if (options.dt < 0.0 || !std::isfinite(options.dt)) {
    invalid_input({"a step dt > 0 s", fmt::format("{}", options.dt), "or write dt: auto", options.where});
  }
  if (options.dt > options.end * (1.0 + 1e-9)) {
    invalid_input({fmt::format("a step dt <= end = {} s", options.end), fmt::format("{} s", options.dt),
                   "make dt smaller or end larger", options.where});
  }
  if (body.boundary.free == 0) {
    invalid_input({"a body that can move", "every component fixed or prescribed",
                   "free some particles in `boundary`", options.where});
  }
  const bool explicit_method = options.method == TimeMethod::central_difference;
  if (options.kinematics == Kinematics::large_rotation && !explicit_method) {
    invalid_input({"method: central_difference with kinematics: large_rotation", method_name(options.method),
                   "use central_difference, or kinematics: linear", options.where});
  }
  if (may_break(options) && options.method == TimeMethod::modal) {
    invalid_input({"method: central_difference, newmark or hht for a material that breaks", "modal",
                   "use one of these, or leave out fracture_energy and critical_stretch", options.where});
  }
  if (may_break(options) && !explicit_method && softening(body)) {
    invalid_input({"bonds that pull when they are stretched, for implicit steps that break them",
                   "a micromodulus with negative parts", "use central_difference", options.where});
  }
  (void)unbreakable(body, options);
  if (needs_bond_forces(options) && options.form != StiffnessForm::automatic) {
    invalid_input({"operator: auto for bonds that turn or break", "another",
                   "remove `operator`: such bonds have forces of their own", options.where});
  }
  for (const double t : options.fields_at) {
    if (t < 0.0 || t > options.end * (1.0 + 1e-9)) {
      invalid_input({fmt::format("times of fields_at from 0 to end = {} s", options.end),
                     fmt::format("{} s", t), "remove it or make end larger", options.where});
    }
  }
}

template <int Dim>
TransientPlan plan_steps(const Body<Dim>& body, const TransientOptions& options, const Motion& motion) {
  TransientPlan plan;
  plan.method = method_name(options.method);
  plan.form = form_name(body, options);
  plan.symmetric = motion.symmetric;
  plan.conserves = !needs_bond_forces(options);
  const bool explicit_method = options.method == TimeMethod::central_difference;
  const bool implicit_method = options.method == TimeMethod::newmark || options.method == TimeMethod::hht;
  if (may_break(options) && implicit_method && !motion.symmetric) {
    invalid_input({"a symmetric boundary for implicit steps that break bonds",
                   "surface nodes, or odd or even walls",
                   "use mirror, antimirror or zero_layer walls, or central_difference", options.where});
  }
  if (explicit_method || implicit_method || options.dt == 0.0) {
    plan.stable = stable_step(body, as_operator(motion.stiffness), motion.mass, motion.symmetric,
                              explicit_method ? options.rayleigh_stiffness : 0.0);
  }
  if (options.dt == 0.0) {
    const double limit = std::min(plan.stable.limit, largest_step(options, plan.stable));
    plan.steps = counted_steps(std::ceil(options.end / (share_of_limit * limit) * (1.0 - 1e-12)), options);
    plan.dt = options.end / static_cast<double>(plan.steps);
  } else {
    plan.dt = options.dt;
    plan.steps = counted_steps(std::round(options.end / options.dt), options);
    const double limit = largest_step(options, plan.stable);
    if (options.dt > limit * (1.0 + 1e-12)) refuse_step(options, plan, limit);
  }
  if (negative_bonds_may_break(body, options.critical_stretch))
    plan.warnings.push_back(warning_of_negative_breaks());
  const double grown = plan.stable.growth * plan.dt * static_cast<double>(plan.steps);
  if (grown > 0.1) {
    plan.warnings.push_back(fmt::format(
        "the unsymmetric boundary (surface nodes, odd or even walls) lets some waves grow by up to "
        "{:.3g} 1/s, exp({:.3g}) over this run; use mirror, antimirror or zero_layer walls, or damping",
        plan.stable.growth, grown));
  }
  return plan;
}

std::vector<std::int64_t> field_steps(const TransientOptions& options, const TransientPlan& plan) {
  std::vector<std::int64_t> steps;
  steps.reserve(options.fields_at.size() + 1);
  for (const double t : options.fields_at)
    steps.push_back(std::clamp<std::int64_t>(std::llround(t / plan.dt), 0, plan.steps));
  if (options.fields_every > 0) {
    for (std::int64_t n = 0; n <= plan.steps; n += options.fields_every) steps.push_back(n);
    steps.push_back(plan.steps);
  }
  if (steps.empty()) steps.push_back(plan.steps);
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

namespace {

/// Peak of a run, bytes.
template <int Dim>
double predicted_memory(const Body<Dim>& body, const TransientOptions& options, double factor_bytes) {
  constexpr double program_bytes = 36e6;  // code, libraries and their work space
  const double dofs = body.boundary.free;
  const double all_dofs = static_cast<double>(body.count()) * Dim;
  const double common = body_bytes(body) + operator_bytes(body, options.form) + program_bytes;
  if (options.method == TimeMethod::modal) {
    ModalOptions modal;
    modal.modes = std::min<int>(options.modes, body.boundary.free);
    const double shapes = sizeof(double) * dofs * *modal.modes;
    return std::max(plan_modes(body, modal).memory_bytes, common + 2.0 * shapes);
  }
  // State, forces and the work of the integrator; the frames and fields that are written.
  const bool explicit_method = options.method == TimeMethod::central_difference;
  double vectors = explicit_method ? 5.0 : 14.0;
  if (needs_bond_forces(options)) vectors += 2.0 + 4.0 / Dim;  // over the padded grid; of particles
  if (may_break(options) && !explicit_method) vectors += 8.0;  // of all particle dofs, and of the solver
  return common + sizeof(double) * (vectors * dofs + 6.0 * all_dofs) + factor_bytes;
}

}  // namespace

template <int Dim>
TransientPlan plan_transient(const Body<Dim>& body, const TransientOptions& options) {
  check_options(body, options);
  (void)place_probes(body, options.probes);
  const Motion motion = make_motion(body, options);
  TransientPlan plan = plan_steps(body, options, motion);
  double factor_bytes = 0.0;
  if (options.method == TimeMethod::newmark || options.method == TimeMethod::hht) {
    ShiftedPlan solver = plan_shifted_solver(body, motion.symmetric, options.solver,
                                             plan.dt / plan.stable.limit, options.tolerance);
    plan.solver = std::move(solver.description);
    factor_bytes = solver.factor_bytes;
  }
  plan.memory_bytes = predicted_memory(body, options, factor_bytes);
  return plan;
}

#define PERIMODE_PLAN(D)                                                                        \
  template std::vector<Index> unbreakable<D>(const Body<D>&, const TransientOptions&);          \
  template void check_options<D>(const Body<D>&, const TransientOptions&);                      \
  template TransientPlan plan_steps<D>(const Body<D>&, const TransientOptions&, const Motion&); \
  template TransientPlan plan_transient<D>(const Body<D>&, const TransientOptions&)
PERIMODE_PLAN(1);
PERIMODE_PLAN(2);
PERIMODE_PLAN(3);
#undef PERIMODE_PLAN

}  // namespace perimode
