// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The registers of a design's words, and the package that holds them. Documentation:
// docs/designs.md

#include <set>
#include <tuple>

#include "catch.hpp"
#include "design_fixture.hpp"
#include "feltgate/generated/balanced.hpp"
#include "feltgate/generated/exact.hpp"
#include "feltgate/generated/fast.hpp"
#include "feltgate/generated/first_power.hpp"
#include "feltgate/generated/gimbal_current.hpp"
#include "feltgate/generated/gimbal_law.hpp"
#include "feltgate/generated/gimbal_motor.hpp"
#include "feltgate/generated/hall_motor.hpp"
#include "feltgate/generated/knob_law.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/lever_absolute.hpp"
#include "feltgate/generated/lever_current.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "feltgate/generated/lever_observer.hpp"
#include "feltgate/generated/pantograph_law.hpp"
#include "feltgate/generated/paper.hpp"
#include "feltgate/generated/stylus_law.hpp"
#include "feltgate/generated/two_levers_law.hpp"

using namespace feltgate;
using namespace feltgate::design;

namespace {

const ParamsRegister& named(const std::vector<ParamsRegister>& all, const std::string& name) {
  for (const ParamsRegister& r : all) {
    if (r.name == name) return r;
  }
  FAIL("no register " << name);
  return all.front();
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A design as data is the same from its file and from its generated header.
template <class D>
void check_data() {
  INFO(D::name);
  const axis::Design file = as_data(shipped(D::name)), header = axis::Design::of<D>();
  CHECK(file.constants == header.constants);
  REQUIRE(file.words.size() == header.words.size());
  for (std::size_t k = 0; k < file.words.size(); ++k) {
    const axis::Word &a = file.words[k], &b = header.words[k];
    CHECK(std::tie(a.name, a.address, a.bits, a.has_sign, a.fraction, a.reset) ==
          std::tie(b.name, b.address, b.bits, b.has_sign, b.fraction, b.reset));
  }
}

template <class... D>
void check_all() {
  (check_data<D>(), ...);
}

}  // namespace

TEST_CASE("a design is the same data from its file and from its header", "[cfg]") {
  check_all<Balanced, Exact, Fast, FirstPower, GimbalCurrent, GimbalLaw, GimbalMotor, HallMotor,
            KnobLaw, Lever, LeverAbsolute, LeverCurrent, LeverLaw, LeverObserver, PantographLaw,
            Paper, StylusLaw, TwoLeversLaw>();
  const axis::Design lever = as_data(shipped("lever"));
  CHECK(lever["VELOCITY_F"] == 21);
  CHECK(lever["CLOCK_HZ"] == 50000000);
  CHECK(lever.words.front().name == "velocity_a1");
  CHECK(lever.words.front().bits == 17);
}

TEST_CASE("every word has one register that holds each of its values", "[cfg]") {
  for (const char* design : {"lever", "paper", "exact", "gimbal_motor", "stylus_law"}) {
    const Elaborated e = shipped(design);
    const std::vector<ParamsRegister> all = params_registers(e);
    std::set<int> addresses;
    for (const ParamsRegister& r : all) CHECK(addresses.insert(r.address).second);
    for (const Word& w : e.words) {
      const Parameter& p = w.parameter;
      INFO(design << ", " << p.name);
      const std::string name = p.scene.empty() ? p.name : "scene_" + std::to_string(p.slot);
      const ParamsRegister& r = named(all, name);
      CHECK(r.address == (p.scene.empty() ? p.address : 32 * bank_of_any_scene + p.slot));
      CHECK(r.bits >= w.field().width());
      CHECK(w.raw < std::int64_t{1} << (w.field().width() - w.field().sign));
      if (p.scene.empty()) CHECK(r.reset == w.raw);
      if (p.kind == "limit") {
        CHECK(w.field().sign == 0);
        CHECK(w.field().width() == w.format.width() - 1);
      }
    }
  }
}

TEST_CASE("registers of lever", "[cfg]") {
  const std::vector<ParamsRegister> all = params_registers(shipped("lever"));
  const struct {
    const char* name;
    int bits;
    bool is_signed;
  } cases[] = {{"velocity_a1", 17, false}, {"observer_gain", 18, true}, {"overspeed", 31, false},
               {"i2t_budget", 32, false},  {"hold_time", 14, false},    {"torque_limit", 20, false},
               {"scene_1", 26, true},      {"scene_2", 32, false},      {"scene_3", 17, false},
               {"scene_6", 18, false},     {"scene_10", 21, true}};
  for (const auto& c : cases) {
    INFO(c.name);
    CHECK(named(all, c.name).bits == c.bits);
    CHECK(named(all, c.name).is_signed == c.is_signed);
  }
  CHECK(all.size() == 42);
  const std::vector<ParamsRegister> phases = params_registers(shipped("gimbal_motor"));
  CHECK(named(phases, "commutation_gain").bits == 32);
}

TEST_CASE("a time beyond its word is the longest", "[cfg]") {
  const std::string paper = file_text(design_path("paper"));
  const Elaborated e =
      elaborate(design_from_text(replaced(paper, "[supervisor]", "[supervisor]\nhold_s = 1000.0"),
                                 "long.toml"),
                shipped_registers());
  CHECK(e.word("hold_time").raw == 16383);
  CHECK(has(cfg_package(e), "14'd16383"));
}

TEST_CASE("the control word is a struct, so its fields leave no gap", "[cfg]") {
  Elaborated e = shipped("lever");
  CHECK(has(cfg_package(e), "  typedef struct packed {\n    logic [3:0] filter;"));
  e.registers.controls[0].fields[1].bit = 2;
  CHECK_THROWS_WITH(cfg_package(e),
                    Catch::Contains("control.arm begins at bit 2 and 1 comes next"));
}
