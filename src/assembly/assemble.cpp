// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/assemble.hpp"

#include <algorithm>
#include <cstring>

#include "block_form.hpp"

namespace perimode {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <int Dim>
constexpr int block_size = Dim * Dim;

/// Rows whose partners are all particles at their own place, so that slots ascend with columns.
template <int Dim>
bool plain_row(const GridBonds<Dim>& bonds, const Particles<Dim>& particles, Index i) {
  const auto& grid = *particles.grid;
  const auto cell = grid.cell(particles.cell[i]);
  for (int a = 0; a < Dim; ++a) {
    if (bonds.beyond[2 * a] != Beyond::nothing && cell[a] < bonds.reach) return false;
    if (bonds.beyond[2 * a + 1] != Beyond::nothing && cell[a] >= grid.cells[a] - bonds.reach) return false;
  }
  return true;
}
template <int Dim>
bool plain_row(const CloudBonds<Dim>&, const Particles<Dim>&, Index) {
  return true;
}

template <int Dim>
void row_columns(const Body<Dim>& body, Index i, std::vector<Index>& columns) {
  columns.assign(1, i);
  for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
    if (end.neighbour < body.count()) {
      columns.push_back(end.neighbour);
    } else {
      for_each_image(body.boundary, static_cast<std::size_t>(end.neighbour - body.count()),
                     [&](Index j, const double*) { columns.push_back(j); });
    }
  });
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
}

template <int Dim>
Offset alive_ends(const GridBonds<Dim>& bonds, Index i) {
  Offset count = 0;
  for (int w = 0; w < bonds.words; ++w)
    count += std::popcount(bonds.alive[static_cast<std::size_t>(i) * bonds.words + w]);
  return count;
}
template <int Dim>
Offset alive_ends(const CloudBonds<Dim>& bonds, Index i) {
  Offset count = 0;
  for (Offset e = bonds.start[i]; e < bonds.start[i + 1]; ++e) count += is_alive(bonds, i, e) ? 1 : 0;
  return count;
}

/// Ascending columns of a plain row, the diagonal in its place.
template <int Dim, class B>
void plain_columns(const B& bonds, Index i, Index* column) {
  bool diagonal = false;
  const auto put = [&](Index j) {
    if (!diagonal && j > i) {
      *column++ = i;
      diagonal = true;
    }
    *column++ = j;
  };
  if constexpr (std::is_same_v<B, GridBonds<Dim>>) {
    const Index* here = bonds.occupant.data() + bonds.home[i];
    for (int w = 0; w < bonds.words; ++w) {
      for (auto bits = bonds.alive[static_cast<std::size_t>(i) * bonds.words + w]; bits != 0;
           bits &= bits - 1) {
        put(here[bonds.step[64 * w + std::countr_zero(bits)]]);
      }
    }
  } else {
    for_each_bond(bonds, i, Which::alive, [&](const BondEnd<Dim>& end) { put(end.neighbour); });
  }
  if (!diagonal) *column = i;
}

template <int Dim>
void add_outer(double* block, double k, const Point<Dim>& n) {
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b < Dim; ++b) block[a * Dim + b] += k * (n[a] * n[b]);
  }
}

/// Any row of any body, slot by slot.
template <int Dim>
void fill_row(const Body<Dim>& body, BlockCsr& m, Index i) {
  const Index n = body.count();
  const Index* first = m.column.data() + m.row_start[i];
  const Index* last = m.column.data() + m.row_start[i + 1];
  double* row = m.value.data() + m.row_start[i] * block_size<Dim>;
  std::fill(row, row + (last - first) * block_size<Dim>, 0.0);
  const auto block = [&](Index column) {
    return row + (std::lower_bound(first, last, column) - first) * block_size<Dim>;
  };
  double* diagonal = block(i);
  for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
    const double k = bond_stiffness(body, i, end);
    const Point<Dim> e = end.xi / end.length;
    add_outer<Dim>(diagonal, k, e);
    if (end.neighbour < n) {
      add_outer<Dim>(block(end.neighbour), -k, e);
      return;
    }
    for_each_image(body.boundary, static_cast<std::size_t>(end.neighbour - n),
                   [&](Index j, const double* coefficient) {
                     double* target = block(j);
                     for (int a = 0; a < Dim; ++a) {
                       for (int b = 0; b < Dim; ++b)
                         target[a * Dim + b] -= k * (e[a] * e[b]) * coefficient[b];
                     }
                   });
  });
}

