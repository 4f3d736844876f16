// SPDX-License-Identifier: BSD-3-Clause
#include "bond_form.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <variant>

#include "linalg/vector_kernels.hpp"
#include "perimode/linalg/threads.hpp"

namespace perimode {

namespace {

/// K u of one particle. Two sums take turns, so that a bond does not wait for the one before.
template <int Dim>
[[gnu::always_inline]] inline void sum_ends(const double* b, const Index* neighbour, Offset ends,
                                            const double* u, const double* here, double* sum) {
  double even[Dim] = {}, odd[Dim] = {};
  const auto add = [&](Offset e, double* to) {
    const double* other = u + static_cast<Offset>(neighbour[e]) * Dim;
    const double* n = b + e * Dim;
    double stretch = n[0] * (here[0] - other[0]);
    for (int a = 1; a < Dim; ++a) stretch += n[a] * (here[a] - other[a]);
    for (int a = 0; a < Dim; ++a) to[a] += n[a] * stretch;
  };
  Offset e = 0;
  for (; e + 2 <= ends; e += 2) {
    add(e, even);
    add(e + 1, odd);
  }
  if (e < ends) add(e, even);
  for (int a = 0; a < Dim; ++a) sum[a] = even[a] + odd[a];
}

/// In 2D two ends side by side fill a vector.
template <>
[[gnu::always_inline]] inline void sum_ends<2>(const double* b, const Index* neighbour, Offset ends,
                                               const double* u, const double* here, double* sum) {
  using Pair __attribute__((vector_size(2 * sizeof(double)), aligned(8), may_alias)) = double;
  using Two __attribute__((vector_size(4 * sizeof(double)), aligned(8), may_alias)) = double;
  const auto at = [&](Offset e) {
    return *reinterpret_cast<const Pair*>(u + static_cast<Offset>(neighbour[e]) * 2);
  };
  const Two own = {here[0], here[1], here[0], here[1]};
  Two total[2] = {};
  const auto add = [&](Offset e, Two& to) {
    const Pair first = at(e), second = at(e + 1);
    const Two n = *reinterpret_cast<const Two*>(b + e * 2);
    const Two part = n * (own - __builtin_shufflevector(first, second, 0, 1, 2, 3));
    to += n * (part + __builtin_shufflevector(part, part, 1, 0, 3, 2));
  };
  Offset e = 0;
  for (; e + 4 <= ends; e += 4) {
    add(e, total[0]);
    add(e + 2, total[1]);
  }
  if (e + 2 <= ends) {
    add(e, total[0]);
    e += 2;
  }
  const Two all = total[0] + total[1];
  sum[0] = all[0] + all[2];
  sum[1] = all[1] + all[3];
  if (e < ends) {
    const Pair other = at(e);
    const double stretch = b[e * 2] * (here[0] - other[0]) + b[e * 2 + 1] * (here[1] - other[1]);
    sum[0] += b[e * 2] * stretch;
    sum[1] += b[e * 2 + 1] * stretch;
  }
}

/// K u of particles [begin, end) by free dof, to y[0 ..) from row `first` on.
template <int Dim, bool Signed>
[[gnu::always_inline]] inline void sum_particles(const BondForm<Dim>& form, const double* u, Index begin,
                                                 Index end, Index first, double* y) {
  const Index* number = form.u.empty() ? nullptr : form.body->boundary.free_number.data();
  for (Index i = begin; i < end; ++i) {
    const std::size_t dof = static_cast<std::size_t>(i) * Dim;
    double sum[Dim];
    const Index pull = Signed ? form.positive[i] : form.ends[i];
    sum_ends<Dim>(form.b.data() + form.start[i] * Dim, form.neighbour.data() + form.start[i], pull, u,
                  u + dof, sum);
    if constexpr (Signed) {
      const Offset first_push = form.start[i] + pull;
      double push[Dim];
      sum_ends<Dim>(form.b.data() + first_push * Dim, form.neighbour.data() + first_push, form.ends[i] - pull,
                    u, u + dof, push);
      for (int a = 0; a < Dim; ++a) sum[a] -= push[a];
    }
    for (int a = 0; a < Dim; ++a) {
      if (number == nullptr)
        y[dof + a - first] = sum[a];
      else if (number[dof + a] >= 0)
        y[number[dof + a] - first] = sum[a];
    }
  }
}

#define PERIMODE_SUMS(D)                                                                                  \
  PERIMODE_EVERY_PROCESSOR void sum_##D(const BondForm<D>& form, const double* u, Index begin, Index end, \
                                        Index first, double* y) {                                         \
    sum_particles<D, false>(form, u, begin, end, first, y);                                               \
  }                                                                                                       \
  PERIMODE_EVERY_PROCESSOR void signed_sum_##D(const BondForm<D>& form, const double* u, Index begin,     \
                                               Index end, Index first, double* y) {                       \
    sum_particles<D, true>(form, u, begin, end, first, y);                                                \
  }
