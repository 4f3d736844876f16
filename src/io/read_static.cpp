// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_sections.hpp"

namespace perimode::case_file {

StaticOptions read_static(const Cursor& cursor, const BodyFacts& facts, InputFiles& files) {
  StaticOptions options;
  if (cursor.node().kind == CaseNode::Kind::null) return options;  // `static:` with nothing: all defaults
  const Section section(cursor, {"loads", "solver", "tolerance"});
  if (const auto loads = section.find("loads")) options.loads = read_loads(*loads, facts, files);
  if (const auto solver = section.find("solver")) {
    options.solver = solver->choice<StaticSolver>({{"auto", StaticSolver::automatic},
                                                   {"cholesky", StaticSolver::cholesky},
                                                   {"multigrid", StaticSolver::multigrid},
                                                   {"jacobi", StaticSolver::jacobi},
                                                   {"lu", StaticSolver::lu}});
    if (options.solver == StaticSolver::multigrid && !facts.grid) {
      solver->complain("auto, cholesky, jacobi or lu for a cloud", "multigrid needs a grid");
    }
  }
  if (const auto tolerance = section.find("tolerance")) {
    options.tolerance = tolerance->number({"", "1e-8"});
    if (options.tolerance < 1e-13 || options.tolerance >= 1.0) {
      tolerance->complain("a number >= 1e-13 and < 1", "for example 1e-8");
    }
  }
  return options;
}

}  // namespace perimode::case_file
