// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <vector>

#include "dynamics/given_forces.hpp"
#include "dynamics/transient_plan.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/dynamics/transient.hpp"

namespace perimode {

namespace {

/// Speed of long waves along the axes, m/s: the largest over axes and particles of sqrt(E_a/rho) with
/// E_a = 1/(2 V) sum_b k_b xi_a^4/|xi|^2.
template <int Dim>
double long_wave_speed(const Body<Dim>& body) {
  double square = 0.0;
#pragma omp parallel for schedule(static) reduction(max : square)
  for (Index i = 0; i < body.count(); ++i) {
    Point<Dim> modulus = Point<Dim>::Zero();
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const double k = bond_stiffness(body, i, end);
      modulus += (k / (end.length * end.length) * end.xi.array().pow(4)).matrix();
    });
    const auto p = static_cast<std::size_t>(i);
    const double density = body.density[static_cast<std::size_t>(body.particles.block[p])];
    square = std::max(square, modulus.maxCoeff() / (2.0 * body.particles.volume[p] * density));
  }
  return std::sqrt(square);
}

/// Where a face lies: that of a grid's box, or the extreme particle of a cloud.
template <int Dim>
double plane_of(const Particles<Dim>& particles, const Face& face) {
  if (particles.grid) return (face.upper ? particles.grid->upper() : particles.grid->lower)[face.axis];
  double plane = particles.position.front()[face.axis];
  for (const Point<Dim>& x : particles.position)
    plane = face.upper ? std::max(plane, x[face.axis]) : std::min(plane, x[face.axis]);
  return plane;
}

template <int Dim>
void add_sponge(const Body<Dim>& body, const Sponge& sponge, std::vector<double>& rate) {
  const double full = sponge.rate > 0.0
                          ? sponge.rate
                          : (sponge.power + 1.0) * std::log(1000.0) * long_wave_speed(body) / sponge.width;
  std::vector<double> depth(rate.size(), 0.0);  // a corner counts once, as deep as it lies in any layer
  bool met = false;
  for (const Face& face : sponge.faces) {
    if (face.axis < 0 || face.axis >= Dim) {
      invalid_input({"faces of the body for the sponge", "an axis it does not have",
                     "use the axes of the body", sponge.where});
    }
    const double plane = plane_of(body.particles, face);
    for (std::size_t i = 0; i < rate.size(); ++i) {
      const double inside = sponge.width - std::abs(body.particles.position[i][face.axis] - plane);
      depth[i] = std::max(depth[i], inside / sponge.width);
    }
  }
  for (std::size_t i = 0; i < rate.size(); ++i) {
    if (depth[i] <= 0.0) continue;
    met = true;
    rate[i] += full * std::pow(depth[i], sponge.power);
  }
  if (!met) {
    invalid_input({"a sponge that holds at least one particle", "none",
                   "make its width larger than a spacing", sponge.where});
  }
}

/// Rates of mass-proportional damping per particle, 1/s; empty: none.
template <int Dim>
std::vector<double> damping_rates(const Body<Dim>& body, const TransientOptions& options) {
  if (options.rayleigh_mass == 0.0 && options.damping.empty() && !options.sponge) return {};
  std::vector<double> rate(static_cast<std::size_t>(body.count()), options.rayleigh_mass);
  for (const NodalDamping& damping : options.damping) {
    const std::vector<Index> here = select(damping.at, body.particles);
    if (here.empty()) {
      invalid_input({"a region that holds at least one particle", "none", "move or enlarge the region",
                     damping.at.where.line > 0 ? damping.at.where : damping.where});
    }
    for (const Index i : here) rate[static_cast<std::size_t>(i)] += damping.rate;
  }
  if (options.sponge) add_sponge(body, *options.sponge, rate);
  return rate;
}

/// Loads that vary alike make one term.
template <int Dim>
void add_loads(const Body<Dim>& body, const std::vector<Load>& loads, Motion& motion) {
  std::vector<bool> taken(loads.size(), false);
  for (std::size_t first = 0; first < loads.size(); ++first) {
    if (taken[first]) continue;
    std::vector<Load> alike;
    for (std::size_t k = first; k < loads.size(); ++k) {
      if (!taken[k] && same(loads[k].time, loads[first].time)) {
        alike.push_back(loads[k]);
        taken[k] = true;
      }
    }
    ForceTerm term = free_term(body.boundary, load_vector(body.particles, alike), 1.0);
    term.time = loads[first].time;
    if (!term.dof.empty()) motion.force.push_back(std::move(term));
  }
}

/// Form of K. Stiffness damping of a body that breaks is that of the whole one, which the stencil, reading
/// the alive bits, would forget.
StiffnessForm stored_form(const TransientOptions& options) {
  const bool automatic = options.form == StiffnessForm::automatic;
  const bool reads_bits = automatic || options.form == StiffnessForm::stencil;
  if (reads_bits && needs_bond_forces(options) && options.rayleigh_stiffness > 0.0)
    return StiffnessForm::bonds;
  return options.form;
}

}  // namespace

template <int Dim>
Motion make_motion(const Body<Dim>& body, const TransientOptions& options) {
  Motion motion;
  motion.mass = lumped_mass(body);
  motion.stiffness = stiffness_rows(body, stored_form(options));
  motion.symmetric = asymmetry(as_operator(motion.stiffness)) <= symmetric_to_round_off;
  const std::vector<double> rate = damping_rates(body, options);
  if (!rate.empty()) {
    motion.damping_rate.resize(body.boundary.free);
    for (std::size_t d = 0; d < body.boundary.free_number.size(); ++d) {
      const Index number = body.boundary.free_number[d];
      if (number >= 0) motion.damping_rate[number] = rate[d / Dim];
    }
  }
  motion.stiffness_damping = options.rayleigh_stiffness;
  add_loads(body, options.loads, motion);
  set_given_forces(body, given_shapes(body), motion);
  return motion;
}

template Motion make_motion<1>(const Body<1>&, const TransientOptions&);
template Motion make_motion<2>(const Body<2>&, const TransientOptions&);
template Motion make_motion<3>(const Body<3>&, const TransientOptions&);

}  // namespace perimode
