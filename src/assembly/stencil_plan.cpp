// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "perimode/linalg/threads.hpp"
#include "stencil.hpp"
#include "stencil_kernels.hpp"

namespace perimode {

namespace {

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
    const int size = bonds.family.size();
    int ends = 0;
    for (int w = 0; w < bonds.words; ++w)
      ends += std::popcount(bonds.alive[static_cast<std::size_t>(i) * bonds.words + w]);
    bool one_factor = true;
    bool one_material = true;
    if (body.density.size() > 1 || !body.constants.factor.empty()) {
      for_each_bond(bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
        const Index j = owner(body.bonds, end.neighbour, body.count());
        one_factor = one_factor && factor(i) == factor(j);
        one_material = one_material && !differ(i, j);
      });
    }
    if (!one_material) return Families::mixed;
    return one_factor && ends == size ? Families::whole : Families::partial;
  }
};

/// Partial families fill the kernels' groups with whole ones from beside them: a group costs the same however
/// many particles it holds. All of one row, with the same dofs and material.
template <class Iterator>
void round_to_groups(Iterator begin, Iterator end) {
  for (auto first = begin; first != end;) {
    const Families kind = *first;
    auto last = std::find_if(first, end, [&](Families f) { return f != kind; });
    if (kind == Families::partial) {
      auto spare = in_groups(static_cast<Index>(last - first)) - static_cast<Index>(last - first);
      for (; spare > 0 && last != end && *last == Families::whole; --spare) *last++ = kind;
      for (; spare > 0 && first != begin && *(first - 1) == Families::whole; --spare) *--first = kind;
    }
    first = last;
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

/// The pairs of a block with those of negative k_b last within every pattern.
template <int Dim>
std::vector<int> add_signed_pairs(Stencil<Dim>& s, int block) {
  const double* kernel =
      s.body->constants.kernel.data() + static_cast<std::size_t>(block) * s.bonds->family.offset.size();
  std::vector<int> pair = s.pair;
  for (int pattern = 0; pattern < StencilPairs::patterns; ++pattern) {
    const auto at = std::stable_partition(pair.begin() + s.pair_start[static_cast<std::size_t>(pattern)],
                                          pair.begin() + s.pair_start[static_cast<std::size_t>(pattern) + 1],
                                          [&](int k) { return !(kernel[k] < 0.0); });
    s.negative.push_back(static_cast<int>(at - pair.begin()));
  }
  s.signed_pair.insert(s.signed_pair.end(), pair.begin(), pair.end());
  return pair;
}

/// b = sqrt|k_b| n of the family of a block, all calibration factors equal.
template <int Dim>
Index add_set(Stencil<Dim>& s, int block, double factor) {
  const Family<Dim>& family = s.bonds->family;
  const double volume = s.body->particles.volume[0];
  const auto number = static_cast<Index>(s.b.size() / (s.pair.size() * Dim));
  const std::vector<int> pair = s.some_negative ? add_signed_pairs(s, block) : s.pair;
  for (const int k : pair) {
    const double c = factor * s.body->constants.kernel[static_cast<std::size_t>(block) * family.size() + k];
    const double root = std::sqrt(std::abs(c) * family.weight[k] * (volume * volume) / family.length[k]);
    for (int a = 0; a < Dim; ++a)
      s.b.push_back(root * (family.spacing * family.offset[k][a] / family.length[k]));
  }
  return number;
}

/// The set of a material and factor, made where it is new.
template <int Dim>
Index numbered_set(Stencil<Dim>& s, int material, double factor) {
  const auto [at, fresh] = s.sets.emplace(std::pair(material, factor), 0);
  if (fresh) at->second = add_set(s, material, factor);
  return at->second;
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

  const auto set_of = [&](Index i) {
    return numbered_set(s, classes.material[body.particles.block[i]],
                        families[i] == Families::whole ? classes.factor(i) : 1.0);
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
      ParticleRun run{home[i] % s.layer_cells, i, 1, -1, set_of(i), s.pieces, families[i]};
      if (dofs == Dofs::all) run.dof = body.boundary.free_number[static_cast<std::size_t>(i) * Dim];
      for (++i; i < last && families[i] == run.families && set_of(i) == run.set; ++i) ++run.count;
      s.pieces += (run.count + stencil_piece - 1) / stencil_piece;
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
  constexpr std::array<Index, 4> step_per_cell = {0, Dim, 1, 1};  // of FillRun::first, by What
  const Index* occupant = s.bonds->occupant.data();
  for (Index layer = 0; layer < s.layers + 2 * s.reach; ++layer, occupant += s.layer_cells) {
    s.layer_fill.push_back(static_cast<Index>(s.fill.size()));
    const bool inner = layer >= s.reach && layer < s.layers + s.reach;
    for (Index cell = 0; inner && cell < s.layer_cells; ++cell) {
      if (occupant[cell] < n) continue;
      for_each_image(boundary, static_cast<std::size_t>(occupant[cell] - n), [&](Index j, const double*) {
        s.in_place = s.in_place && s.bonds->home[j] / s.layer_cells == layer;
      });
    }
    for (Index cell = 0; cell < s.layer_cells;) {
      FillRun run = filling(cell, occupant[cell]);
      const Index per_cell = step_per_cell[static_cast<std::size_t>(run.what)];
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

}  // namespace

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
  s.some_negative = softening(body);
  add_pairs(s);
  add_factors(s);
  add_particle_runs(s);
  add_fillings(s);
  s.prepare(s.chunks());
  return s;
}

template <int Dim>
void family_no_longer_whole(Stencil<Dim>& s, Index particle) {
  const auto holds = [&](const ParticleRun& r) {
    return r.particle <= particle && particle < r.particle + r.count;
  };
  auto at = std::upper_bound(s.run.begin(), s.run.end(), particle,
                             [](Index i, const ParticleRun& r) { return i < r.particle; });
  if (at == s.run.begin() || !holds(*--at) || at->families != Families::whole) return;
  // Of the whole run a group becomes partial; what is left on either side stays whole.
  const ParticleRun whole = *at;
  const auto part = [&whole](Index begin, Index end) {
    ParticleRun run = whole;
    run.cell += begin;
    run.particle += begin;
    run.count = end - begin;
    if (run.dof >= 0) run.dof += begin * Dim;
    return run;
  };
  const Index begin = (particle - whole.particle) / stencil_slack * stencil_slack;
  const Index end = std::min(begin + stencil_slack, whole.count);
  ParticleRun partial = part(begin, end);
  partial.families = Families::partial;
  partial.set = numbered_set(s, Classes<Dim>(*s.body).material[s.body->particles.block[particle]], 1.0);
  // Neighbours of the same row that are partial already take it in.
  const auto next_to = [&](const ParticleRun& a, const ParticleRun& b) {
    return a.families == Families::partial && b.families == Families::partial && a.set == b.set &&
           a.cell + a.count == b.cell && a.particle + a.count == b.particle && (a.dof >= 0) == (b.dof >= 0);
  };
  std::vector<ParticleRun> parts;
  if (begin > 0) parts.push_back(part(0, begin));
  parts.push_back(partial);
  if (end < whole.count) parts.push_back(part(end, whole.count));
  const Index layer = static_cast<Index>(
      std::upper_bound(s.layer_run.begin(), s.layer_run.end(), static_cast<Index>(at - s.run.begin())) -
      s.layer_run.begin() - 1);
  auto first = at;
  auto last = at + 1;
  if (begin == 0 && at - s.run.begin() > s.layer_run[layer] && next_to(*(at - 1), parts.front())) {
    parts.front().cell = (at - 1)->cell;
    parts.front().particle = (at - 1)->particle;
    parts.front().count += (at - 1)->count;
    parts.front().dof = (at - 1)->dof;
    --first;
  }
  if (end == whole.count && last - s.run.begin() < s.layer_run[layer + 1] && next_to(parts.back(), *last)) {
    parts.back().count += last->count;
    ++last;
  }
  const auto change = static_cast<Index>(parts.size()) - static_cast<Index>(last - first);
  const auto place = s.run.erase(first, last);
  s.run.insert(place, parts.begin(), parts.end());
  for (Index l = layer + 1; l <= s.layers; ++l) s.layer_run[l] += change;
}

#define PERIMODE_STENCIL_PLAN(D)                       \
  template Stencil<D> make_stencil<D>(const Body<D>&); \
  template void family_no_longer_whole<D>(Stencil<D>&, Index)
PERIMODE_STENCIL_PLAN(1);
PERIMODE_STENCIL_PLAN(2);
PERIMODE_STENCIL_PLAN(3);
#undef PERIMODE_STENCIL_PLAN

}  // namespace perimode
