// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace perimode {

/// The version of this library, "major.minor.patch".
[[nodiscard]] std::string version();

/// Something this library was built with.
struct Component {
  std::string name;
  std::string version;
};

/// The compiler and the libraries, in a fixed order. Versions are those of the libraries loaded
/// where they can tell at run time (CHOLMOD, OpenBLAS), else those of the headers compiled against.
[[nodiscard]] std::vector<Component> components();

}  // namespace perimode
