// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "bond_pieces.hpp"

namespace perimode {

namespace {

template <int Dim>
class GridEvaluation final : public PieceByPiece<Dim> {
 public:
  GridEvaluation(const Body<Dim>& body, bool turning, const std::vector<double>& measure,
                 const std::vector<Index>& no_fail)
      : PieceByPiece<Dim>(body, cut_into_pieces(body,
                                                [&](Index i) {
                                                  const auto& home = bonds_of(body).home;
                                                  return home[i] == home[i - 1] + 1;
                                                })),
        bonds_(&bonds_of(body)),
        turning_(turning) {
    // An odd number of cache lines, so that components do not crowd the same sets.
    const auto cells = static_cast<std::ptrdiff_t>(bonds_->occupant.size());
    stride_ = ((cells + bond_lanes + 7) / 8 | 1) * 8;
    u_.assign(static_cast<std::size_t>(stride_ * Dim), 0.0);
    add_family(body);
    add_limits(body, measure, no_fail);
    add_cells(body);
  }

  [[nodiscard]] Point<Dim> relative(Index i, const BondEnd<Dim>& end) const override {
    const double* here = u_.data() + bonds_->home[i];
    const double* there = here + bonds_->step[static_cast<std::size_t>(end.slot)];
    Point<Dim> eta;
    for (int a = 0; a < Dim; ++a) eta[a] = there[a * stride_] - here[a * stride_];
    return eta;
  }

 protected:
  void spread(const GivenMotion<Dim>& given, const double* q) override {
    const BoundaryMap<Dim>& map = this->body_->boundary;
    const Index n = this->body_->count();
    const auto cells = static_cast<Index>(bonds_->occupant.size());
    const Index* free_number = map.free_number.data();
    const auto value = [&](Index particle, int a) {
      const std::size_t d = static_cast<std::size_t>(particle) * Dim + a;
      return free_number[d] >= 0 ? q[free_number[d]] : given.dof[d];
    };
#pragma omp parallel for schedule(static) if (n >= parallel_rows)
    for (Index cell = 0; cell < cells; ++cell) {
      const Index occupant = bonds_->occupant[cell];
      if (occupant == GridBonds<Dim>::absent) continue;
      for (int a = 0; a < Dim; ++a) {
        double& to = u_[static_cast<std::size_t>(a * stride_ + cell)];
        if (occupant < n) {
          to = value(occupant, a);
        } else {
          const std::size_t g = static_cast<std::size_t>(occupant - n);
          to = followed(map, g, a, value) + given.ghost[g * Dim + a];
        }
      }
    }
  }

  void sum(const Piece& piece, double* out, double* energy,
           std::vector<OverStretched>& broken) const override {
    GridRun run = run_of(piece);
    run.out = out;
    run.out_stride = this->out_stride;
    run.energy = energy;
    run.broken = &broken;
    bond_forces<Dim>(run, turning_);
  }

 private:
  static const GridBonds<Dim>& bonds_of(const Body<Dim>& body) {
    return std::get<GridBonds<Dim>>(body.bonds);
  }

  [[nodiscard]] GridRun run_of(const Piece& piece) const {
    const Index home = bonds_->home[piece.particle];
    const auto from = [&](const std::vector<double>& v) { return v.empty() ? nullptr : v.data() + home; };
    GridRun run;
    run.u = u_.data() + home;
    run.stride = stride_;
    run.step = bonds_->step.data();
    run.xi = xi_.data();
    run.length = bonds_->family.length.data();
    run.stiffness = stiffness_.data();
    run.limit = limit_.data();
    run.square = square_.data();
    run.members = bonds_->family.size();
    run.alive = bonds_->alive.data() + static_cast<std::ptrdiff_t>(piece.particle) * bonds_->words;
    run.words = bonds_->words;
    run.count = piece.count;
    run.cells = {from(factor_), from(block_), from(cell_limit_), from(never_), from(share_)};
    return run;
  }

