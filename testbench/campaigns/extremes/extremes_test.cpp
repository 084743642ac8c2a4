// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Every extreme as a named test: the expected result holds in RTL, twin and double, and
// table.md has the same values. Documentation: docs/extremes.md
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "campaigns/extremes/case.hpp"
#include "catch.hpp"

namespace {

using namespace feltgate::extremes;

std::string committed_page() {
  std::ifstream in(std::string(FELTGATE_ROOT) + "/testbench/campaigns/extremes/table.md");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("an extreme", "[.extreme]") {  // FELTGATE_EXTREME says which
  const char* name = std::getenv("FELTGATE_EXTREME");
  const std::vector<Case> all = cases();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Case& c) {
    return name != nullptr && c.name == std::string(name);
  });
  if (found == all.end()) throw std::invalid_argument("FELTGATE_EXTREME names no case");
  Settings settings;
  settings.root = FELTGATE_ROOT;
  const Result r{*found, found->run(settings)};
  CAPTURE(r.outcome.first_mismatch);
  CHECK(r.outcome.mismatches == 0);
  CHECK_FALSE(r.outcome.findings.empty());
  for (const Finding& f : r.outcome.findings) {
    CAPTURE(f.what, f.expected.text, f.rtl.value_or(0), f.twin.value_or(0), f.real.value_or(0));
    CHECK(f.holds());
  }
  for (const std::string& row : stale_rows(committed_page(), r)) {
    FAIL_CHECK("table.md is stale: " << row << "; run feltgate extremes --markdown");
  }
}

TEST_CASE("the page, whose cases are tested, has every case and no other", "[list]") {
  std::set<std::string> names, told;
  for (const Case& c : cases()) CHECK(names.insert(c.name).second);
  std::istringstream page(committed_page());
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("### ", 0) == 0) told.insert(line.substr(4));
  }
  CHECK(names == told);
}
