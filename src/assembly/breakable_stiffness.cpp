// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/breakable_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "block_form.hpp"
#include "bond_ends.hpp"
#include "bond_form.hpp"
#include "stencil.hpp"

namespace perimode {

namespace {

/// A bond from its lower end; `image` is the bond itself where it has none besides.
struct Listed {
  BondRef bond, image;
};

template <int Dim>
Listed listed(const Body<Dim>& body, const BondRef& bond) {
  if (const auto other = other_end(body, bond)) {
    const BondRef lower = std::min(bond, *other);
    return {lower, lower};
  }
  const BondRef image = wall_image(body, bond).value_or(bond);
  return {std::min(bond, image), std::max(bond, image)};
}

/// The forms follow one end each; `refresh` comes after all of them, with the particles concerned.
template <int Dim>
void take_out(Stencil<Dim>&, const Body<Dim>&, const BondRef&) {}
template <int Dim>
void take_out(BondForm<Dim>& form, const Body<Dim>&, const BondRef& bond) {
  form.remove(bond.particle, bond.slot);
}
template <int Dim>
void take_out(BlockForm<Dim>&, const Body<Dim>&, const BondRef&) {}

template <int Dim>
void refresh(Stencil<Dim>& stencil, const Body<Dim>&, std::span<const Index> particles) {
  for (const Index i : particles) family_no_longer_whole(stencil, i);
}
template <int Dim>
void refresh(BondForm<Dim>&, const Body<Dim>&, std::span<const Index>) {}
template <int Dim>
void refresh(BlockForm<Dim>& form, const Body<Dim>& body, std::span<const Index> particles) {
  refill_rows(body, particles, form.matrix);
}

}  // namespace

template <int Dim>
std::vector<BondRef> with_images(const Body<Dim>& body, std::vector<BondRef> bonds) {
  std::vector<Listed> list;
  list.reserve(bonds.size());
  for (const BondRef& bond : bonds)
    if (alive(body, bond)) list.push_back(listed(body, bond));
  std::sort(list.begin(), list.end(), [](const Listed& a, const Listed& b) { return a.bond < b.bond; });
  bonds.clear();
  for (const Listed& l : list) {
    if (!bonds.empty() && (bonds.back() == l.bond || bonds.back() == l.image)) continue;
    bonds.push_back(l.bond);
    if (!(l.image == l.bond)) bonds.push_back(l.image);
  }
  return bonds;
}

template <int Dim>
BondColumns bond_columns(const Body<Dim>& body, std::span<const BondRef> bonds) {
  const auto& number = body.boundary.free_number;
  BondColumns result;
  result.positive.rows = result.negative.rows = body.boundary.free;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const Index i = bonds[b].particle;
    const BondEnd<Dim> end = bond_end(body, bonds[b]);
    const double k = bond_stiffness(body, i, end);
    SparseColumns& columns = k < 0.0 ? result.negative : result.positive;
    // [n; -C n]: the partner is a particle with C = 1, or a ghost u = C u_j.
    const Point<Dim> n = end.xi / end.length;
    Index j = end.neighbour;
    Point<Dim> c = Point<Dim>::Ones();
    double root = std::sqrt(std::abs(k));
    if (j >= body.count()) {
      const auto ghost = static_cast<std::size_t>(j - body.count());
      j = body.boundary.image[ghost];
      c = Eigen::Map<const Point<Dim>>(body.boundary.coefficient.data() + ghost * Dim);
      const auto image = wall_image(body, bonds[b]);
      if (image && *image == bonds[b]) root *= std::sqrt(0.5);  // k n [n - C n]^T, and n - C n = 2 n or 0
      if (image && b + 1 < bonds.size() && *image == bonds[b + 1] && !(*image == bonds[b])) ++b;
    }
    if (root == 0.0) continue;
    const auto add = [&](Index particle, const Point<Dim>& part) {
      for (int a = 0; a < Dim; ++a) {
        const Index row = number[static_cast<std::size_t>(particle) * Dim + a];
        if (row < 0 || part[a] == 0.0) continue;
        columns.row.push_back(row);
        columns.value.push_back(root * part[a]);
      }
    };
    const Point<Dim> other = -c.cwiseProduct(n);
    if (i == j) {
      add(i, n + other);
    } else {  // free dofs ascend with the particles
      add(std::min(i, j), i < j ? n : other);
      add(std::max(i, j), i < j ? other : n);
    }
    if (columns.start.back() == static_cast<Offset>(columns.row.size())) continue;
    columns.start.push_back(static_cast<Offset>(columns.row.size()));
  }
  return result;
}

template <int Dim>
struct BreakableStiffness<Dim>::Implementation {
  using Form = std::variant<Stencil<Dim>, BondForm<Dim>, BlockForm<Dim>>;

  Body<Dim>& body;
  Form form;

  static Form made(const Body<Dim>& body, StiffnessForm of) {
    switch (chosen_form(body, of)) {
      case StiffnessForm::blocks:
        return make_block_form(body);
      case StiffnessForm::bonds:
        return make_bond_form(body);
      default:
        return make_stencil(body);
    }
  }
};

template <int Dim>
BreakableStiffness<Dim>::BreakableStiffness(Body<Dim>& body, StiffnessForm form)
    : implementation_(std::make_unique<Implementation>(body, Implementation::made(body, form))) {}

template <int Dim>
BreakableStiffness<Dim>::~BreakableStiffness() = default;
template <int Dim>
BreakableStiffness<Dim>::BreakableStiffness(BreakableStiffness&&) noexcept = default;
template <int Dim>
BreakableStiffness<Dim>& BreakableStiffness<Dim>::operator=(BreakableStiffness&&) noexcept = default;

template <int Dim>
LinearOperator BreakableStiffness<Dim>::product() const {
  Implementation* held = implementation_.get();
  return {held->body.boundary.free, [held](const double* x, double* y) {
            std::visit([&](auto& form) { form.apply(x, y); }, held->form);
          }};
}

template <int Dim>
RowProduct BreakableStiffness<Dim>::rows() const {
  return in_rows(product());
}

template <int Dim>
void BreakableStiffness<Dim>::break_bonds(std::span<const BondRef> bonds) {
  Body<Dim>& body = implementation_->body;
  std::vector<Index> particles;
  std::visit(
      [&](auto& form) {
        for (const BondRef& bond : bonds) {
          if (!alive(body, bond)) continue;
          const auto other = other_end(body, bond);
          take_out(form, body, bond);
          particles.push_back(bond.particle);
          if (other) {
            take_out(form, body, *other);
            particles.push_back(other->particle);
          }
          break_bond(body.bonds, bond.particle, bond.slot);
        }
        std::sort(particles.begin(), particles.end());
        particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
        refresh(form, body, particles);
      },
      implementation_->form);
}

#define PERIMODE_BREAKABLE(D)                                                         \
  template std::vector<BondRef> with_images<D>(const Body<D>&, std::vector<BondRef>); \
  template BondColumns bond_columns<D>(const Body<D>&, std::span<const BondRef>);     \
  template class BreakableStiffness<D>
PERIMODE_BREAKABLE(1);
PERIMODE_BREAKABLE(2);
PERIMODE_BREAKABLE(3);
#undef PERIMODE_BREAKABLE

}  // namespace perimode
