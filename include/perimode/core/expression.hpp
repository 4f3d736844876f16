// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "perimode/core/error.hpp"

namespace perimode {

/// A number as a formula of place and time, "0.02*exp(-100*(x-0.5)^2)": the variables x, y, z (m) and t (s),
/// the constants pi and e, the operators + - * / ^, comparisons, ?: and the functions of muParser
/// (sin, cos, tan, asin, ..., exp, ln, log10, sqrt, abs, min, max, ...). Copies share nothing that changes.
class Expression {
 public:
  /// Throws invalid_input (what muParser says of it, and where in the text) for a text that does not parse.
  explicit Expression(std::string text, const Where& where = {});
  ~Expression();
  Expression(const Expression& other);
  Expression& operator=(const Expression& other);
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;

  /// Its value at a place and time. Throws invalid_input where the value is no finite number. Not for two
  /// threads at a time.
  [[nodiscard]] double operator()(double x, double y = 0.0, double z = 0.0, double t = 0.0) const;

  [[nodiscard]] const std::string& text() const;
  /// Whether the formula names the variable ('x', 'y', 'z' or 't').
  [[nodiscard]] bool uses(char variable) const;

 private:
  struct Parsed;
  std::unique_ptr<Parsed> parsed_;
};

}  // namespace perimode
