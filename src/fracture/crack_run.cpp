// SPDX-License-Identifier: BSD-3-Clause
#include "fracture/crack_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/stopwatch.hpp"
#include "perimode/bonds/bonds.hpp"
#include "perimode/core/error.hpp"
#include "perimode/fracture/crack_area.hpp"

namespace perimode {

namespace {

template <int Dim>
Eigen::VectorXd all_dofs(const Body<Dim>& body, const Eigen::Ref<const Eigen::VectorXd>& q,
                         const Eigen::VectorXd& given) {
  const auto& number = body.boundary.free_number;
  Eigen::VectorXd u(given.size());
  for (Eigen::Index d = 0; d < u.size(); ++d) {
    const Index n = number[static_cast<std::size_t>(d)];
    u[d] = n < 0 ? given[d] : q[n];
  }
  return u;
}

}  // namespace

void not_held() {
  invalid_input(
      {"supports and bonds that hold the body against its loads",
       "a piece that moves under them without stretching a bond",
       "fix or prescribe what stops that motion, use a longer horizon, or end the pre-cracks earlier",
       {}});
}

template <int Dim>
CrackRun<Dim>::CrackRun(Body<Dim>& body, const QuasistaticOptions& options,
                        const QuasistaticObserver<Dim>& observer, const Sink& sink,
                        QuasistaticProblem problem, bool matrix_free, const IntegratorState* resume)
    : body_(&body),
      options_(&options),
      observer_(&observer),
      sink_(&sink),
      problem_(std::move(problem)),
      search_(body),
      removed_(static_cast<std::size_t>(body.count()), 0) {
  std::vector<std::uint8_t> moves(static_cast<std::size_t>(body.count()), 0), near = moves;
  for (const Driving& part : problem_.parts) {
    for (Eigen::Index d = 0; d < part.given.size(); ++d)
      if (part.given[d] != 0.0) moves[static_cast<std::size_t>(d / Dim)] = 1;
  }
  for (Index i = 0; i < body.count(); ++i) {
    if (moves[i] == 0) continue;
    moving_.push_back(i);
    near[i] = 1;
    for_each_bond(body.bonds, i, Which::alive,
                  [&](const BondEnd<Dim>& end) { near[owner(body.bonds, end.neighbour, body.count())] = 1; });
  }
  for (Index i = 0; i < body.count(); ++i) {
    if (near[i] != 0) beside_.push_back(i);
  }
  std::vector<double> springs = intact_springs(body);
  std::vector<Index> pins = pivot_dofs(problem_.rigid);
  if (resume != nullptr) {
    restore(*resume);
    pins.clear();
    for (const double dof : resume->numbers.at("pins")) pins.push_back(static_cast<Index>(dof));
  }
  equilibrium_ =
      std::make_unique<Equilibrium<Dim>>(body, options.solver, matrix_free, std::move(springs), pins);
}

/// (K u) of particle i.
template <int Dim>
Point<Dim> CrackRun<Dim>::force_on(Index i, const Eigen::VectorXd& displacement) const {
  const Point<Dim> here = displacement.segment<Dim>(static_cast<Eigen::Index>(i) * Dim);
  Point<Dim> sum = Point<Dim>::Zero();
  for_each_bond(body_->bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
    const Point<Dim> n = end.xi / end.length;
    const Point<Dim> there =
        partner_displacement(body_->boundary, displacement.data(), end.neighbour, body_->count(), false);
    sum += bond_stiffness(*body_, i, end) * n.dot(here - there) * n;
  });
  return sum;
}

/// R f - R K g
template <int Dim>
Eigen::VectorXd CrackRun<Dim>::right_side(const Driving& driving) const {
  const auto& number = body_->boundary.free_number;
  Eigen::VectorXd b(body_->boundary.free);
  for (Eigen::Index d = 0; d < driving.load.size(); ++d) {
    const Index n = number[static_cast<std::size_t>(d)];
    if (n >= 0) b[n] = removed_[static_cast<std::size_t>(d / Dim)] != 0 ? 0.0 : driving.load[d];
  }
  if (driving.given.isZero(0.0)) return b;
  for (const Index i : beside_) {
    const Point<Dim> held = force_on(i, driving.given);
    for (int a = 0; a < Dim; ++a) {
      const Index n = number[static_cast<std::size_t>(i) * Dim + a];
      if (n >= 0) b[n] -= held[a];
    }
  }
  return b;
}

