// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/assembly/model.hpp"
#include "perimode/bonds/bonds.hpp"
#include "perimode/boundary/boundary_map.hpp"
#include "perimode/core/sink.hpp"
#include "perimode/geometry/particles.hpp"
#include "perimode/material/micromodulus.hpp"

namespace perimode {

/// Micromoduli of a body's bonds. A bond of i and j has the constant
///   c = (f_i c_i(r) + f_j c_j(r)) / 2 in one block, the harmonic mean of the two between blocks (0 where one
/// is 0; opposite signs have none),
/// with f the calibration factors; it is the same to the last bit seen from both ends.
struct BondConstants {
  /// Grids: c(|xi|) per block and family member (block-major), N/m6.
  std::vector<double> kernel;
  /// Clouds: c_i(r) per bond end, i the particle whose end it is, N/m6.
  std::vector<double> kernel_of_end;
  /// Calibration factor f per particle; empty: all 1.
  std::vector<double> factor;
  int family_size = 0;
};

/// A body ready to be assembled: everything the operators K and M are made of.
template <int Dim>
struct Body {
  Particles<Dim> particles;
  Bonds<Dim> bonds;
  BondConstants constants;
  BoundaryMap<Dim> boundary;
  std::vector<double> density;  ///< per block, kg/m3
  double section = 1.0;         ///< thickness (2D), area (1D), 1 (3D)
  Offset cut = 0;               ///< bonds cut by pre-cracks

  [[nodiscard]] Index count() const { return particles.count(); }
};

/// Builds the body a model describes: particles, bonds, pre-cracks, calibration, boundary map.
/// Throws invalid_input, pointing at the place in the case, for anything that makes no body, such as a bond
/// between blocks whose micromoduli there have opposite signs, or what require_lattice_kernel_fits refuses.
/// Cost O(particles * family).
template <int Dim>
[[nodiscard]] Body<Dim> build_body(const Model& model, const Sink& sink = {});

/// Whether some bond has a negative micromodulus: only then can a symmetric K have a negative eigenvalue.
/// Cost O(blocks * family) on a grid, O(bond ends) on a cloud.
template <int Dim>
[[nodiscard]] bool softening(const Body<Dim>& body);

/// Throws invalid_input, at the material's place, where a material's kernel belongs to a lattice (fourier,
/// shells) and the model's body is a cloud, or has a volume correction, a self cell, or a calibration other
/// than continuum: its table is taken as it is.
void require_lattice_kernel_fits(const Model& model);

/// What a body would hold, from the model alone.
struct BodySize {
  double particles = 0.0;
  double family = 0.0;  ///< directed bonds of an interior particle
};
[[nodiscard]] BodySize estimate_size(const Model& model);

/// Largest extent of a body between particle centres, in (largest) horizons; 0 without bonds. Cost O(bond
/// ends) on a cloud, O(particles) on a grid.
template <int Dim>
[[nodiscard]] double horizons_long(const Body<Dim>& body);

/// Bytes a body holds (a cloud: took while its neighbours were searched).
template <int Dim>
[[nodiscard]] double body_bytes(const Body<Dim>& body);

/// Bytes that the body of a model and some ten vectors on it will at least take, from the model alone: tells
/// a case that cannot fit before anything is built. 0 for clouds.
[[nodiscard]] double least_body_bytes(const Model& model);

/// Stiffness k_b = c beta V_i V_j / |xi| of the bond seen from particle i, N/m: force per stretch
/// displacement along the bond. docs/theory/01_bond.md eq. (2). Cost O(1).
template <int Dim>
[[nodiscard]] double bond_stiffness(const Body<Dim>& body, Index i, const BondEnd<Dim>& end);

}  // namespace perimode
