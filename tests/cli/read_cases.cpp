// SPDX-License-Identifier: BSD-3-Clause
// Reads one case per line of the standard input (JSON in a line) as if it lay in the folder given, and
// answers each with a line: "ok", or what is wrong with it.
#include <filesystem>
#include <iostream>
#include <string>

#include "perimode/core/error.hpp"
#include "perimode/io/case.hpp"

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".";
  for (std::string text; std::getline(std::cin, text);) {
    try {
      (void)perimode::read_case_text(text, folder / "case.json");
      std::cout << "ok\n";
    } catch (const perimode::Error& error) {
      std::cout << error.what() << '\n';
    }
  }
}