PERIMODE_SUMS(1)
PERIMODE_SUMS(2)
PERIMODE_SUMS(3)
#undef PERIMODE_SUMS

/// All dofs free and no ghosts: the product reads x itself.
template <int Dim>
bool unconstrained(const Body<Dim>& body) {
  return body.boundary.image.empty() && body.boundary.free == body.count() * Dim;
}

template <int Dim>
void expand(const BoundaryMap<Dim>& boundary, const double* x, std::vector<double>& u) {
  const std::size_t dofs = boundary.free_number.size();
#pragma omp parallel for schedule(static) if (dofs > parallel_rows * Dim)
  for (std::size_t d = 0; d < dofs; ++d)
    u[d] = boundary.free_number[d] < 0 ? 0.0 : x[boundary.free_number[d]];
  for (std::size_t g = 0; g < boundary.image.size(); ++g) {
    for (int a = 0; a < Dim; ++a)
      u[dofs + g * Dim + a] =
          followed(boundary, g, a, [&u](Index i, int b) { return u[static_cast<std::size_t>(i) * Dim + b]; });
  }
}

template <int Dim>
void sum_slice(const BondForm<Dim>& form, const double* u, Index begin, Index end, Index first, double* y) {
  const bool some_negative = !form.positive.empty();
  if constexpr (Dim == 1) (some_negative ? signed_sum_1 : sum_1)(form, u, begin, end, first, y);
  if constexpr (Dim == 2) (some_negative ? signed_sum_2 : sum_2)(form, u, begin, end, first, y);
  if constexpr (Dim == 3) (some_negative ? signed_sum_3 : sum_3)(form, u, begin, end, first, y);
}

/// Displacements the bonds read: those of all particles and ghosts.
template <int Dim>
const double* all_displacements(BondForm<Dim>& form, const double* x) {
  if (form.u.empty()) return x;
  expand(form.body->boundary, x, form.u);
  return form.u.data();
}

constexpr Index slice = 256;  ///< particles

/// Alive ends of a particle before one of them.
template <int Dim>
Offset alive_before(const GridBonds<Dim>& bonds, Index particle, Offset slot) {
  const std::uint64_t* bits = bonds.alive.data() + static_cast<std::size_t>(particle) * bonds.words;
  Offset count = 0;
  for (Offset w = 0; w < slot / 64; ++w) count += std::popcount(bits[w]);
  return count + std::popcount(bits[slot / 64] & ((std::uint64_t{1} << (slot % 64)) - 1));
}
template <int Dim>
Offset alive_before(const CloudBonds<Dim>& bonds, Index particle, Offset slot) {
  Offset count = 0;
  for (Offset e = bonds.start[particle]; e < slot; ++e) count += is_alive(bonds, particle, e) ? 1 : 0;
  return count;
}

}  // namespace

template <int Dim>
void BondForm<Dim>::apply(const double* x, double* y) {
  const double* all = all_displacements(*this, x);
  const Index n = body->count();
#pragma omp parallel for schedule(static) if (n > parallel_rows)
  for (Index begin = 0; begin < n; begin += slice)
    sum_slice(*this, all, begin, std::min(n, begin + slice), 0, y);
}

template <int Dim>
void BondForm<Dim>::apply(const double* x, const std::function<void(const RowPiece&)>& take) {
  const double* all = all_displacements(*this, x);
  const Index n = body->count();
  const Index* number = body->boundary.free_number.data();
#pragma omp parallel for schedule(static) if (n > parallel_rows)
  for (Index begin = 0; begin < n; begin += slice) {
    const Index end = std::min(n, begin + slice);
    const Index* first = number + static_cast<std::ptrdiff_t>(begin) * Dim;
    const Index* last = number + static_cast<std::ptrdiff_t>(end) * Dim;
    const auto free = [](Index d) { return d >= 0; };
    const Index* row = std::find_if(first, last, free);
    if (row == last) continue;
    double y[slice * Dim];
    sum_slice(*this, all, begin, end, *row, y);
    take({begin / slice, *row, static_cast<Index>(std::count_if(row, last, free)), y});
  }
}

