// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The current loop beside a plain PI in double around an averaged winding, and beside closed forms
// that are written again here. Documentation: docs/controllers.md
#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>
#include <vector>

#include "catch.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/controllers/current_loop.hpp"

using namespace feltgate;
using namespace feltgate::controllers;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kKt = 0.0302, kR = 0.42, kL = 82.3e-6, kV = 24, kClock = 20e-9;
constexpr int kPeriod = 1000;  // clocks

const Bench& bench() {
  static const std::string root = FELTGATE_ROOT;
  static const Bench b{design::elaborate(design::read_design(root + "/rtl/designs/lever.toml"),
                                         design::read_registers(root + "/rtl/registers.toml")),
                       plant::read_plant_file(root + "/vectors/plants/p24.toml"),
                       plant::read_plant_file(root + "/vectors/plants/linear.toml")};
  return b;
}

CurrentSetting setting(double bandwidth_hz = 2000) {
  CurrentSetting s;
  s.plant = bench().plant;
  s.bandwidth_hz = bandwidth_hz;
  return s;
}

/// A PI in double: it cancels the winding's pole, samples in the middle of the pulse, and acts from
/// the next pulse on. All pulses are equally wide and as high as it takes: no PWM, and no
/// modulator.
class PlainLoop {
 public:
  explicit PlainLoop(double bandwidth_hz) {
    const double pole = std::exp(-kR * kPeriod * kClock / kL);
    gain_ohm_ = 2 * kPi * bandwidth_hz * kPeriod * kClock * kR / (1 - pole);
    share_ = 1 - pole;
  }
  double clock(double reference_a) {
    const int at = clock_++ % kPeriod;
    if (at == 516) sampled_a_ = current_a_;
    if (at == 914) {  // 397 clocks from the middle of the window, and one to be taken
      const double by_error = gain_ohm_ * (reference_a - sampled_a_);
      next_v_ = integral_v_ + by_error;
      integral_v_ += share_ * by_error;
    }
    if (at == 16) voltage_v_ = next_v_;
    const double volts = std::abs(at - 516) < kWidth / 2 ? voltage_v_ * kPeriod / (kWidth - 1) : 0;
    current_a_ += (volts / kR - current_a_) * -std::expm1(-kR * kClock / kL);
    return current_a_;
  }

 private:
  static constexpr int kWidth = 290;  // clocks
  double gain_ohm_, share_, sampled_a_ = 0, next_v_ = 0, voltage_v_ = 0, integral_v_ = 0;
  double current_a_ = 0;
  int clock_ = 0;
};

/// Until the mean over a period is within 2 % of 1, ms; the worst of ten phases.
double plain_settling_ms(double bandwidth_hz) {
  double worst = 0;
  for (int phase = 0; phase < 10; ++phase) {
    PlainLoop loop(bandwidth_hz);
    for (int c = 0; c < 100 * phase; ++c) loop.clock(0);
    std::vector<double> all(kPeriod, 0.0);
    double sum = 0;
    for (int c = 1; c < 100'000; ++c) {
      all.push_back(loop.clock(1));
      sum += all.back() - all[all.size() - 1 - kPeriod];
      if (std::fabs(sum / kPeriod - 1) > 0.02) worst = std::max(worst, c * kClock * 1e3);
    }
  }
  return worst;
}

std::complex<double> plain_response(double bandwidth_hz, double hz) {
  PlainLoop loop(bandwidth_hz);
  std::complex<double> in, out;
  const int one = static_cast<int>(std::lround(1 / (hz * kClock)));
  const int begin = (100'000 / one + 1) * one, end = begin + (200'000 / one + 1) * one;
  for (int c = 0; c < end; ++c) {
    const double at = 2 * kPi * c / one, reference = std::sin(at);
    const double current = loop.clock(reference);
    if (c < begin) continue;
    in += reference * std::polar(1.0, -at);
    out += current * std::polar(1.0, -at);
  }
  return out / in;
}