  void add_family(const Body<Dim>& body) {
    const Family<Dim>& family = bonds_->family;
    const double volume = body.particles.volume[0];
    for (int k = 0; k < family.size(); ++k) {
      for (int a = 0; a < Dim; ++a) xi_.push_back(family.spacing * family.offset[k][a]);
      square_.push_back(family.length[k] * family.length[k]);
    }
    for (std::size_t b = 0; b < body.density.size(); ++b) {
      for (int k = 0; k < family.size(); ++k) {
        const double c = body.constants.kernel[b * static_cast<std::size_t>(family.size()) + k];
        const double stiffness = c * family.weight[k] * (volume * volume) / family.length[k];
        stiffness_.push_back(turning_ ? stiffness : stiffness / square_[k]);
      }
    }
  }

  void add_limits(const Body<Dim>& body, const std::vector<double>& measure,
                  const std::vector<Index>& no_fail) {
    for (const double square : square_) limit_.push_back(square * measure[0]);
    const bool one = std::all_of(measure.begin(), measure.end(), [&](double m) { return m == measure[0]; });
    if (one && no_fail.empty()) return;
    std::vector<char> holds(static_cast<std::size_t>(body.count()), 0);
    for (const Index i : no_fail) holds[i] = 1;
    cell_limit_ = over_cells(body, infinity, [&](Index i) { return measure[body.particles.block[i]]; });
    never_ = over_cells(body, -infinity, [&](Index i) { return holds[i] != 0 ? infinity : -infinity; });
  }

  void add_cells(const Body<Dim>& body) {
    const auto& factor = body.constants.factor;
    const std::ptrdiff_t size = bonds_->family.size();
    if (!factor.empty()) factor_ = over_cells(body, 0.0, [&](Index i) { return factor[i]; });
    bool alike = factor.empty() || body.density.size() == 1;
    for (std::size_t b = 1; b < body.density.size() && alike; ++b)
      alike = std::equal(stiffness_.begin(), stiffness_.begin() + size,
                         stiffness_.begin() + static_cast<std::ptrdiff_t>(b) * size);
    if (!alike)
      block_ = over_cells(body, 0.0, [&](Index i) { return static_cast<double>(body.particles.block[i]); });
    bool halves = true;
    for (std::size_t g = 0; g < bonds_->ghosts.size(); ++g)
      halves = halves && ghost_share(body.boundary, static_cast<Index>(g)) == 0.5;
    if (halves) return;
    share_.assign(bonds_->occupant.size() + bond_lanes, 0.5);
    for (std::size_t cell = 0; cell < bonds_->occupant.size(); ++cell) {
      const Index occupant = bonds_->occupant[cell];
      if (occupant >= body.count()) share_[cell] = ghost_share(body.boundary, occupant - body.count());
    }
  }

  /// A property of particles over the padded grid; ghosts have that of their images.
  template <class Of>
  std::vector<double> over_cells(const Body<Dim>& body, double nobody, const Of& of) const {
    std::vector<double> values(bonds_->occupant.size() + bond_lanes, nobody);
    for (std::size_t cell = 0; cell < bonds_->occupant.size(); ++cell) {
      const Index occupant = bonds_->occupant[cell];
      if (occupant != GridBonds<Dim>::absent) values[cell] = of(owner(body.bonds, occupant, body.count()));
    }
    return values;
  }

  const GridBonds<Dim>* bonds_;
  bool turning_;
  std::ptrdiff_t stride_ = 0;
  std::vector<double> u_;  ///< displacements over the padded grid, component by component
  std::vector<double> xi_, square_, stiffness_, limit_;
  std::vector<double> factor_, block_, cell_limit_, never_, share_;
};

}  // namespace

template <int Dim>
std::unique_ptr<BondEvaluation<Dim>> make_grid_evaluation(const Body<Dim>& body, bool turning,
                                                          const std::vector<double>& measure,
                                                          const std::vector<Index>& no_fail) {
  return std::make_unique<GridEvaluation<Dim>>(body, turning, measure, no_fail);
}

#define PERIMODE_EVALUATION(D)                                         \
  template std::unique_ptr<BondEvaluation<D>> make_grid_evaluation<D>( \
      const Body<D>&, bool, const std::vector<double>&, const std::vector<Index>&)
PERIMODE_EVALUATION(1);
PERIMODE_EVALUATION(2);
PERIMODE_EVALUATION(3);
#undef PERIMODE_EVALUATION

}  // namespace perimode
