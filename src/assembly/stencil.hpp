// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/linalg/row_product.hpp"

namespace perimode {

/// How the products of a run of particles are summed. whole: every family member there and alive, one
/// stiffness. partial: bonds missing, broken or scaled by different calibration factors, one material. mixed:
/// several materials.
enum class Families : std::uint8_t { whole, partial, mixed };

/// Particles of a run whose products are summed at a time: they stay in the first cache.
constexpr Index stencil_piece = 256;

/// Consecutive particles of one row of cells, their bonds summed alike.
struct ParticleRun {
  Index cell = 0;      ///< of the first one within its layer of the padded grid
  Index particle = 0;  ///< first
  Index count = 0;
  Index dof = -1;   ///< number of the first free dof where all are free; -1: by particle
  Index set = 0;    ///< vectors b of the family
  Index piece = 0;  ///< number of its first piece
  Families families = Families::whole;
};

/// Consecutive cells of one row of the padded grid, filled alike.
struct FillRun {
  enum class What : std::uint8_t { nothing, free, particles, ghosts };
  Index cell = 0;
  Index count = 0;
  Index first = 0;  ///< free: number of the first dof; particles, ghosts: of the first one
  What what = What::nothing;
};

/// K of a grid without a matrix. A layer is a row of cells in 2D, a plane in 3D, everything in 1D; the
/// displacements of the layers in reach are kept while a product moves through the body.
template <int Dim>
struct Stencil {
  const Body<Dim>* body = nullptr;
  const GridBonds<Dim>* bonds = nullptr;
  Index layers = 0;                              ///< of the body
  int reach = 0;                                 ///< layers a bond can cross
  Index layer_cells = 0;                         ///< cells of a padded layer
  std::ptrdiff_t stride = 0;                     ///< numbers of a component of a layer
  std::vector<int> pair;                         ///< family member of each pair (StencilPairs)
  std::vector<int> pair_start;                   ///< per pattern of components
  std::vector<double> b;                         ///< sqrt|k_b| n per set, pair and component
  bool some_negative = false;                    ///< softening(body); then the pairs of a set are in
                                                 ///< an order of its own, negative ones last in a pattern
  std::vector<int> signed_pair;                  ///< as `pair`, per set
  std::vector<int> negative;                     ///< StencilPairs::negative, per set
  std::map<std::pair<int, double>, Index> sets;  ///< by material and calibration factor
  std::vector<double> factor;                    ///< calibration factors over the padded grid; empty: all 1
  std::vector<ParticleRun> run;
  std::vector<Index> layer_run;  ///< first run of each layer
  std::vector<FillRun> fill;
  std::vector<Index> layer_fill;  ///< first filling of each padded layer
  Index pieces = 0;
  bool in_place = true;  ///< ghosts follow particles of their own layer, or lie beyond the last ones

  /// Memory of one thread.
  struct Work {
    std::vector<double> window;        ///< displacements of 2 reach + 1 layers
    std::vector<double> beyond;        ///< and of the `reach` layers above those of this thread
    std::vector<const double*> layer;  ///< the layers in reach, the lowest first
    std::vector<const double*> at;     ///< per family member
    std::vector<std::uint64_t> lanes;  ///< alive bits
    std::vector<double> out;           ///< K u of a piece of a run
    std::vector<double> rows;          ///< the same by free dof
  };
  std::vector<Work> work;

  /// Parts of a product that threads take, and memory for them.
  [[nodiscard]] Index chunks() const;
  void prepare(Index chunks);
  /// y = K x over the free dofs.
  void apply(const double* x, double* y);
  /// The same piece by piece; x may be changed by `take` (RowProduct::in_place): the window has taken it in.
  void apply(const double* x, const std::function<void(const RowPiece&)>& take);
  /// Bytes held besides the body, with work for the present number of threads.
  [[nodiscard]] double bytes() const;
};

/// Cost O(bond ends). `body` has to outlive the stencil. @pre a grid.
template <int Dim>
[[nodiscard]] Stencil<Dim> make_stencil(const Body<Dim>& body);

/// A particle whose family was whole has lost bonds: it and others of its group are summed as partial from
/// now on. Numbers of pieces are not renewed, so products piece by piece are over. Cost O(log runs + layers)
/// and moving the runs that follow.
template <int Dim>
void family_no_longer_whole(Stencil<Dim>& stencil, Index particle);

}  // namespace perimode
