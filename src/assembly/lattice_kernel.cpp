// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <variant>

#include "perimode/assembly/body.hpp"

namespace perimode {
namespace {

void require_fits(const Model& model, const Material& material) {
  const Kernel kernel = material.micromodulus.kernel;
  if (!is_lattice_kernel(kernel)) return;
  const char* name = kernel == Kernel::shells ? "shells" : "fourier";
  if (!std::holds_alternative<GridSpec>(model.particles)) {
    invalid_input({fmt::format("a grid for the kernel {}, which multiplies the bonds of a lattice", name),
                   "a cloud", "use a grid, or a kernel that is a function of distance", material.where});
  }
  if (model.volume_correction != VolumeCorrection::none) {
    invalid_input({fmt::format("volume_correction none with the kernel {}", name),
                   model.volume_correction == VolumeCorrection::linear ? "linear" : "exact",
                   "its multipliers hold for whole cells", material.where});
  }
  if (model.self_cell) {
    invalid_input({fmt::format("no self cell with the kernel {}", name), "self_cell: true",
                   "it belongs to the kernel inverse_distance", material.where});
  }
  if (model.calibration != Calibration::continuum) {
    invalid_input({fmt::format("calibration continuum with the kernel {}", name),
                   model.calibration == Calibration::discrete ? "discrete" : "discrete_cut",
                   "its multipliers are used as they are", material.where});
  }
}

}  // namespace

void require_lattice_kernel_fits(const Model& model) {
  require_fits(model, model.material);
  for (const auto& [name, material] : model.block_materials) require_fits(model, material);
}

}  // namespace perimode