const CurrentReport& report() {
  static const CurrentReport all = measure_current(bench());
  return all;
}
const CurrentFigure& figure(const std::string& key) {
  for (const CurrentFigure& f : report().figures) {
    if (f.key == key) return f;
  }
  throw std::invalid_argument(key);
}
/// The figure is `form` within `margin`, and so is what stands beside it.
void check(const std::string& key, double form, double margin) {
  INFO(key << ": " << figure(key).measured << " beside " << figure(key).form << ", here " << form);
  CHECK(std::fabs(figure(key).measured - form) <= margin);
  CHECK(std::fabs(figure(key).form - form) <= 0.02 * std::fabs(form) + 1e-9);
  CHECK_FALSE(figure(key).bound);
}
void check_bound(const std::string& key, double least, double most) {
  INFO(key << ": " << figure(key).measured << " of at most " << figure(key).form << ", here "
           << most);
  CHECK(figure(key).measured >= least);
  CHECK(figure(key).measured <= most);
  CHECK(std::fabs(figure(key).form / most - 1) < 0.02);
  CHECK(figure(key).bound);
}

}  // namespace

TEST_CASE("current loop: it settles as a plain PI around an averaged winding", "[current]") {
  const double plain_ms = plain_settling_ms(2000), lag_ms = 1e3 * std::log(50) / (2 * kPi * 2000);
  CHECK(lag_ms == Approx(0.3113).margin(1e-4));
  // The delay of a loop that does not swing makes it faster than a lag.
  CHECK(plain_ms < lag_ms);
  for (const char* key : {"settling_ms", "settling_full_ms"}) {
    INFO(key << ": " << figure(key).measured << ", plain " << plain_ms);
    CHECK(figure(key).measured == Approx(plain_ms).epsilon(0.03));
    CHECK(figure(key).measured <= 0.35);
    CHECK(figure(key).form == Approx(lag_ms));
  }
  // The current goes through zero, where the lost voltage turns.
  CHECK(figure("settling_reversal_ms").measured == Approx(plain_ms).epsilon(0.15));
  CHECK(figure("settling_reversal_ms").measured <= 0.35);
  check("overshoot_pct", 0, 0.3);
  const CurrentStep fast = current_step(bench(), setting(1000), 0.1, 0.2);
  CHECK(fast.settling_ms == Approx(plain_settling_ms(1000)).epsilon(0.03));
}

TEST_CASE("current loop: what is not fed forward is found by the winding's own pole", "[current]") {
  // 0.34 V of brushes; 0.5 us at 50 kHz of 24 V and two diodes.
  const double lost_v = 0.34 + 0.5e-6 * 50e3 * (kV + 1.4), w = 2 * kPi * 2000, a = kR / kL;
  const double step_a = 0.2 / kKt, slow_a = lost_v / kL / (w - a);
  double t = 0;
  while (slow_a * std::exp(-a * t) + (step_a - slow_a) * std::exp(-w * t) > 0.02 * step_a)
    t += 1e-6;
  check("settling_blind_ms", 1e3 * t, 0.03);
  CHECK(figure("settling_blind_ms").measured > 1.7 * figure("settling_ms").measured);
}

TEST_CASE("current loop: its frequency response is that of the averaged winding", "[current]") {
  for (const double bandwidth_hz : {2000.0, 5000.0}) {
    for (const double hz : {490.0, 1970.0, 4930.0, 7930.0}) {
      const CurrentSine sine = current_sine(bench(), setting(bandwidth_hz), hz);
      const std::complex<double> plain = plain_response(bandwidth_hz, sine.hz);
      const double db = 20 * std::log10(std::abs(plain));
      double degrees = 180 / kPi * std::arg(plain);
      if (degrees > 90) degrees -= 360;
      INFO(bandwidth_hz << ", " << hz << ": " << sine.gain_db << " dB, " << sine.phase_deg
                        << " degrees; plain " << db << ", " << degrees);
      CHECK(std::fabs(sine.gain_db - db) < 0.15);
      CHECK(std::fabs(sine.phase_deg - degrees) < 1);
      CHECK(std::fabs(sine.form_gain_db - db) < 0.1);
      CHECK(std::fabs(sine.form_phase_deg - degrees) < 0.7);
    }
    const std::string of = bandwidth_hz == 2000 ? "_2_khz" : "_5_khz";
    const CurrentFigure &gain = figure("minus_3_db" + of), &phase = figure("minus_90_deg" + of);
    for (const double khz : {gain.measured, gain.form}) {
      INFO(khz << " kHz");
      CHECK(std::abs(plain_response(bandwidth_hz, 1e3 * khz)) ==
            Approx(std::sqrt(0.5)).epsilon(0.03));
    }
    for (const double khz : {phase.measured, phase.form}) {
      INFO(khz << " kHz");
      CHECK(std::arg(plain_response(bandwidth_hz, 1e3 * khz)) == Approx(-kPi / 2).epsilon(0.02));
    }
  }
  // A first-order lag would be -3 dB at 2 kHz and never at -90 degrees.
  CHECK(figure("minus_3_db_2_khz").measured > 2);
}

