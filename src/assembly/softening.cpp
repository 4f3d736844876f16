// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "perimode/assembly/body.hpp"

namespace perimode {

template <int Dim>
bool softening(const Body<Dim>& body) {
  const auto below_zero = [](double c) { return c < 0.0; };
  const BondConstants& constants = body.constants;
  return std::any_of(constants.kernel.begin(), constants.kernel.end(), below_zero) ||
         std::any_of(constants.kernel_of_end.begin(), constants.kernel_of_end.end(), below_zero);
}

template bool softening<1>(const Body<1>&);
template bool softening<2>(const Body<2>&);
template bool softening<3>(const Body<3>&);

}  // namespace perimode
