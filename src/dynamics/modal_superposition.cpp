// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/modal_superposition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/ledger.hpp"
#include "dynamics/saved_state.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

/// Modal states are few, so they are kept in the widest numbers there are: over 1e5 steps nothing adds up.
using Real = long double;
/// Displacement, velocity, force per mass, its rate and the integral of the displacement.
constexpr int states = 5;
using Square = Eigen::Matrix<Real, states, states>;
using Vector = Eigen::Matrix<Real, states, 1>;
enum Component { y_now, v_now, f_now, f_rate, y_area };

/// What one mode does in a step under a force linear in time: z_{n+1} = advance z_n, and the integral of its
/// velocity squared, z_n^T square z_n.
struct ModeStep {
  Square advance;
  Square square;
};

/// exp(L dt) and int_0^dt exp(L^T s) e e^T exp(L s) ds, e the velocity, by Taylor series of a short time and
/// doubling: exact to round-off for rigid, slow, fast, critically and heavily damped modes alike.
/// docs/theory/12_implicit.md
ModeStep mode_step(Real lambda, Real damping, Real dt) {
  Square generator = Square::Zero();
  generator(y_now, v_now) = 1;
  generator(v_now, y_now) = -lambda;
  generator(v_now, v_now) = -damping;
  generator(v_now, f_now) = 1;
  generator(f_now, f_rate) = 1;
  generator(y_area, y_now) = 1;
  const Real turn = dt * std::max({std::sqrt(lambda), damping, std::numeric_limits<Real>::min()});
  const int doublings = std::max(0, 1 + static_cast<int>(std::ceil(std::log2(turn))));
  const Real tau = std::ldexp(dt, -doublings);
  Square term = Square::Identity();
  Square product = Square::Zero();
  product(v_now, v_now) = tau;
  ModeStep step{term, product};
  constexpr int terms = 30;  // (1/2)^30 / 30! is far below any round-off, with room for polynomial growth
  for (int n = 1; n <= terms; ++n) {
    term = (term * generator * (tau / n)).eval();
    step.advance += term;
    product = ((generator.transpose() * product + product * generator) * (tau / (n + 1))).eval();
    step.square += product;
  }
  for (int k = 0; k < doublings; ++k) {
    step.square += (step.advance.transpose() * step.square * step.advance).eval();
    step.advance = (step.advance * step.advance).eval();
  }
  return step;
}

double uniform_rate(const Motion& motion) {
  if (motion.damping_rate.size() == 0) return 0.0;
  const double least = motion.damping_rate.minCoeff(), most = motion.damping_rate.maxCoeff();
  if (most - least > 1e-12 * most) {
    invalid_input({"damping that modes share (Rayleigh's alone) for method: modal",
                   fmt::format("damping rates from {:.6g} to {:.6g} 1/s", least, most),
                   "remove sponges and damped regions, or use newmark or central_difference",
                   {}});
  }
  return most;
}

void check(const Motion& motion, double dt, const Eigen::MatrixXd& modes, const Eigen::VectorXd& lambda) {
  if (!motion.symmetric) {
    invalid_input({"a symmetric body for method: modal",
                   "surface nodes, or odd or even walls",
                   "use central_difference or newmark",
                   {}});
  }
  if (modes.rows() != motion.mass.size() || modes.cols() != lambda.size()) {
    invalid_input(
        {fmt::format("modes of {} dofs with an eigenvalue each", motion.mass.size()),
         fmt::format("{} x {} numbers and {} eigenvalues", modes.rows(), modes.cols(), lambda.size()),
         "solve for the modes of the same body",
         {}});
  }
  if (!(dt > 0.0 && std::isfinite(dt)))
    invalid_input({"a step dt > 0 s", fmt::format("{}", dt), "give a positive step", {}});
}

class ModalSuperposition final : public Integrator {
 public:
  ModalSuperposition(const Motion& motion, double dt, const Eigen::MatrixXd& modes,
                     const Eigen::VectorXd& lambda)
      : motion_(&motion), dt_(dt) {
    set_modes(modes, lambda.cwiseMax(0.0));
  }

