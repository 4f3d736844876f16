// SPDX-License-Identifier: BSD-3-Clause
#include "supernodal_update.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>

#include "perimode/core/error.hpp"
#include "rank_kernels.hpp"

namespace perimode {
namespace {

constexpr double vanished = 1e-11;  // of the diagonal: a pivot that counts as none

/// One column of change.
struct Term {
  double sign;
  int first;  ///< its lowest row in the order of elimination
  std::span<const Index> row;
  std::span<const double> value;
};

[[noreturn]] void outside(const char* what) {
  invalid_input({"columns whose products lie within the analysed pattern",
                 what,
                 "change a matrix only between dofs that share an entry, or analyse the wider pattern",
                 {}});
}

/// The rows of a column make a clique of L where all of them lie in the structure of its lowest one.
void add_terms(const SparseColumns& columns, double sign, const cholmod_factor& factor,
               const SupernodeTree& tree, std::vector<Term>& terms) {
  if (columns.rows != static_cast<Index>(factor.n) && columns.count() > 0)
    invalid_input({fmt::format("columns of length {}, that of the factor", factor.n),
                   fmt::format("{}", columns.rows),
                   "use one set of free dofs",
                   {}});
  const auto* super = static_cast<const int*>(factor.super);
  const auto* row_start = static_cast<const int*>(factor.pi);
  const auto* rows = static_cast<const int*>(factor.s);
  const auto already = static_cast<std::ptrdiff_t>(terms.size());
  for (Index c = 0; c < columns.count(); ++c) {
    const auto begin = static_cast<std::size_t>(columns.start[c]);
    const auto size = static_cast<std::size_t>(columns.start[c + 1]) - begin;
    Term term{sign, static_cast<int>(factor.n), std::span(columns.row).subspan(begin, size),
              std::span(columns.value).subspan(begin, size)};
    for (std::size_t e = 0; e < size; ++e) {
      const Index dof = term.row[e];
      if (dof < 0 || dof >= columns.rows) outside("a row beyond the matrix");
      if (term.value[e] != 0.0) term.first = std::min(term.first, tree.column_of_dof[dof]);
    }
    if (term.first == static_cast<int>(factor.n)) continue;  // nothing but zeros
    const int node = tree.node_of_column[term.first];
    for (std::size_t e = 0; e < size; ++e) {
      if (term.value[e] == 0.0) continue;
      const int at = tree.column_of_dof[term.row[e]];
      if (at >= super[node + 1] &&
          !std::binary_search(rows + row_start[node], rows + row_start[node + 1], at))
        outside("an entry outside it");
    }
    terms.push_back(term);
  }
  std::stable_sort(terms.begin() + already, terms.end(),
                   [](const Term& a, const Term& b) { return a.first < b.first; });
}

/// Up to most_ranks terms on their way to the roots. `work` holds most_ranks numbers per row of L.
class Group {
 public:
  Group(cholmod_factor& factor, const SupernodeTree& tree, std::span<const double> diagonal,
        std::vector<double>& work)
      : factor_(factor), tree_(tree), diagonal_(diagonal), work_(work) {}

  void run(std::span<const Term> terms, UpdateResult& result) {
    std::vector<int> firsts;
    removing_ = false;
    for (std::size_t r = 0; r < terms.size(); ++r) {
      sign_[r] = terms[r].sign;
      alpha_[r] = 1.0;
      removing_ = removing_ || terms[r].sign < 0.0;
      firsts.push_back(terms[r].first);
      for (std::size_t e = 0; e < terms[r].row.size(); ++e)
        if (terms[r].value[e] != 0.0)
          work_[place(tree_.column_of_dof[terms[r].row[e]]) + r] += terms[r].value[e];
    }
    for (const int node : paths_to_root(tree_, firsts)) {
      pass(node, result);
      if (result.status != FactorStatus::done) return;
    }
  }

 private:
  static std::size_t place(int row) { return static_cast<std::size_t>(row) * most_ranks; }

  void pass(int node, UpdateResult& result) {
    const int begin = static_cast<const int*>(factor_.super)[node];
    const std::ptrdiff_t columns = static_cast<const int*>(factor_.super)[node + 1] - begin;
    const int* row_start = static_cast<const int*>(factor_.pi);
    const int* row = static_cast<const int*>(factor_.s) + row_start[node];
    const std::ptrdiff_t rows = row_start[node + 1] - row_start[node];
    double* l = static_cast<double*>(factor_.x) + static_cast<const int*>(factor_.px)[node];

    const int present = gather(row, rows);
    if (present == 0) return;
    least_.assign(columns, 0.0);
    if (removing_) {
      const auto* order = static_cast<const int*>(factor_.Perm);
      for (std::ptrdiff_t j = 0; j < columns; ++j) least_[j] = vanished * diagonal_[order[begin + j]];
    }
    const std::ptrdiff_t passed = rotate_supernode(terms_, l, rows, columns, least_.data());
    result.touched += present * (columns * rows - columns * (columns - 1) / 2);
    if (passed < columns) {
      result.status = FactorStatus::not_positive_definite;
      result.dof = static_cast<const int*>(factor_.Perm)[begin + passed];
      std::fill(work_.begin(), work_.end(), 0.0);
      return;
    }
    scatter(row, rows, columns, present);
  }

