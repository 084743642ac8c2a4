// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core with a host, a panel and a lever that a test controls. The twin runs at once; play() then
// runs the RTL beside a twin. Documentation: docs/architecture.md
#pragma once

#include <cmath>
#include <cstdlib>
#include <vector>

#include "catch.hpp"
#include "core_adapter.hpp"

namespace feltgate::test {

using A = Design::A;
using C = Design::C;
constexpr int kTick = Design::clocks_per_tick;

inline constexpr std::uint32_t kHost =
    static_cast<std::uint32_t>(Design::control_reset) | 1u << C::control_host;

inline std::uint32_t word_of_design(int address) {
  for (const auto& p : Design::parameters) {
    if (p.address == address) return static_cast<std::uint32_t>(p.raw);
  }
  return 0;
}

/// Runs the twin and records its inputs; the RTL runs them later beside a twin.
class Life {
 public:
  CoreIn in;

  const CoreOut& out() const { return twin_.out(); }
  int clock_of_tick() const { return twin_.clock_of_tick(); }

  void clocks(std::int64_t n) {
    if (n <= 0) return;
    parts_.push_back({in, n});
    for (; n > 0; --n) {
      twin_.clock(in);
      if (twin_.out().snapshot_valid) shown_ = twin_.out();
    }
  }
  void to_clock(int c) { clocks((c - clock_of_tick() + kTick) % kTick); }
  void ticks(std::int64_t n) {
    to_clock(0);
    clocks(n * kTick);
  }
  /// Writes early in a tick and runs to the end of that tick.
  void write(int address, std::uint32_t word) {
    to_clock(5);
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = word;
    in.reg_write = true;
    clocks(1);
    in.reg_write = false;
    to_clock(0);
  }
  void as_designed(int address) { write(address, word_of_design(address)); }
  void command(int bit) { write(C::command, 1u << bit); }
  /// Arms in this scene and mode, without a self-test and, except for the first step, without a
  /// ramp.
  void arm(int scene, int mode = 0, unsigned filter = 0) {
    std::uint32_t word = kHost & ~(15u << C::control_filter);
    word |= filter << C::control_filter | static_cast<std::uint32_t>(scene) << C::control_scene |
            static_cast<std::uint32_t>(mode) << C::control_mode;
    write(C::control, word);
    write(A::self_test_pulse, 0);
    write(A::ramp_step, 0x7ffffff);
    write(A::voltage_step, (1u << (Design::f.voltage.width() - 1)) - 1);
    command(C::command_clear_faults);
    ticks(2);
    write(C::control, word | 1u << C::control_arm);
    ticks(1);
    REQUIRE(out().armed);
    REQUIRE(out().faults == 0);
  }
  void disarm() { write(C::control, kHost); }
  /// Reads a word at the port; takes four clocks.
  std::uint32_t read(int address) {
    in.reg_addr = static_cast<std::uint16_t>(address);
    clocks(4);
    return out().reg_rdata;
  }
  /// Moves the lever by one count.
  void step(bool up) {
    phase_ += up ? 1u : 3u;
    const bool a = (phase_ & 2u) != 0;
    in.encoder.a = a;
    in.encoder.b = ((phase_ & 1u) != 0) != a;
  }
  void move(std::int64_t counts, std::int64_t spacing) {
    for (std::int64_t k = 0; k < std::llabs(counts); ++k) {
      step(counts > 0);
      clocks(spacing);
    }
  }
  /// The outputs of the last whole tick.
  const CoreOut& shown() const { return shown_; }
  int ticks_to_fall(int limit) {
    int n = 0;
    while (out().gates_enable && n <= limit) ticks(1), ++n;
    return n;
  }
  bool only(Fault cause) const {
    return out().faults == fault_bit(cause) && out().first_fault == static_cast<unsigned>(cause);
  }
  void play() {
    CoreBench bench("feltgate_core", 1);
    std::int64_t total = 0;
    for (const Part& part : parts_) total += part.clocks;
    bench.run(Replay{&parts_, 0, 0}, total + CoreBench::kFirstReset);
  }

 private:
  struct Part {
    CoreIn in;
    std::int64_t clocks;
  };
  struct Replay {
    const std::vector<Part>* parts;
    std::size_t part;
    std::int64_t done;

    CoreIn operator()(std::int64_t cycle) {
      if (cycle < CoreBench::kFirstReset) return {};
      if (done == (*parts)[part].clocks) {
        ++part;
        done = 0;
      }
      ++done;
      return (*parts)[part].in;
    }
  };

  CoreTwin twin_;
  CoreOut shown_;
  std::vector<Part> parts_;
  std::uint32_t phase_ = 0;
};

inline std::uint32_t low(std::int64_t value) { return static_cast<std::uint32_t>(value); }

/// A host's write in the clock `at`; the address stays for a tick.
inline void write_at(CoreIn* in, std::int64_t cycle, std::int64_t at, int address,
                     std::uint32_t word) {
  if (cycle == at) in->reg_addr = static_cast<std::uint16_t>(address), in->reg_wdata = word;
  if (cycle >= at && cycle < at + kTick + 1) in->reg_write = cycle == at;
}

/// RTL and twin with what is at their pins, rig(clock, outputs of the clock before); after each
/// clock look(rig, clock, outputs).
template <class Rig, class Look>
void beside(const Rig& given, std::int64_t clocks, const Look& look) {
  const Rig* live = nullptr;
  std::int64_t cycle = 0;
  const auto stimulus = [rig = given, &live](std::int64_t k, const CoreOut& out) mutable {
    live = &rig;
    return rig(k, out);
  };
  CoreBench bench("feltgate_core", 5);
  bench.run(stimulus, clocks, {}, [&](const CoreIn&, const auto&, const CoreTwin& twin, bool) {
    look(*live, cycle++, twin.out());
    return static_cast<const char*>(nullptr);
  });
}

}  // namespace feltgate::test
