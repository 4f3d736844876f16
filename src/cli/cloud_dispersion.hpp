// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "commands.hpp"
#include "perimode/assembly/body.hpp"
#include "perimode/io/case.hpp"

namespace perimode::cli {

/// The command dispersion of a case with a cloud: Rayleigh quotients along the axes. Returns the exit code.
int run_cloud_dispersion(const Case& input, const Arguments& arguments, Console& console);

/// What `perimode check` says of it.
template <int Dim>
[[nodiscard]] std::string cloud_dispersion_plan_text(const Body<Dim>& body, const Case& input);

}  // namespace perimode::cli
