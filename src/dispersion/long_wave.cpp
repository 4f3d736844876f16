// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion/long_wave.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "perimode/core/error.hpp"

namespace perimode {

template <int Dim>
Eigen::MatrixXd long_wave_constraints(const Family<Dim>& family, const std::vector<double>& rates,
                                      const std::array<double, 2>& speeds) {
  constexpr Eigen::Index count = Dim == 1 ? 1 : 2;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(family.shell.size()));
  for (std::size_t j = 0; j < rates.size(); ++j) {
    double squared = 0.0;
    for (const int component : family.offset[j]) squared += component * component;
    const double x2 = family.offset[j][0] * family.offset[j][0];
    rows(0, family.orbit[j]) += 0.5 * rates[j] * x2 * x2 / (squared * speeds[0]);
    if constexpr (Dim > 1) {
      const double y2 = family.offset[j][1] * family.offset[j][1];
      rows(1, family.orbit[j]) += 0.5 * rates[j] * x2 * y2 / (squared * speeds[1]);
    }
  }
  if (Dim > 1 && rows.row(1).maxCoeff() <= 0.0) {
    invalid_input({"a horizon with diagonal bonds, which give a lattice its shear stiffness",
                   fmt::format("{} orbit{}, along the axes alone: no multipliers give long shear waves their "
                               "speed",
                               family.shell.size(), family.shell.size() == 1 ? "" : "s"),
                   "take a horizon of 1.5 spacings or more"});
  }
  return rows;
}

LargestBound largest_bound(const Eigen::MatrixXd& constraints) {
  const Eigen::Index n = constraints.cols();
  const Eigen::VectorXd sums = constraints.rowwise().sum();
  LargestBound best{-std::numeric_limits<double>::infinity(), Eigen::VectorXd()};
  if (constraints.rows() == 1) {
    best.bound = 1.0 / sums[0];
    best.alpha = Eigen::VectorXd::Constant(n, best.bound);
    return best;
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    Eigen::Matrix2d basis;
    basis << sums, constraints.col(j);
    const double determinant = basis.determinant();
    if (std::abs(determinant) <= 1e-14 * basis.col(0).norm() * basis.col(1).norm()) continue;
    const double bound = (basis(1, 1) - basis(0, 1)) / determinant;
    const double excess = (basis(0, 0) - basis(1, 0)) / determinant;
    if (excess < 0.0 || bound <= best.bound) continue;
    best.bound = bound;
    best.alpha = Eigen::VectorXd::Constant(n, bound);
    best.alpha[j] += excess;
  }
  return best;
}

template Eigen::MatrixXd long_wave_constraints<1>(const Family<1>&, const std::vector<double>&,
                                                  const std::array<double, 2>&);
template Eigen::MatrixXd long_wave_constraints<2>(const Family<2>&, const std::vector<double>&,
                                                  const std::array<double, 2>&);
template Eigen::MatrixXd long_wave_constraints<3>(const Family<3>&, const std::vector<double>&,
                                                  const std::array<double, 2>&);

}  // namespace perimode
