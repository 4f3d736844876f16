// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "bond_pieces.hpp"

namespace perimode {

namespace {

template <int Dim>
class CloudEvaluation final : public PieceByPiece<Dim> {
 public:
  CloudEvaluation(const Body<Dim>& body, bool turning, const std::vector<double>& measure,
                  const std::vector<Index>& no_fail)
      : PieceByPiece<Dim>(body, cut_into_pieces(body, [](Index) { return true; })),
        bonds_(&std::get<CloudBonds<Dim>>(body.bonds)),
        turning_(turning),
        u_(static_cast<std::size_t>(body.count()) * Dim) {
    const std::size_t ends = bonds_->neighbour.size();
    stride_ = static_cast<std::ptrdiff_t>(ends) + bond_lanes;
    xi_.assign(static_cast<std::size_t>(stride_) * Dim, 0.0);
    for (auto* v : {&length_, &stiffness_, &limit_}) v->assign(ends + bond_lanes, 0.0);
    neighbour_ = bonds_->neighbour;
    neighbour_.resize(ends + bond_lanes, 0);
    std::vector<char> holds(static_cast<std::size_t>(body.count()), 0);
    for (const Index i : no_fail) holds[i] = 1;
    const auto& block = body.particles.block;
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < body.count(); ++i) {
      for_each_bond(*bonds_, i, Which::present, [&](const BondEnd<Dim>& end) {
        const auto e = static_cast<std::size_t>(end.slot);
        const Index j = end.neighbour;
        for (int a = 0; a < Dim; ++a) xi_[a * static_cast<std::size_t>(stride_) + e] = end.xi[a];
        const double square = end.length * end.length;
        length_[e] = end.length;
        stiffness_[e] = bond_stiffness(body, i, end) / (turning_ ? 1.0 : square);
        limit_[e] = holds[i] != 0 || holds[j] != 0 ? infinity
                                                   : square * std::min(measure[block[i]], measure[block[j]]);
      });
    }
  }

  [[nodiscard]] Point<Dim> relative(Index i, const BondEnd<Dim>& end) const override {
    return Eigen::Map<const Point<Dim>>(u_.data() + static_cast<std::ptrdiff_t>(end.neighbour) * Dim) -
           Eigen::Map<const Point<Dim>>(u_.data() + static_cast<std::ptrdiff_t>(i) * Dim);
  }

 protected:
  void spread(const GivenMotion<Dim>& given, const double* q) override {
    const Index* free_number = this->body_->boundary.free_number.data();
    const auto dofs = static_cast<Offset>(u_.size());
#pragma omp parallel for schedule(static) if (dofs >= parallel_rows * Dim)
    for (Offset d = 0; d < dofs; ++d) u_[d] = free_number[d] >= 0 ? q[free_number[d]] : given.dof[d];
  }
  void sum(const Piece& piece, double* out, double* energy,
           std::vector<OverStretched>& broken) const override {
    CloudRun run = run_of(piece);
    run.out = out;
    run.out_stride = this->out_stride;
    run.energy = energy;
    run.broken = &broken;
    bond_forces<Dim>(run, turning_);
  }

 private:
  [[nodiscard]] CloudRun run_of(const Piece& piece) const {
    CloudRun run;
    run.u = u_.data();
    run.start = bonds_->start.data();
    run.neighbour = neighbour_.data();
    run.xi = xi_.data();
    run.stride = stride_;
    run.length = length_.data();
    run.stiffness = stiffness_.data();
    run.limit = limit_.data();
    run.alive = bonds_->alive.data();
    run.first = piece.particle;
    run.count = piece.count;
    return run;
  }

  const CloudBonds<Dim>* bonds_;
  bool turning_;
  std::ptrdiff_t stride_ = 0;
  std::vector<double> u_;
  std::vector<Index> neighbour_;
  std::vector<double> xi_, length_, stiffness_, limit_;
};

}  // namespace

template <int Dim>
std::unique_ptr<BondEvaluation<Dim>> make_cloud_evaluation(const Body<Dim>& body, bool turning,
                                                           const std::vector<double>& measure,
                                                           const std::vector<Index>& no_fail) {
  return std::make_unique<CloudEvaluation<Dim>>(body, turning, measure, no_fail);
}

#define PERIMODE_EVALUATION(D)                                          \
  template std::unique_ptr<BondEvaluation<D>> make_cloud_evaluation<D>( \
      const Body<D>&, bool, const std::vector<double>&, const std::vector<Index>&)
PERIMODE_EVALUATION(1);
PERIMODE_EVALUATION(2);
PERIMODE_EVALUATION(3);
#undef PERIMODE_EVALUATION

}  // namespace perimode
