// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <fstream>

#include "commands.hpp"
#include "perimode/core/error.hpp"
#include "perimode/io/case_template.hpp"

namespace perimode::cli {

int run_new_modal(const Arguments& arguments, Console& console) {
  if (!arguments.template_to) {
    fmt::print("{}", modal_template());
    return 0;
  }
  const auto& file = *arguments.template_to;
  if (std::filesystem::exists(file) && !arguments.force) {
    invalid_input(
        {"a file that does not exist yet", file.string(), "use --force to replace it, or another name", {}});
  }
  std::ofstream out(file);
  out << modal_template();
  out.close();
  if (!out) {
    throw Error(ErrorKind::environment,
                Complaint{"a file that can be written", file.string(), "choose another folder", {}});
  }
  console.info("wrote " + file.string() + "; run it with: perimode modal " + file.string());
  return 0;
}

}  // namespace perimode::cli
