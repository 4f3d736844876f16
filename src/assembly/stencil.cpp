// SPDX-License-Identifier: BSD-3-Clause
#include "stencil.hpp"

#include <algorithm>

#include "perimode/linalg/threads.hpp"
#include "stencil_kernels.hpp"

namespace perimode {

namespace {

template <int Dim>
void fill_layer(const Stencil<Dim>& s, Index layer, const double* x, double* to) {
  const BoundaryMap<Dim>& boundary = s.body->boundary;
  const auto value = [&](Index particle, int a) {
    const Index number = boundary.free_number[static_cast<std::size_t>(particle) * Dim + a];
    return number < 0 ? 0.0 : x[number];
  };
  for (Index r = s.layer_fill[layer]; r < s.layer_fill[layer + 1]; ++r) {
    const FillRun& run = s.fill[r];
    double* first = to + run.cell;
    if (run.what == FillRun::What::free) {
      deinterleave<Dim>(x + run.first, run.count, s.stride, first);
      continue;
    }
    for (int a = 0; a < Dim; ++a) {
      double* component = first + a * s.stride;
      if (run.what == FillRun::What::nothing) {
        std::fill_n(component, run.count, 0.0);
      } else if (run.what == FillRun::What::particles) {
        for (Index t = 0; t < run.count; ++t) component[t] = value(run.first + t, a);
      } else {
        for (Index t = 0; t < run.count; ++t) {
          component[t] = followed(boundary, static_cast<std::size_t>(run.first) + t, a, value);
        }
      }
    }
  }
}

/// Bonds between different materials, one by one.
template <int Dim>
void mixed_families(const Stencil<Dim>& s, const StencilRun& run, Index particle) {
  for (Index t = 0; t < run.count; ++t) {
    const std::ptrdiff_t cell = run.cell + t;
    Point<Dim> here;
    for (int a = 0; a < Dim; ++a) here[a] = run.here[a * run.stride + cell];
    Point<Dim> sum = Point<Dim>::Zero();
    for_each_bond(*s.bonds, particle + t, Which::alive, [&](const BondEnd<Dim>& end) {
      const Point<Dim> n = end.xi / end.length;
      Point<Dim> relative;
      for (int a = 0; a < Dim; ++a) relative[a] = here[a] - run.at[end.slot][a * run.stride + cell];
      sum += bond_stiffness(*s.body, particle + t, end) * n.dot(relative) * n;
    });
    for (int a = 0; a < Dim; ++a) run.out[a * run.out_stride + t] = sum[a];
  }
}

/// K u of a piece of a run by free dof, to y[0 ..) from row `first` on.
template <int Dim>
void by_rows(const Stencil<Dim>& s, const ParticleRun& of, Index begin, const StencilRun& run, Index first,
             double* y) {
  if (of.dof >= 0) {
    interleave<Dim>(run.out, run.count, run.out_stride, y + (of.dof + begin * Dim - first));
    return;
  }
  const Index* number =
      s.body->boundary.free_number.data() + static_cast<std::size_t>(of.particle + begin) * Dim;
  for (Index t = 0; t < run.count; ++t) {
    for (int a = 0; a < Dim; ++a) {
      if (number[t * Dim + a] >= 0) y[number[t * Dim + a] - first] = run.out[a * run.out_stride + t];
    }
  }
}

/// First row of particles [begin, begin + count) and their number: free dofs count up with the particles.
template <int Dim>
RowPiece rows_of(const Stencil<Dim>& s, const ParticleRun& of, Index begin, Index count) {
  const Index piece = of.piece + begin / stencil_piece;
  if (of.dof >= 0) return {piece, of.dof + begin * Dim, count * Dim, nullptr};
  const auto number =
      s.body->boundary.free_number.begin() + static_cast<std::ptrdiff_t>(of.particle + begin) * Dim;
  const auto free = [](Index n) { return n >= 0; };
  const auto end = number + static_cast<std::ptrdiff_t>(count) * Dim;
  return {piece, *std::find_if(number, end, free), static_cast<Index>(std::count_if(number, end, free)),
          nullptr};
}

/// Numbers that will be wanted soon, fetched a few at a time while others are worked on.
struct Fetch {
  const double* at = nullptr;
  const double* end = nullptr;

