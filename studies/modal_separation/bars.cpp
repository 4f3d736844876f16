// SPDX-License-Identifier: BSD-3-Clause
#include "bars.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "perimode/modal/modes.hpp"
#include "perimode/reference/closed_form.hpp"
#include "perimode/reference/separation.hpp"
#include "studies/common/models.hpp"

namespace perimode::studies {
namespace {

constexpr double speed = 5000.0;

struct BarKind {
  const char* name;
  BarEnds ends;
  double shift;  ///< wave number of elastic mode n of the continuum: (n - shift) pi / length
};

/// zero_layer is meant to be a fixed end and is compared with odd walls; a free end with even ones.
const std::vector<BarKind>& kinds() {
  static const std::vector<BarKind> all = {
      {"odd", {WallType::odd, WallType::odd}, 0.0},
      {"even", {WallType::even, WallType::even}, 0.0},
      {"odd-even", {WallType::odd, WallType::even}, 0.5},
      {"zero_layer", {WallType::zero_layer, WallType::zero_layer}, 0.0},
      {"free", {std::nullopt, std::nullopt}, 0.0},
      {"surface_nodes", {WallType::surface_nodes, WallType::surface_nodes}, 0.0}};
  return all;
}

constexpr std::string_view with_self_cell = " self_cell";

}  // namespace

std::vector<std::string> bar_names() {
  std::vector<std::string> names;
  for (const std::string_view suffix : {std::string_view(), with_self_cell})
    for (const BarKind& kind : kinds()) names.push_back(std::string(kind.name) + std::string(suffix));
  return names;
}

void run_bar(const std::string& name, double horizon, int ratio, Results& results) {
  const bool self_cell = name.ends_with(with_self_cell);
  const std::string bare = self_cell ? name.substr(0, name.size() - with_self_cell.size()) : name;
  const BarKind* kind = nullptr;
  for (const BarKind& k : kinds())
    if (bare == k.name) kind = &k;

  const Model model = separable_bar(horizon, ratio, kind->ends, self_cell);
  const Body<1> body = build_body<1>(model);
  ModalOptions options;
  const bool unsymmetric = kind->ends.first == WallType::surface_nodes;
  options.solver = ModalSolver::dense;
  options.modes = unsymmetric ? body.boundary.free : bar_modes + 1;  // one of them may be rigid
  const ModalResult modes = solve_modes(body, options);
  std::string why_not;
  const auto exact = closed_form_modes(model, bar_modes + 1, why_not);

  for (int mode = 1; mode <= bar_modes; ++mode) {
    const double n = mode;
    const int i = mode - 1 + modes.rigid_modes;
    const double omega = modes.angular_frequency[i];
    const double k = (n - kind->shift) * std::numbers::pi;
    const double separation = speed * std::sqrt(scabbia_lambda(horizon, k));
    results[{"omega", name, horizon, ratio, n}] = omega;
    results[{"separation", bare, horizon, 0, n}] = separation;
    results[{"error", name, horizon, ratio, n}] = omega / separation - 1.0;
    results[{"classical_error", name, horizon, ratio, n}] = omega / (speed * k) - 1.0;
    if (exact) {
      const double discrete = exact->at(static_cast<std::size_t>(i)).discrete;
      results[{"discrete_error", name, horizon, ratio, n}] = omega / discrete - 1.0;
    }
  }
  if (!unsymmetric) return;
  results[{"asymmetry", name, horizon, ratio, 0}] = modes.asymmetry;
  results[{"imaginary", name, horizon, ratio, 0}] = modes.imaginary;
}

void derive(const std::vector<double>& horizons, const std::vector<int>& ratios, Results& results) {
  for (const double horizon : horizons) {
    for (int mode = 1; mode <= bar_modes; ++mode) {
      const double n = mode;
      for (const std::string& name : bar_names()) {
        for (std::size_t r = 1; r < ratios.size(); ++r) {
          const auto coarse = results.find({"error", name, horizon, ratios[r - 1], n});
          const auto fine = results.find({"error", name, horizon, ratios[r], n});
          if (coarse == results.end() || fine == results.end()) continue;
          results[{"order", name, horizon, ratios[r], n}] =
              std::log(std::abs(coarse->second / fine->second)) /
              std::log(static_cast<double>(ratios[r]) / ratios[r - 1]);
        }
      }
      for (const int ratio : ratios) {
        for (const std::string_view suffix : {std::string_view(), with_self_cell}) {
          const std::string end(suffix);
          const auto nodes = results.find({"omega", "surface_nodes" + end, horizon, ratio, n});
          const auto odd = results.find({"omega", "odd" + end, horizon, ratio, n});
          if (nodes == results.end() || odd == results.end()) continue;
          results[{"bias", "surface_nodes" + end, horizon, ratio, n}] = nodes->second / odd->second - 1.0;
        }
      }
    }
  }
}

}  // namespace perimode::studies
