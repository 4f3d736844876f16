// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "io/case_sections.hpp"
#include "io/number_table.hpp"
#include "perimode/bonds/family.hpp"
#include "perimode/material/micromodulus.hpp"

namespace perimode::case_file {

namespace {

using Orbit = std::array<int, 3>;

const GridSpec& grid_of(const Model& model) { return std::get<GridSpec>(model.particles); }

double horizon_of(const Model& model) {
  const double value = model.horizon.value;
  return model.horizon.rule == HorizonSpec::Rule::ratio ? value * grid_of(model).spacing : value;
}

template <int Dim>
std::vector<Orbit> orbits(const Model& model) {
  const Family<Dim> family =
      make_family<Dim>(grid_of(model).spacing, horizon_of(model), VolumeCorrection::none);
  std::vector<Orbit> result(family.shell.size());
  for (std::size_t k = 0; k < result.size(); ++k)
    std::copy(family.shell[k].begin(), family.shell[k].end(), result[k].begin());
  return result;
}

/// The orbits of the grid's family, as Family::shell has them.
std::vector<Orbit> orbits_of(const Model& model) {
  check_horizon(model);
  constexpr double largest_family = 4e6;  // of a table, so that reading a case stays quick
  const double most = 0.5 * std::pow(largest_family, 1.0 / model.dimension) - 1.0;
  const double ratio = horizon_of(model) / grid_of(model).spacing;
  if (ratio > std::min(most, 9e4)) {
    invalid_input(
        {fmt::format("a horizon of at most {:.0f} spacings with the kernel shells", std::min(most, 9e4)),
         fmt::format("{:.6g} spacings", ratio), "a table holds one number per orbit of the family",
         model.horizon.where});
  }
  if (model.dimension == 1) return orbits<1>(model);
  return model.dimension == 2 ? orbits<2>(model) : orbits<3>(model);
}

std::string text_of(const Orbit& orbit, int dimension) {
  std::string text = "(";
  for (int a = 0; a < dimension; ++a)
    text += fmt::format("{}{}", a > 0 ? ", " : "", orbit[static_cast<std::size_t>(a)]);
  return text + ")";
}

/// "dx,dy,distance,alpha", with or without the distance.
std::string header_of(int dimension, bool distance) {
  std::string header;
  for (int a = 0; a < dimension; ++a) header += std::string("d") + "xyz"[a] + ",";
  return header + (distance ? "distance,alpha" : "alpha");
}

/// The offset in a line of a table, which is that of an orbit.
Orbit orbit_in(const NumberTable& table, std::size_t row, int dimension, const std::filesystem::path& file) {
  constexpr double largest = 1e6;
  Orbit orbit = {};
  double before = largest;
  for (int a = 0; a < dimension; ++a) {
    const double value = table.column[static_cast<std::size_t>(a)][row];
    const std::string name = std::string("d") + "xyz"[a];
    const std::string line = dimension == 1   ? "dx > 0"
                             : dimension == 2 ? "dx >= dy >= 0"
                                              : "dx >= dy >= dz >= 0";
    if (value != std::floor(value) || value < 0.0 || value > before || (a == 0 && value == 0.0)) {
      invalid_input({fmt::format("whole numbers, {}", line),
                     fmt::format("{} for {}", value, name),
                     "an orbit is named by its offset in spacings without signs, the largest component first",
                     {file.string(), table.line[row], 1}});
    }
    orbit[static_cast<std::size_t>(a)] = static_cast<int>(value);
    before = value;
  }
  return orbit;
}

constexpr const char* other_table = "use the table made for this horizon, or the horizon of the table";

std::vector<Shell> read_shell_file(const Cursor& cursor, const std::vector<Orbit>& orbits, int dimension,
                                   InputFiles& files) {
  const std::filesystem::path file = files.add(cursor, "coefficients.csv");
  const NumberTable table =
      read_number_table(file, {header_of(dimension, true), header_of(dimension, false)});
  std::map<Orbit, double> found;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Where where = {file.string(), table.line[row], 1};
    const Orbit orbit = orbit_in(table, row, dimension, file);
    if (std::find(orbits.begin(), orbits.end(), orbit) == orbits.end()) {
      invalid_input({fmt::format("one of the {} orbits within the horizon", orbits.size()),
                     text_of(orbit, dimension), other_table, where});
    }
    if (!found.emplace(orbit, table.column.back()[row]).second) {
      invalid_input(
          {"every orbit once", text_of(orbit, dimension) + " again", "remove one of the two", where});
    }
  }
  std::vector<Shell> shells(orbits.size());
  for (std::size_t k = 0; k < orbits.size(); ++k) {
    const auto at = found.find(orbits[k]);
    if (at == found.end()) {
      invalid_input({fmt::format("a line for each of the {} orbits within the horizon", orbits.size()),
                     fmt::format("none for {}", text_of(orbits[k], dimension)),
                     other_table,
                     {file.string(), 0, 0}});
    }
    shells[k] = {orbits[k], at->second};
  }
  return shells;
}

std::vector<Shell> read_shell_list(const Cursor& cursor, const std::vector<Orbit>& orbits, int dimension) {
  const std::vector<Cursor> items = cursor.items("[8.17, 1.48, -3.04]");
  if (items.size() != orbits.size()) {
    constexpr std::size_t most = 12;
    std::vector<std::string> names(std::min(most, orbits.size()));
    for (std::size_t k = 0; k < names.size(); ++k) names[k] = text_of(orbits[k], dimension);
    if (orbits.size() > most) names.emplace_back("...");
    cursor.complain(
        fmt::format(
            "a list of {} number{}, one per orbit within the horizon in ascending order of distance: {}",
            orbits.size(), orbits.size() == 1 ? "" : "s", fmt::join(names, " ")),
        "give every orbit its number, or a `file`");
  }
  std::vector<Shell> shells(orbits.size());
  for (std::size_t k = 0; k < orbits.size(); ++k)
    shells[k] = {orbits[k], items[k].number({"", "1.5", Sign::any})};
  return shells;
}

/// Keys of one kernel are refused with the others.
void refuse_others(const Section& section, Kernel kernel) {
  const auto refuse = [&](const char* key, Kernel owner, const char* name) {
    if (kernel == owner) return;
    section.refuse(key, fmt::format("`{}` with the kernel {} only", key, name),
                   fmt::format("remove it, or write kernel: {}", name));
  };
  refuse("p", Kernel::gaussian, "gaussian");
  for (const char* key : {"a0", "a", "w"}) refuse(key, Kernel::fourier, "fourier");
  for (const char* key : {"file", "alpha"}) refuse(key, Kernel::shells, "shells");
}

void read_fourier(const Section& section, bool named, const Model& model, Micromodulus& result) {
  if (named) {
    (void)section.need("a0", "2.5");
    (void)section.need("a", "[1.6, 0.2]");
    (void)section.need("w", "0.76");
  }
  result.spacing = grid_of(model).spacing;
  if (const auto a0 = section.find("a0")) result.a0 = a0->number({"", "2.5", Sign::any});
  if (const auto w = section.find("w")) result.w = w->number({"", "0.76", Sign::any});
  if (const auto a = section.find("a")) {
    result.a.clear();
    for (const Cursor& item : a->items("[1.6, 0.2]")) result.a.push_back(item.number({"", "1.6", Sign::any}));
  }
}

void read_shells(const Section& section, bool named, const Model& model, InputFiles& files,
                 Micromodulus& result) {
  const std::string_view key =
      named ? section.exactly_one({"file", "alpha"}) : section.at_most_one({"file", "alpha"});
  if (key.empty()) return;  // a block that keeps the table of the whole
  const Cursor value = *section.find(key);
  const std::vector<Orbit> orbits = orbits_of(model);
  result.shells = key == "file" ? read_shell_file(value, orbits, model.dimension, files)
                                : read_shell_list(value, orbits, model.dimension);
}

}  // namespace

