// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two twins of axes with their engine, one run clock by clock, one from event to event, with random
// levers and a random host. Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "feltgate/feltgate_axes.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "law/image.hpp"
#include "random.hpp"
#include "twins.hpp"

namespace feltgate::test {

using D = LeverLaw;
using C = D::C;
using H = EngineMap::H;

/// What is told at the end of a tick: the runs behind its torque, and those that began in it.
inline void same_runs(const EngineWatch& x, const EngineWatch& y) {
  if (x.begins == y.begins && x.in_force == y.in_force &&
      x.changes_at_begin == y.changes_at_begin) {
    return;
  }
  CAPTURE(x.begins, y.begins, x.in_force.value_or(7), y.in_force.value_or(7), x.changes_at_begin,
          y.changes_at_begin);
  FAIL("another run is behind the torque");
}

/// Everything that a host sees after a clock, and what the engine's runs are of.
template <int N>
void same(AxesOut<N> a, AxesOut<N> b, const EngineWatch& x, const EngineWatch& y, bool snapshot) {
  for (std::size_t n = 0; n < N; ++n) {
    for (CoreOut* o : {&a.axis[n], &b.axis[n]}) {
      if (!snapshot) continue;  // amid a stretch the words are not shown one by one
      o->reg_rdata = o->word_data = o->word_slot = 0;
      o->reg_busy = o->word_valid = false;
    }
    INFO("axis " << n);
    if (!(a.axis[n] == b.axis[n])) {
      CAPTURE(a.axis[n].tau_ref, b.axis[n].tau_ref, a.axis[n].faults, b.axis[n].faults);
      FAIL("by events the outputs are not those by clocks");
    }
  }
  if (snapshot) return;
  if (a.reg_busy != b.reg_busy) FAIL("busy");
  if (a.rdata_known && b.rdata_known && a.reg_rdata != b.reg_rdata) {
    CAPTURE(a.reg_rdata, b.reg_rdata);
    FAIL("read data");
  }
  if (b.rdata_known && !a.rdata_known) FAIL("read data that are not known");
  if (a.event_valid != b.event_valid) FAIL("an event");
  if (a.event_valid && (a.event_number != b.event_number || a.event_value != b.event_value)) {
    FAIL("an event's number or value");
  }
  if (x.ended != y.ended || x.changes != y.changes) FAIL("another run has ended");
}

/// What is shown amid a tick without settle().
template <int N>
void same_amid(const AxesOut<N>& a, const AxesOut<N>& b) {
  for (std::size_t n = 0; n < N; ++n) {
    const CoreOut &x = a.axis[n], &y = b.axis[n];
    INFO("axis " << n);
    if (x.gates != y.gates || x.duty_active != y.duty_active || x.gates_enable != y.gates_enable ||
        x.armed != y.armed || x.position != y.position || x.velocity != y.velocity ||
        x.tau_hat != y.tau_hat) {
      CAPTURE(x.position, y.position, x.velocity, y.velocity, x.tau_hat, y.tau_hat);
      FAIL("amid a tick the outputs by events are not those by clocks");
    }
  }
}

template <int N>
class Both {
 public:
  using Axes = test::AxesOf<D, N, true, true>;
  AxesIn<N> in;
  Axes by_clock, by_event;
  std::int64_t done = 0, whole = 0;
  bool hasty = false;  ///< a word is not waited for: it lands amid what follows

