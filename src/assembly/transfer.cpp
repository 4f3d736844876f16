// SPDX-License-Identifier: BSD-3-Clause
#include "transfer.hpp"

#include <algorithm>

#include "linalg/vector_kernels.hpp"

namespace perimode {

namespace {

/// sum = factor from, or sum += factor from.
PERIMODE_EVERY_PROCESSOR void weigh(Index n, double factor, const double* __restrict from, bool first,
                                    double* __restrict sum) {
  if (first) {
    for (Index i = 0; i < n; ++i) sum[i] = factor * from[i];
  } else {
    for (Index i = 0; i < n; ++i) sum[i] += factor * from[i];
  }
}

/// Fine cells 2I, 2I + 1 of one row from coarse cells I - 1 .. I + 1; coarse[0] belongs to cell -1.
template <int Dim>
[[gnu::always_inline]] inline void widen(Index coarse_cells, const double* __restrict coarse,
                                         double* __restrict fine) {
  for (Index i = 0; i < coarse_cells; ++i) {
    for (int a = 0; a < Dim; ++a) {
      const double here = 0.75 * coarse[(i + 1) * Dim + a];
      fine[2 * i * Dim + a] = here + 0.25 * coarse[i * Dim + a];
      fine[(2 * i + 1) * Dim + a] = here + 0.25 * coarse[(i + 2) * Dim + a];
    }
  }
}

/// Its transpose, for frame cells -1 .. coarse_cells; fine[0 .. Dim) belongs to cell 0 and two zero cells
/// stand before it and behind its end.
template <int Dim>
[[gnu::always_inline]] inline void narrow(Index frame_cells, const double* __restrict fine,
                                          double* __restrict coarse) {
  for (Index i = 0; i < frame_cells; ++i) {
    const double* from = fine + (2 * i - 3) * Dim;  // fine cell 2 (i - 1) - 1
    for (int a = 0; a < Dim; ++a) {
      coarse[i * Dim + a] = 0.25 * (from[a] + from[3 * Dim + a]) + 0.75 * (from[Dim + a] + from[2 * Dim + a]);
    }
  }
}

PERIMODE_EVERY_PROCESSOR void widen_row(int dim, Index coarse_cells, const double* coarse, double* fine) {
  if (dim == 1) return widen<1>(coarse_cells, coarse, fine);
  if (dim == 2) return widen<2>(coarse_cells, coarse, fine);
  widen<3>(coarse_cells, coarse, fine);
}

PERIMODE_EVERY_PROCESSOR void narrow_row(int dim, Index frame_cells, const double* fine, double* coarse) {
  if (dim == 1) return narrow<1>(frame_cells, fine, coarse);
  if (dim == 2) return narrow<2>(frame_cells, fine, coarse);
  narrow<3>(frame_cells, fine, coarse);
}

template <int Dim>
[[gnu::always_inline]] inline void add_scaled(Index particles, const double* __restrict scale,
                                              const double* __restrict row, double* __restrict x) {
  for (Index i = 0; i < particles; ++i)
    for (int a = 0; a < Dim; ++a) x[i * Dim + a] += scale[i] * row[i * Dim + a];
}

template <int Dim>
[[gnu::always_inline]] inline void scaled_difference(Index particles, const double* __restrict scale,
                                                     const double* __restrict b, const double* __restrict q,
                                                     double* __restrict row) {
  for (Index i = 0; i < particles; ++i)
    for (int a = 0; a < Dim; ++a) row[i * Dim + a] = scale[i] * (b[i * Dim + a] - q[i * Dim + a]);
}

PERIMODE_EVERY_PROCESSOR void add_row(int dim, Index particles, const double* scale, const double* row,
                                      double* x) {
  if (dim == 1) return add_scaled<1>(particles, scale, row, x);
  if (dim == 2) return add_scaled<2>(particles, scale, row, x);
  add_scaled<3>(particles, scale, row, x);
}

PERIMODE_EVERY_PROCESSOR void difference_row(int dim, Index particles, const double* scale, const double* b,
                                             const double* q, double* row) {
  if (dim == 1) return scaled_difference<1>(particles, scale, b, q, row);
  if (dim == 2) return scaled_difference<2>(particles, scale, b, q, row);
  scaled_difference<3>(particles, scale, b, q, row);
}

/// The coarse rows that a fine row (y, z) takes from, or the fine rows that a coarse one gives to:
/// visit(row number, weight) over the axes beyond x.
template <int Dim, class Axis, class Visit>
void for_each_row(const std::array<Index, Dim>& cells, const Axis& axis, const Visit& visit) {
  if constexpr (Dim == 1) {
    visit(Index{0}, 1.0);
  } else {
    axis(1, [&](Index y, double wy) {
      if constexpr (Dim == 2) {
        visit(y, wy);
      } else {
        axis(2, [&](Index z, double wz) { visit(y + cells[1] * z, wy * wz); });
      }
    });
  }
}

}  // namespace

template <int Dim>
Transfer<Dim>::Transfer(const Body<Dim>& fine, const Body<Dim>& coarse) : fine_(fine), coarse_(coarse) {
  const auto& bonds = std::get<GridBonds<Dim>>(coarse.bonds);
  cells_ = fine.particles.grid->cells;
  rows_ = frame_rows_ = 1;
  std::array<Index, Dim> stride;  // of the frame, in cells
  Index frame = 1;
  for (int a = 0; a < Dim; ++a) {
    frame_cells_[a] = coarse.particles.grid->cells[a] + 2;
    stride[a] = frame;
    frame *= frame_cells_[a];
    if (a == 0) continue;
    rows_ *= cells_[a];
    frame_rows_ *= frame_cells_[a];
  }
  width_ = 2 * (frame_cells_[0] - 2) * Dim;
  first_in_row_.assign(rows_ + 1, 0);
  for (Index i = 0; i < fine.count(); ++i) ++first_in_row_[fine.particles.cell[i] / cells_[0] + 1];
  for (Index r = 0; r < rows_; ++r) first_in_row_[r + 1] += first_in_row_[r];
  const auto& number = fine.boundary.free_number;
  plain_row_.assign(rows_, 0);
  for (Index r = 0; r < rows_; ++r) {
    const std::size_t first = static_cast<std::size_t>(first_in_row_[r]) * Dim;
    const std::size_t last = static_cast<std::size_t>(first_in_row_[r + 1]) * Dim;
    plain_row_[r] = last - first == static_cast<std::size_t>(cells_[0]) * Dim && number[first] >= 0 &&
                    number[last - 1] - number[first] + 1 == static_cast<Index>(last - first);
  }

  frame_.assign(static_cast<std::size_t>(frame) * Dim, 0.0);
  frame_cell_.resize(coarse.count());
  std::vector<Index> coarse_at(frame, GridBonds<Dim>::absent);
  for (Index i = 0; i < coarse.count(); ++i) {
    const auto cell = coarse.particles.grid->cell(coarse.particles.cell[i]);
    Index at = 0;
    for (int a = 0; a < Dim; ++a) at += stride[a] * (cell[a] + 1);
    frame_cell_[i] = at;
    coarse_at[at] = i;
  }
  for (Index at = 0; at < frame; ++at) {
    Index padded = 0;
    Index padded_stride = 1;
    Index rest = at;
    bool beyond = false;
    for (int a = 0; a < Dim; ++a) {
      const Index c = rest % frame_cells_[a] - 1;
      rest /= frame_cells_[a];
      beyond = beyond || c < 0 || c >= frame_cells_[a] - 2;
      padded += padded_stride * (c + bonds.reach);
      padded_stride *= bonds.padded[a];
    }
    const Index j = bonds.occupant[padded];
    if (j == GridBonds<Dim>::absent) continue;
    for (int a = 0; a < Dim; ++a) frame_[static_cast<std::size_t>(at) * Dim + a] = 1.0;  // something is there
    if (!beyond) continue;
    Echo echo{at, j, {}};
    echo.coefficient.fill(1.0);
    if (j >= coarse.count()) {
      const auto g = static_cast<std::size_t>(j - coarse.count());
      echo.particle = coarse.boundary.image[g];
      for (int a = 0; a < Dim; ++a) echo.coefficient[a] = coarse.boundary.coefficient[g * Dim + a];
    }
    echoes_.push_back(echo);
  }
  scale_.assign(fine.count(), 1.0);
  for_each_prolonged_row([&](Index row, const double* values) {
    for (Index i = first_in_row_[row]; i < first_in_row_[row + 1]; ++i)
      scale_[i] = 1.0 / values[(fine_.particles.cell[i] % cells_[0]) * Dim];
  });
  find_parted(coarse_at);
  std::fill(frame_.begin(), frame_.end(), 0.0);
  gather_.resize(frame_.size());
  dense_.assign(static_cast<std::size_t>(rows_) * width_, 0.0);
}

template <int Dim>
void Transfer<Dim>::find_parted(const std::vector<Index>& coarse_at) {
  constexpr int corners = 1 << Dim;
  const auto& bonds = std::get<GridBonds<Dim>>(coarse_.bonds);
  const auto& offsets = bonds.family.offset;
  std::array<std::array<int, corners>, corners>
      slot;  // of the step to a corner, by the place among the children
  for (int place = 0; place < corners; ++place) {
    for (int corner = 0; corner < corners; ++corner) {
      std::array<int, Dim> step;
      for (int a = 0; a < Dim; ++a) step[a] = (corner >> a) % 2 == 0 ? 0 : 2 * ((place >> a) % 2) - 1;
      const auto found = std::find(offsets.begin(), offsets.end(), step);
      slot[place][corner] = found == offsets.end() ? -1 : static_cast<int>(found - offsets.begin());
    }
  }
  for (Index i = 0; i < fine_.count(); ++i) {
    const auto cell = fine_.particles.grid->cell(fine_.particles.cell[i]);
    int place = 0;
    Index parent = 0;
    std::array<Index, Dim> step;
    Index stride = 1;
    for (int a = 0; a < Dim; ++a) {
      place |= (cell[a] % 2) << a;
      parent += stride * (cell[a] / 2 + 1);
      step[a] = cell[a] % 2 == 0 ? -stride : stride;
      stride *= frame_cells_[a];
    }
    const Index home = coarse_at[parent];
    Parted p{i, {}, {}};
    double sum = 0.0;
    bool parted = false;
    for (int corner = 0; corner < corners; ++corner) {
      p.cell[corner] = parent;
      p.weight[corner] = 1.0;
      for (int a = 0; a < Dim; ++a) {
        const bool aside = (corner >> a) % 2 == 1;
        p.cell[corner] += aside ? step[a] : 0;
        p.weight[corner] *= aside ? 0.25 : 0.75;
      }
      const int k = slot[place][corner];
      const bool broken = k >= 0 && !is_alive(bonds, home, k);
      const bool there = frame_[static_cast<std::size_t>(p.cell[corner]) * Dim] != 0.0;
      parted = parted || (broken && there);
      if (broken || !there) p.weight[corner] = 0.0;
      sum += p.weight[corner];
    }
    if (!parted) continue;
    for (double& w : p.weight) w /= sum;
    scale_[i] = 0.0;
    parted_.push_back(p);
  }
}

template <int Dim>
double Transfer<Dim>::bytes() const {
  return static_cast<double>((first_in_row_.size() + frame_cell_.size()) * sizeof(Index) + plain_row_.size() +
                             echoes_.size() * sizeof(Echo) + parted_.size() * sizeof(Parted) +
                             (scale_.size() + frame_.size() + gather_.size() + dense_.size()) *
                                 sizeof(double));
}

template <int Dim>
template <class Use>
void Transfer<Dim>::for_each_prolonged_row(const Use& use) {
  const Index frame_width = frame_cells_[0] * Dim;
#pragma omp parallel
  {
    std::vector<double> sum(frame_width);
    std::vector<double> values(width_);
#pragma omp for schedule(static)
    for (Index row = 0; row < rows_; ++row) {
      if (first_in_row_[row] == first_in_row_[row + 1]) continue;
      std::array<Index, 3> at = {0, row, 0};
      if constexpr (Dim == 3) at = {0, row % cells_[1], row / cells_[1]};
      bool first = true;
      for_each_row<Dim>(
          frame_cells_,
          [&](int axis, const auto& next) {
            const Index parent = at[axis] / 2 + 1;  // in the frame
            next(parent, 0.75);
            next(at[axis] % 2 == 0 ? parent - 1 : parent + 1, 0.25);
          },
          [&](Index from, double weight) {
            weigh(frame_width, weight, frame_.data() + static_cast<std::size_t>(from) * frame_width, first,
                  sum.data());
            first = false;
          });
      widen_row(Dim, frame_cells_[0] - 2, sum.data(), values.data());
      use(row, values.data());
    }
  }
}

template <int Dim>
void Transfer<Dim>::spread(const double* coarse) {
  const auto& number = coarse_.boundary.free_number;
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < coarse_.count(); ++i) {
    for (int a = 0; a < Dim; ++a) {
      const Index free = number[static_cast<std::size_t>(i) * Dim + a];
      frame_[static_cast<std::size_t>(frame_cell_[i]) * Dim + a] = free < 0 ? 0.0 : coarse[free];
    }
  }
  for (const Echo& echo : echoes_) {
    for (int a = 0; a < Dim; ++a) {
      frame_[static_cast<std::size_t>(echo.cell) * Dim + a] =
          echo.coefficient[a] * frame_[static_cast<std::size_t>(frame_cell_[echo.particle]) * Dim + a];
    }
  }
}

