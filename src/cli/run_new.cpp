// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <fstream>
#include <string_view>

#include "commands.hpp"
#include "perimode/core/error.hpp"
#include "perimode/io/case_template.hpp"

namespace perimode::cli {

namespace {

int write_template(std::string_view text, const char* command, const Arguments& arguments, Console& console) {
  if (!arguments.template_to) {
    fmt::print("{}", text);
    return 0;
  }
  const auto& file = *arguments.template_to;
  if (std::filesystem::exists(file) && !arguments.force) {
    invalid_input(
        {"a file that does not exist yet", file.string(), "use --force to replace it, or another name", {}});
  }
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) {
    throw Error(ErrorKind::environment,
                Complaint{"a file that can be written", file.string(), "choose another folder", {}});
  }
  console.info(fmt::format("wrote {0}; run it with: perimode {1} {0}", file.string(), command));
  return 0;
}

}  // namespace

int run_new_modal(const Arguments& arguments, Console& console) {
  return write_template(modal_template(), "modal", arguments, console);
}

int run_new_static(const Arguments& arguments, Console& console) {
  return write_template(static_template(), "static", arguments, console);
}

int run_new_transient(const Arguments& arguments, Console& console) {
  return write_template(transient_template(), "transient", arguments, console);
}

int run_new_quasistatic(const Arguments& arguments, Console& console) {
  return write_template(quasistatic_template(), "quasistatic", arguments, console);
}

int run_new_dispersion(const Arguments& arguments, Console& console) {
  return write_template(dispersion_template(), "dispersion", arguments, console);
}

}  // namespace perimode::cli
