// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// 24 hours of device time: no count is lost, no filter's bias grows. Documentation:
// docs/extremes.md
#include "extremes/day.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <thread>

#include "extremes/table.hpp"

namespace feltgate::extremes {

namespace {

constexpr int minutes = 24 * 60;
constexpr std::int64_t minute_ticks = 60'000'000;
constexpr std::int64_t rests = 11;  ///< periods of rest per minute that are passed over
constexpr std::int64_t stepped_ticks = minute_ticks - rests * rest_period_ticks;

/// The motion of one minute: bursts at 599 rad/s, strokes by hand, single counts, dither, rest.
/// Returns the counts that it ends away from where it began.
void motion(LongRun& r, int minute) {
  const std::int64_t begin = r.stepped_ticks();
  r.turn(390'625, 128);            // 1 s at 599 rad/s
  r.turn(-195'000 - minute, 128);  // not quite half of it back, a little more every minute
  r.wait(20'000);
  for (int k = 0; k < 4; ++k) r.turn(k % 2 == 0 ? 2500 : -2500, 4000);  // strokes at 19 rad/s
  r.turn(60, 500'000);                                                  // 100 counts a second
  r.dither(500 + minute % 7 * 2, 767 * 50);                             // the worst half-period
  r.until_tick(begin + stepped_ticks);                                  // and rest
}

constexpr std::int64_t net(int minute) { return 390'625 - 195'000 - minute + 60; }
constexpr std::int64_t edges_of(int minute) {
  return 390'625 + 195'000 + minute + 4 * 2500 + 60 + 500 + minute % 7 * 2;
}

/// What is kept of a stretch of minutes.
struct Segment {
  std::int64_t drift = 0;  ///< largest difference of position and counts fed, in any minute
  std::int64_t lost_ticks = 0, edges = 0, minutes = 0;
  std::int64_t velocity = 0, tau_hat = 0;              ///< largest at rest, raw
  std::int64_t first_velocity = 0, last_velocity = 0;  ///< of the first and the last minute
  int faults = 0, disarmed = 0;
  CoreOut begin, end;
};

Segment run_segment(int from, int to, const std::string& progress_file) {
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
    if (!progress_file.empty() && (m % 10 == 9 || m + 1 == to)) {
      std::ofstream(fmt::format("{}.{}", progress_file, from))
          << m + 1 - from << " of " << to - from << " minutes\n";
    }
  }
  s.edges = r.edges() - edges0;
  s.end = r.out();
  return s;
}

/// Signals that differ, the position left out: it is what the day is about.
double differing(const CoreOut& a, const CoreOut& b) {
  return static_cast<double>(
      (a.velocity != b.velocity) + (a.tau_hat != b.tau_hat) + (a.tau_ref != b.tau_ref) +
      (a.current_ref != b.current_ref) + (a.voltage != b.voltage) + (a.duty != b.duty) +
      (a.limits != b.limits) + (a.faults != b.faults) + (a.armed != b.armed));
}

Finding twin(const std::string& what, const std::string& unit, const Expected& expected,
             double value) {
  return finding(Cores::twin, what, unit, expected, value);
}

Outcome rest_period(const Settings& s) {
  Outcome o;
  LongRun stepped;
  stepped.turn(3000, 3000);
  stepped.wait(200'000);
  LongRun passed = stepped;
  stepped.wait(rest_period_ticks + (s.defect == 11 ? 7 : 0));
  for (LongRun* r : {&stepped, &passed}) {
    r->turn(-2000, 2500);
    r->dither(50, 767 * 50);
  }
  LongRun begun = passed;
  begun.wait(1);
  const std::int64_t later = (stepped.out().tick_count - passed.out().tick_count) & 0xffffffffu;
  o.findings.push_back(twin("ticks between the two", "tick",
                            exactly(static_cast<double>(rest_period_ticks)),
                            static_cast<double>(later)));
  // Every pin in every clock from here on, through a motion.
  std::int64_t differences = 0;
  const auto same = [](CoreOut a, CoreOut b) {
    a.tick_count = b.tick_count = 0;
    a.reg_rdata = b.reg_rdata = 0;
    return a == b;
  };
  for (int k = 0; k < 60; ++k) {
    stepped.turn(1, 12'345);
    passed.turn(1, 12'345);
    differences += same(stepped.out(), passed.out()) ? 0 : 1;
  }
  o.findings.push_back(twin("of 60 looks at every output, those that differ", "", exactly(0),
                            static_cast<double>(differences)));
  o.twin_s = static_cast<double>(stepped.stepped_ticks()) * 1e-6;
  o.note =
      "3.927 s of rest stepped tick by tick, and passed over; then the same motion. This is what "
      "the long case `day` passes over.";
  return o;
}

Outcome clock_of_the_simulator(const Settings& s) {
  Outcome o;
  // Microseconds in float32: the first one that cannot be added any more.
  const auto stands_still = [](float us) {
    const volatile float next = us + 1.0F;
    return next == us;
  };
  float us = 1;
  while (!stands_still(us)) us *= 2;
  Finding f{"a clock in microseconds stands still in float32: 2^24 us",
            "s",
            near(16.777216, s.defect == 11 ? -1 : 1e-9),
            {},
            {},
            1e-6 * static_cast<double>(us)};
  o.findings.push_back(f);
  const std::int64_t day_clocks = std::int64_t{86'400} * 50'000'000;
  o.findings.push_back(twin("clocks of a day as the simulator counts them, in 64-bit integers",
                            "clock", exactly(4.32e12), static_cast<double>(day_clocks)));
  return o;
}

Outcome day(const Settings& s) {
  Outcome o;
  Segment first, second;
  const int half = s.defect == 11 ? 2 : minutes / 2, end = s.defect == 11 ? 4 : minutes;
  std::thread other([&] { second = run_segment(half, end, s.progress_file); });
  first = run_segment(0, half, s.progress_file);
  other.join();
  std::int64_t edges = 0;
  for (int m = 0; m < end; ++m) edges += edges_of(m);
  const std::int64_t run = first.minutes + second.minutes;
  o.findings.push_back(twin("ticks of device time", "tick", exactly(86.4e9),
                            static_cast<double>(run * minute_ticks)));
  o.findings.push_back(twin("of them stepped; the others are whole periods of a core at rest",
                            "tick", exactly(static_cast<double>(minutes * stepped_ticks)),
                            static_cast<double>(run * stepped_ticks)));
  o.findings.push_back(twin("encoder edges fed", "", exactly(static_cast<double>(edges)),
                            static_cast<double>(first.edges + second.edges)));
  o.findings.push_back(twin("largest difference of position and counts fed, at any minute's end",
                            "count", exactly(0),
                            static_cast<double>(std::max(first.drift, second.drift))));
  o.findings.push_back(twin("ticks lost", "tick", exactly(0),
                            static_cast<double>(std::max(first.lost_ticks, second.lost_ticks))));
  const double lsb = std::ldexp(1.0, -Lever::f.velocity.fraction);
  const double a1 = std::ldexp(67092, -27);
  o.findings.push_back(twin("largest velocity left at rest: half an LSB over a1", "rad/s",
                            between(0, 0.5 / a1 * lsb),
                            lsb * static_cast<double>(std::max(first.velocity, second.velocity))));
  o.findings.push_back(twin("largest tau_hat left at rest: one LSB", "Nm", between(0, 1.0 / 65536),
                            static_cast<double>(std::max(first.tau_hat, second.tau_hat)) / 65536));
  o.findings.push_back(
      twin("velocity left after the last minute less that after the first", "rad/s", exactly(0),
           lsb * static_cast<double>(second.last_velocity - first.first_velocity)));
  o.findings.push_back(twin("faults, and minutes that ended disarmed", "", exactly(0),
                            first.faults | second.faults | first.disarmed | second.disarmed));
  o.findings.push_back(twin("signals that differ at the seam of the two segments", "", exactly(0),
                            differing(first.end, second.begin)));
  o.twin_s = static_cast<double>(run * minute_ticks) * 1e-6;
  o.note =
      "`lever`, armed, 1440 minutes: each 16.8 s of motion and rest stepped tick by tick "
      "(bursts at 599 rad/s, strokes at 19 rad/s, 100 counts a second, dither on one edge at the "
      "worst half-period), then 43.2 s of rest, 11 whole periods of 3.927 s after which a core at "
      "rest "
      "is where it was (rest_period shows one), passed over. Two segments of twelve hours; the "
      "second "
      "starts from reset with the last minute of the first, and the seam compares what both then "
      "show.";
  return o;
}

}  // namespace

std::vector<Case> day_cases() {
  return {
      {"A day", "rest_period",
       "A core at rest comes back to the same state after 767 x 1024 x 5 ticks.", false,
       rest_period},
      {"A day", "clock_of_the_simulator", "Time is an integer: a float would stand still.", false,
       clock_of_the_simulator},
      {"A day", "day", "24 hours: no count lost, no bias that grows.", true, day},
  };
}

}  // namespace feltgate::extremes
