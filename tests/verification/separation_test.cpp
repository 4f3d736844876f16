// SPDX-License-Identifier: BSD-3-Clause
// A bar of length 1, delta = 0.1, wave speed 5000 m/s, inverse-distance kernel, against the separation of
// variables of the nonlocal continuum [scabbia2023]. Numbers are those of an independent NumPy computation.
#include "perimode/reference/separation.hpp"

#include <cmath>
#include <numbers>

#include "verification/modes_of.hpp"

namespace perimode {
namespace {

using test::add_walls;
using test::box_model;
using test::certified_modes;
using test::lowest;

constexpr double horizon = 0.1, speed = 5000.0;

Model bar(int m, WallType type) {
  Model model = box_model({10 * m}, horizon / m, m);
  model.material.youngs_modulus = speed * speed;
  model.material.micromodulus.kernel = Kernel::inverse_distance;
  model.volume_correction = VolumeCorrection::linear;
  add_walls(model, 0, type);
  return model;
}

double continuum(int n) { return speed * std::sqrt(scabbia_lambda(horizon, n * std::numbers::pi)); }

struct TableRow {
  int mode;
  double continuum, odd, surface_nodes;  // rad/s, m = 10
};
constexpr TableRow frequencies[] = {{1, 1.5686458861e4, 1.5288055010e4, 1.5288290666e4},
                                    {2, 3.1244555297e4, 3.0443743290e4, 3.0445616396e4},
                                    {3, 4.6549230270e4, 4.5338059659e4, 4.5344314050e4},
                                    {5, 7.5933792828e4, 7.3862894136e4, 7.3890885937e4},
                                    {10, 1.3816714221e5, 1.3356565491e5, 1.3375785955e5},
                                    {15, 1.8137362049e5, 1.7347218409e5, 1.7398124917e5},
                                    {20, 2.1107473968e5, 1.9904248050e5, 1.9993794979e5}};

TEST(Separation, FrequenciesOfTheContinuumAndOfBothWalls) {
  const auto odd = certified_modes<1>(bar(10, WallType::odd), lowest(20));
  const auto nodes = certified_modes<1>(bar(10, WallType::surface_nodes), lowest(20));
  for (const TableRow& row : frequencies) {
    EXPECT_NEAR(continuum(row.mode), row.continuum, 1e-9 * row.continuum);
    EXPECT_NEAR(odd.angular_frequency[row.mode - 1], row.odd, 1e-9 * row.odd);
    EXPECT_NEAR(nodes.angular_frequency[row.mode - 1], row.surface_nodes, 1e-9 * row.surface_nodes);
  }
}

constexpr int modes_in_table[] = {1, 2, 3, 5, 10, 15, 20};
struct ErrorRow {
  WallType type;
  int m;
  double error[7];  // omega_h / omega_continuum - 1
};
constexpr ErrorRow errors[] = {
    {WallType::odd, 10, {-2.5398e-2, -2.5630e-2, -2.6019e-2, -2.7272e-2, -3.3304e-2, -4.3564e-2, -5.7005e-2}},
    {WallType::odd, 25, {-1.0079e-2, -1.0166e-2, -1.0311e-2, -1.0781e-2, -1.3080e-2, -1.7090e-2, -2.2404e-2}},
    {WallType::odd, 50, {-5.0266e-3, -5.0689e-3, -5.1398e-3, -5.3697e-3, -6.5011e-3, -8.4911e-3, -1.1138e-2}},
    {WallType::surface_nodes,
     10,
     {-2.5383e-2, -2.5571e-2, -2.5885e-2, -2.6904e-2, -3.1913e-2, -4.0758e-2, -5.2762e-2}},
    {WallType::surface_nodes,
     25,
     {-1.0069e-2, -1.0126e-2, -1.0221e-2, -1.0523e-2, -1.1959e-2, -1.4544e-2, -1.8353e-2}},
    {WallType::surface_nodes,
     50,
     {-5.0180e-3, -5.0342e-3, -5.0605e-3, -5.1391e-3, -5.4461e-3, -6.0085e-3, -7.1417e-3}}};

TEST(Separation, ErrorsOfBothWallsAgainstTheContinuum) {
  for (const ErrorRow& row : errors) {
    const auto r = certified_modes<1>(bar(row.m, row.type), lowest(20));
    for (int i = 0; i < 7; ++i) {
      const int n = modes_in_table[i];
      const double error = r.angular_frequency[n - 1] / continuum(n) - 1.0;
      EXPECT_NEAR(error, row.error[i], 1e-4 * std::abs(row.error[i])) << "m " << row.m << " mode " << n;
    }
  }
}

// The relative error is -1/(4 m) and higher powers of 1/m, which grow with the mode: at m = 10 they still
// show.
TEST(Separation, OddWallsConvergeWithOrderOneInTheRatio) {
  const auto errors_at = [](int m) {
    const auto r = certified_modes<1>(bar(m, WallType::odd), lowest(20));
    std::vector<double> error;
    for (int n = 1; n <= 20; ++n) error.push_back(1.0 - r.angular_frequency[n - 1] / continuum(n));
    return error;
  };
  const auto coarse = errors_at(10), middle = errors_at(50), fine = errors_at(100);
  for (std::size_t n = 0; n < 20; ++n) {
    EXPECT_NEAR(std::log10(coarse[n] / fine[n]), 1.0, 0.02) << "mode " << n + 1;
    EXPECT_NEAR(std::log2(middle[n] / fine[n]), 1.0, 0.01) << "mode " << n + 1;
  }
}

TEST(Separation, TheSelfCellTermMakesItOrderTwo) {
  double error[2];
  const int ratios[] = {10, 100};
  for (int i : {0, 1}) {
    Model m = bar(ratios[i], WallType::odd);
    m.self_cell = true;
    error[i] = certified_modes<1>(m, lowest(20)).angular_frequency[0] / continuum(1) - 1.0;
  }
  EXPECT_NEAR(error[0], -8.9e-6, 0.05e-6);  // the digits given
  EXPECT_NEAR(error[1], -7.0e-8, 0.05e-8);
}

TEST(Separation, AllEigenvaluesBetweenSurfaceNodesAreRealAndPositive) {
  for (auto kernel : {Kernel::inverse_distance, Kernel::constant, Kernel::gaussian}) {
    for (int m : {5, 10, 20}) {
      Model model = bar(m, WallType::surface_nodes);
      model.material.micromodulus.kernel = kernel;
      const auto r = certified_modes<1>(model, lowest(10 * m));
      EXPECT_EQ(r.count(), 10 * m);
      EXPECT_LT(r.imaginary, 1e-8);
      EXPECT_GT(r.eigenvalue[0], 0.0);
      EXPECT_GT(r.asymmetry, 0.05) << "the problem is not symmetric";
    }
  }
}

}  // namespace
}  // namespace perimode