template <int Dim>
void Transfer<Dim>::add_prolonged(const double* coarse, double* x) {
  spread(coarse);
  const auto& number = fine_.boundary.free_number;
  for_each_prolonged_row([&](Index row, const double* values) {
    const Index first = first_in_row_[row];
    if (plain_row_[row] != 0) {
      add_row(Dim, cells_[0], scale_.data() + first, values,
              x + number[static_cast<std::size_t>(first) * Dim]);
      return;
    }
    for (Index i = first; i < first_in_row_[row + 1]; ++i) {
      const double* value = values + static_cast<std::size_t>(fine_.particles.cell[i] % cells_[0]) * Dim;
      for (int a = 0; a < Dim; ++a) {
        const Index free = number[static_cast<std::size_t>(i) * Dim + a];
        if (free >= 0) x[free] += scale_[i] * value[a];
      }
    }
  });
  for (const Parted& p : parted_) {
    for (int a = 0; a < Dim; ++a) {
      const Index free = number[static_cast<std::size_t>(p.particle) * Dim + a];
      if (free < 0) continue;
      for (std::size_t c = 0; c < p.cell.size(); ++c)
        x[free] += p.weight[c] * frame_[static_cast<std::size_t>(p.cell[c]) * Dim + a];
    }
  }
}

