// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <utility>

#include "dynamics/saved_state.hpp"
#include "linalg/fused.hpp"
#include "perimode/core/error.hpp"
#include "perimode/dynamics/central_difference.hpp"

namespace perimode {

namespace {

/// At step n: q_n, v_{n-1/2} and the force on the free dofs at q_n, in which all bonds broken by then are
/// missing; so what a step reports is known when it is reached.
template <int Dim>
class BondStepping final : public Integrator {
 public:
  BondStepping(const Motion& motion, BondForces<Dim>& forces, double dt)
      : motion_(&motion), forces_(&forces), dt_(dt), n_(forces.product().size) {
    if (motion.mass.size() != n_) {
      invalid_input({fmt::format("masses of {} free dofs", n_),
                     fmt::format("{}", motion.mass.size()),
                     "make motion and forces of the same body",
                     {}});
    }
    q_ = v_ = force_ = Eigen::VectorXd::Zero(n_);
    if (motion.stiffness_damping > 0.0) damped_ = Eigen::VectorXd::Zero(n_);
  }

  void start(const Eigen::VectorXd& q, const Eigen::VectorXd& v) override {
    step_ = 0;
    q_ = q;
    find_force(v, true);
    for (Index d = 0; d < n_; ++d) v_[d] = v[d] - 0.5 * dt_ * (force_[d] / motion_->mass[d] - rate(d) * v[d]);
    reaction_ = forces_->moving_force();
    work_ = damping_ = broken_ = {};
    power_ = damping_power();
    energies_ = {};
    find_energies();
    energies_.initial = energies_.kinetic + energies_.strain + energies_.broken;
  }

  void advance(bool with_energies) override {
    const std::vector<double> load = load_factors();
    for_each_chunk(n_, [&](Index first, Index count) {
      for (Index d = first; d < first + count; ++d) {
        v_[d] = next_velocity(d);
        q_[d] += dt_ * v_[d];
      }
    });
    ++step_;
    const std::vector<double> later = load_factors();
    for (std::size_t k = 0; k < motion_->force.size(); ++k) {
      const ForceTerm& term = motion_->force[k];
      if (term.motion) continue;
      double power = 0.0;
      for (std::size_t e = 0; e < term.dof.size(); ++e) power += term.value[e] * v_[term.dof[e]];
      work_.add(0.5 * (load[k] + later[k]) * power * dt_);
    }
    const std::vector<double> given = forces_->moving_displacement();
    const Offset broken = forces_->broken();
    find_force(v_, with_energies);
    if (forces_->broken() != broken) correct_broken_energy();
    for (std::size_t m = 0; m < given.size(); ++m) {
      work_.add(0.5 * (reaction_[m] + forces_->moving_force()[m]) *
                (forces_->moving_displacement()[m] - given[m]));
    }
    reaction_ = forces_->moving_force();
    const double power = damping_power();
    damping_.add(0.5 * dt_ * (power_ + power));
    power_ = power;
    if (with_energies) find_energies();
  }

  [[nodiscard]] std::int64_t step() const override { return step_; }
  [[nodiscard]] const Eigen::VectorXd& displacement() const override { return q_; }
  [[nodiscard]] Eigen::VectorXd velocity() const override {
    return Eigen::VectorXd::NullaryExpr(n_,
                                        [&](Eigen::Index d) { return velocity_at(static_cast<Index>(d)); });
  }
  [[nodiscard]] Energies energies() const override { return energies_; }
  [[nodiscard]] std::int64_t broken_bonds() const override { return forces_->broken(); }

  [[nodiscard]] IntegratorState save() const override {
    auto bonds = forces_->save();
    const Energies& e = energies_;
    IntegratorState state;
    state.step = step_;
    perimode::save("displacement", q_, state);
    perimode::save("velocity", v_, state);
    perimode::save("force", force_, state);
    perimode::save("damped", damped_, state);
    state.numbers["reaction"] = reaction_;
    state.numbers["energies"] = {e.kinetic, e.strain, e.external_work, e.damping, e.broken, e.initial};
    state.numbers["sums"] = {work_.sum, work_.lost,   damping_.sum, damping_.lost, broken_.sum, broken_.lost,
                             power_,    bonds.energy, dt_};
    state.bits["alive"] = std::move(bonds.alive);
    state.bits["broken"] = {static_cast<std::uint64_t>(bonds.broken)};
    return state;
  }

  void restore(const IntegratorState& state) override {
    const auto alive = state.bits.find("alive");
    const auto broken = state.bits.find("broken");
    if (alive == state.bits.end() || broken == state.bits.end() || broken->second.size() != 1) {
      invalid_input({"a checkpoint of bonds that break", "another", "resume with the case that made it", {}});
    }
    const auto& e = saved_numbers(state, "energies", 6);
    const auto& sums = saved_numbers(state, "sums", 9);
    check_saved_step(sums[8], dt_);
    std::vector<double> reaction = saved_numbers(state, "reaction", forces_->moving_force().size());
    Eigen::VectorXd q = saved(state, "displacement", n_);
    Eigen::VectorXd v = saved(state, "velocity", n_);
    Eigen::VectorXd force = saved(state, "force", n_);
    Eigen::VectorXd damped = saved(state, "damped", damped_.size());
    forces_->restore({alive->second, static_cast<Offset>(broken->second[0]), sums[7]});
    step_ = state.step;
    forces_->set_time(time());
    q_ = std::move(q);
    v_ = std::move(v);
    force_ = std::move(force);
    damped_ = std::move(damped);
    reaction_ = std::move(reaction);
    energies_ = {e[0], e[1], e[2], e[3], e[4], e[5]};
    work_ = {sums[0], sums[1]};
    damping_ = {sums[2], sums[3]};
    broken_ = {sums[4], sums[5]};
    power_ = sums[6];
  }

