// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "perimode/assembly/multigrid.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace {

constexpr Index absent = -1;

/// Which fine particles a coarse one stands for: child[slots * coarse + slot], bit a of the slot saying
/// whether the child is the upper one along axis a.
template <int Dim>
struct Children {
  static constexpr int slots = 1 << Dim;
  std::vector<Index> child;
  [[nodiscard]] const Index* of(Index coarse) const {
    return child.data() + static_cast<std::size_t>(coarse) * slots;
  }
};

/// Coarse particles (position, volume, block) and their children.
template <int Dim>
Particles<Dim> coarse_particles(const Particles<Dim>& fine, Children<Dim>& children) {
  constexpr int slots = Children<Dim>::slots;
  Grid<Dim> grid = *fine.grid;
  grid.spacing *= 2.0;
  for (Index& n : grid.cells) n = (n + 1) / 2;
  std::vector<Index> child(static_cast<std::size_t>(grid.count()) * slots, absent);
  for (Index i = 0; i < fine.count(); ++i) {
    const auto cell = fine.grid->cell(fine.cell[i]);
    Index number = 0;
    Index stride = 1;
    int slot = 0;
    for (int a = 0; a < Dim; ++a) {
      number += stride * (cell[a] / 2);
      stride *= grid.cells[a];
      slot |= (cell[a] % 2) << a;
    }
    child[static_cast<std::size_t>(number) * slots + slot] = i;
  }
  Particles<Dim> coarse;
  coarse.grid = grid;
  coarse.block_names = fine.block_names;
  std::vector<int> votes(fine.block_names.size());
  for (Index number = 0; number < static_cast<Index>(grid.count()); ++number) {
    const Index* here = child.data() + static_cast<std::size_t>(number) * slots;
    const Index* first = std::find_if(here, here + slots, [](Index i) { return i != absent; });
    if (first == here + slots) continue;
    std::fill(votes.begin(), votes.end(), 0);
    for (int s = 0; s < slots; ++s) {
      if (here[s] != absent) ++votes[fine.block[here[s]]];
    }
    coarse.block.push_back(static_cast<int>(std::max_element(votes.begin(), votes.end()) - votes.begin()));
    coarse.position.push_back(grid.centre(grid.cell(number)));
    coarse.volume.push_back(slots * fine.volume[*first]);
    coarse.cell.push_back(number);
    children.child.insert(children.child.end(), here, here + slots);
  }
  return coarse;
}

/// Of a bond family: the slot of offset k mirrored in the axes of a bit pattern.
template <int Dim>
std::vector<int> mirrored_slots(const Family<Dim>& family) {
  std::map<std::array<int, Dim>, int> slot;
  for (int k = 0; k < family.size(); ++k) slot[family.offset[k]] = k;
  std::vector<int> out;
  for (int axes = 0; axes < (1 << Dim); ++axes) {
    for (auto o : family.offset) {
      for (int a = 0; a < Dim; ++a) o[a] = (axes >> a) % 2 == 1 ? -o[a] : o[a];
      out.push_back(slot.at(o));
    }
  }
  return out;
}

/// Axes along which a ghost is mirrored an odd number of times, as a bit pattern.
template <int Dim>
int mirrored_axes(const Ghost<Dim>& ghost) {
  int axes = 0;
  for (int a = 0; a < Dim; ++a) axes |= ((ghost.crossings[2 * a] + ghost.crossings[2 * a + 1]) % 2) << a;
  return axes;
}

/// Carries broken bonds down. A coarse bond stands for the chains of two fine bonds that lead from the
/// children of one end to those of the other; it breaks where more than half of them are broken. Beyond walls
/// the chains are followed in their mirror image, so that a bond and its mirrored one share their fate.
template <int Dim>
class BondCarrier {
 public:
  BondCarrier(const Body<Dim>& fine, const Particles<Dim>& particles, const Children<Dim>& children,
              GridBonds<Dim>& coarse)
      : bonds_(std::get<GridBonds<Dim>>(fine.bonds)),
        count_(fine.count()),
        children_(children),
        particles_(particles),
        coarse_(coarse),
        mirrored_(mirrored_slots(bonds_.family)) {
    for (int a = 0; a < Dim; ++a) uneven_[a] = fine.particles.grid->cells[a] % 2 == 1;
  }