  void next(std::ptrdiff_t count) {
    constexpr std::ptrdiff_t line = 8;
    const double* to = at + std::min(count, end - at);
    for (; at < to; at += std::min(line, end - at)) __builtin_prefetch(at);
  }
};

/// Displacements of the free particles of a padded layer.
template <int Dim>
Fetch fetch_layer(const Stencil<Dim>& s, Index layer, const double* x) {
  Fetch fetch;
  for (Index r = s.layer_fill[layer]; r < s.layer_fill[layer + 1]; ++r) {
    const FillRun& run = s.fill[r];
    if (run.what != FillRun::What::free) continue;
    if (fetch.at == nullptr) fetch.at = x + run.first;
    fetch.end = x + run.first + static_cast<std::ptrdiff_t>(run.count) * Dim;
  }
  return fetch;
}

/// Rows of K of one layer of particles; emit(run, piece of it, K u) takes them.
template <int Dim, class Emit>
void apply_layer(const Stencil<Dim>& s, Index layer, const double* here, Fetch fetch,
                 typename Stencil<Dim>::Work& work, const Emit& emit) {
  StencilPairs pairs{s.pair.data(), {}, s.some_negative, {}, s.bonds->family.size() - 1};
  std::copy(s.pair_start.begin(), s.pair_start.end(), pairs.start);
  for (Index r = s.layer_run[layer]; r < s.layer_run[layer + 1]; ++r) {
    const ParticleRun& of = s.run[r];
    if (s.some_negative) {
      pairs.member = s.signed_pair.data() + static_cast<std::size_t>(of.set) * s.pair.size();
      std::copy_n(s.negative.begin() + static_cast<std::ptrdiff_t>(of.set) * StencilPairs::patterns,
                  StencilPairs::patterns, pairs.negative);
    }
    for (Index begin = 0; begin < of.count; begin += stencil_piece) {
      const Index particle = of.particle + begin;
      const StencilRun run{.at = work.at.data(),
                           .here = here,
                           .stride = s.stride,
                           .b = s.b.data() + static_cast<std::size_t>(of.set) * s.pair.size() * Dim,
                           .cell = of.cell + begin,
                           .count = std::min(stencil_piece, of.count - begin),
                           .out = work.out.data(),
                           .out_stride = stencil_piece + stencil_slack};
      fetch.next(static_cast<std::ptrdiff_t>(run.count) * Dim);
      if (of.families == Families::whole) {
        whole_families<Dim>(pairs, run);
      } else if (of.families == Families::partial) {
        partial_families<Dim>(
            pairs, run,
            {s.bonds->alive.data() + static_cast<std::size_t>(particle) * s.bonds->words, s.bonds->words,
             work.lanes.data(), s.factor.empty() ? nullptr : s.factor.data() + s.bonds->home[particle],
             s.bonds->step.data()});
      } else {
        mixed_families(s, run, particle);
      }
      emit(of, begin, run, work);
    }
  }
}

/// Padded layers that particles [begin, end) reach, and where they are kept: the last `reach` ones, which lie
/// beyond, by themselves, the others in a window that moves along.
template <int Dim>
struct Reach {
  const Stencil<Dim>& s;
  Index begin, end;
  typename Stencil<Dim>::Work& work;

