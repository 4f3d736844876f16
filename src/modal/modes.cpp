// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/modal/modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/stopwatch.hpp"
#include "given_factor.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/multigrid.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/modal/rigid.hpp"

namespace perimode {

namespace {

double to_eigenvalue(double hz) { return std::pow(2.0 * std::numbers::pi * hz, 2); }

/// The order of the first elastic eigenvalue, (c/L)^2: the largest is about (4 c/delta)^2, so scaling it by
/// (delta/(4 L))^2 needs no material data.
template <int Dim>
double eigenvalue_scale(const Body<Dim>& body, double largest) {
  const double length = std::max(1.0, horizons_long(body));
  return largest > 0.0 ? largest * std::pow(1.0 / (4.0 * length), 2) : 1.0;
}

/// Small beside the first elastic eigenvalue, large beside round-off of K.
double shift_below(double scale) { return -1e-2 * scale; }

struct Problem {
  LinearOperator action;
  double bound = 0.0;                      ///< no |eigenvalue| of K lies above, N/m
  Csr assembled;                           ///< for the engines that need it
  const Csr* stiffness = nullptr;          ///< where there is a matrix
  const CholeskyFactor* factor = nullptr;  ///< of K - shift M, at hand
  std::optional<Multigrid> multigrid;      ///< for the engine inverse on grids
  Eigen::VectorXd mass;
  std::vector<Index> particle;
  Eigen::MatrixXd position;  ///< Dim x particles
};

/// Modes merged from deflated rigid motions and what the solver returned.
struct Pairs {
  std::vector<double> value;
  std::vector<Eigen::VectorXd> vector;
  std::vector<ModeKind> kind;
};

/// Elastic pairs besides `rigid` deflated motions; `largest` bounds the spectrum.
EigenResult solve_symmetric(const EigenProblem& problem, EigenOptions wanted, const ModalOptions& options,
                            Eigen::Index rigid, double largest, const Sink& sink) {
  const Eigen::Index elastic = problem.mass->size() - rigid;
  if (!options.shift) return solve_eigen(problem, wanted, sink);
  // The nearest in Hz lie within the eigenvalues nearest to the shift up to the distance that set covers
  // upward.
  const double f0 = *options.shift;
  if (wanted.shift >= largest) {  // beyond the spectrum the order by eigenvalue is that by frequency
    wanted.shift = largest;
    return solve_eigen(problem, wanted, sink);
  }
  for (Eigen::Index count = wanted.count;; count *= 2) {
    wanted.count = static_cast<int>(std::min(count, elastic));
    EigenResult r = solve_eigen(problem, wanted, sink);
    if (r.value.size() < wanted.count || wanted.count == elastic) return r;
    const double radius = (r.value.array() - wanted.shift).abs().maxCoeff();
    const double covered = std::sqrt(wanted.shift + radius) / (2.0 * std::numbers::pi) - f0;
    const auto inside =
        (r.value.array().max(0.0).sqrt() / (2.0 * std::numbers::pi) - f0).abs() <= covered * (1.0 + 1e-12);
    if (inside.count() >= std::min<Eigen::Index>(*options.modes, elastic)) return r;
  }
}

EigenOptions eigen_options(const ModalOptions& options, Eigen::Index rigid, Eigen::Index dofs, double scale) {
  EigenOptions wanted;
  const auto asked = static_cast<Eigen::Index>(options.modes.value_or(20));
  wanted.engine = options.solver;
  wanted.check = options.certificate;
  wanted.block_size = options.block_size;
  wanted.scale = scale;
  if (options.range) {
    wanted.has_range = true;
    wanted.lower = to_eigenvalue(options.range->first);
    wanted.upper = to_eigenvalue(options.range->second);
  } else if (options.shift) {
    wanted.has_shift = true;
    wanted.shift = to_eigenvalue(*options.shift);
    wanted.count = static_cast<int>(std::min(asked, dofs - rigid));
  } else {
    wanted.count = static_cast<int>(std::clamp<Eigen::Index>(asked - rigid, 0, dofs - rigid));
  }
  return wanted;
}

void sort_and_trim(Pairs& pairs, const ModalOptions& options) {
  std::vector<std::size_t> order(pairs.value.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  const auto keep = static_cast<std::size_t>(options.modes.value_or(20));
  if (options.shift && order.size() > keep) {
    const auto distance = [&](std::size_t k) {
      return std::abs(std::sqrt(std::max(pairs.value[k], 0.0)) / (2.0 * std::numbers::pi) - *options.shift);
    };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
    order.resize(keep);
  }
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
    const bool rigid_a = pairs.kind[a] == ModeKind::rigid;
    const bool rigid_b = pairs.kind[b] == ModeKind::rigid;
    return rigid_a != rigid_b ? rigid_a : pairs.value[a] < pairs.value[b];
  });
  if (!options.range && order.size() > keep) order.resize(keep);
  Pairs sorted;
  for (std::size_t k : order) {
    sorted.value.push_back(pairs.value[k]);
    sorted.vector.push_back(std::move(pairs.vector[k]));
    sorted.kind.push_back(pairs.kind[k]);
  }
  pairs = std::move(sorted);
}

/// The stated sign: the first among the largest components is positive.
void fix_sign(Eigen::Ref<Eigen::VectorXd> x) {
  const double top = x.cwiseAbs().maxCoeff();
  for (Eigen::Index d = 0; d < x.size(); ++d) {
    if (std::abs(x[d]) < top * (1.0 - 1e-6)) continue;
    if (x[d] < 0.0) x = -x;
    return;
  }
}

template <int Dim>
Eigen::MatrixXd translations(const Body<Dim>& body) {
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(body.boundary.free, Dim);
  for (std::size_t d = 0; d < body.boundary.free_number.size(); ++d) {
    const Index number = body.boundary.free_number[d];
    if (number >= 0) r(number, static_cast<int>(d % Dim)) = 1.0;
  }
  return r;
}

/// Displacements of all particle dofs in each mode: the free ones move, the others stay.
template <int Dim>
Eigen::MatrixXd motions_of(const Body<Dim>& body, const Eigen::MatrixXd& modes) {
  const auto& number = body.boundary.free_number;
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(number.size()), modes.cols());
  for (std::size_t d = 0; d < number.size(); ++d) {
    if (number[d] >= 0) u.row(static_cast<Eigen::Index>(d)) = modes.row(number[d]);
  }
  return u;
}