template <int Dim>
bool CrackRun<Dim>::solve(const std::vector<Driving>& drivings, std::vector<Eigen::VectorXd>& displacement) {
  const auto columns = static_cast<Eigen::Index>(drivings.size());
  const Index free = body_->boundary.free;
  if (q_.rows() != free || q_.cols() != columns) q_ = Eigen::MatrixXd::Zero(free, columns);
  SolveOutcome outcome;
  Eigen::MatrixXd b(free, columns);
  for (std::size_t tried = 0; tried < 100; ++tried) {
    for (Eigen::Index c = 0; c < columns; ++c) b.col(c) = right_side(drivings[static_cast<std::size_t>(c)]);
    outcome = equilibrium_->solve(b, q_);
    // Iterations that come nowhere near may have met a mechanism as well.
    if (!outcome.singular && (outcome.converged || outcome.residual <= hopeless_residual)) break;
    const std::size_t before = equilibrium_->pins().size();
    pin_mechanism(outcome.dof);
    q_.setZero();
    if (equilibrium_->pins().size() == before) break;  // no mechanism
  }
  result_.worst_residual = std::max(result_.worst_residual, outcome.residual);
  // Where round-off holds iterations up short of their tolerance, that is all there is to be had.
  constexpr double good = 1e-9;
  const bool solved = outcome.converged || outcome.residual <= good;
  if (outcome.singular || !solved || !q_.allFinite()) {
    result_.message =
        outcome.singular
            ? "the bonds left do not hold the body's shape, and no motion was found to hold"
            : fmt::format("a solution left the residual {:.1e}: {}", outcome.residual, outcome.message);
    return false;
  }
  displacement.clear();
  spring_share_ = 0.0;
  for (Eigen::Index c = 0; c < columns; ++c) {
    const Driving& driving = drivings[static_cast<std::size_t>(c)];
    double held = 0.0;
    for (const Pin& pin : equilibrium_->pins()) held += std::abs(pin.stiffness * q_(pin.dof, c));
    const double whole = driving.load.template lpNorm<1>();
    if (whole > 0.0) spring_share_ = std::max(spring_share_, held / whole);
    Eigen::VectorXd q = q_.col(c);
    if (problem_.rigid.cols() > 0)
      q -= problem_.rigid * (problem_.rigid.transpose() * problem_.mass.cwiseProduct(q));
    displacement.push_back(all_dofs(*body_, q, driving.given));
  }
  return true;
}

template <int Dim>
void CrackRun<Dim>::reach(const Eigen::VectorXd& displacement, const Driving& driving, double stored,
                          const std::vector<double>& factors) {
  EquilibriumState state;
  state.displacement = displacement;
  state.external = Eigen::VectorXd::Zero(displacement.size());
  state.stored = stored;
  const auto& number = body_->boundary.free_number;
  for (Eigen::Index d = 0; d < displacement.size(); ++d) {
    const Index n = number[static_cast<std::size_t>(d)];
    if (n < 0 || removed_[static_cast<std::size_t>(d / Dim)] != 0) continue;
    state.external[d] = driving.load[d];
  }
  double reaction = 0.0;
  for (const Index i : moving_) {
    const Point<Dim> internal = force_on(i, displacement);
    for (int a = 0; a < Dim; ++a) {
      const Eigen::Index d = static_cast<Eigen::Index>(i) * Dim + a;
      if (number[static_cast<std::size_t>(d)] >= 0) continue;
      state.external[d] = internal[a];
      if (problem_.motion_driven) reaction += internal[a] * problem_.direction[d];
    }
  }
  const Eigen::VectorXd& along = problem_.motion_driven ? driving.given : displacement;
  state.along = problem_.direction.dot(along);
  state.force = problem_.motion_driven ? reaction : problem_.direction.dot(driving.load);
  // Springs pull back on what they hold.
  if (!equilibrium_->pins().empty()) {
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(body_->boundary.free);
    for (const Pin& pin : equilibrium_->pins()) {
      for (std::size_t c = 0; c < factors.size(); ++c)
        pull[pin.dof] -= factors[c] * pin.stiffness * q_(pin.dof, static_cast<Eigen::Index>(c));
    }
    for (std::size_t d = 0; d < number.size(); ++d)
      if (number[d] >= 0) state.external[static_cast<Eigen::Index>(d)] += pull[number[d]];
  }
  ledger_.reach(std::move(state), bond_states<Dim>(*body_, left_, displacement));
  left_.clear();
}

