// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Figures of the current loop, each with its closed form. Documentation: docs/controllers.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "files/json_text.hpp"
#include "studies/controllers/current_loop.hpp"

namespace feltgate::controllers {

namespace {

constexpr double kStep_nm = 0.2, kFull_nm = 0.5;
constexpr double kFast_hz = 5000;
/// From the bridge to a short; the resistance is what p24 has beside the winding's own.
constexpr double kShort_ohm = 0.12, kShort_h = 1e-6;
constexpr int kShortPhases = 200;
/// None of them is the PWM's frequency over a whole number, where quantisation would repeat.
constexpr double kSines_hz[] = {97,   490,  980,  1470, 1970, 2370, 2770, 3170, 3570,
                                3970, 4470, 4930, 5530, 6230, 7030, 7930, 9930, 12370};

/// The bench with what the closed forms need of it.
struct Study {
  const Bench& bench;
  const plant::MotorParameters& motor = bench.plant.motor;
  double supply_v = bench.design.design.supply_v;
  double clock_hz = static_cast<double>(bench.design.design.clock_hz);
  double pwm_hz = clock_hz / bench.design.design.pwm_period_clocks();
  CurrentSetting as_is = setting_of(bench.plant);
  double rad_s = plant::kTwoPi * as_is.bandwidth_hz;

