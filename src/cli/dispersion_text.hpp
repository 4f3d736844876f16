// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "lattice_report.hpp"
#include "perimode/io/case.hpp"

namespace perimode::cli {

/// The lattice in two lines: sizes and material.
template <int Dim>
[[nodiscard]] std::string lattice_text(const Lattice<Dim>& lattice);

/// The report a person reads.
template <int Dim>
[[nodiscard]] std::string waves_text(const Lattice<Dim>& lattice, const LatticeReport<Dim>& report,
                                     const DispersionSpec& spec);

/// That of the optimised micromodulus; `file` as another case beside this one would name it.
template <int Dim>
[[nodiscard]] std::string optimised_text(const Lattice<Dim>& lattice, const OptimisedReport<Dim>& optimised,
                                         const DispersionSpec& spec, const std::filesystem::path& file);

/// What `perimode check` says of a dispersion analysis on a grid.
template <int Dim>
[[nodiscard]] std::string dispersion_plan_text(const Lattice<Dim>& lattice, const DispersionSpec& spec);

}  // namespace perimode::cli
