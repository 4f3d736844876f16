// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/reference/closed_form.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>

#include "perimode/dispersion/symbol.hpp"
#include "perimode/reference/separation.hpp"

namespace perimode {
namespace {

/// A body whose modes are products of sines and cosines.
struct SeparableBody {
  Medium medium;
  double spacing = 0.0;
  std::array<Ends, 3> ends = {Ends::periodic, Ends::periodic, Ends::periodic};
  std::array<int, 3> cells = {1, 1, 1};
};

std::string face_name(const Face& face) {
  constexpr std::string_view axes = "xyz";
  return fmt::format("{}{}", axes[static_cast<std::size_t>(face.axis)], face.upper ? '+' : '-');
}

/// Whether the wall changes the sign of the normal component and keeps that of the tangential ones
/// (mirror), or the reverse (antimirror); nothing for walls whose modes are no sines and cosines.
std::optional<Ends> reflection(WallType type, int dimension) {
  if (type == WallType::mirror || (dimension == 1 && type == WallType::odd)) return Ends::mirror;
  if (type == WallType::antimirror || (dimension == 1 && type == WallType::even)) return Ends::antimirror;
  return std::nullopt;
}

/// Why the bonds are not the same everywhere, or nothing.
std::string inhomogeneity(const Model& model) {
  const auto* grid = std::get_if<GridSpec>(&model.particles);
  if (grid == nullptr) return "the particles are a cloud, not a grid";
  if (!grid->remove.empty()) return "particles are removed from the grid";
  if (!model.precracks.empty()) return "the body has pre-cracks";
  if (!model.block_materials.empty()) return "blocks have a material of their own";
  if (model.horizon.rule == HorizonSpec::Rule::neighbours) return "the horizon is set by neighbours";
  return {};
}

/// Fills body.ends, or says why the ends of some axis do not separate.
std::string read_ends(const Model& model, SeparableBody& body) {
  std::array<std::array<std::optional<Ends>, 2>, 3> walls;
  for (const BoundaryCondition& condition : model.boundary) {
    const auto* wall = std::get_if<Wall>(&condition.what);
    if (wall == nullptr) return "displacements are fixed or prescribed in a region";
    const std::optional<Ends> kind = reflection(wall->type, model.dimension);
    if (!kind)
      return fmt::format("the modes of the wall at {} are not sines and cosines", face_name(wall->face));
    auto& slot = walls[static_cast<std::size_t>(wall->face.axis)][wall->face.upper ? 1 : 0];
    if (slot) return fmt::format("{} has two walls", face_name(wall->face));
    slot = kind;
  }
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(model.dimension); ++axis) {
    const auto& [lower, upper] = walls[axis];
    if (model.periodic[axis]) {
      if (lower || upper) return fmt::format("axis {} is periodic and has a wall", "xyz"[axis]);
      continue;
    }
    for (const bool side : {false, true}) {
      const bool free = side ? !upper : !lower;
      if (free) return fmt::format("the face {} is free", face_name({static_cast<int>(axis), side}));
    }
    body.ends[axis] = *lower == *upper ? *lower : Ends::mixed;
  }
  return {};
}

/// The body, or the reason in `why_not`.
std::optional<SeparableBody> separate(const Model& model, std::string& why_not) {
  SeparableBody body;
  why_not = inhomogeneity(model);
  if (why_not.empty()) why_not = read_ends(model, body);
  if (!why_not.empty()) return std::nullopt;
  const auto& grid = std::get<GridSpec>(model.particles);
  body.spacing = grid.spacing;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(model.dimension); ++axis) {
    body.cells[axis] = static_cast<int>(std::lround((grid.upper[axis] - grid.lower[axis]) / grid.spacing));
  }
  const double section = model.dimension == 1 ? model.area : (model.dimension == 2 ? model.thickness : 1.0);
  const bool ratio = model.horizon.rule == HorizonSpec::Rule::ratio;
  body.medium = {model.material,
                 {model.dimension, model.plane, section},
                 ratio ? model.horizon.value * grid.spacing : model.horizon.value};
  return body;
}

struct Candidate {
  double squared = 0.0;  ///< omega^2
  double k = 0.0;        ///< |k|
  Branch branch = Branch::pressure;
  int multiplicity = 1;
};