  static CurrentSetting setting_of(const plant::Parameters& plant) {
    CurrentSetting setting;
    setting.plant = plant;
    return setting;
  }
  double current_a(double torque_nm) const { return torque_nm / motor.torque_constant_nm_a; }
};

/// When the step's error, with a lost voltage that only the integrator finds, is 2 % for good.
double lost_settling_s(const Study& s, double step_a) {
  const double pole = s.motor.resistance_ohm / s.motor.inductance_h;
  const double lost_a =
      s.bench.design.word("dead_voltage").si / (s.motor.inductance_h * (s.rad_s - pole));
  double t = 2e-3;
  while (t > 0 && lost_a * std::exp(-pole * t) + (step_a - lost_a) * std::exp(-s.rad_s * t) <
                      0.02 * step_a) {
    t -= 1e-7;
  }
  return t;
}

void steps(const Study& s, CurrentReport& report) {
  const double lag_ms = 1e3 * std::log(50.0) / s.rad_s;
  const std::string lag = "ln 50/(2πf), a lag", asked = "at most 0.35";
  const auto add = [&](const char* key, const std::string& what, const CurrentSetting& setting,
                       double from_nm, double to_nm) {
    CurrentStep step = current_step(s.bench, setting, from_nm, to_nm);
    report.figures.push_back(
        {key, what + ": to 2 %, ms", step.settling_ms, lag_ms, false, lag, asked, 3});
    return step;
  };
  report.step = add("settling_ms", "0 to 0.2 Nm", s.as_is, 0, kStep_nm);
  const CurrentStep full = add("settling_full_ms", "0 to 0.5 Nm", s.as_is, 0, kFull_nm);
  const CurrentStep back =
      add("settling_reversal_ms", "-0.2 to 0.2 Nm", s.as_is, -kStep_nm, kStep_nm);
  const double most = std::max({report.step.overshoot_pct, full.overshoot_pct, back.overshoot_pct});
  report.figures.push_back({"overshoot_pct", "overshoot of these, %", most, 0, false,
                            "both poles of the sampled loop are real", "", 1});
  CurrentSetting blind = s.as_is;
  blind.feeds_lost = false;
  add("settling_blind_ms", "0 to 0.2 Nm, brushes and dead time not fed forward", blind, 0,
      kStep_nm);
  report.figures.back().form = 1e3 * lost_settling_s(s, s.current_a(kStep_nm));
  report.figures.back().formula = "lag, and the lost voltage through both poles";
  report.figures.back().asked.clear();
}

/// Where a figure of the sines falls below a level; between two by the logarithm of the frequency.
double falls_below(const std::vector<CurrentSine>& sines, double CurrentSine::*figure,
                   double level) {
  for (std::size_t k = 1; k < sines.size(); ++k) {
    const double before = sines[k - 1].*figure, now = sines[k].*figure;
    if (now > level) continue;
    return sines[k - 1].hz *
           std::pow(sines[k].hz / sines[k - 1].hz, (before - level) / (before - now));
  }
  throw std::runtime_error("current loop: no sine is fast enough");
}

std::vector<CurrentSine> bandwidth(const Study& s, const CurrentSetting& setting,
                                   CurrentReport& report) {
  std::vector<CurrentSine> sines;
  for (const double hz : kSines_hz) sines.push_back(current_sine(s.bench, setting, hz));
  const std::string quoted = "TI, PWM of 10 kHz: about 5 (quoted)";
  const std::string gains = fmt::format("{:g} kHz", 1e-3 * setting.bandwidth_hz);
  const auto add = [&](const char* key, const char* what, double CurrentSine::*measured,
                       double CurrentSine::*form, double level) {
    report.figures.push_back({fmt::format("{}_{:g}_khz", key, 1e-3 * setting.bandwidth_hz),
                              fmt::format("gains for {}: {}, kHz", gains, what),
                              1e-3 * falls_below(sines, measured, level),
                              1e-3 * falls_below(sines, form, level), false,
                              "averaged winding, sampled", quoted, 2});
  };
  add("minus_3_db", "-3 dB", &CurrentSine::gain_db, &CurrentSine::form_gain_db,
      10 * std::log10(0.5));
  add("minus_90_deg", "-90°", &CurrentSine::phase_deg, &CurrentSine::form_phase_deg, -90);
  return sines;
}

/// Mean current over a time, A.
double mean_a(CurrentLoop& loop, double seconds, double reference_a) {
  const Clock clocks = loop.clocks(seconds);
  double sum_a = 0;
  for (Clock c = 0; c < clocks; ++c) {
    loop.clock(reference_a);
    sum_a += loop.seen().motor_current_mean_a;
  }
  return sum_a / static_cast<double>(clocks);
}

void errors(const Study& s, CurrentReport& report) {
  const double reference_a = s.current_a(kStep_nm);
  const auto stalled_pct = [&](const plant::Parameters& plant) {
    CurrentLoop loop(s.bench, Study::setting_of(plant));
    loop.run(loop.clocks(2.5e-3), reference_a);
    return 100 * (mean_a(loop, 1e-3, reference_a) / reference_a - 1);
  };
  plant::Parameters warm = s.bench.plant;
  warm.motor.resistance_ohm *= 1.2;
  const std::string asked = "at most 1";
  report.figures.push_back({"error_pct", "error of 0.2 Nm at stall, %", stalled_pct(s.bench.plant),
                            0, false, "the integrator", asked, 2});
  report.figures.push_back({"error_r_pct", "the same, R +20 %", stalled_pct(warm), 0, false,
                            "the integrator", asked, 2});
  report.figures.push_back({"law_error_r_pct", "the voltage law without the loop, R +20 %",
                            stall_step(s.bench, Kind::feed_forward, true, warm).final_error_pct,
                            100 * (1 / 1.2 - 1), false, "1/1.2 - 1, and a clock of the duty", "",
                            1});
  // The back-EMF of a free lever grows; the integrator, which nobody tells, is behind.
  CurrentSetting free = s.as_is;
  free.locked = false;
  CurrentLoop loop(s.bench, free);
  loop.run(loop.clocks(10e-3), reference_a);
  const double begin_rad_s = loop.seen().omega_rad_s;
  const double error_a = mean_a(loop, 10e-3, reference_a) - reference_a;
  const double rad_s2 = (loop.seen().omega_rad_s - begin_rad_s) / 10e-3;
  report.figures.push_back({"error_moving_pct",
                            fmt::format("error on the free lever, {:.0f} rad/s², %", rad_s2),
                            100 * error_a / reference_a,
                            -100 * s.motor.back_emf_constant_v_s_rad * rad_s2 /
                                (s.motor.resistance_ohm * s.rad_s) / reference_a,
                            false, "Ke·dω/dt/(2πf·R·I)", asked, 2});
}

/// Ripples of the current at a duty of about 0.29, peak to peak: of its means over 1 ms, and within
/// a period.
struct Ripples {
  double slow_a = 0, within_a = 0, duty = 0;
};
Ripples ripples_of(const Study& s, const CurrentSetting& setting) {
  const double reference_a = (0.29 * s.supply_v - s.motor.dead_voltage_v) / s.motor.resistance_ohm;
  CurrentLoop loop(s.bench, setting);
  loop.run(loop.clocks(2.5e-3), reference_a);
  SignalRange slow;
  Ripples r;
  double high = 0;
  constexpr int windows = 40;
  const Clock ms = loop.clocks(1e-3);
  for (int w = 0; w < windows; ++w) {
    SignalRange fast;
    double sum_a = 0;
    for (Clock c = 0; c < ms; ++c) {
      loop.clock(reference_a);
      sum_a += loop.seen().motor_current_mean_a;
      high += loop.gates().gate_a_hi ? 1 : 0;
      if (c < loop.period()) fast.add(loop.seen().motor_current_a);
    }
    slow.add(sum_a / static_cast<double>(ms));
    r.within_a += (fast.high - fast.low) / windows;
  }
  r.slow_a = slow.high - slow.low;
  r.duty = high / (windows * static_cast<double>(ms));
  return r;
}

void ripple(const Study& s, CurrentReport& report) {
  const double kt = s.motor.torque_constant_nm_a;
  const Ripples r = ripples_of(s, s.as_is);
  const int period = CurrentLoop(s.bench, s.as_is).period();
  report.figures.push_back(
      {"slow_ripple_mnm", "means over 1 ms, peak to peak, mNm", 1e3 * kt * r.slow_a,
       1e3 * kt * 2 * s.supply_v / period / (s.motor.resistance_ohm * s.rad_s * 1e-3), true,
       "the error's integral stays within a clock of the duty", "at most 1", 2});
  report.figures.push_back(
      {"ripple_mnm", fmt::format("within a period, D = {:.3f}, peak to peak, mNm", r.duty),
       1e3 * kt * r.within_a,
       1e3 * kt * s.supply_v * r.duty * (1 - r.duty) / (s.motor.inductance_h * s.pwm_hz), false,
       "Kt·V·D(1 - D)/(L·f)", "within 5 %", 1});
}

/// The latest of so many phases at which the motor is shorted; `trace_a` is that with the largest
/// current, every 0.1 us.
struct Shorts {
  double off_us = 0, beyond_us = 0, largest_a = 0;
  std::vector<double> trace_a;
};
Shorts shorts_of(const Study& s, const CurrentSetting& setting, int phases) {
  const double reference_a = s.current_a(kFull_nm);
  Shorts found;
  CurrentLoop before(s.bench, setting);
  before.run(before.clocks(2.5e-3), reference_a);
  for (int phase = 0; phase < phases; ++phase) {
    CurrentLoop loop = before;
    before.run(before.period() / phases, reference_a);
    loop.short_motor(kShort_ohm, kShort_h);
    double from_us = 0, us = 0, peak_a = 0;
    std::vector<double> trace_a;
    const Clock tail = loop.clocks(1e-6);  // a dead time also has no gate on
    for (Clock c = 0, off = 0; off < tail; ++c) {
      if (c > Clock{10} * loop.period())
        throw std::runtime_error("current loop: the short goes on");
      loop.clock(reference_a);
      const double now_us = 1e6 * static_cast<double>(c + 1) / loop.clock_hz();
      off = loop.gates_on() ? 0 : off + 1;
      if (off == 1) us = now_us;
      const double now_a = std::abs(loop.seen().motor_current_a);
      if (c % loop.clocks(1e-7) == 0) trace_a.push_back(now_a);
      peak_a = std::max(peak_a, now_a);
      // A current that falls below the threshold again, after the pulse, begins anew.
      if (now_a < overcurrent_a && off == 0) from_us = now_us;
    }
    found.off_us = std::max(found.off_us, us);
    found.beyond_us = std::max(found.beyond_us, us - from_us);
    if (peak_a > found.largest_a) {
      found.largest_a = peak_a;
      found.trace_a = trace_a;
    }
  }
  return found;
}

void shorts(const Study& s, CurrentReport& report) {
  const double reference_a = s.current_a(kFull_nm);
  const Shorts found = shorts_of(s, s.as_is, kShortPhases);
  report.short_a = found.trace_a;
  // The over-current's own bound, and the clock of the enable.
  const double most_us = 1e6 * (CurrentSense::Parameters{}.overcurrent_clocks() + 1) / s.clock_hz;
  const double tau_s = kShort_h / kShort_ohm, final_a = s.supply_v / kShort_ohm;
  const double rise_us = -1e6 * tau_s * std::log1p(-overcurrent_a / final_a);
  const double duty = (s.motor.resistance_ohm * reference_a + s.motor.dead_voltage_v) / s.supply_v;
  const double low_us = 1e6 * (1 - duty) / s.pwm_hz;
  report.figures.push_back(
      {"short_beyond_us",
       fmt::format("short at 0.5 Nm: {:g} A to all gates off, µs", overcurrent_a), found.beyond_us,
       most_us, true, "current_sense, and a clock", "", 2});
  report.figures.push_back({"short_off_us", "the short to all gates off, µs", found.off_us,
                            low_us + 2 * rise_us + most_us, true,
                            "a rise, to the next pulse, a rise, and that", "", 2});
  report.figures.push_back({"short_peak_a", "greatest current, A", found.largest_a,
                            final_a + (overcurrent_a - final_a) * std::exp(-1e-6 * most_us / tau_s),
                            true, "the wiring's exponential until then", "", 1});
}

/// What 12 bits at a shunt's amplifier give instead, as fast as such converters and the DE0-Nano's.
void adcs(const Study& s, CurrentReport& report) {
  const double lsb_a = 2 * shunt_full_scale_a / 4096;
  for (const double ksps : {1000.0, 200.0}) {
    CurrentSetting setting = s.as_is;
    setting.adc_hz = 1e3 * ksps;
    const std::string name = fmt::format("ADC of 12 bits, {:g} ksps", ksps);
    const auto key = [ksps](const char* what) { return fmt::format("adc_{:g}_{}", ksps, what); };
    report.figures.push_back({key("settling_ms"), name + ": 0 to 0.2 Nm, to 2 %, ms",
                              current_step(s.bench, setting, 0, kStep_nm).settling_ms,
                              1e3 * std::log(50.0) / s.rad_s, false, "ln 50/(2πf), a lag", "", 3});
    report.figures.push_back({key("slow_ripple_mnm"), name + ": means over 1 ms, peak to peak, mNm",
                              1e3 * s.motor.torque_constant_nm_a * ripples_of(s, setting).slow_a,
                              1e3 * s.motor.torque_constant_nm_a * lsb_a, true, "an LSB, 15.6 mA",
                              "at most 1", 2});
    report.figures.push_back(
        {key("short_beyond_us"),
         fmt::format("{}: short: {:g} A to all gates off, µs", name, overcurrent_a),
         shorts_of(s, setting, kShortPhases / 5).beyond_us, 2e3 / ksps + 1e6 / s.clock_hz, true,
         "two conversions, and a clock", "at most 5", 2});
  }
}

}  // namespace

CurrentReport measure_current(const Bench& bench, const std::function<void(double)>& progress) {
  const auto done = [&progress](double share) {
    if (progress) progress(share);
  };
  const Study s{bench};
  CurrentReport report;
  steps(s, report);
  done(0.4);
  report.sines = bandwidth(s, s.as_is, report);
  CurrentSetting fast = s.as_is;
  fast.bandwidth_hz = kFast_hz;
  bandwidth(s, fast, report);
  done(0.8);
  errors(s, report);
  ripple(s, report);
  shorts(s, report);
  adcs(s, report);
  done(1);
  return report;
}

std::string current_text(const CurrentReport& report) {
  std::string s =
      "| | measured | closed form | which is | asked or quoted |\n|---|---|---|---|---|\n";
  for (const CurrentFigure& f : report.figures) {
    s += fmt::format("| {} | {:.{}f} | {}{:.{}f} | {} | {} |\n", f.what, f.measured, f.decimals,
                     f.bound ? "at most " : "", f.form, f.decimals, f.formula, f.asked);
  }
  return s;
}

std::string current_json(const CurrentReport& report) {
  using Json = nlohmann::ordered_json;
  Json j{{"schema", "feltgate-current/1"},
         {"version", FELTGATE_VERSION},
         {"figures", Json::array()},
         {"sines", Json::array()}};
  for (const CurrentFigure& f : report.figures) {
    j["figures"].push_back({{"key", f.key},
                            {"what", f.what},
                            {"measured", f.measured},
                            {"closed_form", f.form},
                            {"bound", f.bound},
                            {"asked", f.asked}});
  }
  for (const CurrentSine& sine : report.sines) {
    j["sines"].push_back({{"hz", sine.hz},
                          {"gain_db", sine.gain_db},
                          {"phase_deg", sine.phase_deg},
                          {"form_gain_db", sine.form_gain_db},
                          {"form_phase_deg", sine.form_phase_deg}});
  }
  j["step_every_s"] = 1e-6;
  j["step_mean_nm"] = report.step.mean_nm;
  j["step_nm"] = report.step.raw_nm;
  j["short_every_s"] = 1e-7;
  j["short_a"] = report.short_a;
  return files::json_text(j);
}

}  // namespace feltgate::controllers
