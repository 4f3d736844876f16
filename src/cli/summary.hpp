// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/stopwatch.hpp"
#include "perimode/assembly/body.hpp"
#include "perimode/io/result_directory.hpp"
#include "perimode/io/table.hpp"

namespace perimode::cli {

/// What every summary.json begins with.
template <int Dim>
[[nodiscard]] nlohmann::ordered_json begin_summary(const std::string& analysis, const std::string& title,
                                                   const Body<Dim>& body) {
  return {{"analysis", analysis},       {"title", title},
          {"particles", body.count()},  {"bonds", count_bonds(body.bonds, body.count())},
          {"dofs", body.boundary.free}, {"engine", "serial"}};
}

/// Adds what every summary.json holds besides: timings_s, peak_memory_mb, threads, version.
void add_run(nlohmann::ordered_json& summary, nlohmann::ordered_json timings);

/// Writes summary.json and puts the result folder in its place. Throws Error(environment).
void commit_summary(ResultDirectory& folder, const nlohmann::ordered_json& summary);

/// Rows of a table as objects; NaN becomes null.
[[nodiscard]] nlohmann::ordered_json table_json(const Table& table);

}  // namespace perimode::cli
