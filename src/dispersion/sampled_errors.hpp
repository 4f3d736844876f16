// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "dispersion/contour.hpp"

namespace perimode {

/// Errors omega^2 - c^2 k^2 at quadrature points as a linear function of the multipliers of the orbits,
/// values alpha - targets, in the units spacing = 1, E/rho = 1.
struct SampledErrors {
  Eigen::MatrixXd values;   ///< points x orbits
  Eigen::VectorXd targets;  ///< c^2 |k|^2
  Eigen::VectorXd measure;  ///< arc length of each, times the waves that share it
  Eigen::VectorXd weights;  ///< e_P or e_S
};

/// a . M_o(k) a of every orbit o for the rates of alpha = 1; `k` in 1/spacing. Cost O(family).
template <int Dim>
[[nodiscard]] Eigen::VectorXd orbit_squares(const Family<Dim>& family, const std::vector<double>& rates,
                                            const Point<Dim>& k, const Point<Dim>& a);

/// All branches of the contour by Gauss-Legendre panels of 16 points, `panels` to a side.
template <int Dim>
[[nodiscard]] SampledErrors sample_contour(const Family<Dim>& family, const std::vector<double>& rates,
                                           const std::array<double, 2>& speeds,
                                           const std::array<double, 2>& weights, int panels);

/// A least-squares objective |rows x - right|^2 reduced by orthogonal transformations to at most as many rows
/// as columns, plus one. Blocks of rows are added one after another; memory O(columns (columns + block)).
class ReducedObjective {
 public:
  explicit ReducedObjective(Eigen::Index columns) : triangle_(0, columns + 1) {}
  void add(const Eigen::MatrixXd& rows, const Eigen::VectorXd& right);
  [[nodiscard]] Eigen::MatrixXd rows() const { return triangle_.leftCols(triangle_.cols() - 1); }
  [[nodiscard]] Eigen::VectorXd right() const { return triangle_.rightCols(1); }

 private:
  Eigen::MatrixXd triangle_;
};

/// int e^2 (omega^2 - c^2 k^2)^2 dk over the branches of the contour.
[[nodiscard]] ReducedObjective contour_objective(const SampledErrors& samples);

/// int |W (M(k) - M_exact(k)) W|^2 dk over [0, pi]^Dim (Frobenius norm), with M_exact = c_S^2 k^2 I +
/// (c_P^2 - c_S^2) k k^T and W = sqrt(e_P) n n^T + sqrt(e_S) (I - n n^T), n = k/|k|, by `panels` panels of 16
/// points per axis. What permutations of the axes make equal is summed once. Cost O(points^Dim/Dim! family).
template <int Dim>
[[nodiscard]] ReducedObjective zone_objective(const Family<Dim>& family, const std::vector<double>& rates,
                                              const std::array<double, 2>& speeds,
                                              const std::array<double, 2>& weights, int panels);

}  // namespace perimode
