// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/boundary/time_function.hpp"

#include <algorithm>
#include <cmath>

namespace perimode {

namespace {

constexpr double pi = 3.14159265358979323846;

double on_table(const std::vector<double>& time, const std::vector<double>& value, double t) {
  if (t <= time.front()) return value.front();
  if (t >= time.back()) return value.back();
  const auto after = std::upper_bound(time.begin(), time.end(), t) - time.begin();
  const auto k = static_cast<std::size_t>(after - 1);
  const double share = (t - time[k]) / (time[k + 1] - time[k]);
  return value[k] + share * (value[k + 1] - value[k]);
}

}  // namespace

double value_at(const TimeFunction& f, double t) {
  using Kind = TimeFunction::Kind;
  switch (f.kind) {
    case Kind::constant:
      return 1.0;
    case Kind::ramp:
      return std::clamp(t / f.a, 0.0, 1.0);
    case Kind::step:
      return t >= f.a - 1e-9 * std::abs(f.a) ? 1.0 : 0.0;
    case Kind::half_sine:
      return t >= 0.0 && t <= f.a ? std::sin(pi * t / f.a) : 0.0;
    case Kind::ricker: {
      const double s = pi * f.a * (t - 1.5 / f.a);
      return (1.0 - 2.0 * s * s) * std::exp(-s * s);
    }
    case Kind::gaussian: {
      const double s = (t - f.a) / f.b;
      return std::exp(-s * s);
    }
    case Kind::table:
      return on_table(f.time, f.value, t);
    case Kind::expression:
      return (*f.formula)(0.0, 0.0, 0.0, t);
  }
  return 1.0;
}

bool same(const TimeFunction& f, const TimeFunction& g) {
  const auto text = [](const TimeFunction& h) { return h.formula ? h.formula->text() : std::string(); };
  return f.kind == g.kind && f.a == g.a && f.b == g.b && f.time == g.time && f.value == g.value &&
         text(f) == text(g);
}

}  // namespace perimode
