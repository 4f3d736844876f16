// SPDX-License-Identifier: BSD-3-Clause
#include "block_form.hpp"

#include <algorithm>

#include "perimode/assembly/assemble.hpp"

namespace perimode {

namespace {

template <int Dim>
bool all_free(const BoundaryMap<Dim>& boundary) {
  return static_cast<std::size_t>(boundary.free) == boundary.free_number.size();
}

/// Particles that bonds of particle i meet, directly or through ghosts, and i itself.
template <int Dim>
Offset columns_of(const Body<Dim>& body, Index i) {
  std::vector<Index> column = {i};
  for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
    if (end.neighbour < body.count()) {
      column.push_back(end.neighbour);
    } else {
      for_each_image(body.boundary, static_cast<std::size_t>(end.neighbour - body.count()),
                     [&](Index j, const double*) { column.push_back(j); });
    }
  });
  std::sort(column.begin(), column.end());
  return std::unique(column.begin(), column.end()) - column.begin();
}

}  // namespace

template <int Dim>
void BlockForm<Dim>::apply(const double* x, double* y) {
  if (u.empty()) {
    const auto dofs = boundary->free_number.size();
    return multiply(matrix, {x, dofs}, {y, dofs});
  }
  const auto dofs = static_cast<Offset>(u.size());
#pragma omp parallel for schedule(static)
  for (Offset d = 0; d < dofs; ++d) u[d] = boundary->free_number[d] < 0 ? 0.0 : x[boundary->free_number[d]];
  multiply(matrix, u, f);
#pragma omp parallel for schedule(static)
  for (Offset d = 0; d < dofs; ++d)
    if (boundary->free_number[d] >= 0) y[boundary->free_number[d]] = f[d];
}

template <int Dim>
BlockForm<Dim> make_block_form(const Body<Dim>& body) {
  BlockForm<Dim> form{&body.boundary, assemble_stiffness(body), {}, {}};
  if (!all_free(body.boundary)) {
    form.u.resize(body.boundary.free_number.size());
    form.f.resize(body.boundary.free_number.size());
  }
  return form;
}

template <int Dim>
double block_form_bytes(const Body<Dim>& body) {
  Offset blocks = 0;
#pragma omp parallel for schedule(static) reduction(+ : blocks)
  for (Index i = 0; i < body.count(); ++i) blocks += columns_of(body, i);
  const double dofs = all_free(body.boundary) ? 0.0 : static_cast<double>(body.boundary.free_number.size());
  return static_cast<double>(blocks) * (sizeof(Index) + Dim * Dim * sizeof(double)) +
         (body.count() + 1.0) * sizeof(Offset) + 2.0 * dofs * sizeof(double) + sizeof(BlockForm<Dim>);
}

#define PERIMODE_BLOCK_FORM(D)                              \
  template struct BlockForm<D>;                             \
  template BlockForm<D> make_block_form<D>(const Body<D>&); \
  template double block_form_bytes<D>(const Body<D>&)
PERIMODE_BLOCK_FORM(1);
PERIMODE_BLOCK_FORM(2);
PERIMODE_BLOCK_FORM(3);
#undef PERIMODE_BLOCK_FORM

}  // namespace perimode
