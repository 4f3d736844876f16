// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/newmark.hpp"

#include <fmt/format.h>

#include <cmath>

#include "dynamics/ledger.hpp"
#include "dynamics/saved_state.hpp"
#include "linalg/fused.hpp"
#include "perimode/core/error.hpp"
#include "perimode/dynamics/step_breaking.hpp"

namespace perimode {

namespace {

NewmarkOptions checked(NewmarkOptions o) {
  if (!(o.alpha >= -1.0 / 3.0 && o.alpha <= 0.0)) {
    invalid_input({"alpha of HHT in [-1/3, 0]",
                   fmt::format("{}", o.alpha),
                   "use for example -0.05; 0 is Newmark's method",
                   {}});
  }
  if (o.alpha != 0.0) {
    o.beta = 0.25 * (1.0 - o.alpha) * (1.0 - o.alpha);
    o.gamma = 0.5 - o.alpha;
  }
  if (!(o.beta > 0.0 && std::isfinite(o.beta))) {
    invalid_input({"beta > 0", fmt::format("{}", o.beta), "use 0.25, or method: central_difference", {}});
  }
  if (!(o.gamma >= 0.5 && std::isfinite(o.gamma))) {
    invalid_input({"gamma >= 1/2, below which all motion grows",
                   fmt::format("{}", o.gamma),
                   "use 0.5, or more for algorithmic damping",
                   {}});
  }
  return o;
}

/// Notation of docs/theory/12_implicit.md: z' = (1 + alpha) z_{n+1} - alpha z_n, M a_{n+1} + C v' + K q' =
/// F', w = q + stiffness_damping v.
class Newmark final : public Integrator {
 public:
  Newmark(const Motion& motion, double dt, const NewmarkOptions& options, const ShiftedSolver& solver,
          StepBreaking* breaking)
      : motion_(&motion),
        breaking_(breaking),
        dt_(dt),
        o_(checked(options)),
        n_(static_cast<Index>(motion.mass.size())),
        stiffness_(as_operator(motion.stiffness)) {
    if (!(dt > 0.0 && std::isfinite(dt))) {
      invalid_input({"a step dt > 0 s", fmt::format("{}", dt), "give a positive step", {}});
    }
    reach_ = (1.0 + o_.alpha) * dt * (o_.beta * dt + o_.gamma * motion.stiffness_damping);
    Eigen::VectorXd shift = motion.mass / reach_;
    if (rate_of(motion) != nullptr)
      shift.array() *= 1.0 + (1.0 + o_.alpha) * o_.gamma * dt * motion.damping_rate.array();
    solve_ = solver(shift);
    for (Eigen::VectorXd* work : {&x_, &product_, &rhs_, &guess_}) work->setZero(n_);
  }

  void start(const Eigen::VectorXd& q, const Eigen::VectorXd& v) override {
    step_ = 0;
    q_ = q;
    v_ = v;
    dq_ = dv_ = Eigen::VectorXd::Zero(n_);
    h_ = values_at(motion_->force, 0.0);
    dh_ = Eigen::VectorXd::Zero(h_.size());
    broken_ = {};
    if (breaking_ != nullptr && breaking_->break_beyond(q_, h_)) {
      broken_.add(0.5 * breaking_->stiffness().dot(breaking_->elongation(q_, h_).cwiseAbs2()));
      breaking_->settle();
    }
    a_ = -multiply(stiffness_, Eigen::VectorXd(q + motion_->stiffness_damping * v));
    add_forces(h_, a_);
    a_.array() /= motion_->mass.array();
    if (rate_of(*motion_) != nullptr) a_.array() -= motion_->damping_rate.array() * v.array();
    ledger_ = {};
    update_energies();
    ledger_.initial = energies_.kinetic + energies_.strain + energies_.broken;
    energies_.initial = ledger_.initial;
  }

  void advance(bool with_energies) override {
    const Eigen::VectorXd next = values_at(motion_->force, static_cast<double>(step_ + 1) * dt_);
    const Eigen::VectorXd dh = next - h_;
    solve_step(next, dh, false);
    if (breaking_ != nullptr) {
      while (breaking_->break_beyond(end_of_step(), next)) solve_step(next, dh, true);
      release(dh);
      breaking_->settle();
    }
    correct(dh);
    h_ = next;
    dh_ = dh;
    ++step_;
    if (with_energies) update_energies();
  }

  [[nodiscard]] std::int64_t step() const override { return step_; }
  [[nodiscard]] const Eigen::VectorXd& displacement() const override { return q_; }
  [[nodiscard]] Eigen::VectorXd velocity() const override { return v_; }
  [[nodiscard]] Energies energies() const override { return energies_; }
  [[nodiscard]] std::int64_t broken_bonds() const override {
    return breaking_ == nullptr ? 0 : breaking_->broken();
  }

