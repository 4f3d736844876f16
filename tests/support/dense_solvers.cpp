// SPDX-License-Identifier: BSD-3-Clause
#include "support/dense_solvers.hpp"

namespace Eigen {

template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    const EigenBase<MatrixXd>&, int);
template SelfAdjointEigenSolver<MatrixXcd>& SelfAdjointEigenSolver<MatrixXcd>::compute(
    const EigenBase<MatrixXcd>&, int);
template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
template class GeneralizedSelfAdjointEigenSolver<MatrixXd>;
template void PartialPivLU<MatrixXd>::compute();

}  // namespace Eigen
