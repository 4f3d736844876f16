// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/linalg/row_product.hpp"

namespace perimode {

/// K as its alive bonds: per bond end the vector b = sqrt|k_b| n and the partner. Ends of negative k_b come
/// last in every particle's list.
template <int Dim>
struct BondForm {
  const Body<Dim>* body = nullptr;
  std::vector<Offset> start;     ///< of each particle's ends
  std::vector<Index> ends;       ///< how many it has
  std::vector<Index> positive;   ///< how many of them have k_b >= 0; empty: all of all particles
  std::vector<Index> neighbour;  ///< from the number of particles on: ghosts
  std::vector<double> b;         ///< Dim per end, sqrt(N/m)
  std::vector<double> u;         ///< work: displacements of all particles and ghosts; empty: those given

  /// y = K x over the free dofs: (K u)_i = sum_b +-b (b . (u_i - u_j)).
  void apply(const double* x, double* y);
  /// The same piece by piece. Displacements that are taken into `u` first leave x to `take`.
  void apply(const double* x, const std::function<void(const RowPiece&)>& take);
  [[nodiscard]] Index pieces() const;

  /// Takes out an alive end of a particle; those after it close up. Cost O(family). @pre the bond is still
  /// alive in the body.
  void remove(Index particle, Offset slot);
};

/// Cost O(bond ends). `body` has to outlive it.
template <int Dim>
[[nodiscard]] BondForm<Dim> make_bond_form(const Body<Dim>& body);

/// Bytes that the bond form of a body takes. Cost O(bond ends).
template <int Dim>
[[nodiscard]] double bond_form_bytes(const Body<Dim>& body);

}  // namespace perimode
