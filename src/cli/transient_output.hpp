// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "io/output_file.hpp"
#include "perimode/assembly/body.hpp"
#include "perimode/dynamics/transient.hpp"

namespace perimode::cli {

/// The first line of history.csv.
[[nodiscard]] std::string history_header(const std::vector<std::string>& probes, bool boundary_work);
/// A line of it, numbers with 17 significant digits.
void add_history(OutputFile& file, const HistoryRow& row, bool boundary_work);

/// |balance| over the energy that went through: the largest of initial, external work and what the body holds
/// and has lost. 0 for a body nothing happens to.
[[nodiscard]] double relative_balance(const Energies& energies);

/// The report a person reads: before the first step, and at the end.
template <int Dim>
[[nodiscard]] std::string transient_start_text(const Body<Dim>& body, const TransientPlan& plan);
[[nodiscard]] std::string transient_text(const TransientResult& result);

/// What `perimode check` says of a transient analysis.
template <int Dim>
[[nodiscard]] std::string transient_plan_text(const Body<Dim>& body, const TransientPlan& plan);

}  // namespace perimode::cli
