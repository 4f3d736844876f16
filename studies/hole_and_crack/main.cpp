// SPDX-License-Identifier: BSD-3-Clause
//
// hole_and_crack [--coarse | --fine] [--out OUT]: the quasi-static path of a crack that runs into a hole and
// out of it, from the first broken bond to separation. Prints what happened and what it took, checks it, and
// writes OUT/load_curve.csv, OUT/crack_path.csv and OUT/damage.csv. Exit code 1: a check failed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "perimode/assembly/fields.hpp"
#include "perimode/io/table.hpp"
#include "plate.hpp"

namespace {

using namespace perimode;
using namespace perimode::studies;

struct Path {
  QuasistaticResult result;
  std::vector<QuasistaticRow> rows;
  std::vector<BrokenBond<2>> broken;
};

Path follow(Body<2>& body, const QuasistaticOptions& options) {
  Path path;
  QuasistaticObserver<2> observer;
  observer.row = [&](const QuasistaticRow& row) { path.rows.push_back(row); };
  observer.broken = [&](const std::vector<BrokenBond<2>>& bonds) {
    path.broken.insert(path.broken.end(), bonds.begin(), bonds.end());
  };
  path.result = run_quasistatic<2>(body, options, observer);
  return path;
}

/// Row of the largest force among the events [first, last).
const QuasistaticRow& peak(const std::vector<QuasistaticRow>& rows, std::int64_t first, std::int64_t last) {
  const auto from = rows.begin() + (first - 1), to = rows.begin() + (last - 1);
  return *std::max_element(from, to, [](const auto& a, const auto& b) { return a.force < b.force; });
}

double grip_motion(const QuasistaticRow& row) { return 1e-4 * row.load_factor; }
double grip_force(const QuasistaticRow& row) {
  // displacement and force are along the unit vector of the given motion; their product is the work
  return row.force * row.displacement / grip_motion(row);
}

void print(const Path& path, const Landmarks& marks) {
  const QuasistaticResult& r = path.result;
  const auto& rows = path.rows;
  const auto state = [](const char* what, const QuasistaticRow& row) {
    fmt::print("{:<34}event {:>6}  grip {:>9.5f} mm  force {:>9.3f} N  crack {:>7.3f} mm\n", what, row.event,
               1e3 * grip_motion(row), grip_force(row), 1e3 * row.crack_length);
  };
  state("first break", rows.front());
  state("largest load before the hole", peak(rows, 1, marks.meets));
  state("crack meets the hole", rows[static_cast<std::size_t>(marks.meets - 1)]);
  state("first break beyond the hole", rows[static_cast<std::size_t>(marks.leaves - 1)]);
  state("last event", rows.back());
  fmt::print("\n{} events, {} bonds, {}\n", r.events, r.broken_bonds, r.message);
  fmt::print("{:.2f} s in all: {:.2f} s set-up, {:.2f} s searching bonds; a fresh factor {:.4f} s\n",
             r.seconds_total, r.seconds_setup, r.seconds_search, r.factor_seconds);
  Offset avoided = 0;
  for (int way = 0; way < solve_ways; ++way) {
    const WayTotals& t = r.ways[static_cast<std::size_t>(way)];
    if (t.solves == 0) continue;
    const auto which = static_cast<SolveWay>(way);
    if (which == SolveWay::update || which == SolveWay::stale) avoided += t.solves;
    fmt::print("  {:<9}{:>7} solutions{:>8} columns{:>9} iterations{:>10.3f} s\n", name(which), t.solves,
               t.columns, t.iterations, t.seconds);
  }
  fmt::print("factorisations avoided: {}, about {:.1f} s\n", avoided,
             static_cast<double>(avoided) * r.factor_seconds);
  fmt::print("worst residual {:.1e}, worst energy balance {:.1e} of the work\n", r.worst_residual,
             r.worst_balance);
}

void write(const std::filesystem::path& out, const Path& path, const Body<2>& body) {
  std::filesystem::create_directories(out);
  Table curve, cracks, damages;
  curve.columns = {"event", "motion", "force", "stored", "released", "relaxation", "work", "crack_length"};
  for (const QuasistaticRow& row : path.rows)
    curve.rows.push_back({Offset{row.event}, grip_motion(row), grip_force(row), row.stored_energy,
                          row.bond_energy_released, row.relaxation_energy, row.external_work,
                          row.crack_length});
  cracks.columns = {"event", "x", "y", "energy"};
  for (const BrokenBond<2>& bond : path.broken)
    cracks.rows.push_back({Offset{bond.event}, bond.middle[0], bond.middle[1], bond.energy});
  damages.columns = {"x", "y", "damage", "u_x", "u_y"};
  const Eigen::VectorXd d = damage(body);
  const Eigen::VectorXd& u = path.result.displacement;
  for (Index i = 0; i < body.count(); ++i) {
    const Point<2>& x = body.particles.position[static_cast<std::size_t>(i)];
    damages.rows.push_back({x[0], x[1], d[i], u[2 * i], u[2 * i + 1]});
  }
  write_csv(out / "load_curve.csv", curve);
  write_csv(out / "crack_path.csv", cracks);
  write_csv(out / "damage.csv", damages);
}

/// What has to hold.
int check(const Path& path, const Landmarks& marks, double first, double spacing) {
  std::vector<std::string> wrong;
  const auto require = [&](bool holds, std::string what) {
    if (!holds) wrong.push_back(std::move(what));
  };
  require(path.result.status == QuasistaticStatus::separated, "not separated: " + path.result.message);
  // The last bonds hang across a gap of many times the plate's stretch: their energies lose digits.
  const double largest = peak(path.rows, 1, path.result.events).force;
  double balance = 0.0;
  for (const QuasistaticRow& row : path.rows) {
    if (row.force < 0.05 * largest) break;
    balance = std::max(balance, std::abs(row.balance()) / row.external_work);
  }
  require(balance <= 1e-10, fmt::format("energies balance to {:.1e} until 5 % of the peak is left", balance));
  require(path.result.worst_balance <= 1e-8,
          fmt::format("energies balance to {:.1e}", path.result.worst_balance));
  require(std::abs(path.result.first_load - first) <= 1e-8 * first,
          fmt::format("first load factor {:.12g}, {:.12g} by statics", path.result.first_load, first));
  require(marks.meets > 0 && marks.gap <= spacing, "the crack misses the hole");
  require(marks.leaves > marks.meets, "no crack beyond the hole after it was met");
  for (const std::string& line : wrong) fmt::print("  {}\n", line);
  fmt::print("{} of 6 checks failed\n", wrong.size());
  return wrong.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool coarse = std::erase(words, "--coarse") > 0, fine = std::erase(words, "--fine") > 0;
  if (!(words.empty() || (words.size() == 2 && words[0] == "--out")) || (coarse && fine)) {
    fmt::print(stderr, "usage: hole_and_crack [--coarse | --fine] [--out OUT]\n");
    return 2;
  }
  const int cells = coarse ? 40 : (fine ? 200 : 100);
  try {
    const Model model = plate_with_hole_and_crack(cells);
    Body<2> body = build_body<2>(model);
    const double first = first_load_by_statics(model, body), spacing = plate_side / cells;
    const Path path = follow(body, tear_apart(model, body));
    const Landmarks marks = landmarks(path.broken, spacing);
    fmt::print("{} particles, {} dofs\n", body.count(), body.boundary.free);
    if (marks.meets > 1 && marks.leaves > 0) print(path, marks);
    if (words.size() == 2) write(words[1], path, body);
    return check(path, marks, first, spacing);
  } catch (const std::exception& error) {
    fmt::print(stderr, "hole_and_crack: {}\n", error.what());
    return 1;
  }
}
