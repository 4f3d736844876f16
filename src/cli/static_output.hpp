// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/io/table.hpp"
#include "perimode/statics/static.hpp"
#include "perimode/statics/static_plan.hpp"

namespace perimode::cli {

/// reactions.csv, one row per boundary condition.
[[nodiscard]] Table reactions_table(const StaticResult& result, int dimension);

/// The report a person reads.
template <int Dim>
[[nodiscard]] std::string static_text(const Body<Dim>& body, const StaticResult& result);

/// fields.exo: one step with the fields chosen.
template <int Dim>
void write_fields_exodus(const std::filesystem::path& file, const std::string& title, const Body<Dim>& body,
                         const StaticResult& result, const std::vector<std::string>& fields);

/// What `perimode check` says of a static analysis.
[[nodiscard]] std::string static_plan_text(const StaticPlan& plan);

}  // namespace perimode::cli
