// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/bonds/family.hpp"
#include "perimode/material/material.hpp"

namespace perimode {

/// What a micromodulus is calibrated for: the dimension and, in 2D, the plane; `section` is the
/// thickness (2D, m), the area (1D, m2) or 1 (3D).
struct Continuum {
  int dimension = 3;
  Plane plane = Plane::stress;
  double section = 1.0;
};

/// Poisson's ratio the bond-based theory fixes: 1/3 plane stress, 1/4 plane strain and 3D, 0 in 1D.
[[nodiscard]] double poissons_ratio(const Continuum& continuum);

/// Strain energy density of the unit uniform dilation strain (J/m3 = Pa) in classical elasticity:
/// 1D E/2, plane stress 3E/2, plane strain 8E/5, 3D 3E. A body stretched by s in all directions stores s^2
/// times that.
[[nodiscard]] double dilation_energy(double youngs_modulus, const Continuum& continuum);

/// g(r) of the kernel (dimensionless); 0 beyond the horizon for the conical kernel, which would turn
/// negative there, and continued by its formula for the others. Throws invalid_input for shells, which are no
/// function of r, and for a fourier kernel without its spacing. @pre r > 0.
[[nodiscard]] double kernel_shape(const Micromodulus& micromodulus, double r, double horizon);

/// The shape of every member of a family: g(length), or the alpha of its orbit. Throws invalid_input: shells
/// that lack an orbit of the family or hold another, a fourier kernel of another spacing.
/// Cost O(family (log shells + a)).
template <int Dim>
[[nodiscard]] std::vector<double> kernel_shapes(const Micromodulus& micromodulus, const Family<Dim>& family);

/// Whether the kernel is a table or series of a lattice (fourier, shells): multipliers of the constant
/// kernel's c0 that are never renormalised.
[[nodiscard]] bool is_lattice_kernel(Kernel kernel);
[[nodiscard]] std::string name(Kernel kernel);  ///< as in case files: "constant", "inverse_distance", ...

/// c0 in c(r) = c0 g(r), N/m6 (3D; times m per section otherwise), from the moment integral
///   (1/4) int c(r) r dV = dilation_energy   over the continuum family 0 < r <= horizon.
/// Gives [bouaraquia2024] eqs. (21)-(34) for the constant and Gaussian kernels; fourier and shells have that
/// of the constant kernel. Relative error < 1e-13.
[[nodiscard]] double micromodulus_constant(const Micromodulus& micromodulus, double youngs_modulus,
                                           double horizon, const Continuum& continuum);

/// c(r) = c0 g(r) with c0 as above; keep c0 instead of calling this in a loop.
[[nodiscard]] double micromodulus(const Micromodulus& micromodulus, double c0, double r, double horizon);

}  // namespace perimode
