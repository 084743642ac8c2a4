// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extremes of the low-pass filters: dead bands per rounding mode, the dyadic trap, a pole of
// 1 - 5e-6, coefficients at 0 and at their largest. Documentation: docs/extremes.md
#include <Vfilter_convergent.h>
#include <Vfilter_down.h>
#include <Vfilter_half_up.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "campaigns/extremes/bench.hpp"
#include "campaigns/extremes/dead_band.hpp"
#include "design/design.hpp"
#include "feltgate/axis/velocity_estimator.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/largest.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/backends/rtl_model.hpp"

namespace feltgate::extremes {

namespace {

// The velocity estimator of lever alone: its low-pass, in three roundings. A count in the window
// is an input of 2^22 LSB of its state.
constexpr int fraction = Lever::P::velocity_a1.fraction;
constexpr double one = 1 << fraction;
constexpr std::int64_t count = std::int64_t{1} << 22;

/// The twin's law. Both filters begin at 0.
class FilterTwin {
 public:
  explicit FilterTwin(axis::Rounding rounding) : law_(design(rounding)) {}
  /// One sample of an input of so many counts; returns the new state.
  std::int64_t sample(std::int64_t counts, std::int64_t a1) {
    words_.velocity_a1 = a1;
    state_ = law_.tick(state_, words_, static_cast<std::int16_t>(counts));
    return state_.velocity;
  }

 private:
  using Law = axis::VelocityEstimator<axis::Fixed>;
  static axis::Design design(axis::Rounding rounding) {
    axis::Design d = axis::Design::of<Lever>();
    d.constants["ROUNDING"] = static_cast<std::int64_t>(rounding);
    return d;
  }
  Law law_;
  axis::Words<std::int64_t> words_;
  Law::State state_;
};

/// Rtl: Verilator's class with one of the roundings. One sample takes five clocks.
template <class Rtl>
class FilterAlone {
 public:
  FilterAlone() { rtl_.reset(1); }
  std::int64_t sample(std::int64_t counts, std::int64_t a1) {
    std::int16_t& travel = line_[place_];  // of a window ago
    travel = static_cast<std::int16_t>(travel + counts);
    place_ = (place_ + 1) % line_.size();
    rtl_->travel_i = static_cast<std::uint16_t>(travel);
    rtl_->a1_i = static_cast<std::uint32_t>(a1);
    for (int k = 0; k < 5; ++k) {
      rtl_->sample_i = k == 0;
      rtl_.clock();
    }
    ++samples_;
    return static_cast<std::int32_t>(rtl_->velocity_o);
  }
  double seconds() const { return static_cast<double>(samples_) * 5 * 20e-9; }

