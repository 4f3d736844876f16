// SPDX-License-Identifier: BSD-3-Clause
#include "summary.hpp"

#include <cmath>
#include <fstream>
#include <type_traits>
#include <utility>

#include "interrupt.hpp"
#include "machine.hpp"
#include "perimode/core/error.hpp"
#include "perimode/core/version.hpp"
#include "perimode/linalg/threads.hpp"

namespace perimode::cli {

void add_run(nlohmann::ordered_json& summary, nlohmann::ordered_json timings) {
  summary["timings_s"] = std::move(timings);
  summary["peak_memory_mb"] = peak_memory() / 1e6;
  summary["threads"] = threads();
  summary["version"] = version();
}

void commit_summary(ResultDirectory& folder, const nlohmann::ordered_json& summary) {
  std::ofstream out(folder.temporary() / "summary.json");
  out << summary.dump(1) << '\n';
  out.close();
  if (!out) {
    throw Error(ErrorKind::environment,
                Complaint{"room to write summary.json", "a failed write", "free some disk space", {}});
  }
  folder.commit();
  set_unfinished_result({});
}

nlohmann::ordered_json table_json(const Table& table) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json object;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      std::visit(
          [&](const auto& cell) {
            if constexpr (std::is_same_v<std::decay_t<decltype(cell)>, double>) {
              object[table.columns[c]] =
                  std::isfinite(cell) ? nlohmann::ordered_json(cell) : nlohmann::ordered_json();
            } else {
              object[table.columns[c]] = cell;
            }
          },
          row[c]);
    }
    rows.push_back(std::move(object));
  }
  return rows;
}

}  // namespace perimode::cli
