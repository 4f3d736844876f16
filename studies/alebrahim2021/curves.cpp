// SPDX-License-Identifier: BSD-3-Clause
#include "curves.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "influence.hpp"
#include "perimode/dispersion/zone.hpp"

namespace perimode::studies {
namespace {

using std::numbers::pi;
constexpr int samples = 400;

std::string label(int n) { return fmt::format("N={}", n); }

void add_number(Figure& figure, const std::string& panel, const std::string& curve, double x,
                const Results& results, const Key& which) {
  const auto found = results.find(which);
  if (found != results.end()) add_point(figure, panel, curve, x, found->second);
}

/// omega of one branch over the length of O-M-Y-O; "classical" is that of elasticity.
void add_contour(Figure& figure, const std::string& panel, const std::string& curve, const Lattice<2>& plate,
                 int branch) {
  const ZonePath<2> path = zone_path<2>(irreducible_contour<2>(), 1.0, samples);
  const std::vector<PlaneWaves<2>> waves = waves_along<2>(plate, path);
  for (std::size_t i = 0; i < waves.size(); ++i)
    add_point(figure, panel, curve, path.length[i],
              waves[i].angular_frequency[static_cast<std::size_t>(branch)]);
}

void add_classical(Figure& figure, const std::string& panel, int branch) {
  const double speed =
      classical_speed(original_lattice<2>(3).medium, branch == 0 ? Branch::pressure : Branch::shear);
  const ZonePath<2> path = zone_path<2>(irreducible_contour<2>(), 1.0, samples);
  for (std::size_t i = 0; i < path.k.size(); ++i)
    add_point(figure, panel, "classical", path.length[i], speed * path.k[i].norm());
}

/// Kernels shown with the optimal and with the positive columns of table 2, N = 3.
std::vector<std::string> shown_plates(bool positive) {
  std::vector<std::string> names = {"original"};
  names.reserve(names.size() + method_names.size() + 2);
  for (const std::string& method : method_names)
    names.push_back(method + (positive ? " positive" : " optimal"));
  if (positive) {
    names.insert(names.end(), {"QP 0.5", "QP 0"});
  } else {
    names.insert(names.end(), {"QP", "L1"});
  }
  return names;
}

}  // namespace

Figure long_wave_figure(const Results& results) {
  Figure figure;
  for (const int n : {2, 3, 4}) {
    const Lattice<2> plate = original_lattice<2>(n);
    const std::vector<PlaneWaves<2>> waves = waves_around<2>(plate, 0.0, 360);
    for (std::size_t i = 0; i <= waves.size(); ++i) {
      const PlaneWaves<2>& wave = waves[i % waves.size()];
      const double degrees = static_cast<double>(i);
      add_point(figure, "a", label(n), degrees,
                wave.phase_velocity[0] / classical_speed(plate.medium, Branch::pressure));
      add_point(figure, "b", label(n), degrees,
                wave.phase_velocity[1] / classical_speed(plate.medium, Branch::shear));
    }
  }
  for (int n = 1; n <= 10; ++n)
    for (const char* branch : {"P", "S"})
      for (const double degrees : {0.0, 45.0})
        add_number(figure, "c", fmt::format("{} {}", branch, degrees), n, results,
                   key("long_wave_speed", branch, n, degrees));
  return figure;
}

Figure bar_error_figure(const Kernels& bars, const Results& results) {
  Figure figure;
  for (const int n : {3, 5, 10})
    for (const std::string suffix : {"", " printed"}) {
      const std::vector<double>& alpha = bars.at({"P.C" + suffix, n});
      for (std::size_t i = 0; i < alpha.size(); ++i)
        add_point(figure, "a", label(n) + suffix, static_cast<double>(i + 1), alpha[i]);
    }
  for (const std::string name : {"original", "P.C", "S.C", "L.S", "G", "L1"})
    for (int n = 1; n <= 10; ++n) add_number(figure, "b", name, n, results, key("error49", name, n));
  return figure;
}

Figure bar_figure(const Kernels& bars, const Results& results) {
  Figure figure;
  for (const auto& [panel, n] : {std::pair{"a", 3}, std::pair{"b", 5}}) {
    for (const std::string name : {"original", "P.C", "S.C", "L.S", "G", "L.S printed"}) {
      const Lattice<1> bar = modified_lattice<1>(n, bars.at({name, n}));
      for (int i = 0; i <= samples; ++i) {
        const double k = i * pi / samples;
        add_point(figure, panel, name, k, bar_frequency(bar, k));
      }
    }
    for (const double k : {0.0, pi}) add_point(figure, panel, "classical", k, k);
  }
  for (const std::string& method : method_names)
    for (const int n : {3, 5, 10})
      for (const std::string& name : {method, method + " printed"})
        add_number(figure, "c", name, n, results, key("error49", name, n));
  for (const int n : {3, 5, 10})
    for (const std::string name : {"original", "L1"})
      add_number(figure, "c", name, n, results, key("error49", name, n));
  return figure;
}

Figure contour_figure(const Kernels& plates) {
  Figure figure;
  for (const bool positive : {false, true})
    for (const int branch : {0, 1}) {
      const std::string panel(1, static_cast<char>('a' + (positive ? 2 : 0) + branch));
      add_classical(figure, panel, branch);
      for (const std::string& name : shown_plates(positive))
        add_contour(figure, panel, name, modified_lattice<2>(3, plates.at({name, 3})), branch);
    }
  return figure;
}

Figure influence_figure(const ExpectedResults& paper, const Kernels& plates) {
  Figure figure;
  const Micromodulus printed = printed_influence(paper), fitted = fitted_influence(plates.at({"QP 0.5", 3}));
  for (int i = 1; i <= samples; ++i) {
    const double r = 3.0 * i / samples;
    add_point(figure, "a", "eq. 50", r, kernel_shape(printed, r, 3.0));
    add_point(figure, "a", "fit", r, kernel_shape(fitted, r, 3.0));
  }
  const Family<2> family = original_lattice<2>(3).family;
  for (const std::string name : {"S.C positive", "QP 0.5"})
    for (std::size_t orbit = 0; orbit < family.shell.size(); ++orbit)
      add_point(figure, "a", name, std::hypot(family.shell[orbit][0], family.shell[orbit][1]),
                plates.at({name, 3})[orbit]);
  return figure;
}

Figure plate_error_figure(const Kernels& plates, const Results& results) {
  Figure figure;
  const std::vector<Point<2>> sides = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}};
  const ZonePath<2> path = zone_path<2>(sides, 1.0, samples);
  for (const bool positive : {false, true})
    for (const std::string& name : shown_plates(positive)) {
      const Lattice<2> plate = modified_lattice<2>(3, plates.at({name, 3}));
      const std::vector<PlaneWaves<2>> waves = waves_along<2>(plate, path);
      for (std::size_t i = 0; i < waves.size(); ++i)
        for (std::size_t b = 0; b < 2; ++b)
          add_point(figure, positive ? "b" : "a", fmt::format("{} {}", b == 0 ? "P" : "S", name),
                    path.length[i], waves[i].angular_frequency[b]);
    }
  for (const char* panel : {"a", "b"})
    for (std::size_t i = 0; i < path.k.size(); ++i)
      for (const Branch branch : {Branch::pressure, Branch::shear})
        add_point(figure, panel, branch == Branch::pressure ? "P classical" : "S classical", path.length[i],
                  classical_speed(original_lattice<2>(3).medium, branch) * path.k[i].norm());
  for (const auto& [name, alpha] : plates)
    for (const char* error : {"error51", "error45"})
      add_number(figure, "c", fmt::format("{} {}", error, name.first), name.second, results,
                 key(error, name.first, name.second));
  return figure;
}

}  // namespace perimode::studies
