// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <perimode/modal/modes.hpp>

int main() {
  perimode::Model bar;  // aluminium, 1 m, fixed at both ends
  bar.dimension = 1;
  bar.particles = perimode::GridSpec{.lower = {0.0}, .upper = {1.0}, .spacing = 0.005};
  bar.material = {.youngs_modulus = 68e9, .density = 2700.0};
  bar.volume_correction = perimode::VolumeCorrection::linear;
  bar.boundary = {{perimode::Wall{{0, false}, perimode::WallType::odd}},
                  {perimode::Wall{{0, true}, perimode::WallType::odd}}};
  const auto modes = perimode::solve_modes(perimode::build_body<1>(bar), {.modes = 3});
  for (double f : modes.frequency_hz) std::printf("%.6f Hz\n", f);
}
