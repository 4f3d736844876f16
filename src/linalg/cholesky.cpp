// SPDX-License-Identifier: BSD-3-Clause
#include <omp.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "cholmod_workspace.hpp"
#include "perimode/linalg/factor.hpp"
#include "supernodal_solve.hpp"
#include "supernodal_update.hpp"

namespace perimode {
namespace {

/// Row i of a symmetric matrix up to the diagonal is column i of its upper triangle.
struct UpperTriangle {
  std::vector<int> start, row;
  std::vector<double> value;

  UpperTriangle(const Csr& matrix, bool with_values) : start(1, 0) {
    start.reserve(matrix.rows + 1);
    row.reserve((matrix.nonzeros() + matrix.rows) / 2);
    for (Index i = 0; i < matrix.rows; ++i) {
      for (Offset e = matrix.row_start[i]; e < matrix.row_start[i + 1] && matrix.column[e] <= i; ++e)
        row.push_back(matrix.column[e]);
      start.push_back(static_cast<int>(row.size()));
    }
    if (with_values) value.resize(row.size());
  }

  /// The values of matrix - sigma diag(mass).
  void fill(const Csr& matrix, double sigma, const Eigen::VectorXd& mass, std::vector<double>& diagonal) {
    value.resize(row.size());
    diagonal.assign(matrix.rows, 0.0);
    for (Index i = 0; i < matrix.rows; ++i) {
      const Offset shift = start[i] - matrix.row_start[i];
      for (int e = start[i]; e < start[i + 1]; ++e) {
        value[e] = matrix.value[e - shift];
        if (row[e] == i) diagonal[i] = value[e] -= sigma * mass[i];
      }
    }
  }

  cholmod_sparse view() {
    cholmod_sparse out = {};
    out.nrow = out.ncol = start.size() - 1;
    out.nzmax = row.size();
    out.p = start.data();
    out.i = row.data();
    out.x = value.empty() ? nullptr : value.data();
    out.stype = 1;
    out.itype = CHOLMOD_INT;
    out.xtype = value.empty() ? CHOLMOD_PATTERN : CHOLMOD_REAL;
    out.dtype = CHOLMOD_DOUBLE;
    out.sorted = 1;
    out.packed = 1;
    return out;
  }
};

void refuse_wide_pattern(const Csr& pattern) {
  if (pattern.nonzeros() / 2 + pattern.rows >= std::numeric_limits<int>::max())
    throw Error(ErrorKind::environment,
                "Cholesky: the matrix has more than 2^32 entries; take fewer particles");
}

cholmod_factor* analyse(CholmodWorkspace& workspace, UpperTriangle& upper, const std::vector<Index>& order,
                        int supernodal) {
  cholmod_common* common = workspace.get();
  common->supernodal = supernodal;
  common->nmethods = 1;
  common->method[0].ordering = CHOLMOD_GIVEN;
  common->postorder = 1;
  common->final_ll = 1;
  cholmod_sparse view = upper.view();
  std::vector<int> given(order.begin(), order.end());
  cholmod_factor* factor = cholmod_analyze_p(&view, given.data(), nullptr, 0, common);
  workspace.check(factor != nullptr, "analysis");
  return factor;
}

/// CHOLMOD asks for four threads in small copying loops, whatever the caller set; on fewer cores they
/// only wait for each other. In this scope its loops run on the calling thread (BLAS is not OpenMP).
class SerialLoops {
 public:
  SerialLoops() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
  ~SerialLoops() { omp_set_max_active_levels(levels_); }
  SerialLoops(const SerialLoops&) = delete;
  SerialLoops& operator=(const SerialLoops&) = delete;

 private:
  int levels_;
};

/// Dense supernodes store explicit zeros: 5 to 16 percent over the true count on peridynamic
/// matrices with 20 thousand to a million dofs.
constexpr double supernodal_excess = 1.16;

FillEstimate estimate(const cholmod_common& common, double matrix_entries, double rows) {
  FillEstimate fill;
  fill.nonzeros = static_cast<Offset>(common.lnz);
  fill.flops = common.fl;
  fill.factor_bytes = 8.0 * supernodal_excess * common.lnz;
  // Our upper triangle and CHOLMOD's permuted copy (12 bytes an entry each), index arrays, and the
  // update matrix of the largest front, which holds up to about a tenth of L.
  fill.peak_bytes = 1.1 * fill.factor_bytes + 24.0 * matrix_entries + 100.0 * rows;
  return fill;
}

/// The dof of the first pivot that is not positive, or else of the smallest one.
Index first_bad_pivot(const cholmod_factor& factor) {
  const auto* order = static_cast<const int*>(factor.Perm);
  if (factor.minor < factor.n) return order[factor.minor];
  const auto* super = static_cast<const int*>(factor.super);
  const auto* row_start = static_cast<const int*>(factor.pi);
  const auto* value_start = static_cast<const int*>(factor.px);
  const auto* value = static_cast<const double*>(factor.x);
  Index found = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const std::ptrdiff_t rows = row_start[s + 1] - row_start[s];
    for (std::ptrdiff_t j = 0; j < super[s + 1] - super[s]; ++j) {
      const double pivot = value[value_start[s] + j * rows + j];
      if (!(pivot < least)) continue;
      least = pivot;
      found = order[super[s] + j];
    }
  }
  return found;
}

}  // namespace