  [[nodiscard]] IntegratorState save() const override {
    IntegratorState state;
    state.step = step_;
    perimode::save("q", q_, state);
    perimode::save("v", v_, state);
    perimode::save("a", a_, state);
    perimode::save("dq", dq_, state);
    perimode::save("dv", dv_, state);
    perimode::save("h", h_, state);
    perimode::save("dh", dh_, state);
    perimode::save(ledger_, dt_, state);
    if (breaking_ != nullptr) {
      breaking_->save(state);
      state.numbers["broken energy"] = {broken_.sum, broken_.lost};
    }
    return state;
  }

  void restore(const IntegratorState& state) override {
    q_ = saved(state, "q", n_);
    v_ = saved(state, "v", n_);
    a_ = saved(state, "a", n_);
    dq_ = saved(state, "dq", n_);
    dv_ = saved(state, "dv", n_);
    const auto terms = static_cast<Eigen::Index>(motion_->force.size());
    h_ = saved(state, "h", terms);
    dh_ = saved(state, "dh", terms);
    ledger_ = saved_ledger(state, dt_);
    if (breaking_ != nullptr) {
      const std::vector<double>& broken = saved_numbers(state, "broken energy", 2);
      breaking_->restore(state);
      broken_ = {broken[0], broken[1]};
    }
    step_ = state.step;
    update_energies();
  }

 private:
  [[nodiscard]] static const double* rate_of(const Motion& motion) {
    return motion.damping_rate.size() > 0 ? motion.damping_rate.data() : nullptr;
  }

  void add_forces(const Eigen::VectorXd& h, Eigen::VectorXd& x) const {
    for (Eigen::Index k = 0; k < h.size(); ++k) add(motion_->force[static_cast<std::size_t>(k)], h[k], x);
  }

  /// p_k . x of every term.
  [[nodiscard]] Eigen::VectorXd projections(const Eigen::VectorXd& x) const {
    Eigen::VectorXd p(h_.size());
    for (Eigen::Index k = 0; k < p.size(); ++k) p[k] = dot(motion_->force[static_cast<std::size_t>(k)], x);
    return p;
  }

  /// x^T K x
  double stiffness_square(const Eigen::VectorXd& x) {
    stiffness_.apply(x.data(), product_.data());
    return perimode::dot(n_, x.data(), product_.data());
  }

  [[nodiscard]] double q_part(Index i) const { return q_[i] + dt_ * (v_[i] + dt_ * (0.5 - o_.beta) * a_[i]); }
  [[nodiscard]] double v_part(Index i) const { return v_[i] + dt_ * (1.0 - o_.gamma) * a_[i]; }

  /// x = w' and rhs = -C v' without the acceleration at the end of the step; rhs without its stiffness part.
  /// The guess is the acceleration at its start, or the solution that was found before (`again`).
  void predict(bool again) {
    const double* rate = rate_of(*motion_);
    const double b = motion_->stiffness_damping;
    for_each_chunk(n_, [&](Index first, Index count) {
      for (Index i = first; i < first + count; ++i) {
        const double v = v_part(i), dv = v - v_[i];
        const double q = q_part(i), dq = q - q_[i];
        guess_[i] = again ? x_[i] : reach_ * a_[i];
        x_[i] = q + b * v + o_.alpha * (dq + b * dv);
        rhs_[i] = rate == nullptr ? 0.0 : -rate[i] * motion_->mass[i] * (v + o_.alpha * dv);
      }
    });
  }

  /// reach a_{n+1} for the bonds as they are. Solved for what the predictor lacks, so that rounding is that
  /// of the acceleration.
  void solve_step(const Eigen::VectorXd& next, const Eigen::VectorXd& dh, bool again) {
    predict(again);
    stiffness_.apply(x_.data(), product_.data());
    for_each_chunk(n_, [&](Index first, Index count) {
      for (Index i = first; i < first + count; ++i) rhs_[i] -= product_[i];
    });
    add_forces(next + o_.alpha * dh, rhs_);
    solve_(rhs_, guess_, x_);
  }

  /// q_{n+1} of the solution x.
  [[nodiscard]] Eigen::VectorXd end_of_step() const {
    const double reach = o_.beta * dt_ * dt_ / reach_;
    return Eigen::VectorXd::NullaryExpr(
        n_, [&](Eigen::Index i) { return q_part(static_cast<Index>(i)) + reach * x_[i]; });
  }

  /// What the bonds that broke in this step held at its start, and did with the force they had there.
  void release(const Eigen::VectorXd& dh) {
    const Eigen::VectorXd& k = breaking_->stiffness();
    if (k.size() == 0) return;
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(n_), still = Eigen::VectorXd::Zero(dh.size());
    const Eigen::ArrayXd e = breaking_->elongation(q_, h_), before = breaking_->elongation(dq_, dh_);
    const Eigen::ArrayXd de = breaking_->elongation(end_of_step() - q_, dh);
    const Eigen::ArrayXd moved = breaking_->elongation(rest, dh);
    const Eigen::ArrayXd pull = (1.0 - o_.gamma) * k.array() * (e + o_.alpha * before);
    broken_.add((0.5 * k.array() * (e.square() + spring() * before.square()) + pull * de).sum());
    ledger_.work.add((pull * moved).sum());
    if (motion_->stiffness_damping == 0.0) return;
    const Eigen::ArrayXd rate = breaking_->elongation(v_ + o_.alpha * dv_, still);
    ledger_.damping.add(motion_->stiffness_damping * (1.0 - o_.gamma) *
                        (k.array() * rate * (de - moved)).sum());
  }

