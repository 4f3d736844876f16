// SPDX-License-Identifier: BSD-3-Clause
#include "statics/problem.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/bonds/connectivity.hpp"
#include "perimode/modal/rigid.hpp"

namespace perimode {

namespace {

/// |r . f| / (|r| |f|) at or below this is equilibrium.
constexpr double equilibrium = 1e-9;

/// "translation along y", "rotation", with the piece that moves where there are several.
template <int Dim>
std::string motion_name(const Body<Dim>& body, const Eigen::VectorXd& mode) {
  const double size = mode.cwiseAbs().maxCoeff();
  const Pieces pieces = find_pieces(body.bonds, body.count());
  Index moving = -1;
  Point<Dim> low = Point<Dim>::Constant(size);
  Point<Dim> high = Point<Dim>::Constant(-size);
  for (int pass = 0; pass < 2; ++pass) {  // find the piece, then its range of every component
    for (Index i = 0; i < body.count(); ++i) {
      for (int a = 0; a < Dim; ++a) {
        const Index d = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
        if (d < 0) continue;
        if (pass == 0 && moving < 0 && std::abs(mode[d]) > 0.5 * size) moving = i;
        if (pass == 0 || pieces.of[i] != pieces.of[moving]) continue;
        low[a] = std::min(low[a], mode[d]);
        high[a] = std::max(high[a], mode[d]);
      }
    }
  }
  std::string text = "translation along";
  for (int a = 0; a < Dim; ++a) {
    if (high[a] - low[a] > 1e-6 * size) text = "rotation";
  }
  for (int a = 0; a < Dim && text != "rotation"; ++a) {
    if (std::abs(high[a]) > 1e-6 * size && high[a] >= low[a]) text += fmt::format(" {}", "xyz"[a]);
  }
  if (pieces.count > 1) {
    const Point<Dim>& x = body.particles.position[moving];
    text += " of the piece at (";
    for (int a = 0; a < Dim; ++a) text += fmt::format("{}{:.6g}", a == 0 ? "" : ", ", x[a]);
    text += ")";
  }
  return text;
}

}  // namespace

template <int Dim>
Eigen::VectorXd free_part(const Body<Dim>& body, const Eigen::VectorXd& all) {
  Eigen::VectorXd part(body.boundary.free);
  for (Eigen::Index d = 0; d < all.size(); ++d) {
    const Index number = body.boundary.free_number[static_cast<std::size_t>(d)];
    if (number >= 0) part[number] = all[d];
  }
  return part;
}

template <int Dim>
void check_equilibrium(const Body<Dim>& body, const Eigen::MatrixXd& rigid, const Eigen::VectorXd& rhs) {
  std::string free;
  int count = 0;
  for (Eigen::Index k = 0; k < rigid.cols(); ++k) {
    const auto mode = rigid.col(k);
    if (std::abs(mode.dot(rhs)) <= equilibrium * mode.norm() * rhs.norm()) continue;
    if (++count > 3) break;
    free += (count > 1 ? ", " : "") + motion_name<Dim>(body, mode);
  }
  if (count == 0) return;
  invalid_input(
      {"supports that hold the body against its loads, or loads in equilibrium",
       fmt::format("a free {}{}", free, count > 3 ? ", ..." : ""),
       "fix or prescribe what stops that motion, for example boundary: [ { fix: [x], at: { face: x-, "
       "layers: 1 } } ], or balance the loads",
       {}});
}

template <int Dim>
StaticProblem pose_problem(const Body<Dim>& body, const StaticOptions& options) {
  StaticProblem p;
  p.load = load_vector(body.particles, options.loads);
  const auto& given = body.boundary.given;
  const auto moved = [](const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
  };
  if (p.load.isZero(0.0) && !moved(given) && !moved(body.boundary.value)) {
    invalid_input({"something that loads or moves the body",
                   "none",
                   "give analysis.static.loads, or a prescribed displacement in boundary",
                   {}});
  }
  if (body.boundary.free == 0) return p;
  p.stiffness = stiffness_operator(body);
  p.bound = stiffness_bound(body);
  p.asymmetry = asymmetry(p.stiffness);
  const Eigen::VectorXd held =
      internal_force(body, Eigen::Map<const Eigen::VectorXd>(given.data(), p.load.size()));
  const Eigen::VectorXd free_load = free_part(body, p.load);
  const Eigen::VectorXd free_held = free_part(body, held);
  p.rhs = free_load - free_held;
  p.scale = std::max(free_load.norm(), free_held.norm());
  p.mass = lumped_mass(body);
  p.rigid = rigid_modes(body, p.stiffness, p.mass);
  if (p.symmetric()) {
    check_equilibrium(body, p.rigid, p.rhs);
  } else if (p.rigid.cols() > 0) {
    invalid_input({"supports that hold the body, where walls make its equations unsymmetric",
                   "a free " + motion_name<Dim>(body, p.rigid.col(0)),
                   "fix or prescribe what stops it",
                   {}});
  }
  return p;
}

template <int Dim>
FactorDofs factor_dofs(const Body<Dim>& body, const Eigen::MatrixXd& rigid) {
  std::vector<bool> held(static_cast<std::size_t>(body.boundary.free), false);
  if (rigid.cols() > 0) {
    // The dofs in which the rigid motions differ most, one per motion.
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivots(rigid.transpose());
    for (Eigen::Index k = 0; k < rigid.cols(); ++k)
      held[static_cast<std::size_t>(pivots.colsPermutation().indices()[k])] = true;
  }
  FactorDofs dofs;
  dofs.number.assign(body.boundary.free_number.size(), -1);
  for (std::size_t d = 0; d < dofs.number.size(); ++d) {
    const Index number = body.boundary.free_number[d];
    if (number < 0 || held[static_cast<std::size_t>(number)]) continue;
    dofs.number[d] = static_cast<Index>(dofs.free.size());
    dofs.free.push_back(number);
    dofs.particle.push_back(static_cast<Index>(d / Dim));
  }
  return dofs;
}

#define PERIMODE_PROBLEM(D)                                                                           \
  template void check_equilibrium<D>(const Body<D>&, const Eigen::MatrixXd&, const Eigen::VectorXd&); \
  template Eigen::VectorXd free_part<D>(const Body<D>&, const Eigen::VectorXd&);                      \
  template StaticProblem pose_problem<D>(const Body<D>&, const StaticOptions&);                       \
  template FactorDofs factor_dofs<D>(const Body<D>&, const Eigen::MatrixXd&)
PERIMODE_PROBLEM(1);
PERIMODE_PROBLEM(2);
PERIMODE_PROBLEM(3);
#undef PERIMODE_PROBLEM

}  // namespace perimode
