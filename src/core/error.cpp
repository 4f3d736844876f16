// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/core/error.hpp"

namespace perimode {

std::string Where::text() const {
  if (line <= 0) return file;
  return file + ":" + std::to_string(line) + ":" + std::to_string(column);
}

namespace {

/// Control bytes of whatever came would cut or split the line; they are shown as \xNN.
std::string printable(const std::string& text) {
  constexpr const char* digits = "0123456789abcdef";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      out += c;
    } else {
      out += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
    }
  }
  return out;
}

std::string one_line(const Complaint& c) {
  std::string place = c.where.text();
  if (!place.empty()) place += ": ";
  std::string message = place + "expected " + c.expected;
  if (!c.got.empty()) message += ", got " + c.got;
  if (!c.remedy.empty()) message += "; " + c.remedy;
  return printable(message);
}

}  // namespace

Error::Error(ErrorKind kind, const Complaint& complaint)
    : std::runtime_error(one_line(complaint)), kind_(kind), where_(complaint.where) {}

Error::Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}

Error at(const Error& error, const Where& where) {
  if (error.where().line > 0 || where.file.empty()) return error;
  Error placed(error.kind(), where.text() + ": " + error.what());
  placed.where_ = where;
  return placed;
}

void invalid_input(const Complaint& complaint) { throw Error(ErrorKind::invalid_input, complaint); }

}  // namespace perimode