  void run(std::int64_t clocks) {
    std::vector<AxesOut<N>> shown;
    std::vector<EngineWatch> told;
    std::vector<std::pair<std::int64_t, int>> events, told_events;
    for (std::int64_t k = 0; k < clocks; ++k) {
      if (by_clock.out().event_valid) events.emplace_back(k, by_clock.out().event_number);
      by_clock.clock(in);
      if (by_clock.out().axis[0].snapshot_valid) {
        shown.push_back(by_clock.out());
      }
      if (by_clock.last()) told.push_back(by_clock.glue().watch());
    }
    INFO("clock " << done << ", " << clocks << " clocks, clock of tick "
                  << by_clock.clock_of_tick());
    std::size_t next = 0;
    bool settled = true;
    if (in.reg_write || in.reg_read) {
      by_event.clock(in);
      next = shown.size();
    } else {
      std::size_t ticks = 0;
      const auto on_event = [&](std::int64_t clock, int number) {
        told_events.emplace_back(clock, number);
      };
      const auto on_tick_end = [&] {
        REQUIRE(ticks < told.size());
        same_runs(told[ticks++], by_event.glue().watch());
      };
      const auto on_snapshot = [&] {
        REQUIRE(next < shown.size());
        same<N>(shown[next], by_event.out(), by_event.glue().watch(), by_event.glue().watch(),
                true);
        ++next;
      };
      settled = !random_.coin();
      if (settled) {
        by_event.run(in, clocks, on_snapshot, on_event, on_tick_end);
      } else {
        by_event.advance(in, clocks, on_snapshot, on_event, on_tick_end);
      }
      if (told_events != events) FAIL("what is told of events");
      REQUIRE(ticks == told.size());
    }
    REQUIRE(next == shown.size());
    if (settled) {
      same<N>(by_clock.out(), by_event.out(), by_clock.glue().watch(), by_event.glue().watch(),
              false);
    } else {
      same_amid<N>(by_clock.out(), by_event.out());
    }
    const bool known = by_clock.out().rdata_known && by_event.out().rdata_known;
    if (in.reg_addr < axes_engine && !known) FAIL("words of axes are always known");
    if (by_clock.measured() != by_event.measured()) FAIL("whether a tick is measured");
    if (by_clock.glue().restarted() != by_event.glue().restarted()) FAIL("a restart");
    if (by_clock.glue().busy() != by_event.glue().busy()) FAIL("whether it takes words");
    done += clocks;
    if (by_event.glue().runs_whole()) whole += clocks;
  }
  void write(int address, std::uint32_t word) {
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = word;
    for (int n = 0; (by_clock.out().reg_busy || n == 0) && n < 20'000; ++n) run(1);
    in.reg_write = true;
    run(1);
    in.reg_write = false;
    if (hasty) return;
    for (int n = 0; (by_clock.out().reg_busy || n == 0) && n < 20'000; ++n) run(1);
  }
  void engine(int address, std::uint32_t word) { write(axes_engine + address, word); }
  void core(int n, int address, std::uint32_t word) { write(n * axes_stride + address, word); }
  void control(int n, int scene, bool arm) {
    core(n, C::control,
         1U << C::control_host | static_cast<unsigned>(arm) << C::control_arm |
             static_cast<unsigned>(scene) << C::control_scene);
  }
  void arm(int scene) {
    for (int n = 0; n < N; ++n) {
      core(n, D::A::self_test_pulse, 0);
      core(n, D::A::ramp_step, 0x7ffffff);
      core(n, C::command, 1U << C::command_clear_faults);
    }
    for (int n = 0; n < N; ++n) control(n, scene, true);
    in.reg_addr = 0;
    for (int k = 0; k < 1300 && !by_clock.out().axis[0].armed; ++k) run(D::clocks_per_tick);
  }
  void memories() {
    const EngineMemory &a = by_clock.glue().engine().memory(), &b = by_event.glue().engine().memory();
    if (a.data != b.data) FAIL("data");
    if (a.table != b.table) FAIL("table");
  }
  void step(std::size_t n, bool up) {
    phase_[n] += up ? 1u : 3u;
    const bool a = (phase_[n] & 2u) != 0;
    in.axis[n].encoder.a = a;
    in.axis[n].encoder.b = ((phase_[n] & 1u) != 0) != a;
  }

 private:
  Random random_{7};
  std::array<unsigned, N> phase_{};
};

/// Memories go in at once; registers by the port, so that their CRC and ranges are looked at.
template <int N>
void load(Both<N>& b, const EngineMemory& m, unsigned run, unsigned divider, unsigned max_age) {
  b.by_clock.glue().engine().memory() = m;
  b.by_event.glue().engine().memory() = m;
  for (int t = 0; t < 4; ++t) b.engine(H::divider0 + t, divider);
  b.engine(H::line_base, static_cast<std::uint32_t>(m.line_base));
  b.engine(H::max_age, max_age);
  law::Image image;
  image.program = m.program;
  image.data = m.data;
  image.table = m.table;
  image.line_base = m.line_base;
  b.engine(H::crc, law::crc(image));
  b.engine(H::run, run);
  b.in.reg_addr = 0;
}

/// Moves the levers and makes random accesses of the host.
template <int N>
void live(Both<N>& b, Random& random, int stretches, bool meddles) {
  std::int64_t pace = 200;
  for (int k = 0; k < stretches; ++k) {
    if (random.one_in(50)) pace = std::int64_t{20} << random.below(7);
    const std::size_t n = random.below(N);
    if (!random.one_in(4)) b.step(n, random.below(10) < 6);
    std::int64_t clocks = 1 + random.below(static_cast<std::uint64_t>(pace));
    if (random.one_in(10)) clocks = 1 + random.below(4000);
    if (random.one_in(3)) clocks = D::clocks_per_tick - b.by_clock.clock_of_tick();
    b.run(clocks);
    if (random.one_in(60)) b.memories();
    if (!meddles || !random.one_in(25)) continue;
    const auto some = static_cast<int>(n);
    switch (random.below(10)) {
      case 0:
        for (int w = 0; w < 4; ++w) b.engine(EngineMap::D::parameter + w, random.below(3));
        b.engine(H::commit, 1);
        break;
      case 1:
        b.hasty = random.coin();
        b.core(some, D::A::ramp_step, 0x7ffffff - random.below(5));
        break;
      case 2:  // reads, at once or in time
        b.in.reg_addr = static_cast<std::uint16_t>(axes_engine + random.below(0xa20));
        b.run(1 + random.below(60));
        b.in.reg_read = true;
        b.run(1);
        b.in.reg_read = false;
        break;
      case 3:
        b.in.axis[n].set_zero = true;
        b.in.reg_write = true;  // a clock of its own
        b.in.reg_addr = 0x3fff;
        b.run(1);
        b.in.axis[n].set_zero = false;
        b.in.reg_write = false;
        break;
      case 4:
        b.hasty = random.coin();
        b.control(some, random.coin() ? D::S::law : D::S::setpoint, random.below(3) != 0);
        break;
      case 5:
        b.arm(D::S::law);
        break;
      case 6:
        b.in.stop = random.one_in(3);
        break;
      case 7:
        b.engine(H::max_age, random.below(12));
        b.engine(H::mailbox_first, random.below(64));
        b.engine(H::mailbox_age, random.below(8));
        break;
      default:
        break;
    }
    b.hasty = false;
    if (!random.one_in(5)) b.in.reg_addr = static_cast<std::uint16_t>(random.below(0x300));
    if (!random.one_in(4)) b.in.stop = false;
  }
}

}  // namespace feltgate::test