  /// The state at the end of the step and what the step adds to the ledger.
  void correct(const Eigen::VectorXd& dh) {
    const Eigen::VectorXd p_q = projections(q_), p_before = projections(dq_);
    const double now = o_.gamma * (1.0 + o_.alpha), before = o_.alpha * (1.0 - o_.gamma);
    const double* rate = rate_of(*motion_);
    const bool hht = o_.alpha != 0.0;
    // x = dq, or the second difference of q; guess = the velocity of the damping.
    CompensatedSum lost;
    const double inertia = (o_.gamma - 0.5) * (o_.beta - 0.5 * o_.gamma) * dt_ * dt_;
    lost.add(sum_over_chunks(n_, [&](Index first, Index count) {
      double sum = 0.0;
      for (Index i = first; i < first + count; ++i) {
        const double m = motion_->mass[i];
        const double a = x_[i] / reach_;
        const double q = q_part(i) + o_.beta * dt_ * dt_ * a;
        const double v = v_part(i) + o_.gamma * dt_ * a;
        const double dq = q - q_[i], dv = v - v_[i], da = a - a_[i];
        const double v_damped = v_[i] + now * dv + before * dv_[i];
        sum += inertia * m * da * da;
        if (rate != nullptr) sum += rate[i] * m * dq * v_damped;
        x_[i] = hht ? dq - dq_[i] : dq;
        guess_[i] = v_damped;
        q_[i] = q;
        v_[i] = v;
        a_[i] = a;
        dq_[i] = dq;
        dv_[i] = dv;
      }
      return sum;
    }));
    const Eigen::VectorXd p_dq = projections(dq_);
    if (hht) {
      const Eigen::VectorXd p_x = p_dq - p_before, h_x = dh - dh_;
      lost.add(spring() * (0.5 * stiffness_square(x_) + given_energy(*motion_, p_x, h_x)));
    } else if (o_.gamma != 0.5) {
      lost.add((o_.gamma - 0.5) * (stiffness_square(x_) + 2.0 * given_energy(*motion_, p_dq, dh)));
    }
    if (motion_->stiffness_damping > 0.0) {
      stiffness_.apply(guess_.data(), product_.data());
      lost.add(motion_->stiffness_damping * perimode::dot(n_, dq_.data(), product_.data()));
    }
    ledger_.damping.add(lost.value());

    const Eigen::VectorXd h = h_ + now * dh + before * dh_;
    const Eigen::VectorXd reaction = reactions(*motion_, p_q + now * p_dq + before * p_before, h);
    for (Eigen::Index k = 0; k < h.size(); ++k)
      ledger_.work.add(motion_->force[static_cast<std::size_t>(k)].motion ? dh[k] * reaction[k]
                                                                          : p_dq[k] * h[k]);
  }

  /// Stiffness per K of the springs that HHT puts on dq: -alpha (1 - gamma).
  [[nodiscard]] double spring() const { return -o_.alpha * (1.0 - o_.gamma); }

  void update_energies() {
    const double inertia = (o_.beta - 0.5 * o_.gamma) * dt_ * dt_;
    const double kinetic = 0.5 * sum_over_chunks(n_, [&](Index first, Index count) {
                             double sum = 0.0;
                             for (Index i = first; i < first + count; ++i)
                               sum += motion_->mass[i] * (v_[i] * v_[i] + inertia * a_[i] * a_[i]);
                             return sum;
                           });
    double strain = 0.5 * stiffness_square(q_) + given_energy(*motion_, projections(q_), h_);
    if (o_.alpha != 0.0)
      strain += spring() * (0.5 * stiffness_square(dq_) + given_energy(*motion_, projections(dq_), dh_));
    energies_ = ledger_.with(kinetic, strain);
    energies_.broken = broken_.value();
  }

  const Motion* motion_;
  StepBreaking* breaking_;  ///< or none
  double dt_;
  NewmarkOptions o_;
  Index n_;
  LinearOperator stiffness_;
  double reach_ = 0.0;  ///< d w' / d a_{n+1}, s^2
  ShiftedSolve solve_;
  std::int64_t step_ = 0;
  Eigen::VectorXd q_, v_, a_;
  Eigen::VectorXd dq_, dv_;  ///< of the last step
  Eigen::VectorXd h_, dh_;   ///< of the force terms, now and of the last step
  Eigen::VectorXd x_, product_, rhs_, guess_;
  Ledger ledger_;
  CompensatedSum broken_;  ///< energy of broken bonds, J
  Energies energies_;
};

}  // namespace

std::unique_ptr<Integrator> newmark(const Motion& motion, double dt, const NewmarkOptions& options,
                                    const ShiftedSolver& solver, StepBreaking* breaking) {
  return std::make_unique<Newmark>(motion, dt, options, solver, breaking);
}

}  // namespace perimode
