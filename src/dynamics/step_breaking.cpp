// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/step_breaking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "dynamics/given_forces.hpp"
#include "perimode/core/error.hpp"
#include "perimode/dynamics/shifted_solver.hpp"

namespace perimode {

namespace {

/// Columns between solutions from which on a fresh factor costs less than its update, about
/// (docs/theory/15_updates.md): counted, since what is timed does not repeat.
constexpr Index most_updated = 1000;

template <int Dim>
class BodyBreaking final : public StepBreaking {
 public:
  BodyBreaking(Body<Dim>& body, Motion& motion, const StepBreakingOptions& options)
      : body_(&body),
        motion_(&motion),
        options_(options),
        stiffness_(body, options.form),
        shapes_(given_shapes(body)) {
    motion.stiffness = stiffness_.rows();
  }

  [[nodiscard]] ShiftedSolve solver(const Eigen::VectorXd& d) override {
    shift_ = d;
    return [this](const Eigen::VectorXd& b, const Eigen::VectorXd& guess, Eigen::VectorXd& x) {
      return solve(b, guess, x);
    };
  }

  bool break_beyond(const Eigen::VectorXd& q, const Eigen::VectorXd& h) override {
    const std::vector<BondRef> bonds = overstretched(*body_, options_.limits, everywhere(q, h), 0, 0.0).bonds;
    if (bonds.empty()) return false;
    take_out(bonds);
    now_.insert(now_.end(), bonds.begin(), bonds.end());
    const auto before = k_.size();
    k_.conservativeResize(static_cast<Eigen::Index>(now_.size()));
    const std::vector<BondState> states = bond_states(*body_, bonds, nowhere());
    for (std::size_t b = 0; b < states.size(); ++b)
      k_[before + static_cast<Eigen::Index>(b)] = states[b].share * states[b].stiffness;
    ++repeats_now_;
    return true;
  }

  [[nodiscard]] const Eigen::VectorXd& stiffness() const override { return k_; }

  [[nodiscard]] Eigen::VectorXd elongation(const Eigen::VectorXd& q,
                                           const Eigen::VectorXd& h) const override {
    const std::vector<BondState> states = bond_states(*body_, now_, everywhere(q, h));
    Eigen::VectorXd e(k_.size());
    for (std::size_t b = 0; b < states.size(); ++b) e[static_cast<Eigen::Index>(b)] = states[b].elongation;
    return e;
  }

  void settle() override {
    broken_ += static_cast<Offset>(now_.size());
    repeats_.all += repeats_now_;
    repeats_.most = std::max(repeats_.most, repeats_now_);
    repeats_now_ = 0;
    now_.clear();
    k_.resize(0);
  }

  [[nodiscard]] Offset broken() const override { return broken_; }
  [[nodiscard]] StepRepeats repeats() const override { return repeats_; }

  void save(IntegratorState& state) override {
    state.bits["alive"] = std::visit([](const auto& bonds) { return bonds.alive; }, body_->bonds);
    state.bits["broken"] = {static_cast<std::uint64_t>(broken_), static_cast<std::uint64_t>(repeats_.all),
                            static_cast<std::uint64_t>(repeats_.most)};
    solver_.reset();
  }

  void restore(const IntegratorState& state) override {
    const auto alive = state.bits.find("alive");
    const auto counts = state.bits.find("broken");
    const std::size_t words = std::visit([](const auto& bonds) { return bonds.alive.size(); }, body_->bonds);
    if (alive == state.bits.end() || counts == state.bits.end() || counts->second.size() != 3 ||
        alive->second.size() != words) {
      invalid_input({"a checkpoint of implicit steps that break the bonds of this body",
                     "another",
                     "resume with the case that made it",
                     {}});
    }
    take_out(missing(alive->second));
    broken_ = static_cast<Offset>(counts->second[0]);
    repeats_ = {static_cast<Offset>(counts->second[1]), static_cast<Offset>(counts->second[2])};
    solver_.reset();
  }

 private:
  [[nodiscard]] Eigen::VectorXd nowhere() const {
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(body_->boundary.free_number.size()));
  }

