// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "perimode/boundary/boundary_map.hpp"

namespace perimode {

/// Number of a time function among those of the map; a new one is added.
template <int Dim>
[[nodiscard]] int time_number(BoundaryMap<Dim>& map, const TimeFunction& function) {
  const auto known =
      std::find_if(map.time.begin(), map.time.end(), [&](const auto& f) { return same(f, function); });
  const auto number = static_cast<int>(known - map.time.begin());
  if (known == map.time.end()) map.time.push_back(function);
  return number;
}

/// Sets entry k of a list of `size` time numbers; the list stays empty while all are constant.
inline void set_time(std::vector<int>& list, std::size_t size, std::size_t k, int number) {
  if (list.empty() && number != 0) list.assign(size, 0);
  if (!list.empty()) list[k] = number;
}

}  // namespace perimode