Micromodulus read_micromodulus(const Cursor& cursor, const Model& model, InputFiles& files,
                               Micromodulus result) {
  const Section section(cursor, {"kernel", "p", "a0", "a", "w", "file", "alpha"});
  const auto kernel = section.find("kernel");
  if (kernel) {
    result.kernel = kernel->choice<Kernel>({{"constant", Kernel::constant},
                                            {"conical", Kernel::conical},
                                            {"gaussian", Kernel::gaussian},
                                            {"inverse_distance", Kernel::inverse_distance},
                                            {"fourier", Kernel::fourier},
                                            {"shells", Kernel::shells}});
  }
  refuse_others(section, result.kernel);
  if (!is_lattice_kernel(result.kernel)) {
    if (const auto p = section.find("p")) result.p = p->number({"", "2"});
    return result;
  }
  if (kernel && !std::holds_alternative<GridSpec>(model.particles)) {
    kernel->complain(
        "a kernel that is a function of distance for a cloud (constant, conical, gaussian, "
        "inverse_distance)",
        "fourier and shells belong to the lattice of a grid");
  }
  if (kernel && model.horizon.rule == HorizonSpec::Rule::neighbours) {
    kernel->complain("a kernel that is a function of distance where the horizon varies",
                     "fourier and shells need horizon: { ratio: ... } or { length: ... }");
  }
  if (result.kernel == Kernel::fourier) {
    read_fourier(section, kernel.has_value(), model, result);
  } else {
    read_shells(section, kernel.has_value(), model, files, result);
  }
  return result;
}

}  // namespace perimode::case_file
