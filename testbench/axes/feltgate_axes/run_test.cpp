// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Compares the twin of the axes run from event to event with the twin run clock by clock: same
// outputs at the end of every stretch, and in every snapshot. Documentation:
// docs/architecture.md
#include <vector>

#include "axes_life.hpp"
#include "catch.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "mismatch.hpp"
#include "twins.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr int kCores = AXES;
using D = LeverLaw;
using In = AxesIn<kCores>;

bool same(const In& a, const In& b) {
  bool all = a.arm == b.arm && a.stop == b.stop && a.law_late == b.law_late &&
             a.law_restart == b.law_restart && a.reg_addr == b.reg_addr &&
             a.reg_wdata == b.reg_wdata && a.reg_write == b.reg_write;
  for (std::size_t n = 0; n < kCores; ++n) {
    all = all && a.axis[n].encoder == b.axis[n].encoder &&
          a.axis[n].set_zero == b.axis[n].set_zero && a.axis[n].scene == b.axis[n].scene &&
          a.axis[n].law_torque == b.axis[n].law_torque;
  }
  return all;
}
bool strobes(const In& in) {
  bool any = in.reg_write;
  for (const auto& axis : in.axis) any = any || axis.set_zero;
  return any;
}

}  // namespace

TEST_CASE("axes: from event to event as clock by clock") {
  for (const std::uint32_t longest : {30u, 4'000u}) {
    AxesStimulus<D, kCores> stimulus(longest);
    Random cut(longest);
    test::AxesOf<D, kCores> by_clock, by_event;
    const std::int64_t clocks = scaled_clocks(400'000);
    std::int64_t done = 0, snapshots = 0, faults = 0;
    In in = stimulus(0);
    while (done < clocks) {
      const In held = in;
      const auto limit = static_cast<std::int64_t>(1 + cut.below(longest));
      std::int64_t length = 0;
      do {
        in = stimulus(done + ++length);
      } while (same(in, held) && !strobes(held) && length < limit);
      std::vector<AxesOut<kCores>> of_clocks;
      for (std::int64_t k = 0; k < length; ++k) {
        by_clock.clock(held);
        if (by_clock.out().axis[0].snapshot_valid) of_clocks.push_back(by_clock.out());
      }
      std::size_t next = 0;
      const auto check = [&](const AxesOut<kCores>& a, const AxesOut<kCores>& b, bool whole) {
        for (std::size_t n = 0; n < kCores; ++n) {
          CoreOut one = a.axis[n], other = b.axis[n];
          if (!whole) {  // within a stretch the words are not shown one by one
            for (CoreOut* o : {&one, &other}) {
              o->reg_rdata = o->word_data = o->word_slot = 0;
              o->reg_busy = o->word_valid = false;
            }
          }
          INFO("axis " << n << ", clock " << done << ", length " << length);
          if (!(one == other)) FAIL("the axes by events differ from the axes by clocks");
        }
        if (whole && (a.reg_rdata != b.reg_rdata || a.reg_busy != b.reg_busy)) FAIL("the port");
      };
      if (strobes(held)) {
        by_event.clock(held);
        if (by_event.out().axis[0].snapshot_valid) ++next;
      } else {
        by_event.run(held, length, [&] {
          REQUIRE(next < of_clocks.size());
          check(of_clocks[next++], by_event.out(), false);
        });
      }
      REQUIRE(next == of_clocks.size());
      check(by_clock.out(), by_event.out(), true);
      snapshots += static_cast<std::int64_t>(next);
      for (const CoreOut& o : by_clock.out().axis) {
        faults += o.first_fault == static_cast<unsigned>(Fault::axis);
      }
      done += length;
    }
    CHECK(snapshots == clocks / D::clocks_per_tick + (done - clocks) / D::clocks_per_tick);
    CHECK((kCores == 1 || faults > 0));
  }
}

TEST_CASE("axes: one that faults in the tick that would arm them all") {
  using Axes = test::AxesOf<D, kCores>;
  const auto made = [] {
    Axes axes;
    In in;
    for (int n = 0; n < kCores; ++n) {
      in.reg_addr = static_cast<std::uint16_t>(n * axes_stride + D::A::self_test_pulse);
      in.reg_write = true;
      axes.clock(in);
      in.reg_write = false;
      axes.run(in, 20 * D::clocks_per_tick, [] {});
    }
    return axes;
  };
  In in;
  in.arm = true;
  Axes calm = made();
  std::int64_t arms = 0;  // clocks until the axes are armed
  for (; !calm.out().axis[0].armed; ++arms) {
    REQUIRE(arms < 2'000 * D::clocks_per_tick);
    calm.clock(in);
  }
  int armed = 0, refused = 0;
  for (int n = 0; n < kCores; ++n) {
    for (std::int64_t before = 0; before <= arms; ++before) {
      Axes by_clock = made(), by_event = made();
      In now = in;
      auto& pins = now.axis[static_cast<std::size_t>(n)].encoder;
      std::int64_t done = 0;
      const auto pass = [&](std::int64_t clocks) {
        for (std::int64_t k = 0; k < clocks; ++k) by_clock.clock(now);
        by_event.run(now, clocks, [] {});
        done += clocks;
        for (std::size_t m = 0; m < kCores; ++m) {
          INFO("axis " << m << ", clock " << done << " of " << arms << ", fault of axis " << n);
          if (!(by_clock.out().axis[m] == by_event.out().axis[m])) FAIL("another output");
        }
      };
      // A change of both channels at once is an error; some errors are tolerated.
      const auto err = [&pins] { pins.a = pins.b = !pins.a; };
      now.arm = false;
      for (int error = 0; error < Map::errors_borne; ++error) {
        err();
        pass(2 * D::clocks_per_tick);
      }
      now.arm = true;
      pass(arms - before);
      err();
      pass(before);
      pass(200);
      armed += by_clock.out().axis[0].armed;
      const unsigned first = by_clock.out().axis[static_cast<std::size_t>(n)].first_fault;
      refused += !by_clock.out().axis[0].armed && first == static_cast<unsigned>(Fault::encoder);
    }
  }
  CAPTURE(arms, armed, refused);
  CHECK(armed == 0);
  CHECK(refused > 20);
}

TEST_CASE("axes: as made they show what their cores do, and measure once in a tick") {
  test::AxesOf<D, kCores> axes;
  for (int n = 0; n < kCores; ++n) {
    CHECK(axes.out().axis[static_cast<std::size_t>(n)] == axes.core(n).out());
  }
  constexpr int ticks = 5;
  int measured = 0;
  for (int k = 0; k < ticks * D::clocks_per_tick; ++k) {
    axes.clock({});
    measured += axes.measured();
    CHECK(axes.measured() == axes.core(kCores - 1).measured());
  }
  CHECK(measured == ticks);
}

TEST_CASE("axes: without an engine ticks are told, no events") {
  test::AxesOf<D, kCores> axes;
  int snapshots = 0, events = 0, ticks = 0;
  for (int k = 0; k < 40; ++k) {
    axes.run(
        {}, 7 * (k % 3) + D::clocks_per_tick * (k % 2), [&] { ++snapshots; },
        [&](std::int64_t, int) { ++events; }, [&] { ++ticks; });
  }
  CHECK(snapshots > 20);
  CHECK(std::abs(ticks - snapshots) <= 1);
  CHECK(events == 0);
  CHECK_FALSE(axes.glue().event_valid());
  CHECK(axes.glue().event_number() == 0);
}

// Axes: directed tests of limits and faults in each axis; random runs reach each only in some axis.

using D = Design;

namespace {

constexpr std::uint32_t kMost = 0x7fffffff;

/// Returns the limits that acted in the next `ticks` ticks.
unsigned met(Life& s, int n, int ticks) {
  unsigned limits = 0;
  for (; ticks > 0; --ticks) {
    s.ticks(1);
    limits |= s.out(n).limits;
  }
  return limits;
}
void check_met(Life& s, int n, unsigned limit, int ticks) {
  const unsigned limits = met(s, n, ticks);
  CAPTURE(n, limit, limits);
  CHECK((limits & limit) != 0);
}
void check_fault(Life& s, int n, Fault cause) {
  CAPTURE(n, s.out(n).faults);
  CHECK(s.out(n).first_fault == static_cast<unsigned>(cause));
  for (int m = 0; m < kAxes; ++m) {
    CHECK_FALSE(s.out(m).gates_enable);
    if (m != n) CHECK(s.out(m).first_fault == static_cast<unsigned>(Fault::axis));
  }
}

}  // namespace

TEST_CASE("axes: each comes to its own limits") {
  for (int n = 0; n < kAxes; ++n) {
    Life s;
    s.write(n, A::duty_limit, 1);
    s.write(n, A::hold_torque, 0);
    s.write(n, A::hold_time, 1);
    s.write(n, A::setpoint_torque, static_cast<std::uint32_t>(torque(0.05)));
    s.arm(D::S::setpoint);
    check_met(s, n, limit::duty, 4);
    check_met(s, n, limit::hold, 3 << Map::hold_unit_bits);
    for (int m = 0; m < kAxes; ++m) s.control(m, D::S::setpoint, false);
    s.write(n, A::voltage_window, 0);
    s.write(n, A::current_limit, 1);
    s.arm(D::S::setpoint);
    const unsigned limits = met(s, n, 4);
    CAPTURE(n, limits);
    CHECK((limits & limit::voltage) != 0);
    CHECK((limits & limit::current) != 0);
    for (int m = 0; m < kAxes; ++m) s.control(m, D::S::setpoint, false);
    s.ticks(2);
    s.play();
  }
}

TEST_CASE("axes: each has its own faults, and tells the others") {
  for (int n = 0; n < kAxes; ++n) {
    Life s;
    s.write(n, A::watchdog_ticks, 40);
    s.arm(D::S::setpoint);
    s.write(n, C::command, 1U << C::command_kick);
    s.ticks(60);
    check_fault(s, n, Fault::watchdog);

    s.write(n, A::watchdog_ticks, 0xffffff);
    s.write(n, A::overspeed, kMost);
    s.write(n, A::polarity_ticks, 20);
    s.write(n, A::polarity_speed, 1);
    s.write(n, A::polarity_current, 0);
    s.write(n, A::setpoint_torque, static_cast<std::uint32_t>(torque(0.05)));
    s.arm(D::S::setpoint);
    for (int gap = 2'000; gap > 100 && s.out(n).gates_enable; gap -= gap / 20) {
      s.turn(n, false);
      s.clocks(gap);
    }
    check_fault(s, n, Fault::polarity);

    s.write(n, A::polarity_speed, kMost);
    s.write_all(A::self_test_quiet, 1);
    s.arm(D::S::setpoint, 4);
    for (int k = 0; k < 64 << Map::self_test_unit_bits && s.out(n).gates_enable; ++k) {
      s.ticks(1);
      const bool pulse = s.twin().core(n).testing() && s.out(n).tau_ref != 0;
      if (pulse && k % 8 == 0) s.turn(n, s.out(n).tau_ref < 0);
    }
    check_fault(s, n, Fault::self_test);
    for (int m = 0; m < kAxes; ++m) s.control(m, D::S::setpoint, false);
    s.write_all(C::command, 1U << C::command_clear_faults);
    for (int m = 0; m < kAxes; ++m) CHECK(s.out(m).faults == 0);
    s.play();
  }
}

TEST_CASE("axes: a law that is late is a fault of all whose scene it is") {
  Life s;
  s.arm(D::S::law);
  s.in.law_late = true;
  s.ticks(2);
  for (int n = 0; n < kAxes; ++n) {
    CHECK(s.out(n).first_fault == static_cast<unsigned>(Fault::engine));
  }
  s.in.law_late = false;
  s.arm(D::S::law);
  s.play();
}