/// Energies of motions (dofs x modes) if every particle moved among neighbours at rest: what the energy of a
/// mechanism is round-off of, wherever it moves.
template <int Dim>
Eigen::VectorXd energy_apart(const Body<Dim>& body, const Eigen::MatrixXd& motion) {
  const std::vector<double> blocks = absolute_blocks(body);
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(motion.cols());
  for (Index i = 0; i < body.count(); ++i) {
    using Block = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;
    const Eigen::Map<const Block> block(blocks.data() + static_cast<std::size_t>(i) * Dim * Dim);
    const auto u = motion.middleRows<Dim>(static_cast<Eigen::Index>(i) * Dim);
    energy += 0.5 * u.cwiseProduct(block * u).colwise().sum().transpose();
  }
  return energy;
}

template <int Dim>
void finish(ModalResult& result, const Body<Dim>& body, const Problem& problem, Pairs&& pairs) {
  const auto modes = static_cast<Eigen::Index>(pairs.value.size());
  result.kind = pairs.kind;
  result.eigenvalue = Eigen::Map<Eigen::VectorXd>(pairs.value.data(), modes);
  result.shape.resize(problem.mass.size(), modes);
  for (Eigen::Index k = 0; k < modes; ++k) {
    result.shape.col(k) = pairs.vector[k];
    pairs.vector[k] = {};
    if (result.left.cols() == 0) fix_sign(result.shape.col(k));
  }
  result.unstable = static_cast<int>((result.eigenvalue.array() < 0.0).count());
  result.angular_frequency = result.eigenvalue.array().max(0.0).sqrt();
  result.frequency_hz = result.angular_frequency / (2.0 * std::numbers::pi);
  result.rigid_modes = static_cast<int>(std::count(result.kind.begin(), result.kind.end(), ModeKind::rigid)) -
                       result.mechanisms;

  const Eigen::MatrixXd kx = multiply(problem.action, result.shape);
  const double k_norm = problem.bound;
  const Eigen::MatrixXd mr = problem.mass.asDiagonal() * translations(body);
  const Eigen::MatrixXd right = result.shape.transpose() * mr;
  result.effective_mass = result.left.cols() == 0
                              ? Eigen::MatrixXd(right.array().square())
                              : Eigen::MatrixXd(right.array() * (result.left.transpose() * mr).array());
  result.residual.resize(modes);
  for (Eigen::Index k = 0; k < modes; ++k) {
    const Eigen::VectorXd mx = problem.mass.cwiseProduct(result.shape.col(k));
    result.residual[k] =
        result.kind[k] == ModeKind::rigid
            ? kx.col(k).norm() / (k_norm * result.shape.col(k).norm())
            : (kx.col(k) - result.eigenvalue[k] * mx).norm() / (std::abs(result.eigenvalue[k]) * mx.norm());
  }
}