template <int Dim>
void Transfer<Dim>::restrict_difference(const double* b, const double* q, double* coarse) {
  const auto& number = fine_.boundary.free_number;
  const Index frame_width = frame_cells_[0] * Dim;
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (Index row = 0; row < rows_; ++row) {
      double* values = dense_.data() + static_cast<std::size_t>(row) * width_;
      const Index first = first_in_row_[row];
      if (plain_row_[row] != 0) {
        const Index free = number[static_cast<std::size_t>(first) * Dim];
        difference_row(Dim, cells_[0], scale_.data() + first, b + free, q + free, values);
        continue;
      }
      for (Index i = first; i < first_in_row_[row + 1]; ++i) {
        double* value = values + static_cast<std::size_t>(fine_.particles.cell[i] % cells_[0]) * Dim;
        for (int a = 0; a < Dim; ++a) {
          const Index free = number[static_cast<std::size_t>(i) * Dim + a];
          value[a] = free < 0 ? 0.0 : scale_[i] * (b[free] - q[free]);
        }
      }
    }
    std::vector<double> sum(width_ + 6 * Dim, 0.0);
    double* middle = sum.data() + 3 * Dim;
#pragma omp for schedule(static)
    for (Index row = 0; row < frame_rows_; ++row) {
      std::array<Index, 3> at = {0, row, 0};
      if constexpr (Dim == 3) at = {0, row % frame_cells_[1], row / frame_cells_[1]};
      bool first = true;
      for_each_row<Dim>(
          cells_,
          [&](int axis, const auto& next) {
            constexpr std::array<double, 4> weight = {0.25, 0.75, 0.75, 0.25};
            for (int k = 0; k < 4; ++k) {
              const Index from = 2 * at[axis] - 3 + k;
              if (from >= 0 && from < cells_[axis]) next(from, weight[k]);
            }
          },
          [&](Index from, double weight) {
            weigh(width_, weight, dense_.data() + static_cast<std::size_t>(from) * width_, first, middle);
            first = false;
          });
      if (first) std::fill(middle, middle + width_, 0.0);
      narrow_row(Dim, frame_cells_[0], middle, gather_.data() + static_cast<std::size_t>(row) * frame_width);
    }
  }
  for (const Parted& p : parted_) {
    for (int a = 0; a < Dim; ++a) {
      const Index free = number[static_cast<std::size_t>(p.particle) * Dim + a];
      if (free < 0) continue;
      for (std::size_t c = 0; c < p.cell.size(); ++c)
        gather_[static_cast<std::size_t>(p.cell[c]) * Dim + a] += p.weight[c] * (b[free] - q[free]);
    }
  }
  for (const Echo& echo : echoes_) {
    for (int a = 0; a < Dim; ++a) {
      gather_[static_cast<std::size_t>(frame_cell_[echo.particle]) * Dim + a] +=
          echo.coefficient[a] * gather_[static_cast<std::size_t>(echo.cell) * Dim + a];
    }
  }
  const auto& coarse_number = coarse_.boundary.free_number;
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < coarse_.count(); ++i) {
    for (int a = 0; a < Dim; ++a) {
      const Index free = coarse_number[static_cast<std::size_t>(i) * Dim + a];
      if (free >= 0) coarse[free] = gather_[static_cast<std::size_t>(frame_cell_[i]) * Dim + a];
    }
  }
}

template class Transfer<1>;
template class Transfer<2>;
template class Transfer<3>;

}  // namespace perimode
