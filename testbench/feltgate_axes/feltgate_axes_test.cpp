// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Axes: RTL against twin, every output of each on every clock, and what must hold between them.
// AXES is how many. Documentation: docs/blocks/feltgate_axes.md
#include "feltgate/feltgate_axes.hpp"

#include "axes_adapter.hpp"
#include "axes_stimulus.hpp"
#include "catch.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using D = Design;
using In = AxesIn<kAxes>;
using A = D::A;
using C = D::C;
constexpr int kTick = D::clocks_per_tick;
constexpr std::uint32_t kHost =
    static_cast<std::uint32_t>(D::control_reset) | 1u << C::control_host;

/// What a life has met, by axis.
struct Tally {
  std::int64_t clocks = 0, armed = 0;
  std::int64_t own[kAxes] = {}, spread[kAxes] = {}, tests[kAxes] = {};
};

/// What must hold whatever comes.
struct Watch {
  Tally* tally;
  bool gates = false;   ///< of all, the clock before
  bool faulty = false;  ///< of any, the clock before
  int testing = -1;     ///< the axis whose pulse it is
  unsigned first[3] = {0, 0, 0};

  const char* operator()(const In&, const Vfeltgate_axes& rtl, const AxesTwin& twin, bool reset) {
    const auto of = [](const auto& port, int n, int width = 1) {
      return static_cast<unsigned>(bits_of(port, n * width, width));
    };
    int armed = 0, enabled = 0, pulses = 0;
    bool any = false;
    for (int n = 0; n < kAxes; ++n) {
      const unsigned fault = of(rtl.first_fault_o, n, C::faults_first_width);
      armed += static_cast<int>(of(rtl.armed_o, n));
      enabled += static_cast<int>(of(rtl.gates_enable_o, n));
      any = any || fault != 0;
      if (fault != 0 && first[n] == 0) {
        const bool spread = fault == static_cast<unsigned>(Fault::axis);
        ++(spread ? tally->spread : tally->own)[n];
        if (spread && !faulty) return "a fault of another axis that has none";
      }
      if (fault != 0 && first[n] != 0 && fault != first[n] && !reset)
        return "the first cause is kept";
      first[n] = fault;
      // A pulse of the self-test: its torque while the test lasts.
      const bool pulse = twin.core(n).testing() && twin.core(n).out().tau_ref != 0;
      pulses += pulse ? 1 : 0;
      tally->tests[n] += pulse ? 1 : 0;
      for (int m = 0; m < kAxes; ++m) {
        if (pulse && m != n && twin.core(m).out().snapshot_valid &&
            twin.core(m).out().tau_ref != 0 && !twin.core(m).testing())
          return "a torque beside the pulse of another axis";
      }
    }
    ++tally->clocks;
    tally->armed += armed == kAxes ? 1 : 0;
    // A fault in the very clock of the arming, or of the end of a tick, is that of one axis for a tick.
    if (armed != 0 && armed != kAxes && !any) return "armed together";
    // A fault of any, one clock for the others.
    if (faulty && any && enabled != 0) return "gates on a clock after a fault";
    if (pulses > 1) return "two tests at once";
    faulty = any;
    return nullptr;
  }
};

/// Axes with a host, who does what a test says: the twin at once, the RTL beside one afterwards.
class Life {
 public:
  In in;

  const CoreOut& out(int n) const { return twin_.out().axis[static_cast<std::size_t>(n)]; }
  AxesTwin& twin() { return twin_; }
  In::Axis& axis(int n) { return in.axis[static_cast<std::size_t>(n)]; }