/// Blocks k_b n n^T per family member of a grid of one material, calibration factors left out.
template <int Dim>
struct OrbitBlocks {
  std::vector<double> plus;   ///< + k n n^T
  std::vector<double> whole;  ///< the row of a particle with its whole family: -k n n^T ..., diagonal, ...
};

template <int Dim>
OrbitBlocks<Dim> orbit_blocks(const Body<Dim>& body, const GridBonds<Dim>& bonds) {
  constexpr int nb = block_size<Dim>;
  const Family<Dim>& f = bonds.family;
  const double v = body.particles.volume[0];
  OrbitBlocks<Dim> t;
  t.plus.assign(static_cast<std::size_t>(f.size()) * nb, 0.0);
  for (int k = 0; k < f.size(); ++k) {
    Point<Dim> e;
    for (int a = 0; a < Dim; ++a) e[a] = f.spacing * f.offset[k][a] / f.length[k];
    add_outer<Dim>(t.plus.data() + static_cast<std::size_t>(k) * nb,
                   body.constants.kernel[k] * f.weight[k] * (v * v) / f.length[k], e);
  }
  t.whole.assign(static_cast<std::size_t>(f.size() + 1) * nb, 0.0);
  double* diagonal = t.whole.data() + static_cast<std::size_t>(f.size() / 2) * nb;
  for (int k = 0; k < f.size(); ++k) {
    for (int b = 0; b < nb; ++b) {
      const double p = t.plus[static_cast<std::size_t>(k) * nb + b];
      t.whole[static_cast<std::size_t>(k < f.size() / 2 ? k : k + 1) * nb + b] = -p;
      diagonal[b] += p;
    }
  }
  return t;
}

/// A plain row of a grid of one material.
template <int Dim>
void fill_plain_row(const GridBonds<Dim>& bonds, const OrbitBlocks<Dim>& orbits,
                    const std::vector<double>& factor, Index i, Offset ends, double* row) {
  constexpr int nb = block_size<Dim>;
  const int half = bonds.family.size() / 2;
  if (factor.empty() && ends == bonds.family.size()) {
    std::memcpy(row, orbits.whole.data(), orbits.whole.size() * sizeof(double));
    return;
  }
  const Index* here = bonds.occupant.data() + bonds.home[i];
  std::array<double, nb> sum = {};
  double* diagonal = nullptr;
  for (int w = 0; w < bonds.words; ++w) {
    for (auto bits = bonds.alive[static_cast<std::size_t>(i) * bonds.words + w]; bits != 0;
         bits &= bits - 1) {
      const int k = 64 * w + std::countr_zero(bits);
      if (diagonal == nullptr && k >= half) {
        diagonal = row;
        row += nb;
      }
      const double f = factor.empty() ? 1.0 : 0.5 * (factor[i] + factor[here[bonds.step[k]]]);
      const double* plus = orbits.plus.data() + static_cast<std::size_t>(k) * nb;
      for (int b = 0; b < nb; ++b) {
        const double p = f * plus[b];
        row[b] = -p;
        sum[b] += p;
      }
      row += nb;
    }
  }
  std::copy(sum.begin(), sum.end(), diagonal == nullptr ? row : diagonal);
}

