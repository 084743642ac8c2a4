// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Every extreme as a named test: the expected result holds in RTL, twin and double, and
// table.md has the same values. Documentation: docs/extremes.md
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "campaigns/extremes/table.hpp"
#include "catch.hpp"

namespace {

using namespace feltgate::extremes;

std::set<std::string>& tested() {
  static std::set<std::string> names;
  return names;
}

struct Name {
  explicit Name(const char* name) { tested().insert(name); }
};

std::string committed_page() {
  std::ifstream in(std::string(FELTGATE_ROOT) + "/testbench/campaigns/extremes/table.md");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void check(const std::string& name) {
  Settings settings;
  settings.root = FELTGATE_ROOT;
  for (const Case& c : cases()) {
    if (name != c.name) continue;
    const Result r{c, c.run(settings)};
    CAPTURE(r.outcome.first_mismatch);
    CHECK(r.outcome.mismatches == 0);
    CHECK_FALSE(r.outcome.findings.empty());
    for (const Finding& f : r.outcome.findings) {
      CAPTURE(f.what, f.expected.text, f.rtl.value_or(0), f.twin.value_or(0), f.real.value_or(0));
      CHECK(f.holds());
    }
    for (const std::string& row : stale_rows(committed_page(), r)) {
      FAIL_CHECK("testbench/campaigns/extremes/table.md is stale: " << row << "; run feltgate extremes --markdown");
    }
    return;
  }
  FAIL("there is no case " << name);
}

}  // namespace

#define EXTREME(name)                        \
  static const Name name##_is_tested(#name); \
  TEST_CASE("extreme: " #name, "[" #name "]") { check(#name); }

EXTREME(decoder_limit)
EXTREME(decoder_beyond)
EXTREME(decoder_aliasing)
EXTREME(filter_limit)
EXTREME(wrap_16)
EXTREME(wrap_32)
EXTREME(one_count_per_second)
EXTREME(dither_on_one_edge)
EXTREME(speed_613_6)
EXTREME(speed_795)
EXTREME(dead_bands)
EXTREME(dyadic_trap)
EXTREME(slow_pole)
EXTREME(coefficient_zero)
EXTREME(coefficient_max)
EXTREME(coefficient_bits)
EXTREME(windup_1_ms)
EXTREME(windup_1_s)
EXTREME(windup_60_s)
EXTREME(windup_trip)
EXTREME(rest)
EXTREME(charge_through_zero)
EXTREME(charge_limit_cycle)
EXTREME(stall_pole)
EXTREME(inertia_ratio)
EXTREME(lever_inertia)
EXTREME(border_015)
EXTREME(lever_monotone)
EXTREME(wall_edge)
EXTREME(clock_of_the_simulator)
EXTREME(two_minutes)
EXTREME(law_table_ends)
EXTREME(law_age)
EXTREME(law_events_full)
EXTREME(law_program_512)
EXTREME(law_threads_at_once)
EXTREME(linkage_singular)
EXTREME(gimbal_lock)
EXTREME(plane_lost)

TEST_CASE("every short case is tested, and the page has no other", "[list]") {
  std::set<std::string> names;
  for (const Case& c : cases()) {
    CHECK(names.insert(c.name).second);
    if (!c.long_only) CHECK(tested().count(c.name) == 1);
  }
  std::istringstream page(committed_page());
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("### ", 0) == 0) CHECK(names.count(line.substr(4)) == 1);
  }
}

TEST_CASE("a changed number in the page is seen", "[list]") {
  Outcome o;
  o.findings.push_back({"velocity", "rad/s", near(2.0, 0.1), 2.05, 2.05, 2.0});
  Result r{{"g", "c", "about", false, nullptr}, o};
  const std::string page = markdown(r);
  CHECK(stale_rows(page, r).empty());
  r.outcome.findings[0].twin = 2.06;  // within a percent
  CHECK(stale_rows(page, r).empty());
  r.outcome.findings[0].twin = 2.08;
  CHECK(stale_rows(page, r).size() == 1);
  r.outcome.findings[0].chaotic = true;
  CHECK(stale_rows(page, r).empty());
  r.outcome.findings[0].expected = near(2.1, 0.1);
  CHECK(stale_rows(page, r).size() == 1);
  CHECK(stale_rows("", r).size() == 1);
}

TEST_CASE("a finding outside its bounds, without value, or with a mismatch does not hold",
          "[list]") {
  Finding f{"x", "", near(1.0, 0.1), 1.0, 1.0, 1.0};
  CHECK(f.holds());
  f.rtl = 1.2;
  CHECK_FALSE(f.holds());
  f.rtl.reset();
  f.real = 3.0;
  CHECK_FALSE(f.holds());
  f.real_may_differ = true;
  CHECK(f.holds());
  f.twin.reset();
  f.real.reset();
  CHECK_FALSE(f.holds());
  Outcome o;
  CHECK_FALSE(o.holds());
  o.findings.push_back({"x", "", exactly(1), 1.0, 1.0, {}});
  CHECK(o.holds());
  o.mismatches = 1;
  CHECK_FALSE(o.holds());
}
