// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/bond_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bond_evaluation.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

/// s0 as the measure of a bond over |xi|^2 (bond_kernels.hpp).
double critical_measure(double s0, bool turning) { return turning ? s0 * (2.0 + s0) : s0; }

template <int Dim>
std::vector<double> critical_measures(const Body<Dim>& body, const std::vector<double>& critical_stretch,
                                      bool turning) {
  const std::size_t blocks = body.density.size();
  if (critical_stretch.empty()) return std::vector<double>(blocks, std::numeric_limits<double>::infinity());
  if (critical_stretch.size() != blocks) {
    invalid_input({fmt::format("{} critical stretches, one per block", blocks),
                   fmt::format("{}", critical_stretch.size()),
                   "give one for every block, infinity where bonds do not break",
                   {}});
  }
  std::vector<double> measure;
  for (const double s0 : critical_stretch) {
    if (!(s0 > 0.0))
      invalid_input({"critical stretches > 0", fmt::format("{}", s0), "leave it out: unbreakable", {}});
    measure.push_back(critical_measure(s0, turning));
  }
  return measure;
}

template <int Dim>
BondEnd<Dim> end_at(const GridBonds<Dim>& bonds, Index i, Offset slot) {
  const auto k = static_cast<std::size_t>(slot);
  const Family<Dim>& f = bonds.family;
  BondEnd<Dim> end{
      bonds.occupant[bonds.home[i] + bonds.step[k]], {}, f.length[k], f.weight[k], f.horizon, slot};
  for (int a = 0; a < Dim; ++a) end.xi[a] = f.spacing * f.offset[k][a];
  return end;
}
template <int Dim>
BondEnd<Dim> end_at(const CloudBonds<Dim>& bonds, Index, Offset slot) {
  const auto e = static_cast<std::size_t>(slot);
  return {bonds.neighbour[e], bonds.xi[e], bonds.xi[e].norm(), bonds.weight[e], bonds.horizon[e], slot};
}

}  // namespace

template <int Dim>
struct BondForces<Dim>::Implementation {
  /// A given dof, or component of a ghost, that varies in time.
  struct Moving {
    std::size_t at;
    double full;
    int time;
  };

  Body<Dim>* body;
  bool turning;
  GivenMotion<Dim> given;
  std::unique_ptr<BondEvaluation<Dim>> evaluation;
  std::vector<Moving> dofs, ghosts;
  std::vector<double> moving_displacement, moving_force;
  std::vector<OverStretched> last;  ///< broken in the last evaluation
  bool with_energy = false;
  Offset broken = 0;
  double energy = 0.0;
  RowProduct product;

  Implementation(Body<Dim>& of, Kinematics kinematics, const std::vector<double>& critical_stretch,
                 const std::vector<Index>& no_fail)
      : body(&of), turning(kinematics == Kinematics::large_rotation) {
    const BoundaryMap<Dim>& map = of.boundary;
    given.dof = map.given;
    given.ghost = map.value;
    for (std::size_t d = 0; d < map.given_time.size(); ++d) {
      if (map.free_number[d] < 0 && map.given_time[d] != 0)
        dofs.push_back({d, map.given[d], map.given_time[d]});
    }
    for (std::size_t v = 0; v < map.value.size() && !map.value_time.empty(); ++v) {
      if (map.value_time[v / Dim] != 0) ghosts.push_back({v, map.value[v], map.value_time[v / Dim]});
    }
    for (const Moving& m : dofs) given.moving.push_back(m.at);
    moving_displacement.resize(dofs.size());
    moving_force.resize(dofs.size());
    const auto measure = critical_measures(of, critical_stretch, turning);
    evaluation = std::holds_alternative<GridBonds<Dim>>(of.bonds)
                     ? make_grid_evaluation(of, turning, measure, no_fail)
                     : make_cloud_evaluation(of, turning, measure, no_fail);
    set_time(0.0);
    product = {map.free, evaluation->pieces(), true,
               [this](const double* q, const auto& take) { apply(q, take); }};
  }

  void set_time(double t) {
    if (dofs.empty() && ghosts.empty()) return;
    std::vector<double> factor;
    factor.reserve(body->boundary.time.size());
    for (const TimeFunction& h : body->boundary.time) factor.push_back(value_at(h, t));
    for (std::size_t m = 0; m < dofs.size(); ++m)
      moving_displacement[m] = given.dof[dofs[m].at] = dofs[m].full * factor[dofs[m].time];
    for (const Moving& m : ghosts) given.ghost[m.at] = m.full * factor[m.time];
  }

  void apply(const double* q, const std::function<void(const RowPiece&)>& take) {
    last.clear();
    const BondRequest request{&take, moving_force.data(), with_energy};
    for (const OverStretched& bond : evaluation->forces(given, q, request)) break_one(bond);
  }

