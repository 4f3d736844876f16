// SPDX-License-Identifier: BSD-3-Clause
#include "io/exodus_fields.hpp"

#include <exodusII.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace perimode {
namespace {

/// Extent of the particles' places along the longest axis, m.
template <int Dim>
double extent(const Particles<Dim>& particles) {
  Point<Dim> lower = particles.position[0];
  Point<Dim> upper = lower;
  for (const Point<Dim>& point : particles.position) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  return (upper - lower).maxCoeff();
}

}  // namespace

ExodusFields::ExodusFields(const std::filesystem::path& file, Role role, Where where)
    : file_(file), role_(std::move(role)), where_(std::move(where)) {
  ex_opts(EX_DEFAULT);  // report errors by code, print nothing
  int word = sizeof(double);
  int stored = 0;
  float version = 0.0F;
  id_ = ex_open(file_.c_str(), EX_READ, &word, &stored, &version);
  check(id_);
}

ExodusFields::~ExodusFields() {
  if (id_ >= 0) (void)ex_close(id_);
}

std::int64_t ExodusFields::steps() const {
  return std::max<std::int64_t>(ex_inquire_int(id_, EX_INQ_TIME), 0);
}

std::vector<double> ExodusFields::times() const {
  std::vector<double> result(static_cast<std::size_t>(steps()));
  if (!result.empty()) check(ex_get_all_times(id_, result.data()));
  return result;
}

std::vector<int> ExodusFields::displacements(int dimension) const {
  std::vector<int> numbers;
  numbers.reserve(static_cast<std::size_t>(dimension));
  for (int a = 0; a < dimension; ++a) numbers.push_back(number_of(std::string("displacement_") + "xyz"[a]));
  return numbers;
}

void ExodusFields::values(int variable, int step, std::vector<double>& result) const {
  check(
      ex_get_var(id_, step, EX_NODAL, variable, 1, static_cast<std::int64_t>(result.size()), result.data()));
}

template <int Dim>
void ExodusFields::require(const Particles<Dim>& particles) const {
  const auto other = [&](const std::string& expected, const std::string& got) {
    invalid_input({expected, got, role_.same_body, where_});
  };
  ex_init_params init = {};
  check(ex_get_init_ext(id_, &init));
  if (init.num_dim != 3) complain("particles in x, y and z", fmt::format("{} axes", init.num_dim));
  const std::int64_t n = init.num_nodes;
  if (n != particles.count())
    other(fmt::format("{} of the {} particles of this body", role_.what, particles.count()),
          fmt::format("{} particles in {}", n, name()));
  if (n == 0) return;
  std::array<std::vector<double>, 3> place;
  for (auto& component : place) component.assign(static_cast<std::size_t>(n), 0.0);
  check(ex_get_coord(id_, place[0].data(), place[1].data(), place[2].data()));
  const double close = 1e-9 * extent(particles);
  for (std::size_t i = 0; i < particles.position.size(); ++i) {
    for (int a = 0; a < Dim; ++a) {
      const double x = place[static_cast<std::size_t>(a)][i];
      if (std::abs(x - particles.position[i][a]) <= close) continue;
      other(fmt::format("{} of this body, whose particle {} has {} = {:.17g} m", role_.what, i + 1, "xyz"[a],
                        particles.position[i][a]),
            fmt::format("{:.17g} m in {}", x, name()));
    }
  }
}

int ExodusFields::number_of(const std::string& variable) const {
  int count = 0;
  check(ex_get_variable_param(id_, EX_NODAL, &count));
  check(ex_set_max_name_length(id_, longest_name));
  std::array<char, longest_name + 1> text = {};
  for (int k = 1; k <= count; ++k) {
    check(ex_get_variable_name(id_, EX_NODAL, k, text.data()));
    if (variable == text.data()) return k;
  }
  complain(fmt::format("{} in {}", role_.variables, name()), fmt::format("no variable {}", variable));
}

void ExodusFields::complain(const std::string& expected, const std::string& got) const {
  invalid_input({expected, got, role_.remedy, where_});
}

void ExodusFields::check(int code) const {
  if (code >= 0) return;
  complain(fmt::format("an Exodus file that can be read ({})", name()), fmt::format("error {}", code));
}

template void ExodusFields::require<1>(const Particles<1>&) const;
template void ExodusFields::require<2>(const Particles<2>&) const;
template void ExodusFields::require<3>(const Particles<3>&) const;

}  // namespace perimode
