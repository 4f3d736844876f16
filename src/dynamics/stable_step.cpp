// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/stable_step.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <vector>

#include "dynamics/instability.hpp"
#include "linalg/arnoldi.hpp"
#include "linalg/fused.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

constexpr double accuracy = 1e-4;    ///< of omega_max, relative
constexpr double negative = -1e-10;  ///< eigenvalues below that of the largest are instabilities
constexpr double imaginary = 1e-8;   ///< complex ones beyond that of the largest let motion grow
constexpr int most_products = 600;   ///< of Lanczos
constexpr double round_off = 1e-12;  ///< by which every value is raised at least

/// y = M^-1/2 K M^-1/2 x
class Scaled {
 public:
  Scaled(const LinearOperator& stiffness, const Eigen::VectorXd& mass)
      : stiffness_(&stiffness), weight_(mass.cwiseSqrt().cwiseInverse()), x_(mass.size()), y_(mass.size()) {}

  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& x) {
    x_ = weight_.cwiseProduct(x);
    stiffness_->apply(x_.data(), y_.data());
    ++products_;
    return weight_.cwiseProduct(y_);
  }
  /// Of a vector it acts on, the displacement.
  [[nodiscard]] Eigen::VectorXd displacement(const Eigen::VectorXd& x) const {
    return weight_.cwiseProduct(x);
  }
  [[nodiscard]] int products() const { return products_; }
  [[nodiscard]] Index size() const { return stiffness_->size; }

 private:
  const LinearOperator* stiffness_;
  Eigen::VectorXd weight_, x_, y_;
  int products_ = 0;
};

[[noreturn]] void no_number() {
  throw Error(ErrorKind::solver_failure, "the product with K is no number: a bond without a real stiffness?");
}

Eigen::VectorXd random_vector(Index n) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); }).normalized();
}

/// An end of the spectrum as far as it is known.
struct End {
  double value = 0.0;
  double error = 0.0;  ///< there is an eigenvalue within
};

/// Lanczos with three vectors and no reorthogonalisation: the ends of the spectrum are met all the same, and
/// a residual means what it says [paige1980]. The eigenvector comes from a second run.
class Lanczos {
 public:
  explicit Lanczos(Scaled& a) : a_(&a) { restart(); }

  /// One step; false where the space is exhausted.
  bool step() {
    Eigen::VectorXd next = (*a_)(now_);
    const Index n = a_->size();
    const double alpha = dot(n, now_.data(), next.data());
    next -= alpha * now_;
    if (!beta_.empty()) next -= beta_.back() * before_;
    if (!std::isfinite(alpha)) no_number();
    alpha_.push_back(alpha);
    beta_.push_back(std::sqrt(dot(n, next.data(), next.data())));
    largest_ = std::max({largest_, std::abs(alpha), beta_.back()});
    if (beta_.back() <= 1e-10 * largest_) return false;
    before_.swap(now_);
    now_ = next / beta_.back();
    return true;
  }

  [[nodiscard]] int steps() const { return static_cast<int>(alpha_.size()); }

  /// Ritz values at both ends.
  void look(End& lowest, End& highest) {
    const auto k = static_cast<Eigen::Index>(alpha_.size());
    const Eigen::Map<const Eigen::VectorXd> diagonal(alpha_.data(), k), beside(beta_.data(), k - 1);
    small_.computeFromTridiagonal(diagonal, beside);
    const auto end = [&](Eigen::Index j) {
      return End{small_.eigenvalues()[j], beta_.back() * std::abs(small_.eigenvectors()(k - 1, j))};
    };
    lowest = end(0);
    highest = end(k - 1);
  }

  /// The lowest Ritz vector of the last look; costs as many products again.
  [[nodiscard]] Eigen::VectorXd lowest_vector() {
    const Eigen::VectorXd share = small_.eigenvectors().col(0);
    restart();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(a_->size());
    for (Eigen::Index k = 0; k < share.size(); ++k) {
      x += share[k] * now_;
      if (!step()) break;
    }
    return x;
  }