  void run() {
    const Index n = particles_.count();
    std::vector<char> whole(n);
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < n; ++i) whole[i] = all_alive(i) ? 1 : 0;
    const auto window = near();
#pragma omp parallel for schedule(dynamic, 256)
    for (Index i = 0; i < n; ++i) {
      const bool intact = std::all_of(window.begin(), window.end(), [&](Index step) {
        const Index j = coarse_.occupant[coarse_.home[i] + step];
        return j != absent && whole[j < n ? j : coarse_.ghosts[j - n].image] == 1;
      });
      if (intact) continue;
      for (int k = 0; k < coarse_.family.size(); ++k) {
        if (is_alive(coarse_, i, k) && !survives(i, k))
          coarse_.alive[static_cast<std::size_t>(i) * coarse_.words + k / 64] &=
              ~(std::uint64_t{1} << (k % 64));
      }
    }
  }

 private:
  static constexpr int slots = Children<Dim>::slots;

  /// Are all children there, with all their bonds?
  bool all_alive(Index i) const {
    const int size = bonds_.family.size();
    for (int s = 0; s < slots; ++s) {
      const Index c = children_.of(i)[s];
      if (c == absent) return false;
      int alive = 0;
      for (int w = 0; w < bonds_.words; ++w)
        alive += std::popcount(bonds_.alive[static_cast<std::size_t>(c) * bonds_.words + w]);
      if (alive != size) return false;
    }
    return true;
  }

  /// Steps in the padded coarse grid to the cells in which the middles of chains lie.
  std::vector<Index> near() const {
    const int reach = (bonds_.reach + 1) / 2;
    std::vector<Index> steps = {0};
    Index stride = 1;
    for (int a = 0; a < Dim; ++a) {
      std::vector<Index> wider;
      for (int d = -reach; d <= reach; ++d)
        for (const Index s : steps) wider.push_back(s + d * stride);
      steps = wider;
      stride *= coarse_.padded[a];
    }
    return steps;
  }

  /// Does the coarse bond pass a face where the coarse grid sticks out, so that chains do not fit?
  bool leaves_by_uneven_face(Index i, int k, Index j) const {
    const auto cell = particles_.grid->cell(particles_.cell[i]);
    for (int a = 0; a < Dim; ++a) {
      if (!uneven_[a]) continue;
      const Index to = cell[a] + coarse_.family.offset[k][a];
      if (to >= particles_.grid->cells[a]) return true;
      if (to < 0 && coarse_.beyond[2 * a] == Beyond::periodic_image) return true;
      if (j >= particles_.count() && coarse_.ghosts[j - particles_.count()].crossings[2 * a + 1] > 0)
        return true;
    }
    return false;
  }

  bool survives(Index i, int k) const {
    const Index n = particles_.count();
    const Index j = coarse_.occupant[coarse_.home[i] + coarse_.step[k]];
    if (leaves_by_uneven_face(i, k, j)) return true;
    const bool ghost = j >= n;
    const int axes = ghost ? mirrored_axes(coarse_.ghosts[j - n]) : 0;
    const Index* from = children_.of(i);
    const Index* to = children_.of(ghost ? coarse_.ghosts[j - n].image : j);
    int chains = 0;
    int alive = 0;
    for (int s = 0; s < slots; ++s) {
      if (from[s] == absent || to[s ^ axes] == absent) continue;
      ++chains;
      alive += chain(from[s], k) ? 1 : 0;
    }
    return chains > 0 && 2 * alive >= chains;
  }

  /// Are the two bonds of offset k that start at a fine particle alive?
  bool chain(Index c, int k) const {
    if (!is_alive(bonds_, c, k)) return false;
    const Index middle = bonds_.occupant[bonds_.home[c] + bonds_.step[k]];
    if (middle < count_) return is_alive(bonds_, middle, k);
    const Ghost<Dim>& ghost = bonds_.ghosts[middle - count_];
    return is_alive(bonds_, ghost.image, mirrored_[mirrored_axes(ghost) * bonds_.family.size() + k]);
  }

  const GridBonds<Dim>& bonds_;
  Index count_;
  const Children<Dim>& children_;
  const Particles<Dim>& particles_;
  GridBonds<Dim>& coarse_;
  std::vector<int> mirrored_;
  std::array<bool, Dim> uneven_ = {};
};

