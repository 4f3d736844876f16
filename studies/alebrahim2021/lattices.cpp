// SPDX-License-Identifier: BSD-3-Clause
#include "lattices.hpp"

#include <algorithm>
#include <cmath>

#include "perimode/dispersion/optimise.hpp"

namespace perimode::studies {

Key key(const std::string& quantity, const std::string& body, int n, double at) {
  return {quantity, body, static_cast<double>(n), n, at};
}

template <int Dim>
Lattice<Dim> original_lattice(int n) {
  Lattice<Dim> lattice;
  lattice.medium.material.youngs_modulus = 1.0;
  lattice.medium.material.density = 1.0;
  lattice.medium.continuum = {Dim, Plane::strain, 1.0};
  lattice.medium.horizon = n;
  lattice.family = make_family<Dim>(1.0, n, VolumeCorrection::none);
  lattice.rates = bond_rates<Dim>(lattice.medium, lattice.family);
  return lattice;
}

template <int Dim>
Lattice<Dim> modified_lattice(int n, const std::vector<double>& alpha) {
  return with_shells<Dim>(original_lattice<Dim>(n), alpha);
}

template <int Dim>
Model periodic_model(int n, const std::vector<double>& alpha, int cells) {
  Model model;
  model.dimension = Dim;
  model.plane = Plane::strain;
  GridSpec grid;
  grid.lower.assign(Dim, 0.0);
  grid.upper.assign(Dim, cells);
  grid.spacing = 1.0;
  model.particles = grid;
  model.horizon = {HorizonSpec::Rule::ratio, static_cast<double>(n), {}};
  model.periodic = {true, Dim > 1, false};
  const Lattice<Dim> lattice = original_lattice<Dim>(n);
  model.material = lattice.medium.material;
  model.material.micromodulus.kernel = Kernel::shells;
  model.material.micromodulus.shells.reserve(alpha.size());
  for (std::size_t s = 0; s < alpha.size(); ++s) {
    Shell& shell = model.material.micromodulus.shells.emplace_back();
    std::copy(lattice.family.shell[s].begin(), lattice.family.shell[s].end(), shell.offset.begin());
    shell.alpha = alpha[s];
  }
  return model;
}

std::vector<double> printed_column(const ExpectedResults& paper, const std::string& quantity,
                                   const std::string& body, int n) {
  std::vector<double> numbers;
  for (int i = 1;; ++i) {
    const auto found = paper.find(key(quantity, body, n, i));
    if (found == paper.end()) return numbers;
    numbers.push_back(found->second.value);
  }
}

std::vector<int> table2_orbits(int n) {
  using Offsets = std::vector<std::array<int, 2>>;
  const Offsets bonds = n == 2 ? Offsets{{1, 1}, {2, 0}, {1, 0}}
                               : Offsets{{2, 2}, {2, 1}, {2, 1}, {1, 1}, {3, 0}, {2, 0}, {1, 0}};
  const auto shells = make_family<2>(1.0, n, VolumeCorrection::none).shell;
  std::vector<int> orbits;
  orbits.reserve(bonds.size());
  for (const auto& bond : bonds)
    orbits.push_back(static_cast<int>(std::find(shells.begin(), shells.end(), bond) - shells.begin()));
  return orbits;
}

std::vector<double> by_orbit(const std::vector<double>& numbers, const std::vector<int>& orbits) {
  std::vector<double> alpha(static_cast<std::size_t>(*std::max_element(orbits.begin(), orbits.end()) + 1));
  for (std::size_t i = 0; i < numbers.size(); ++i) alpha[static_cast<std::size_t>(orbits[i])] = numbers[i];
  return alpha;
}

double bar_frequency(const Lattice<1>& bar, double k) {
  return std::sqrt(lattice_symbol<1>(bar.family, bar.rates, Point<1>(k))(0, 0));
}

std::array<double, 2> long_wave_moduli(const Lattice<2>& plate) {
  std::array<double, 2> moduli = {};
  for (std::size_t j = 0; j < plate.rates.size(); ++j) {
    const double x = plate.family.offset[j][0], y = plate.family.offset[j][1], r = plate.family.length[j];
    moduli[0] += 0.5 * plate.rates[j] * x * x * x * x / (r * r);
    moduli[1] += 0.5 * plate.rates[j] * x * x * y * y / (r * r);
  }
  return moduli;
}

template Lattice<1> original_lattice<1>(int);
template Lattice<2> original_lattice<2>(int);
template Lattice<1> modified_lattice<1>(int, const std::vector<double>&);
template Lattice<2> modified_lattice<2>(int, const std::vector<double>&);
template Model periodic_model<1>(int, const std::vector<double>&, int);
template Model periodic_model<2>(int, const std::vector<double>&, int);

}  // namespace perimode::studies
