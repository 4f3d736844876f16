// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/io/exodus.hpp"

namespace perimode::cli {

/// fields.exo of a run while it lasts, made with its first frame.
class FieldsFile {
 public:
  /// What the file says of itself and holds.
  struct Content {
    std::string title;
    std::string analysis;             ///< "transient"
    std::vector<std::string> fields;  ///< of output.fields
    std::vector<std::string> globals = {};
  };

  /// `frames`: of an earlier part of the run that stand; 0 begins anew.
  FieldsFile(std::filesystem::path file, Content content, std::int64_t frames);

  /// A frame at a time (s, or what stands for it), with the globals' values; `velocity` may be null.
  template <int Dim>
  void add(double time, std::vector<double> globals, const Body<Dim>& body,
           const Eigen::VectorXd& displacement, const Eigen::VectorXd* velocity);
  void sync();
  [[nodiscard]] std::int64_t frames() const { return frames_; }
  void close();

 private:
  std::filesystem::path file_;
  Content content_;
  std::int64_t frames_;
  std::optional<ExodusWriter> writer_;
};

}  // namespace perimode::cli
