// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "perimode/assembly/body.hpp"
#include "perimode/assembly/operators.hpp"
#include "perimode/bonds/bonds.hpp"
#include "perimode/linalg/operator.hpp"
#include "perimode/linalg/row_product.hpp"
#include "perimode/linalg/sparse.hpp"

namespace perimode {

/// A bond by one of its ends.
struct BondRef {
  Index particle = 0;
  Offset slot = 0;
  bool operator==(const BondRef&) const = default;
};

/// A bond as seen from the end that names it. Cost O(1). @pre it is present.
template <int Dim>
[[nodiscard]] BondEnd<Dim> bond_end(const Body<Dim>& body, const BondRef& bond);

/// Bonds as they break: each once, by its lower end. Where walls mirror the body, a bond to a ghost has an
/// image, the bond of the ghost's particle to the ghost of this one, that breaks with it (beyond an
/// antimirror wall it is compressed as much as the bond is stretched): both are listed, the two next to each
/// other. Ghosts that stand still have none. Sorted by particle and slot of the first of each. Bonds that are
/// not alive are left out. Cost O(bonds log bonds).
template <int Dim>
[[nodiscard]] std::vector<BondRef> with_images(const Body<Dim>& body, std::vector<BondRef> bonds);

/// The low-rank term of bonds in R K T over the free dofs by the sign of k_b: when they break, K loses
/// sum c c^T over `positive` and gains it over `negative`.
struct BondColumns {
  SparseColumns positive, negative;
  [[nodiscard]] Index count() const { return positive.count() + negative.count(); }
};

/// sum_b +-c_b c_b^T, c_b = sqrt|k_b| [n; -n]. A bond and its image (with_images) make one column, n of the
/// one end and the ghost's own of the other; bonds between dofs that are not free make none. Symmetric
/// boundaries only. `bonds` as with_images returns them. Cost O(bonds).
template <int Dim>
[[nodiscard]] BondColumns bond_columns(const Body<Dim>& body, std::span<const BondRef> bonds);

/// K of a body whose bonds break, in one of its forms, which follows in place: the stencil by alive bits and
/// the runs of the particles concerned, the bond form by closing up their ends, blocks by summing their rows
/// anew. Equal to the operator made of the body anew, to the last bit (the stencil: to round-off, since more
/// particles may count as partial). `body` has to outlive it.
template <int Dim>
class BreakableStiffness {
 public:
  /// Throws invalid_input for the stencil of a cloud.
  explicit BreakableStiffness(Body<Dim>& body, StiffnessForm form = StiffnessForm::automatic);
  ~BreakableStiffness();
  BreakableStiffness(BreakableStiffness&&) noexcept;
  BreakableStiffness& operator=(BreakableStiffness&&) noexcept;
  BreakableStiffness(const BreakableStiffness&) = delete;
  BreakableStiffness& operator=(const BreakableStiffness&) = delete;

  /// R K T as it is at every product; valid while this object lives (it may move).
  [[nodiscard]] LinearOperator product() const;
  /// The same piece by piece, in pieces that stay as they are.
  [[nodiscard]] RowProduct rows() const;

  /// Clears the bonds in the body, at both ends, and takes them out of the form; those that are not alive are
  /// left alone. Cost O(family) per bond; the stencil moves its list of runs (a few per row of cells).
  void break_bonds(std::span<const BondRef> bonds);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace perimode
