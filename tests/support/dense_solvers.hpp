// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>

/// The dense solvers most tests compare with, compiled once (dense_solvers.cpp) for all of them. Precompiled,
/// not included: a test that is compiled alone makes its own.
namespace Eigen {

extern template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    const EigenBase<MatrixXd>&, int);
extern template SelfAdjointEigenSolver<MatrixXcd>& SelfAdjointEigenSolver<MatrixXcd>::compute(
    const EigenBase<MatrixXcd>&, int);
extern template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
extern template class GeneralizedSelfAdjointEigenSolver<MatrixXd>;
extern template void PartialPivLU<MatrixXd>::compute();

}  // namespace Eigen
