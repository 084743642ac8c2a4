// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/safety.hpp"

#include "block_signals.hpp"
#include "ports/safety.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::safety> {
  /// Ticks of 40 clocks and more, whose operands hold. In calm ones causes and refusals are rare.
  void legal(In& in, Random& random) {
    if (at == 0) {
      held = in;
      gap = static_cast<int>(random.below(random.coin() ? 2 : 30));
      if (random.one_in(100)) calm = !random.one_in(4);
    }
    const auto last = at == 40 + gap;
    in.p = held.p;
    in.velocity = held.velocity, in.tau_ref = held.tau_ref;
    in.voltage = held.voltage, in.current = held.current;
    in.tick = {at, at == 2, at == 7, at == 15, at == 11, at == 14, at == 27, last, held.tick.count};
    in.bridge.measured = false;
    in.trips &= 1U << fault::word | 1U << fault::engine;
    auto& c = in.commands;
    c.kick = c.kick && last;
    c.clear_faults = c.clear_faults && last;
    if (calm) {
      const bool rare = random.one_in(4000);
      const auto keep = [rare](auto& bit) {
        bit = static_cast<std::decay_t<decltype(bit)>>(rare ? bit : 0);
      };
      keep(in.trips), keep(c.stop), keep(c.host_stop), keep(in.bridge.why), keep(in.peers.fault);
      auto& s = in.position;
      keep(s.why), keep(s.trip_channel), keep(s.trip_index), keep(s.trip_flip), keep(s.illegal);
      in.p.overspeed = in.p.i2t_budget = ~0U >> 1;
      in.velocity = held.velocity >>= 12;
      in.bridge.period_start = in.bridge.period_start && random.one_in(500);
      in.p.self_test_quiet &= 1, in.p.self_test_pulse &= 1;
      in.p.watchdog_ticks |= 0xff;
      in.peers.silent = in.peers.silent && rare, in.peers.blocked = in.peers.blocked && rare;
      c.disarm = c.disarm && random.one_in(100);
      if (last && !random.one_in(20)) c.host_arm = c.panel_arm = !random.one_in(30);
    }
    at = last ? 0 : at + 1;
  }
  struct Converted {
    explicit Converted(const In& in)
        : tick(tick_of(in.tick)),
          position(position_of(in.position)),
          bridge(bridge_of(in.bridge)),
          to{tick,
             commands_of(in.commands),
             position,
             bridge,
             pins,
             (in.trips >> fault::word & 1) != 0,
             (in.trips >> fault::engine & 1) != 0,
             in.velocity,
             in.tau_ref,
             in.current,
             in.voltage} {
      pins.arm = in.commands.panel_arm, pins.stop = in.commands.stop;
      pins.axis_fault = in.peers.fault, pins.axis_silent = in.peers.silent;
      pins.axis_blocked = in.peers.blocked, pins.axis_waits = in.peers.waits;
    }
    Tick tick;
    Position position;
    Bridge bridge;
    Pins pins;
    Safety::In to;
  };
  void between(const In& in) { block.stop.see(in.commands.stop); }
  void clock(const In& in) { block.clock(laws, in.p, Converted(in).to); }
  Out out(const In& in) const {
    const Safe s = block.see(laws, Converted(in).to);
    return {{s.armed, s.locks, s.gates_enable, s.gates_clear, s.clear, s.arm_request, s.ready,
             s.unkicked, s.derated, s.testing, s.test_torque, s.test_result, s.faults,
             s.first_fault, s.current_estimate}};
  }
  void reset(const In& in) {
    block.reset(in.commands.stop);
    at = 0;
  }
  Twin() { block.heat_sum = laws.heat.start; }

  Laws laws{design()};
  Safety block;
  In held{};
  int at = 0, gap = 0;
  bool calm = true;
};

}  // namespace

TEST_CASE("safety: RTL and twin, every clock") {
  lock_step(Twin(), {2'000'000, 8, 50'000, "safety.unkicked"});
}
