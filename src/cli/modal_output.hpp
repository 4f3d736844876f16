// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/io/table.hpp"
#include "perimode/modal/modes.hpp"
#include "perimode/reference/closed_form.hpp"

namespace perimode::cli {

/// The exact modes that stand beside the computed ones: one per mode, `unknown` where there is none.
using References = std::vector<ClosedFormMode>;

/// Pairs computed modes with closed-form ones: by rank for the lowest modes, by nearest frequency
/// otherwise (each closed-form mode once). `from_lowest`: the result holds the lowest modes.
[[nodiscard]] References match_references(const ModalResult& result, const std::vector<ClosedFormMode>& exact,
                                          bool from_lowest);

/// modes.csv, one row per mode.
[[nodiscard]] Table modes_table(const ModalResult& result, const References& references, int dimension);

/// The table a person reads: Hz, exact, relative error, residual, effective masses.
[[nodiscard]] std::string modes_text(const ModalResult& result, const References& references,
                                     const std::vector<double>& total_mass);

/// The `certificate` part of summary.json.
[[nodiscard]] nlohmann::ordered_json certificate_json(const ModalResult& result);

/// modes.exo: one step per mode, its number the time, frequency_hz a global, displacement a nodal vector.
template <int Dim>
void write_modes_exodus(const std::filesystem::path& file, const std::string& title, const Body<Dim>& body,
                        const ModalResult& result);

}  // namespace perimode::cli
