// SPDX-License-Identifier: BSD-3-Clause
#include <Clp_C_Interface.h>
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "dispersion/linear_programme.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

LinearOptimum solve_linear_programme(const LinearProgramme& programme) {
  const auto rows = static_cast<int>(programme.matrix.rows());
  const auto columns = static_cast<int>(programme.matrix.cols());
  const std::vector<double> zero(static_cast<std::size_t>(rows), 0.0);
  std::vector<CoinBigIndex> starts = {0};
  std::vector<int> indices;
  std::vector<double> values;
  starts.reserve(static_cast<std::size_t>(columns) + 1);
  indices.reserve(static_cast<std::size_t>(programme.matrix.size()));
  values.reserve(static_cast<std::size_t>(programme.matrix.size()));
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      if (programme.matrix(row, column) == 0.0) continue;
      indices.push_back(row);
      values.push_back(programme.matrix(row, column));
    }
    starts.push_back(static_cast<CoinBigIndex>(values.size()));
  }
  const std::unique_ptr<Clp_Simplex, void (*)(Clp_Simplex*)> model(Clp_newModel(), Clp_deleteModel);
  Clp_setLogLevel(model.get(), 0);
  Clp_loadProblem(model.get(), columns, rows, starts.data(), indices.data(), values.data(),
                  programme.lower.data(), programme.upper.data(), programme.cost.data(), zero.data(),
                  zero.data());
  Clp_setPrimalTolerance(model.get(), 1e-9);
  Clp_setDualTolerance(model.get(), 1e-9);
  Clp_primal(model.get(), 0);
  if (Clp_isProvenOptimal(model.get()) == 0) {
    throw Error(ErrorKind::solver_failure,
                fmt::format("Clp ended without an optimum of a linear programme of {} rows and {} columns "
                            "(status {})",
                            rows, columns, Clp_status(model.get())));
  }
  return {Clp_objectiveValue(model.get()),
          Eigen::Map<const Eigen::VectorXd>(Clp_getRowPrice(model.get()), rows)};
}

}  // namespace perimode
