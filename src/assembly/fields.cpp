// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/fields.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <utility>

namespace perimode {

namespace {

/// Below this share of the largest spread of a particle's bonds a direction counts as not spanned.
constexpr double spanned = 1e-10;

/// Row and column of each tensor component.
template <int Dim>
constexpr auto tensor_entries() {
  if constexpr (Dim == 1) return std::array<std::pair<int, int>, 1>{{{0, 0}}};
  if constexpr (Dim == 2) return std::array<std::pair<int, int>, 3>{{{0, 0}, {1, 1}, {0, 1}}};
  if constexpr (Dim == 3)
    return std::array<std::pair<int, int>, 6>{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
}

template <int Dim>
void put(const Eigen::Matrix<double, Dim, Dim>& tensor, Index i, Eigen::MatrixXd& field) {
  int c = 0;
  for (const auto& [a, b] : tensor_entries<Dim>()) field(c++, i) = 0.5 * (tensor(a, b) + tensor(b, a));
}

/// Calls visit(end, eta) for the alive bonds of particle i.
template <int Dim, class Visit>
void for_each_extension(const Body<Dim>& body, const Eigen::VectorXd& u, Index i, bool given, Visit&& visit) {
  const Point<Dim> here = u.segment<Dim>(static_cast<Eigen::Index>(i) * Dim);
  for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
    const Point<Dim> eta =
        partner_displacement(body.boundary, u.data(), end.neighbour, body.count(), given) - here;
    visit(end, eta);
  });
}

/// Whether a ghost moves as the mirror image of its particle, with or without a change of sign: then the
/// ghost of i seen from its image has the same stretch.
template <int Dim>
std::vector<bool> mirrored_ghosts(const Body<Dim>& body) {
  const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds);
  std::vector<bool> mirrored(grid == nullptr ? 0 : grid->ghosts.size());
  for (std::size_t g = 0; g < mirrored.size(); ++g) {
    double sign = 0.0;
    mirrored[g] = true;
    for (int a = 0; a < Dim; ++a) {
      const auto& crossings = grid->ghosts[g].crossings;
      const double reflection = (crossings[2 * a] + crossings[2 * a + 1]) % 2 == 0 ? 1.0 : -1.0;
      const double c = body.boundary.coefficient[g * Dim + static_cast<std::size_t>(a)] * reflection;
      if (a == 0) sign = c;
      if (c != sign || (c != 1.0 && c != -1.0)) mirrored[g] = false;
    }
    // Surface nodes: the ghosts of one face follow the same particles and have no pairs.
    if (body.boundary.image[g] != grid->ghosts[g].image || !body.boundary.more_start.empty())
      return std::vector<bool>(mirrored.size(), false);
  }
  return mirrored;
}

}  // namespace

template <int Dim>
Eigen::MatrixXd strain(const Body<Dim>& body, const Eigen::VectorXd& displacement) {
  using Tensor = Eigen::Matrix<double, Dim, Dim>;
  Eigen::MatrixXd field(tensor_components<Dim>, body.count());
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < body.count(); ++i) {
    Tensor shape = Tensor::Zero();
    Tensor moment = Tensor::Zero();
    for_each_extension(body, displacement, i, true, [&](const BondEnd<Dim>& end, const Point<Dim>& eta) {
      const Index j = owner(body.bonds, end.neighbour, body.count());
      const double w = end.weight * body.particles.volume[static_cast<std::size_t>(j)];
      shape += w * end.xi * end.xi.transpose();
      moment += w * eta * end.xi.transpose();
    });
    // H = moment shape^-1 on what the bonds span, P its projector.
    const Eigen::SelfAdjointEigenSolver<Tensor> axes(shape);
    Tensor inverse = Tensor::Zero();
    Tensor projector = Tensor::Zero();
    int rank = 0;
    for (int k = 0; k < Dim; ++k) {
      const double spread = axes.eigenvalues()[k];
      if (!(spread > spanned * axes.eigenvalues()[Dim - 1])) continue;
      const Point<Dim> axis = axes.eigenvectors().col(k);
      inverse += axis * axis.transpose() / spread;
      projector += axis * axis.transpose();
      ++rank;
    }
    const Tensor gradient = moment * inverse;
    const Tensor symmetric = 0.5 * (gradient + gradient.transpose());
    put<Dim>(rank == Dim ? symmetric : Tensor(projector * symmetric * projector), i, field);
  }
  return field;
}

template <int Dim>
Eigen::MatrixXd stress(const Body<Dim>& body, const Eigen::VectorXd& displacement) {
  using Tensor = Eigen::Matrix<double, Dim, Dim>;
  Eigen::MatrixXd field(tensor_components<Dim>, body.count());
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < body.count(); ++i) {
    Tensor sum = Tensor::Zero();
    for_each_extension(body, displacement, i, true, [&](const BondEnd<Dim>& end, const Point<Dim>& eta) {
      const Point<Dim> n = end.xi / end.length;
      sum += bond_stiffness(body, i, end) * n.dot(eta) * end.length * (n * n.transpose());
    });
    put<Dim>(sum / (2.0 * body.particles.volume[static_cast<std::size_t>(i)]), i, field);
  }
  return field;
}

template <int Dim>
Eigen::VectorXd damage(const Body<Dim>& body) {
  Eigen::VectorXd field(body.count());
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < body.count(); ++i) {
    const auto weight = [&](Which which) {
      double sum = 0.0;
      for_each_bond(body.bonds, i, which, [&](const BondEnd<Dim>& end) {
        if (end.neighbour == i) return;  // its own periodic image: carries no force and cannot break
        const Index j = owner(body.bonds, end.neighbour, body.count());
        sum += end.weight * body.particles.volume[static_cast<std::size_t>(j)];
      });
      return sum;
    };
    const double present = weight(Which::present);
    field[i] = present > 0.0 ? 1.0 - weight(Which::alive) / present : 0.0;
  }
  return field;
}

template <int Dim>
Eigen::VectorXd energy_density(const Body<Dim>& body, const Eigen::VectorXd& displacement) {
  const std::vector<bool> mirrored = mirrored_ghosts(body);
  Eigen::VectorXd field(body.count());
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < body.count(); ++i) {
    const Point<Dim> here = displacement.segment<Dim>(static_cast<Eigen::Index>(i) * Dim);
    double sum = 0.0;
    for_each_extension(body, displacement, i, false, [&](const BondEnd<Dim>& end, const Point<Dim>& eta) {
      const Point<Dim> n = end.xi / end.length;
      const double k = bond_stiffness(body, i, end);
      const double extension = n.dot(eta);
      const bool shared =
          end.neighbour < body.count() || mirrored[static_cast<std::size_t>(end.neighbour - body.count())];
      sum += shared ? 0.25 * k * extension * extension : -0.5 * k * n.dot(here) * extension;
    });
    field[i] = sum / body.particles.volume[static_cast<std::size_t>(i)];
  }
  return field;
}

#define PERIMODE_FIELDS(D)                                                    \
  template Eigen::MatrixXd strain<D>(const Body<D>&, const Eigen::VectorXd&); \
  template Eigen::MatrixXd stress<D>(const Body<D>&, const Eigen::VectorXd&); \
  template Eigen::VectorXd damage<D>(const Body<D>&);                         \
  template Eigen::VectorXd energy_density<D>(const Body<D>&, const Eigen::VectorXd&)
PERIMODE_FIELDS(1);
PERIMODE_FIELDS(2);
PERIMODE_FIELDS(3);
#undef PERIMODE_FIELDS

}  // namespace perimode