void warn_of_unstable(const ModalResult& result, const Sink& sink) {
  if (result.unstable == 0) return;
  sink.warn(fmt::format(
      "{} mode{} of negative eigenvalue, the lowest {:.6g} (rad/s)^2: the body is unstable, and {} growing "
      "motion{} stand{} with frequency 0; bonds of negative stiffness need a periodic body or whole families",
      result.unstable, result.unstable == 1 ? "" : "s", result.eigenvalue.minCoeff(),
      result.unstable == 1 ? "a" : "these", result.unstable == 1 ? "" : "s",
      result.unstable == 1 ? "s" : ""));
}

template <int Dim>
void solve_symmetric_body(ModalResult& result, const Body<Dim>& body, const Problem& problem,
                          const ModalOptions& options, double scale, const Sink& sink) {
  sink.report("rigid modes");
  const Eigen::MatrixXd rigid = rigid_modes(body, problem.action, problem.mass);
  EigenOptions wanted = eigen_options(options, rigid.cols(), problem.mass.size(), scale);
  wanted.negative_shift = shift_below(scale);
  wanted.engine = result.choice.engine;
  wanted.edge = result.choice.edge;
  wanted.top = result.largest;
  const EigenProblem eigen{.stiffness = problem.stiffness,
                           .mass = &problem.mass,
                           .node_of_dof = problem.particle,
                           .known = rigid.cols() > 0 ? &rigid : nullptr,
                           .position = problem.position.size() > 0 ? &problem.position : nullptr,
                           .action = &problem.action,
                           .preconditioner = problem.multigrid ? &problem.multigrid->preconditioner : nullptr,
                           .factor = problem.factor};

  Pairs pairs;
  const bool want_rigid = !options.range || options.range->first <= 0.0;
  for (Eigen::Index k = 0; want_rigid && k < rigid.cols(); ++k) {
    pairs.value.push_back(0.0);
    pairs.vector.emplace_back(rigid.col(k));
    pairs.kind.push_back(ModeKind::rigid);
  }
  if (wanted.count == 0 && !wanted.has_range) {
    result.status = EigenStatus::converged;
    result.solver = "rigid motions";
    result.certificate = {true, true, "all rigid motions", static_cast<Offset>(rigid.cols()), 0.0, 0.0, 0};
  } else {
    EigenResult r = solve_symmetric(eigen, wanted, options, rigid.cols(), result.largest, sink);
    result.status = r.status;
    result.message = r.message;
    result.solver = r.engine;
    result.certificate = r.certificate;
    result.shift = r.shift;
    result.solves = r.solves;
    result.products = r.products;
    result.factor_nonzeros = r.factor_nonzeros;
    result.seconds_analyse = r.seconds_analyse;
    result.seconds_factor = r.seconds_factor;
    result.seconds_iterate = r.seconds_iterate;
    const Eigen::MatrixXd motion = motions_of(body, r.vector);
    const Eigen::VectorXd energy = bond_energy(body, motion);
    const Eigen::VectorXd apart = energy_apart(body, motion);
    const bool negative_bonds = softening(body);
    for (Eigen::Index k = 0; k < r.value.size(); ++k) {
      const Eigen::VectorXd x = r.vector.col(k);
      const double norm2 = x.dot(problem.mass.cwiseProduct(x));
      const double value = 2.0 * energy[k] / norm2;
      const double round_off = 1e-14 * apart[k];
      const bool zero = energy[k] <= round_off && (!negative_bonds || energy[k] >= -round_off);
      if (zero) ++result.mechanisms;
      pairs.value.push_back(zero ? 0.0 : value);
      pairs.vector.emplace_back(x / std::sqrt(norm2));
      pairs.kind.push_back(zero ? ModeKind::rigid : ModeKind::elastic);
    }
  }
  sort_and_trim(pairs, options);
  finish(result, body, problem, std::move(pairs));
  warn_of_unstable(result, sink);
  if (result.mechanisms > 0) {
    sink.warn(fmt::format(
        "{} zero-energy mode{} that {} no rigid motion: the bonds do not hold the body together (a "
        "horizon below 2 spacings, a particle or strip on too few bonds)",
        result.mechanisms, result.mechanisms == 1 ? "" : "s", result.mechanisms == 1 ? "is" : "are"));
  }
}

