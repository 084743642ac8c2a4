// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Figures of a block's page that a test measures: the page has them, or FELTGATE_WRITE_FIGURES=1
// writes them there, between two marks; the first names the test, by default as the block.
// Documentation: docs/testing.md
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "catch.hpp"

namespace feltgate::test {

inline void check_page_figures(const std::string& block, const std::string& figures,
                               const std::string& test = "") {
  const std::string path = FELTGATE_SOURCE_DIR "/docs/blocks/" + block + ".md";
  const std::string first =
      "<!-- figures: written by the test " + (test.empty() ? block : test) + " -->\n";
  std::stringstream read;
  read << std::ifstream(path).rdbuf();
  std::string page = read.str();
  const std::size_t begin = page.find(first);
  const std::size_t end = page.find("<!-- end of figures -->\n", begin);
  REQUIRE(begin != std::string::npos);
  REQUIRE(end != std::string::npos);
  const std::size_t from = begin + first.size();
  const bool fresh = page.substr(from, end - from) == figures;
  if (!fresh && std::getenv("FELTGATE_WRITE_FIGURES") != nullptr) {
    std::ofstream(path) << page.replace(from, end - from, figures);
  } else {
    INFO("stale; FELTGATE_WRITE_FIGURES=1 writes it. It is:\n" << figures);
    CHECK(fresh);
  }
}

}  // namespace feltgate::test