/// Appends the modes of one wave vector: eigenpairs of the symbol restricted to the components that exist.
/// These do not couple to the others (the sines of the coupling vanish). Pressure is the eigenvector most
/// parallel to k, if it lies among the existing components.
template <int Dim>
void append_modes(Eigen::Matrix<double, Dim, Dim> symbol, const Point<Dim>& k,
                  const std::array<bool, Dim>& exists, int multiplicity, std::vector<Candidate>& modes) {
  const double above = 2.0 * symbol.trace();  // moves the missing components behind all others
  Point<Dim> direction = k;
  Eigen::Index size = Dim;
  for (Eigen::Index a = 0; a < Dim; ++a) {
    if (exists[static_cast<std::size_t>(a)]) continue;
    symbol.row(a).setZero();
    symbol.col(a).setZero();
    symbol(a, a) = above;
    direction[a] = 0.0;
    --size;
  }
  if (size == 0) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> solver(symbol);
  Eigen::Index parallel = 0;
  (solver.eigenvectors().transpose() * direction).cwiseAbs().maxCoeff(&parallel);
  const bool has_pressure = Dim == 1 || 2.0 * direction.squaredNorm() >= k.squaredNorm();
  for (Eigen::Index i = 0; i < size; ++i) {
    const Branch branch = has_pressure && i == parallel ? Branch::pressure : Branch::shear;
    modes.push_back({std::max(0.0, solver.eigenvalues()[i]), k.norm(), branch, multiplicity});
  }
}

template <int Dim>
std::vector<Candidate> all_modes(const SeparableBody& body, const Family<Dim>& family,
                                 std::span<const double> rates) {
  std::array<std::vector<AxisWave>, Dim> waves;
  std::size_t total = 1;
  for (std::size_t a = 0; a < Dim; ++a) {
    waves[a] = axis_waves(body.ends[a], body.spacing * body.cells[a], body.cells[a]);
    total *= waves[a].size();
  }
  std::vector<Candidate> modes;
  modes.reserve(total * Dim);
  for (std::size_t number = 0; number < total; ++number) {
    Point<Dim> k;
    std::array<bool, Dim> exists;
    exists.fill(true);
    int multiplicity = 1;
    std::size_t rest = number;
    for (std::size_t a = 0; a < Dim; ++a) {
      const AxisWave& wave = waves[a][rest % waves[a].size()];
      rest /= waves[a].size();
      k[static_cast<Eigen::Index>(a)] = wave.k;
      multiplicity *= wave.multiplicity;
      for (std::size_t b = 0; b < Dim; ++b) exists[b] = exists[b] && (a == b ? wave.normal : wave.tangential);
    }
    append_modes<Dim>(lattice_symbol<Dim>(family, rates, k), k, exists, multiplicity, modes);
  }
  return modes;
}

template <int Dim>
std::vector<ClosedFormMode> lowest_modes(const Model& model, const SeparableBody& body, int count) {
  const Family<Dim> family =
      make_family<Dim>(body.spacing, body.medium.horizon, model.volume_correction, model.self_cell);
  const std::vector<double> rates = bond_rates<Dim>(body.medium, family, model.calibration);
  std::vector<Candidate> candidates = all_modes<Dim>(body, family, rates);
  const auto needed = static_cast<std::ptrdiff_t>(
      std::min<std::size_t>(candidates.size(), static_cast<std::size_t>(std::max(count, 0))));
  std::partial_sort(candidates.begin(), candidates.begin() + needed, candidates.end(),
                    [](const Candidate& a, const Candidate& b) {
                      return std::tie(a.squared, a.k, a.branch) < std::tie(b.squared, b.k, b.branch);
                    });
  std::vector<ClosedFormMode> modes;
  for (std::ptrdiff_t i = 0; i < needed; ++i) {
    const Candidate& candidate = candidates[static_cast<std::size_t>(i)];
    const ClosedFormMode mode = {std::sqrt(candidate.squared),
                                 continuum_frequency(body.medium, candidate.branch, candidate.k),
                                 candidate.k * classical_speed(body.medium, candidate.branch)};
    for (int copy = 0; copy < candidate.multiplicity && static_cast<int>(modes.size()) < count; ++copy) {
      modes.push_back(mode);
    }
  }
  return modes;
}

}  // namespace

std::optional<std::vector<ClosedFormMode>> closed_form_modes(const Model& model, int count,
                                                             std::string& why_not) {
  const std::optional<SeparableBody> body = separate(model, why_not);
  if (!body) return std::nullopt;
  switch (model.dimension) {
    case 1:
      return lowest_modes<1>(model, *body, count);
    case 2:
      return lowest_modes<2>(model, *body, count);
    default:
      return lowest_modes<3>(model, *body, count);
  }
}

}  // namespace perimode
