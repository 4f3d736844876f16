// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "perimode/modal/modes.hpp"
#include "perimode/reference/closed_form.hpp"
#include "support/models.hpp"

namespace perimode::test {

inline ModalOptions lowest(int modes, ModalSolver solver = ModalSolver::automatic) {
  ModalOptions options;
  options.modes = modes;
  options.solver = solver;
  return options;
}

/// Modes of a model; the run has to converge and to be certified complete.
template <int Dim>
ModalResult certified_modes(const Model& model, const ModalOptions& options) {
  ModalResult result = solve_modes(build_body<Dim>(model), options);
  EXPECT_EQ(result.status, EigenStatus::converged) << result.message;
  EXPECT_TRUE(result.certificate.complete);
  return result;
}

/// Every computed frequency against an expected one of the same rank, zeros exactly.
template <class Expected>
void expect_frequencies(const Eigen::VectorXd& computed, const std::vector<Expected>& expected,
                        double relative) {
  ASSERT_GE(static_cast<Eigen::Index>(expected.size()), computed.size());
  for (Eigen::Index k = 0; k < computed.size(); ++k) {
    const double exact = static_cast<double>(expected[static_cast<std::size_t>(k)]);
    ASSERT_NEAR(computed[k], exact, relative * exact) << "mode " << k + 1 << " of " << computed.size();
  }
}

/// The lowest `count` modes of a body that separates, against its closed form.
template <int Dim>
void expect_closed_form(const Model& model, const ModalOptions& options, double relative) {
  const ModalResult result = certified_modes<Dim>(model, options);
  std::string why_not;
  const auto exact = closed_form_modes(model, *options.modes, why_not);
  ASSERT_TRUE(exact) << why_not;
  std::vector<double> omega;
  for (const ClosedFormMode& mode : *exact) omega.push_back(mode.discrete);
  ASSERT_EQ(result.count(), *options.modes);
  expect_frequencies(result.angular_frequency, omega, relative);
}

}  // namespace perimode::test
