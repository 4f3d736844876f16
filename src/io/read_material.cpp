// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "io/case_sections.hpp"
#include "perimode/material/micromodulus.hpp"

namespace perimode::case_file {

namespace {

/// nu is checked to the three decimals 1/3 is usually written with.
void check_poissons_ratio(const Section& section, const Model& model) {
  const auto given = section.find("poissons_ratio");
  if (!given) return;
  if (model.dimension == 1) {
    section.refuse("poissons_ratio", "no Poisson's ratio in 1D", "leave it out");
  }
  const double value = given->number({"", "0.25", Sign::any});
  const double theory = poissons_ratio({model.dimension, model.plane, 1.0});
  if (std::abs(value - theory) > 5e-4) {
    given->complain(fmt::format("Poisson's ratio {} of bond-based theory ({})", theory > 0.3 ? "1/3" : "1/4",
                                model.dimension == 3           ? "3D"
                                : model.plane == Plane::stress ? "plane stress"
                                                               : "plane strain"),
                    "the theory fixes it: leave the key out");
  }
}

/// Replaces in `result` what the section gives.
void read_constants(const Section& section, const Model& model, InputFiles& files, Material& result) {
  result.where = section.where();
  check_poissons_ratio(section, model);
  if (const auto e = section.find("youngs_modulus")) result.youngs_modulus = e->number({"Pa", "210.0e+9"});
  if (const auto rho = section.find("density")) result.density = rho->number({"kg/m3", "7850"});
  if (const auto kernel = section.find("micromodulus")) {
    result.micromodulus = read_micromodulus(*kernel, model, files, result.micromodulus);
  }
  if (const auto negative = section.find("break_negative")) result.break_negative = negative->boolean();
  const std::string_view strength = section.at_most_one({"fracture_energy", "critical_stretch"});
  if (strength.empty()) return;
  result.fracture_energy.reset();
  result.critical_stretch.reset();
  const Cursor value = *section.find(strength);
  if (strength == "fracture_energy") result.fracture_energy = value.number({"J/m2", "135.0"});
  if (strength == "critical_stretch") result.critical_stretch = value.number({"", "1.8e-3"});
}

void read_body_wide(const Section& section, Model& model) {
  if (const auto calibration = section.find("calibration")) {
    model.calibration = calibration->choice<Calibration>({{"continuum", Calibration::continuum},
                                                          {"discrete", Calibration::discrete},
                                                          {"discrete_cut", Calibration::discrete_cut}});
  }
  if (const auto correction = section.find("volume_correction")) {
    model.volume_correction = correction->choice<VolumeCorrection>({{"none", VolumeCorrection::none},
                                                                    {"linear", VolumeCorrection::linear},
                                                                    {"exact", VolumeCorrection::exact}});
    if (model.volume_correction == VolumeCorrection::exact && model.dimension != 1) {
      correction->complain(fmt::format("none or linear in {}D", model.dimension), "exact is for dimension 1");
    }
  }
  if (const auto self_cell = section.find("self_cell")) model.self_cell = self_cell->boolean();
}

/// The self-cell term exists for the inverse-distance kernel in 1D only.
void check_self_cell(const Section& section, const Model& model) {
  if (!model.self_cell) return;
  const auto self_cell = section.find("self_cell");
  bool fits = model.dimension == 1 && model.material.micromodulus.kernel == Kernel::inverse_distance;
  for (const auto& [name, material] : model.block_materials) {
    fits = fits && material.micromodulus.kernel == Kernel::inverse_distance;
  }
  if (!fits) {
    self_cell->complain("false, save in 1D with the kernel inverse_distance (of every block)",
                        "the self-cell term exists there only: leave the key out");
  }
}

const char* lattice_kernel_of(const Micromodulus& micromodulus) {
  if (!is_lattice_kernel(micromodulus.kernel)) return nullptr;
  return micromodulus.kernel == Kernel::fourier ? "fourier" : "shells";
}

/// Tables of a lattice are what they were made to be with the continuum's constant and whole cells alone.
void check_lattice_kernels(const Section& section, const Model& model) {
  const char* kernel = lattice_kernel_of(model.material.micromodulus);
  std::string whose;
  for (const auto& [name, material] : model.block_materials) {
    if (kernel != nullptr) break;
    kernel = lattice_kernel_of(material.micromodulus);
    whose = fmt::format(" of the block {}", name);
  }
  if (kernel == nullptr) return;
  const std::string with = fmt::format(" with the kernel {}{}", kernel, whose);
  if (model.volume_correction != VolumeCorrection::none) {
    section.find("volume_correction")
        ->complain("none" + with, "its numbers are multipliers of whole cells: leave the key out");
  }
  if (model.calibration != Calibration::continuum) {
    section.find("calibration")
        ->complain("continuum" + with,
                   "scaling its numbers would undo what they were made for: leave the key out");
  }
}

}  // namespace

void read_materials(const Cursor& material, const std::optional<Cursor>& overrides, InputFiles& files,
                    Model& model) {
  const Section section(
      material, {"youngs_modulus", "density", "micromodulus", "calibration", "volume_correction", "self_cell",
                 "fracture_energy", "critical_stretch", "break_negative", "poissons_ratio"});
  (void)section.need("youngs_modulus", "210.0e+9");
  (void)section.need("density", "7850");
  read_body_wide(section, model);
  read_constants(section, model, files, model.material);
  if (overrides) {
    for (const Cursor& entry : overrides->entries("{ inclusion: { density: 2700 } }")) {
      const Section block(
          entry, {"youngs_modulus", "density", "micromodulus", "fracture_energy", "critical_stretch",
                  "break_negative", "poissons_ratio", "calibration", "volume_correction", "self_cell"});
      for (const char* key : {"calibration", "volume_correction", "self_cell"}) {
        block.refuse(key, fmt::format("{} in `material`", key), "it holds for the whole body");
      }
      Material merged = model.material;
      read_constants(block, model, files, merged);
      merged.where = entry.node().key_where;
      model.block_materials.emplace(entry.node().key, merged);
    }
  }
  check_self_cell(section, model);
  check_lattice_kernels(section, model);
}

}  // namespace perimode::case_file
