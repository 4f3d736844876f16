// SPDX-License-Identifier: BSD-3-Clause
#include "verification/quasistatic_path.hpp"

namespace perimode {
namespace {

using test::add_crack;
using test::box_model;
using test::expect_sound;
using test::fix_face;
using test::observe_path;
using test::ObservedPath;
using test::Pair;
using test::path_options;
using test::prescribe_face;
using test::traction;

Model moved_box(const std::vector<int>& cells) {
  Model m = box_model(cells, 0.1, 3.0);
  m.volume_correction = VolumeCorrection::linear;
  m.material.critical_stretch = 1e-3;
  return m;
}

ObservedPath run(const Model& model, const std::vector<Load>& loads,
                 const std::function<void(QuasistaticOptions&)>& change = {}) {
  Body<2> body = build_body<2>(model);
  QuasistaticOptions options = path_options(model, body, loads);
  for (const bool upper : {false, true})
    options.no_fail.push_back(Region{FaceRegion{{1, upper}, 2, 0.0}, {}});
  if (change) change(options);
  return observe_path(body, options);
}

/// The bonds of an event with every particle replaced by its image, sorted again.
std::vector<Pair> mirrored(const std::vector<Pair>& bonds, int nx, int ny, int axis) {
  std::vector<Pair> images;
  for (Pair bond : bonds) {
    for (Index& i : bond) {
      const int x = i % nx, y = i / nx;
      i = axis == 0 ? nx - 1 - x + nx * y : x + nx * (ny - 1 - y);
    }
    std::sort(bond.begin(), bond.end());
    images.push_back(bond);
  }
  std::sort(images.begin(), images.end());
  return images;
}

TEST(QuasistaticSymmetry, OfAPlateWithTwoEdgeCracksIsKeptToSeparation) {
  constexpr int nx = 18, ny = 14;
  Model model = moved_box({nx, ny});
  add_crack(model, {{0.0, 0.7}, {0.4, 0.7}});
  add_crack(model, {{1.4, 0.7}, {1.8, 0.7}});
  prescribe_face(model, 1, false, 1, {{0, 0.0}, {1, -1e-3}});
  prescribe_face(model, 1, true, 1, {{0, 0.0}, {1, 1e-3}});
  const ObservedPath path = run(model, {});
  EXPECT_EQ(path.result.status, QuasistaticStatus::separated);
  ASSERT_GT(path.events.size(), 20U);
  for (const test::PathEvent& event : path.events) {
    ASSERT_EQ(mirrored(event.bonds, nx, ny, 0), event.bonds);
    ASSERT_EQ(mirrored(event.bonds, nx, ny, 1), event.bonds);
  }
  expect_sound(path, false);
}

/// A plate whose left third hangs between two necks, alike, above and below, which break at one event and
/// leave it without support; the right part then goes on to separation.
Model plate_with_island() {
  Model model = moved_box({12, 20});
  add_crack(model, {{0.4, 0.6}, {0.4, 1.4}});
  add_crack(model, {{0.0, 0.6}, {0.3, 0.6}});
  add_crack(model, {{0.0, 1.4}, {0.3, 1.4}});
  prescribe_face(model, 1, false, 1, {{0, 0.0}, {1, -1e-3}});
  prescribe_face(model, 1, true, 1, {{0, 0.0}, {1, 1e-3}});
  return model;
}

TEST(QuasistaticPieces, WithoutSupportAreHeldOrRemoved) {
  const Model model = plate_with_island();
  ObservedPath paths[2];
  for (const LoosePieces loose : {LoosePieces::hold, LoosePieces::remove}) {
    ObservedPath& path = paths[static_cast<std::size_t>(loose)];
    path = run(model, {}, [&](QuasistaticOptions& o) {
      o.loose = loose;
      o.solver.only = SolveWay::update;  // a piece on hinges shows where a pivot vanishes
    });
    EXPECT_EQ(path.result.status, QuasistaticStatus::separated) << path.result.message;
    expect_sound(path, false);
    ASSERT_FALSE(path.loose.empty());
    const auto island =
        std::max_element(path.loose.begin(), path.loose.end(),
                         [](const auto& a, const auto& b) { return a.particles < b.particles; });
    EXPECT_GE(island->particles, 20);  // of 32 between the necks
    EXPECT_FALSE(island->loaded);
    EXPECT_LT(island->event, path.rows.back().event);
  }
  // Nothing loads the pieces, so what becomes of them changes nothing else; no bond breaks but by stretch.
  EXPECT_EQ(paths[1].result.broken_bonds, paths[0].result.broken_bonds);
  ASSERT_EQ(paths[1].rows.size(), paths[0].rows.size());
  for (std::size_t n = 0; n < paths[0].rows.size(); ++n) {
    const QuasistaticRow &held = paths[0].rows[n], &removed = paths[1].rows[n];
    EXPECT_NEAR(removed.load_factor, held.load_factor, 1e-6 * held.load_factor) << "event " << n + 1;
    EXPECT_NEAR(removed.stored_energy, held.stored_energy, 1e-6 * held.stored_energy) << "event " << n + 1;
  }
}

TEST(QuasistaticPieces, GoOnUntilNothingIsStretchedWhenSeparationDoesNotStopThem) {
  for (const LoosePieces loose : {LoosePieces::hold, LoosePieces::remove}) {
    Model model = moved_box({10, 12});
    add_crack(model, {{0.0, 0.6}, {0.4, 0.6}});
    fix_face(model, 1, false, 1, {0, 1});
    const ObservedPath path = run(model, {traction(1, true, {0.0, 1e-3})}, [&](QuasistaticOptions& o) {
      o.stop.separated = false;
      o.loose = loose;
    });
    EXPECT_NE(path.result.status, QuasistaticStatus::not_converged) << path.result.message;
    expect_sound(path, true);
    EXPECT_FALSE(path.loose.empty());
  }
}

}  // namespace
}  // namespace perimode
