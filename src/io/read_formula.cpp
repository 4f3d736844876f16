// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "io/case_sections.hpp"

namespace perimode::case_file {

Expression read_formula(const Cursor& cursor, int dimension) {
  if (cursor.is_number()) {
    return Expression(fmt::format("{:.17g}", cursor.number({"", "0", Sign::any})), cursor.where());
  }
  const std::string text = cursor.text("0.02*exp(-100*(x-0.5)^2)");
  Expression formula(text, cursor.where());
  if (formula.uses('t')) {
    cursor.complain("a formula of the place alone", "take t out; what varies in time has a `time`");
  }
  for (const char axis : std::string_view("xyz").substr(static_cast<std::size_t>(dimension))) {
    if (formula.uses(axis)) {
      cursor.complain(fmt::format("a formula of {}", std::string("x, y, z").substr(0, 3 * dimension - 2)),
                      fmt::format("the body has dimension {}", dimension));
    }
  }
  return formula;
}

std::vector<Expression> read_formulas(const Cursor& cursor, int dimension) {
  const char* examples[] = {"[\"1e-3*sin(pi*x)\"]", "[\"1e-3*sin(pi*x)\", 0]", "[\"1e-3*sin(pi*x)\", 0, 0]"};
  const char* example = examples[dimension - 1];
  if (cursor.node().kind != CaseNode::Kind::sequence ||
      cursor.node().children.size() != static_cast<std::size_t>(dimension)) {
    cursor.complain(dimension == 1 ? std::string("a list of 1 number or formula")
                                   : fmt::format("a list of {} numbers or formulas", dimension),
                    fmt::format("the body has dimension {}: for example {}", dimension, example));
  }
  std::vector<Expression> formulas;
  for (const Cursor& item : cursor.items(example)) formulas.push_back(read_formula(item, dimension));
  return formulas;
}

}  // namespace perimode::case_file