/// What a reflection at each face does to the components, read off a ghost mirrored once; faces without
/// such a ghost have none.
template <int Dim>
struct Reflections {
  std::array<bool, 2 * Dim> known = {};
  std::array<std::array<double, Dim>, 2 * Dim> coefficient = {};
};

template <int Dim>
Reflections<Dim> reflections(const Body<Dim>& body) {
  Reflections<Dim> out;
  const auto& ghosts = std::get<GridBonds<Dim>>(body.bonds).ghosts;
  for (std::size_t g = 0; g < ghosts.size(); ++g) {
    int total = 0;
    int face = 0;
    for (int side = 0; side < 2 * Dim; ++side) {
      total += ghosts[g].crossings[side];
      if (ghosts[g].crossings[side] > 0) face = side;
    }
    if (total != 1 || out.known[face]) continue;
    out.known[face] = true;
    for (int a = 0; a < Dim; ++a) out.coefficient[face][a] = body.boundary.coefficient[g * Dim + a];
  }
  return out;
}

/// A coarse dof is fixed where a child's is; ghosts follow by the reflections of the fine ones.
template <int Dim>
BoundaryMap<Dim> coarse_boundary(const Body<Dim>& fine, const Children<Dim>& children, Index count,
                                 const GridBonds<Dim>& bonds, const Reflections<Dim>& reflection) {
  BoundaryMap<Dim> map;
  const std::size_t dofs = static_cast<std::size_t>(count) * Dim;
  map.given.assign(dofs, 0.0);
  map.free_number.assign(dofs, absent);
  for (Index i = 0; i < count; ++i) {
    const Index* child = children.of(i);
    for (int a = 0; a < Dim; ++a) {
      const bool fixed = std::any_of(child, child + Children<Dim>::slots, [&](Index c) {
        return c != absent && fine.boundary.free_number[static_cast<std::size_t>(c) * Dim + a] < 0;
      });
      if (!fixed) map.free_number[static_cast<std::size_t>(i) * Dim + a] = map.free++;
    }
  }
  for (const Ghost<Dim>& ghost : bonds.ghosts) {
    map.image.push_back(ghost.image);
    for (int a = 0; a < Dim; ++a) {
      double coefficient = 1.0;
      for (int side = 0; side < 2 * Dim; ++side)
        coefficient *= std::pow(reflection.coefficient[side][a], ghost.crossings[side]);
      map.coefficient.push_back(coefficient);
      map.value.push_back(0.0);
    }
  }
  return map;
}

/// sum_b k_b |xi|^2 / V_i of every particle: four times the energy density of a unit dilation.
template <int Dim>
std::vector<double> dilation_energies(const Body<Dim>& body) {
  const auto& bonds = std::get<GridBonds<Dim>>(body.bonds);
  const BondConstants& constants = body.constants;
  const Index n = body.count();
  const int size = bonds.family.size();
  const bool uniform = constants.factor.empty() && constants.kernel.size() == static_cast<std::size_t>(size);
  std::vector<double> share(size);  // k_b |xi|^2 / V_i of a uniform body
  for (int k = 0; k < size; ++k) {
    share[k] =
        constants.kernel[k] * bonds.family.weight[k] * bonds.family.length[k] * body.particles.volume[0];
  }
  std::vector<double> energy(n);
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < n; ++i) {
    double sum = 0.0;
    if (uniform) {
      for (int k = 0; k < size; ++k) sum += is_alive(bonds, i, k) ? share[k] : 0.0;
    } else {
      for_each_bond(bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
        sum += bond_stiffness(body, i, end) * end.length * end.length;
      });
      sum /= body.particles.volume[i];
    }
    energy[i] = sum;
  }
  return energy;
}