template <int Dim>
void solve_unsymmetric_body(ModalResult& result, const Body<Dim>& body, const Problem& problem,
                            const ModalOptions& options, double scale, const Sink& sink) {
  EigenOptions wanted = eigen_options(options, 0, problem.mass.size(), scale);
  const EigenProblem eigen{problem.stiffness, &problem.mass, problem.particle, nullptr};
  UnsymmetricEigenResult r = solve_unsymmetric(eigen, wanted, sink);
  result.status = r.status;
  result.message = r.message;
  result.solver = r.engine;
  result.certificate = r.certificate;
  result.solves = r.solves;
  result.imaginary = r.imaginary;
  result.largest = r.largest;
  result.seconds_factor = r.seconds_factor;
  result.seconds_iterate = r.seconds_iterate;
  if (r.imaginary > 1e-8) {
    result.status = EigenStatus::not_converged;
    result.message =
        fmt::format("eigenvalues are not real: max |Im lambda| / max |lambda| = {:.2e}", r.imaginary);
  }
  Pairs pairs;
  std::vector<Eigen::VectorXd> left;
  for (Eigen::Index k = 0; k < r.value.size(); ++k) {
    // A real eigenvalue's vectors are real up to a complex factor; turn the largest component real.
    Eigen::Index top = 0;
    r.right.col(k).cwiseAbs().maxCoeff(&top);
    const std::complex<double> turn = std::abs(r.right(top, k)) / r.right(top, k);
    Eigen::VectorXd x = (r.right.col(k) * turn).real();
    x /= std::sqrt(x.dot(problem.mass.cwiseProduct(x)));
    Eigen::Index top_left = 0;
    r.left.col(k).cwiseAbs().maxCoeff(&top_left);
    Eigen::VectorXd y = (r.left.col(k) * (std::abs(r.left(top_left, k)) / r.left(top_left, k))).real();
    y /= y.dot(problem.mass.cwiseProduct(x));
    const double value = r.value[k].real();
    const bool zero = std::abs(value) <= 1e-12 * r.largest;
    pairs.value.push_back(zero ? 0.0 : value);
    pairs.vector.push_back(std::move(x));
    pairs.kind.push_back(zero ? ModeKind::rigid : ModeKind::elastic);
    left.push_back(std::move(y));
  }
  result.left.resize(problem.mass.size(), static_cast<Eigen::Index>(left.size()));
  for (std::size_t k = 0; k < left.size(); ++k) result.left.col(static_cast<Eigen::Index>(k)) = left[k];
  finish(result, body, problem, std::move(pairs));
  if (softening(body)) warn_of_unstable(result, sink);
}

}  // namespace

void check_request(Index dofs, const ModalOptions& options) {
  if (dofs == 0) {
    invalid_input({"at least one free degree of freedom", "none", "fix fewer particles or components", {}});
  }
  if (options.modes && (*options.modes < 1 || *options.modes > dofs)) {
    invalid_input({fmt::format("modes between 1 and the body's {} degrees of freedom", dofs),
                   fmt::format("{}", *options.modes),
                   "ask for fewer modes",
                   {}});
  }
}

