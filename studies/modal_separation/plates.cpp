// SPDX-License-Identifier: BSD-3-Clause
#include "plates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perimode/dispersion/symbol.hpp"
#include "perimode/modal/modes.hpp"
#include "perimode/reference/closed_form.hpp"
#include "studies/common/models.hpp"

namespace perimode::studies {

std::vector<std::string> plate_names() {
  return {"mirror constant", "mirror gaussian", "antimirror constant", "antimirror gaussian"};
}

void run_plate(const std::string& name, int ratio, Results& results) {
  constexpr int count = 20;
  const WallType wall = name.starts_with("mirror") ? WallType::mirror : WallType::antimirror;
  const Micromodulus kernel = {name.ends_with("gaussian") ? Kernel::gaussian : Kernel::constant, 2.0};
  const Model model = separable_plate(32 * ratio / 3, ratio, kernel, wall);
  ModalOptions options;
  options.modes = count;
  const ModalResult modes = solve_modes(build_body<2>(model), options);
  std::string why_not;
  const std::vector<ClosedFormMode> exact = closed_form_modes(model, count, why_not).value();

  double& worst = results[{"discrete_error", name, plate_horizon, ratio, 0}];
  for (int i = 0; i < count; ++i) {
    const double discrete = exact[static_cast<std::size_t>(i)].discrete;
    if (discrete > 0.0) worst = std::max(worst, std::abs(modes.angular_frequency[i] / discrete - 1.0));
  }
  const Medium medium = {model.material, {2, Plane::stress, 1.0}, plate_horizon};
  const double k = std::numbers::pi * std::hypot(1.0, 2.0);  // one half wave along each axis
  for (const Branch branch : {Branch::shear, Branch::pressure}) {
    const double continuum = continuum_frequency(medium, branch, k);
    const auto nearest = std::min_element(exact.begin(), exact.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.nonlocal - continuum) < std::abs(b.nonlocal - continuum);
    });
    const double omega = modes.angular_frequency[nearest - exact.begin()];
    const std::string wave = name + (branch == Branch::shear ? " S" : " P");
    results[{"omega", wave, plate_horizon, ratio, 1}] = omega;
    results[{"continuum", wave, plate_horizon, 0, 1}] = continuum;
    results[{"error", wave, plate_horizon, ratio, 1}] = omega / continuum - 1.0;
  }
}

}  // namespace perimode::studies
