// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "perimode/reference/separation.hpp"

namespace perimode {

/// One standing wave of a bar, (sine sin(k x) + cosine cos(k x)) cos(omega t), m.
struct StandingWave {
  double k = 0.0;       ///< rad/m
  double sine = 0.0;    ///< m
  double cosine = 0.0;  ///< m
  double omega = 0.0;   ///< rad/s
};

/// omega(k), rad/s: v k for classical elasticity, v sqrt(scabbia_lambda) or v sqrt(continuum_lambda) for the
/// peridynamic continuum, v sqrt(lattice_lambda) for a lattice, stepped_frequency of it for one that is
/// stepped.
using DispersionRelation = std::function<double(double k)>;

/// The motion of a bar 0 <= x <= length on a lattice of u0.size() cells, let go at t = 0 from the
/// displacements u0 (m) of the cell centres at rest. Exact on the lattice: mirror (u odd about both ends)
/// sines, antimirror (even) cosines, mixed (odd about x = 0, even about x = length) sines of quarter waves;
/// amplitudes from their discrete orthogonality. Cost O(cells^2). Throws invalid_input for periodic ends.
[[nodiscard]] std::vector<StandingWave> released_lattice(Ends ends, double length, std::span<const double> u0,
                                                         const DispersionRelation& omega);

/// The motion of a bar held at both ends, let go at rest from height exp(-((x - centre)/width)^2), as `terms`
/// sines with amplitudes (2/length) int u0 sin(k x) dx, the integral taken over all x: right to the size of
/// the pulse at the ends. [scabbia2023] eq. (11) is height 0.02, centre 1/2, width 0.1, length 1.
[[nodiscard]] std::vector<StandingWave> released_pulse(double length, double height, double centre,
                                                       double width, int terms,
                                                       const DispersionRelation& omega);

/// Displacement (m) of the sum of the waves.
[[nodiscard]] double displacement(std::span<const StandingWave> waves, double x, double t);

/// Strain over the segment from a to b: (u(b) - u(a))/(b - a), without cancellation.
[[nodiscard]] double strain(std::span<const StandingWave> waves, double a, double b, double t);

/// What central differences with step dt make of an oscillation: (2/dt) asin(omega dt/2).
/// @pre omega dt <= 2.
[[nodiscard]] double stepped_frequency(double omega, double dt);

/// Strain at x of a classical bar with speed `speed`, fixed at 0 and free at `length`, let go at rest from
/// the uniform strain 1: the mean of two square waves of period 4 length/speed, [bouaraquia2024] eq. (56)
/// summed. Halves at jumps.
[[nodiscard]] double snapped_bar_strain(double length, double speed, double x, double t);

}  // namespace perimode