/// Factors that give each coarse family the mean dilation energy of its children's, within [1/5, 5].
template <int Dim>
std::vector<double> matched_factors(const Body<Dim>& fine, const Body<Dim>& coarse,
                                    const Children<Dim>& children) {
  constexpr double most = 5.0;
  const std::vector<double> wanted = dilation_energies(fine);
  const std::vector<double> found = dilation_energies(coarse);
  std::vector<double> factor(coarse.count(), 1.0);
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < coarse.count(); ++i) {
    double sum = 0.0;
    int there = 0;
    for (int s = 0; s < Children<Dim>::slots; ++s) {
      const Index c = children.of(i)[s];
      if (c == absent) continue;
      sum += wanted[c];
      ++there;
    }
    if (found[i] > 0.0) factor[i] = std::clamp(sum / there / found[i], 1.0 / most, most);
  }
  return factor;
}

/// Micromoduli of coarse levels: the fine ones, where none is negative. Negative ones would leave families
/// that lack half of their bonds with little or nothing to resist with; then every family member of a block
/// gets the mean that stores the same energy of dilation, sum_b k_b |xi|^2.
template <int Dim>
std::vector<double> coarse_kernel(const Body<Dim>& fine, const Family<Dim>& family) {
  std::vector<double> kernel = fine.constants.kernel;
  if (!softening(fine)) return kernel;
  const auto size = static_cast<std::size_t>(family.size());
  for (std::size_t first = 0; first < kernel.size(); first += size) {
    double energy = 0.0;
    double all = 0.0;
    double largest = 0.0;
    for (std::size_t k = 0; k < size; ++k) {
      const double share = family.weight[k] * family.length[k];
      energy += kernel[first + k] * share;
      all += share;
      largest = std::max(largest, std::abs(kernel[first + k]));
    }
    std::fill_n(kernel.begin() + static_cast<std::ptrdiff_t>(first), size,
                energy > 0.0 ? energy / all : largest);
  }
  return kernel;
}

}  // namespace

template <int Dim>
Body<Dim> coarsen(const Body<Dim>& fine) {
  const auto* bonds = std::get_if<GridBonds<Dim>>(&fine.bonds);
  if (bonds == nullptr) {
    invalid_input({"a grid to coarsen", "a cloud", "use block Jacobi or a Cholesky factor for clouds", {}});
  }
  Children<Dim> children;
  Body<Dim> coarse;
  coarse.section = fine.section;
  coarse.density = fine.density;
  coarse.particles = coarse_particles(fine.particles, children);

  Family<Dim> family = bonds->family;
  family.spacing *= 2.0;
  family.horizon *= 2.0;
  for (double& length : family.length) length *= 2.0;
  const Reflections<Dim> reflection = reflections(fine);
  auto beyond = bonds->beyond;
  for (int side = 0; side < 2 * Dim; ++side) {
    if (beyond[side] == Beyond::ghosts && !reflection.known[side]) beyond[side] = Beyond::nothing;
  }
  auto coarse_bonds = make_grid_bonds(coarse.particles, std::move(family), beyond);
  BondCarrier<Dim>(fine, coarse.particles, children, coarse_bonds).run();
  coarse.boundary = coarse_boundary(fine, children, coarse.particles.count(), coarse_bonds, reflection);
  coarse.bonds = std::move(coarse_bonds);

  // k_b = c beta V^2 / |xi| has to grow by 2^(Dim-2): elastic moduli are k_b |xi|^2 / volume.
  coarse.constants.family_size = fine.constants.family_size;
  coarse.constants.kernel = coarse_kernel(fine, bonds->family);
  for (double& c : coarse.constants.kernel) c *= std::ldexp(1.0, Dim - 2 + 1 - 2 * Dim);
  coarse.constants.factor = matched_factors(fine, coarse, children);
  return coarse;
}

template Body<1> coarsen<1>(const Body<1>&);
template Body<2> coarsen<2>(const Body<2>&);
template Body<3> coarsen<3>(const Body<3>&);

}  // namespace perimode