FillEstimate predict_fill(const Csr& pattern, std::span<const Index> node_of_dof) {
  return predict_fill_with_order(pattern, fill_reducing_order(pattern, node_of_dof));
}

FillEstimate predict_fill_with_order(const Csr& pattern, const std::vector<Index>& order) {
  refuse_wide_pattern(pattern);
  CholmodWorkspace workspace;
  UpperTriangle upper(pattern, false);
  cholmod_factor* factor = analyse(workspace, upper, order, CHOLMOD_SIMPLICIAL);
  cholmod_free_factor(&factor, workspace.get());
  return estimate(*workspace.get(), static_cast<double>(upper.row.size()), pattern.rows);
}

struct CholeskyFactor::Handle {
  Handle(const Csr& pattern, std::vector<Index> given)
      : order(std::move(given)),
        upper(pattern, true),
        factor(analyse(workspace, upper, order, CHOLMOD_SUPERNODAL)) {
    fill = estimate(*workspace.get(), static_cast<double>(upper.row.size()), pattern.rows);
    fill.factor_bytes = 8.0 * static_cast<double>(factor->xsize);
  }
  ~Handle() { cholmod_free_factor(&factor, workspace.get()); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  CholmodWorkspace workspace;
  std::vector<Index> order;
  UpperTriangle upper;
  cholmod_factor* factor;
  FillEstimate fill;
  Index failed_dof = -1;
  std::vector<double> work;           // of solve()
  std::optional<SupernodeTree> tree;  // of update() and solve_sparse(), made by the first
  std::vector<double> diagonal;       // of the matrix last factored
  std::vector<double> terms;          // of update()

  const SupernodeTree& supernodes() {
    if (!tree) tree = supernode_tree(*factor);
    return *tree;
  }
};

CholeskyFactor::CholeskyFactor(const Csr& pattern, std::span<const Index> node_of_dof)
    : CholeskyFactor(with_order(pattern, fill_reducing_order(pattern, node_of_dof))) {}

CholeskyFactor::CholeskyFactor(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {}

CholeskyFactor CholeskyFactor::with_order(const Csr& pattern, std::vector<Index> order) {
  refuse_wide_pattern(pattern);
  return CholeskyFactor(std::make_unique<Handle>(pattern, std::move(order)));
}

CholeskyFactor::~CholeskyFactor() = default;
CholeskyFactor::CholeskyFactor(CholeskyFactor&&) noexcept = default;
CholeskyFactor& CholeskyFactor::operator=(CholeskyFactor&&) noexcept = default;

FactorStatus CholeskyFactor::factorize(const Csr& matrix, double sigma, const Eigen::VectorXd& mass) {
  handle_->upper.fill(matrix, sigma, mass, handle_->diagonal);
  cholmod_sparse view = handle_->upper.view();
  cholmod_common* common = handle_->workspace.get();
  const SerialLoops serial;
  const int fine = cholmod_factorize(&view, handle_->factor, common);
  handle_->workspace.check(fine != 0, "factorisation");
  constexpr double smallest_pivot = 1e-13;
  const bool positive = common->status == CHOLMOD_OK && handle_->factor->minor == handle_->factor->n &&
                        cholmod_rcond(handle_->factor, common) > smallest_pivot;
  if (!positive) handle_->failed_dof = first_bad_pivot(*handle_->factor);
  return positive ? FactorStatus::done : FactorStatus::not_positive_definite;
}

UpdateResult CholeskyFactor::update(const SparseColumns& added, const SparseColumns& removed) {
  return supernodal_update(*handle_->factor, handle_->supernodes(), added, removed, handle_->diagonal,
                           handle_->terms);
}

Eigen::VectorXd CholeskyFactor::solve_sparse(std::span<const Index> rows, const Eigen::VectorXd& b) const {
  const SupernodeTree& tree = handle_->supernodes();
  std::vector<int> columns;
  columns.reserve(rows.size());
  for (const Index row : rows) columns.push_back(tree.column_of_dof[row]);
  Eigen::MatrixXd x;
  supernodal_solve(*handle_->factor, paths_to_root(tree, columns), b, x, handle_->work);
  return x;
}

Index CholeskyFactor::failed_dof() const { return handle_->failed_dof; }

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  Eigen::MatrixXd x;
  supernodal_solve(*handle_->factor, b, x, handle_->work);
  return x;
}

const FillEstimate& CholeskyFactor::fill() const { return handle_->fill; }
const std::vector<Index>& CholeskyFactor::order() const { return handle_->order; }

}  // namespace perimode
