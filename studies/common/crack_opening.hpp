// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/assembly/body.hpp"
#include "perimode/fracture/griffith.hpp"
#include "perimode/fracture/quasistatic.hpp"

namespace perimode::studies {

// The crack opening of [ganzenmueller2013], section 5, with parameters of our own, since the paper's are
// lost: a patch 1 m wide and 2 m high (|y| <= 1) in plane strain, E = 1e5 Pa, G0 = 0.358 J/m2, with an edge
// crack along y = 0 from x = 0 to x = 1/4, pulled by a traction on its upper and its lower row of particles.
// Bonds have the energy density c s^2/2 (inverse-distance kernel, all bonds within the horizon counted
// whole).

inline constexpr double opening_crack = 0.25;  ///< length of the crack, m

/// `cells` along x, a multiple of 4; horizon of `ratio` spacings. Rigid motion is held at the two particles
/// next to y = 0 on the right side (x and y of the upper, x of the lower one).
[[nodiscard]] Model crack_opening_patch(int cells, double ratio, Calibration calibration);

/// Event-driven run of that patch under tractions of 1 Pa, so that load factors are Pa. Bonds less than
/// three horizons from the loaded rows do not break; critical stretch of G0, each bond counted once.
[[nodiscard]] QuasistaticOptions crack_opening_run(const Model& model, const Body<2>& body);

/// Critical traction of linear elastic fracture mechanics for a crack of length a < 0.6 m, Pa [tada1973]:
///   sigma = sqrt(G0 E/(1 - nu^2)) / (sqrt(pi a) (1.12 - 0.231 a + 10.55 a^2 - 21.72 a^3 + 30.39 a^4)).
[[nodiscard]] double crack_opening_stress(double a);

/// The Griffith load of that patch by the compliance of a crack longer by one spacing, Pa.
[[nodiscard]] GriffithLoad crack_opening_griffith(const Model& model);

/// A load of the Griffith criterion over crack_opening_stress in the middle of its increment of one spacing.
[[nodiscard]] double griffith_ratio(const GriffithLoad& load, int cells);

}  // namespace perimode::studies
