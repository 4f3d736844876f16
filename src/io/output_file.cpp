// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.hpp"

#include <cerrno>
#include <system_error>

#include "perimode/core/error.hpp"

namespace perimode {

OutputFile::OutputFile(const std::filesystem::path& file)
    : file_(file), stream_(std::fopen(file.c_str(), "wb")) {
  if (stream_ == nullptr) fail("open");
}

OutputFile::~OutputFile() {
  if (stream_ != nullptr) (void)std::fclose(stream_);
}

void OutputFile::flush() {
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), stream_) != buffer_.size()) fail("write");
  buffer_.clear();
}

void OutputFile::close() {
  flush();
  std::FILE* stream = stream_;
  stream_ = nullptr;
  if (std::fclose(stream) != 0) fail("write");
}

void OutputFile::fail(const char* doing) const {
  const std::string reason = std::generic_category().message(errno);
  throw Error(ErrorKind::environment, Complaint{fmt::format("to {} the file", doing),
                                                reason,
                                                "check the free space and the permissions",
                                                {file_.string()}});
}

}  // namespace perimode
