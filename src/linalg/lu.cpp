// SPDX-License-Identifier: BSD-3-Clause
#include <umfpack.h>

#include <cstdint>
#include <string>

#include "perimode/core/error.hpp"
#include "perimode/linalg/factor.hpp"

namespace perimode {

/// UMFPACK reads columns; our rows are the columns of the transpose, which is what it factors.
struct LuFactor::Handle {
  std::vector<SuiteSparse_long> start, row;
  std::vector<double> value;
  void* numeric = nullptr;

  Handle() = default;
  ~Handle() { umfpack_dl_free_numeric(&numeric); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  static void check(SuiteSparse_long status) {
    if (status == UMFPACK_OK) return;
    if (status == UMFPACK_ERROR_out_of_memory)
      throw Error(ErrorKind::environment, "LU factorisation: out of memory; take fewer particles");
    const std::string why =
        status == UMFPACK_WARNING_singular_matrix ? "the matrix is singular" : "it broke down";
    throw Error(ErrorKind::solver_failure,
                "LU factorisation: " + why + " (UMFPACK code " + std::to_string(status) + ")");
  }

  [[nodiscard]] Eigen::VectorXd solve(SuiteSparse_long system, const Eigen::VectorXd& b) const {
    Eigen::VectorXd x(b.size());
    check(umfpack_dl_solve(system, start.data(), row.data(), value.data(), x.data(), b.data(), numeric,
                           nullptr, nullptr));
    return x;
  }
};

LuFactor::LuFactor(const Csr& matrix, double sigma, const Eigen::VectorXd& mass)
    : handle_(std::make_unique<Handle>()) {
  Handle& h = *handle_;
  h.start.assign(matrix.row_start.begin(), matrix.row_start.end());
  h.row.assign(matrix.column.begin(), matrix.column.end());
  h.value = matrix.value;
  for (Index i = 0; i < matrix.rows; ++i)
    for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1]; ++e)
      if (matrix.column[e] == i) h.value[e] -= sigma * mass[i];
  void* symbolic = nullptr;
  const SuiteSparse_long n = matrix.rows;
  Handle::check(
      umfpack_dl_symbolic(n, n, h.start.data(), h.row.data(), h.value.data(), &symbolic, nullptr, nullptr));
  const SuiteSparse_long status = umfpack_dl_numeric(h.start.data(), h.row.data(), h.value.data(), symbolic,
                                                     &h.numeric, nullptr, nullptr);
  umfpack_dl_free_symbolic(&symbolic);
  Handle::check(status);
}

LuFactor::~LuFactor() = default;
LuFactor::LuFactor(LuFactor&&) noexcept = default;
LuFactor& LuFactor::operator=(LuFactor&&) noexcept = default;

Eigen::VectorXd LuFactor::solve(const Eigen::VectorXd& b) const { return handle_->solve(UMFPACK_At, b); }
Eigen::VectorXd LuFactor::solve_transposed(const Eigen::VectorXd& b) const {
  return handle_->solve(UMFPACK_A, b);
}

}  // namespace perimode
