// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

namespace perimode {

/// A text file being written through a buffer. Errors (full disk, permissions) throw
/// Error(environment); close() must be called to learn of the last ones.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// To append to; call flush_if_full() now and then.
  [[nodiscard]] fmt::memory_buffer& buffer() { return buffer_; }
  void flush_if_full() {
    if (buffer_.size() >= full) flush();
  }
  void close();

 private:
  static constexpr std::size_t full = 1U << 20U;

  void flush();
  [[noreturn]] void fail(const char* doing) const;

  std::filesystem::path file_;
  std::FILE* stream_;
  fmt::memory_buffer buffer_;
};

}  // namespace perimode
