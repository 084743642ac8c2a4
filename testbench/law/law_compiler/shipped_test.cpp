// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Every shipped law is proven, small and fast, and its runs stay within the bound.
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>

#include "law/measure.hpp"

namespace feltgate::law {
namespace {

Compiled shipped(const std::string& name) {
  return compile_file(std::string(FELTGATE_ROOT) + "/rtl/laws/" + name + ".law", Target{});
}

void require_within(const Compiled& c, const Measured& m) {
  for (std::size_t o = 0; o < m.output.size(); ++o) {
    INFO(c.law.name << " output " << o << ": measured " << m.output[o] << ", bound "
                    << c.bound.output[o]);
    // The law itself runs in double.
    REQUIRE(m.output[o] <= c.bound.output[o] * (1 + 1e-9) + 1e-8);
  }
  // Only few runs may be in strips, which the bound does not cover.
  REQUIRE(m.in_strips * 20 <= m.runs);
}

struct Goal {
  int instructions;
  double rate_hz;
};

TEST_CASE("shipped laws are proven, fit their rate and stay within their bounds") {
  const std::map<std::string, Goal> goals = {
      {"detent", {4, 1e6}},  {"wall", {6, 1e6}},          {"spring", {6, 1e6}},
      {"damper", {6, 1e6}},  {"ceiling", {6, 1e6}},       {"membrane", {8, 5e5}},
      {"charge", {14, 5e5}}, {"quaternion", {27, 2.5e5}}, {"pantograph", {33, 2.5e5}}};
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(FELTGATE_ROOT) + "/rtl/laws")) {
    if (entry.path().extension() != ".law") continue;
    const std::string name = entry.path().stem().string();
    INFO(name);
    const Compiled c = shipped(name);
    CHECK(c.bound.unproven.empty());
    const auto goal = goals.find(name);
    if (goal != goals.end()) {
      CHECK(static_cast<int>(c.assembled.instructions.size()) <= goal->second.instructions);
      CHECK(c.rate_hz >= goal->second.rate_hz);
    }
    require_within(c, measure(c, 1, 20000));
    if (c.bound.states_bounded) require_within(c, measure(c, 2, 20000, true));
  }
}

TEST_CASE("what the page says of the strips of shipped laws") {
  for (const char* name : {"wall", "membrane", "charge", "charge_far"}) {
    INFO(name);
    const Compiled c = shipped(name);
    CHECK(c.bound.strips.empty());
    CHECK_FALSE(c.bound.sharp.empty());
  }
  for (const auto& [name, width] :
       std::map<std::string, double>{{"quaternion", 1.95e-6}, {"gimbal", 4.45e-4}}) {
    INFO(name);
    const Compiled c = shipped(name);
    REQUIRE_FALSE(c.bound.strips.empty());
    for (const Strip& s : c.bound.strips) CHECK(s.width < width);
  }
  CHECK(shipped("detent").bound.sharp.empty());
}

TEST_CASE("the bounds of laws with tables are near what was seen") {
  for (const auto& [name, most] :
       std::map<std::string, double>{{"charge", 0.27e-3}, {"charge_far", 0.27e-3}}) {
    INFO(name);
    CHECK(shipped(name).bound.output[0] < most);
  }
}

TEST_CASE("a law of one input and no state is run over all of its positions") {
  const Compiled c = shipped("detent");
  const Measured m = measure_all(c);
  CHECK(m.all_inputs);
  CHECK(m.runs == 262145);
  require_within(c, m);
  // One LSB of torque, as docs/laws.md promises.
  CHECK(m.output[0] <= std::ldexp(1.0, -16));
  CHECK_FALSE(measure_all(shipped("damper")).all_inputs);
}

}  // namespace
}  // namespace feltgate::law
