// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/core/error.hpp"
#include "slepc.hpp"

namespace perimode {

EigenResult solve_slepc(const EigenProblem& /*problem*/, const EigenOptions& /*options*/,
                        const Sink& /*sink*/) {
  throw Error(ErrorKind::environment,
              "the solver slepc is not in this library: it was built without SLEPc; configure with "
              "-DPERIMODE_WITH_SLEPC=ON, or take the solver lanczos or arpack");
}

}  // namespace perimode
