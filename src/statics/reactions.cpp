// SPDX-License-Identifier: BSD-3-Clause
#include "statics/reactions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace perimode {

namespace {

std::string face_name(const Face& face) {
  return fmt::format("{}{}", "xyz"[face.axis], face.upper ? '+' : '-');
}

std::string region_name(const Region& region) {
  if (const auto* face = std::get_if<FaceRegion>(&region.shape)) return face_name(face->face);
  if (const auto* block = std::get_if<BlockRegion>(&region.shape)) return block->name;
  if (std::holds_alternative<BoxRegion>(region.shape)) return "box";
  if (std::holds_alternative<BallRegion>(region.shape)) return "ball";
  return "nearest";
}

std::string name(const BoundaryCondition& condition) {
  if (const auto* fix = std::get_if<Fix>(&condition.what)) return fmt::format("fix {}", region_name(fix->at));
  if (const auto* prescribe = std::get_if<Prescribe>(&condition.what))
    return fmt::format("prescribe {}", region_name(prescribe->at));
  return fmt::format("wall {}", face_name(std::get<Wall>(condition.what).face));
}

/// Entries named in order, a number added where a name comes again.
std::vector<Reaction> named(const std::vector<BoundaryCondition>& conditions) {
  std::vector<Reaction> reactions;
  std::map<std::string, int> count;
  for (const auto& condition : conditions) {
    std::string text = name(condition);
    const int n = ++count[text];
    if (n > 1) text += fmt::format(" {}", n);
    reactions.push_back({text, {}});
  }
  return reactions;
}

/// Number of the condition that owns each given dof; conditions.size() for those none names.
template <int Dim>
std::vector<std::size_t> owners(const Body<Dim>& body, const std::vector<BoundaryCondition>& conditions) {
  std::vector<std::size_t> owner(body.boundary.free_number.size(), conditions.size());
  const auto take = [&](std::size_t c, const Region& at, const std::vector<int>& components) {
    for (Index i : select(at, body.particles)) {
      for (int a : components) {
        auto& entry = owner[static_cast<std::size_t>(i) * Dim + static_cast<std::size_t>(a)];
        if (entry == conditions.size()) entry = c;
      }
    }
  };
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    if (const auto* fix = std::get_if<Fix>(&conditions[c].what)) take(c, fix->at, fix->components);
    if (const auto* prescribe = std::get_if<Prescribe>(&conditions[c].what)) {
      std::vector<int> components;
      components.reserve(prescribe->components.size());
      for (const auto& [a, value] : prescribe->components) components.push_back(a);
      take(c, prescribe->at, components);
    }
  }
  return owner;
}

/// Number of the wall each ghost belongs to: the first of those it lies beyond.
template <int Dim>
std::vector<std::size_t> walls_of_ghosts(const Body<Dim>& body,
                                         const std::vector<BoundaryCondition>& conditions) {
  const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds);
  std::vector<std::size_t> wall(grid == nullptr ? 0 : grid->ghosts.size(), conditions.size());
  for (std::size_t g = 0; g < wall.size(); ++g) {
    for (std::size_t c = 0; c < conditions.size() && wall[g] == conditions.size(); ++c) {
      const auto* w = std::get_if<Wall>(&conditions[c].what);
      if (w != nullptr && grid->ghosts[g].crossings[2 * w->face.axis + (w->face.upper ? 1 : 0)] > 0)
        wall[g] = c;
    }
  }
  return wall;
}

}  // namespace

template <int Dim>
ReactionSums sum_reactions(const Body<Dim>& body, const std::vector<BoundaryCondition>& conditions,
                           const Eigen::VectorXd& u, const Eigen::VectorXd& internal,
                           const Eigen::VectorXd& load) {
  ReactionSums sums;
  sums.reactions = named(conditions);
  sums.reactions.push_back({"other", {}});
  bool other = false;
  Point<Dim> net = Point<Dim>::Zero();
  double magnitudes = 0.0;
  const auto add = [&](std::size_t entry, int a, double force) {
    sums.reactions[entry].force[static_cast<std::size_t>(a)] += force;
    other = other || entry == conditions.size();
    net[a] += force;
    magnitudes += std::abs(force);
  };

  const std::vector<std::size_t> owner = owners(body, conditions);
  for (Eigen::Index d = 0; d < load.size(); ++d) {
    net[d % Dim] += load[d];
    magnitudes += std::abs(load[d]);
    if (body.boundary.free_number[static_cast<std::size_t>(d)] >= 0) continue;
    add(owner[static_cast<std::size_t>(d)], static_cast<int>(d % Dim), internal[d] - load[d]);
  }
  const std::vector<std::size_t> wall = walls_of_ghosts(body, conditions);
  for (Index i = 0; i < body.count() && !wall.empty(); ++i) {
    const Point<Dim> here = u.segment<Dim>(static_cast<Eigen::Index>(i) * Dim);
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      if (end.neighbour < body.count()) return;
      const Point<Dim> n = end.xi / end.length;
      const Point<Dim> eta =
          partner_displacement(body.boundary, u.data(), end.neighbour, body.count()) - here;
      const Point<Dim> force = bond_stiffness(body, i, end) * n.dot(eta) * n;
      for (int a = 0; a < Dim; ++a)
        add(wall[static_cast<std::size_t>(end.neighbour - body.count())], a, force[a]);
    });
  }
  if (!other) sums.reactions.pop_back();
  sums.balance = magnitudes > 0.0 ? net.norm() / magnitudes : 0.0;
  return sums;
}

template ReactionSums sum_reactions<1>(const Body<1>&, const std::vector<BoundaryCondition>&,
                                       const Eigen::VectorXd&, const Eigen::VectorXd&,
                                       const Eigen::VectorXd&);
template ReactionSums sum_reactions<2>(const Body<2>&, const std::vector<BoundaryCondition>&,
                                       const Eigen::VectorXd&, const Eigen::VectorXd&,
                                       const Eigen::VectorXd&);
template ReactionSums sum_reactions<3>(const Body<3>&, const std::vector<BoundaryCondition>&,
                                       const Eigen::VectorXd&, const Eigen::VectorXd&,
                                       const Eigen::VectorXd&);

}  // namespace perimode