/// Takes bonds out of everything, with their energies at the state reached.
template <int Dim>
void CrackRun<Dim>::clear_bonds(const std::vector<BondRef>& bonds) {
  const Eigen::VectorXd& u = ledger_.state().displacement;
  const Eigen::VectorXd at =
      u.size() > 0 ? u : Eigen::VectorXd::Zero(static_cast<Eigen::Index>(body_->count()) * Dim);
  const std::vector<BondState> states = bond_states<Dim>(*body_, bonds, at);
  broken_area_ += crack_area(*body_, options_->area, std::span<const BondRef>(bonds));
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const BondEnd<Dim> end = bond_end(*body_, bonds[b]);
    BrokenBond<Dim> broken;
    broken.event = label_;
    broken.first = bonds[b].particle;
    broken.second = owner(body_->bonds, end.neighbour, body_->count());
    broken.middle = body_->particles.position[bonds[b].particle] + 0.5 * end.xi;
    broken.energy = 0.5 * states[b].share * states[b].stiffness * states[b].elongation * states[b].elongation;
    unreported_.push_back(broken);
  }
  ledger_.leave(states);
  left_.insert(left_.end(), bonds.begin(), bonds.end());
  result_.broken_bonds += static_cast<Offset>(bonds.size());
  equilibrium_->break_bonds(bonds);
}

template <int Dim>
void CrackRun<Dim>::break_bonds(const std::vector<BondRef>& bonds) {
  struct Ends {
    Index first, second;
  };
  std::vector<Ends> ends;
  ends.reserve(bonds.size());
  for (const BondRef& bond : bonds) {
    ends.push_back({bond.particle, owner(body_->bonds, bond_end(*body_, bond).neighbour, body_->count())});
  }
  clear_bonds(bonds);
  for (const Ends& e : ends) {
    for (const Index i : {e.first, e.second}) {
      const std::vector<Index> dofs = LooseSearch<Dim>::unheld_dofs(*body_, *equilibrium_, i);
      if (!dofs.empty()) hold_or_remove({i}, dofs, held_by_nothing(i));
    }
    const std::vector<Index> side = search_.cut_off(*body_, e.first, e.second);
    if (side.empty() || (side.size() == 1 && held(side[0]))) continue;
    for (const LooseMotion& loose : loose_motions(*body_, *equilibrium_, problem_.mass))
      hold_or_remove(loose.particles, loose.dofs, true);
  }
}

template <int Dim>
bool CrackRun<Dim>::held_by_nothing(Index i) const {
  bool none = true;
  for_each_bond(body_->bonds, i, Which::alive, [&](const BondEnd<Dim>&) { none = false; });
  return none;
}

/// Whether springs hold all components of particle i.
template <int Dim>
bool CrackRun<Dim>::held(Index i) const {
  for (int a = 0; a < Dim; ++a) {
    const Index n = body_->boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
    if (n < 0 || !equilibrium_->pinned(n)) return false;
  }
  return true;
}

