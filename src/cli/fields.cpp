// SPDX-License-Identifier: BSD-3-Clause
#include "fields.hpp"

#include <utility>

#include "perimode/assembly/fields.hpp"
#include "perimode/io/exodus.hpp"

namespace perimode::cli {

namespace {

void add_vector(Fields& fields, const std::string& name, const Eigen::VectorXd& vector, int dimension) {
  auto components = three_components({vector.data(), static_cast<std::size_t>(vector.size())}, dimension);
  for (std::size_t a = 0; a < 3; ++a) fields.add(name + "_" + "xyz"[a], std::move(components[a]));
}

std::vector<std::string> tensor_suffixes(int dimension) {
  if (dimension == 1) return {"_xx"};
  if (dimension == 2) return {"_xx", "_yy", "_xy"};
  return {"_xx", "_yy", "_zz", "_xy", "_xz", "_yz"};
}

template <int Dim>
void add_tensor(Fields& fields, const std::string& name, const Eigen::MatrixXd& tensor) {
  const auto suffixes = tensor_suffixes(Dim);
  for (std::size_t c = 0; c < suffixes.size(); ++c) {
    const auto row = tensor.row(static_cast<Eigen::Index>(c));
    fields.add(name + suffixes[c], {row.begin(), row.end()});
  }
}

}  // namespace

template <int Dim>
Fields chosen_fields(const Body<Dim>& body, const Eigen::VectorXd& displacement,
                     const Eigen::VectorXd* velocity, const std::vector<std::string>& chosen) {
  Fields fields;
  for (const std::string& name : chosen) {
    if (name == "displacement") {
      add_vector(fields, name, displacement, Dim);
    } else if (name == "velocity") {
      if (velocity != nullptr) add_vector(fields, name, *velocity, Dim);
    } else if (name == "strain") {
      add_tensor<Dim>(fields, name, strain(body, displacement));
    } else if (name == "stress") {
      add_tensor<Dim>(fields, name, stress(body, displacement));
    } else {
      const Eigen::VectorXd values = name == "damage" ? damage(body) : energy_density(body, displacement);
      fields.add(name, {values.begin(), values.end()});
    }
  }
  return fields;
}

template Fields chosen_fields<1>(const Body<1>&, const Eigen::VectorXd&, const Eigen::VectorXd*,
                                 const std::vector<std::string>&);
template Fields chosen_fields<2>(const Body<2>&, const Eigen::VectorXd&, const Eigen::VectorXd*,
                                 const std::vector<std::string>&);
template Fields chosen_fields<3>(const Body<3>&, const Eigen::VectorXd&, const Eigen::VectorXd*,
                                 const std::vector<std::string>&);

}  // namespace perimode::cli
