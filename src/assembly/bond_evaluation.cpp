// SPDX-License-Identifier: BSD-3-Clause
#include "bond_evaluation.hpp"

#include <limits>

#include "perimode/linalg/threads.hpp"

namespace perimode {

namespace {

constexpr Index piece_particles =
    256;  ///< a multiple of bond_lanes; forces of a piece stay in the first cache
constexpr Index parallel_rows = 1000;  ///< particles from which threads pay
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Consecutive particles; on a grid of one row of cells.
struct Piece {
  Index particle = 0;
  Index count = 0;
  Index dof = 0;  ///< its free dofs: number of the first one, and how many
  Index dofs = 0;
  bool forces = true;  ///< whether anything asks for its forces
};

/// Cuts the particles into pieces; `follows(i)`: whether particle i may share one with i - 1.
template <int Dim, class Follows>
std::vector<Piece> cut_into_pieces(const Body<Dim>& body, const Follows& follows) {
  const BoundaryMap<Dim>& map = body.boundary;
  const auto asked = [&](Index i) {
    for (std::size_t d = static_cast<std::size_t>(i) * Dim; d < static_cast<std::size_t>(i + 1) * Dim; ++d)
      if (map.free_number[d] >= 0 || map.given[d] != 0.0) return true;
    return false;
  };
  std::vector<Piece> pieces;
  Index dof = 0;
  for (Index i = 0; i < body.count(); ++i) {
    const bool forces = asked(i);
    if (pieces.empty() || pieces.back().count == piece_particles || pieces.back().forces != forces ||
        !follows(i))
      pieces.push_back({i, 0, dof, 0, forces});
    ++pieces.back().count;
    for (int a = 0; a < Dim; ++a) {
      if (map.free_number[static_cast<std::size_t>(i) * Dim + a] < 0) continue;
      ++pieces.back().dofs;
      ++dof;
    }
  }
  return pieces;
}

/// What grids and clouds share: pieces, threads, the order of what breaks. The derived classes say where
/// displacements go and how a piece is summed.
template <int Dim>
class PieceByPiece : public BondEvaluation<Dim> {
 public:
  [[nodiscard]] Index pieces() const override { return static_cast<Index>(piece_.size()); }

  const std::vector<OverStretched>& forces(const GivenMotion<Dim>& given, const double* q,
                                           const std::function<void(const RowPiece&)>& take,
                                           double* moving_force) override {
    spread(given, q);
    const Index parts = chunks();
    work_.resize(std::max<std::size_t>(work_.size(), static_cast<std::size_t>(parts)));
#pragma omp parallel for schedule(static, 1) if (parts > 1)
    for (Index c = 0; c < parts; ++c) {
      Work& work = work_[static_cast<std::size_t>(c)];
      work.broken.clear();
      for (Index p = first_piece(c, parts); p < first_piece(c + 1, parts); ++p) {
        const Piece& piece = piece_[static_cast<std::size_t>(p)];
        if (!piece.forces) continue;
        const std::size_t before = work.broken.size();
        sum_forces(piece, work.out.data(), work.broken);
        for (std::size_t b = before; b < work.broken.size(); ++b) work.broken[b].particle += piece.particle;
        hand_out(given, p, work, take, moving_force);
      }
    }
    broken_.clear();
    for (Index c = 0; c < parts; ++c) {
      const auto& found = work_[static_cast<std::size_t>(c)].broken;
      broken_.insert(broken_.end(), found.begin(), found.end());
    }
    return broken_;
  }

  double energy(const GivenMotion<Dim>& given, const double* q) override {
    spread(given, q);
    std::vector<double> of_piece(piece_.size());
    const Index n = pieces();
#pragma omp parallel if (body_->count() >= parallel_rows)
    {
      std::vector<double> out(out_stride);
#pragma omp for schedule(static)
      for (Index p = 0; p < n; ++p) {
        sum_energies(piece_[static_cast<std::size_t>(p)], out.data());
        for (Index t = 0; t < piece_[static_cast<std::size_t>(p)].count; ++t)
          of_piece[static_cast<std::size_t>(p)] += out[static_cast<std::size_t>(t)];
      }
    }
    double sum = 0.0;
    for (const double e : of_piece) sum += e;
    return sum;
  }

 protected:
  static constexpr std::ptrdiff_t out_stride = piece_particles + bond_lanes;

  PieceByPiece(const Body<Dim>& body, std::vector<Piece> pieces) : body_(&body), piece_(std::move(pieces)) {}