  void clocks(std::int64_t count) {
    for (; count > 0; --count) {
      inputs_.push_back(in);
      twin_.clock(in);
    }
  }
  void to_clock(int c) { clocks((c - twin_.clock_of_tick() + kTick) % kTick); }
  void ticks(std::int64_t n) {
    to_clock(0);
    clocks(n * kTick);
  }
  void write(int n, int address, std::uint32_t word) {
    to_clock(5);
    in.reg_addr = static_cast<std::uint16_t>(n * axes_stride + address);
    in.reg_wdata = word;
    in.reg_write = true;
    clocks(1);
    in.reg_write = false;
    to_clock(0);
  }
  void write_all(int address, std::uint32_t word) {
    for (int n = 0; n < kAxes; ++n) write(n, address, word);
  }
  std::uint32_t read(int n, int address) {
    in.reg_addr = static_cast<std::uint16_t>(n * axes_stride + address);
    clocks(4);
    return twin_.out().reg_rdata;
  }
  void control(int n, int scene, bool arm) {
    write(n, C::control,
          kHost | static_cast<std::uint32_t>(scene) << C::control_scene |
              std::uint32_t{arm} << C::control_arm);
  }
  /// All, without a ramp.
  void arm(int scene, std::uint32_t test_pulse = 0) {
    for (int n = 0; n < kAxes; ++n) control(n, scene, false);
    write_all(A::self_test_pulse, test_pulse);
    write_all(A::ramp_step, 0x7ffffff);
    write_all(C::command, 1u << C::command_clear_faults);
    ticks(2);
    for (int n = 0; n < kAxes; ++n) control(n, scene, true);
    ticks(1);
    for (int n = 0; n < kAxes; ++n) REQUIRE(out(n).armed);
  }
  void play() {
    Tally tally;
    AxesBench bench("feltgate_axes", 1);
    bench.run(Replay{&inputs_}, static_cast<std::int64_t>(inputs_.size()) + AxesBench::kFirstReset,
              {}, Watch{&tally});
  }

 private:
  struct Replay {
    const std::vector<In>* inputs;
    In operator()(std::int64_t cycle) const {
      const std::int64_t k = cycle - AxesBench::kFirstReset;
      return k < 0 ? In{} : (*inputs)[static_cast<std::size_t>(k)];
    }
  };

  AxesTwin twin_;
  std::vector<In> inputs_;
};

std::int32_t torque(double nm) {
  return static_cast<std::int32_t>(nm * (1 << D::f.torque.fraction));
}

}  // namespace

TEST_CASE("axes: random levers, host and panel") {
  Tally tally;
  const auto lives = static_cast<std::uint64_t>(scaled_clocks(kAxes == 1 ? 2 : 3));
  for (std::uint64_t seed = 31; seed < 31 + lives; ++seed) {
    AxesBench bench("feltgate_axes", seed);
    bench.run(AxesStimulus<D, kAxes>(seed), 800'000, {}, Watch{&tally});
  }
  std::string met = "armed " + std::to_string(tally.armed) + " of " + std::to_string(tally.clocks);
  for (int n = 0; n < kAxes; ++n) {
    met += ", axis " + std::to_string(n) + ": own " + std::to_string(tally.own[n]) + " spread " +
           std::to_string(tally.spread[n]) + " test clocks " + std::to_string(tally.tests[n]);
  }
  INFO(met);
  CHECK(tally.armed > tally.clocks / 10);
  for (int n = 0; n < kAxes; ++n) {
    CHECK(tally.own[n] >= 3);
    if (kAxes > 1) CHECK(tally.spread[n] >= 2);
  }
}

TEST_CASE("axes: resets at random times") {
  Tally tally;
  AxesBench bench("feltgate_axes", 77);
  bench.run(AxesStimulus<D, kAxes>(77), 300'000, {20'000});
}

TEST_CASE("axes: each has its words at its own addresses, and nothing lies between") {
  Life s;
  for (int n = 0; n < kAxes; ++n) s.write(n, A::torque_limit, 1000u + static_cast<unsigned>(n));
  for (int n = 0; n < kAxes; ++n) {
    CHECK(s.read(n, A::torque_limit) == 1000u + static_cast<unsigned>(n));
    s.axis(n).encoder = {(n + 1 & 2) != 0, (n + 1 & 1) != 0, false};
  }
  for (int n = 0; n < kAxes; ++n) {
    CHECK(s.read(n, 0x2ff) == 0);
    CHECK(s.read(n, C::snapshot + Map::R::tick) == s.out(n).tick_count - 1);
  }
  for (const int n : {kAxes, 4, 15, 16, 63}) {
    s.write(n, A::torque_limit, 7);
    CHECK(s.read(n, A::torque_limit) == 0);
  }
  CHECK(s.read(0, A::torque_limit) == 1000u);
  s.play();
}

TEST_CASE("axes: the port is busy with the write of the axis that is addressed") {
  Life s;
  s.to_clock(3);
  s.in.reg_addr = A::torque_limit;
  s.in.reg_wdata = 5;
  s.in.reg_write = true;
  s.clocks(1);
  s.in.reg_write = false;
  s.clocks(1);
  CHECK(s.twin().out().reg_busy);
  s.in.reg_addr = static_cast<std::uint16_t>(axes_stride + A::torque_limit);
  s.clocks(1);
  CHECK_FALSE(s.twin().out().reg_busy);
  s.in.reg_wdata = 6;
  s.in.reg_write = kAxes > 1;
  s.clocks(1);
  s.in.reg_write = false;
  s.ticks(1);
  CHECK(s.read(0, A::torque_limit) == 5);
  CHECK(s.read(1, A::torque_limit) == (kAxes > 1 ? 6u : 0u));
  s.play();
}