  void start(const Eigen::VectorXd& q, const Eigen::VectorXd& v) override {
    step_ = 0;
    const Eigen::VectorXd y = modes_.transpose() * motion_->mass.cwiseProduct(q);
    const Eigen::VectorXd rate = modes_.transpose() * motion_->mass.cwiseProduct(v);
    y_.assign(y.begin(), y.end());
    v_.assign(rate.begin(), rate.end());
    h_ = values_at(motion_->force, 0.0);
    ledger_ = {};
    update_energies();
    ledger_.initial = energies_.kinetic + energies_.strain;
    energies_.initial = ledger_.initial;
    current_ = false;
  }

  void advance(bool with_energies) override {
    const Eigen::VectorXd next = values_at(motion_->force, static_cast<double>(step_ + 1) * dt_);
    const Eigen::VectorXd dh = next - h_;
    const Eigen::Index terms = h_.size();
    // p_k . q before and after, and its integral over the step.
    std::vector<Real> before(terms, 0), after(terms, 0), area(terms, 0);
    CompensatedSum lost;
    for (std::size_t j = 0; j < y_.size(); ++j) {
      Vector z = Vector::Zero();
      z[y_now] = y_[j];
      z[v_now] = v_[j];
      const auto load = load_.col(static_cast<Eigen::Index>(j));
      for (Eigen::Index k = 0; k < terms; ++k) {
        z[f_now] += static_cast<Real>(load[k]) * h_[k];
        z[f_rate] += static_cast<Real>(load[k]) * dh[k] / dt_;
        before[k] += load[k] * y_[j];
      }
      const double damping = damping_[static_cast<Eigen::Index>(j)];
      if (damping > 0.0) lost.add(static_cast<double>(damping * z.dot(step_of_[j].square * z)));
      z = (step_of_[j].advance * z).eval();
      y_[j] = z[y_now];
      v_[j] = z[v_now];
      for (Eigen::Index k = 0; k < terms; ++k) {
        after[k] += load[k] * y_[j];
        area[k] += load[k] * z[y_area];
      }
    }
    ledger_.damping.add(lost.value());
    // int h p . q' dt of loads; of motions int h' g^T K u dt, from the mean of the reaction.
    Eigen::VectorXd mean(terms);
    for (Eigen::Index k = 0; k < terms; ++k) mean[k] = static_cast<double>(area[k] / dt_);
    const Eigen::VectorXd reaction = reactions(*motion_, mean, h_ + 0.5 * dh);
    for (Eigen::Index k = 0; k < terms; ++k) {
      if (motion_->force[static_cast<std::size_t>(k)].motion) {
        ledger_.work.add(dh[k] * reaction[k]);
      } else {
        ledger_.work.add(static_cast<double>(next[k] * after[k] - h_[k] * before[k] - dh[k] * area[k] / dt_));
      }
    }
    h_ = next;
    ++step_;
    current_ = false;
    if (with_energies) update_energies();
  }

  [[nodiscard]] std::int64_t step() const override { return step_; }

  /// Made when it is asked for.
  [[nodiscard]] const Eigen::VectorXd& displacement() const override {
    if (!current_) q_ = modes_ * narrow(y_);
    current_ = true;
    return q_;
  }
  [[nodiscard]] Eigen::VectorXd velocity() const override { return modes_ * narrow(v_); }
  [[nodiscard]] Energies energies() const override { return energies_; }

  [[nodiscard]] IntegratorState save() const override {
    IntegratorState state;
    state.step = step_;
    for (const auto& [name, x] : {std::pair{"y", &y_}, std::pair{"v", &v_}}) {
      const Eigen::VectorXd high = narrow(*x);
      std::vector<Real> low = *x;
      for (std::size_t j = 0; j < low.size(); ++j) low[j] -= high[static_cast<Eigen::Index>(j)];
      perimode::save(name, high, state);
      perimode::save(std::string(name) + "_rest", narrow(low), state);
    }
    perimode::save("h", h_, state);
    perimode::save(ledger_, dt_, state);
    // Modes solved for once more need not be the same to the last bit, nor the same of a repeated frequency.
    perimode::save("lambda", lambda_, state);
    perimode::save("modes", modes_.reshaped(), state);
    return state;
  }

