// SPDX-License-Identifier: BSD-3-Clause
#include "fracture/loose_pieces.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "perimode/modal/rigid.hpp"

namespace perimode {

template <int Dim>
std::vector<Index> LooseSearch<Dim>::unheld_dofs(const Body<Dim>& body, const Equilibrium<Dim>& equilibrium,
                                                 Index i) {
  using Block = Eigen::Matrix<double, Dim, Dim>;
  std::array<Index, Dim> number;
  Block block = Block::Zero();
  for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
    const Point<Dim> n = end.xi / end.length;
    block += std::abs(bond_stiffness(body, i, end)) * n * n.transpose();
  });
  double spring = 0.0;
  for (int a = 0; a < Dim; ++a) {
    number[a] = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
    if (number[a] >= 0) spring = std::max(spring, equilibrium.spring(number[a]));
  }
  if (!(spring > 0.0)) return {};  // nothing of it is free
  for (int a = 0; a < Dim; ++a) {
    if (number[a] >= 0 && !equilibrium.pinned(number[a])) continue;
    block.row(a).setZero();
    block.col(a).setZero();
    block(a, a) = spring;
  }
  std::vector<Index> unheld;
  constexpr double vanishing = 1e-9;  // of the stiffness of the intact particle
  for (int pass = 0; pass < Dim; ++pass) {
    const Eigen::SelfAdjointEigenSolver<Block> eigen(block);
    if (eigen.eigenvalues()[0] > vanishing * spring) break;
    Eigen::Index a = 0;
    eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&a);
    unheld.push_back(number[static_cast<std::size_t>(a)]);
    block(a, a) += spring;
  }
  return unheld;
}

template <int Dim>
std::vector<Index> LooseSearch<Dim>::cut_off(const Body<Dim>& body, Index i, Index j) {
  if (i == j) return {};
  search_ += 2;
  std::array<std::vector<Index>, 2> side = {std::vector<Index>{i}, std::vector<Index>{j}};
  std::array<std::size_t, 2> next = {0, 0};
  seen_[i] = search_;
  seen_[j] = search_ + 1;
  for (int turn = 0;; turn = 1 - turn) {
    auto& mine = side[static_cast<std::size_t>(turn)];
    std::size_t& at = next[static_cast<std::size_t>(turn)];
    if (at == mine.size()) {
      std::sort(mine.begin(), mine.end());
      return mine;
    }
    bool met = false;
    const Index from = mine[at++];
    for_each_bond(body.bonds, from, Which::alive, [&](const BondEnd<Dim>& end) {
      const Index to = owner(body.bonds, end.neighbour, body.count());
      if (seen_[to] == search_ + 1 - turn) met = true;
      if (seen_[to] >= search_) return;
      seen_[to] = search_ + turn;
      mine.push_back(to);
    });
    if (met) return {};
  }
}

std::vector<Index> pivot_dofs(const Eigen::MatrixXd& motions) {
  std::vector<Index> dofs;
  if (motions.cols() == 0) return dofs;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivots(motions.transpose());
  for (Eigen::Index k = 0; k < motions.cols(); ++k)
    dofs.push_back(static_cast<Index>(pivots.colsPermutation().indices()[k]));
  return dofs;
}

template <int Dim>
std::vector<LooseMotion> loose_motions(const Body<Dim>& body, const Equilibrium<Dim>& equilibrium,
                                       const Eigen::VectorXd& mass) {
  const Eigen::MatrixXd modes = rigid_modes(body, equilibrium.product(), mass);
  // Every mode is one piece's own; the modes of a piece follow each other.
  std::vector<LooseMotion> found;
  Eigen::Index first = 0;
  const auto moving = [&](Eigen::Index k) {
    const double size = modes.col(k).cwiseAbs().maxCoeff();
    std::vector<Index> particles;
    for (Index i = 0; i < body.count(); ++i) {
      bool moves = false;
      for (int a = 0; a < Dim; ++a) {
        const Index n = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
        moves = moves || (n >= 0 && std::abs(modes(n, k)) > 1e-9 * size);
      }
      if (moves) particles.push_back(i);
    }
    return particles;
  };
  std::vector<std::vector<Index>> particles;
  for (Eigen::Index k = 0; k < modes.cols(); ++k) particles.push_back(moving(k));
  const auto apart = [](const std::vector<Index>& a, const std::vector<Index>& b) {
    std::vector<Index> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both.empty();
  };
  for (Eigen::Index k = 1; k <= modes.cols(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (k < modes.cols() && !apart(particles[at - 1], particles[at])) continue;
    LooseMotion piece;
    for (auto c = static_cast<std::size_t>(first); c < at; ++c) {
      std::vector<Index> sum;
      std::set_union(piece.particles.begin(), piece.particles.end(), particles[c].begin(), particles[c].end(),
                     std::back_inserter(sum));
      piece.particles = std::move(sum);
    }
    piece.dofs = pivot_dofs(modes.middleCols(first, k - first));
    found.push_back(std::move(piece));
    first = k;
  }
  return found;
}

#define PERIMODE_LOOSE(D)                                                                   \
  template class LooseSearch<D>;                                                            \
  template std::vector<LooseMotion> loose_motions<D>(const Body<D>&, const Equilibrium<D>&, \
                                                     const Eigen::VectorXd&)
PERIMODE_LOOSE(1);
PERIMODE_LOOSE(2);
PERIMODE_LOOSE(3);
#undef PERIMODE_LOOSE

}  // namespace perimode
