// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"

namespace perimode::cli {

/// Nodal variables of fields.exo and their values, in the order they are written.
struct Fields {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;

  void add(std::string name, std::vector<double> value) {
    names.push_back(std::move(name));
    values.push_back(std::move(value));
  }
};

/// The fields a case asks for, of displacements (m) and velocities (m/s) of all particle dofs; without
/// velocities (a body at rest) their field is left out. Cost O(bond ends) for strain, stress and energy.
template <int Dim>
[[nodiscard]] Fields chosen_fields(const Body<Dim>& body, const Eigen::VectorXd& displacement,
                                   const Eigen::VectorXd* velocity, const std::vector<std::string>& chosen);

}  // namespace perimode::cli
