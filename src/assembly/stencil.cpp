// SPDX-License-Identifier: BSD-3-Clause
#include "stencil.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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
          const auto g = static_cast<std::size_t>(run.first + t);
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
      const StencilRun run{
          work.at.data(),  here,
          s.stride,        s.b.data() + static_cast<std::size_t>(of.set) * s.pair.size() * Dim,
          of.cell + begin, std::min(piece, of.count - begin),
          work.out.data(), piece + stencil_slack};
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
    const Index padded = layer + s.reach;
    for (int k = 0; k < family.size(); ++k) {
      const Index across = Dim > 1 ? family.offset[k][Dim - 1] : 0;
      work.at[k] = window(padded + across) + (s.bonds->step[k] - across * s.layer_cells);
    }
    apply_layer(s, layer, window(padded), work, y);
  }
}

/// What decides how a particle's bonds are summed.
template <int Dim>
struct Classes {
  const Body<Dim>& body;
  const GridBonds<Dim>& bonds;
  std::vector<int> material;  ///< per block: the first block of the same micromoduli

  explicit Classes(const Body<Dim>& of) : body(of), bonds(std::get<GridBonds<Dim>>(of.bonds)) {
    const auto& kernel = body.constants.kernel;
    const std::ptrdiff_t size = body.constants.family_size;
    for (std::size_t i = 0; i < body.density.size(); ++i) {
      std::size_t j = 0;
      const auto mine = kernel.begin() + static_cast<std::ptrdiff_t>(i) * size;
      while (!std::equal(mine, mine + size, kernel.begin() + static_cast<std::ptrdiff_t>(j) * size)) ++j;
      material.push_back(static_cast<int>(j));
    }
  }

  [[nodiscard]] double factor(Index i) const {
    return body.constants.factor.empty() ? 1.0 : body.constants.factor[i];
  }

  /// Equal micromoduli and factors give the harmonic mean of two blocks the value of either.
  [[nodiscard]] bool differ(Index i, Index j) const {
    const auto& block = body.particles.block;
    return block[i] != block[j] && (material[block[i]] != material[block[j]] || factor(i) != factor(j));
  }

  [[nodiscard]] Families families(Index i) const {
    const bool plain = body.density.size() == 1 && body.constants.factor.empty();
    int ends = 0;
    bool one_factor = true;
    bool one_material = true;
    for (int k = 0; k < bonds.family.size(); ++k) {
      if (!is_alive(bonds, i, k)) continue;
      ++ends;
      if (plain) continue;
      const Index j = owner(body.bonds, bonds.occupant[bonds.home[i] + bonds.step[k]], body.count());
      one_factor = one_factor && factor(i) == factor(j);
      one_material = one_material && !differ(i, j);
    }
    if (!one_material) return Families::mixed;
    return one_factor && ends == bonds.family.size() ? Families::whole : Families::partial;
  }
};

/// Particles of one row with the same dofs and materials: partial families take whole groups of the kernel,
/// at the cost of whole ones beside them.
template <class Iterator>
void round_to_groups(Iterator begin, Iterator end) {
  for (auto first = std::find(begin, end, Families::partial); first != end;) {
    auto last = std::find_if(first, end, [](Families f) { return f != Families::partial; });
    auto left = static_cast<Index>((last - first) % stencil_slack);
    if (left > 0) {
      for (left = stencil_slack - left; left > 0 && last != end && *last == Families::whole; --left)
        *last++ = Families::partial;
      for (; left > 0 && first != begin && *(first - 1) == Families::whole; --left)
        *--first = Families::partial;
    }
    first = std::find(last, end, Families::partial);
  }
}

template <int Dim>
void add_pairs(Stencil<Dim>& s) {
  const Family<Dim>& family = s.bonds->family;
  for (int pattern = 0; pattern < StencilPairs::patterns; ++pattern) {
    s.pair_start.push_back(static_cast<int>(s.pair.size()));
    for (int k = 0; k < family.size() / 2; ++k) {
      int own = 0;
      for (int a = 0; a < Dim; ++a) own |= family.offset[k][a] != 0 ? 1 << a : 0;
      if (own == pattern) s.pair.push_back(k);
    }
  }
  s.pair_start.push_back(static_cast<int>(s.pair.size()));
}

/// b = sqrt(k_b) n of the family of a block, all calibration factors equal.
template <int Dim>
Index add_set(Stencil<Dim>& s, int block, double factor) {
  const Family<Dim>& family = s.bonds->family;
  const double volume = s.body->particles.volume[0];
  const auto number = static_cast<Index>(s.b.size() / (s.pair.size() * Dim));
  for (const int k : s.pair) {
    const double c = factor * s.body->constants.kernel[static_cast<std::size_t>(block) * family.size() + k];
    const double root = std::sqrt(c * family.weight[k] * (volume * volume) / family.length[k]);
    for (int a = 0; a < Dim; ++a)
      s.b.push_back(root * (family.spacing * family.offset[k][a] / family.length[k]));
  }
  return number;
}

/// Free dofs of a particle: all, some or none.
enum class Dofs { all, some, none };

template <int Dim>
Dofs dofs_of(const BoundaryMap<Dim>& boundary, Index i) {
  int free = 0;
  for (int a = 0; a < Dim; ++a)
    free += boundary.free_number[static_cast<std::size_t>(i) * Dim + a] >= 0 ? 1 : 0;
  return free == Dim ? Dofs::all : free > 0 ? Dofs::some : Dofs::none;
}

