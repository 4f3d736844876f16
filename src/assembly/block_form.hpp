// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/linalg/sparse.hpp"

namespace perimode {

/// K as blocked rows over all dofs of the particles; fixed ones are zero on the way in and left out on the
/// way out.
template <int Dim>
struct BlockForm {
  const BoundaryMap<Dim>* boundary = nullptr;
  BlockCsr matrix;
  std::vector<double> u, f;  ///< work; empty where all dofs are free

  /// y = K x over the free dofs.
  void apply(const double* x, double* y);
};

template <int Dim>
[[nodiscard]] BlockForm<Dim> make_block_form(const Body<Dim>& body);

/// Bytes that the block form of a body takes. Cost O(bond ends log family).
template <int Dim>
[[nodiscard]] double block_form_bytes(const Body<Dim>& body);

/// Sums the rows of some particles anew after bonds of theirs broke: the values fill_stiffness would give, to
/// the last bit, and zeros where a column has no bond left. Cost O(family) per row.
template <int Dim>
void refill_rows(const Body<Dim>& body, std::span<const Index> particles, BlockCsr& matrix);

/// The form that `automatic` stands for. Throws invalid_input for the stencil of a cloud.
template <int Dim>
[[nodiscard]] StiffnessForm chosen_form(const Body<Dim>& body, StiffnessForm form);

}  // namespace perimode