  void break_one(const OverStretched& bond) {
    std::visit(
        [&](const auto& bonds) {
          if (!is_alive(bonds, bond.particle, bond.slot)) return;  // its other end came first
          const BondEnd<Dim> end = end_at(bonds, bond.particle, bond.slot);
          energy += energy_of(bond.particle, end, evaluation->relative(bond.particle, end));
          ++broken;
          last.push_back(bond);
          break_bond(body->bonds, bond.particle, bond.slot);
        },
        body->bonds);
  }

  /// Energy of a bond of particle i, J.
  [[nodiscard]] double energy_of(Index i, const BondEnd<Dim>& end, const Point<Dim>& eta) const {
    double extension = end.xi.dot(eta) / end.length;
    if (turning) {
      const Point<Dim> y = end.xi + eta;
      extension = eta.dot(end.xi + y) / (y.norm() + end.length);
    }
    double share = 1.0;
    if (end.neighbour >= body->count()) share = ghost_share(body->boundary, end.neighbour - body->count());
    return 0.5 * share * bond_stiffness(*body, i, end) * (extension * extension);
  }

  /// Displacement of a particle or ghost at q.
  [[nodiscard]] Point<Dim> displacement(const double* q, Index partner) const {
    const BoundaryMap<Dim>& map = body->boundary;
    const auto value = [&](Index particle, int a) {
      const std::size_t d = static_cast<std::size_t>(particle) * Dim + static_cast<std::size_t>(a);
      return map.free_number[d] >= 0 ? q[map.free_number[d]] : given.dof[d];
    };
    const bool ghost = partner >= body->count();
    const auto g = static_cast<std::size_t>(ghost ? partner - body->count() : 0);
    Point<Dim> u;
    for (int a = 0; a < Dim; ++a) {
      u[a] = ghost ? followed(map, g, a, value) + given.ghost[g * Dim + static_cast<std::size_t>(a)]
                   : value(partner, a);
    }
    return u;
  }

  [[nodiscard]] double last_energy(const double* q) const {
    double sum = 0.0;
    for (const OverStretched& bond : last) {
      std::visit(
          [&](const auto& bonds) {
            const BondEnd<Dim> end = end_at(bonds, bond.particle, bond.slot);
            sum += energy_of(bond.particle, end,
                             displacement(q, end.neighbour) - displacement(q, bond.particle));
          },
          body->bonds);
    }
    return sum;
  }
};

template <int Dim>
BondForces<Dim>::BondForces(Body<Dim>& body, Kinematics kinematics, std::vector<double> critical_stretch,
                            const std::vector<Index>& no_fail)
    : implementation_(std::make_unique<Implementation>(body, kinematics, critical_stretch, no_fail)) {}

template <int Dim>
BondForces<Dim>::~BondForces() = default;
template <int Dim>
BondForces<Dim>::BondForces(BondForces&&) noexcept = default;
template <int Dim>
BondForces<Dim>& BondForces<Dim>::operator=(BondForces&&) noexcept = default;

template <int Dim>
const RowProduct& BondForces<Dim>::product() const {
  return implementation_->product;
}

template <int Dim>
void BondForces<Dim>::set_time(double t) {
  implementation_->set_time(t);
}

template <int Dim>
const std::vector<double>& BondForces<Dim>::moving_displacement() const {
  return implementation_->moving_displacement;
}

template <int Dim>
const std::vector<double>& BondForces<Dim>::moving_force() const {
  return implementation_->moving_force;
}

template <int Dim>
Offset BondForces<Dim>::broken() const {
  return implementation_->broken;
}

template <int Dim>
double BondForces<Dim>::broken_energy() const {
  return implementation_->energy;
}

template <int Dim>
double BondForces<Dim>::last_broken_energy(const double* q) const {
  return implementation_->last_energy(q);
}

template <int Dim>
void BondForces<Dim>::follow_energy(bool wanted) {
  implementation_->with_energy = wanted;
}

template <int Dim>
double BondForces<Dim>::last_strain_energy() const {
  return implementation_->evaluation->energy();
}

template <int Dim>
typename BondForces<Dim>::State BondForces<Dim>::save() const {
  return {std::visit([](const auto& bonds) { return bonds.alive; }, implementation_->body->bonds),
          implementation_->broken, implementation_->energy};
}

template <int Dim>
void BondForces<Dim>::restore(const State& state) {
  std::visit(
      [&](auto& bonds) {
        if (state.alive.size() != bonds.alive.size()) {
          invalid_input({fmt::format("{} words of alive bits", bonds.alive.size()),
                         fmt::format("{}", state.alive.size()),
                         "use a state of the same body",
                         {}});
        }
        bonds.alive = state.alive;
      },
      implementation_->body->bonds);
  implementation_->broken = state.broken;
  implementation_->energy = state.energy;
}

template class BondForces<1>;
template class BondForces<2>;
template class BondForces<3>;

}  // namespace perimode
