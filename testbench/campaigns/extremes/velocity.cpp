// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extremes of the velocity: one count a second, an edge that dithers, the encoder's and the motor's
// highest speed. Documentation: docs/extremes.md
#include <cmath>

#include "campaigns/extremes/bench.hpp"
#include "feltgate/largest.hpp"

namespace feltgate::extremes {

namespace {

constexpr double count_rad = 6.283185307179586 / 4096;
constexpr double cutoff = 500.0;  // rad/s, of both designs

/// The N-method of a shipped design.
struct Window {
  double step_rad_s;  ///< 2^n
  double length_s;    ///< m1 ticks
  int ticks;
};
Window window(const std::string& design) {
  return design == "paper" ? Window{4, 386e-6, 386} : Window{2, 767e-6, 767};
}

/// Half an LSB over a1: the distance at which a rounding low-pass stops before its input.
double dead_band(const DesignInfo& d) {
  return 0.5 / -std::expm1(-cutoff / static_cast<double>(d.tick_hz)) *
         std::ldexp(1.0, -d.velocity.fraction);
}

Outcome one_count_per_second(const Settings&) {
  Outcome o;
  for (const char* design : {"paper", "lever"}) {
    const Window w = window(design);
    const std::string in = std::string(" (") + design + ")";
    Bench b(design, Cores::lock_step);
    b.run(10);
    b.move(b.now() + 7, 1);
    double peak = 0, real_peak = 0;
    std::int64_t at_peak = 0, fallen = 0, real_fallen = 0;
    b.run(b.ticks(12e-3), [&](const Sample& x) {
      if (x.core.velocity_rad_s > peak) at_peak = x.tick;
      peak = larger(peak, x.core.velocity_rad_s);
      real_peak = larger(real_peak, x.real.velocity_rad_s);
      if (fallen == 0 && peak > 0.1 && x.core.velocity_rad_s <= peak * std::exp(-1)) {
        fallen = x.tick - at_peak;
      }
      if (real_fallen == 0 && real_peak > 0.1 &&
          x.real.velocity_rad_s <= real_peak * std::exp(-1)) {
        real_fallen = x.tick - at_peak;
      }
    });
    b.report(&o);
    const double closed = w.step_rad_s * -std::expm1(-cutoff * w.length_s);
    o.add(Cores::lock_step, "peak after one count: 2^n (1 - exp(-wc m1 T))" + in, "rad/s",
          near(closed, 2e-3 * closed), peak, real_peak);
    o.add(Cores::lock_step, "falls to 1/e in 1/wc" + in, "ms", near(1e3 / cutoff, 0.01),
          static_cast<double>(fallen) * 1e-3, static_cast<double>(real_fallen) * 1e-3);
    // The mean over a second: the filter has gain 1, but stops half an LSB over a1 before its final
    // value.
    Bench day(design, Cores::twin);
    day.turn(0, 1.0, 3);
    double sum = 0, real_sum = 0;
    day.run(day.ticks(3.0), [&](const Sample& x) {
      if (x.tick < 2'000'000) return;
      sum += x.core.velocity_rad_s * 1e-6;
      real_sum += x.real.velocity_rad_s * 1e-6;
    });
    day.report(&o);
    const double mean = w.step_rad_s * w.length_s;
    o.add(Cores::twin, "mean over a second: 2^n m1 T, within the filter's dead band" + in, "rad/s",
          near(mean, dead_band(day.design())), sum, real_sum);
    o.add(Cores::twin, "gain error of the mean in double" + in, "%",
          near(100 * (mean / count_rad - 1), 0.01), 0, 100 * (real_sum / count_rad - 1));
    o.findings.back().twin.reset();
  }
  o.note =
      "RTL: one count and 12 ms after it; the twin alone: three seconds at one count a second.";
  return o;
}

/// Largest |velocity| over the last two periods of a dither of this half-period.
std::pair<double, double> dither(Bench& b, std::int64_t half_ticks, int* positions) {
  const std::int64_t periods = 2 + (b.ticks(16e-3) + 2 * half_ticks) / (2 * half_ticks);
  const Clock half = half_ticks * b.design().clocks_per_tick, begin = b.now() + 10;
  for (std::int64_t k = 0; k < 2 * periods; ++k) b.move(begin + k * half, k % 2 == 0 ? 1 : -1);
  double worst = 0, real = 0;
  std::int32_t low = 1 << 20, high = -(1 << 20);
  const std::int64_t first = 2 * half_ticks * (periods - 2);
  std::int64_t k = 0;
  b.run(2 * half_ticks * periods, [&](const Sample& x) {
    low = std::min(low, x.raw.position);
    high = std::max(high, x.raw.position);
    if (++k <= first) return;
    worst = larger(worst, std::abs(x.core.velocity_rad_s));
    real = larger(real, std::abs(x.real.velocity_rad_s));
  });
  *positions = high - low;
  return {worst, real};
}

Outcome dither_on_one_edge(const Settings&) {
  Outcome o;
  for (const char* design : {"paper", "lever"}) {
    const Window w = window(design);
    const std::string in = std::string(" (") + design + ")";
    // Half a period of one window: the raw velocity is a full square wave of +-2^n.
    const double worst = w.step_rad_s * std::tanh(cutoff * w.length_s / 2);
    int positions = 0;
    Bench b(design, Cores::lock_step);
    const auto [core, real] = dither(b, w.ticks, &positions);
    b.report(&o);
    o.add(Cores::lock_step, "range of the position" + in, "count", exactly(1), positions);
    o.add(Cores::lock_step,
          "peak velocity, half-period " + number(w.ticks) + " us: 2^n tanh(wc m1 T/2)" + in,
          "rad/s", near(worst, 4e-3 * worst), core, real);
    const auto worst_of = [&](const std::vector<int>& shares) {
      std::pair<double, double> all{0, 0};
      for (const int percent : shares) {
        Bench t(design, Cores::twin);
        const auto [c, r] = dither(t, w.ticks * percent / 100, &positions);
        all = {std::max(all.first, c), std::max(all.second, r)};
        t.report(&o);
      }
      return all;
    };
    const auto quick = worst_of({12, 25, 50, 75, 90});
    o.add(Cores::twin, "peak at half-periods of 0.12 to 0.9 windows" + in, "rad/s",
          at_most(1.004 * worst), quick.first, quick.second);
    const auto slow = worst_of({110, 150, 300, 700});
    o.add(Cores::twin, "peak at half-periods of 1.1 to 7 windows: single counts" + in, "rad/s",
          between(worst, w.step_rad_s * -std::expm1(-cutoff * w.length_s)), slow.first,
          slow.second);
  }
  o.note =
      "RTL: half a period of one window, the worst square wave. A slower dither shows single "
      "counts, "
      "whose peak is that of one_count_per_second; a quicker one less.";
  return o;
}

Outcome speed_613_6(const Settings&) {
  Outcome o;
  Bench b("lever", Cores::lock_step);
  b.set("overspeed", 700);
  const Window w = window("lever");
  const double speed = 613.6;
  b.run(4);
  b.turn(b.now(), speed / count_rad, std::llround(speed / count_rad * 30e-3));
  double sum = 0, real_sum = 0;
  std::int64_t n = 0, limits = 0;
  int faults = 0;
  b.run(b.ticks(29e-3), [&](const Sample& x) {
    faults |= x.raw.faults;
    if (x.tick < 21'000) return;
    sum += x.core.velocity_rad_s;
    real_sum += x.real.velocity_rad_s;
    limits += (x.raw.limits & limit::velocity) != 0 ? 1 : 0;
    ++n;
  });
  b.report(&o);
  const double exact = speed / count_rad * w.step_rad_s * w.length_s;
  const double k = 1.0 / static_cast<double>(n);
  o.add(Cores::lock_step, "mean velocity at 613.6 rad/s (100 kHz a channel)", "rad/s",
        near(exact, 0.05), sum * k, real_sum * k);
  o.add(Cores::lock_step, "ticks at the velocity's limit", "", exactly(0), limits);
  o.add(Cores::lock_step, "faults", "", exactly(0), faults);
  return o;
}

/// Response of window and low-pass to a step of the speed.
double estimate(double speed, double t, const Window& w) {
  const double tau = 1 / cutoff;
  const auto ramp = [&](double x) {
    return x <= 0 ? 0.0 : (x - tau * -std::expm1(-x / tau)) * speed / w.length_s;
  };
  return ramp(t) - ramp(t - w.length_s);
}

Outcome speed_795(const Settings&) {
  Outcome o;
  const Window w = window("lever");
  const double speed = 795;
  // The time at which the estimate crosses the limit of 613.6 rad/s.
  double low = 0, high = 0.02;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (estimate(speed, middle, w) < 613.6 ? low : high) = middle;
  }
  Bench b("lever", Cores::lock_step);
  b.arm("free");
  const Clock begin = b.now();
  b.turn(begin, speed / count_rad, std::llround(speed / count_rad * 25e-3));
  double at = -1, real_at = -1, last = 0, real_last = 0;
  int faults = 0;
  bool open = true;
  const std::int64_t first = begin / b.design().clocks_per_tick;
  b.run(b.ticks(24e-3), [&](const Sample& x) {
    const double t = static_cast<double>(x.tick - first) * 1e-6;
    if (at < 0 && x.raw.faults != 0) at = t;
    if (real_at < 0 && x.real.velocity_rad_s > 613.6) real_at = t;
    faults |= x.raw.faults;
    open = (x.raw.limits & limit::gates_closed) == 0;
    last = x.core.velocity_rad_s;
    real_last = x.real.velocity_rad_s;
  });
  b.report(&o);
  o.add(Cores::lock_step, "over-speed fault at 795 rad/s, from standstill", "ms",
        near(1e3 * low, 0.02), 1e3 * at, 1e3 * real_at);
  o.add(Cores::lock_step, "faults: bit 2 is speed", "", exactly(4), faults);
  o.add(Cores::lock_step, "gates open at the end", "", exactly(0), open);
  const double exact = speed / count_rad * w.step_rad_s * w.length_s;
  o.add(Cores::lock_step, "velocity at the end", "rad/s",
        near(exact, exact * std::exp(-cutoff * 23e-3) + w.step_rad_s), last, real_last);
  return o;
}

}  // namespace

std::vector<Case> velocity_cases() {
  return {
      {"Velocity", "one_count_per_second",
       "One count a second: a pulse, its decay, and the mean that the filter's dead band lets "
       "through.",
       one_count_per_second},
      {"Velocity", "dither_on_one_edge",
       "An edge that dithers: one count, and a velocity in closed form where half a period is one "
       "window.",
       dither_on_one_edge},
      {"Velocity", "speed_613_6", "The encoder's highest speed, inside every limit.", speed_613_6},
      {"Velocity", "speed_795",
       "The motor's no-load speed: the supervisor opens the bridge when the estimate crosses 613.6 "
       "rad/s.",
       speed_795},
  };
}

}  // namespace feltgate::extremes
