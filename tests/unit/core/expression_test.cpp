// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/core/expression.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace perimode {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string complaint(const std::string& text) {
  try {
    (void)Expression(text, {"case.yaml", 3, 9});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "no error";
}

TEST(ExpressionTest, ArithmeticOfPlaceAndTime) {
  EXPECT_EQ(Expression("1 + 2*3^2 - 8/4")(0.0), 17.0);
  EXPECT_EQ(Expression("x + 10*y + 100*z + 1000*t")(1.0, 2.0, 3.0, 4.0), 4321.0);
  EXPECT_EQ(Expression("-x^2")(3.0), -9.0);  // the power binds more than the sign
  EXPECT_EQ(Expression("2^3^2")(0.0), 512.0);
  EXPECT_EQ(Expression("1.5e-3")(0.0), 1.5e-3);
  EXPECT_EQ(Expression("x < 0.5 ? 1 : -1")(0.4), 1.0);
  EXPECT_EQ(Expression("x < 0.5 ? 1 : -1")(0.5), -1.0);
  EXPECT_EQ(Expression("(x > 0.2) * (x < 0.4)")(0.3), 1.0);
}

TEST(ExpressionTest, FunctionsAndConstantsAreThoseOfTheLanguage) {
  EXPECT_DOUBLE_EQ(Expression("0.02*exp(-100*(x-0.5)^2)")(0.6),
                   0.02 * std::exp(-100.0 * (0.6 - 0.5) * (0.6 - 0.5)));
  EXPECT_DOUBLE_EQ(Expression("sin(pi*x) + cos(pi*x)")(0.25), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(Expression("ln(e) + log10(1000) + sqrt(16) + abs(-2)")(0.0), 10.0);
  EXPECT_DOUBLE_EQ(Expression("min(x, 2) + max(x, 2) + tanh(0)")(5.0), 7.0);
}

TEST(ExpressionTest, KnowsWhichVariablesItNames) {
  const Expression formula("sin(x) + t");
  EXPECT_TRUE(formula.uses('x'));
  EXPECT_TRUE(formula.uses('t'));
  EXPECT_FALSE(formula.uses('y'));
  EXPECT_FALSE(formula.uses('z'));
  EXPECT_EQ(formula.text(), "sin(x) + t");
}

TEST(ExpressionTest, CopiesAreIndependent) {
  Expression original("2*x");
  const Expression copy = original;
  original = Expression("3*x");
  EXPECT_EQ(copy(5.0), 10.0);
  EXPECT_EQ(original(5.0), 15.0);
  const Expression moved = std::move(original);
  EXPECT_EQ(moved(1.0), 3.0);
}

TEST(ExpressionTest, WhatDoesNotParseIsNamedWithItsPlace) {
  EXPECT_THAT(complaint("sin(x"),
              StartsWith("case.yaml:3:9: expected a formula of x, y, z and t, got 'sin(x'"));
  EXPECT_THAT(complaint("2*q"), HasSubstr("q"));
  EXPECT_THAT(complaint("x +"), HasSubstr("a formula"));
  EXPECT_THAT(complaint(""), HasSubstr("a formula"));
  EXPECT_THAT(complaint("5 mm"), HasSubstr("mm"));
  EXPECT_THAT(complaint("sin(x, 2)"), HasSubstr("a formula"));
  EXPECT_THAT(complaint("x ** 2"), HasSubstr("a formula"));
}

TEST(ExpressionTest, ListsAssignmentsAndTextsAreNoFormulas) {
  EXPECT_THAT(complaint("x, 2"), HasSubstr("one value"));
  EXPECT_THAT(complaint("x = 2"), HasSubstr("sets a variable"));
  for (const char* comparison : {"x == 2", "x <= 2", "x >= 2", "x != 2"})
    EXPECT_EQ(complaint(comparison), "no error");
  EXPECT_THAT(complaint("\"a\""), HasSubstr("a formula"));
}

TEST(ExpressionTest, AValueThatIsNoNumberNamesThePoint) {
  const Expression formula("1/(x - 1)", {"case.yaml", 3, 9});  // no complaint at x = 0, nor while it is read
  EXPECT_EQ(formula(3.0), 0.5);
  try {
    (void)formula(1.0, 2.0);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_THAT(error.what(), StartsWith("case.yaml:3:9: expected a formula with finite values"));
    EXPECT_THAT(error.what(), HasSubstr("x = 1, y = 2"));
  }
  EXPECT_NO_THROW(Expression("ln(x)"));  // -inf at the origin, but perhaps no particle is there
  EXPECT_THROW((void)Expression("sqrt(x)")(-1.0), Error);
}

}  // namespace
}  // namespace perimode
