// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ports of the Verilated registers, a host that follows a script, and a random host.
// Documentation: docs/architecture.md
#pragma once

#include <Vregisters.h>

#include "../sequencer/sequencer_twin.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/registers.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

namespace feltgate::test {

using Twin = Registers<Lever, READ_BACK != 0>;
using Clock = Sequencer<Lever::clocks_per_tick>;
constexpr std::uint16_t kControl = Lever::C::control;
constexpr std::uint16_t kCommand = Lever::C::command;

struct RegistersAdapter {
  static void drive(Vregisters& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, tick, reg_addr, reg_wdata, reg_write, armed, polarity_holds, set_zero,
                   slot_fetch, scene_slot_fetch, scene, region_high, at_least_full, at_least_hold,
                   at_least_test, derated, testing, snap_slot, snap_valid, snap_data);
  }
  template <class Check>
  static void compare(Check& check, const Vregisters& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, reg_rdata, reg_busy, param, word_error, control, set_zero,
                     clear_faults, kick, disarm, stop, restart, refused, saturated);
  }
};
using RegistersBench = LockStep<Vregisters, Twin, RegistersAdapter>;

/// The word that slot `slot` of tick number `tick` carries in these tests: its own label.
constexpr std::uint32_t label(std::uint32_t tick, int slot) {
  return tick * 64 + static_cast<std::uint32_t>(slot);
}

/// Inputs as the sequencer gives them; in wave clock t the snapshot takes a labelled word.
inline Twin::In inputs_of(const Clock::Out& now) {
  Twin::In in;
  in.tick = now.tick;
  in.slot_fetch = static_cast<std::uint8_t>(now.slot_fetch);
  in.scene_slot_fetch = now.scene_slot_fetch;
  const auto fetched = [&now](int t) { return now.slot_fetch == Map::first_wave_clock + t; };
  in.at_least_full = fetched(Map::T::least_full);
  in.at_least_hold = fetched(Map::T::least_hold);
  in.at_least_test = fetched(Map::T::least_test);
  if (now.slot_fetch >= 2 && now.slot_fetch < 49) {
    in.snap_slot = static_cast<std::uint8_t>(now.slot_fetch - 2);
    in.snap_valid = true;
    in.snap_data = label(now.tick_count, in.snap_slot);
  }
  return in;
}

/// A host with a script. Runs the twin as it goes and keeps the inputs for the lock-step run.
class Script {
 public:
  std::uint8_t scene = 0;
  bool region_high = false, testing = false, armed = false, set_zero = false, derated = false;
  bool polarity_holds = false;
  std::uint16_t address = 0;

  Script() { twin_.reset(); }

  const Twin& twin() const { return twin_; }
  const Twin::Out& out() const { return twin_.out(); }
  int clock_of_tick() const { return clock_.clock_of_tick(); }
  std::uint32_t tick() const { return clock_.out().tick_count; }

  /// One clock; returns all outputs in it.
  Twin::Out clock(bool write = false, std::uint32_t data = 0) {
    Twin::In in = inputs_of(clock_.out());
    in.scene = scene;
    in.region_high = region_high;
    in.testing = testing;
    in.armed = armed;
    in.polarity_holds = polarity_holds;
    in.set_zero = set_zero;
    in.derated = derated;
    in.reg_addr = address;
    in.reg_write = write;
    in.reg_wdata = data;
    list_.push_back(in);
    const Twin::Out now = twin_.peek(in);
    twin_.clock(in);
    clock_.clock({});
    return now;
  }
  /// Runs to clock c of this tick, or of the next tick if that clock has passed.
  Script& until(int c) {
    do {
      clock();
    } while (clock_of_tick() != c);
    return *this;
  }
  Script& write(std::uint16_t at, std::uint32_t data) {
    address = at;
    clock(true, data);
    return *this;
  }
  /// Holds a write until it is taken; returns the clocks for which it waited.
  int hold(std::uint16_t at, std::uint32_t data) {
    int waited = 0;
    for (address = at; out().reg_busy; ++waited) clock(true, data);
    clock(true, data);
    return waited;
  }
  std::uint32_t read(std::uint16_t at) {
    address = at;
    for (int k = 0; k < 3; ++k) clock();
    return out().reg_rdata;
  }
  /// The word of slot t as the bus carries it in wave clock t.
  std::uint32_t bus(int t) {
    until(t + 2);
    return out().param;
  }
  /// RTL and twin on all of it.
  void play() {
    RegistersBench bench("registers", 1);
    bench.run_list(list_);
  }

 private:
  Clock clock_;
  Twin twin_;
  std::vector<Twin::In> list_;
};

/// Makes any access at any time.
class RandomHost {
 public:
  RandomHost(std::uint64_t seed, ResetPlan plan) : random_(seed), clock_(seed, plan) {}

  Twin::In operator()(std::int64_t) {
    Twin::In in = inputs_of(clock_.next());
    if (in.tick) {
      in_force_.scene = static_cast<std::uint8_t>(random_.below(16));
      in_force_.region_high = random_.coin();
      in_force_.testing = random_.coin();
      if (random_.one_in(5)) in_force_.armed = random_.coin();
      in_force_.derated = random_.coin();
      in_force_.polarity_holds = random_.coin();
    }
    in.armed = in_force_.armed;
    in.set_zero = random_.one_in(300);
    in.scene = in_force_.scene;
    in.region_high = in_force_.region_high;
    in.derated = in_force_.derated;
    in.polarity_holds = in_force_.polarity_holds;
    in.testing = in_force_.testing;
    // Some writes are held for a while, others last one clock.
    if (!in_force_.reg_write || random_.one_in(in.tick ? 2 : 60)) {
      if (random_.one_in(4)) in_force_.reg_addr = any_address();
      in_force_.reg_write = random_.one_in(20);
      in_force_.reg_wdata = static_cast<std::uint32_t>(random_.bits());
    }
    in.reg_addr = in_force_.reg_addr;
    in.reg_write = in_force_.reg_write;
    in.reg_wdata = in_force_.reg_wdata;
    if (random_.coin()) in_force_.reg_write = false;
    in.snap_data = static_cast<std::uint32_t>(random_.bits());
    return in;
  }

 private:
  std::uint16_t any_address() {
    switch (random_.below(8)) {
      case 0:
      case 1:
        return static_cast<std::uint16_t>(random_.below(0x200));
      case 2:
        return static_cast<std::uint16_t>(random_.below(64));
      case 3:
        return Lever::C::control;
      case 4:
        return Lever::C::command;
      case 5:
      case 6:
        return static_cast<std::uint16_t>(0x300 + random_.below(64));
      default:
        return static_cast<std::uint16_t>(random_.below(0x1000));
    }
  }

  Random random_;
  RunningClock<Lever::clocks_per_tick> clock_;
  Twin::In in_force_;
};

}  // namespace feltgate::test