template <int Dim>
ModalResult solve_modes(const Body<Dim>& body, const ModalOptions& options, const Sink& sink) {
  const Index dofs = body.boundary.free;
  check_request(dofs, options);
  ModalOptions wanted = options;
  if (!wanted.modes && !wanted.range) wanted.modes = std::min<Index>(20, dofs);

  ModalResult result;
  const auto start = Clock::now();
  sink.report("assembling");
  Problem problem;
  problem.mass = lumped_mass(body);
  problem.action = stiffness_operator(body);
  problem.bound = stiffness_bound(body);
  result.largest = problem.bound / problem.mass.minCoeff();
  if (!std::isfinite(result.largest)) {
    invalid_input({"stiffnesses and masses within the range of floating-point numbers",
                   fmt::format("a largest eigenvalue of {}", result.largest),
                   "check the material and the units",
                   {}});
  }
  result.asymmetry = asymmetry(problem.action);
  const bool symmetric = result.asymmetry <= symmetric_to_round_off;
  result.choice = choose_solver(modal_size(body, symmetric), result.largest, wanted);
  if (needs_matrix(result.choice.engine)) {
    problem.assembled = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
    problem.stiffness = &problem.assembled;
    problem.particle = particle_of_free_dof(body);
    problem.position = particle_positions(body);
    problem.action = as_operator(problem.assembled);
    problem.bound = norm_inf(problem.assembled);
    result.nonzeros = problem.assembled.nonzeros();
    result.asymmetry = asymmetry(problem.assembled);
  } else if (result.choice.engine == EigenEngine::inverse) {
    if (std::holds_alternative<GridBonds<Dim>>(body.bonds))
      problem.multigrid = multigrid(body, problem.action);
  }
  result.seconds_assemble = seconds_since(start);
  const double scale = eigenvalue_scale(body, result.largest);

  if (symmetric) {
    solve_symmetric_body(result, body, problem, wanted, scale, sink);
  } else {
    solve_unsymmetric_body(result, body, problem, wanted, scale, sink);
  }
  return result;
}

template <int Dim>
double lowest_modes_shift(const Body<Dim>& body, const Eigen::VectorXd& mass) {
  return shift_below(eigenvalue_scale(body, stiffness_bound(body) / mass.minCoeff()));
}

template <int Dim>
ModalResult solve_modes_by(const Body<Dim>& body, const ModalOptions& options, const GivenFactor& given,
                           const Eigen::VectorXd& mass, const Sink& sink) {
  Problem problem;
  problem.action = given.action;
  problem.bound = stiffness_bound(body);
  problem.stiffness = given.stiffness;
  problem.factor = given.factor;
  problem.mass = mass;
  ModalResult result;
  result.largest = problem.bound / mass.minCoeff();
  result.choice.engine = EigenEngine::lanczos;
  solve_symmetric_body(result, body, problem, options, given.shift / shift_below(1.0), sink);
  return result;
}

Eigen::MatrixXd modal_assurance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                const Eigen::VectorXd& mass) {
  const Eigen::MatrixXd cross = a.transpose() * mass.asDiagonal() * b;
  const Eigen::VectorXd na = (a.array().square().matrix().transpose() * mass);
  const Eigen::VectorXd nb = (b.array().square().matrix().transpose() * mass);
  return cross.array().square() / (na * nb.transpose()).array();
}

#define PERIMODE_MODES(D)                                                                         \
  template ModalResult solve_modes<D>(const Body<D>&, const ModalOptions&, const Sink&);          \
  template double lowest_modes_shift<D>(const Body<D>&, const Eigen::VectorXd&);                  \
  template ModalResult solve_modes_by<D>(const Body<D>&, const ModalOptions&, const GivenFactor&, \
                                         const Eigen::VectorXd&, const Sink&)
PERIMODE_MODES(1);
PERIMODE_MODES(2);
PERIMODE_MODES(3);
#undef PERIMODE_MODES

}  // namespace perimode