template <int Dim>
void add_particle_runs(Stencil<Dim>& s) {
  const Body<Dim>& body = *s.body;
  const Classes<Dim> classes(body);
  const Index n = body.count();
  const auto& home = s.bonds->home;
  std::vector<Families> families(static_cast<std::size_t>(n));
#pragma omp parallel for schedule(static) if (n > parallel_rows)
  for (Index i = 0; i < n; ++i) families[i] = classes.families(i);

  std::map<std::pair<int, double>, Index> sets;  // by material and factor
  const auto set_of = [&](Index i) {
    const std::pair key(classes.material[body.particles.block[i]],
                        families[i] == Families::whole ? classes.factor(i) : 1.0);
    const auto [at, fresh] = sets.emplace(key, 0);
    if (fresh) at->second = add_set(s, key.first, key.second);
    return at->second;
  };
  s.layer_run.assign(static_cast<std::size_t>(s.layers) + 1, 0);
  for (Index first = 0, last = 0; first < n; first = last) {
    const Dofs dofs = dofs_of(body.boundary, first);
    const int material = classes.material[body.particles.block[first]];
    last = first + 1;
    while (last < n && home[last] == home[last - 1] + 1 && dofs_of(body.boundary, last) == dofs &&
           classes.material[body.particles.block[last]] == material)
      ++last;
    if (dofs == Dofs::none) continue;
    round_to_groups(families.begin() + first, families.begin() + last);
    for (Index i = first; i < last;) {
      ParticleRun run{home[i] % s.layer_cells, i, 1, -1, set_of(i), families[i]};
      if (dofs == Dofs::all) run.dof = body.boundary.free_number[static_cast<std::size_t>(i) * Dim];
      for (++i; i < last && families[i] == run.families && set_of(i) == run.set; ++i) ++run.count;
      s.run.push_back(run);
      ++s.layer_run[home[first] / s.layer_cells - s.reach + 1];
    }
  }
  for (Index layer = 0; layer < s.layers; ++layer) s.layer_run[layer + 1] += s.layer_run[layer];
}

template <int Dim>
void add_fillings(Stencil<Dim>& s) {
  const BoundaryMap<Dim>& boundary = s.body->boundary;
  const Index n = s.body->count();
  const auto filling = [&](Index cell, Index occupant) {
    if (occupant == GridBonds<Dim>::absent) return FillRun{cell, 1, 0, FillRun::What::nothing};
    if (occupant >= n) return FillRun{cell, 1, occupant - n, FillRun::What::ghosts};
    if (dofs_of(boundary, occupant) != Dofs::all) return FillRun{cell, 1, occupant, FillRun::What::particles};
    return FillRun{cell, 1, boundary.free_number[static_cast<std::size_t>(occupant) * Dim],
                   FillRun::What::free};
  };
  const Index* occupant = s.bonds->occupant.data();
  for (Index layer = 0; layer < s.layers + 2 * s.reach; ++layer, occupant += s.layer_cells) {
    s.layer_fill.push_back(static_cast<Index>(s.fill.size()));
    for (Index cell = 0; cell < s.layer_cells;) {
      FillRun run = filling(cell, occupant[cell]);
      const Index per_cell = run.what == FillRun::What::nothing ? 0
                             : run.what == FillRun::What::free  ? Dim
                                                                : 1;
      for (++cell; cell < s.layer_cells; ++cell, ++run.count) {
        const FillRun next = filling(cell, occupant[cell]);
        if (next.what != run.what || next.first != run.first + run.count * per_cell) break;
      }
      s.fill.push_back(run);
    }
  }
  s.layer_fill.push_back(static_cast<Index>(s.fill.size()));
}

/// Calibration factors in the places of the padded grid; ghosts have those of their images.
template <int Dim>
void add_factors(Stencil<Dim>& s) {
  const auto& factor = s.body->constants.factor;
  if (factor.empty()) return;
  const auto& occupant = s.bonds->occupant;
  s.factor.assign(occupant.size() + stencil_slack, 0.0);
  for (std::size_t cell = 0; cell < occupant.size(); ++cell) {
    if (occupant[cell] != GridBonds<Dim>::absent)
      s.factor[cell] = factor[owner(s.body->bonds, occupant[cell], s.body->count())];
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
  for (const auto& w : work) sum += bytes_of(w.window) + bytes_of(w.at) + bytes_of(w.lanes) + bytes_of(w.out);
  return sum;
}

template <int Dim>
Stencil<Dim> make_stencil(const Body<Dim>& body) {
  Stencil<Dim> s;
  s.body = &body;
  s.bonds = &std::get<GridBonds<Dim>>(body.bonds);
  s.layers = Dim > 1 ? body.particles.grid->cells[Dim - 1] : 1;
  s.reach = Dim > 1 ? s.bonds->reach : 0;
  s.layer_cells = 1;
  for (int a = 0; a < std::max(Dim - 1, 1); ++a) s.layer_cells *= s.bonds->padded[a];
  // An odd number of cache lines, so that layers and components do not crowd the same sets.
  s.stride = ((s.layer_cells + stencil_slack + 7) / 8 | 1) * 8;
  add_pairs(s);
  add_factors(s);
  add_particle_runs(s);
  add_fillings(s);
  s.prepare(s.chunks());
  return s;
}

template struct Stencil<1>;
template struct Stencil<2>;
template struct Stencil<3>;
template Stencil<1> make_stencil<1>(const Body<1>&);
template Stencil<2> make_stencil<2>(const Body<2>&);
template Stencil<3> make_stencil<3>(const Body<3>&);

}  // namespace perimode
