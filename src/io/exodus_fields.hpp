// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "perimode/core/error.hpp"
#include "perimode/geometry/particles.hpp"

namespace perimode {

inline constexpr std::size_t longest_name = 255;  ///< of blocks, fields and variables, in letters

/// Results in an Exodus II file, open for reading: particles, times, nodal variables. Everything that does
/// not fit is an invalid_input at `where`.
class ExodusFields {
 public:
  /// What the file is taken for, as its complaints say it.
  struct Role {
    std::string what;       ///< "modes", "a run"
    std::string variables;  ///< "modes", "displacements"
    std::string remedy;     ///< for a file that is something else
    std::string same_body;  ///< for particles that are others
  };

  ExodusFields(const std::filesystem::path& file, Role role, Where where);
  ~ExodusFields();
  ExodusFields(const ExodusFields&) = delete;
  ExodusFields& operator=(const ExodusFields&) = delete;
  ExodusFields(ExodusFields&&) = delete;
  ExodusFields& operator=(ExodusFields&&) = delete;

  [[nodiscard]] std::int64_t steps() const;
  [[nodiscard]] std::vector<double> times() const;
  /// Numbers of the variables displacement_x, ... of `dimension` axes.
  [[nodiscard]] std::vector<int> displacements(int dimension) const;
  /// Values of a nodal variable at a step, from 1.
  void values(int variable, int step, std::vector<double>& result) const;
  /// Throws unless the file's particles are these: number, places to 1e-9 of their extent.
  template <int Dim>
  void require(const Particles<Dim>& particles) const;

  [[noreturn]] void complain(const std::string& expected, const std::string& got) const;
  [[nodiscard]] std::string name() const { return file_.string(); }

 private:
  [[nodiscard]] int number_of(const std::string& variable) const;
  void check(int code) const;

  std::filesystem::path file_;
  Role role_;
  Where where_;
  int id_ = -1;
};

}  // namespace perimode