template <int Dim>
void CrackRun<Dim>::hold_or_remove(const std::vector<Index>& piece, const std::vector<Index>& dofs,
                                   bool apart) {
  LoosePiece loose;
  loose.event = label_;
  loose.particles = static_cast<Index>(piece.size());
  Point<Dim> centre = Point<Dim>::Zero();
  double carried = 0.0, whole = 0.0;
  for (const Driving& part : problem_.parts) whole += part.load.template lpNorm<1>();
  for (const Index i : piece) {
    centre += body_->particles.position[i] / static_cast<double>(piece.size());
    for (const Driving& part : problem_.parts)
      carried += part.load.template segment<Dim>(static_cast<Eigen::Index>(i) * Dim).template lpNorm<1>();
  }
  loose.centre.assign(centre.data(), centre.data() + Dim);
  loose.loaded = carried > 0.0;
  // A piece whose loads matter is not dropped where that is to end the run.
  const bool ends = options_->stop.separated && carried > separating_share * whole;
  if (options_->loose == LoosePieces::hold || ends || !apart) {
    equilibrium_->pin(dofs);
  } else {
    std::vector<Index> all;
    for (const Index i : piece) {
      removed_[i] = 1;
      for (int a = 0; a < Dim; ++a) {
        const Index n = body_->boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
        if (n >= 0) all.push_back(n);
      }
    }
    equilibrium_->pin(all);
  }
  result_.loose.push_back(loose);
  if (observer_->loose) observer_->loose(loose);
}

/// A motion that stretches no bond, found where a pivot vanished (a factor) or not at all (iterations).
template <int Dim>
void CrackRun<Dim>::pin_mechanism(Index dof) {
  if (dof < 0) {
    const std::vector<LooseMotion> rigid = loose_motions(*body_, *equilibrium_, problem_.mass);
    for (const LooseMotion& loose : rigid) hold_or_remove(loose.particles, loose.dofs, true);
    if (!rigid.empty()) return;
    dof = equilibrium_->mechanism_dof();
    if (dof < 0) return;
  }
  if (equilibrium_->pinned(dof)) return;
  equilibrium_->pin({dof});
  // With a spring at one of its dofs only, K + P moves along the motion alone when pushed there.
  Eigen::MatrixXd push = Eigen::MatrixXd::Zero(body_->boundary.free, 1), motion = push;
  push(dof, 0) = equilibrium_->spring(dof);
  if (equilibrium_->solve(push, motion).singular) return;
  const double size = motion.cwiseAbs().maxCoeff();
  std::vector<Index> piece;
  for (Index i = 0; i < body_->count(); ++i) {
    bool moves = false;
    for (int a = 0; a < Dim; ++a) {
      const Index n = body_->boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
      moves = moves || (n >= 0 && std::abs(motion(n, 0)) > 1e-3 * size);
    }
    if (moves) piece.push_back(i);
  }
  hold_or_remove(piece, {}, false);
}

#define PERIMODE_CRACK_RUN(D)                                                                            \
  template CrackRun<D>::CrackRun(Body<D>&, const QuasistaticOptions&, const QuasistaticObserver<D>&,     \
                                 const Sink&, QuasistaticProblem, bool, const IntegratorState*);         \
  template Point<D> CrackRun<D>::force_on(Index, const Eigen::VectorXd&) const;                          \
  template Eigen::VectorXd CrackRun<D>::right_side(const Driving&) const;                                \
  template bool CrackRun<D>::solve(const std::vector<Driving>&, std::vector<Eigen::VectorXd>&);          \
  template void CrackRun<D>::reach(const Eigen::VectorXd&, const Driving&, double,                       \
                                   const std::vector<double>&);                                          \
  template void CrackRun<D>::clear_bonds(const std::vector<BondRef>&);                                   \
  template void CrackRun<D>::break_bonds(const std::vector<BondRef>&);                                   \
  template bool CrackRun<D>::held(Index) const;                                                          \
  template bool CrackRun<D>::held_by_nothing(Index) const;                                               \
  template void CrackRun<D>::hold_or_remove(const std::vector<Index>&, const std::vector<Index>&, bool); \
  template void CrackRun<D>::pin_mechanism(Index)
PERIMODE_CRACK_RUN(1);
PERIMODE_CRACK_RUN(2);
PERIMODE_CRACK_RUN(3);
#undef PERIMODE_CRACK_RUN

}  // namespace perimode