/// A plain row of a grid of one material whose pattern may hold bonds that broke since.
template <int Dim>
void refill_plain_row(const Body<Dim>& body, const GridBonds<Dim>& bonds, const OrbitBlocks<Dim>& orbits,
                      BlockCsr& m, Index i) {
  constexpr int nb = block_size<Dim>;
  const auto& factor = body.constants.factor;
  const Index* column = m.column.data() + m.row_start[i];
  const Index* last = m.column.data() + m.row_start[i + 1];
  double* block = m.value.data() + m.row_start[i] * nb;
  std::fill(block, block + (last - column) * nb, 0.0);
  std::array<double, nb> sum = {};
  double* diagonal = block + (std::lower_bound(column, last, i) - column) * nb;
  for_each_bond(bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
    for (; *column != end.neighbour; ++column) block += nb;
    const double f = factor.empty() ? 1.0 : 0.5 * (factor[i] + factor[end.neighbour]);
    const double* plus = orbits.plus.data() + static_cast<std::size_t>(end.slot) * nb;
    for (int b = 0; b < nb; ++b) {
      const double p = f * plus[b];
      block[b] = -p;
      sum[b] += p;
    }
  });
  std::copy(sum.begin(), sum.end(), diagonal);
}

}  // namespace

template <int Dim>
BlockCsr stiffness_pattern(const Body<Dim>& body) {
  const Index n = body.count();
  BlockCsr m;
  m.block = Dim;
  m.rows = n;
  m.row_start.assign(static_cast<std::size_t>(n) + 1, 0);
  std::visit(
      [&](const auto& bonds) {
#pragma omp parallel
        {
          std::vector<Index> columns;
#pragma omp for schedule(static)
          for (Index i = 0; i < n; ++i) {
            if (plain_row(bonds, body.particles, i)) {
              m.row_start[i + 1] = alive_ends(bonds, i) + 1;
            } else {
              row_columns(body, i, columns);
              m.row_start[i + 1] = static_cast<Offset>(columns.size());
            }
          }
        }
        for (Index i = 0; i < n; ++i) m.row_start[i + 1] += m.row_start[i];
        m.column.resize(static_cast<std::size_t>(m.blocks()));
#pragma omp parallel
        {
          std::vector<Index> columns;
#pragma omp for schedule(static)
          for (Index i = 0; i < n; ++i) {
            Index* column = m.column.data() + m.row_start[i];
            if (plain_row(bonds, body.particles, i)) {
              plain_columns<Dim>(bonds, i, column);
            } else {
              row_columns(body, i, columns);
              std::copy(columns.begin(), columns.end(), column);
            }
          }
        }
      },
      body.bonds);
  m.value.resize(static_cast<std::size_t>(m.blocks()) * block_size<Dim>);
  return m;
}

template <int Dim>
void fill_stiffness(const Body<Dim>& body, BlockCsr& matrix) {
  const Index n = body.count();
  const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds);
  if (grid == nullptr || body.density.size() > 1) {
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < n; ++i) fill_row(body, matrix, i);
    return;
  }
  const auto orbits = orbit_blocks(body, *grid);
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < n; ++i) {
    if (plain_row(*grid, body.particles, i)) {
      fill_plain_row(*grid, orbits, body.constants.factor, i,
                     matrix.row_start[i + 1] - matrix.row_start[i] - 1,
                     matrix.value.data() + matrix.row_start[i] * block_size<Dim>);
    } else {
      fill_row(body, matrix, i);
    }
  }
}

template <int Dim>
void refill_rows(const Body<Dim>& body, std::span<const Index> particles, BlockCsr& matrix) {
  const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds);
  const bool plain = grid != nullptr && body.density.size() == 1;
  const auto orbits = plain ? orbit_blocks(body, *grid) : OrbitBlocks<Dim>{};
  for (const Index i : particles) {
    if (plain && plain_row(*grid, body.particles, i))
      refill_plain_row(body, *grid, orbits, matrix, i);
    else
      fill_row(body, matrix, i);
  }
}

template <int Dim>
BlockCsr assemble_stiffness(const Body<Dim>& body) {
  BlockCsr m = stiffness_pattern(body);
  fill_stiffness(body, m);
  return m;
}

