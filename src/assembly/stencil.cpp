// SPDX-License-Identifier: BSD-3-Clause
#include "stencil.hpp"

#include <algorithm>

#include "perimode/linalg/threads.hpp"
#include "stencil_kernels.hpp"

namespace perimode {

namespace {

constexpr Index piece = 256;           ///< particles of a run at a time: their K u stays in the first cache
constexpr Index parallel_rows = 1000;  ///< particles from which threads pay

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
          const std::size_t g = static_cast<std::size_t>(run.first) + t;
          component[t] = boundary.coefficient[g * Dim + a] * value(boundary.image[g], a);
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

template <int Dim>
void store(const Stencil<Dim>& s, const ParticleRun& of, Index begin, const StencilRun& run, double* y) {
  if (of.dof >= 0) {
    interleave<Dim>(run.out, run.count, run.out_stride,
                    y + of.dof + static_cast<std::ptrdiff_t>(begin) * Dim);
    return;
  }
  const Index* number =
      s.body->boundary.free_number.data() + static_cast<std::size_t>(of.particle + begin) * Dim;
  for (Index t = 0; t < run.count; ++t) {
    for (int a = 0; a < Dim; ++a) {
      if (number[t * Dim + a] >= 0) y[number[t * Dim + a]] = run.out[a * run.out_stride + t];
    }
  }
}

/// Rows of K of one layer of particles.
template <int Dim>
void apply_layer(const Stencil<Dim>& s, Index layer, const double* here, typename Stencil<Dim>::Work& work,
                 double* y) {
  StencilPairs pairs{s.pair.data(), {}, s.bonds->family.size() - 1};
  std::copy(s.pair_start.begin(), s.pair_start.end(), pairs.start);
  for (Index r = s.layer_run[layer]; r < s.layer_run[layer + 1]; ++r) {
    const ParticleRun& of = s.run[r];
    for (Index begin = 0; begin < of.count; begin += piece) {
      const Index particle = of.particle + begin;
      const StencilRun run{.at = work.at.data(),
                           .here = here,
                           .stride = s.stride,
                           .b = s.b.data() + static_cast<std::size_t>(of.set) * s.pair.size() * Dim,
                           .cell = of.cell + begin,
                           .count = std::min(piece, of.count - begin),
                           .out = work.out.data(),
                           .out_stride = piece + stencil_slack};
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
      store(s, of, begin, run, y);
    }
  }
}

/// Layers [begin, end): the window of the layers in reach moves along with them.
template <int Dim>
void apply_layers(const Stencil<Dim>& s, Index begin, Index end, const double* x, double* y,
                  typename Stencil<Dim>::Work& work) {
  const Index depth = 2 * s.reach + 1;
  const auto window = [&](Index padded) { return work.window.data() + (padded % depth) * s.stride * Dim; };
  for (Index layer = begin; layer < begin + 2 * s.reach; ++layer) fill_layer(s, layer, x, window(layer));
  const Family<Dim>& family = s.bonds->family;
  for (Index layer = begin; layer < end; ++layer) {
    fill_layer(s, layer + 2 * s.reach, x, window(layer + 2 * s.reach));
    for (Index k = 0; k < depth; ++k) work.layer[k] = window(layer + k);
    for (int k = 0; k < family.size(); ++k) {
      const Index across = Dim > 1 ? family.offset[k][Dim - 1] : 0;
      work.at[k] = work.layer[s.reach + across] + (s.bonds->step[k] - across * s.layer_cells);
    }
    apply_layer(s, layer, work.layer[s.reach], work, y);
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
    w.layer.resize(2 * static_cast<std::size_t>(reach) + 1);
    w.at.resize(static_cast<std::size_t>(bonds->family.size()));
    w.lanes.resize(static_cast<std::size_t>(bonds->words) * stencil_slack);
    w.out.resize((piece + stencil_slack) * Dim);
    work.push_back(std::move(w));
  }
}

template <int Dim>
Index Stencil<Dim>::chunks() const {
  return body->count() < parallel_rows ? 1 : std::min<Index>(threads(), layers);
}

template <int Dim>
void Stencil<Dim>::apply(const double* x, double* y) {
  const Index parts = chunks();
  prepare(parts);
#pragma omp parallel for schedule(static, 1) if (parts > 1)
  for (Index c = 0; c < parts; ++c) {
    const auto first = [&](Index part) {
      return static_cast<Index>(static_cast<Offset>(layers) * part / parts);
    };
    apply_layers(*this, first(c), first(c + 1), x, y, work[c]);
  }
}

template <int Dim>
double Stencil<Dim>::bytes() const {
  double sum = sizeof(*this) + bytes_of(pair) + bytes_of(pair_start) + bytes_of(b) + bytes_of(factor) +
               bytes_of(run) + bytes_of(layer_run) + bytes_of(fill) + bytes_of(layer_fill);
  for (const auto& w : work)
    sum += bytes_of(w.window) + bytes_of(w.layer) + bytes_of(w.at) + bytes_of(w.lanes) + bytes_of(w.out);
  return sum;
}

template struct Stencil<1>;
template struct Stencil<2>;
template struct Stencil<3>;

}  // namespace perimode
