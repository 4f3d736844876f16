// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace perimode {

/// min cost . x  subject to  matrix x = 0, lower <= x <= upper (infinite where there is no bound).
struct LinearProgramme {
  Eigen::MatrixXd matrix;  ///< rows x columns
  Eigen::VectorXd cost, lower, upper;
};

struct LinearOptimum {
  double value = 0.0;
  Eigen::VectorXd prices;  ///< of the rows, pi: cost - matrix^T pi are the reduced costs
};

/// By Clp's simplex method. Throws Error: environment where the library was built without Clp
/// (PERIMODE_WITH_CLP), solver_failure where no optimum is reached.
[[nodiscard]] LinearOptimum solve_linear_programme(const LinearProgramme& programme);

}  // namespace perimode
