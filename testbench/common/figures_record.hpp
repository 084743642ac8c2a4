// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Figures that a test measures: testbench/campaigns/figures/TEST.md has them, or FELTGATE_WRITE_FIGURES=1
// writes them there. Documentation: docs/testing.md
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "catch.hpp"

namespace feltgate::test {

inline void check_figures(const std::string& test, const std::string& figures) {
  const std::string path = FELTGATE_SOURCE_DIR "/testbench/campaigns/figures/" + test + ".md";
  if (std::getenv("FELTGATE_WRITE_FIGURES") != nullptr) std::ofstream(path) << figures;
  std::stringstream read;
  read << std::ifstream(path).rdbuf();
  INFO("stale; FELTGATE_WRITE_FIGURES=1 writes " << path << ". It is:\n" << figures);
  CHECK(read.str() == figures);
}

}  // namespace feltgate::test
