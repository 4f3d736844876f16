// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dynamics/central_difference.hpp"

#include <algorithm>
#include <utility>

#include "dynamics/saved_state.hpp"
#include "step_kernels.hpp"

namespace perimode {

namespace {

/// What the rows of a piece have in common.
struct PieceRows {
  double mass = 0.0;  ///< of all rows; 0: they differ
  bool damped = false;
};

struct PieceSums {
  double kinetic = 0.0;
  double strain = 0.0;
  double work = 0.0;
  double damping = 0.0;
};

/// Force terms, and where the dofs of each piece begin in them.
class Forces {
 public:
  explicit Forces(const std::vector<ForceTerm>& terms, Index pieces)
      : terms_(&terms), h_(terms.size()), first_(terms.size() * static_cast<std::size_t>(pieces)) {}

  void place(const RowPiece& rows) {
    for (std::size_t k = 0; k < terms_->size(); ++k) {
      const auto& dof = (*terms_)[k].dof;
      first_[index(rows, k)] =
          static_cast<std::size_t>(std::lower_bound(dof.begin(), dof.end(), rows.first) - dof.begin());
    }
  }

  void set_time(double t) {
    for (std::size_t k = 0; k < terms_->size(); ++k) h_[k] = value_at((*terms_)[k].time, t);
  }

  /// Calls use(row of the piece, force, whether a load) for every force on a piece.
  template <class Use>
  void on(const RowPiece& rows, const Use& use) const {
    for (std::size_t k = 0; k < terms_->size(); ++k) {
      if (h_[k] == 0.0) continue;
      const ForceTerm& term = (*terms_)[k];
      for (std::size_t e = first_[index(rows, k)];
           e < term.dof.size() && term.dof[e] < rows.first + rows.count; ++e)
        use(term.dof[e] - rows.first, h_[k] * term.value[e], !term.motion);
    }
  }

 private:
  [[nodiscard]] std::size_t index(const RowPiece& rows, std::size_t term) const {
    return static_cast<std::size_t>(rows.piece) * terms_->size() + term;
  }

  const std::vector<ForceTerm>* terms_;
  std::vector<double> h_;
  std::vector<std::size_t> first_;
};

/// Given displacements sum_k h_k g_k: what they store and the work they do, from p_k = -R K g_k alone.
class GivenWork {
 public:
  explicit GivenWork(const Motion& motion) : stiffness_(&motion.motion_stiffness) {
    for (const ForceTerm& term : motion.force)
      if (term.motion) terms_.push_back(&term);
  }

  [[nodiscard]] bool any() const { return !terms_.empty(); }
  [[nodiscard]] Eigen::VectorXd factors(double t) const {
    Eigen::VectorXd h(size());
    for (Eigen::Index k = 0; k < h.size(); ++k) h[k] = value_at(at(k).time, t);
    return h;
  }
  /// p_k . q.
  [[nodiscard]] Eigen::VectorXd along(const Eigen::VectorXd& q) const {
    Eigen::VectorXd s = Eigen::VectorXd::Zero(size());
    for (Eigen::Index k = 0; k < s.size(); ++k)
      for (std::size_t e = 0; e < at(k).dof.size(); ++e) s[k] += at(k).value[e] * q[at(k).dof[e]];
    return s;
  }
  /// u^T K w - q_u^T K q_w of displacements u and w with factors h_u, h_w and s = p . q.
  [[nodiscard]] double energy(const Eigen::VectorXd& h_u, const Eigen::VectorXd& s_u,
                              const Eigen::VectorXd& h_w, const Eigen::VectorXd& s_w) const {
    return h_u.dot(*stiffness_ * h_w) - h_w.dot(s_u) - h_u.dot(s_w);
  }
  /// Forces g_k^T K u that hold the given displacements.
  [[nodiscard]] Eigen::VectorXd reactions(const Eigen::VectorXd& h, const Eigen::VectorXd& s) const {
    return *stiffness_ * h - s;
  }

 private:
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(terms_.size()); }
  [[nodiscard]] const ForceTerm& at(Eigen::Index k) const { return *terms_[static_cast<std::size_t>(k)]; }

  const Eigen::MatrixXd* stiffness_;
  std::vector<const ForceTerm*> terms_;
};

class CentralDifference final : public Integrator {
 public:
  CentralDifference(const Motion& motion, double dt)
      : motion_(&motion),
        dt_(dt),
        rows_(static_cast<std::size_t>(motion.stiffness.pieces)),
        sums_(rows_.size()),
        forces_(motion.force, motion.stiffness.pieces),
        given_(motion) {}