 private:
  [[nodiscard]] double time() const { return static_cast<double>(step_) * dt_; }
  [[nodiscard]] double rate(Index d) const {
    return motion_->damping_rate.size() == 0 ? 0.0 : motion_->damping_rate[d];
  }
  /// v_{n+1/2} from v_{n-1/2}: diagonal damping acts on their mean.
  [[nodiscard]] double next_velocity(Index d) const {
    const double half = 0.5 * dt_ * rate(d);
    return ((1.0 - half) * v_[d] + dt_ * force_[d] / motion_->mass[d]) / (1.0 + half);
  }
  template <class Term>
  [[nodiscard]] double sum_over_dofs(const Term& term) const {
    return sum_over_chunks(n_, [&](Index first, Index count) {
      double sum = 0.0;
      for (Index d = first; d < first + count; ++d) sum += term(d);
      return sum;
    });
  }
  [[nodiscard]] double velocity_at(Index d) const { return 0.5 * (v_[d] + next_velocity(d)); }

  [[nodiscard]] std::vector<double> load_factors() const {
    std::vector<double> h;
    h.reserve(motion_->force.size());
    for (const ForceTerm& term : motion_->force) h.push_back(term.motion ? 0.0 : value_at(term.time, time()));
    return h;
  }

  /// The force at q_n and the instant of step n; stiffness damping by velocity v.
  void find_force(const Eigen::VectorXd& v, bool with_energy) {
    forces_->set_time(time());
    forces_->follow_energy(with_energy);
    forces_->product().apply(q_.data(), [&](const RowPiece& piece) {
      for (Index r = 0; r < piece.count; ++r) force_[piece.first + r] = -piece.y[r];
    });
    const std::vector<double> load = load_factors();
    for (std::size_t k = 0; k < motion_->force.size(); ++k) {
      const ForceTerm& term = motion_->force[k];
      if (term.motion) continue;
      for (std::size_t e = 0; e < term.dof.size(); ++e) force_[term.dof[e]] += load[k] * term.value[e];
    }
    if (damped_.size() == 0) return;
    motion_->stiffness.apply(v.data(), [&](const RowPiece& piece) {
      for (Index r = 0; r < piece.count; ++r) {
        damped_[piece.first + r] = motion_->stiffness_damping * piece.y[r];
        force_[piece.first + r] -= damped_[piece.first + r];
      }
    });
  }

  /// Power that damping takes at step n, W.
  [[nodiscard]] double damping_power() const {
    double power = 0.0;
    if (motion_->damping_rate.size() > 0) {
      power += sum_over_dofs([&](Index d) {
        const double v = velocity_at(d);
        return motion_->damping_rate[d] * motion_->mass[d] * v * v;
      });
    }
    if (damped_.size() > 0) power += sum_over_dofs([&](Index d) { return velocity_at(d) * damped_[d]; });
    return power;
  }

  /// A bond found broken at step n gave no force to the kick from t_{n-1/2} on, so it took along the energy
  /// it held then.
  void correct_broken_energy() {
    const double now = forces_->last_broken_energy(q_.data());
    const Eigen::VectorXd earlier = q_ - 0.5 * dt_ * v_;
    forces_->set_time(time() - 0.5 * dt_);
    broken_.add(forces_->last_broken_energy(earlier.data()) - now);
    forces_->set_time(time());
  }

  void find_energies() {
    energies_.kinetic = sum_over_dofs([&](Index d) {
      const double v = velocity_at(d);
      return 0.5 * motion_->mass[d] * v * v;
    });
    energies_.strain = forces_->last_strain_energy();
    energies_.broken = forces_->broken_energy() + broken_.value();
    energies_.external_work = work_.value();
    energies_.damping = damping_.value();
  }

  const Motion* motion_;
  BondForces<Dim>* forces_;
  double dt_;
  Index n_;
  std::int64_t step_ = 0;
  Eigen::VectorXd q_, v_, force_;
  Eigen::VectorXd damped_;        ///< beta K v at the last evaluation, N
  std::vector<double> reaction_;  ///< internal force on the dofs that are moved, at step n
  Energies energies_;
  CompensatedSum work_, damping_;
  CompensatedSum broken_;  ///< energy of broken bonds half a step earlier, less that when they were found, J
  double power_ = 0.0;
};

}  // namespace

template <int Dim>
std::unique_ptr<Integrator> central_difference(const Motion& motion, BondForces<Dim>& forces, double dt) {
  return std::make_unique<BondStepping<Dim>>(motion, forces, dt);
}

template std::unique_ptr<Integrator> central_difference<1>(const Motion&, BondForces<1>&, double);
template std::unique_ptr<Integrator> central_difference<2>(const Motion&, BondForces<2>&, double);
template std::unique_ptr<Integrator> central_difference<3>(const Motion&, BondForces<3>&, double);

}  // namespace perimode