 private:
  void restart() {
    alpha_.clear();
    beta_.clear();
    now_ = random_vector(a_->size());
    before_.setZero(a_->size());
  }

  Scaled* a_;
  Eigen::VectorXd before_, now_;
  std::vector<double> alpha_, beta_;
  double largest_ = 0.0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small_;
};

constexpr Index few = 400;  ///< dofs up to which all eigenvalues are found

Eigen::MatrixXd dense(Scaled& a) {
  const Index n = a.size();
  Eigen::MatrixXd whole(n, n);
  for (Index j = 0; j < n; ++j) whole.col(j) = a(Eigen::VectorXd::Unit(n, j));
  if (!whole.allFinite()) no_number();
  return whole;
}

/// Largest eigenvalue: of few dofs as it is, else raised by its error. Where bonds soften the iteration goes
/// on until the lowest one is known to be negative or not, or for most_products.
template <int Dim>
double symmetric_top(const Body<Dim>& body, Scaled& a) {
  if (a.size() <= few) {
    const Eigen::MatrixXd whole = dense(a);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> all(0.5 * (whole + whole.transpose()));
    const double least = all.eigenvalues()[0], most = all.eigenvalues()[a.size() - 1];
    if (softening(body) && least < negative * std::max(std::abs(least), std::abs(most)))
      refuse_instability(body, a.displacement(all.eigenvectors().col(0)), {least, 0.0});
    return std::max(most, 0.0);
  }
  Lanczos lanczos(a);
  End lowest, highest;
  const bool look_below = softening(body);
  // A look costs the cube of the steps, so looks become rare as they grow dear.
  int next_look = 16;
  for (bool more = true; more;) {
    more = lanczos.step();
    if (more && lanczos.steps() < next_look) continue;
    next_look += 8 + next_look / 8;
    lanczos.look(lowest, highest);
    const double scale = std::max(std::abs(lowest.value), std::abs(highest.value));
    const bool top_known = highest.error <= accuracy * scale;
    const bool unstable = lowest.value < negative * scale;
    const bool bottom_known = !look_below || lowest.error <= 1e-3 * std::abs(lowest.value);
    if (top_known && bottom_known) more = false;
    if (next_look > most_products) more = false;
    if (!more && look_below && unstable)
      refuse_instability(body, a.displacement(lanczos.lowest_vector()), {lowest.value, 0.0});
  }
  return std::max(highest.value + highest.error, 0.0);
}

/// Largest |Im sqrt(lambda)| of the eigenvalues that are complex beyond round-off.
double growth_of(const Eigen::VectorXcd& lambda, double top) {
  double growth = 0.0;
  for (const std::complex<double>& l : lambda) {
    if (std::abs(l.imag()) > imaginary * top) growth = std::max(growth, std::abs(std::sqrt(l).imag()));
  }
  return growth;
}

