// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extremes of the low-pass filters: dead bands per rounding mode, the dyadic trap, a pole of
// 1 - 5e-6, coefficients at 0 and at their largest. Documentation: docs/extremes.md
#include <Vlowpass.h>
#include <Vlowpass_convergent.h>
#include <Vlowpass_truncate.h>

#include <cmath>
#include <cstdint>

#include "campaigns/extremes/bench.hpp"
#include "campaigns/extremes/dead_band.hpp"
#include "design/design.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/lowpass.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/backends/rtl_model.hpp"

namespace feltgate::extremes {

namespace {

// The low-pass alone at its default widths. Each rounding mode has its own RTL class. One sample
// takes six clocks.
constexpr Format lowpass_state{1, 31, 0}, lowpass_operand{1, 32, 0}, lowpass_a1{0, -10, 27};

/// The twin's law.
template <Round R>
class LowpassTwin {
 public:
  void start(std::int64_t y) { y_ = y; }
  std::int64_t sample(std::int64_t x, std::int64_t a1) {
    using Law = LowpassLaw<Fixed, lowpass_state.key(), lowpass_operand.key(), R>;
    using A1 = fixed_of<lowpass_a1.key()>;
    const auto word = [](std::int64_t raw) {
      return Law::State::from_raw(static_cast<typename Law::State::raw_type>(raw));
    };
    y_ = Law::template step<lowpass_a1.key()>(word(x), word(y_),
                                              A1::from_raw(static_cast<typename A1::raw_type>(a1)))
             .raw();
    return y_;
  }

 private:
  std::int64_t y_ = 0;
};

/// Rtl is Verilator's class of lowpass with one rounding mode.
template <class Rtl>
class LowpassAlone {
 public:
  LowpassAlone() { rtl_.reset(1); }

  /// Sets the state to `y`.
  void start(std::int64_t y) { sample(y, 0, true); }
  /// Runs one sample; returns the new state.
  std::int64_t sample(std::int64_t x, std::int64_t a1, bool follow = false) {
    rtl_->x_i = static_cast<std::uint32_t>(x);
    rtl_->follow_i = follow;
    rtl_->valid_i = 1;
    edge();
    rtl_->valid_i = 0;
    // 33 bits of difference times the coefficient, as the shared multiplier computes it.
    const std::int64_t operand = static_cast<std::int64_t>(rtl_->operand_o << 31) >> 31;
    for (int k = 0; k < 4; ++k) edge();
    rtl_->product_i = static_cast<std::uint64_t>(operand * a1) & ((std::uint64_t{1} << 53) - 1);
    rtl_->update_i = 1;
    edge();
    rtl_->update_i = 0;
    return static_cast<std::int32_t>(rtl_->y_o);
  }
  double seconds() const { return static_cast<double>(clocks_) * 20e-9; }

 private:
  void edge() {
    rtl_.clock();
    ++clocks_;
  }