  void start(const Eigen::VectorXd& q, const Eigen::VectorXd& v) override {
    step_ = 0;
    q_ = q;
    v_ = v;
    work_ = damping_ = {};
    update_lag();
    forces_.set_time(0.0);
    motion_->stiffness.apply(q_.data(), [this](const RowPiece& rows) { start_piece(rows); });
    sum_energies();
    if (given_.any()) {
      along_ = given_.along(q_);
      const Eigen::VectorXd h = given_.factors(0.0);
      strain_ += 0.5 * given_.energy(h, given_.along(q_ - dt_ * v_), h, along_);
    }
    initial_ = kinetic_ + strain_;
  }

  void advance(bool with_energies) override {
    update_lag();
    forces_.set_time(time(step_));
    if (!motion_->stiffness.in_place) next_.resize(q_.size());
    double* next = motion_->stiffness.in_place ? q_.data() : next_.data();
    motion_->stiffness.apply(q_.data(), [this, next, with_energies](const RowPiece& rows) {
      step_piece(rows, next, with_energies);
    });
    if (!motion_->stiffness.in_place) q_.swap(next_);
    double work = 0.0, damping = 0.0;
    for (const PieceSums& s : sums_) {
      work += s.work;
      damping += s.damping;
    }
    work_.add(work);
    damping_.add(damping);
    if (with_energies) sum_energies();
    if (given_.any()) move_given(with_energies);
    ++step_;
  }

  [[nodiscard]] std::int64_t step() const override { return step_; }
  [[nodiscard]] const Eigen::VectorXd& displacement() const override { return q_; }

  [[nodiscard]] Eigen::VectorXd velocity() const override {
    Forces forces = forces_;
    forces.set_time(time(step_));
    Eigen::VectorXd v = v_;
    const Eigen::VectorXd lag = lagging(v_);
    motion_->stiffness.apply(q_.data(), [&](const RowPiece& rows) {
      forces.on(rows, [&](Index row, double force, bool) { rows.y[row] -= force; });
      static_cast<void>(step_rows(rows_of(rows, v.data(), rows.y, lag), false));
    });
    return 0.5 * (v_ + v);
  }

  [[nodiscard]] Energies energies() const override {
    return {kinetic_, strain_, work_.value(), damping_.value(), 0.0, initial_};
  }

  [[nodiscard]] IntegratorState save() const override {
    IntegratorState state;
    state.step = step_;
    perimode::save("displacement", q_, state);
    perimode::save("velocity", v_, state);
    state.numbers["energies"] = {kinetic_,   strain_,      initial_,      work_.sum,
                                 work_.lost, damping_.sum, damping_.lost, dt_};
    return state;
  }

  void restore(const IntegratorState& state) override {
    const auto& e = saved_numbers(state, "energies", 8);
    check_saved_step(e[7], dt_);
    q_ = saved(state, "displacement", motion_->stiffness.size);
    v_ = saved(state, "velocity", motion_->stiffness.size);
    step_ = state.step;
    kinetic_ = e[0];
    strain_ = e[1];
    initial_ = e[2];
    work_ = {e[3], e[4]};
    damping_ = {e[5], e[6]};
    motion_->stiffness.apply(q_.data(), [this](const RowPiece& rows) { look_at(rows); });
    if (given_.any()) along_ = given_.along(q_);
  }

 private:
  [[nodiscard]] double time(std::int64_t step) const { return static_cast<double>(step) * dt_; }

  /// Force of stiffness damping at velocity v; empty: none.
  [[nodiscard]] Eigen::VectorXd lagging(const Eigen::VectorXd& v) const {
    if (motion_->stiffness_damping == 0.0) return {};
    return motion_->stiffness_damping * multiply(as_operator(motion_->stiffness), v);
  }
  void update_lag() { lag_ = lagging(v_); }

  void look_at(const RowPiece& rows) {
    const auto m = motion_->mass.segment(rows.first, rows.count);
    PieceRows& common = rows_[static_cast<std::size_t>(rows.piece)];
    common.mass = (m.array() == m[0]).all() ? m[0] : 0.0;
    common.damped = motion_->damping_rate.size() > 0 &&
                    (motion_->damping_rate.segment(rows.first, rows.count).array() != 0.0).any();
    forces_.place(rows);
  }