TEST_CASE("axes: armed when the last one asks, disarmed with the first that does not") {
  Life s;
  s.write_all(A::self_test_pulse, 0);
  for (int n = 0; n < kAxes; ++n) {
    for (int m = 0; m < kAxes; ++m) CHECK_FALSE(s.out(m).armed);
    s.control(n, D::S::setpoint, true);
    s.ticks(2);
  }
  for (int m = 0; m < kAxes; ++m) CHECK(s.out(m).armed);
  s.control(kAxes - 1, D::S::setpoint, false);
  for (int m = 0; m < kAxes; ++m) CHECK_FALSE(s.out(m).armed);
  s.play();
}

TEST_CASE("axes: a fault of any opens the gates of all, and each keeps its first cause") {
  for (int n = 0; n < kAxes; ++n) {
    Life s;
    s.arm(D::S::setpoint);
    s.write(n, C::command, 1u << C::command_stop);
    for (int m = 0; m < kAxes; ++m) {
      INFO("axis " << m << ", the stop is that of " << n);
      CHECK_FALSE(s.out(m).gates_enable);
      CHECK(s.out(m).first_fault == static_cast<unsigned>(m == n ? Fault::stop : Fault::axis));
      CHECK(s.out(m).faults == fault_bit(m == n ? Fault::stop : Fault::axis));
    }
    // None is armed before all are cleared.
    s.ticks(1);
    for (int m = 0; m < kAxes; ++m) s.control(m, D::S::setpoint, false);
    for (int m = 0; m < kAxes; ++m) {
      if (m != n) s.write(m, C::command, 1u << C::command_clear_faults);
    }
    for (int m = 0; m < kAxes; ++m) s.control(m, D::S::setpoint, true);
    s.ticks(1);
    for (int m = 0; m < kAxes; ++m) CHECK_FALSE(s.out(m).armed);
    s.arm(D::S::setpoint);
    s.play();
  }
}

TEST_CASE("axes: own scene and polarity, programmed torque by axis, duties in one period") {
  Life s;
  s.arm(D::S::law);
  for (int n = 0; n < kAxes; ++n) s.axis(n).law_torque = torque(0.1 * (n + 1));
  s.ticks(3);
  for (int n = 0; n < kAxes; ++n) CHECK(s.out(n).tau_ref == torque(0.1 * (n + 1)));
  // The duties of one tick are in force with the same clock.
  std::int64_t changed[3] = {-1, -1, -1};
  for (int n = 0; n < kAxes; ++n) s.axis(n).law_torque = torque(-0.1 * (n + 1));
  for (std::int64_t c = 0; c < 3 * D::pwm_period; ++c) {
    s.clocks(1);
    for (int n = 0; n < kAxes; ++n) {
      if (changed[n] < 0 && s.out(n).duty_active < 0) changed[n] = c;
    }
  }
  for (int n = 0; n < kAxes; ++n) {
    CHECK(changed[n] > 0);
    CHECK(changed[n] == changed[0]);
  }
  s.play();
}

TEST_CASE("axes: self-tests in turn, the others at 0") {
  Life s;
  s.write_all(A::self_test_quiet, 1);
  s.arm(D::S::law, 2);
  for (int n = 0; n < kAxes; ++n) s.axis(n).law_torque = torque(0.2);
  int order[8] = {}, seen = 0;
  for (int tick = 0; tick < (kAxes + 1) * 8 << Map::self_test_unit_bits; ++tick) {
    s.ticks(1);
    bool testing = false;
    for (int n = 0; n < kAxes; ++n) testing = testing || s.twin().core(n).testing();
    if (!testing) break;
    for (int n = 0; n < kAxes; ++n) {
      if (s.out(n).tau_ref == 0) continue;
      REQUIRE(s.twin().core(n).testing());
      if (seen == 0 || order[seen - 1] != n) {
        REQUIRE(seen < 8);
        order[seen++] = n;
      }
    }
  }
  CHECK(seen == kAxes);
  for (int n = 0; n < seen; ++n) CHECK(order[n] == n);
  s.ticks(3);
  for (int n = 0; n < kAxes; ++n) CHECK(s.out(n).tau_ref == torque(0.2));
  s.play();
}
