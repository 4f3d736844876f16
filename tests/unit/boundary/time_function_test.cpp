// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/boundary/time_function.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace perimode {
namespace {

using Kind = TimeFunction::Kind;

TimeFunction table(std::vector<double> time, std::vector<double> value) {
  TimeFunction f{Kind::table};
  f.time = std::move(time);
  f.value = std::move(value);
  return f;
}

TimeFunction formula(const std::string& text) {
  TimeFunction f{Kind::expression};
  f.formula.emplace(text);
  return f;
}

TEST(TimeFunctionTest, ConstantIsTheDefault) {
  EXPECT_EQ(value_at({}, -1.0), 1.0);
  EXPECT_EQ(value_at({}, 7.0), 1.0);
}

TEST(TimeFunctionTest, RampRisesAndStays) {
  const TimeFunction ramp{Kind::ramp, 4.0};
  EXPECT_EQ(value_at(ramp, 0.0), 0.0);
  EXPECT_EQ(value_at(ramp, 1.0), 0.25);
  EXPECT_EQ(value_at(ramp, 4.0), 1.0);
  EXPECT_EQ(value_at(ramp, 9.0), 1.0);
}

TEST(TimeFunctionTest, StepHoldsAtItsInstant) {
  const TimeFunction step{Kind::step, 3e-4};
  EXPECT_EQ(value_at(step, 0.0), 0.0);
  EXPECT_EQ(value_at(step, 2.99e-4), 0.0);
  EXPECT_EQ(value_at(step, 3e-4), 1.0);
  EXPECT_EQ(value_at(step, 3000 * 1e-7), 1.0);  // a multiple of a step that ends an ulp before or after
  EXPECT_EQ(value_at(step, 1.0), 1.0);
  EXPECT_EQ(value_at({Kind::step, 0.0}, 0.0), 1.0);
}

TEST(TimeFunctionTest, HalfSineIsOneHalfWave) {
  const TimeFunction f{Kind::half_sine, 2.0};
  EXPECT_EQ(value_at(f, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(value_at(f, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(value_at(f, 1.0 / 3.0), 0.5);
  EXPECT_NEAR(value_at(f, 2.0), 0.0, 1e-15);  // sin(pi) in doubles
  EXPECT_EQ(value_at(f, 2.5), 0.0);
  EXPECT_EQ(value_at(f, -0.5), 0.0);
}

TEST(TimeFunctionTest, RickerPeaksAfterAPeriodAndAHalf) {
  const double frequency = 5e4;
  const TimeFunction f{Kind::ricker, frequency};
  const double peak = 1.5 / frequency;
  EXPECT_DOUBLE_EQ(value_at(f, peak), 1.0);
  // Zeros where 2 (pi f s)^2 = 1; 1e-9: the sine of rounding in the argument, squared slope of order one.
  const double zero = 1.0 / (std::sqrt(2.0) * 3.14159265358979323846 * frequency);
  EXPECT_NEAR(value_at(f, peak + zero), 0.0, 1e-9);
  EXPECT_NEAR(value_at(f, peak - zero), 0.0, 1e-9);
  EXPECT_LT(value_at(f, peak + 1.5 * zero), 0.0);
  EXPECT_NEAR(value_at(f, 0.0), 0.0, 1e-7);  // (1 - 2 s^2) exp(-s^2) at s = 1.5 pi: -1e-8
}

TEST(TimeFunctionTest, GaussianHasItsWidth) {
  const TimeFunction f{Kind::gaussian, 3.0, 0.5};
  EXPECT_EQ(value_at(f, 3.0), 1.0);
  EXPECT_DOUBLE_EQ(value_at(f, 3.5), std::exp(-1.0));
  EXPECT_DOUBLE_EQ(value_at(f, 2.0), std::exp(-4.0));
}

TEST(TimeFunctionTest, TableJoinsItsPoints) {
  const TimeFunction f = table({1.0, 2.0, 4.0}, {10.0, 20.0, -20.0});
  EXPECT_EQ(value_at(f, 0.0), 10.0);
  EXPECT_EQ(value_at(f, 1.0), 10.0);
  EXPECT_EQ(value_at(f, 1.5), 15.0);
  EXPECT_EQ(value_at(f, 2.0), 20.0);
  EXPECT_EQ(value_at(f, 3.0), 0.0);
  EXPECT_EQ(value_at(f, 9.0), -20.0);
  EXPECT_EQ(value_at(table({5.0}, {3.0}), 0.0), 3.0);
}

TEST(TimeFunctionTest, FormulaOfTime) {
  EXPECT_EQ(value_at(formula("t^2"), 3.0), 9.0);
  EXPECT_THROW((void)value_at(formula("1/t"), 0.0), Error);
}

TEST(TimeFunctionTest, SameMeansTheSameNumbers) {
  EXPECT_TRUE(same({}, {}));
  EXPECT_TRUE(same({Kind::ramp, 1.0}, {Kind::ramp, 1.0}));
  EXPECT_FALSE(same({Kind::ramp, 1.0}, {Kind::ramp, 2.0}));
  EXPECT_FALSE(same({Kind::ramp, 1.0}, {Kind::step, 1.0}));
  EXPECT_FALSE(same({Kind::gaussian, 1.0, 1.0}, {Kind::gaussian, 1.0, 2.0}));
  EXPECT_TRUE(same(table({0, 1}, {1, 2}), table({0, 1}, {1, 2})));
  EXPECT_FALSE(same(table({0, 1}, {1, 2}), table({0, 1}, {1, 3})));
  EXPECT_TRUE(same(formula("t"), formula("t")));
  EXPECT_FALSE(same(formula("t"), formula("2*t")));
}

}  // namespace
}  // namespace perimode
