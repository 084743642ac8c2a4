// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// current_control around the averaged winding of `lever`: steps with other windings, and what other
// ways against wind-up make of a step that is limited. docs/blocks/current_control.md
#include <fmt/format.h>

#include <cmath>

#include "catch.hpp"
#include "feltgate/current_control.hpp"
#include "feltgate/largest.hpp"
#include "page_figures.hpp"

using namespace feltgate;

namespace {

constexpr double kOhm = 0.42, kHenry = 82e-6, kSupplyV = 24, kFullScaleA = 32, kPeriodS = 20e-6;
constexpr double kHz = 2000, kLimitV = 0.95 * kSupplyV;

/// The block, in volts and amperes.
class Block {
 public:
  explicit Block(double bandwidth_hz) {
    const CurrentGains gains =
        current_gains(kOhm, kHenry, bandwidth_hz, kPeriodS, kFullScaleA, kSupplyV);
    in_.armed = true;
    in_.proportional = gains.proportional;
    in_.integral = gains.integral;
    in_.limit = word(kLimitV / kSupplyV);
  }
  double operator()(double reference_a, double current_a, double emf_v) {
    in_.reference = word(reference_a / kFullScaleA);
    in_.current = word(current_a / kFullScaleA);
    in_.emf = word(emf_v / kSupplyV);
    for (int clock = 0; clock < CurrentControl::kBusyClocks; ++clock) {
      in_.valid = clock == 0;
      twin_.clock(in_);
    }
    return kSupplyV * std::ldexp(twin_.out().voltage, -17);
  }

 private:
  static std::int32_t word(double part) {
    return static_cast<std::int32_t>(std::lround(std::ldexp(part, 17)));
  }
  CurrentControl twin_;
  CurrentControl::In in_;
};

/// The same gains in double, with other ways against wind-up.
struct Other {
  enum Way { none, frozen, back_calculated } way;
  double bandwidth_hz, integral = 0;
  double operator()(double reference_a, double current_a, double emf_v) {
    const double part = -std::expm1(-kOhm * kPeriodS / kHenry);
    const double proportional =
        2 * M_PI * bandwidth_hz * kPeriodS * kOhm / part * (reference_a - current_a);
    const double wanted = proportional + integral + emf_v;
    const double applied = std::fmax(-kLimitV, std::fmin(kLimitV, wanted));
    if (way == none || applied == wanted) {
      integral += part * proportional;
    } else if (way == back_calculated) {
      integral = applied - emf_v - proportional;
    }
    return applied;
  }
};

struct Step {
  double settled_ms = 0, overshoot = 0;  // 2 %, part of the step
};

/// A current is sampled in the middle of each period; its voltage acts from the next one's start.
template <class Control>
Step step(Control control, double amperes, double emf_v, double ohm = kOhm, double henry = kHenry) {
  constexpr int kSteps = 200;  // in half a period
  const double part = -std::expm1(-ohm / henry * kPeriodS / 2 / kSteps);
  Step found;
  double current = 0, applied = emf_v;
  for (int period = 0; period < 100; ++period) {
    const double next = control(amperes, current, emf_v);
    for (int k = 0; k < 2 * kSteps; ++k) {
      if (k == kSteps) applied = next;
      current += part * ((applied - emf_v) / ohm - current);
      const double now_ms = 1e3 * kPeriodS * (period + (k + 1.0) / (2 * kSteps));
      if (std::fabs(current - amperes) > 0.02 * amperes) found.settled_ms = now_ms;
      found.overshoot = larger(found.overshoot, current / amperes - 1);
    }
  }
  CHECK(std::fabs(current - amperes) < 0.001);
  return found;
}

}  // namespace

TEST_CASE("current_control: steps of the averaged winding", "[figures]") {
  std::string figures =
      "| winding | 2 % after a step of 1 A, ms | of 16.6 A | overshoot |\n|---|---|---|---|\n";
  const struct {
    const char* name;
    double ohm, henry;
  } windings[] = {
      {"as the gains have it", 1, 1}, {"R -20 %", 0.8, 1}, {"R +20 %", 1.2, 1},
      {"L -33 %", 1, 0.67},           {"L +50 %", 1, 1.5}, {"R -20 %, L +50 %", 0.8, 1.5}};
  for (const auto& [name, ohm, henry] : windings) {
    const Step small = step(Block(kHz), 1, 0, ohm * kOhm, henry * kHenry);
    const Step large = step(Block(kHz), 16.6, 0, ohm * kOhm, henry * kHenry);
    CHECK(large.overshoot < 0.1);
    CHECK(small.settled_ms < 0.75);
    if (ohm == 1 && henry == 1) {
      CHECK(small.settled_ms <= 0.35);
      CHECK(large.settled_ms <= 0.35);
      CHECK(large.overshoot < 0.001);
    }
    figures += fmt::format("| {} | {:.3f} | {:.3f} | {:.1f} % |\n", name, small.settled_ms,
                           large.settled_ms, 100 * large.overshoot);
  }
  figures +=
      "\n| limited, 2 % and overshoot | 30 A at rest | 16.6 A at 12 V of back-EMF | the same, 5 "
      "kHz "
      "|\n|---|---|---|---|\n";
  const auto row = [&figures](const char* name, const auto& control) {
    const Step cases[] = {step(control(kHz), 30, 0), step(control(kHz), 16.6, 12),
                          step(control(5000), 16.6, 12)};
    figures += fmt::format("| {} ", name);
    for (const Step& one : cases) {
      figures += fmt::format("| {:.3f} ms, {:.1f} % ", one.settled_ms, 100 * one.overshoot);
    }
    figures += "|\n";
    return cases[0].settled_ms;
  };
  const double here = row("this block", [](double hz) { return Block(hz); });
  for (const auto& [name, way] :
       {std::pair("integrator frozen while limited", Other::frozen),
        std::pair("integrator set to what the limit leaves", Other::back_calculated),
        std::pair("nothing", Other::none)}) {
    CHECK(here < 0.7 * row(
                           name,
                           [way = way](double hz) {
                             return Other{way, hz};
                           }));
  }
  test::check_page_figures("current_control", figures);
}
