// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/controllers/controllers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "feltgate/generated/lever.hpp"
#include "sim/reference/chain.hpp"

namespace feltgate::controllers {

namespace {

/// Design `lever` with a word observer_gain wide enough for an observer that is fed back; `lever`
/// feeds none back. Another encoder: a window of the velocity estimator whose gain is 2^shift, near
/// that of `lever`.
DesignInfo fed_lever(int lines = encoder_lines[0]) {
  constexpr Format fed_gain{1, 3, 14};
  static_assert(fed_gain.width() == Lever::P::observer_gain.width());
  DesignInfo design = design_info<Lever>();
  auto& constants = design.data.constants;
  constants["P_OBSERVER_GAIN_F"] = fed_gain.fraction;
  for (ParameterInfo& p : design.parameters) {
    if (p.address == Lever::A::observer_gain) p.format = p.field = fed_gain;
  }
  if (lines != encoder_lines[0]) {
    const int shift = lines >= 2500 ? 0 : 2;
    const int window = 1'570'796 / lines;  // ticks in which a count is 1 rad/s
    constants["VELOCITY_SHIFT"] = shift;
    constants["M1"] = (window + (1 << shift) / 2) >> shift;
  }
  return design;
}

template <class N>
std::unique_ptr<RealChain> make(Kind kind, const DesignInfo& design, const Tuning& t) {
  const auto with = [&](auto law) -> std::unique_ptr<RealChain> {
    return std::make_unique<Chain<N, decltype(law)>>(name_of(kind), design, law);
  };
  if (kind == Kind::pi) return with(PiLaw<N>(design.data, t));
  if (kind == Kind::pid) return with(PidWithDerivative<N>(design.data, t));
  if (kind == Kind::reaction) return with(ReactionLaw<N>(design.data, t));
  auto chain = with(AsIs<N>());
  if (kind == Kind::observer) {
    chain->set_parameter(Map::A::torque_gain, t.share / t.torque_constant_nm_a);
    chain->set_parameter(Map::A::observer_gain, (1 - t.share) / t.torque_constant_nm_a);
  }
  return chain;
}

/// Bits of the observer's state.
constexpr int observer_bits = Lever::f.observer.width();
/// Of the observer (Ktn*I, g*Jn*w, a1), and from the torque to the current.
constexpr int shared_multiplications = 3 + 1;
/// LUT4 equivalents of the blocks of `lever`, measured: CMake reads docs/verification/areas.json.
constexpr int observer_lut4 = FELTGATE_LUT4_OBSERVER, lowpass_lut4 = FELTGATE_LUT4_LOWPASS;

constexpr double step_nm = 0.2;
constexpr double wall_damping_nm_s_rad = 0.005;

plant::Hand hand_of(plant::HandPhase phase, double start_rad) {
  plant::Hand hand;
  hand.start_rad = start_rad;
  hand.phases = {std::move(phase)};
  return hand;
}

plant::HandPhase holding(const Bench& bench, double stiffness_nm_rad) {
  plant::HandPhase phase;
  phase.kind = plant::HandPhase::Kind::kImpedance;
  const double radius_m = bench.plant.lever.radius_m;
  phase.impedance.stiffness_n_m = stiffness_nm_rad / (radius_m * radius_m);
  return phase;
}

plant::Parameters with_inertia_ratio(plant::Parameters plant, double ratio) {
  plant.lever.inertia_kg_m2 /= ratio;
  return plant;
}

/// A point half way between two edges, so that the first count is no chance.
double between_edges(const Bench& bench) { return 0.5 * bench.design.design.count_rad(); }

double after(double time_s, double from_s, double value) { return time_s < from_s ? 0.0 : value; }

constexpr double step_at_s = 1e-3;

/// Collects a signal from the first tick with a torque reference on.
class Step {
 public:
  Step(double trace_every_s, std::vector<double>* trace) : every_s_(trace_every_s), trace_(trace) {}
  void add(double time_s, const stability::BitLoop& loop, double value) {
    if (begun_s_ < 0 && loop.tau_ref_nm() > 0) begun_s_ = time_s;
    if (begun_s_ < 0) return;
    samples_.add(value);
    if (trace_ == nullptr) return;
    const double due_s = static_cast<double>(trace_->size()) * every_s_;
    if (time_s - begun_s_ >= due_s - 1e-9) trace_->push_back(value);
  }
  StepResponse response(const Bench& bench) const {
    return samples_.response(bench.design.design.tick_s(), step_nm);
  }