  [[nodiscard]] StepRows rows_of(const RowPiece& rows, double* v, double* next,
                                 const Eigen::VectorXd& lag) const {
    const PieceRows& common = rows_[static_cast<std::size_t>(rows.piece)];
    return {.count = rows.count,
            .ahead = std::min(rows.count, motion_->stiffness.size - rows.first - rows.count),
            .dt = dt_,
            .y = rows.y,
            .q = q_.data() + rows.first,
            .v = v + rows.first,
            .next = next,
            .one_mass = common.mass,
            .mass = common.mass > 0.0 ? nullptr : motion_->mass.data() + rows.first,
            .rate = common.damped ? motion_->damping_rate.data() + rows.first : nullptr,
            .lag = lag.size() > 0 ? lag.data() + rows.first : nullptr};
  }

  /// v_{-1/2} = v_0 - (dt/2) a_0, and the energies of that half step.
  void start_piece(const RowPiece& rows) {
    look_at(rows);
    PieceSums sum;
    const auto at = [&](const Eigen::VectorXd& of, Index row) {
      return of.size() > 0 ? of[rows.first + row] : 0.0;
    };
    std::vector<double> force(static_cast<std::size_t>(rows.count), 0.0);
    forces_.on(rows, [&](Index row, double f, bool) { force[static_cast<std::size_t>(row)] += f; });
    for (Index row = 0; row < rows.count; ++row) {
      double& v = v_[rows.first + row];
      const double mass = motion_->mass[rows.first + row];
      const double a = (force[static_cast<std::size_t>(row)] - rows.y[row] - at(lag_, row)) / mass -
                       at(motion_->damping_rate, row) * v;
      v -= 0.5 * dt_ * a;
      sum.kinetic += 0.5 * mass * v * v;
      sum.strain += 0.5 * rows.y[row] * (q_[rows.first + row] - dt_ * v);
    }
    sums_[static_cast<std::size_t>(rows.piece)] = sum;
  }

  void step_piece(const RowPiece& rows, double* next, bool with_energies) {
    double power = 0.0, forced = 0.0;
    double* v = v_.data() + rows.first;
    next += rows.first;
    forces_.on(rows, [&](Index row, double force, bool load) {
      rows.y[row] -= force;
      if (load) power += force * v[row];
    });
    const StepSums sums = step_rows(rows_of(rows, v_.data(), next, lag_), with_energies);
    forces_.on(rows, [&](Index row, double force, bool load) {
      forced += force * next[row];
      if (load) power += force * v[row];
    });
    sums_[static_cast<std::size_t>(rows.piece)] = {0.5 * sums.momentum, 0.5 * (sums.strain + forced),
                                                   0.5 * dt_ * power, sums.damping};
  }

  void sum_energies() {
    CompensatedSum kinetic, strain;
    for (const PieceSums& s : sums_) {
      kinetic.add(s.kinetic);
      strain.add(s.strain);
    }
    kinetic_ = kinetic.value();
    strain_ = strain.value();
  }

  /// Work of given displacements over a step, and their part of its strain energy. Before the start they
  /// stand still.
  void move_given(bool with_energies) {
    const Eigen::VectorXd before = given_.factors(time(std::max<std::int64_t>(step_ - 1, 0)));
    const Eigen::VectorXd h = given_.factors(time(step_));
    const Eigen::VectorXd after = given_.factors(time(step_ + 1));
    Eigen::VectorXd along = given_.along(q_);
    work_.add(0.5 * (after - before).dot(given_.reactions(h, along_)));
    if (with_energies) strain_ += 0.5 * given_.energy(h, along_, after, along);
    along_.swap(along);
  }

  const Motion* motion_;
  double dt_;
  std::int64_t step_ = 0;
  Eigen::VectorXd q_, v_;  ///< q_n, v_{n-1/2}
  Eigen::VectorXd next_;   ///< q_{n+1} where the product still reads q_n
  Eigen::VectorXd lag_;
  std::vector<PieceRows> rows_;
  std::vector<PieceSums> sums_;
  Forces forces_;
  GivenWork given_;
  Eigen::VectorXd along_;  ///< p_k . q_n
  double kinetic_ = 0.0, strain_ = 0.0, initial_ = 0.0;
  CompensatedSum work_, damping_;
};

}  // namespace

std::unique_ptr<Integrator> central_difference(const Motion& motion, double dt) {
  return std::make_unique<CentralDifference>(motion, dt);
}

}  // namespace perimode
