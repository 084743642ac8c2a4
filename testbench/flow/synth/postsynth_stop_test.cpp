// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The stop on the RTL and on the ECP5 netlist that Yosys made of it: in each of 20 phases of a
// clock, gone before the next phase, and with a clock that stands. docs/synthesis.md
#include <Vpair.h>

#include <memory>

#include "catch.hpp"
#include "feltgate/generated/causes.hpp"
#include "pair_ports.hpp"

namespace {

constexpr int kPhases = 20;  // of a clock: it rises before phase 0 and falls before phase 10

class Pair {
 public:
  Pair() : pair_(std::make_unique<Vpair>()) {
    pair_->rst_ni = 1;
    pair_->eval();
    pair_->rst_ni = 0;
    clocks(4);
    pair_->rst_ni = 1;
  }
  void set(const char* name, bool value) {
    feltgate::test::set_input(pair_->in_i, name, value);
    pair_->eval();
    REQUIRE(get(true, "gate_a_lo_o") == get(false, "gate_a_lo_o"));
  }
  unsigned get(bool netlist, const char* name) const {
    using feltgate::test::output_of;
    return static_cast<unsigned>(netlist ? output_of(pair_->netlist_o, name)
                                         : output_of(pair_->rtl_o, name));
  }
  unsigned gates(bool netlist) const {
    return get(netlist, "gate_a_hi_o") | get(netlist, "gate_a_lo_o") << 1 |
           get(netlist, "gate_b_hi_o") << 2 | get(netlist, "gate_b_lo_o") << 3;
  }
  void phase() {
    if (phase_ == 0) pair_->clk_i = 1;
    if (phase_ == kPhases / 2) pair_->clk_i = 0;
    pair_->eval();
    phase_ = (phase_ + 1) % kPhases;
    REQUIRE(gates(true) == gates(false));
    REQUIRE(get(true, "faults_o") == get(false, "faults_o"));
    REQUIRE(get(true, "gates_enable_o") == get(false, "gates_enable_o"));
  }
  void phases(int n) {
    for (int k = 0; k < n; ++k) phase();
  }
  void clocks(int n) { phases(n * kPhases); }

 private:
  std::unique_ptr<Vpair> pair_;
  int phase_ = 0;
};

}  // namespace

TEST_CASE(
    "post-synthesis: a stop closes the gates at once and is a fault, in every phase of a clock") {
  for (int phase = 0; phase < kPhases; ++phase) {
    for (const bool clock_stands : {false, true}) {
      CAPTURE(phase, clock_stands);
      Pair pair;
      pair.clocks(120);
      pair.set("arm_i", true);
      for (int k = 0; k < 400 && pair.gates(true) != 10; ++k) pair.clocks(1);
      REQUIRE(pair.gates(true) == 10);  // both low switches: no torque is asked for
      pair.clocks(3);
      pair.phases(phase);
      pair.set("stop_i", true);
      for (const bool netlist : {false, true}) REQUIRE(pair.gates(netlist) == 0);
      pair.set("stop_i", false);
      for (const bool netlist : {false, true}) REQUIRE(pair.gates(netlist) == 0);
      if (clock_stands) {  // the stop may come and go, the gates stay off
        pair.set("stop_i", true);
        pair.set("stop_i", false);
        for (const bool netlist : {false, true}) REQUIRE(pair.gates(netlist) == 0);
      }
      for (int k = 0; k < 5 * kPhases; ++k) {
        pair.phase();
        REQUIRE(pair.gates(true) == 0);
      }
      REQUIRE(pair.get(true, "faults_o") == 1u << static_cast<unsigned>(feltgate::Fault::stop));
      pair.clocks(200);  // and for good, though the request is still there
      REQUIRE(pair.gates(true) == 0);
    }
  }
}