template <int Dim>
Index BondForm<Dim>::pieces() const {
  return (body->count() + slice - 1) / slice;
}

template <int Dim>
void BondForm<Dim>::remove(Index particle, Offset slot) {
  Offset alike = 0;  // alive ends of the same sign before it
  bool negative = false;
  if (positive.empty()) {
    alike = std::visit([&](const auto& bonds) { return alive_before(bonds, particle, slot); }, body->bonds);
  } else {
    Offset before[2] = {};
    for_each_bond(body->bonds, particle, Which::alive, [&](const BondEnd<Dim>& end) {
      const bool of_end = bond_stiffness(*body, particle, end) < 0.0;
      if (end.slot == slot) negative = of_end;
      if (end.slot < slot) ++before[of_end ? 1 : 0];
    });
    alike = before[negative ? 1 : 0];
  }
  const Offset at = start[particle] + alike + (negative ? positive[particle] : 0);
  if (!positive.empty() && !negative) --positive[particle];
  const Offset last = start[particle] + ends[particle]--;
  std::copy(neighbour.begin() + at + 1, neighbour.begin() + last, neighbour.begin() + at);
  std::copy(b.begin() + (at + 1) * Dim, b.begin() + last * Dim, b.begin() + at * Dim);
}

template <int Dim>
BondForm<Dim> make_bond_form(const Body<Dim>& body) {
  const Index n = body.count();
  BondForm<Dim> form;
  form.body = &body;
  form.start.assign(static_cast<std::size_t>(n), 0);
  form.ends.assign(static_cast<std::size_t>(n), 0);
#pragma omp parallel for schedule(static) if (n > parallel_rows)
  for (Index i = 0; i < n; ++i)
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>&) { ++form.ends[i]; });
  Offset ends = 0;
  for (Index i = 0; i < n; ++i) {
    form.start[i] = ends;
    ends += form.ends[i];
  }
  form.neighbour.resize(static_cast<std::size_t>(ends));
  form.b.resize(static_cast<std::size_t>(ends) * Dim);
  const bool some_negative = softening(body);
  if (some_negative) form.positive.assign(static_cast<std::size_t>(n), 0);
#pragma omp parallel for schedule(static) if (n > parallel_rows)
  for (Index i = 0; i < n; ++i) {
    Offset at = form.start[i];
    const auto add = [&](const BondEnd<Dim>& end, double k) {
      const Point<Dim> b = std::sqrt(std::abs(k)) / end.length * end.xi;
      form.neighbour[at] = end.neighbour;
      std::copy_n(b.data(), Dim, form.b.data() + at * Dim);
      ++at;
    };
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const double k = bond_stiffness(body, i, end);
      if (!(k < 0.0)) add(end, k);
    });
    if (!some_negative) continue;
    form.positive[i] = static_cast<Index>(at - form.start[i]);
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const double k = bond_stiffness(body, i, end);
      if (k < 0.0) add(end, k);
    });
  }
  if (!unconstrained(body)) form.u.resize((static_cast<std::size_t>(n) + body.boundary.image.size()) * Dim);
  return form;
}

template <int Dim>
double bond_form_bytes(const Body<Dim>& body) {
  const Index n = body.count();
  Offset ends = 0;
#pragma omp parallel for schedule(static) reduction(+ : ends) if (n > parallel_rows)
  for (Index i = 0; i < n; ++i)
    for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>&) { ++ends; });
  const double points =
      unconstrained(body) ? 0.0 : static_cast<double>(n) + static_cast<double>(body.boundary.image.size());
  return static_cast<double>(ends) * (sizeof(Index) + Dim * sizeof(double)) +
         n * (sizeof(Offset) + (softening(body) ? 2 : 1) * sizeof(Index)) + points * Dim * sizeof(double) +
         sizeof(BondForm<Dim>);
}

#define PERIMODE_BOND_FORM(D)                             \
  template struct BondForm<D>;                            \
  template BondForm<D> make_bond_form<D>(const Body<D>&); \
  template double bond_form_bytes<D>(const Body<D>&)
PERIMODE_BOND_FORM(1);
PERIMODE_BOND_FORM(2);
PERIMODE_BOND_FORM(3);
#undef PERIMODE_BOND_FORM

}  // namespace perimode
