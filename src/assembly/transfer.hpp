// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "perimode/assembly/body.hpp"

namespace perimode {

/// Displacements between the free dofs of a grid body and of its coarse one (coarsen), cell-centred and
/// linear per axis: a fine cell takes 3/4 from its parent and 1/4 from the parent's neighbour on its side.
/// Beyond faces stand the ghosts and periodic images of the coarse body, fixed dofs count as 0, absent cells
/// not at all, nor cells whose bond to the parent is broken: the weights of the others are scaled to the
/// sum 1. Not for two threads at a time.
template <int Dim>
class Transfer {
 public:
  /// Both bodies have to outlive it.
  Transfer(const Body<Dim>& fine, const Body<Dim>& coarse);

  /// coarse = P^T (b - q), gathered row by row: the same bits for any number of threads. One pass over b and
  /// q.
  void restrict_difference(const double* b, const double* q, double* coarse);
  /// x += P coarse. One pass over x.
  void add_prolonged(const double* coarse, double* x);

  [[nodiscard]] double bytes() const;

 private:
  /// A cell beyond the coarse grid and the particle it follows.
  struct Echo {
    Index cell;
    Index particle;
    std::array<double, Dim> coefficient;
  };

  /// A fine particle that a crack parts from some of the coarse cells around it, and its weights of the
  /// others.
  struct Parted {
    Index particle;
    std::array<Index, 1 << Dim> cell;
    std::array<double, 1 << Dim> weight;
  };

  void find_parted(const std::vector<Index>& coarse_at);
  void spread(const double* coarse);
  /// use(first particle, row of interpolated values of its row's cells) for every fine row, in parallel.
  template <class Use>
  void for_each_prolonged_row(const Use& use);

  const Body<Dim>& fine_;
  const Body<Dim>& coarse_;
  std::array<Index, Dim> cells_;        ///< of the fine grid
  std::array<Index, Dim> frame_cells_;  ///< of the coarse grid with one more on every side
  Index rows_ = 0;                      ///< of fine cells
  Index width_ = 0;                     ///< numbers per fine row, of twice the coarse number of cells
  Index frame_rows_ = 0;
  std::vector<Index> first_in_row_;  ///< first fine particle of each row, rows + 1
  std::vector<char> plain_row_;      ///< all cells there, all dofs free
  std::vector<double> scale_;      ///< per fine particle: 1 / sum of the weights of the cells that are there
  std::vector<Index> frame_cell_;  ///< of each coarse particle
  std::vector<Echo> echoes_;
  std::vector<Parted> parted_;  ///< their scale_ is 0
  std::vector<double> frame_;   ///< coarse values in the frame, 0 where nothing is
  std::vector<double> gather_;  ///< the same for restriction
  std::vector<double> dense_;   ///< fine residuals by cell
};

}  // namespace perimode
