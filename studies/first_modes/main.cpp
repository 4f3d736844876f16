// SPDX-License-Identifier: BSD-3-Clause
//
// first_modes CASES TABLE.csv: modes of the bar, the plate and the cracked plate of the folder CASES beside
// whatever else is known about them, in one table.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "perimode/assembly/assemble.hpp"
#include "perimode/core/error.hpp"
#include "perimode/io/case.hpp"
#include "perimode/io/table.hpp"
#include "perimode/modal/modes.hpp"
#include "perimode/reference/closed_form.hpp"

namespace {

using namespace perimode;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Finite elements, Hz. The bar: 40 linear ones with consistent mass (MOOSE's test suite, its modal analysis
/// of a bar). The plate without crack: classical_plate.py, 120 x 60 biquadratic ones.
constexpr std::array<double, 3> bar_elements_hz = {2509.887, 5023.645, 7545.151};
constexpr std::array<double, 6> plate_elements_hz = {357.097,  1299.656, 1356.405,
                                                     2839.007, 3623.435, 3756.394};

/// A mode and what it is compared with; frequencies in Hz, NaN where there is nothing to compare with.
struct Row {
  std::string body;
  int mode = 0;
  double hz = unknown, exact = unknown, nonlocal = unknown, classical = unknown, elements = unknown;
  double residual = unknown;
  int pair = 0;  ///< mode of the plate without crack; 0: none
  double mac = unknown, drop = unknown;
  std::string certificate;
};

template <int Dim>
struct Solved {
  Body<Dim> body;
  ModalResult modes;
};

template <int Dim>
Solved<Dim> solve(const Case& input) {
  Body<Dim> body = build_body<Dim>(input.model);
  ModalResult modes = solve_modes(body, input.modal.value_or(ModalOptions{}));
  if (modes.status != EigenStatus::converged)
    throw Error(ErrorKind::solver_failure,
                {"all modes of " + input.title, modes.message, "see the case file", {}});
  return {std::move(body), std::move(modes)};
}

Row row(const std::string& body, const ModalResult& modes, int k) {
  Row r;
  r.body = body;
  r.mode = k + 1;
  r.hz = modes.frequency_hz[k];
  r.residual = modes.residual[k];
  r.certificate = modes.certificate.complete ? modes.certificate.method : "none";
  return r;
}

void add_bar(const std::filesystem::path& file, std::vector<Row>& rows) {
  const Case input = read_case(file);
  const ModalResult modes = solve<1>(input).modes;
  std::string why_not;
  const std::vector<ClosedFormMode> exact =
      closed_form_modes(input.model, static_cast<int>(modes.count()), why_not)
          .value_or(std::vector<ClosedFormMode>());
  constexpr double to_hz = 0.5 / std::numbers::pi;
  for (int k = 0; k < modes.count(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    Row r = row("bar", modes, k);
    r.exact = exact.at(i).discrete * to_hz;
    r.nonlocal = exact.at(i).nonlocal * to_hz;
    r.classical = exact.at(i).classical * to_hz;
    if (i < bar_elements_hz.size()) r.elements = bar_elements_hz[i];
    rows.push_back(r);
  }
}

/// Pairs columns with rows, largest value first: the row of each column.
std::vector<int> pair_columns(Eigen::MatrixXd likeness) {
  std::vector<int> pair(static_cast<std::size_t>(likeness.cols()), -1);
  for (Eigen::Index n = 0; n < std::min(likeness.rows(), likeness.cols()); ++n) {
    Eigen::Index i = 0, j = 0;
    likeness.maxCoeff(&i, &j);
    pair[static_cast<std::size_t>(j)] = static_cast<int>(i);
    likeness.row(i).setConstant(-1.0);
    likeness.col(j).setConstant(-1.0);
  }
  return pair;
}

void add_plates(const std::filesystem::path& whole_file, const std::filesystem::path& cracked_file,
                std::vector<Row>& rows) {
  const auto [body, whole] = solve<2>(read_case(whole_file));
  const ModalResult cracked = solve<2>(read_case(cracked_file)).modes;
  const Eigen::MatrixXd mac = modal_assurance(whole.shape, cracked.shape, lumped_mass(body));
  const std::vector<int> pair = pair_columns(mac);
  constexpr int shown =
      plate_elements_hz.size();  // two more are solved for, so that crossing modes find their pairs
  for (int k = 0; k < shown; ++k) {
    rows.push_back(row("plate", whole, k));
    rows.back().elements = plate_elements_hz[static_cast<std::size_t>(k)];
  }
  for (int k = 0; k < shown; ++k) {
    Row r = row("plate, crack", cracked, k);
    const int partner = pair[static_cast<std::size_t>(k)];
    r.pair = partner + 1;
    r.mac = mac(partner, k);
    r.drop = 1.0 - r.hz / whole.frequency_hz[partner];
    rows.push_back(r);
  }
}

std::string cell(double value, const char* format) {
  return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value);
}

void print(const std::vector<Row>& rows) {
  constexpr const char* line =
      "{:<13}{:>4}{:>11}{:>11}{:>11}{:>10}{:>11}{:>11}{:>11}{:>9}{:>6}{:>7}{:>9}  {}\n";
  fmt::print(line, "body", "mode", "f [Hz]", "exact", "rel. error", "residual", "nonlocal", "classical", "FE",
             "f/FE - 1", "pair", "MAC", "drop", "complete by");
  for (const Row& r : rows) {
    if (r.mode == 1) fmt::print("\n");
    fmt::print(line, r.body, r.mode, cell(r.hz, "{:.3f}"), cell(r.exact, "{:.3f}"),
               cell(r.hz / r.exact - 1.0, "{:.1e}"), cell(r.residual, "{:.1e}"), cell(r.nonlocal, "{:.3f}"),
               cell(r.classical, "{:.3f}"), cell(r.elements, "{:.3f}"),
               cell(100.0 * (r.hz / r.elements - 1.0), "{:+.2f} %"),
               r.pair > 0 ? fmt::to_string(r.pair) : "-", cell(r.mac, "{:.3f}"),
               cell(100.0 * r.drop, "{:.2f} %"), r.certificate);
  }
}

Table table_of(const std::vector<Row>& rows) {
  Table table;
  table.columns = {"body",     "mode",           "frequency_hz", "exact_hz",          "relative_error",
                   "residual", "nonlocal_hz",    "classical_hz", "finite_element_hz", "paired_mode",
                   "mac",      "frequency_drop", "certificate"};
  for (const Row& r : rows)
    table.rows.push_back({r.body, Offset{r.mode}, r.hz, r.exact, r.hz / r.exact - 1.0, r.residual, r.nonlocal,
                          r.classical, r.elements,
                          r.pair > 0 ? TableCell(Offset{r.pair}) : TableCell(unknown), r.mac, r.drop,
                          r.certificate});
  return table;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: first_modes CASES TABLE.csv\n");
    return 2;
  }
  try {
    const std::filesystem::path cases = argv[1];
    std::vector<Row> rows;
    add_bar(cases / "bar.yaml", rows);
    add_plates(cases / "plate.yaml", cases / "plate_cracked.yaml", rows);
    write_csv(argv[2], table_of(rows));
    print(rows);
  } catch (const std::exception& error) {
    fmt::print(stderr, "first_modes: {}\n", error.what());
    return 1;
  }
}
