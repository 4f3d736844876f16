// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "perimode/dispersion/lattice.hpp"
#include "perimode/io/case.hpp"

namespace perimode::cli {

/// Writes ridge.csv and spectrum.csv of the transient run that the case names into `folder`; returns
/// `spectrum` of summary.json. @pre input.dispersion->spectrum. Errors point at the run's key.
template <int Dim>
[[nodiscard]] nlohmann::ordered_json write_spectrum(const std::filesystem::path& folder,
                                                    const Lattice<Dim>& lattice, const Case& input);

/// What the report says of it.
[[nodiscard]] std::string spectrum_text(const nlohmann::ordered_json& spectrum);

}  // namespace perimode::cli