template <int Dim>
Eigen::VectorXd lumped_mass(const Body<Dim>& body) {
  Eigen::VectorXd mass(body.boundary.free);
  for (std::size_t d = 0; d < body.boundary.free_number.size(); ++d) {
    const std::size_t i = d / Dim;
    const Index number = body.boundary.free_number[d];
    if (number >= 0) mass[number] = body.density[body.particles.block[i]] * body.particles.volume[i];
  }
  return mass;
}

template <int Dim>
std::vector<Index> particle_of_free_dof(const Body<Dim>& body) {
  std::vector<Index> particle(body.boundary.free);
  for (std::size_t d = 0; d < body.boundary.free_number.size(); ++d) {
    const Index number = body.boundary.free_number[d];
    if (number >= 0) particle[number] = static_cast<Index>(d / Dim);
  }
  return particle;
}

template <int Dim>
Eigen::MatrixXd particle_positions(const Body<Dim>& body) {
  return Eigen::Map<const Eigen::MatrixXd>(body.particles.position[0].data(), Dim, body.count());
}

template <int Dim>
Eigen::VectorXd bond_energy(const Body<Dim>& body, const Eigen::MatrixXd& displacement) {
  const Index n = body.count();
  // The fields of one dof lie side by side; partial sums per particle are added in order below.
  const RowMajor u = displacement;
  RowMajor energy = RowMajor::Zero(n, u.cols());
#pragma omp parallel
  {
    Eigen::RowVectorXd stretch(u.cols());
    Eigen::RowVectorXd own(u.cols());
#pragma omp for schedule(static)
    for (Index i = 0; i < n; ++i) {
      for_each_bond(body.bonds, i, Which::alive, [&](const BondEnd<Dim>& end) {
        const double k = bond_stiffness(body, i, end);
        const Point<Dim> e = end.xi / end.length;
        if (end.neighbour < n) {
          stretch = e[0] * (u.row(end.neighbour * Dim) - u.row(i * Dim));
          for (int a = 1; a < Dim; ++a)
            stretch += e[a] * (u.row(end.neighbour * Dim + a) - u.row(i * Dim + a));
          energy.row(i).array() += 0.25 * k * stretch.array().square();  // the other end adds the other half
          return;
        }
        own.setZero();
        for (int a = 0; a < Dim; ++a) own += e[a] * u.row(i * Dim + a);
        stretch = own;
        for_each_image(body.boundary, static_cast<std::size_t>(end.neighbour - n),
                       [&](Index j, const double* coefficient) {
                         for (int a = 0; a < Dim; ++a) stretch -= e[a] * coefficient[a] * u.row(j * Dim + a);
                       });
        energy.row(i).array() += 0.5 * k * own.array() * stretch.array();
      });
    }
  }
  Eigen::RowVectorXd total = Eigen::RowVectorXd::Zero(u.cols());
  for (Index i = 0; i < n; ++i) total += energy.row(i);
  return total.transpose();
}

#define PERIMODE_ASSEMBLE(D)                                                       \
  template BlockCsr stiffness_pattern<D>(const Body<D>&);                          \
  template void fill_stiffness<D>(const Body<D>&, BlockCsr&);                      \
  template void refill_rows<D>(const Body<D>&, std::span<const Index>, BlockCsr&); \
  template BlockCsr assemble_stiffness<D>(const Body<D>&);                         \
  template Eigen::VectorXd lumped_mass<D>(const Body<D>&);                         \
  template std::vector<Index> particle_of_free_dof<D>(const Body<D>&);             \
  template Eigen::MatrixXd particle_positions<D>(const Body<D>&);                  \
  template Eigen::VectorXd bond_energy<D>(const Body<D>&, const Eigen::MatrixXd&)
PERIMODE_ASSEMBLE(1);
PERIMODE_ASSEMBLE(2);
PERIMODE_ASSEMBLE(3);
#undef PERIMODE_ASSEMBLE

}  // namespace perimode
