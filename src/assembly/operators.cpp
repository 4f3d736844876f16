// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/operators.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "perimode/assembly/assemble.hpp"

namespace perimode {

namespace {

/// Displacements of particles and ghosts side by side, ghosts by the affine map with its given values.
template <int Dim>
Eigen::VectorXd with_ghosts(const Body<Dim>& body, const Eigen::VectorXd& u) {
  const auto ghosts = static_cast<Eigen::Index>(body.boundary.image.size());
  Eigen::VectorXd all(u.size() + ghosts * Dim);
  all.head(u.size()) = u;
  for (Eigen::Index g = 0; g < ghosts; ++g) {
    for (int a = 0; a < Dim; ++a) {
      const std::size_t d = static_cast<std::size_t>(g) * Dim + a;
      all[u.size() + g * Dim + a] =
          body.boundary.coefficient[d] * u[static_cast<Eigen::Index>(body.boundary.image[g]) * Dim + a] +
          body.boundary.value[d];
    }
  }
  return all;
}

/// Scalar rows of the assembled matrix; fixed dofs struck out.
template <int Dim>
LinearOperator assembled_operator(const Body<Dim>& body) {
  const auto matrix =
      std::make_shared<const Csr>(scalar_csr(assemble_stiffness(body), body.boundary.free_number));
  return {matrix->rows, [matrix](const double* x, double* y) { as_operator(*matrix).apply(x, y); }};
}

}  // namespace

template <int Dim>
LinearOperator stiffness_operator(const Body<Dim>& body, StiffnessForm /*form*/) {
  return assembled_operator(body);
}

template <int Dim>
double operator_bytes(const Body<Dim>& body, StiffnessForm /*form*/) {
  return 2.0 * static_cast<double>(count_bonds(body.bonds, body.count())) * (4.0 + 8.0 * Dim * Dim);
}

template <int Dim>
Eigen::VectorXd internal_force(const Body<Dim>& body, const Eigen::VectorXd& displacement) {
  const Eigen::VectorXd u = with_ghosts(body, displacement);
  Eigen::VectorXd force(displacement.size());
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < body.count(); ++i) {
    const Point<Dim> here = u.segment<Dim>(static_cast<Eigen::Index>(i) * Dim);
    Point<Dim> sum = Point<Dim>::Zero();
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const Point<Dim> n = end.xi / end.length;
      const Point<Dim> relative = here - u.segment<Dim>(static_cast<Eigen::Index>(end.neighbour) * Dim);
      sum += bond_stiffness(body, i, end) * n.dot(relative) * n;
    });
    force.segment<Dim>(static_cast<Eigen::Index>(i) * Dim) = sum;
  }
  return force;
}

template <int Dim>
std::vector<double> diagonal_blocks(const Body<Dim>& body) {
  const Index n = body.count();
  std::vector<double> blocks(static_cast<std::size_t>(n) * Dim * Dim, 0.0);
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < n; ++i) {
    double* block = blocks.data() + static_cast<std::size_t>(i) * Dim * Dim;
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const double k = bond_stiffness(body, i, end);
      const Point<Dim> e = end.xi / end.length;
      const bool own =
          end.neighbour >= n && body.boundary.image[static_cast<std::size_t>(end.neighbour - n)] == i;
      const double* coefficient =
          own ? body.boundary.coefficient.data() + static_cast<std::size_t>(end.neighbour - n) * Dim
              : nullptr;
      for (int a = 0; a < Dim; ++a) {
        for (int b = 0; b < Dim; ++b)
          block[a * Dim + b] += k * e[a] * e[b] * (own ? 1.0 - coefficient[b] : 1.0);
      }
    });
  }
  return blocks;
}

template <int Dim>
double stiffness_bound(const Body<Dim>& body) {
  const Index n = body.count();
  const auto& number = body.boundary.free_number;
  const std::vector<double> blocks = diagonal_blocks(body);
  double largest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (Index i = 0; i < n; ++i) {
    const std::size_t first = static_cast<std::size_t>(i) * Dim;
    Point<Dim> sum = Point<Dim>::Zero();
    for (int a = 0; a < Dim; ++a) {
      for (int b = 0; b < Dim; ++b)
        sum[a] += number[first + b] < 0 ? 0.0 : std::abs(blocks[(first + a) * Dim + b]);
    }
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const double k = bond_stiffness(body, i, end);
      const Point<Dim> e = end.xi / end.length;
      const bool ghost = end.neighbour >= n;
      const auto g = static_cast<std::size_t>(ghost ? end.neighbour - n : 0);
      const Index j = ghost ? body.boundary.image[g] : end.neighbour;
      if (j == i) return;
      for (int b = 0; b < Dim; ++b) {
        if (number[static_cast<std::size_t>(j) * Dim + b] < 0) continue;
        const double coefficient = ghost ? std::abs(body.boundary.coefficient[g * Dim + b]) : 1.0;
        for (int a = 0; a < Dim; ++a) sum[a] += k * std::abs(e[a] * e[b]) * coefficient;
      }
    });
    for (int a = 0; a < Dim; ++a) {
      if (number[first + a] >= 0) largest = std::max(largest, sum[a]);
    }
  }
  return largest;
}

#define PERIMODE_OPERATORS(D)                                                         \
  template LinearOperator stiffness_operator<D>(const Body<D>&, StiffnessForm);       \
  template double operator_bytes<D>(const Body<D>&, StiffnessForm);                   \
  template Eigen::VectorXd internal_force<D>(const Body<D>&, const Eigen::VectorXd&); \
  template std::vector<double> diagonal_blocks<D>(const Body<D>&);                    \
  template double stiffness_bound<D>(const Body<D>&)
PERIMODE_OPERATORS(1);
PERIMODE_OPERATORS(2);
PERIMODE_OPERATORS(3);
#undef PERIMODE_OPERATORS

}  // namespace perimode
