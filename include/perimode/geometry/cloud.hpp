// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "perimode/geometry/region.hpp"

namespace perimode {

/// Particles of a CSV file, before the dimension is fixed at compile time.
struct CloudData {
  int dimension = 0;
  std::vector<double> position;    ///< dimension numbers per particle, m
  std::vector<double> volume;      ///< m3, the true one (thickness or area included), > 0
  std::vector<std::string> block;  ///< block name per particle, "" = none; empty without that column

  [[nodiscard]] std::size_t count() const { return volume.size(); }
};

/// Reads a CSV file with the header x[,y[,z]],volume[,block], one particle per line. Windows line
/// ends, a byte order mark, blanks around fields and empty lines at the end are accepted.
/// Throws invalid_input with file:line:column: unreadable file, another header (or one of another
/// dimension), wrong number of fields, what is no finite number, volume <= 0, two particles at
/// exactly the same point, no particle. Cost O(n log n).
[[nodiscard]] CloudData read_cloud(const std::filesystem::path& file, int dimension);

/// The same of text at hand; errors name it `file`.
[[nodiscard]] CloudData read_cloud_text(std::string_view text, const std::filesystem::path& file,
                                        int dimension);

}  // namespace perimode