 private:
  RtlModel<Rtl> rtl_{1};
  std::vector<std::int16_t> line_ = std::vector<std::int16_t>(Lever::m1);
  std::size_t place_ = 0;
  std::int64_t samples_ = 0;
};

using FilterRtl = FilterAlone<Vfilter_half_up>;  // as in every shipped design

/// The values at which a filter comes to rest around an input, from below and from above.
struct Rest {
  std::int64_t low = 0, high = 0;
};

template <class Filter>
std::int64_t settled(Filter& filter, std::int64_t counts, std::int64_t a1) {
  std::int64_t y = filter.sample(counts, a1);
  for (std::int64_t before = y + 1; before != y;) {
    before = y;
    y = filter.sample(counts, a1);
  }
  return y;
}

template <class Filter>
Rest rest(Filter& filter, std::int64_t a1) {
  const std::int64_t low = settled(filter, 1, a1) - count;
  return {low, settled(filter, 0, a1)};
}
Rest twin_rest(axis::Rounding rounding, std::int64_t a1) {
  FilterTwin twin(rounding);
  return rest(twin, a1);
}
template <class Rtl>
Rest rtl_rest(std::int64_t a1) {
  FilterAlone<Rtl> rtl;
  return rest(rtl, a1);
}

/// Returns the least number of guard bits for which the band is below half an output LSB.
double guard_bits(const Rest& r) {
  const auto widest = static_cast<double>(std::max(-r.low, r.high));
  return std::floor(std::log2(2 * widest)) + 1;
}

/// Returns the final error for a constant input with `g` guard bits, in output LSB, from above.
double output_error(const Rest& r, int g) {
  return std::floor(std::ldexp(static_cast<double>(r.high), -g) + 0.5);
}

void add(Outcome* o, const std::string& what, const std::string& unit, const Expected& expected,
         std::optional<double> rtl, std::optional<double> twin, std::optional<double> real) {
  o->add(what, unit, expected, rtl, twin, real).real_may_differ = true;
}

Outcome dead_bands(const Settings&) {
  Outcome o;
  const std::int64_t a1 = std::llround(5e-4 * one);
  struct Mode {
    const char* name;
    Round round;
    axis::Rounding rounding;
    Rest (*rtl)(std::int64_t);
    double guard_bits;  ///< value in the documentation's table
  };
  using axis::Rounding;
  const Mode modes[] = {
      {"truncate", Round::truncate, Rounding::down, rtl_rest<Vfilter_down>, 12},
      {"half up", Round::half_up, Rounding::half_up, rtl_rest<Vfilter_half_up>, 11},
      {"convergent", Round::convergent, Rounding::half_to_even, rtl_rest<Vfilter_convergent>, 11}};
  for (const Mode& m : modes) {
    const Band expected = dead_band(m.round, a1, fraction);
    const Rest twin = twin_rest(m.rounding, a1), hardware = m.rtl(a1);
    const std::string name = std::string(", ") + m.name;
    add(&o, "lowest rest" + name, "state LSB", exactly(static_cast<double>(expected.low)),
        hardware.low, twin.low, 0);
    add(&o, "highest rest" + name, "state LSB", exactly(static_cast<double>(expected.high)),
        hardware.high, twin.high, 0);
    add(&o, "guard bits for less than half an output LSB" + name, "bit", exactly(m.guard_bits),
        guard_bits(hardware), guard_bits(twin), {});
  }
  o.note =
      "The filter alone, a1 = 5e-4 with 27 fraction bits. The band does not depend on the guard "
      "bits; in output LSB, G guard bits divide it by 2^G.";
  return o;
}

Outcome dyadic_trap(const Settings&) {
  Outcome o;
  const std::int64_t a1 = std::int64_t{1} << (fraction - 11);
  const Rest hardware = rtl_rest<Vfilter_half_up>(a1);
  const Rest twin = twin_rest(axis::Rounding::half_up, a1);
  add(&o, "highest rest, a1 = 2^-11: exactly half of 2^11", "state LSB", exactly(1024),
      hardware.high, twin.high, 0);
  add(&o, "lowest rest", "state LSB", exactly(-1023), hardware.low, twin.low, 0);
  for (const int g : {11, 12}) {
    add(&o, "lasting output error with " + number(g) + " guard bits", "output LSB",
        exactly(g == 11 ? 1 : 0), output_error(hardware, g), output_error(twin, g), 0);
  }
  add(&o, "the same, convergent, 11 guard bits", "output LSB", exactly(1),
      output_error(rtl_rest<Vfilter_convergent>(a1), 11),
      output_error(twin_rest(axis::Rounding::half_to_even, a1), 11), 0);
  const std::int64_t neighbour = std::llround(5e-4 * one);
  add(&o, "not dyadic, a1 = 5e-4, 11 guard bits", "output LSB", exactly(0),
      output_error(rtl_rest<Vfilter_half_up>(neighbour), 11),
      output_error(twin_rest(axis::Rounding::half_up, neighbour), 11), 0);
  o.note = "The filter alone.";
  return o;
}

Outcome slow_pole(const Settings&) {
  Outcome o;
  const std::int64_t a1 = std::llround(5e-6 * one);
  const double a = static_cast<double>(a1) / one;
  const Rest hardware = rtl_rest<Vfilter_half_up>(a1);
  const Rest twin = twin_rest(axis::Rounding::half_up, a1);
  const Band band = dead_band(Round::half_up, a1, fraction);
  add(&o, "highest rest: 1/(2 a1)", "state LSB", exactly(static_cast<double>(band.high)),
      hardware.high, twin.high, 0);
  add(&o, "guard bits for less than half an output LSB", "bit", exactly(18), guard_bits(hardware),
      guard_bits(twin), {});
  add(&o, "a1 with 16 fraction bits", "", exactly(0), {}, std::llround(5e-6 * 65536), 5e-6);
  // Settling of the filter alone, sample by sample; double computes the same recurrence.
  constexpr std::int64_t counts = 239, step = counts * count;
  FilterRtl rtl;
  FilterTwin filter(axis::Rounding::half_up);
  std::int64_t core_settled = 0, rtl_settled = 0, real_settled = 0;
  double real = 0;
  for (std::int64_t k = 1; k <= 900'000; ++k) {
    const std::int64_t h = rtl.sample(counts, a1);
    const std::int64_t y = filter.sample(counts, a1);
    real += a * (static_cast<double>(step) - real);
    if (h < step / 50 * 49) rtl_settled = k;
    if (y < step / 50 * 49) core_settled = k;
    if (real < static_cast<double>(step) * 0.98) real_settled = k;
    o.mismatches += h == y ? 0 : 1;
  }
  const double samples = std::log(0.02) / std::log1p(-a);
  o.add("2 % settling of a step: ln 50 / 5 rad/s at 1 MHz", "s", near(samples * 1e-6, 1e-5),
        static_cast<double>(rtl_settled) * 1e-6, static_cast<double>(core_settled) * 1e-6,
        static_cast<double>(real_settled) * 1e-6);
  // The whole core with that coefficient in its register: a steady 20 rad/s.
  Bench b("paper", Cores::twin);
  b.set("velocity_a1", 5e-6);
  b.run(4);
  const double rate = 20 / (6.283185307179586 / 4096);
  const Clock begin = b.now();
  b.turn(begin, rate, std::llround(rate * 1.0));
  const double raw = rate * 4 * 386e-6;
  double at = 0, real_at = 0;
  const std::int64_t first = begin / b.design().clocks_per_tick;
  b.run(b.ticks(0.95), [&](const Sample& x) {
    const double t = static_cast<double>(x.tick - first) * 1e-6;
    if (x.core.velocity_rad_s < 0.98 * raw) at = t;
    if (x.real.velocity_rad_s < 0.98 * raw) real_at = t;
  });
  b.report(&o);
  // The core's velocity is half a window later. One count in the window changes the raw velocity by
  // 4 rad/s, and the filtered one by 0.02.
  o.add(Cores::twin, "2 % settling of the core's velocity", "s",
        near(samples * 1e-6 + 193e-6, 3e-3), at, real_at);
  o.rtl_s += rtl.seconds();
  o.note = "RTL: the filter alone, 0.9 million samples; the twin also as the whole core.";
  return o;
}

Outcome coefficient_zero(const Settings&) {
  Outcome o;
  Bench b("paper", Cores::lock_step);
  for (std::size_t i = 0; i < b.design().parameters.size(); ++i) {
    const ParameterInfo& p = b.design().parameters[i];
    // Only the coefficients change; limits and scene geometry stay.
    if (std::string(p.unit).find('/') == std::string::npos && std::string(p.unit) != "1") continue;
    if (std::string(p.name) != "ramp_step") b.set(p.name, 0);
  }
  b.set("ramp_step", 1);
  b.set("setpoint_torque", 0.3);
  b.run(60);
  b.arm("setpoint");
  b.turn(b.now(), 20000, 100);
  double velocity = 0, current = 0, tau_hat = 0;
  int faults = 0;
  b.run(b.ticks(6e-3), [&](const Sample& x) {
    velocity = larger(velocity, std::abs(x.core.velocity_rad_s));
    tau_hat = larger(tau_hat, std::abs(x.core.tau_hat_nm));
    current = larger(current, std::abs(x.core.current_a));
    faults |= x.raw.faults;
  });
  b.report(&o);
  for (const auto& [what, unit, value] :
       {std::tuple{"largest velocity with a1 = 0 while 100 counts pass", "rad/s", velocity},
        {"largest tau_hat", "Nm", tau_hat},
        {"largest current at a reference of 0.3 Nm with all gains 0", "A", current}}) {
    o.add(Cores::lock_step, what, unit, exactly(0), value);
  }
  o.add(Cores::lock_step, "faults", "", exactly(0), faults);
  return o;
}

Outcome coefficient_max(const Settings&) {
  Outcome o;
  Bench b("paper", Cores::lock_step);
  double a1_max = 0;
  for (std::size_t i = 0; i < b.design().parameters.size(); ++i) {
    const ParameterInfo& p = b.design().parameters[i];
    const int mantissa = p.format.width() - p.format.sign;
    if (mantissa != 17 || p.address >= 64) continue;  // a coefficient
    const double largest = std::ldexp(131071.0, -p.format.fraction);
    if (std::string(p.name) == "velocity_a1") a1_max = largest;
    b.set(p.name, largest);
  }
  b.set("setpoint_torque", 0.5);
  b.run(60);
  b.arm("setpoint");
  b.run(b.ticks(2e-3));
  const double current_limit = 8.264463, voltage_limit = 24;
  b.move(b.now() + 10, 1);
  double peak = 0, current = 0, voltage = 0;
  std::int64_t at = 0, fallen = 0, duty = 0;
  b.run(b.ticks(8e-3), [&](const Sample& x) {
    if (x.core.velocity_rad_s > peak) {
      peak = x.core.velocity_rad_s;
      at = x.tick;
    } else if (peak > 0 && fallen == 0 && x.core.velocity_rad_s <= peak * std::exp(-1)) {
      fallen = x.tick - at;
    }
    current = larger(current, std::abs(x.core.current_a));
    voltage = larger(voltage, std::abs(x.core.voltage_v));
    duty = std::max<std::int64_t>(duty, std::abs(x.raw.duty));
  });
  b.report(&o);
  o.add(Cores::lock_step, "velocity falls to 1/e with the largest a1: -1/ln(1 - a1)", "ms",
        near(-1e-3 / std::log1p(-a1_max), 2e-3), static_cast<double>(fallen) * 1e-3);
  o.add(Cores::lock_step, "largest current, its limit", "A", near(current_limit, 1e-4), current);
  o.add(Cores::lock_step, "largest voltage, its limit", "V", at_most(voltage_limit), voltage);
  o.add(Cores::lock_step, "largest duty, its limit", "clock", at_most(b.design().pwm_period), duty);
  o.note = "Every coefficient word at 131071 at once.";
  return o;
}

Outcome coefficient_bits(const Settings& s) {
  Outcome o;
  // The slowest filter that a design may have; the fraction bits of the state set it.
  const auto registers = design::read_registers(s.root + "/rtl/registers.toml");
  const auto accepted = [&](double cutoff, int fraction_bits) {
    design::Design d = design::read_design(s.root + "/rtl/designs/lever.toml");
    d.observer_cutoff_rad_s = cutoff;
    d.observer_fraction = fraction_bits;
    try {
      elaborate(d, registers);
      return true;
    } catch (const config::ConfigError&) {
      return false;
    }
  };
  const int torque_bits = 16;
  for (const double cutoff : {500.0, 50.0}) {
    const int need =
        torque_bits + static_cast<int>(std::ceil(-std::log2(-std::expm1(-cutoff * 1e-6))));
    int least = 99;
    for (int f = 40; f >= 17; --f) {
      if (accepted(cutoff, f)) least = f;
    }
    add(&o,
        "least fraction bits of the observer's state at " + number(cutoff) +
            " rad/s: 16 + ceil(log2(1/a1))",
        "bit", exactly(need), {}, least, {});
  }
  // A coefficient of 17 bits with the binary point where it is best: the pole's error.
  for (const double cutoff : {500.0, 5.0}) {
    const double a1 = -std::expm1(-cutoff * 1e-6);
    const Format f = design::coefficient_format(a1, false);
    const double stored =
        std::ldexp(static_cast<double>(std::llround(std::ldexp(a1, f.fraction))), -f.fraction);
    add(&o, "relative error of the stored pole at " + number(cutoff) + " rad/s: 2^-17", "",
        between(-std::exp2(-17), std::exp2(-17)), {}, (stored - a1) / a1, 0);
  }
  o.note = "What the generator accepts; nothing runs.";
  return o;
}

}  // namespace

std::vector<Case> filter_cases() {
  return {
      {"Filters", "dead_bands",
       "Where y += round(a1 (x - y)) stops short of its input: |a1 d| rounds to 0. In double it "
       "stops nowhere.",
       dead_bands},
      {"Filters", "dyadic_trap",
       "With a1 a power of two the band is exactly half an LSB, and one guard bit more is needed.",
       dyadic_trap},
      {"Filters", "slow_pole", "A pole of 1 - 5e-6: 18 guard bits, and 0.78 s to settle.",
       slow_pole},
      {"Filters", "coefficient_zero", "Every coefficient 0: filters that stand still, no torque.",
       coefficient_zero},
      {"Filters", "coefficient_max",
       "Every coefficient at its largest word: the limits hold and the filter is as quick as the "
       "word says.",
       coefficient_max},
      {"Filters", "coefficient_bits",
       "Too few bits: what a design is refused for, and what 17 bits of mantissa cost.",
       coefficient_bits},
  };
}

}  // namespace feltgate::extremes
