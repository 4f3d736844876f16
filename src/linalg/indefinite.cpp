// SPDX-License-Identifier: BSD-3-Clause
#include <dmumps_c.h>

#include <limits>
#include <string>

#include "perimode/core/error.hpp"
#include "perimode/linalg/factor.hpp"

namespace perimode {

struct IndefiniteFactor::Handle {
  DMUMPS_STRUC_C mumps = {};
  std::vector<MUMPS_INT> row, column, position;
  std::vector<double> value;

  Handle() {
    mumps.sym = 2;
    mumps.par = 1;
    mumps.comm_fortran = -987654;  // MUMPS's own name for "every process", here the only one
    call(-1);
  }
  ~Handle() {
    mumps.job = -2;
    dmumps_c(&mumps);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  /// ICNTL(i) and INFOG(i) in the numbering of the MUMPS manual.
  MUMPS_INT& control(int i) { return mumps.icntl[i - 1]; }
  [[nodiscard]] MUMPS_INT info(int i) const { return mumps.infog[i - 1]; }

  void run(int job) {
    mumps.job = job;
    dmumps_c(&mumps);
  }
  void call(int job) {
    run(job);
    if (info(1) >= 0) return;
    const bool memory = info(1) == -13 || info(1) == -7;
    throw Error(memory ? ErrorKind::environment : ErrorKind::solver_failure,
                "indefinite factorisation failed with MUMPS code " + std::to_string(info(1)) + " (" +
                    std::to_string(info(2)) + ")" +
                    (memory ? ": out of memory; use the restart certificate" : ""));
  }
};

IndefiniteFactor::IndefiniteFactor(const Csr& matrix, double sigma, const Eigen::VectorXd& mass,
                                   std::span<const Index> order)
    : handle_(std::make_unique<Handle>()) {
  Handle& h = *handle_;
  const std::size_t entries = (matrix.nonzeros() + matrix.rows) / 2;
  h.row.reserve(entries);
  h.column.reserve(entries);
  h.value.reserve(entries);
  for (Index i = 0; i < matrix.rows; ++i)
    for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1] && matrix.column[e] <= i; ++e) {
      h.row.push_back(i + 1);
      h.column.push_back(matrix.column[e] + 1);
      h.value.push_back(matrix.value[e] - (matrix.column[e] == i ? sigma * mass[i] : 0.0));
    }
  h.position.resize(matrix.rows);
  for (std::size_t k = 0; k < order.size(); ++k) h.position[order[k]] = static_cast<MUMPS_INT>(k) + 1;

  h.mumps.n = matrix.rows;
  h.mumps.nnz = static_cast<MUMPS_INT8>(h.value.size());
  h.mumps.irn = h.row.data();
  h.mumps.jcn = h.column.data();
  h.mumps.a = h.value.data();
  h.mumps.perm_in = h.position.data();
  h.control(1) = h.control(2) = h.control(3) = -1;
  h.control(4) = 0;
  h.control(6) = 0;    // no column permutation
  h.control(7) = 1;    // the order is ours
  h.control(12) = 1;   // usual symmetric ordering, no compression by 2 x 2 pivots
  h.control(13) = 1;   // root front by MUMPS itself: its inertia is then counted too
  h.control(14) = 30;  // percent of room for delayed pivots
  h.control(28) = 1;   // sequential analysis
  h.call(1);
  constexpr int widest = 500;
  h.run(2);
  while ((h.info(1) == -8 || h.info(1) == -9) && h.control(14) < widest) {  // not enough room: more
    h.control(14) *= 2;
    h.run(2);
  }
  if (h.info(1) < 0) h.call(2);
  h.row = {};
  h.column = {};
  h.value = {};
}

IndefiniteFactor::~IndefiniteFactor() = default;
IndefiniteFactor::IndefiniteFactor(IndefiniteFactor&&) noexcept = default;
IndefiniteFactor& IndefiniteFactor::operator=(IndefiniteFactor&&) noexcept = default;

Index IndefiniteFactor::negative_pivots() const { return handle_->info(12); }

Offset IndefiniteFactor::nonzeros() const {
  const Offset entries = handle_->info(29);  // negative: in millions
  return entries >= 0 ? entries : -entries * 1'000'000;
}

Eigen::MatrixXd IndefiniteFactor::solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  Eigen::MatrixXd x = b;
  Handle& h = *handle_;
  h.mumps.rhs = x.data();
  h.mumps.nrhs = static_cast<MUMPS_INT>(x.cols());
  h.mumps.lrhs = static_cast<MUMPS_INT>(x.rows());
  h.control(27) = h.mumps.nrhs;  // all right-hand sides in one pass over the factor
  h.call(3);
  return x;
}

}  // namespace perimode
