// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Figures that a test measures: its section of testbench/campaigns/figures.md has them, or
// FELTGATE_WRITE_FIGURES=1 writes them there. Documentation: docs/testing.md
#pragma once

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "catch.hpp"

namespace feltgate::test {

inline void check_figures(const std::string& test, const std::string& figures) {
  const std::string path = FELTGATE_SOURCE_DIR "/testbench/campaigns/figures.md";
  std::stringstream read;
  read << std::ifstream(path).rdbuf();
  std::string all = read.str();
  const std::string head = "\n## " + test + "\n\n";
  const std::size_t begin = all.find(head);
  REQUIRE(begin != std::string::npos);
  const std::size_t from = begin + head.size();
  const std::size_t size = std::min(all.find("\n## ", from), all.size()) - from;
  INFO("stale; FELTGATE_WRITE_FIGURES=1 writes " << path << ". It is:\n" << figures);
  if (std::getenv("FELTGATE_WRITE_FIGURES") != nullptr) {
    std::ofstream(path) << all.replace(from, size, figures);
  } else {
    CHECK(all.substr(from, size) == figures);
  }
}

}  // namespace feltgate::test