/// The same for unsymmetric K: all eigenvalues of small bodies, else those of largest magnitude and, where
/// bonds soften, those farthest from the largest.
template <int Dim>
double unsymmetric_top(const Body<Dim>& body, Scaled& a, double& growth) {
  const Index n = a.size();
  Eigen::VectorXcd value;
  Eigen::MatrixXcd vector;
  double error = 0.0;
  if (n <= few) {
    const Eigen::EigenSolver<Eigen::MatrixXd> all(dense(a));
    value = all.eigenvalues();
    vector = all.eigenvectors();
  } else {
    // The highest waves of a long body differ little, and are told apart no further than it takes.
    ArnoldiPairs pairs;
    for (double tolerance = 1e-6; pairs.theta.size() == 0 && tolerance < 0.1; tolerance *= 10.0) {
      constexpr int restarts = 30;
      pairs = arnoldi([&](const Eigen::VectorXd& x) { return a(x); }, n, 4, tolerance, 1,
                      ArnoldiTarget::magnitude, restarts);
    }
    if (pairs.theta.size() == 0)
      throw Error(ErrorKind::solver_failure, "Arnoldi did not find the largest eigenvalue of the body");
    value = pairs.theta;
    vector = pairs.vector;
    const Eigen::VectorXd re = vector.col(0).real(), im = vector.col(0).imag();
    Eigen::VectorXcd residual(n);
    residual.real() = a(re) - value[0].real() * re + value[0].imag() * im;
    residual.imag() = a(im) - value[0].real() * im - value[0].imag() * re;
    // Eigenvalues of these bodies are a few times as sensitive as those of symmetric ones.
    error = 10.0 * residual.norm();
    // Real spectra hold nothing for this search to converge to, so it is a short one.
    constexpr int few_restarts = 20;
    const ArnoldiPairs aside = arnoldi([&](const Eigen::VectorXd& x) { return a(x); }, n, 2, 1e-4, 1,
                                       ArnoldiTarget::imaginary_part, few_restarts);
    growth = growth_of(aside.theta, std::abs(value[0]));
    if (softening(body)) {
      const double top = std::abs(value[0]);
      pairs =
          arnoldi([&](const Eigen::VectorXd& x) { return Eigen::VectorXd(top * x - a(x)); }, n, 2, 1e-6, 1);
      const Eigen::Index before = value.size();
      value.conservativeResize(before + pairs.theta.size());
      value.tail(pairs.theta.size()) = top - pairs.theta.array();
      vector.conservativeResize(n, value.size());
      vector.rightCols(pairs.theta.size()) = pairs.vector;
    }
  }
  const double top = value.cwiseAbs().maxCoeff();
  Eigen::Index worst = 0;
  double badness = 0.0;
  growth = std::max(growth, growth_of(value, top));
  for (Eigen::Index j = 0; j < value.size(); ++j) {
    const double bad = value[j].real() / (negative * top);
    if (bad <= badness) continue;
    badness = bad;
    worst = j;
  }
  if (badness > 1.0) refuse_instability(body, a.displacement(vector.col(worst).real()), value[worst]);
  return top + error;
}

/// min_i 2 m_i / sum_b |k_b| over particles with a free component, s^2.
template <int Dim>
double sufficient_square(const Body<Dim>& body, const Eigen::VectorXd& mass) {
  double least = std::numeric_limits<double>::infinity();
#pragma omp parallel for schedule(static) reduction(min : least)
  for (Index i = 0; i < body.count(); ++i) {
    double m = 0.0;
    for (int a = 0; a < Dim; ++a) {
      const Index number = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
      if (number >= 0) m = mass[number];
    }
    if (m == 0.0) continue;
    double sum = 0.0;
    for_each_bond(body.bonds, i, Which::alive,
                  [&](const BondEnd<Dim>& end) { sum += std::abs(bond_stiffness(body, i, end)); });
    if (sum > 0.0) least = std::min(least, 2.0 * m / sum);
  }
  return least;
}

}  // namespace

template <int Dim>
StableStep stable_step(const Body<Dim>& body, const LinearOperator& stiffness, const Eigen::VectorXd& mass,
                       bool symmetric, double stiffness_damping) {
  StableStep step;
  step.symmetric = symmetric;
  step.bound = std::sqrt(sufficient_square(body, mass));
  double top = 0.0;
  if (mass.size() > 0) {
    Scaled a(stiffness, mass);
    top = (symmetric ? symmetric_top(body, a) : unsymmetric_top(body, a, step.growth)) * (1.0 + round_off);
    step.products = a.products();
  }
  step.omega_max = std::sqrt(top);
  // sqrt(b^2 + s) - b without its cancellation; infinite for a body without stiffness.
  const double s = 4.0 / top, b = stiffness_damping;
  step.limit = top > 0.0 ? s / (std::sqrt(b * b + s) + b) : std::numeric_limits<double>::infinity();
  return step;
}

#define PERIMODE_STABLE_STEP(D)                                                                           \
  template StableStep stable_step<D>(const Body<D>&, const LinearOperator&, const Eigen::VectorXd&, bool, \
                                     double)
PERIMODE_STABLE_STEP(1);
PERIMODE_STABLE_STEP(2);
PERIMODE_STABLE_STEP(3);
#undef PERIMODE_STABLE_STEP

}  // namespace perimode
