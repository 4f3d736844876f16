// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/output_file.hpp"
#include "perimode/assembly/body.hpp"
#include "perimode/fracture/griffith.hpp"
#include "perimode/fracture/quasistatic.hpp"

namespace perimode::cli {

/// The first line of load_curve.csv.
[[nodiscard]] std::string load_curve_header(QuasistaticControl control);
/// A line of it, numbers with 17 significant digits.
void add_load_curve(OutputFile& file, const QuasistaticRow& row, QuasistaticControl control);

/// The first line of crack_path.csv.
[[nodiscard]] std::string crack_path_header(int dimension);
/// A line for each bond.
template <int Dim>
void add_crack_path(OutputFile& file, const std::vector<BrokenBond<Dim>>& bonds);

/// What is known of a run besides its result.
struct QuasistaticFacts {
  int dimension = 2;
  QuasistaticControl control = QuasistaticControl::event;
  double section = 1.0;          ///< thickness (2D, m), area (1D, m2), 1 (3D)
  double fracture_energy = 0.0;  ///< G0, J/m2
  CrackAreaScale area;
  std::optional<GriffithLoad> griffith;
  std::int64_t resumed_from = 0;  ///< event (step); 0: from the start
};

/// "separated", "not_converged", ...
[[nodiscard]] std::string_view status_name(QuasistaticStatus status);

/// What summary.json holds of a run, beyond what every analysis has.
void add_quasistatic(nlohmann::ordered_json& summary, const QuasistaticResult& result,
                     const QuasistaticFacts& facts);

/// The report a person reads: before the run, and at the end.
template <int Dim>
[[nodiscard]] std::string quasistatic_start_text(const Body<Dim>& body, const QuasistaticPlan& plan);
[[nodiscard]] std::string quasistatic_text(const QuasistaticResult& result, const QuasistaticFacts& facts);
[[nodiscard]] std::string loose_text(const LoosePiece& piece, const QuasistaticOptions& options);

/// What `perimode check` says of a quasi-static analysis.
[[nodiscard]] std::string quasistatic_plan_text(const QuasistaticPlan& plan);

}  // namespace perimode::cli
