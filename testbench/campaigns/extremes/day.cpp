// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// 24 hours of device time: no count is lost and no filter's bias grows. Documentation:
// docs/extremes.md

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <future>
#include <mutex>
#include <thread>

#include "campaigns/extremes/bench.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/largest.hpp"
#include "twins.hpp"

namespace feltgate::extremes {

/// The core of the design `lever`, armed in the scene `free`, with an encoder that moves edge by
/// edge.
class LongRun {
 public:
  LongRun() {
    wait(10);
    in_.arm = true;
    wait(10);
  }

  /// `ticks` ticks without an edge.
  void wait(std::int64_t ticks) { clocks(ticks * Lever::clocks_per_tick); }
  /// Moves `counts` up or down, one count every `clocks_each` clocks.
  void turn(std::int64_t counts, std::int64_t clocks_each) {
    const int step = counts > 0 ? 1 : -1;
    for (std::int64_t k = std::abs(counts); k > 0; --k) {
      clocks(clocks_each);
      count_ += step;
      ++edges_;
      in_.encoder = pins_at(count_);
    }
  }
  /// Moves forth and back over one edge.
  void dither(std::int64_t edges, std::int64_t clocks_each) {
    for (std::int64_t k = 0; k < edges; ++k) turn(k % 2 == 0 ? 1 : -1, clocks_each);
  }
  /// Runs to the start of this tick.
  void until_tick(std::int64_t tick) { clocks(tick * Lever::clocks_per_tick - clock_); }

  std::int64_t stepped_ticks() const { return clock_ / Lever::clocks_per_tick; }
  std::int64_t count() const { return count_; }
  std::int64_t edges() const { return edges_; }
  const CoreOut& out() const { return core_.out(); }

 private:
  void clocks(std::int64_t n) {
    clock_ += n;
    core_.run(in_, n, [] {});
  }

