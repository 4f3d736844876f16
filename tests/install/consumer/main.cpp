// SPDX-License-Identifier: BSD-3-Clause
// Prints the version of Perimode and of everything it was built with.
#include <iostream>
#include <perimode/core/version.hpp>

int main() {
  std::cout << "perimode " << perimode::version() << '\n';
  for (const perimode::Component& component : perimode::components()) {
    std::cout << component.name << ' ' << component.version << '\n';
  }
}
