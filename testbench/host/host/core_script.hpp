// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A host and a lever that follow a script. The twin runs each step at once; play() then runs RTL
// and twin on the whole script. Documentation: docs/testing.md
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "../../core/feltgate_core/core_adapter.hpp"
#include "catch.hpp"

namespace feltgate::test {

class CoreScript {
 public:
  using D = Design;
  using C = D::C;
  static constexpr int kLast = D::clocks_per_tick - 1;
  CoreIn in;

  const CoreOut& out() const { return twin_.out(); }
  int clock_of_tick() const { return twin_.clock_of_tick(); }

  void clock() {
    list_.push_back(in);
    twin_.clock(in);
    if (clock_of_tick() == 0) end_of_tick();
  }
  CoreScript& until(int c) {
    do {
      clock();
    } while (clock_of_tick() != c);
    return *this;
  }
  CoreScript& ticks(int n) {
    for (int k = 0; k < n; ++k) until(0);
    return *this;
  }

  /// Puts a write on the port for one clock, whether it is accepted or not.
  void pulse(int address, std::uint32_t data) {
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = data;
    in.reg_write = true;
    clock();
    in.reg_write = false;
  }
  /// Holds a write until it is accepted.
  void hold(int address, std::uint32_t data) {
    while (out().reg_busy) pulse(address, data);
    pulse(address, data);
  }
  /// Each of these waits until its write is done.
  CoreScript& skip_self_test() { return write(D::A::self_test_pulse, 0); }
  CoreScript& write(int address, std::int64_t data) {
    hold(address, static_cast<std::uint32_t>(data & 0xffffffff));
    return until(0);
  }
  CoreScript& command(int bit) { return write(C::command, std::int64_t{1} << bit); }
  static std::uint32_t control_word(int scene, bool arm, std::uint32_t others = 0) {
    return static_cast<std::uint32_t>(D::control_reset) | 1U << C::control_host |
           std::uint32_t{arm} << C::control_arm |
           static_cast<std::uint32_t>(scene) << C::control_scene | others;
  }
  CoreScript& control(int scene, bool arm, std::uint32_t others = 0) {
    return write(C::control, control_word(scene, arm, others));
  }
  std::uint32_t read(int address) {
    in.reg_addr = static_cast<std::uint16_t>(address);
    for (int k = 0; k < 4; ++k) clock();
    return out().reg_rdata;
  }
  /// Of the last whole tick.
  std::uint32_t status() {
    ticks(2);
    return read(C::read_status);
  }

  /// An edge every `spacing` clocks.
  CoreScript& move(int counts, int spacing = 40) {
    for (int k = std::abs(counts); k > 0; --k) {
      count_ += counts > 0 ? 1 : -1;
      const bool a = (count_ & 2) != 0;
      in.encoder = {a, ((count_ & 1) != 0) != a, false};
      for (int c = 0; c < spacing; ++c) clock();
    }
    return *this;
  }
  /// The lever there, armed in the scene, the ramp over.
  CoreScript& arm(int scene, std::uint32_t others = 0) {
    control(scene, false, others).ticks(2);
    control(scene, true, others).ticks(2);
    REQUIRE(out().armed);
    return settle();
  }
  CoreScript& settle() {
    int n = 0;
    while ((out().limits >> Map::L::ramp & 1U) != 0 && n++ < 40'000) until(0);
    return ticks(2);
  }

  /// What the signals did since the last call of this: the largest change from tick to tick.
  struct Steps {
    std::int64_t tau_ref = 0, current = 0, voltage = 0, duty = 0;
  };
  Steps steps() {
    const Steps seen = steps_;
    steps_ = {};
    return seen;
  }
  void play() {
    CoreBench bench("feltgate_core", 1);
    bench.run_list(list_);
  }

 private:
  void end_of_tick() {
    const CoreOut& o = out();
    const auto keep = [](std::int64_t& most, std::int64_t now, std::int64_t before) {
      most = std::max<std::int64_t>(most, std::abs(now - before));
    };
    keep(steps_.tau_ref, o.tau_ref, before_.tau_ref);
    keep(steps_.current, o.current_ref, before_.current_ref);
    keep(steps_.voltage, o.voltage, before_.voltage);
    keep(steps_.duty, o.duty, before_.duty);
    before_ = o;
  }

  CoreTwin twin_;
  std::vector<CoreIn> list_;
  CoreOut before_;
  Steps steps_;
  std::int64_t count_ = 0;
};

}  // namespace feltgate::test
