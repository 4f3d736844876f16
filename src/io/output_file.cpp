// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "perimode/core/error.hpp"

namespace perimode {

namespace {

[[noreturn]] void fail_at(const std::filesystem::path& path, const std::string& doing) {
  const std::string reason = std::generic_category().message(errno);
  throw Error(ErrorKind::environment,
              Complaint{"to " + doing, reason, "check the free space and the permissions", {path.string()}});
}

void sync_path(const std::filesystem::path& path, int flags) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) fail_at(path, "open");
  const int status = fsync(descriptor);
  const int reason = errno;
  (void)::close(descriptor);
  errno = reason;
  if (status != 0 && reason != EINVAL) fail_at(path, "sync");  // EINVAL: nothing there that can be synced
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& file)
    : file_(file), stream_(std::fopen(file.c_str(), "wb")) {
  if (stream_ == nullptr) fail("open");
}

OutputFile::OutputFile(const std::filesystem::path& file, std::int64_t bytes)
    : file_(file), stream_(std::fopen(file.c_str(), "r+b")), bytes_(bytes) {
  if (stream_ == nullptr) fail("open");
  const auto there = static_cast<std::int64_t>(std::filesystem::file_size(file));
  if (there >= bytes && ftruncate(fileno(stream_), bytes) == 0 && std::fseek(stream_, 0, SEEK_END) == 0)
    return;
  (void)std::fclose(stream_);
  if (there >= bytes) fail("cut");
  invalid_input({fmt::format("a file of at least {} bytes, as the checkpoint says", bytes),
                 fmt::format("{} bytes", there),
                 "start anew with --force",
                 {file.string()}});
}

OutputFile::~OutputFile() {
  if (stream_ != nullptr) (void)std::fclose(stream_);
}

void OutputFile::flush() {
  const std::size_t size = buffer_.size();
  if (std::fwrite(buffer_.data(), 1, size, stream_) != size) fail("write");
  bytes_ += static_cast<std::int64_t>(size);
  buffer_.clear();
}

void OutputFile::write(std::span<const char> bytes) {
  flush();
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size()) fail("write");
  bytes_ += static_cast<std::int64_t>(bytes.size());
}

void OutputFile::show() {
  flush();
  if (std::fflush(stream_) != 0) fail("write");
}

void OutputFile::sync() {
  show();
  if (fsync(fileno(stream_)) != 0) fail("write");
}

void OutputFile::close() {
  flush();
  std::FILE* stream = stream_;
  stream_ = nullptr;
  if (std::fclose(stream) != 0) fail("write");
}

void OutputFile::fail(const char* doing) const { fail_at(file_, fmt::format("{} the file", doing)); }

void sync_file(const std::filesystem::path& file) { sync_path(file, O_WRONLY); }

void sync_folder(const std::filesystem::path& folder) { sync_path(folder, O_RDONLY | O_DIRECTORY); }

}  // namespace perimode
