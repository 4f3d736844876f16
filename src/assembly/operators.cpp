// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/operators.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "block_form.hpp"
#include "bond_form.hpp"
#include "perimode/core/error.hpp"
#include "stencil.hpp"

namespace perimode {

namespace {

template <class Form>
LinearOperator shared_operator(Index size, Form form) {
  const auto held = std::make_shared<Form>(std::move(form));
  return {size, [held](const double* x, double* y) { held->apply(x, y); }};
}

template <class Form>
RowProduct shared_rows(Index size, Index pieces, bool in_place, Form form) {
  const auto held = std::make_shared<Form>(std::move(form));
  return {size, pieces, in_place, [held](const double* x, const std::function<void(const RowPiece&)>& take) {
            held->apply(x, take);
          }};
}

}  // namespace

template <int Dim>
StiffnessForm chosen_form(const Body<Dim>& body, StiffnessForm form) {
  const bool grid = std::holds_alternative<GridBonds<Dim>>(body.bonds);
  if (form == StiffnessForm::automatic) return grid ? StiffnessForm::stencil : StiffnessForm::bonds;
  if (form == StiffnessForm::stencil && !grid) {
    invalid_input({"a grid for the stencil form of K", "a cloud", "use the form bonds or blocks", {}});
  }
  return form;
}

template <int Dim>
LinearOperator stiffness_operator(const Body<Dim>& body, StiffnessForm form) {
  const Index size = body.boundary.free;
  switch (chosen_form(body, form)) {
    case StiffnessForm::blocks:
      return shared_operator(size, make_block_form(body));
    case StiffnessForm::bonds:
      return shared_operator(size, make_bond_form(body));
    default:
      return shared_operator(size, make_stencil(body));
  }
}

template <int Dim>
RowProduct stiffness_rows(const Body<Dim>& body, StiffnessForm form) {
  const Index size = body.boundary.free;
  switch (chosen_form(body, form)) {
    case StiffnessForm::blocks:
      return in_rows(stiffness_operator(body, StiffnessForm::blocks));
    case StiffnessForm::bonds: {
      auto bonds = make_bond_form(body);
      const Index pieces = bonds.pieces();
      const bool taken_in = !bonds.u.empty();
      return shared_rows(size, pieces, taken_in, std::move(bonds));
    }
    default: {
      auto stencil = make_stencil(body);
      const Index pieces = stencil.pieces;
      const bool in_place = stencil.in_place;
      return shared_rows(size, pieces, in_place, std::move(stencil));
    }
  }
}

template <int Dim>
double operator_bytes(const Body<Dim>& body, StiffnessForm form) {
  switch (chosen_form(body, form)) {
    case StiffnessForm::blocks:
      return block_form_bytes(body);
    case StiffnessForm::bonds:
      return bond_form_bytes(body);
    default:
      return make_stencil(body).bytes();
  }
}

template <int Dim>
Eigen::VectorXd internal_force(const Body<Dim>& body, const Eigen::VectorXd& displacement) {
  return internal_force(body, body.boundary, displacement);
}

template <int Dim>
Eigen::VectorXd internal_force(const Body<Dim>& body, const BoundaryMap<Dim>& boundary,
                               const Eigen::VectorXd& displacement) {
  Eigen::VectorXd force(displacement.size());
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < body.count(); ++i) {
    const Point<Dim> here = displacement.segment<Dim>(static_cast<Eigen::Index>(i) * Dim);
    Point<Dim> sum = Point<Dim>::Zero();
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const Point<Dim> n = end.xi / end.length;
      const Point<Dim> relative =
          here - partner_displacement(boundary, displacement.data(), end.neighbour, body.count());
      sum += bond_stiffness(body, i, end) * n.dot(relative) * n;
    });
    force.segment<Dim>(static_cast<Eigen::Index>(i) * Dim) = sum;
  }
  return force;
}

namespace {

/// Diagonal blocks of R K T, or with |k_b| in place of k_b.
template <int Dim, bool Absolute>
std::vector<double> blocks_of(const Body<Dim>& body) {
  const Index n = body.count();
  std::vector<double> blocks(static_cast<std::size_t>(n) * Dim * Dim, 0.0);
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < n; ++i) {
    double* block = blocks.data() + static_cast<std::size_t>(i) * Dim * Dim;
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const double signed_k = bond_stiffness(body, i, end);
      const double k = Absolute ? std::abs(signed_k) : signed_k;
      const Point<Dim> e = end.xi / end.length;
      Point<Dim> share = Point<Dim>::Ones();
      if (end.neighbour >= n) {
        for_each_image(body.boundary, static_cast<std::size_t>(end.neighbour - n),
                       [&](Index j, const double* coefficient) {
                         if (j == i) share -= Eigen::Map<const Point<Dim>>(coefficient);
                       });
      }
      for (int a = 0; a < Dim; ++a) {
        for (int b = 0; b < Dim; ++b) block[a * Dim + b] += k * e[a] * e[b] * share[b];
      }
    });
  }
  return blocks;
}

}  // namespace

template <int Dim>
std::vector<double> diagonal_blocks(const Body<Dim>& body) {
  return blocks_of<Dim, false>(body);
}

template <int Dim>
std::vector<double> absolute_blocks(const Body<Dim>& body) {
  return blocks_of<Dim, true>(body);
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
      const auto add = [&](Index j, const double* coefficient) {
        if (j == i) return;
        for (int b = 0; b < Dim; ++b) {
          if (number[static_cast<std::size_t>(j) * Dim + b] < 0) continue;
          for (int a = 0; a < Dim; ++a)
            sum[a] += std::abs(k) * std::abs(e[a] * e[b]) * std::abs(coefficient[b]);
        }
      };
      if (end.neighbour < n) {
        const Point<Dim> ones = Point<Dim>::Ones();
        add(end.neighbour, ones.data());
      } else {
        for_each_image(body.boundary, static_cast<std::size_t>(end.neighbour - n), add);
      }
    });
    for (int a = 0; a < Dim; ++a) {
      if (number[first + a] >= 0) largest = std::max(largest, sum[a]);
    }
  }
  return largest;
}

#define PERIMODE_OPERATORS(D)                                                                                \
  template StiffnessForm chosen_form<D>(const Body<D>&, StiffnessForm);                                      \
  template LinearOperator stiffness_operator<D>(const Body<D>&, StiffnessForm);                              \
  template RowProduct stiffness_rows<D>(const Body<D>&, StiffnessForm);                                      \
  template double operator_bytes<D>(const Body<D>&, StiffnessForm);                                          \
  template Eigen::VectorXd internal_force<D>(const Body<D>&, const Eigen::VectorXd&);                        \
  template Eigen::VectorXd internal_force<D>(const Body<D>&, const BoundaryMap<D>&, const Eigen::VectorXd&); \
  template std::vector<double> diagonal_blocks<D>(const Body<D>&);                                           \
  template std::vector<double> absolute_blocks<D>(const Body<D>&);                                           \
  template double stiffness_bound<D>(const Body<D>&)
PERIMODE_OPERATORS(1);
PERIMODE_OPERATORS(2);
PERIMODE_OPERATORS(3);
#undef PERIMODE_OPERATORS

}  // namespace perimode
