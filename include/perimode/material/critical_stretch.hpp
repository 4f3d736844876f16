// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perimode/material/micromodulus.hpp"

namespace perimode {

/// Energy of all bonds that cross a unit area of a crack at stretch s0, each counted once, J/m2: with the
/// energy c(r) s0^2 r/2 per bond (and volume squared) and the mean of |cos| over directions,
///   G0 = (s0^2/4) section int_0^delta c(r) r^2 <|cos|> S r^(n-1) dr,
/// <|cos|> = 1, 2/pi, 1/2 and S = 2, 2 pi, 4 pi in n = 1, 2, 3 dimensions. With c = c0 g(r) of the continuum
/// (micromodulus_constant), whatever the calibration of a body. The constant kernel gives
///   s0 = sqrt(5 G0/(9 K delta)) in 3D,  sqrt(5 pi G0/(12 E delta)) in plane strain.
/// Relative error < 1e-12. Throws invalid_input as micromodulus_constant.
[[nodiscard]] double fracture_energy(const Micromodulus& micromodulus, double youngs_modulus,
                                     double critical_stretch, double horizon, const Continuum& continuum);

/// Its inverse: the critical stretch s0 of a fracture energy G0 > 0 (J/m2).
[[nodiscard]] double critical_stretch(const Micromodulus& micromodulus, double youngs_modulus,
                                      double fracture_energy, double horizon, const Continuum& continuum);

}  // namespace perimode
