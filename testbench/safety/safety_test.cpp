// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/safety.hpp"

#include "block_signals.hpp"
#include "ports/safety.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::safety> {
  /// Ticks of 40 clocks and more, whose operands hold. Mostly calm ones: causes and refusals are
  /// rare, the lever rests, times are short, and what is latched is cleared.
  void legal(In& in, Random& random) {
    if (at == 0) {
      gap = static_cast<int>(random.below(random.coin() ? 2 : 30));
      if (random.one_in(100)) calm = !random.one_in(4);
      if (random.one_in(50)) host = !host;
      if (!random.one_in(8)) in.position.travel = held.position.travel;
      if (calm) {
        in.velocity >>= 12;
        in.p.overspeed = in.p.i2t_budget = ~0U >> 1;
        in.p.self_test_quiet &= 1, in.p.self_test_pulse &= 3;
        in.p.hold_torque &= 0xff, in.p.hold_time &= 3;
        in.p.watchdog_ticks |= 0xff;
      }
      held = in;
      ticks += 1U << Map::self_test_unit_bits;
    }
    const bool last = at == 40 + gap;
    in.p = held.p;
    in.velocity = held.velocity, in.tau_ref = held.tau_ref;
    in.voltage = held.voltage, in.current = held.current;
    in.bridge.measured = held.bridge.measured, in.bridge.current = held.bridge.current;
    in.tick = {at,       at == 2,  at == 7,
               at == 15, at == 11, at == 14,
               at == 27, last,     calm ? ticks : held.tick.count};
    constexpr unsigned outside =
        feltgate::fault_bit(feltgate::Fault::word) | feltgate::fault_bit(feltgate::Fault::engine);
    in.trips = static_cast<std::uint16_t>(in.trips & outside);
    auto& c = in.commands;
    c.host = host;
    c.kick = c.kick && last;
    c.clear_faults = c.clear_faults && last;
    if (calm) {
      const bool rare = random.one_in(8000), faulty = block.latch.first != 0;
      const auto keep = [rare](auto& bits) {
        if (!rare) bits = std::decay_t<decltype(bits)>{};
      };
      auto& s = in.position;
      s.travel = held.position.travel;
      keep(in.trips), keep(c.stop), keep(c.host_stop), keep(c.disarm), keep(in.bridge.why);
      keep(in.peers.fault), keep(in.peers.silent), keep(in.peers.blocked), keep(in.peers.waits);
      keep(s.why), keep(s.trip_channel), keep(s.trip_index), keep(s.trip_flip), keep(s.illegal),
          keep(s.moved);
      in.bridge.period_start = in.bridge.period_start && random.one_in(500);
      c.mode = held.commands.mode & 1;
      c.host_arm = c.panel_arm = !faulty && !random.one_in(30);
      c.clear_faults = last && (faulty || rare);
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
             (in.trips & feltgate::fault_bit(feltgate::Fault::word)) != 0,
             (in.trips & feltgate::fault_bit(feltgate::Fault::engine)) != 0,
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
  bool calm = true, host = false;
  std::uint32_t ticks = 0;
};

}  // namespace

TEST_CASE("safety: RTL and twin, every clock") {
  lock_step(Twin(), {2'000'000, 8, 50'000, "safety.unkicked"});
}
