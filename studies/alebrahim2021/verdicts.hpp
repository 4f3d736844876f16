// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lattices.hpp"

namespace perimode::studies {

/// One statement, table or figure of the paper and what came out.
struct Verdict {
  std::string item;
  std::string paper;
  std::string here;
  bool reproduced = false;
  std::string reason;
};

/// Judges what the results hold; also puts verdict/item = 1 or 0 among them.
[[nodiscard]] std::vector<Verdict> judge(const ExpectedResults& paper, Results& results);

}  // namespace perimode::studies
