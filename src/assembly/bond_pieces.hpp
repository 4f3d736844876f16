// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "bond_evaluation.hpp"
#include "perimode/linalg/threads.hpp"

namespace perimode {

constexpr Index piece_particles = 256;  ///< a multiple of bond_lanes; their forces stay in the first cache

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
[[nodiscard]] std::vector<Piece> cut_into_pieces(const Body<Dim>& body, const Follows& follows) {
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
                                           const BondRequest& request) override {
    spread(given, q);
    const Index parts =
        body_->count() < parallel_rows ? 1 : std::max<Index>(1, std::min<Index>(threads(), pieces()));
    work_.resize(std::max<std::size_t>(work_.size(), static_cast<std::size_t>(parts)));
    if (request.energy) energy_.assign(piece_.size(), 0.0);
#pragma omp parallel for schedule(static, 1) if (parts > 1)
    for (Index c = 0; c < parts; ++c) {
      const auto first = [&](Index part) {
        return static_cast<Index>(static_cast<Offset>(pieces()) * part / parts);
      };
      Work& work = work_[static_cast<std::size_t>(c)];
      work.broken.clear();
      for (Index p = first(c); p < first(c + 1); ++p) take_piece(given, p, work, request);
    }
    broken_.clear();
    for (Index c = 0; c < parts; ++c) {
      const auto& found = work_[static_cast<std::size_t>(c)].broken;
      broken_.insert(broken_.end(), found.begin(), found.end());
    }
    return broken_;
  }

  [[nodiscard]] double energy() const override {
    double sum = 0.0;
    for (const double e : energy_) sum += e;
    return sum;
  }

 protected:
  static constexpr std::ptrdiff_t out_stride = piece_particles + bond_lanes;

  PieceByPiece(const Body<Dim>& body, std::vector<Piece> pieces) : body_(&body), piece_(std::move(pieces)) {}

  /// Displacements of all particles and ghosts to where the sums read them.
  virtual void spread(const GivenMotion<Dim>& given, const double* q) = 0;
  /// Internal forces on the particles of a piece: component a of particle t at out[a * out_stride + t]; their
  /// shares of energy where that is not null; what breaks, numbered from the first particle of the piece.
  virtual void sum(const Piece& piece, double* out, double* energy,
                   std::vector<OverStretched>& broken) const = 0;

  const Body<Dim>* body_;

 private:
  /// Memory of one thread.
  struct Work {
    std::vector<double> out = std::vector<double>(Dim * out_stride);
    std::vector<double> rows = std::vector<double>(Dim * piece_particles);
    std::vector<double> energy = std::vector<double>(out_stride);
    std::vector<OverStretched> broken;
  };

  void take_piece(const GivenMotion<Dim>& given, Index p, Work& work, const BondRequest& request) {
    const Piece& piece = piece_[static_cast<std::size_t>(p)];
    if (!piece.forces && !request.energy) return;
    const std::size_t before = work.broken.size();
    sum(piece, work.out.data(), request.energy ? work.energy.data() : nullptr, work.broken);
    for (std::size_t b = before; b < work.broken.size(); ++b) work.broken[b].particle += piece.particle;
    if (request.energy) {
      for (Index t = 0; t < piece.count; ++t)
        energy_[static_cast<std::size_t>(p)] += work.energy[static_cast<std::size_t>(t)];
    }
    hand_out(given, p, work, request);
  }

  void hand_out(const GivenMotion<Dim>& given, Index p, Work& work, const BondRequest& request) {
    const Piece& piece = piece_[static_cast<std::size_t>(p)];
    const std::size_t first = static_cast<std::size_t>(piece.particle) * Dim;
    const std::size_t end = first + static_cast<std::size_t>(piece.count) * Dim;
    const auto at = [&](std::size_t d) {
      return work.out[(d - first) % Dim * out_stride + (d - first) / Dim];
    };
    const auto& moving = given.moving;
    for (auto m = std::lower_bound(moving.begin(), moving.end(), first); m != moving.end() && *m < end; ++m)
      request.moving_force[m - moving.begin()] = at(*m);
    if (piece.dofs == 0) return;
    if (piece.dofs == piece.count * Dim) {
      for (Index t = 0; t < piece.count; ++t)
        for (int a = 0; a < Dim; ++a) work.rows[t * Dim + a] = work.out[a * out_stride + t];
    } else {
      Index row = 0;
      for (std::size_t d = first; d < end; ++d)
        if (body_->boundary.free_number[d] >= 0) work.rows[static_cast<std::size_t>(row++)] = at(d);
    }
    (*request.take)({p, piece.dof, piece.dofs, work.rows.data()});
  }

  std::vector<Piece> piece_;
  std::vector<Work> work_;
  std::vector<OverStretched> broken_;
  std::vector<double> energy_;  ///< per piece, J
};

}  // namespace perimode