TEST_CASE("current loop: R is corrected, and a growing back-EMF is followed", "[current]") {
  check("error_pct", 0, 0.05);
  check("error_r_pct", 0, 0.05);
  // A clock of the duty is 1.73 mNm of 200.
  check("law_error_r_pct", -100.0 / 6, 0.9);
  const double rad_s2 = (0.2 - 3.5e-3) / 1.22e-4;
  check("error_moving_pct", -100 * 0.0302 * rad_s2 / (kR * 2 * kPi * 2000) / (0.2 / kKt), 0.03);
}

TEST_CASE("current loop: ripple", "[current]") {
  const double duty = 0.2914;  // 0.29 of the supply, and the diodes in the dead times
  check("ripple_mnm", 1e3 * kKt * kV * duty * (1 - duty) / (kL * 50e3), 0.02 * 36.4);
  CHECK(figure("ripple_mnm").what.find("D = 0.291,") != std::string::npos);
  // One clock of the duty is 24 mV; the integrator asks for another one before the error's integral
  // is more than that over R*w.
  check_bound("slow_ripple_mnm", 0.005, 2 * 1e3 * kKt * 0.024 / (kR * 2 * kPi * 2000 * 1e-3));
  CHECK(figure("slow_ripple_mnm").measured <= 1);
}

TEST_CASE("current loop: a short ends within the over-current's bound", "[current]") {
  // Modulator's clock, (3 hits + 3) decimations of 8, 7 clocks of the filter, one of the enable.
  const double bound_us = 1e6 * kClock * (4 * 6 * 8 + 7 + 1), tau_s = 1e-6 / 0.12;
  CHECK(bound_us == Approx(4.0));
  check_bound("short_beyond_us", 2.0, bound_us);
  const double low_us = (1 - (0.5 / kKt * kR + 0.34) / kV) / 50e3 * 1e6;
  const double rise_us = -1e6 * tau_s * std::log(1 - 24 / (kV / 0.12));
  check_bound("short_off_us", low_us, low_us + 2 * rise_us + bound_us);
  check_bound("short_peak_a", 40, 200 - (200 - 24) * std::exp(-1e-6 * bound_us / tau_s));
  // Without a short the gates stay on, also in the largest step.
  CurrentLoop loop(bench(), setting());
  loop.run(100'000, -0.5 / kKt);
  loop.run(100'000, 0.5 / kKt);
  CHECK(loop.period_mean_a() == Approx(0.5 / kKt).epsilon(0.01));
}

TEST_CASE("current loop: an ADC of 12 bits in place of the modulator", "[current]") {
  for (const double us : {1.0, 5.0}) {  // of a conversion
    const std::string key = us == 1 ? "adc_1000_" : "adc_200_";
    check(key + "settling_ms", std::log(50.0) / (2 * kPi * 2000) * 1e3, 0.07);
    check_bound(key + "slow_ripple_mnm", 0.001, 1e3 * kKt * 64.0 / 4096);
    // It samples a current beyond the threshold at the next conversion, and tells at the one after.
    check_bound(key + "short_beyond_us", us, 2 * us + 1e6 * kClock);
  }
  CHECK(figure("adc_1000_short_beyond_us").measured < 5);
  CHECK(figure("adc_200_short_beyond_us").measured > 5);  // too slow for the 5 us
}

TEST_CASE("current loop: the table and the JSON have every figure", "[current]") {
  const std::string text = current_text(report()), json = current_json(report());
  CHECK(report().figures.size() == 24);
  for (const CurrentFigure& f : report().figures) {
    CHECK(text.find("| " + f.what + " |") != std::string::npos);
    CHECK(json.find("\"" + f.key + "\"") != std::string::npos);
  }
}