 private:
  StepSamples samples_{0.0};
  double every_s_, begun_s_ = -1;
  std::vector<double>* trace_;
};

/// The largest stiffness that `holds`: doubled from 1 Nm/rad on, then between two to 3 %; 0 where
/// that does not hold.
double largest(const std::function<bool(double)>& holds) {
  double low = 1.0;
  if (!holds(low)) return 0.0;
  double high = 2.0 * low;
  while (high <= stiffest_nm_rad && holds(high)) low = high, high *= 2.0;
  if (high > stiffest_nm_rad) return low;
  while (high > 1.03 * low) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::observer:
      return "observer";
    case Kind::feed_forward:
      return "feed-forward";
    case Kind::pi:
      return "PI";
    case Kind::pid:
      return "PID";
    case Kind::reaction:
      return "reaction observer";
  }
  throw std::invalid_argument("no such controller");
}

namespace {

template <class Law>
Size with_law(int low_passes) {
  return {shared_multiplications + Law::multiplications, observer_bits + Law::state_bits,
          observer_lut4 + low_passes * lowpass_lut4, observer_lut4};
}

}  // namespace

Size size_of(Kind kind) {
  switch (kind) {
    case Kind::observer:
      return {shared_multiplications + 1, observer_bits, observer_lut4, observer_lut4};
    case Kind::feed_forward:
      return {1, 0, 0, 0};
    case Kind::pi:
      return with_law<PiLaw<axis::Fixed>>(1);
    case Kind::pid:
      return with_law<PidWithDerivative<axis::Fixed>>(2);
    case Kind::reaction:
      return with_law<ReactionLaw<axis::Fixed>>(1);
  }
  throw std::invalid_argument("no such controller");
}

Tuning tuning_of(const Bench& bench, const plant::Parameters& plant) {
  const design::Design& d = bench.design.design;
  const plant::MotorParameters& nominal = bench.plant.motor;
  return {paper_share,
          d.observer_cutoff_rad_s,
          d.tick_s(),
          nominal.inductance_h / nominal.resistance_ohm,
          plant.effects.lugre ? plant.lugre.coulomb_nm : 0.0,
          d.torque_limit_nm,
          d.torque_constant_nm_a};
}

std::unique_ptr<RealChain> make_chain(Kind kind, bool fixed, const Tuning& t, int lines) {
  if (std::find(encoder_lines.begin(), encoder_lines.end(), lines) == encoder_lines.end()) {
    throw std::invalid_argument(
        "controllers: chains exist for 500, 1024, 2500 and 10000 lines; choose one of them");
  }
  const DesignInfo design = fed_lever(lines);
  return fixed ? make<axis::Fixed>(kind, design, t) : make<axis::Real<double>>(kind, design, t);
}

void run(const Bench& bench, const Trial& trial, double seconds,
         const std::function<double(double time_s)>& reference,
         const std::function<void(double time_s, const stability::BitLoop&)>& look) {
  design::Elaborated design = bench.design;
  design.design.lines = trial.lines;
  stability::BitLoopSetting s;
  const Tuning tuning = tuning_of(bench, trial.plant);
  s.made_chain = [&] { return make_chain(trial.kind, trial.fixed, tuning, trial.lines); };
  s.plant = trial.plant;
  s.plant.encoder.lines = trial.lines;
  s.hand = trial.hand;
  s.linear = !trial.plant.effects.dead_voltage;
  if (reference) {
    s.wall.scene_ticks = design.design.pwm_period_clocks() / design.design.clocks_per_tick();
  } else {
    s.wall = trial.wall;
  }
  stability::BitLoop loop(design, s);
  const double tick_s = design.design.tick_s();
  const auto now_s = [&] { return static_cast<double>(loop.ticks()) * tick_s; };
  if (reference) loop.set_host([&](double, double) { return reference(now_s()); });
  while (now_s() < seconds) {
    loop.tick();
    look(now_s(), loop);
  }
}

StepResponse stall_step(const Bench& bench, Kind kind, bool fixed, const plant::Parameters& plant,
                        std::vector<double>* trace_nm) {
  plant::HandPhase locked;
  locked.kind = plant::HandPhase::Kind::kLocked;
  Trial trial{kind, fixed, plant, hand_of(locked, between_edges(bench))};
  Step step(stall_trace_s, trace_nm);
  run(
      bench, trial, 0.04, [](double t) { return after(t, step_at_s, step_nm); },
      [&](double t, const auto& loop) { step.add(t, loop, loop.motor_torque_nm()); });
  return step.response(bench);
}

double felt_inertia(const Bench& bench, Kind kind, bool fixed) {
  constexpr double push_nm = 0.02, from_s = 0.01, to_s = 0.02;
  plant::HandPhase push;
  push.kind = plant::HandPhase::Kind::kTorque;
  push.profile = {{plant::Segment::Kind::kStep, 1.0, push_nm}};
  Trial trial{kind, fixed, bench.linear, hand_of(push, between_edges(bench))};
  double from_rad_s = 0, to_rad_s = 0;
  run(
      bench, trial, to_s, [](double) { return 0.0; },
      [&](double t, const auto& loop) {
        if (t <= from_s) from_rad_s = loop.omega_rad_s();
        to_rad_s = loop.omega_rad_s();
      });
  const double acceleration = (to_rad_s - from_rad_s) / (to_s - from_s);
  return push_nm / acceleration / bench.linear.lever.inertia_kg_m2;
}

Held held_step(const Bench& bench, Kind kind, bool fixed, double stiffness_nm_rad,
               double inertia_ratio, std::vector<double>* trace_nm) {
  constexpr double from_s = 0.01, to_s = 0.15;
  Trial trial{kind, fixed, with_inertia_ratio(bench.plant, inertia_ratio),
              hand_of(holding(bench, stiffness_nm_rad), between_edges(bench))};
  Step step(held_trace_s, trace_nm);
  ErrorFigure error;
  run(
      bench, trial, to_s, [](double t) { return after(t, step_at_s, step_nm); },
      [&](double t, const auto& loop) {
        const double felt_nm = -loop.seen().hand_torque_nm;
        step.add(t, loop, felt_nm);
        if (t > from_s) error.add(felt_nm - step_nm);
      });
  return {100 * error.rms() / step_nm, 100 * error.max() / step_nm};
}

double tremor_noise_nm(const Bench& bench, Kind kind, bool fixed, int lines) {
  constexpr double from_s = 0.05, to_s = from_s + 1.0 / tremor_hz;
  plant::HandPhase tremor;
  tremor.kind = plant::HandPhase::Kind::kPrescribed;
  plant::Segment sine;
  sine.kind = plant::Segment::Kind::kSine;
  sine.duration_s = 1.0;
  sine.amplitude = tremor_rad;
  sine.frequency_hz = tremor_hz;
  tremor.profile = {sine};
  Trial trial{kind, fixed, bench.plant, hand_of(tremor, 0.0), lines};
  double sum = 0, squares = 0, count = 0;
  run(
      bench, trial, to_s, [](double) { return 0.1; },
      [&](double t, const auto& loop) {
        if (t < from_s) return;
        const double off = loop.motor_torque_nm() - 0.1;
        sum += off;
        squares += off * off;
        count += 1;
      });
  return std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
}

double border(const Bench& bench, Kind kind, bool fixed, double inertia_ratio) {
  stability::BitLoopSetting s;
  s.plant = with_inertia_ratio(bench.linear, inertia_ratio);
  const Tuning tuning = tuning_of(bench, s.plant);
  s.made_chain = [&] { return make_chain(kind, fixed, tuning); };
  return largest([&](double stiffness) {
    s.wall = {stiffness, wall_damping_nm_s_rad};
    const double expected_rad_s = std::sqrt(stiffness / s.plant.lever.inertia_kg_m2);
    return stability::swing(bench.design, s, expected_rad_s).rate_1_s <= 0;
  });
}

double held_border(const Bench& bench, Kind kind, bool fixed, double damping) {
  constexpr double from_s = 0.1, to_s = 0.15, hand_nm_rad = 1.35, hand_rad = 0.15;
  plant::HandPhase lean = holding(bench, hand_nm_rad);
  lean.impedance.damping_ns_m *= damping;
  lean.impedance.grip_damping_ns_m *= damping;
  lean.profile = {{plant::Segment::Kind::kStep, 1.0, hand_rad}};
  return largest([&](double stiffness) {
    const double depth_rad = hand_nm_rad * hand_rad / (hand_nm_rad + stiffness);
    Trial trial{kind, fixed, bench.plant, hand_of(lean, depth_rad)};
    trial.wall = {stiffness, wall_damping_nm_s_rad};
    SignalRange angle;
    run(bench, trial, to_s, {}, [&](double t, const auto& loop) {
      if (t > from_s) angle.add(loop.theta_rad());
    });
    return angle.high - angle.low < 3 * bench.design.design.count_rad();
  });
}

Report measure(const Bench& bench, const std::function<void(double)>& progress) {
  Report report;
  plant::Parameters hot = bench.plant, weak = bench.plant;
  hot.motor.resistance_ohm *= 1.2;
  weak.motor.torque_constant_nm_a *= 0.5;
  weak.motor.back_emf_constant_v_s_rad *= 0.5;
  const auto pair = [](const std::function<double(bool)>& figure) {
    return Pair{figure(true), figure(false)};
  };
  for (const Kind k : kinds) {
    Row row;
    row.kind = k;
    const StepResponse fixed = stall_step(bench, k, true, bench.plant, &row.stall_trace_nm);
    const StepResponse real = stall_step(bench, k, false, bench.plant);
    row.settling_ms = {fixed.settling_ms, real.settling_ms};
    row.error_pct = {fixed.final_error_pct, real.final_error_pct};
    row.error_r_pct = pair([&](bool f) { return stall_step(bench, k, f, hot).final_error_pct; });
    row.error_kt_pct = pair([&](bool f) { return stall_step(bench, k, f, weak).final_error_pct; });
    row.felt_inertia = pair([&](bool f) { return felt_inertia(bench, k, f); });
    row.noise_nm = pair([&](bool f) { return tremor_noise_nm(bench, k, f, 1024); });
    row.border_nm_rad = pair([&](bool f) { return border(bench, k, f); });
    row.held_border_nm_rad = pair([&](bool f) { return held_border(bench, k, f); });
    row.light_border_nm_rad = pair([&](bool f) { return held_border(bench, k, f, light_damping); });
    for (const double stiffness : stiffness_nm_rad) {
      row.held.push_back(held_step(bench, k, true, stiffness));
    }
    for (const double ratio : inertia_ratios) {
      row.inertia.push_back(
          held_step(bench, k, true, 2.0, ratio, ratio == 1.0 ? &row.held_trace_nm : nullptr));
      row.borders.push_back(ratio == 1.0 ? row.border_nm_rad.fixed : border(bench, k, true, ratio));
    }
    for (const int lines : noise_lines) {
      row.noise_of.push_back(tremor_noise_nm(bench, k, true, lines));
    }
    report.rows.push_back(std::move(row));
    if (progress) progress(static_cast<double>(report.rows.size()) / kinds.size());
  }
  return report;
}

}  // namespace feltgate::controllers
