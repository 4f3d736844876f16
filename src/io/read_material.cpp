// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "io/case_sections.hpp"
#include "perimode/material/micromodulus.hpp"

namespace perimode::case_file {

namespace {

Micromodulus read_micromodulus(const Cursor& cursor, Micromodulus result) {
  const Section section(cursor, {"kernel", "p", "a0", "a", "w", "file", "alpha"});
  if (const auto kernel = section.find("kernel")) {
    if (kernel->node().text == "fourier" || kernel->node().text == "shells") {
      kernel->complain("a kernel of this version (constant, conical, gaussian, inverse_distance)",
                       "choose one of them");
    }
    result.kernel = kernel->choice<Kernel>({{"constant", Kernel::constant},
                                            {"conical", Kernel::conical},
                                            {"gaussian", Kernel::gaussian},
                                            {"inverse_distance", Kernel::inverse_distance}});
  }
  if (result.kernel != Kernel::gaussian) {
    section.refuse("p", "`p` with the kernel gaussian only", "remove it, or write kernel: gaussian");
  }
  for (const char* key : {"a0", "a", "w", "file", "alpha"}) {
    section.refuse(key, "a parameter of this version's kernels (p of gaussian)",
                   "it belongs to the kernels fourier and shells, which this version does not have");
  }
  if (const auto p = section.find("p")) result.p = p->number({"", "2"});
  return result;
}

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
void read_constants(const Section& section, const Model& model, Material& result) {
  result.where = section.where();
  check_poissons_ratio(section, model);
  if (const auto e = section.find("youngs_modulus")) result.youngs_modulus = e->number({"Pa", "210.0e+9"});
  if (const auto rho = section.find("density")) result.density = rho->number({"kg/m3", "7850"});
  if (const auto kernel = section.find("micromodulus")) {
    result.micromodulus = read_micromodulus(*kernel, result.micromodulus);
  }
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

}  // namespace

void read_materials(const Cursor& material, const std::optional<Cursor>& overrides, Model& model) {
  const Section section(
      material, {"youngs_modulus", "density", "micromodulus", "calibration", "volume_correction", "self_cell",
                 "fracture_energy", "critical_stretch", "poissons_ratio"});
  (void)section.need("youngs_modulus", "210.0e+9");
  (void)section.need("density", "7850");
  read_constants(section, model, model.material);
  read_body_wide(section, model);
  if (overrides) {
    for (const Cursor& entry : overrides->entries("{ inclusion: { density: 2700 } }")) {
      const Section block(entry,
                          {"youngs_modulus", "density", "micromodulus", "fracture_energy", "critical_stretch",
                           "poissons_ratio", "calibration", "volume_correction", "self_cell"});
      for (const char* key : {"calibration", "volume_correction", "self_cell"}) {
        block.refuse(key, fmt::format("{} in `material`", key), "it holds for the whole body");
      }
      Material merged = model.material;
      read_constants(block, model, merged);
      merged.where = entry.node().key_where;
      model.block_materials.emplace(entry.node().key, merged);
    }
  }
  check_self_cell(section, model);
}

}  // namespace perimode::case_file
