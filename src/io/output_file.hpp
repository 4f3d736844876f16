// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>

namespace perimode {

/// A file being written through a buffer. Errors (full disk, permissions) throw Error(environment); close()
/// must be called to learn of the last ones.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& file);
  /// Goes on with a file that is there, after its first `bytes`; the rest is cut off. Throws invalid_input
  /// for a shorter one.
  OutputFile(const std::filesystem::path& file, std::int64_t bytes);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// To append to; call flush_if_full() now and then.
  [[nodiscard]] fmt::memory_buffer& buffer() { return buffer_; }
  void flush_if_full() {
    if (buffer_.size() >= full) flush();
  }
  /// What the buffer holds, then these bytes, past the buffer.
  void write(std::span<const char> bytes);
  /// Hands all to the system: other programs see it.
  void show();
  /// All of it on the disk.
  void sync();
  /// Written so far, the buffer included.
  [[nodiscard]] std::int64_t bytes() const { return bytes_ + static_cast<std::int64_t>(buffer_.size()); }
  void close();

 private:
  static constexpr std::size_t full = 1U << 20U;

  void flush();
  [[noreturn]] void fail(const char* doing) const;

  std::filesystem::path file_;
  std::FILE* stream_;
  std::int64_t bytes_ = 0;
  fmt::memory_buffer buffer_;
};

/// What was written to a file, on the disk. Throws Error(environment).
void sync_file(const std::filesystem::path& file);

/// Makes the names in a folder last: renamed and new files survive a power cut. Throws Error(environment).
void sync_folder(const std::filesystem::path& folder);

}  // namespace perimode
