// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/case_sections.hpp"
#include "perimode/geometry/mesh.hpp"

namespace perimode::case_file {

namespace {

/// Names the body gives to blocks; those of a cloud's file are looked up when first needed.
class BlockNames {
 public:
  explicit BlockNames(const Model& model) : model_(model) {
    for (const BlockSpec& block : model.blocks) add(block.name);
  }

  void require(const std::string& name, const Where& where) {
    if (known(name)) return;
    if (const auto* cloud = std::get_if<CloudSpec>(&model_.particles); cloud != nullptr && !file_read_) {
      const double section = model_.dimension == 2 ? model_.thickness : 1.0;
      const CloudData data = read_particles(cloud->file, model_.dimension, section);
      const std::set<std::string> named(data.block.begin(), data.block.end());
      for (const std::string& block : named) {
        if (!block.empty()) add(block);
      }
      file_read_ = true;
      if (known(name)) return;
    }
    std::string remedy = "define it in body.blocks";
    if (!names_.empty()) {
      const std::string_view nearest = nearest_word(name, {names_.begin(), names_.end()});
      remedy = nearest.empty() ? "choose one of them" : fmt::format("the nearest is {}", nearest);
    }
    invalid_input({fmt::format("the name of a block ({})", names_.empty() ? "none is defined" : some_names()),
                   fmt::format("'{}'", name), remedy, where});
  }

 private:
  void add(const std::string& name) {
    if (known_.insert(name).second) names_.push_back(name);
  }
  [[nodiscard]] bool known(const std::string& name) const { return known_.contains(name); }

  [[nodiscard]] std::string some_names() const {
    constexpr std::size_t most = 12;
    const std::string first =
        fmt::format("{}", fmt::join(names_.begin(), names_.begin() + std::min(names_.size(), most), ", "));
    return names_.size() <= most ? first : fmt::format("{}, ... ({} in all)", first, names_.size());
  }

  const Model& model_;
  std::vector<std::string> names_;  // as they come
  std::set<std::string> known_;     // the same
  bool file_read_ = false;
};

void require_region(BlockNames& names, const Region& region) {
  if (const auto* block = std::get_if<BlockRegion>(&region.shape)) names.require(block->name, region.where);
}

}  // namespace

void check_block_names(const Case& result) {
  const Model& model = result.model;
  BlockNames names(model);
  for (const auto& [name, material] : model.block_materials) names.require(name, material.where);
  if (const auto* grid = std::get_if<GridSpec>(&model.particles)) {
    for (const Region& region : grid->remove) require_region(names, region);
  }
  for (const BoundaryCondition& condition : model.boundary) {
    if (const auto* fix = std::get_if<Fix>(&condition.what)) require_region(names, fix->at);
    if (const auto* prescribe = std::get_if<Prescribe>(&condition.what)) require_region(names, prescribe->at);
  }
  const auto require_loads = [&](const std::vector<Load>& loads) {
    for (const Load& load : loads) {
      if (load.at) require_region(names, *load.at);
    }
  };
  if (result.statics) require_loads(result.statics->loads);
  if (result.transient) {
    require_loads(result.transient->loads);
    for (const NodalDamping& damping : result.transient->damping) require_region(names, damping.at);
    for (const Region& region : result.transient->no_fail) require_region(names, region);
  }
  if (!result.quasistatic) return;
  require_loads(result.quasistatic->loads);
  require_loads(result.quasistatic->dead_loads);
  for (const Region& region : result.quasistatic->no_fail) require_region(names, region);
}

void check_horizon(const Model& model) {
  const auto* grid = std::get_if<GridSpec>(&model.particles);
  const HorizonSpec& horizon = model.horizon;
  if (grid == nullptr || horizon.rule == HorizonSpec::Rule::neighbours) return;
  const double ratio =
      horizon.rule == HorizonSpec::Rule::ratio ? horizon.value : horizon.value / grid->spacing;
  const bool none = model.volume_correction == VolumeCorrection::none;
  if (none ? ratio < 1.0 - 1e-9 : ratio <= 0.5) {
    invalid_input({none ? "a horizon of at least 1 spacing" : "a horizon of more than 1/2 spacing",
                   fmt::format("{:.6g} spacings", ratio),
                   "no particle would have a bond; 3 spacings are usual", horizon.where});
  }
  constexpr double largest_family = 1e8;
  if (std::pow(2.0 * ratio + 2.0, model.dimension) > largest_family) {
    invalid_input({fmt::format("a horizon of at most {:.0f} spacings",
                               0.5 * std::pow(largest_family, 1.0 / model.dimension) - 1.0),
                   fmt::format("{:.6g} spacings", ratio), "3 spacings are usual", horizon.where});
  }
}

}  // namespace perimode::case_file