  /// The ranks that are not zero in these rows, side by side; returns how many. They leave `work`.
  int gather(const int* row, std::ptrdiff_t rows) {
    bool any[most_ranks] = {};
    for (std::ptrdiff_t i = 0; i < rows; ++i)
      for (int r = 0; r < most_ranks; ++r) any[r] |= work_[place(row[i]) + r] != 0.0;
    int present = 0;
    for (int r = 0; r < most_ranks; ++r)
      if (any[r]) rank_[present++] = r;
    if (present == 0) return 0;
    terms_.count = static_cast<int>(std::bit_ceil(static_cast<unsigned>(present)));
    terms_.stride = rows + 2 * row_chunk;
    front_.assign(terms_.stride * terms_.count, 0.0);
    terms_.w = front_.data();
    for (int r = 0; r < terms_.count; ++r) {
      terms_.sign[r] = r < present ? sign_[rank_[r]] : 1.0;
      terms_.alpha[r] = r < present ? alpha_[rank_[r]] : 1.0;
    }
    for (std::ptrdiff_t i = 0; i < rows; ++i) {
      double* from = work_.data() + place(row[i]);
      for (int r = 0; r < present; ++r) front_[r * terms_.stride + i] = from[rank_[r]];
      std::fill_n(from, most_ranks, 0.0);
    }
    return present;
  }

  void scatter(const int* row, std::ptrdiff_t rows, std::ptrdiff_t columns, int present) {
    for (std::ptrdiff_t i = columns; i < rows; ++i)
      for (int r = 0; r < present; ++r) work_[place(row[i]) + rank_[r]] = front_[r * terms_.stride + i];
    for (int r = 0; r < present; ++r) alpha_[rank_[r]] = terms_.alpha[r];
  }

  cholmod_factor& factor_;
  const SupernodeTree& tree_;
  std::span<const double> diagonal_;
  std::vector<double>& work_;
  bool removing_ = false;
  double sign_[most_ranks] = {}, alpha_[most_ranks] = {};
  int rank_[most_ranks] = {};
  RankTerms terms_;
  std::vector<double> front_, least_;
};

}  // namespace

SupernodeTree supernode_tree(const cholmod_factor& factor) {
  const auto* super = static_cast<const int*>(factor.super);
  const auto* row_start = static_cast<const int*>(factor.pi);
  const auto* row = static_cast<const int*>(factor.s);
  const auto* order = static_cast<const int*>(factor.Perm);
  SupernodeTree tree;
  tree.node_of_column.resize(factor.n);
  tree.column_of_dof.resize(factor.n);
  tree.parent.assign(factor.nsuper, -1);
  const int nodes = static_cast<int>(factor.nsuper);
  for (int s = 0; s < nodes; ++s)
    for (int k = super[s]; k < super[s + 1]; ++k) {
      tree.node_of_column[k] = s;
      tree.column_of_dof[order[k]] = k;
    }
  for (int s = 0; s < nodes; ++s) {
    const int below = row_start[s] + super[s + 1] - super[s];
    if (below < row_start[s + 1]) tree.parent[s] = tree.node_of_column[row[below]];
  }
  return tree;
}

std::vector<int> paths_to_root(const SupernodeTree& tree, std::span<const int> columns) {
  std::vector<int> out;
  std::vector<bool> met(tree.parent.size(), false);
  for (const int column : columns)
    for (int s = tree.node_of_column[column]; s >= 0 && !met[s]; s = tree.parent[s]) {
      met[s] = true;
      out.push_back(s);
    }
  std::sort(out.begin(), out.end());
  return out;
}

UpdateResult supernodal_update(cholmod_factor& factor, const SupernodeTree& tree, const SparseColumns& added,
                               const SparseColumns& removed, std::span<const double> diagonal,
                               std::vector<double>& work) {
  std::vector<Term> terms;
  add_terms(added, 1.0, factor, tree, terms);
  add_terms(removed, -1.0, factor, tree, terms);
  work.resize(factor.n * most_ranks, 0.0);
  UpdateResult result;
  Group group(factor, tree, diagonal, work);
  for (std::size_t first = 0; first < terms.size() && result.status == FactorStatus::done;
       first += most_ranks)
    group.run(std::span(terms).subspan(first, std::min<std::size_t>(most_ranks, terms.size() - first)),
              result);
  return result;
}

}  // namespace perimode
