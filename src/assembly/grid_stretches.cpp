// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "bond_stretch.hpp"
#include "perimode/linalg/threads.hpp"

namespace perimode {

namespace {

/// The body laid out for the kernels.
template <int Dim>
class GridSearch {
 public:
  GridSearch(const Body<Dim>& body, const BondLimits& limits, const Eigen::VectorXd* u_0,
             const Eigen::VectorXd& u_1)
      : body_(body),
        bonds_(std::get<GridBonds<Dim>>(body.bonds)),
        inverse_(body, limits),
        given_0_(u_0),
        given_1_(u_1) {
    // An odd number of cache lines, so that components do not crowd the same sets.
    stride_ = ((static_cast<std::ptrdiff_t>(bonds_.occupant.size()) + stretch_lanes + 7) / 8 | 1) * 8;
    if (u_0 != nullptr) spread(*u_0, u_0_);
    spread(u_1, u_1_);
    const auto differ = [](const auto& v) {
      return std::any_of(v.begin(), v.end(), [&](const auto& x) { return x != v.front(); });
    };
    vary_ = !bonds_.ghosts.empty() || !limits.no_fail.empty() || differ(limits.critical_stretch) ||
            !body.constants.factor.empty() || body.density.size() > 1;
    add_family();
    if (vary_) add_cells();
  }

  [[nodiscard]] StretchSums chunk(Index begin, Index end) const {
    StretchSums sums;
    for (Index first = begin, last = begin; first < end; first = last) {
      for (last = first + 1; last < end && bonds_.home[last] == bonds_.home[last - 1] + 1;) ++last;
      sums.add(stretches_of<Dim>(run(first, last)));
    }
    if (!bonds_.ghosts.empty())
      for (Index i = begin; i < end; ++i) lower_ghosts(i, sums);
    return sums;
  }

 private:
  [[nodiscard]] StretchRun run(Index first, Index last) const {
    const Index home = bonds_.home[first];
    const auto from = [home](const std::vector<double>& v) { return v.empty() ? nullptr : v.data() + home; };
    StretchRun r;
    r.u_0 = from(u_0_);
    r.u_1 = from(u_1_);
    r.stride = stride_;
    r.step = bonds_.step.data();
    r.direction = direction_.data();
    r.rate = rate_.data();
    r.stiffness = stiffness_.data();
    r.members = bonds_.family.size();
    r.first = r.members / 2;
    r.alive = bonds_.alive.data() + static_cast<std::ptrdiff_t>(first) * bonds_.words;
    r.words = bonds_.words;
    r.count = last - first;
    r.limit = from(limit_);
    r.share = from(share_);
    r.factor = from(factor_);
    r.block = from(block_);
    return r;
  }

  /// Bonds of the lower half lead to particles that count them themselves, but for those to ghosts.
  void lower_ghosts(Index i, StretchSums& sums) const {
    const Grid<Dim>& grid = *body_.particles.grid;
    const auto cell = grid.cell(body_.particles.cell[i]);
    bool near = false;
    for (int a = 0; a < Dim; ++a) {
      near = near || (bonds_.beyond[2 * a] == Beyond::ghosts && cell[a] < bonds_.reach) ||
             (bonds_.beyond[2 * a + 1] == Beyond::ghosts && cell[a] >= grid.cells[a] - bonds_.reach);
    }
    if (!near) return;
    for (int k = 0; k < bonds_.family.size() / 2; ++k) {
      const Index partner = bonds_.occupant[bonds_.home[i] + bonds_.step[k]];
      if (partner < body_.count() || !is_alive(bonds_, i, k)) continue;
      add_stretch(body_, inverse_, i, bond_end(body_, {i, k}), given_0_, given_1_, sums);
    }
  }

