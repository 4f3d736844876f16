// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace perimode {

/// A place in an input file; line and column count from 1, 0 = unknown.
struct Where {
  std::string file;
  int line = 0;
  int column = 0;

  /// "file:line:column", "file" without a line, "" when nothing is known.
  [[nodiscard]] std::string text() const;
};

enum class ErrorKind {
  invalid_input,   ///< the user's input is wrong: exit code 2
  environment,     ///< memory, disk, a missing library: exit code 3
  solver_failure,  ///< a solver broke down (not: did not converge, which is a status)
};

/// What a message must say. Each part is a phrase without a full stop.
struct Complaint {
  std::string expected;  ///< "body.horizon.ratio > 0"
  std::string got;       ///< "-3"
  std::string remedy;    ///< "give the horizon in spacings, for example 3"
  Where where = {};
};

/// Every error this library throws. what() is one line:
/// "file:line:column: expected E, got G; R".
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const Complaint& complaint);
  Error(ErrorKind kind, const std::string& message);

  [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }
  [[nodiscard]] const Where& where() const noexcept { return where_; }

 private:
  friend Error at(const Error& error, const Where& where);

  ErrorKind kind_;
  Where where_;
};

/// The same error with a place, if it has none yet: for callers that know where the input came from.
[[nodiscard]] Error at(const Error& error, const Where& where);

/// Throws Error(invalid_input).
[[noreturn]] void invalid_input(const Complaint& complaint);

}  // namespace perimode
