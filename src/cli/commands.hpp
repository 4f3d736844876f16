// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "console.hpp"
#include "perimode/io/case.hpp"

namespace perimode::cli {

/// What the user said on the command line, besides the command.
struct Arguments {
  std::filesystem::path case_file;
  std::vector<std::string> set;                      ///< key=value
  std::optional<std::filesystem::path> output;       ///< instead of output.directory
  bool force = false;                                ///< replace an earlier result
  bool resume = false;                               ///< go on from the last checkpoint
  bool matrices = false;                             ///< also write K.mtx and M.mtx
  std::optional<int> crack_growth;                   ///< modal: steps in which the pre-cracks grow
  std::string command_line;                          ///< as typed, to be shown
  std::optional<std::filesystem::path> template_to;  ///< `new`: a file instead of standard output
};

/// run(std::integral_constant<int, Dim>) with the Dim of a case's body.
template <class Run>
int with_dimension(int dimension, Run&& run) {
  switch (dimension) {
    case 1:
      return run(std::integral_constant<int, 1>());
    case 2:
      return run(std::integral_constant<int, 2>());
    default:
      return run(std::integral_constant<int, 3>());
  }
}

/// Each returns the program's exit code: 0 done, 1 ran but did not reach its goal, 130 interrupted. Bad input
/// and a lacking environment are thrown as Error.
int run_modal(const Arguments& arguments, Console& console);
int run_crack_growth(const Case& input, const Arguments& arguments, Console& console);
int run_static(const Arguments& arguments, Console& console);
int run_transient(const Arguments& arguments, Console& console);
int run_quasistatic(const Arguments& arguments, Console& console);
int run_dispersion(const Arguments& arguments, Console& console);
int run_check(const Arguments& arguments, Console& console);
int run_new_modal(const Arguments& arguments, Console& console);
int run_new_static(const Arguments& arguments, Console& console);
int run_new_transient(const Arguments& arguments, Console& console);
int run_new_quasistatic(const Arguments& arguments, Console& console);
int run_new_dispersion(const Arguments& arguments, Console& console);

}  // namespace perimode::cli