  void spread(const Eigen::VectorXd& u, std::vector<double>& to) const {
    to.assign(static_cast<std::size_t>(stride_ * Dim), 0.0);
    const Index n = body_.count();
    const auto cells = static_cast<Index>(bonds_.occupant.size());
#pragma omp parallel for schedule(static) if (n > parallel_rows)
    for (Index cell = 0; cell < cells; ++cell) {
      const Index occupant = bonds_.occupant[cell];
      if (occupant == GridBonds<Dim>::absent) continue;
      const Point<Dim> there = partner_displacement(body_.boundary, u.data(), occupant, n, false);
      for (int a = 0; a < Dim; ++a) to[static_cast<std::size_t>(a * stride_ + cell)] = there[a];
    }
  }

  void add_family() {
    const Family<Dim>& family = bonds_.family;
    const double volume = body_.particles.volume[0];
    const double limit = inverse_.of(0);
    for (int k = 0; k < family.size(); ++k) {
      for (int a = 0; a < Dim; ++a)
        direction_.push_back(family.spacing * family.offset[k][a] / family.length[k]);
      rate_.push_back((vary_ ? 1.0 : limit) / family.length[k]);
    }
    for (std::size_t b = 0; b < body_.density.size(); ++b) {
      for (int k = 0; k < family.size(); ++k) {
        const double c = body_.constants.kernel[b * static_cast<std::size_t>(family.size()) + k];
        stiffness_.push_back(c * family.weight[k] * (volume * volume) / family.length[k]);
      }
    }
  }

  void add_cells() {
    const std::size_t cells = bonds_.occupant.size() + stretch_lanes;
    const auto& factor = body_.constants.factor;
    limit_.assign(cells, 0.0);
    share_.assign(cells, 1.0);
    if (!factor.empty()) factor_.assign(cells, 1.0);
    if (body_.density.size() > 1) block_.assign(cells, 0.0);
    for (std::size_t cell = 0; cell < bonds_.occupant.size(); ++cell) {
      const Index occupant = bonds_.occupant[cell];
      if (occupant == GridBonds<Dim>::absent) continue;
      const Index i = owner(body_.bonds, occupant, body_.count());
      limit_[cell] = inverse_.protects(i) ? -1.0 : inverse_.of(i);
      if (!factor_.empty()) factor_[cell] = factor[i];
      if (!block_.empty()) block_[cell] = body_.particles.block[i];
      if (occupant >= body_.count()) share_[cell] = ghost_share(body_.boundary, occupant - body_.count());
    }
  }

  const Body<Dim>& body_;
  const GridBonds<Dim>& bonds_;
  InverseLimit<Dim> inverse_;
  const Eigen::VectorXd* given_0_;
  const Eigen::VectorXd& given_1_;
  std::ptrdiff_t stride_ = 0;
  bool vary_ = false;
  std::vector<double> u_0_, u_1_;  ///< over the padded grid, component by component
  std::vector<double> direction_, rate_, stiffness_;
  std::vector<double> limit_, share_, factor_, block_;
};

}  // namespace

template <int Dim>
std::vector<StretchSums> grid_stretches(const Body<Dim>& body, const BondLimits& limits,
                                        const Eigen::VectorXd* u_0, const Eigen::VectorXd& u_1) {
  const GridSearch<Dim> search(body, limits, u_0, u_1);
  const Index n = body.count();
  std::vector<StretchSums> sums(static_cast<std::size_t>((n + stretch_chunk - 1) / stretch_chunk));
#pragma omp parallel for schedule(static) if (n > parallel_rows)
  for (Index begin = 0; begin < n; begin += stretch_chunk)
    sums[static_cast<std::size_t>(begin / stretch_chunk)] =
        search.chunk(begin, std::min(n, begin + stretch_chunk));
  return sums;
}

#define PERIMODE_GRID_STRETCHES(D)                                                       \
  template std::vector<StretchSums> grid_stretches<D>(const Body<D>&, const BondLimits&, \
                                                      const Eigen::VectorXd*, const Eigen::VectorXd&)
PERIMODE_GRID_STRETCHES(1);
PERIMODE_GRID_STRETCHES(2);
PERIMODE_GRID_STRETCHES(3);
#undef PERIMODE_GRID_STRETCHES

}  // namespace perimode
