// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perimode/bonds/family.hpp"
#include "perimode/core/types.hpp"
#include "perimode/material/material.hpp"

namespace perimode {

/// What bounds one axis of a separable body: two mirror walls (in 1D: odd), two antimirror walls (1D:
/// even), one of each, or periodicity.
enum class Ends { mirror, antimirror, mixed, periodic };

/// One wave number along one axis of a cell-centred grid, and who can carry it. Along a mirrored axis the
/// normal component is a sine and the tangential ones are cosines, along an antimirrored axis the reverse;
/// a sine dies at k = 0, a cosine at k = pi/spacing.
struct AxisWave {
  double k = 0.0;          ///< rad/m
  int multiplicity = 1;    ///< 2: k and -k of a periodic axis
  bool normal = true;      ///< the component along the axis exists
  bool tangential = true;  ///< the components across the axis exist
};

/// All wave numbers of `cells` cells over `length` (m), ascending: mirror and antimirror pi P/length with
/// P = 0..cells; mixed pi (P - 1/2)/length with P = 1..cells; periodic 2 pi P/length, P = 0..cells/2.
[[nodiscard]] std::vector<AxisWave> axis_waves(Ends ends, double length, int cells);

/// Eigenvalue lambda (1/m2), omega^2 = v^2 lambda, of the scalar lattice u'' = v^2 sum_j C_j beta_j V (u_j -
/// u_i) for the wave vector k: sum_j C_j beta_j V (1 - cos k.xi_j), with C = a g(r)/r and a such that the
/// continuum carries long waves at speed v. In 1D this is the bar, sum_j 4 g_j sin^2(j k dx/2) for all walls
/// [scabbia2023]; in 2D and 3D the membrane-like scalar model, exact for sin sin and cos cos.
template <int Dim>
[[nodiscard]] double lattice_lambda(const Micromodulus& micromodulus, const Family<Dim>& family,
                                    const Point<Dim>& k);

/// The same of the continuum: 1D 4 int_0^delta C sin^2(k r/2) dr; 2D 2 pi int C (1 - J0(k r)) r dr; 3D
/// 4 pi int C (1 - sin(k r)/(k r)) r^2 dr. Relative error < 1e-13.
[[nodiscard]] double continuum_lambda(const Micromodulus& micromodulus, double horizon, int dimension,
                                      double k);

/// continuum_lambda of the 1D inverse-distance kernel in closed form,
/// (2/delta^2) (k delta Si(k delta) + cos(k delta) - 1): [scabbia2023] eq. (12) with its sign mended.
[[nodiscard]] double scabbia_lambda(double horizon, double k);

}  // namespace perimode