  /// Displacements of all particles and ghosts to where the sums read them.
  virtual void spread(const GivenMotion<Dim>& given, const double* q) = 0;
  /// Internal forces on the particles of a piece: component a of particle t at out[a * out_stride + t].
  virtual void sum_forces(const Piece& piece, double* out, std::vector<OverStretched>& broken) const = 0;
  virtual void sum_energies(const Piece& piece, double* out) const = 0;

  const Body<Dim>* body_;

 private:
  /// Memory of one thread.
  struct Work {
    std::vector<double> out = std::vector<double>(Dim * out_stride);
    std::vector<double> rows = std::vector<double>(Dim * piece_particles);
    std::vector<OverStretched> broken;
  };

  [[nodiscard]] Index chunks() const {
    return body_->count() < parallel_rows ? 1 : std::min<Index>(threads(), pieces());
  }
  [[nodiscard]] Index first_piece(Index chunk, Index chunks) const {
    return static_cast<Index>(static_cast<Offset>(pieces()) * chunk / chunks);
  }

  void hand_out(const GivenMotion<Dim>& given, Index p, Work& work,
                const std::function<void(const RowPiece&)>& take, double* moving_force) {
    const Piece& piece = piece_[static_cast<std::size_t>(p)];
    const std::size_t first = static_cast<std::size_t>(piece.particle) * Dim;
    const std::size_t end = first + static_cast<std::size_t>(piece.count) * Dim;
    const auto at = [&](std::size_t d) {
      return work.out[(d - first) % Dim * out_stride + (d - first) / Dim];
    };
    const auto& moving = given.moving;
    for (auto m = std::lower_bound(moving.begin(), moving.end(), first); m != moving.end() && *m < end; ++m)
      moving_force[m - moving.begin()] = at(*m);
    if (piece.dofs == 0) return;
    if (piece.dofs == piece.count * Dim) {
      for (Index t = 0; t < piece.count; ++t)
        for (int a = 0; a < Dim; ++a) work.rows[t * Dim + a] = work.out[a * out_stride + t];
    } else {
      Index row = 0;
      for (std::size_t d = first; d < end; ++d)
        if (body_->boundary.free_number[d] >= 0) work.rows[static_cast<std::size_t>(row++)] = at(d);
    }
    take({p, piece.dof, piece.dofs, work.rows.data()});
  }

  std::vector<Piece> piece_;
  std::vector<Work> work_;
  std::vector<OverStretched> broken_;
};

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

  void sum_forces(const Piece& piece, double* out, std::vector<OverStretched>& broken) const override {
    GridRun run = run_of(piece, out);
    run.broken = &broken;
    bond_forces<Dim>(run, turning_);
  }
  void sum_energies(const Piece& piece, double* out) const override {
    bond_energies<Dim>(run_of(piece, out), turning_);
  }

 private:
  static const GridBonds<Dim>& bonds_of(const Body<Dim>& body) {
    return std::get<GridBonds<Dim>>(body.bonds);
  }

  [[nodiscard]] GridRun run_of(const Piece& piece, double* out) const {
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
    run.out = out;
    run.out_stride = this->out_stride;
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
  void sum_forces(const Piece& piece, double* out, std::vector<OverStretched>& broken) const override {
    CloudRun run = run_of(piece, out);
    run.broken = &broken;
    bond_forces<Dim>(run, turning_);
  }
  void sum_energies(const Piece& piece, double* out) const override {
    bond_energies<Dim>(run_of(piece, out), turning_);
  }

 private:
  [[nodiscard]] CloudRun run_of(const Piece& piece, double* out) const {
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
    run.out = out;
    run.out_stride = this->out_stride;
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
std::unique_ptr<BondEvaluation<Dim>> make_bond_evaluation(const Body<Dim>& body, bool turning,
                                                          const std::vector<double>& measure,
                                                          const std::vector<Index>& no_fail) {
  if (std::holds_alternative<GridBonds<Dim>>(body.bonds))
    return std::make_unique<GridEvaluation<Dim>>(body, turning, measure, no_fail);
  return std::make_unique<CloudEvaluation<Dim>>(body, turning, measure, no_fail);
}

#define PERIMODE_EVALUATION(D)                                         \
  template std::unique_ptr<BondEvaluation<D>> make_bond_evaluation<D>( \
      const Body<D>&, bool, const std::vector<double>&, const std::vector<Index>&)
PERIMODE_EVALUATION(1);
PERIMODE_EVALUATION(2);
PERIMODE_EVALUATION(3);
#undef PERIMODE_EVALUATION

}  // namespace perimode
