// SPDX-License-Identifier: BSD-3-Clause
// Modes without a factor against the same modes by block Lanczos on a factor.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "perimode/core/error.hpp"
#include "perimode/modal/modes.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

using test::add_crack;
using test::add_walls;
using test::box_model;
using test::fix_face;

struct Specimen {
  std::string name;
  Model model;
};

Model clamped(const std::vector<int>& cells, double ratio = 3.0) {
  Model m = box_model(cells, 0.1, ratio);
  std::vector<int> all;
  for (int a = 0; a < m.dimension; ++a) all.push_back(a);
  fix_face(m, 0, false, 3, all);
  return m;
}

Specimen with(std::string name, Model model, const std::function<void(Model&)>& change) {
  change(model);
  return {std::move(name), std::move(model)};
}

std::vector<Specimen> specimens() {
  return {
      {"clamped_bar", clamped({900})},
      {"clamped_plate", clamped({24, 21})},
      {"free_square", box_model({22, 22}, 0.1, 3.0)},
      {"clamped_block", clamped({11, 9, 8})},
      {"free_cube", box_model({8, 8, 8}, 0.1, 2.0)},
      {"slender_strip", clamped({260, 7})},
      with("cracked_plate", clamped({24, 24}),
           [](Model& m) {
             add_crack(m, {{1.2, 0.0}, {1.2, 1.3}});
           }),
      with("two_pieces", box_model({20, 20}, 0.1, 3.0),
           [](Model& m) {
             add_crack(m, {{1.0, -1.0}, {1.0, 3.0}});
           }),
      with("periodic_block", box_model({9, 9, 9}, 0.1, 2.0),
           [](Model& m) {
             m.periodic = {true, true, true};
           }),
      with("mirror_walls", box_model({20, 20}, 0.1, 3.0),
           [](Model& m) { add_walls(m, 0, WallType::mirror); }),
      with("inclusion", clamped({22, 22}),
           [](Model& m) {
             m.blocks.push_back({"hard", Region{BoxRegion{{0.8, 0.8}, {1.4, 1.4}}, {}}});
             m.block_materials["hard"] = m.material;
             m.block_materials["hard"].youngs_modulus = 50.0;
             m.block_materials["hard"].density = 3.0;
           }),
  };
}

template <int Dim>
ModalResult modes_of(const Model& model, ModalSolver solver, int count) {
  ModalOptions options;
  options.modes = count;
  options.solver = solver;
  return solve_modes(build_body<Dim>(model), options);
}
ModalResult modes_of(const Model& model, ModalSolver solver, int count) {
  if (model.dimension == 1) return modes_of<1>(model, solver, count);
  return model.dimension == 2 ? modes_of<2>(model, solver, count) : modes_of<3>(model, solver, count);
}

class FactorFree : public testing::TestWithParam<std::tuple<Specimen, ModalSolver>> {};

TEST_P(FactorFree, GivesTheModesOfAFactor) {
  const auto& [specimen, solver] = GetParam();
  constexpr int count = 17;
  const ModalResult expected = modes_of(specimen.model, ModalSolver::lanczos, count);
  const ModalResult got = modes_of(specimen.model, solver, count);
  ASSERT_EQ(got.status, EigenStatus::converged) << got.message;
  ASSERT_EQ(got.count(), expected.count());
  EXPECT_TRUE(got.certificate.complete);
  EXPECT_EQ(got.certificate.count, expected.certificate.count);
  EXPECT_EQ(got.rigid_modes, expected.rigid_modes);
  EXPECT_EQ(got.nonzeros, 0);
  EXPECT_GT(got.products, 0);
  for (Eigen::Index k = 0; k < count; ++k) {
    EXPECT_EQ(got.kind[k], expected.kind[k]);
    // Both are Rayleigh quotients, right to the square of their residuals or to round-off.
    EXPECT_NEAR(got.eigenvalue[k], expected.eigenvalue[k], 1e-10 * expected.eigenvalue[k])
        << "mode " << k + 1;
    // Round-off of a product is eps lambda_max, so a slender body's lowest modes have the largest; inner
    // solves to 1e-12 leave a few more digits.
    const double floor = solver == ModalSolver::inverse ? 1e-7 : 1e-9;
    const double reach = std::max(floor, 1e-14 * got.largest / std::max(got.eigenvalue[k], 1e-300));
    EXPECT_LE(got.residual[k], got.kind[k] == ModeKind::rigid ? 1e-12 : reach) << "mode " << k + 1;
  }
}

std::string specimen_name(const testing::TestParamInfo<std::tuple<Specimen, ModalSolver>>& info) {
  const bool inverse = std::get<1>(info.param) == ModalSolver::inverse;
  return std::get<0>(info.param).name + (inverse ? "_inverse" : "_chebyshev");
}
INSTANTIATE_TEST_SUITE_P(Bodies, FactorFree,
                         testing::Combine(testing::ValuesIn(specimens()),
                                          testing::Values(ModalSolver::chebyshev, ModalSolver::inverse)),
                         specimen_name);

TEST(FactorFree, MostOfAllModes) {
  // More modes than lie below the highest edge of a filter, beyond which it mixes their order.
  const Model plate = clamped({16, 14});
  for (const int count : {120, 250, 350}) {
    const ModalResult expected = modes_of(plate, ModalSolver::dense, count);
    const ModalResult got = modes_of(plate, ModalSolver::chebyshev, count);
    ASSERT_EQ(got.status, EigenStatus::converged) << got.message;
    ASSERT_EQ(got.count(), count);
    // Rayleigh quotients, right to round-off of the largest.
    const double error = (got.eigenvalue - expected.eigenvalue).cwiseAbs().maxCoeff();
    EXPECT_LE(error, 1e-12 * got.largest) << count;
  }
}

TEST(FactorFree, MoreCopiesThanABasisHolds) {
  // A horizon below 2^1/2 spacings: 20 + 18 bars side by side, whose modes at zero and at every other
  // frequency come 20- and 18-fold.
  const Model bars = box_model({20, 18}, 1.0, 1.2);
  const ModalResult expected = modes_of(bars, ModalSolver::dense, 10);
  for (const ModalSolver solver : {ModalSolver::chebyshev, ModalSolver::inverse}) {
    const ModalResult got = modes_of(bars, solver, 10);
    ASSERT_EQ(got.status, EigenStatus::converged) << got.message;
    EXPECT_EQ(got.eigenvalue, expected.eigenvalue);  // zero, all of them
    EXPECT_EQ(got.mechanisms, expected.mechanisms);
  }
}

TEST(FactorFree, RefusesWhatNeedsAFactor) {
  ModalOptions options;
  options.solver = ModalSolver::chebyshev;
  options.range = {0.0, 1.0};
  EXPECT_THROW((void)solve_modes(build_body<2>(clamped({20, 20})), options), Error);
  Model odd = box_model({12, 12}, 0.1, 3.0);
  add_walls(odd, 0, WallType::odd);
  EXPECT_THROW((void)modes_of(odd, ModalSolver::chebyshev, 5), Error);
}

}  // namespace
}  // namespace perimode