  [[nodiscard]] double* at(Index padded) const {
    const Index beyond = padded - end - s.reach;
    const std::ptrdiff_t layer = s.stride * Dim;
    return beyond >= 0 ? work.beyond.data() + beyond * layer
                       : work.window.data() + padded % (2 * s.reach + 1) * layer;
  }
};

/// Takes in the layers below, the first ones and those beyond, before other threads change what they follow.
template <int Dim>
void fill_ends(const Reach<Dim>& reach, const double* x) {
  const Stencil<Dim>& s = reach.s;
  for (Index p = reach.begin; p < reach.begin + 2 * s.reach; ++p) fill_layer(s, p, x, reach.at(p));
  for (Index p = std::max(reach.begin + 2 * s.reach, reach.end + s.reach); p < reach.end + 2 * s.reach; ++p)
    fill_layer(s, p, x, reach.at(p));
}

template <int Dim, class Emit>
void apply_layers(const Reach<Dim>& reach, const double* x, const Emit& emit) {
  const Stencil<Dim>& s = reach.s;
  auto& work = reach.work;
  const Family<Dim>& family = s.bonds->family;
  for (Index layer = reach.begin; layer < reach.end; ++layer) {
    const Index next = layer + 2 * s.reach;
    if (next < reach.end + s.reach) fill_layer(s, next, x, reach.at(next));
    for (Index k = 0; k <= 2 * s.reach; ++k) work.layer[k] = reach.at(layer + k);
    for (int k = 0; k < family.size(); ++k) {
      const Index across = Dim > 1 ? family.offset[k][Dim - 1] : 0;
      work.at[k] = work.layer[s.reach + across] + (s.bonds->step[k] - across * s.layer_cells);
    }
    const Fetch fetch = next + 1 < reach.end + s.reach ? fetch_layer(s, next + 1, x) : Fetch{};
    apply_layer(s, layer, work.layer[s.reach], fetch, work, emit);
  }
}

/// Every thread moves through layers of its own.
template <int Dim, class Emit>
void sweep(Stencil<Dim>& s, const double* x, const Emit& emit) {
  const Index parts = s.chunks();
  s.prepare(parts);
  const auto reach = [&](Index part) {
    const auto first = [&](Index c) { return static_cast<Index>(static_cast<Offset>(s.layers) * c / parts); };
    return Reach<Dim>{s, first(part), first(part + 1), s.work[static_cast<std::size_t>(part)]};
  };
#pragma omp parallel if (parts > 1)
  {
#pragma omp for schedule(static, 1)
    for (Index c = 0; c < parts; ++c) fill_ends(reach(c), x);
#pragma omp for schedule(static, 1)
    for (Index c = 0; c < parts; ++c) apply_layers(reach(c), x, emit);
  }
}

template <class T>
double bytes_of(const std::vector<T>& v) {
  return static_cast<double>(v.capacity() * sizeof(T));
}

}  // namespace

template <int Dim>
void Stencil<Dim>::prepare(Index chunks) {
  for (auto count = static_cast<Index>(work.size()); count < chunks; ++count) {
    Work w;
    w.window.assign((2 * reach + 1) * stride * Dim, 0.0);
    w.beyond.assign(reach * stride * Dim, 0.0);
    w.layer.resize(2 * static_cast<std::size_t>(reach) + 1);
    w.at.resize(static_cast<std::size_t>(bonds->family.size()));
    w.lanes.resize(static_cast<std::size_t>(bonds->words) * stencil_slack);
    w.out.resize((stencil_piece + stencil_slack) * Dim);
    w.rows.resize((stencil_piece + stencil_slack) * Dim);
    work.push_back(std::move(w));
  }
}

template <int Dim>
Index Stencil<Dim>::chunks() const {
  return body->count() < parallel_rows ? 1 : std::min<Index>(threads(), layers);
}

template <int Dim>
void Stencil<Dim>::apply(const double* x, double* y) {
  sweep(*this, x, [this, y](const ParticleRun& of, Index begin, const StencilRun& sum, Work&) {
    by_rows(*this, of, begin, sum, 0, y);
  });
}

template <int Dim>
void Stencil<Dim>::apply(const double* x, const std::function<void(const RowPiece&)>& take) {
  sweep(*this, x, [&](const ParticleRun& of, Index begin, const StencilRun& sum, Work& w) {
    RowPiece rows = rows_of(*this, of, begin, sum.count);
    rows.y = w.rows.data();
    by_rows(*this, of, begin, sum, rows.first, rows.y);
    take(rows);
  });
}

template <int Dim>
double Stencil<Dim>::bytes() const {
  double sum = sizeof(*this) + bytes_of(pair) + bytes_of(pair_start) + bytes_of(b) + bytes_of(signed_pair) +
               bytes_of(negative) + bytes_of(factor) + bytes_of(run) + bytes_of(layer_run) + bytes_of(fill) +
               bytes_of(layer_fill);
  for (const auto& w : work)
    sum += bytes_of(w.window) + bytes_of(w.beyond) + bytes_of(w.layer) + bytes_of(w.at) + bytes_of(w.lanes) +
           bytes_of(w.out) + bytes_of(w.rows);
  return sum;
}

template struct Stencil<1>;
template struct Stencil<2>;
template struct Stencil<3>;

}  // namespace perimode
