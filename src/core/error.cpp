// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/core/error.hpp"

namespace perimode {

std::string Where::text() const {
  if (line <= 0) return file;
  return file + ":" + std::to_string(line) + ":" + std::to_string(column);
}

namespace {

std::string one_line(const Complaint& c) {
  std::string place = c.where.text();
  if (!place.empty()) place += ": ";
  std::string message = place + "expected " + c.expected;
  if (!c.got.empty()) message += ", got " + c.got;
  if (!c.remedy.empty()) message += "; " + c.remedy;
  return message;
}

}  // namespace

Error::Error(ErrorKind kind, const Complaint& complaint)
    : std::runtime_error(one_line(complaint)), kind_(kind), where_(complaint.where) {}

Error::Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}

void invalid_input(const Complaint& complaint) { throw Error(ErrorKind::invalid_input, complaint); }

}  // namespace perimode
