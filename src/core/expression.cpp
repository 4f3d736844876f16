// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/core/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace perimode {

namespace {

/// muParser would store into x what stands behind "x =".
bool assigns(const std::string& text) {
  for (std::size_t k = text.find('='); k != std::string::npos; k = text.find('=', k + 1)) {
    if (k + 1 < text.size() && text[k + 1] == '=') {
      ++k;
    } else if (k == 0 || std::string_view("<>!").find(text[k - 1]) == std::string_view::npos) {
      return true;
    }
  }
  return false;
}

}  // namespace

struct Expression::Parsed {
  std::string text;
  Where where;
  std::array<double, 4> variable = {};  // x, y, z, t
  mu::Parser parser;

  Parsed(std::string formula, Where place) : text(std::move(formula)), where(std::move(place)) {
    try {
      constexpr std::array<const char*, 4> names = {"x", "y", "z", "t"};
      for (std::size_t k = 0; k < names.size(); ++k) parser.DefineVar(names[k], &variable[k]);
      parser.DefineConst("pi", 3.14159265358979323846);
      parser.DefineConst("e", 2.71828182845904523536);
      parser.SetExpr(text);
      (void)parser.Eval();  // parses; a value that is no number here (1/x at x = 0) may be one elsewhere
    } catch (const mu::Parser::exception_type& error) {
      std::string what = error.GetMsg();
      while (!what.empty() && (what.back() == '.' || what.back() == '\n')) what.pop_back();
      refuse(what);
    }
    if (assigns(text)) refuse("it sets a variable");
    if (parser.GetNumResults() != 1) refuse("it has more than one value");
  }

  [[noreturn]] void refuse(const std::string& reason) const {
    invalid_input({"a formula of x, y, z and t", fmt::format("'{}': {}", text, reason),
                   "write for example 0.02*exp(-100*(x-0.5)^2)", where});
  }
};

Expression::Expression(std::string text, const Where& where)
    : parsed_(std::make_unique<Parsed>(std::move(text), where)) {}
Expression::~Expression() = default;
Expression::Expression(const Expression& other)
    : parsed_(std::make_unique<Parsed>(other.parsed_->text, other.parsed_->where)) {}
Expression& Expression::operator=(const Expression& other) {
  if (this != &other) parsed_ = std::make_unique<Parsed>(other.parsed_->text, other.parsed_->where);
  return *this;
}
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

double Expression::operator()(double x, double y, double z, double t) const {
  parsed_->variable = {x, y, z, t};
  const double value = parsed_->parser.Eval();
  if (!std::isfinite(value)) {
    invalid_input({"a formula with finite values",
                   fmt::format("'{}' = {} at x = {:.6g}, y = {:.6g}, z = {:.6g}, t = {:.6g}", parsed_->text,
                               value, x, y, z, t),
                   "choose one that is defined in the whole body at all times", parsed_->where});
  }
  return value;
}

const std::string& Expression::text() const { return parsed_->text; }

bool Expression::uses(char variable) const {
  return parsed_->parser.GetUsedVar().contains(std::string(1, variable));
}

}  // namespace perimode