  RtlModel<Rtl> rtl_{1};
  std::int64_t clocks_ = 0;
};

using LowpassRtl = LowpassAlone<Vlowpass>;  ///< half up, as in every shipped design

constexpr int fraction = lowpass_a1.fraction;
constexpr double one = 1 << fraction;

/// The values at which a filter comes to rest around an input, from above and from below.
struct Rest {
  std::int64_t low = 0, high = 0;
};

/// Runs from the state y until the filter stands still.
template <class Filter>
std::int64_t settled(Filter& filter, std::int64_t y, std::int64_t x, std::int64_t a1) {
  filter.start(y);
  for (std::int64_t before = y + 1; before != y;) {
    before = y;
    y = filter.sample(x, a1);
  }
  return y;
}

template <class Filter>
Rest rest(Filter& filter, std::int64_t input, std::int64_t a1) {
  Rest r;
  // Starts on both sides, some beyond the band and some inside it.
  for (const std::int64_t offset : {-3000000, -1500, 1500, 3000000}) {
    const std::int64_t off = settled(filter, input + offset, input, a1) - input;
    r.low = std::min(r.low, off);
    r.high = std::max(r.high, off);
  }
  return r;
}

template <Round R>
Rest twin_rest(std::int64_t input, std::int64_t a1) {
  LowpassTwin<R> twin;
  return rest(twin, input, a1);
}

/// Returns the least number of guard bits for which the band is below half an output LSB.
double guard_bits(const Rest& r) {
  const auto widest = static_cast<double>(std::max(-r.low, r.high));
  return std::floor(std::log2(2 * widest)) + 1;
}

struct Mode {
  const char* name;
  Round round;
  Rest (*twin)(std::int64_t, std::int64_t);
  double guard_bits;  ///< value in the documentation's table
};

void add(Outcome* o, const std::string& what, const std::string& unit, const Expected& expected,
         std::optional<double> rtl, std::optional<double> twin, std::optional<double> real) {
  o->add(what, unit, expected, rtl, twin, real).real_may_differ = true;
}

Outcome dead_bands(const Settings&) {
  Outcome o;
  const std::int64_t a1 = std::llround(5e-4 * one);
  const Mode modes[] = {{"truncate", Round::truncate, twin_rest<Round::truncate>, 12},
                        {"half up", Round::half_up, twin_rest<Round::half_up>, 11},
                        {"convergent", Round::convergent, twin_rest<Round::convergent>, 11}};
  LowpassRtl half_up;
  LowpassAlone<Vlowpass_truncate> truncate;
  LowpassAlone<Vlowpass_convergent> convergent;
  for (const Mode& m : modes) {
    const Band expected = dead_band(m.round, a1, fraction);
    const Rest twin = m.twin(40000, a1);
    const Rest hardware = m.round == Round::half_up    ? rest(half_up, 40000, a1)
                          : m.round == Round::truncate ? rest(truncate, 40000, a1)
                                                       : rest(convergent, 40000, a1);
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

/// Returns the final error for a constant input with `g` guard bits, in output LSB, starting 100
/// LSB above.
template <class Filter>
double output_error(Filter& filter, std::int64_t a1, int g) {
  const std::int64_t lsb = std::int64_t{1} << g;
  const auto y = static_cast<double>(settled(filter, 105 * lsb, 5 * lsb, a1));
  return std::floor(y / static_cast<double>(lsb) + 0.5) - 5;
}

Outcome dyadic_trap(const Settings&) {
  Outcome o;
  const std::int64_t a1 = std::int64_t{1} << (fraction - 11);
  LowpassRtl rtl;
  LowpassTwin<Round::half_up> half_up;
  LowpassAlone<Vlowpass_convergent> convergent;
  LowpassTwin<Round::convergent> convergent_twin;
  const Rest hardware = rest(rtl, 40000, a1), twin = rest(half_up, 40000, a1);
  add(&o, "highest rest, a1 = 2^-11: exactly half of 2^11", "state LSB", exactly(1024),
      hardware.high, twin.high, 0);
  add(&o, "lowest rest", "state LSB", exactly(-1023), hardware.low, twin.low, 0);
  for (const int g : {11, 12}) {
    add(&o, "lasting output error with " + number(g) + " guard bits", "output LSB",
        exactly(g == 11 ? 1 : 0), output_error(rtl, a1, g), output_error(half_up, a1, g), 0);
  }
  add(&o, "the same, convergent, 11 guard bits", "output LSB", exactly(1),
      output_error(convergent, a1, 11), output_error(convergent_twin, a1, 11), 0);
  const std::int64_t neighbour = std::llround(5e-4 * one);
  add(&o, "not dyadic, a1 = 5e-4, 11 guard bits", "output LSB", exactly(0),
      output_error(rtl, neighbour, 11), output_error(half_up, neighbour, 11), 0);
  o.note = "The filter alone.";
  return o;
}

Outcome slow_pole(const Settings&) {
  Outcome o;
  const std::int64_t a1 = std::llround(5e-6 * one);
  const double a = static_cast<double>(a1) / one;
  LowpassRtl rtl;
  const Rest hardware = rest(rtl, 40000, a1), twin = twin_rest<Round::half_up>(40000, a1);
  const Band band = dead_band(Round::half_up, a1, fraction);
  add(&o, "highest rest: 1/(2 a1)", "state LSB", exactly(static_cast<double>(band.high)),
      hardware.high, twin.high, 0);
  add(&o, "guard bits for less than half an output LSB", "bit", exactly(18), guard_bits(hardware),
      guard_bits(twin), {});
  add(&o, "a1 with 16 fraction bits", "", exactly(0), {}, std::llround(5e-6 * 65536), 5e-6);
  // Settling of the filter alone, sample by sample; double computes the same recurrence.
  const std::int64_t step = 1'000'000'000;
  LowpassTwin<Round::half_up> filter;
  rtl.start(0);
  filter.start(0);
  std::int64_t core_settled = 0, rtl_settled = 0, real_settled = 0;
  double real = 0;
  for (std::int64_t k = 1; k <= 900'000; ++k) {
    const std::int64_t h = rtl.sample(step, a1);
    const std::int64_t y = filter.sample(step, a1);
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
  for (int i = 0; i < b.design().parameter_count; ++i) {
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
  for (int i = 0; i < b.design().parameter_count; ++i) {
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
