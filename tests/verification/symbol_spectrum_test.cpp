// SPDX-License-Identifier: BSD-3-Clause
// The eigenvalues of the symbols of all wave vectors of a periodic body are all eigenvalues of its assembled
// M^-1 K, each as often.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "perimode/assembly/assemble.hpp"
#include "perimode/dispersion/waves.hpp"
#include "perimode/linalg/threads.hpp"
#include "support/models.hpp"

namespace perimode {
namespace {

/// Random bodies; their numbers repeat from the seed on every machine.
class Chance {
 public:
  explicit Chance(unsigned seed) : gen_(seed) {}
  int pick(int low, int high) {
    return low + static_cast<int>(gen_() % static_cast<unsigned>(high - low + 1));
  }
  double real(double low, double high) {
    return low + (high - low) * static_cast<double>(gen_()) / 4294967296.0;
  }

 private:
  std::mt19937 gen_;
};

/// A kernel; the multipliers of fourier and shells take both signs.
template <int Dim>
Micromodulus random_kernel(Kernel kernel, double spacing, double ratio, Chance& chance) {
  Micromodulus m;
  m.kernel = kernel;
  m.p = chance.real(0.5, 2.5);
  if (kernel == Kernel::fourier) {
    m.spacing = spacing;
    m.w = chance.real(0.5, 2.5);
    m.a0 = chance.real(-1.0, 2.0);
    m.a = {chance.real(-3.0, 3.0), chance.real(-3.0, 3.0)};
  } else if (kernel == Kernel::shells) {
    const auto family = make_family<Dim>(spacing, ratio * spacing, VolumeCorrection::none);
    m.shells.resize(family.shell.size());
    for (std::size_t i = 0; i < family.shell.size(); ++i) {
      std::copy(family.shell[i].begin(), family.shell[i].end(), m.shells[i].offset.begin());
      m.shells[i].alpha = chance.real(-2.0, 3.0);
    }
  }
  return m;
}

template <int Dim>
Model random_model(Kernel kernel, Chance& chance) {
  constexpr int most = Dim == 1 ? 30 : Dim == 2 ? 8 : 5;
  std::vector<int> cells(Dim);
  for (int& n : cells) n = chance.pick(Dim == 1 ? 3 : 2, most);
  const double spacing = chance.real(0.1, 2.0), ratio = chance.real(1.0, Dim == 3 ? 2.5 : 4.0);
  Model m = test::box_model(cells, spacing, ratio);
  m.periodic = {true, Dim > 1, Dim > 2};
  m.plane = chance.pick(0, 1) == 0 ? Plane::stress : Plane::strain;
  m.thickness = m.area = chance.real(0.1, 2.0);
  m.material.youngs_modulus = chance.real(0.5, 5.0);
  m.material.density = chance.real(0.5, 5.0);
  m.material.micromodulus = random_kernel<Dim>(kernel, spacing, ratio, chance);
  if (!is_lattice_kernel(kernel)) {
    m.calibration = static_cast<Calibration>(chance.pick(0, 2));
    m.volume_correction = static_cast<VolumeCorrection>(chance.pick(0, Dim == 1 ? 2 : 1));
    m.self_cell = Dim == 1 && kernel == Kernel::inverse_distance && chance.pick(0, 1) == 1;
  }
  return m;
}

/// All eigenvalues of M^-1 K, ascending: all masses of a grid are equal.
template <int Dim>
std::vector<double> assembled_eigenvalues(const Model& model) {
  const Body<Dim> body = build_body<Dim>(model);
  const BlockCsr k = assemble_stiffness(body);
  const Eigen::Index n = static_cast<Eigen::Index>(body.count()) * Dim;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (Index row = 0; row < body.count(); ++row) {
    for (Offset e = k.row_start[static_cast<std::size_t>(row)];
         e < k.row_start[static_cast<std::size_t>(row) + 1]; ++e) {
      for (int a = 0; a < Dim; ++a) {
        for (int b = 0; b < Dim; ++b)
          dense(Dim * row + a, Dim * k.column[static_cast<std::size_t>(e)] + b) +=
              k.value[static_cast<std::size_t>(e) * Dim * Dim + static_cast<std::size_t>(a * Dim + b)];
      }
    }
  }
  dense /= lumped_mass(body)[0];
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues();
  return {values.begin(), values.end()};
}

/// omega^2 of all branches at all wave vectors of the periodic body, ascending.
template <int Dim>
std::vector<double> symbol_eigenvalues(const Model& model) {
  const Lattice<Dim> lattice = make_lattice<Dim>(model);
  const auto& grid = std::get<GridSpec>(model.particles);
  std::array<int, Dim> cells;
  int all = 1;
  for (std::size_t a = 0; a < Dim; ++a) {
    cells[a] = static_cast<int>(std::lround((grid.upper[a] - grid.lower[a]) / grid.spacing));
    all *= cells[a];
  }
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(all) * Dim);
  for (int i = 0; i < all; ++i) {
    Point<Dim> k;
    for (int a = 0, rest = i; a < Dim; rest /= cells[static_cast<std::size_t>(a++)]) {
      const int n = cells[static_cast<std::size_t>(a)];
      k[a] = 2.0 * std::numbers::pi * (rest % n) / (n * grid.spacing);
    }
    const auto waves = plane_waves<Dim>(lattice, k, Point<Dim>::Unit(0));
    values.insert(values.end(), waves.squared.begin(), waves.squared.end());
  }
  std::sort(values.begin(), values.end());
  return values;
}

template <int Dim>
void expect_same_spectrum(int bodies, unsigned seed) {
  set_threads(1);  // the bodies are tiny
  Chance chance(seed);
  for (int i = 0; i < bodies; ++i) {
    const auto kernel = static_cast<Kernel>(i % 6);
    const Model model = random_model<Dim>(kernel, chance);
    const auto expected = assembled_eigenvalues<Dim>(model);
    const auto found = symbol_eigenvalues<Dim>(model);
    ASSERT_EQ(found.size(), expected.size());
    const double largest = std::max(std::abs(expected.front()), std::abs(expected.back()));
    double worst = 0.0;
    for (std::size_t e = 0; e < found.size(); ++e) worst = std::max(worst, std::abs(found[e] - expected[e]));
    EXPECT_LE(worst, 1e-10 * largest) << Dim << "D, kernel " << i % 6 << ", body " << i;
  }
}

TEST(SymbolSpectrum, IsThatOfRandomPeriodicBars) { expect_same_spectrum<1>(60, 21); }

TEST(SymbolSpectrum, IsThatOfRandomPeriodicPlates) { expect_same_spectrum<2>(60, 22); }

TEST(SymbolSpectrum, IsThatOfRandomPeriodicBlocks) { expect_same_spectrum<3>(24, 23); }

// The corner cases: some multipliers of the tables above are negative, and some bodies unstable.
TEST(SymbolSpectrum, IncludesNegativeEigenvalues) {
  Chance chance(22);
  int unstable = 0;
  for (int i = 0; i < 60; ++i) {
    const Model model = random_model<2>(static_cast<Kernel>(i % 6), chance);
    const auto values = symbol_eigenvalues<2>(model);
    if (values.front() < -1e-6 * std::abs(values.back())) ++unstable;
  }
  EXPECT_GT(unstable, 3);
}

}  // namespace
}  // namespace perimode