  test::CoreOf<Lever> core_;
  CoreIn in_;
  std::int64_t clock_ = 0, count_ = 0, edges_ = 0;
};

namespace {

constexpr int day_minutes = 24 * 60;
constexpr std::int64_t minute_ticks = 60'000'000;
/// The fastest dither over one edge that the core does not take for a dead channel.
constexpr std::int64_t dither_ticks = (std::int64_t{Map::edge_units} << Lever::edge_unit_bits) + 64;

/// The motion of one minute: bursts at 599 rad/s, strokes by hand, single counts, dither, rest.
/// Returns the difference between end and start, in counts.
void motion(LongRun& r, int minute) {
  const std::int64_t begin = r.stepped_ticks();
  r.turn(390'625, 128);            // 1 s at 599 rad/s
  r.turn(-195'000 - minute, 128);  // almost half of it back, a little more every minute
  r.wait(20'000);
  for (int k = 0; k < 4; ++k) r.turn(k % 2 == 0 ? 2500 : -2500, 4000);  // strokes at 19 rad/s
  r.turn(60, 500'000);                                                  // 100 counts a second
  r.dither(500 + minute % 7 * 2, dither_ticks * Lever::clocks_per_tick);
  r.until_tick(begin + minute_ticks);  // rest until the minute ends
}

constexpr std::int64_t net(int minute) { return 390'625 - 195'000 - minute + 60; }
constexpr std::int64_t edges_of(int minute) {
  return 390'625 + 195'000 + minute + 4 * 2500 + 60 + 500 + minute % 7 * 2;
}

/// Results of a stretch of minutes.
struct Segment {
  std::int64_t drift = 0;  ///< largest difference of position and counts fed, in any minute
  std::int64_t lost_ticks = 0, edges = 0, minutes = 0;
  std::int64_t velocity = 0, tau_hat = 0;              ///< largest at rest, raw
  std::int64_t first_velocity = 0, last_velocity = 0;  ///< of the first and the last minute
  int faults = 0, disarmed = 0;
  CoreOut begin, end;
};

Segment run_segment(int from, int to, const std::function<void()>& minute_done) {
  Segment s;
  LongRun r;
  // A segment that does not begin the day takes its state from the minute before.
  if (from > 0) motion(r, from - 1);
  s.begin = r.out();
  const std::int64_t count0 = r.count(), edges0 = r.edges();
  std::int64_t count = count0;
  for (int m = from; m < to; ++m) {
    motion(r, m);
    count += net(m);
    const CoreOut& o = r.out();
    s.drift = std::max<std::int64_t>(s.drift, std::abs(o.position - count));
    s.lost_ticks = std::max<std::int64_t>(
        s.lost_ticks,
        std::abs(static_cast<std::int64_t>(o.tick_count) - (r.stepped_ticks() & 0xffffffff)));
    s.velocity = std::max<std::int64_t>(s.velocity, std::abs(o.velocity));
    s.tau_hat = std::max<std::int64_t>(s.tau_hat, std::abs(o.tau_hat));
    (m == from ? s.first_velocity : s.last_velocity) = o.velocity;
    s.faults |= o.faults;
    s.disarmed += o.armed ? 0 : 1;
    ++s.minutes;
    minute_done();
  }
  s.edges = r.edges() - edges0;
  s.end = r.out();
  return s;
}

/// Returns the number of signals that differ, without the position, which this case measures.
double differing(const CoreOut& a, const CoreOut& b) {
  return static_cast<double>(
      (a.velocity != b.velocity) + (a.tau_hat != b.tau_hat) + (a.tau_ref != b.tau_ref) +
      (a.current_ref != b.current_ref) + (a.voltage != b.voltage) + (a.duty != b.duty) +
      (a.limits != b.limits) + (a.faults != b.faults) + (a.armed != b.armed));
}

Outcome clock_of_the_simulator(const Settings&) {
  Outcome o;
  // Microseconds in float32: the first time to which 1 us cannot be added any more.
  const auto stands_still = [](float us) {
    const volatile float next = us + 1.0F;
    return next == us;
  };
  float us = 1;
  while (!stands_still(us)) us *= 2;
  Finding f{"a clock in microseconds stands still in float32: 2^24 us",
            "s",
            near(16.777216, 1e-9),
            {},
            {},
            1e-6 * static_cast<double>(us)};
  o.findings.push_back(f);
  const std::int64_t day_clocks = std::int64_t{86'400} * 50'000'000;
  o.add(Cores::twin, "clocks of a day as the simulator counts them, in 64-bit integers", "clock",
        exactly(4.32e12), day_clocks);
  return o;
}

/// Splits the day into as many segments as there are processors. An exception in a thread ends the
/// case.
std::vector<Segment> run_segments(const Settings& s, int minutes) {
  std::mutex telling;
  int done = 0;
  const auto minute_done = [&] {
    const std::lock_guard<std::mutex> alone(telling);
    ++done;
    if (s.progress) s.progress(static_cast<double>(done) / minutes);
  };
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<std::future<Segment>> running;
  for (int i = 0; i < threads; ++i) {
    running.push_back(std::async(std::launch::async, run_segment, minutes * i / threads,
                                 minutes * (i + 1) / threads, minute_done));
  }
  std::vector<Segment> segments;
  for (auto& segment : running) segments.push_back(segment.get());
  return segments;
}

Outcome device_time(const Settings& s, int minutes) {
  Outcome o;
  const std::vector<Segment> segments = run_segments(s, minutes);
  Segment all;
  double seams = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& part = segments[i];
    all.minutes += part.minutes;
    all.edges += part.edges;
    all.drift = std::max(all.drift, part.drift);
    all.lost_ticks = std::max(all.lost_ticks, part.lost_ticks);
    all.velocity = larger(all.velocity, part.velocity);
    all.tau_hat = larger(all.tau_hat, part.tau_hat);
    all.faults |= part.faults;
    all.disarmed += part.disarmed;
    if (i > 0) seams += differing(segments[i - 1].end, part.begin);
  }
  std::int64_t edges = 0;
  for (int m = 0; m < minutes; ++m) edges += edges_of(m);
  const auto ticks = static_cast<double>(all.minutes * minute_ticks);
  o.add(Cores::twin, "ticks of device time, each of them stepped", "tick",
        exactly(static_cast<double>(minutes * minute_ticks)), ticks);
  o.add(Cores::twin, "encoder edges fed", "", exactly(static_cast<double>(edges)), all.edges);
  o.add(Cores::twin, "largest difference of position and counts fed, at any minute's end", "count",
        exactly(0), all.drift);
  o.add(Cores::twin, "ticks lost", "tick", exactly(0), all.lost_ticks);
  const double lsb = std::ldexp(1.0, -Lever::f.velocity.fraction);
  const double a1 = std::ldexp(67092, -27);
  o.add(Cores::twin, "largest velocity left at rest: half an LSB over a1", "rad/s",
        between(0, 0.5 / a1 * lsb), lsb * static_cast<double>(all.velocity));
  o.add(Cores::twin, "largest tau_hat left at rest: one LSB", "Nm", between(0, 1.0 / 65536),
        static_cast<double>(all.tau_hat) / 65536);
  // The rest of the filter's dead band has either sign: only over many minutes can it be a drift.
  if (minutes == day_minutes) {
    const auto drifted = segments.back().last_velocity - segments.front().first_velocity;
    o.add(Cores::twin, "velocity left after the last minute less that after the first", "rad/s",
          exactly(0), lsb * static_cast<double>(drifted));
  }
  o.add(Cores::twin, "faults, and minutes that ended disarmed", "", exactly(0),
        all.faults + all.disarmed);
  o.add(Cores::twin, "signals that differ at the seams of the segments", "", exactly(0), seams);
  o.twin_s = ticks * 1e-6;
  o.note =
      "`lever`, armed, every tick of each minute stepped: 17 s of motion (bursts at 599 rad/s, "
      "strokes at 19 rad/s, 100 counts a second, dither on one edge, as fast as it may be without "
      "being a dead channel), then rest. Each processor runs a segment; each segment "
      "but the first starts from reset one minute early, and the seams compare the outputs of "
      "both.";
  return o;
}

Outcome day(const Settings& s) { return device_time(s, day_minutes); }
Outcome two_minutes(const Settings& s) { return device_time(s, 2); }

}  // namespace

std::vector<Case> day_cases() {
  return {
      {"A day", "clock_of_the_simulator", "Time is an integer: a float would stand still.",
       clock_of_the_simulator},
      {"A day", "two_minutes", "Two minutes of the day below.", two_minutes},
      {"A day", "day", "24 hours: no count lost, no bias that grows.", day, true},
  };
}

}  // namespace feltgate::extremes
