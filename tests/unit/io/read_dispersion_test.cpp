// SPDX-License-Identifier: BSD-3-Clause
#include "unit/io/bad_case.hpp"

namespace perimode {
namespace {

using test::BadCase;
using test::replace_line;
using test::TemporaryFolder;
using testing::ElementsAre;

DispersionSpec read_dispersion(const char* base, const std::string& section) {
  const TemporaryFolder folder;
  (void)folder.write("cloud.csv", test::sample_cloud());
  const std::string text =
      replace_line(test::sample_cases().at(base), "analysis", "analysis: { dispersion: " + section + " }");
  return *read_case(folder.write("case.yaml", text)).dispersion;
}

TEST(ReadDispersion, AnEmptySectionIsAllDefaults) {
  for (const char* section : {"", "{}"}) {
    for (const char* base : {"bar", "plate", "solid", "cloud"}) {
      const DispersionSpec spec = read_dispersion(base, section);
      EXPECT_TRUE(spec.path.empty());
      EXPECT_EQ(spec.points, 300);
      EXPECT_EQ(spec.phase_error, 0.05);
      EXPECT_EQ(spec.integrator, StepIntegrator::central_difference);
      EXPECT_FALSE(spec.zone || spec.time_step || spec.polar || spec.finite_difference || spec.optimise ||
                   spec.fit || spec.spectrum || spec.waves);
      EXPECT_GT(spec.where.line, 0);
    }
  }
}

TEST(ReadDispersion, EveryKeyOfAnAnalysis) {
  const DispersionSpec spec = read_dispersion(
      "plate",
      "{ path: [[0, 0], [1, 0.5], [-1, 1]], points: 50, zone: 64, time_step: 1.0e-8, integrator: newmark, "
      "phase_error: 0.01, polar: { wave_number: 0.25, directions: 36 }, spectrum: { run: out/pulse } }");
  ASSERT_EQ(spec.path.size(), 3U);
  EXPECT_THAT(spec.path[1], ElementsAre(1.0, 0.5));
  EXPECT_THAT(spec.path[2], ElementsAre(-1.0, 1.0));
  EXPECT_EQ(spec.points, 50);
  EXPECT_EQ(spec.zone, 64);
  EXPECT_EQ(spec.time_step, 1e-8);
  EXPECT_EQ(spec.integrator, StepIntegrator::newmark);
  EXPECT_EQ(spec.phase_error, 0.01);
  ASSERT_TRUE(spec.polar.has_value());
  EXPECT_EQ(spec.polar->wave_number, 0.25);
  EXPECT_EQ(spec.polar->directions, 36);
  ASSERT_TRUE(spec.spectrum.has_value());
  EXPECT_EQ(spec.spectrum->run.filename(), "pulse");
  EXPECT_TRUE(spec.spectrum->run.is_absolute());  // it starts at the folder of the case, which is here
  EXPECT_EQ(read_dispersion("bar", "{ finite_difference: 0 }").finite_difference, 0.0);
  EXPECT_EQ(read_dispersion("bar", "{ finite_difference: 1 }").finite_difference, 1.0);
  EXPECT_EQ(read_dispersion("cloud", "{ waves: 7, time_step: 1.0e-8 }").waves, 7);
}

TEST(ReadDispersion, EveryKeyOfAnOptimisation) {
  const DispersionSpec spec = read_dispersion(
      "solid",
      "{ optimise: { method: least_squares, norm: l2, domain: zone, lower_bound: -0.5, poissons_ratio: 0.3, "
      "weights: [2, 0], fit: 0 } }");
  ASSERT_TRUE(spec.optimise.has_value());
  EXPECT_EQ(spec.optimise->method, OptimiseMethod::least_squares);
  EXPECT_EQ(spec.optimise->norm, ErrorNorm::l2);
  EXPECT_EQ(read_dispersion("solid", "{ optimise: { norm: l1 } }").optimise->norm, ErrorNorm::l1);
  EXPECT_EQ(spec.optimise->domain, ErrorDomain::zone);
  EXPECT_EQ(spec.optimise->lower_bound, -0.5);
  EXPECT_EQ(spec.optimise->poissons_ratio, 0.3);
  EXPECT_THAT(spec.optimise->weights, ElementsAre(2.0, 0.0));
  EXPECT_EQ(spec.fit, 0);
  for (const char* section :
       {"{ optimise: }", "{ optimise: {} }",
        "{ optimise: { lower_bound: none, poissons_ratio: theory, method: least_squares } }"}) {
    const DispersionSpec plain = read_dispersion("solid", section);
    ASSERT_TRUE(plain.optimise.has_value());
    EXPECT_EQ(plain.optimise->norm, ErrorNorm::l2);
    EXPECT_EQ(plain.optimise->domain, ErrorDomain::contour);
    EXPECT_FALSE(plain.optimise->lower_bound || plain.optimise->poissons_ratio || plain.fit);
    EXPECT_THAT(plain.optimise->weights, ElementsAre(1.0, 1.0));
  }
}

TEST(ReadDispersion, MethodsOf1D) {
  const TemporaryFolder folder;
  const std::string text =
      replace_line(test::sample_cases().at("bar"), "volume_correction", "  volume_correction: none");
  const auto file = folder.write("case.yaml", text);
  const std::pair<const char*, OptimiseMethod> methods[] = {
      {"point_collocation", OptimiseMethod::point_collocation},
      {"subdomain_collocation", OptimiseMethod::subdomain_collocation},
      {"galerkin", OptimiseMethod::galerkin}};
  for (const auto& [word, method] : methods) {
    const Case c = read_case(file, {std::string("analysis.dispersion.optimise.method=") + word});
    EXPECT_EQ(c.dispersion->optimise->method, method);
  }
}

class BadDispersionTest : public testing::TestWithParam<BadCase> {};

TEST_P(BadDispersionTest, GivesOneErrorWithPlaceExpectationAndRemedy) { test::expect_complaint(GetParam()); }

#define PERIMODE_DISPERSION(text) "analysis: { dispersion: { " text " } }"
#define PERIMODE_OPTIMISE(text) PERIMODE_DISPERSION("optimise: { " text " }")
const BadCase analysis[] = {
    {"word", "plate", "analysis", "analysis: { dispersion: ^waves }", {"analysis.dispersion: a map", "path"}},
    {"key", "plate", "analysis", PERIMODE_DISPERSION("^point: 3"), {"nearest valid key is points"}},
    {"path_of_one", "plate", "analysis", PERIMODE_DISPERSION("path: ^[[0, 0]]"), {"at least 2 points"}},
    {"path_of_none",
     "plate",
     "analysis",
     PERIMODE_DISPERSION("path: ^[]"),
     {"at least 2 points", "pi/spacing"}},
    {"path_no_list", "plate", "analysis", PERIMODE_DISPERSION("path: ^gamma"), {"a list"}},
    {"path_of_1d",
     "plate",
     "analysis",
     PERIMODE_DISPERSION("path: [^[0], [1]]"),
     {"a list of 2 numbers in pi/spacing", "dimension 2"}},
    {"path_of_2d",
     "solid",
     "analysis",
     PERIMODE_DISPERSION("path: [[0, 0, 0], ^[1, 0]]"),
     {"path.1", "3 numbers"}},
    {"path_word", "bar", "analysis", PERIMODE_DISPERSION("path: [[0], [^pi]]"), {"path.1.0"}},
    {"path_standing",
     "plate",
     "analysis",
     PERIMODE_DISPERSION("path: [[1, 0], ^[1, 0]]"),
     {"other than the one before"}},
    {"points_few", "plate", "analysis", PERIMODE_DISPERSION("points: ^3"), {"at least 4 points", "corner"}},
    {"points_of_path",
     "bar",
     "analysis",
     PERIMODE_DISPERSION("path: [[0], [1], [0]], points: ^2"),
     {"at least 3 points"}},
    {"points_one", "bar", "analysis", PERIMODE_DISPERSION("points: ^1"), {"a whole number >= 2"}},
    {"zone_one", "plate", "analysis", PERIMODE_DISPERSION("zone: ^1"), {"a whole number >= 2"}},
    {"zone_endless",
     "solid",
     "analysis",
     PERIMODE_DISPERSION("zone: ^1001"),
     {"at most 1000 points per axis"}},
    {"time_step_zero", "plate", "analysis", PERIMODE_DISPERSION("time_step: ^0"), {"> 0 in s"}},
    {"time_step_unit", "plate", "analysis", PERIMODE_DISPERSION("time_step: ^1 us"), {"units are not read"}},
    {"integrator_alone",
     "plate",
     "analysis",
     PERIMODE_DISPERSION("^integrator: newmark"),
     {"`integrator` beside `time_step` only"}},
    {"integrator_word",
     "plate",
     "analysis",
     PERIMODE_DISPERSION("time_step: 1, integrator: ^newmrk"),
     {"nearest is newmark"}},
    {"phase_error_zero", "plate", "analysis", PERIMODE_DISPERSION("phase_error: ^0"), {"a number > 0"}},
    {"phase_error_percent", "plate", "analysis", PERIMODE_DISPERSION("phase_error: ^5"), {"> 0 and < 1"}},
    {"polar_of_bar",
     "bar",
     "analysis",
     PERIMODE_DISPERSION("polar: ^{ wave_number: 1 }"),
     {"1D", "one direction"}},
    {"polar_empty", "plate", "analysis", PERIMODE_DISPERSION("^polar: {}"), {"'wave_number'"}},
    {"polar_negative",
     "plate",
     "analysis",
     PERIMODE_DISPERSION("polar: { wave_number: ^-1 }"),
     {"pi/spacing"}},
    {"polar_none",
     "plate",
     "analysis",
     PERIMODE_DISPERSION("polar: { wave_number: 1, directions: ^0 }"),
     {">= 1"}},
    {"finite_difference_2d",
     "plate",
     "analysis",
     PERIMODE_DISPERSION("^finite_difference: 0.5"),
     {"2D", "1D"}},
    {"courant",
     "bar",
     "analysis",
     PERIMODE_DISPERSION("finite_difference: ^1.5"),
     {"Courant number >= 0 and <= 1"}},
    {"spectrum_empty", "plate", "analysis", PERIMODE_DISPERSION("^spectrum: {}"), {"'run'"}},
    {"waves_of_grid",
     "plate",
     "analysis",
     PERIMODE_DISPERSION("^waves: 3"),
     {"no `waves` with a grid", "path"}},
    {"path_of_cloud",
     "cloud",
     "analysis",
     PERIMODE_DISPERSION("^path: [[0, 0], [1, 0]]"),
     {"no `path` with a cloud"}},
    {"zone_of_cloud",
     "cloud",
     "analysis",
     PERIMODE_DISPERSION("^zone: 10"),
     {"no `zone` with a cloud", "grid"}},
    {"polar_of_cloud",
     "cloud",
     "analysis",
     PERIMODE_DISPERSION("^polar: { wave_number: 1 }"),
     {"no `polar`"}},
    {"optimise_of_cloud",
     "cloud",
     "analysis",
     PERIMODE_DISPERSION("^optimise: {}"),
     {"no `optimise` with a cloud"}},
    {"path_far", "plate", "analysis", PERIMODE_DISPERSION("path: [[0, 0], ^[0, 101]]"), {"-100 to 100"}},
    {"points_many", "plate", "analysis", PERIMODE_DISPERSION("points: ^1000001"), {"at most 1000000"}},
    {"waves_many", "cloud", "analysis", PERIMODE_DISPERSION("waves: ^1000001"), {"at most 1000000"}},
    {"waves_zero", "cloud", "analysis", PERIMODE_DISPERSION("waves: ^0"), {"a whole number >= 1"}},
};
INSTANTIATE_TEST_SUITE_P(Analysis, BadDispersionTest, testing::ValuesIn(analysis), test::name_of);

const BadCase optimise[] = {
    {"key", "solid", "analysis", PERIMODE_OPTIMISE("^bound: 0"), {"lower_bound"}},
    {"method_word",
     "solid",
     "analysis",
     PERIMODE_OPTIMISE("method: ^least_square"),
     {"nearest is least_squares"}},
    {"method_of_1d",
     "solid",
     "analysis",
     PERIMODE_OPTIMISE("method: ^galerkin"),
     {"least_squares in 3D", "1D only"}},
    {"norm_word", "solid", "analysis", PERIMODE_OPTIMISE("norm: ^l3"), {"one of l2, l1"}},
    {"domain_word", "solid", "analysis", PERIMODE_OPTIMISE("domain: ^path"), {"one of contour, zone"}},
    {"l1_over_the_zone",
     "solid",
     "analysis",
     PERIMODE_OPTIMISE("norm: l1, domain: ^zone"),
     {"contour with the norm l1", "l2"}},
    {"bound_word", "solid", "analysis", PERIMODE_OPTIMISE("lower_bound: ^no"), {"a number, or none"}},
    {"ratio_word", "solid", "analysis", PERIMODE_OPTIMISE("poissons_ratio: ^steel"), {"a number, or theory"}},
    {"ratio_half", "solid", "analysis", PERIMODE_OPTIMISE("poissons_ratio: ^0.5"), {"> -1 and < 0.5"}},
    {"weights_one", "solid", "analysis", PERIMODE_OPTIMISE("weights: ^[1]"), {"2 numbers, for P and S"}},
    {"weights_negative", "solid", "analysis", PERIMODE_OPTIMISE("weights: [1, ^-1]"), {"weights.1"}},
    {"weights_zero",
     "solid",
     "analysis",
     PERIMODE_OPTIMISE("weights: ^[0, 0]"),
     {"a weight > 0", "got [0, 0]"}},
    {"fit_negative", "solid", "analysis", PERIMODE_OPTIMISE("fit: ^-1"), {"a whole number >= 0"}},
    {"correction",
     "plate",
     "analysis",
     PERIMODE_DISPERSION("optimise: ^{}"),
     {"volume_correction: none", "got linear"}},
};
INSTANTIATE_TEST_SUITE_P(Optimise, BadDispersionTest, testing::ValuesIn(optimise), test::name_of);

TEST(ReadDispersion, OnlyMultiplesOfTheConstantKernelAreOptimised) {
  const TemporaryFolder folder;
  const auto file = folder.write("case.yaml", test::sample_cases().at("solid"));
  const std::string section = "analysis.dispersion={ optimise: {} }";
  for (const char* kernel : {"{ kernel: constant }", "{ kernel: shells, alpha: [1, 1, 1, 1] }",
                             "{ kernel: fourier, a0: 1, a: [1], w: 1 }"}) {
    EXPECT_NO_THROW((void)read_case(file, {std::string("material.micromodulus=") + kernel, section}));
  }
  for (const char* kernel : {"conical", "gaussian", "inverse_distance"}) {
    try {
      (void)read_case(file, {std::string("material.micromodulus.kernel=") + kernel, section});
      FAIL() << kernel;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
      EXPECT_THAT(error.what(), testing::HasSubstr("of the kernel constant, fourier or shells"));
    }
  }
}

TEST(ReadDispersion, EquationsMakeNoErrorLeast) {
  const TemporaryFolder folder;
  const auto file = folder.write("case.yaml", test::sample_cases().at("bar"));
  const auto read_with = [&](const std::string& keys) {
    return read_case(
        file, {"material.volume_correction=none", "analysis.dispersion={ optimise: { " + keys + " } }"});
  };
  const Case c = read_with(
      "method: galerkin, norm: l2, domain: zone, lower_bound: none, poissons_ratio: theory, weights: [1, 2]");
  EXPECT_EQ(c.dispersion->optimise->method, OptimiseMethod::galerkin);
  const std::pair<const char*, const char*> bad[] = {
      {"method: galerkin, norm: l1", "l2 with a method of equations"},
      {"method: point_collocation, lower_bound: 0", "none with a method of equations"},
      {"poissons_ratio: 0.3", "no Poisson's ratio in 1D"}};
  for (const auto& [keys, says] : bad) {
    try {
      (void)read_with(keys);
      FAIL() << keys;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
      EXPECT_THAT(error.what(), testing::HasSubstr(says));
    }
  }
}

}  // namespace
}  // namespace perimode