  void restore(const IntegratorState& state) override {
    const Eigen::VectorXd lambda = saved(state, "lambda", modes_.cols());
    const Eigen::VectorXd modes = saved(state, "modes", modes_.size());
    set_modes(modes.reshaped(modes_.rows(), modes_.cols()), lambda);
    for (const auto& [name, x] : {std::pair{"y", &y_}, std::pair{"v", &v_}}) {
      const Eigen::VectorXd high = saved(state, name, modes_.cols());
      const Eigen::VectorXd low = saved(state, std::string(name) + "_rest", modes_.cols());
      x->assign(high.begin(), high.end());
      for (std::size_t j = 0; j < x->size(); ++j) (*x)[j] += low[static_cast<Eigen::Index>(j)];
    }
    h_ = saved(state, "h", load_.rows());
    ledger_ = saved_ledger(state, dt_);
    step_ = state.step;
    current_ = false;
    update_energies();
  }

 private:
  void set_modes(const Eigen::MatrixXd& modes, const Eigen::VectorXd& lambda) {
    modes_ = modes;
    lambda_ = lambda;
    damping_ = (uniform_rate(*motion_) + motion_->stiffness_damping * lambda_.array()).matrix();
    load_.resize(static_cast<Eigen::Index>(motion_->force.size()), modes_.cols());
    step_of_.clear();
    for (Eigen::Index j = 0; j < modes_.cols(); ++j) {
      step_of_.push_back(mode_step(lambda_[j], damping_[j], dt_));
      const Eigen::VectorXd shape = modes_.col(j);
      for (Eigen::Index k = 0; k < load_.rows(); ++k)
        load_(k, j) = dot(motion_->force[static_cast<std::size_t>(k)], shape);
    }
  }

  static Eigen::VectorXd narrow(const std::vector<Real>& x) {
    Eigen::VectorXd out(static_cast<Eigen::Index>(x.size()));
    for (std::size_t j = 0; j < x.size(); ++j) out[static_cast<Eigen::Index>(j)] = static_cast<double>(x[j]);
    return out;
  }

  void update_energies() {
    const Eigen::VectorXd y = narrow(y_);
    const double kinetic = 0.5 * narrow(v_).squaredNorm();
    const double strain = 0.5 * y.cwiseAbs2().dot(lambda_) + given_energy(*motion_, load_ * y, h_);
    energies_ = ledger_.with(kinetic, strain);
  }

  const Motion* motion_;
  double dt_;
  Eigen::MatrixXd modes_;
  Eigen::VectorXd lambda_, damping_;
  Eigen::MatrixXd load_;  ///< p_k . phi_j
  std::vector<ModeStep> step_of_;
  std::int64_t step_ = 0;
  std::vector<Real> y_, v_;
  Eigen::VectorXd h_;
  Ledger ledger_;
  Energies energies_;
  mutable Eigen::VectorXd q_;
  mutable bool current_ = false;
};

double left_out(double carried, double whole) {
  return whole > 0.0 ? std::clamp(1.0 - carried / whole, 0.0, 1.0) : 0.0;
}

}  // namespace

std::unique_ptr<Integrator> modal_superposition(const Motion& motion, double dt, const Eigen::MatrixXd& modes,
                                                const Eigen::VectorXd& lambda) {
  check(motion, dt, modes, lambda);
  return std::make_unique<ModalSuperposition>(motion, dt, modes, lambda);
}

Truncation truncation(const Motion& motion, const Eigen::MatrixXd& modes, const Eigen::VectorXd& lambda,
                      const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  Truncation result;
  const Eigen::VectorXd y = modes.transpose() * motion.mass.cwiseProduct(q);
  const Eigen::VectorXd rate = modes.transpose() * motion.mass.cwiseProduct(v);
  const double whole = v.dot(motion.mass.cwiseProduct(v)) + q.dot(multiply(as_operator(motion.stiffness), q));
  result.initial_energy = left_out(rate.squaredNorm() + y.cwiseAbs2().dot(lambda.cwiseMax(0.0)), whole);
  for (const ForceTerm& term : motion.force) {
    Eigen::VectorXd p = Eigen::VectorXd::Zero(motion.mass.size());
    add(term, 1.0, p);
    const double carried = (modes.transpose() * p).squaredNorm();
    result.load = std::max(result.load, left_out(carried, p.cwiseAbs2().dot(motion.mass.cwiseInverse())));
  }
  return result;
}

}  // namespace perimode
