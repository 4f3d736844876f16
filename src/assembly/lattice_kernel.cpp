// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "perimode/assembly/body.hpp"

namespace perimode {

namespace {

void require_fits(const Model& model, const Material& material) {
  const Kernel kernel = material.micromodulus.kernel;
  if (!is_lattice_kernel(kernel)) return;
  const std::string name = kernel == Kernel::shells ? "shells" : "fourier";
  const auto refuse = [&](const std::string& expected, const std::string& got, const std::string& remedy) {
    invalid_input({expected + " for the kernel " + name, got, remedy, material.where});
  };
  if (!std::holds_alternative<GridSpec>(model.particles))
    refuse("a grid", "a cloud", "its numbers belong to a lattice; take another kernel for a cloud");
  if (model.volume_correction != VolumeCorrection::none || model.self_cell) {
    refuse("volume_correction: none", model.self_cell ? "a self cell" : "a volume correction",
           "its numbers are those of whole cells; leave the correction out");
  }
  if (model.calibration != Calibration::continuum) {
    refuse("calibration: continuum", "a discrete one",
           "its numbers multiply the constant kernel's as they are; leave the calibration out");
  }
}

}  // namespace

void require_lattice_kernel_fits(const Model& model) {
  require_fits(model, model.material);
  for (const auto& [name, material] : model.block_materials) require_fits(model, material);
}

template <int Dim>
bool softening(const Body<Dim>& body) {
  const auto below_zero = [](double c) { return c < 0.0; };
  const BondConstants& constants = body.constants;
  return std::any_of(constants.kernel.begin(), constants.kernel.end(), below_zero) ||
         std::any_of(constants.kernel_of_end.begin(), constants.kernel_of_end.end(), below_zero);
}

template bool softening<1>(const Body<1>&);
template bool softening<2>(const Body<2>&);
template bool softening<3>(const Body<3>&);

}  // namespace perimode
