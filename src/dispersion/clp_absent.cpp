// SPDX-License-Identifier: BSD-3-Clause
#include "dispersion/linear_programme.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

LinearOptimum solve_linear_programme(const LinearProgramme& /*programme*/) {
  throw Error(ErrorKind::environment,
              "the norm l1 needs the linear programmes of Clp, which is not in this library; configure with "
              "-DPERIMODE_WITH_CLP=ON, or take the norm l2");
}

}  // namespace perimode