  /// Displacements of all particle dofs; the motions among the force terms are the shapes, in their order.
  [[nodiscard]] Eigen::VectorXd everywhere(const Eigen::VectorXd& q, const Eigen::VectorXd& h) const {
    Eigen::VectorXd u = nowhere();
    std::size_t shape = 0;
    for (std::size_t k = 0; k < motion_->force.size(); ++k) {
      const double factor = h[static_cast<Eigen::Index>(k)];
      if (motion_->force[k].motion) u += factor * shapes_[shape++].g;
    }
    for (std::size_t d = 0; d < body_->boundary.free_number.size(); ++d) {
      const Index number = body_->boundary.free_number[d];
      if (number >= 0) u[static_cast<Eigen::Index>(d)] = q[number];
    }
    return u;
  }

  void take_out(const std::vector<BondRef>& bonds) {
    if (bonds.empty()) return;
    if (solver_) {
      const BondColumns lost = bond_columns(*body_, std::span<const BondRef>(bonds));
      solver_->change(lost.negative, lost.positive);
      pending_ += lost.count();
      if (options_.factor && pending_ > most_updated) solver_->refresh();
    }
    stiffness_.break_bonds(bonds);
    const bool moved = std::any_of(shapes_.begin(), shapes_.end(), [&](const GivenShape& shape) {
      const std::vector<BondState> states = bond_states(*body_, bonds, shape.g);
      return std::any_of(states.begin(), states.end(),
                         [](const BondState& s) { return s.elongation != 0.0; });
    });
    if (moved) set_given_forces(*body_, shapes_, *motion_);
  }

  /// Bonds that are alive in the body and not in `alive`.
  [[nodiscard]] std::vector<BondRef> missing(const std::vector<std::uint64_t>& alive) const {
    Bonds<Dim> later = body_->bonds;
    std::visit([&](auto& bonds) { bonds.alive = alive; }, later);
    std::vector<BondRef> bonds;
    for (Index i = 0; i < body_->count(); ++i) {
      for_each_bond(body_->bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
        const bool kept = std::visit([&](const auto& b) { return is_alive(b, i, end.slot); }, later);
        if (!kept && end.neighbour > i) bonds.push_back({i, end.slot});
      });
    }
    return with_images(*body_, std::move(bonds));
  }

  int solve(const Eigen::VectorXd& b, const Eigen::VectorXd& guess, Eigen::VectorXd& x) {
    if (hopeless(b, x)) return 0;
    if (!solver_) {
      solver_.emplace(updated_shifted_solver(*body_, as_operator(motion_->stiffness), shift_, options_.factor,
                                             options_.tolerance));
    }
    Eigen::MatrixXd solution = guess;
    const SolveOutcome outcome = solver_->solve(b, solution);
    pending_ = 0;
    if (outcome.singular || (!outcome.converged && !(outcome.residual <= 10.0 * options_.tolerance)))
      throw Error(ErrorKind::solver_failure, "an implicit step was not solved: " + outcome.message);
    x = solution;
    return outcome.iterations;
  }

  Body<Dim>* body_;
  Motion* motion_;
  StepBreakingOptions options_;
  BreakableStiffness<Dim> stiffness_;
  std::vector<GivenShape> shapes_;
  Eigen::VectorXd shift_;
  std::optional<UpdatedSolver> solver_;  ///< made at the first solution, and after a save
  Index pending_ = 0;                    ///< columns that changed since the last solution
  std::vector<BondRef> now_;             ///< broken in this step
  Eigen::VectorXd k_;                    ///< of these, N/m
  Offset broken_ = 0;
  StepRepeats repeats_;
  Offset repeats_now_ = 0;
};

}  // namespace

template <int Dim>
std::unique_ptr<StepBreaking> step_breaking(Body<Dim>& body, Motion& motion,
                                            const StepBreakingOptions& options) {
  return std::make_unique<BodyBreaking<Dim>>(body, motion, options);
}

template std::unique_ptr<StepBreaking> step_breaking<1>(Body<1>&, Motion&, const StepBreakingOptions&);
template std::unique_ptr<StepBreaking> step_breaking<2>(Body<2>&, Motion&, const StepBreakingOptions&);
template std::unique_ptr<StepBreaking> step_breaking<3>(Body<3>&, Motion&, const StepBreakingOptions&);

}  // namespace perimode
