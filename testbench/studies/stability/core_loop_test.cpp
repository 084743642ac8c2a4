// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The whole core with a current loop, by its twin, around a winding that its gates switch: its
// bandwidth, ripple, tau_hat and walls, beside closed forms and the core without the loop.
// Documentation: docs/blocks/current.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/lever_current.hpp"
#include "figures_record.hpp"
#include "sim/backends/twin_backend.hpp"
#include "sim/plant/drive.hpp"
#include "sim/plant/plant.hpp"
#include "sim/plant/plant_file.hpp"
#include "sim/plant/sigma_delta.hpp"
#include "studies/stability/bit_loop.hpp"
#include "studies/stability/linear_loop.hpp"

using namespace feltgate;

namespace {

/// The textbook loop: a mass with friction, a force held between samples, an actuator with a lag
/// and a dead time. SI units.
struct MassLoop {
  double mass = 0, friction = 0, period_s = 0, actuator_s = 0, dead_time_s = 0;
};

/// States; behind them the commands that wait for the end of the dead time, the newest last.
enum : int { kX, kSpeed, kForce, kCommand, kScalars };

/// The plant for a time with the command held.
Eigen::MatrixXd flow(const MassLoop& loop, double seconds, int size) {
  Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(size, size);
  rate(kX, kSpeed) = 1;
  rate(kSpeed, kSpeed) = -loop.friction / loop.mass;
  rate(kSpeed, kForce) = 1 / loop.mass;
  rate(kForce, kForce) = -1 / loop.actuator_s;
  rate(kForce, kCommand) = 1 / loop.actuator_s;
  return Eigen::MatrixXd::Identity(size, size) + stability::matrix_exp_minus_one(rate, seconds);
}

double spectral_radius(const MassLoop& loop, double stiffness) {
  const double ratio = loop.dead_time_s / loop.period_s;
  // A hair below a whole number of periods is that number.
  const int whole = static_cast<int>(std::floor(ratio + 1e-9)), size = kScalars + whole + 1;
  const double rest_s = std::max(0.0, ratio - whole) * loop.period_s;
  const Eigen::MatrixXd same = Eigen::MatrixXd::Identity(size, size);
  Eigen::MatrixXd sample = same, take = same;
  for (int i = kScalars; i < size - 1; ++i) sample.row(i) = same.row(i + 1);
  sample.row(size - 1) = -stiffness * same.row(kX);
  take.row(kCommand) = same.row(kScalars);
  const Eigen::MatrixXd period =
      flow(loop, loop.period_s - rest_s, size) * take * flow(loop, rest_s, size) * sample;
  return stability::eigenvalues(period).cwiseAbs().maxCoeff();
}

double stiffest(const MassLoop& loop) {
  double low = 1e-3 * loop.friction / (loop.period_s / 2 + loop.actuator_s + loop.dead_time_s);
  double high = 2 * low;
  for (; spectral_radius(loop, high) < 1; high *= 1.2) low = high;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (spectral_radius(loop, middle) < 1 ? low : high) = middle;
  }
  return low;
}

const std::string kRoot = FELTGATE_ROOT;
constexpr Clock kStep = 4;  // a clock of the modulator
constexpr double kStep_s = kStep / 50e6, kArmed_s = 0.0115;
constexpr double kKt = 0.0302, kLocked_s = 0.013;

/// Core and plant. The bridge of a step is that of the gates in the step before.
template <class D>
class LoopDevice {
 public:
  using A = typename D::A;

  LoopDevice(const plant::Parameters& p, const plant::Hand& hand)
      : plant_(p, p.effects, plant::drive_of(design_info<D>()), hand) {
    core_.reset(1, plant_.encoder().pins());
    set(A::self_test_pulse, 0);
    set(A::ramp_step, 1);
  }
  void set(int address, double value) {
    for (const ParameterInfo& p : D::parameters) {
      if (p.address != address) continue;
      const double word = std::ldexp(value, p.format.fraction);
      core_.write(address, static_cast<std::uint32_t>(std::llround(word)));
    }
  }
  /// Runs to kArmed_s; the request waits for the offset.
  void arm(int scene) {
    const auto word = static_cast<std::uint32_t>(D::control_reset) | 1u << D::C::control_host |
                      static_cast<std::uint32_t>(scene) << D::C::control_scene;
    core_.write(D::C::control, word);
    core_.write(D::C::control, word | 1u << D::C::control_arm);
    run(kArmed_s);
    REQUIRE(last_.armed);
  }
  void step() {
    const GateClocks g = core_.gates();
    const auto share = [](Clock on) { return static_cast<double>(on) / kStep; };
    plant_.advance(plant::Bridge::gates(share(g.a_hi), share(g.a_lo), share(g.b_hi), share(g.b_lo)),
                   kStep);
    core_.set_current_bits(modulator_.next(seen().motor_current_a));
    const auto& events = plant_.events();
    core_.advance(kStep, events.data(), events.data() + events.size());
    for (const Snapshot& s : core_.snapshots()) {
      last_ = s;
      if (host) host(ticks_);
      ++ticks_;
    }
  }
  template <class Each>
  void run(double seconds, Each&& each) {
    for (std::int64_t n = std::llround(seconds / kStep_s); n > 0; --n) {
      step();
      each();
    }
  }
  void run(double seconds) {
    run(seconds, [] {});
  }

  const plant::Observables& seen() const { return plant_.observables(); }
  const Snapshot& last() const { return last_; }
  double nm(std::int64_t torque) const {
    return std::ldexp(static_cast<double>(torque), -D::f.torque.fraction);
  }
  double now_s() const { return static_cast<double>(plant_.now()) / 50e6; }
  std::function<void(std::int64_t tick)> host;  ///< called after each tick; may be empty

 private:
  TwinBackend<FeltgateCore> core_{design_info<D>()};
  plant::Plant plant_;
  plant::SigmaDelta modulator_{32};
  Snapshot last_;
  std::int64_t ticks_ = 0;
};

plant::Hand locked() {
  plant::Hand hand;
  plant::HandPhase phase;
  phase.kind = plant::HandPhase::Kind::kLocked;
  hand.phases = {phase};
  return hand;
}
plant::Parameters plant_named(const std::string& name) {
  return plant::read_plant_file(kRoot + "/vectors/plants/" + name + ".toml");
}

/// A locked lever with this torque, settled.
template <class D>
LoopDevice<D> at_stall(const plant::Parameters& p, double torque_nm) {
  LoopDevice<D> device(p, locked());
  device.set(D::A::setpoint_torque, torque_nm);
  device.arm(D::S::setpoint);
  device.run(0.005);
  return device;
}

/// From the core's tau_ref to the motor's torque, a sine of 15 mNm around `device`'s torque.
std::complex<double> response(LoopDevice<LeverCurrent> device, double torque_nm, double hz) {
  const double rad_s = plant::kTwoPi * hz;
  device.host = [&device, rad_s, torque_nm](std::int64_t) {
    device.set(LeverCurrent::A::setpoint_torque,
               torque_nm + 0.015 * std::sin(rad_s * device.now_s()));
  };
  device.run(0.002);
  const double cycles = std::max(4.0, std::round(hz * 4e-3));
  std::complex<double> in, out;
  device.run(cycles / hz, [&] {
    const std::complex<double> turn = std::polar(1.0, -rad_s * (device.now_s() - kStep_s / 2));
    in += (device.nm(device.last().tau_ref) - torque_nm) * turn;
    out += (device.seen().motor_torque_mean_nm - torque_nm) * turn;
  });
  return out / in;
}
double degrees(std::complex<double> ratio) { return 360 / plant::kTwoPi * std::arg(ratio); }
double db(std::complex<double> ratio) { return 20 * std::log10(std::abs(ratio)); }

/// Growth of a swing in a wall without damping. A hand presses with a quarter of a newton metre; at
/// more than a tick, a host reads the position and writes the torque.
stability::Growth swing(double stiffness, int ticks) {
  using A = LeverCurrent::A;
  constexpr double press_nm = 0.25, share = 0.6;
  constexpr int half_periods = 12;
  const double count_rad = design_info<LeverCurrent>().count_rad;
  plant::Parameters p = plant_named("linear");
  p.effects.viscous = true;
  const double start_rad = (1 - share) * press_nm / stiffness;
  plant::Hand hand = locked();
  hand.start_rad = start_rad;
  hand.phases[0].duration_s = kLocked_s;
  plant::HandPhase press;
  press.kind = plant::HandPhase::Kind::kTorque;
  press.profile = {{plant::Segment::Kind::kStep, 1.0, press_nm}};
  hand.phases.push_back(press);
  LoopDevice<LeverCurrent> device(p, hand);
  device.set(A::wall_contact, -start_rad / count_rad);
  device.set(A::wall_stiffness, stiffness * count_rad);
  device.set(A::wall_damping, 0);
  device.set(A::setpoint_torque, -(1 - share) * press_nm);
  device.arm(ticks == 1 ? LeverCurrent::S::wall : LeverCurrent::S::setpoint);
  if (ticks > 1) {
    device.host = [&](std::int64_t tick) {
      if (tick % ticks != 0) return;
      const double depth_rad = start_rad + device.last().position * count_rad;
      device.set(A::setpoint_torque, -stiffness * depth_rad);
    };
  }
  device.run(kLocked_s - kArmed_s);
  stability::SwingMeter meter(start_rad, 2.5 * count_rad, half_periods);
  const double rad_s = std::sqrt(stiffness / p.lever.inertia_kg_m2);
  const double longest_s = 1.5 * (half_periods + 4) * plant::kTwoPi / 2 / rad_s;
  bool on = true;
  for (const double end_s = kLocked_s + longest_s; on && device.now_s() < end_s;) {
    device.step();
    on = meter.add(device.now_s(), device.seen().theta_rad, device.seen().omega_rad_s);
  }
  REQUIRE(device.last().faults == 0);
  return meter.growth();
}

/// The stiffness without growth, between the growths at two near `expected`.
double border(double expected, int ticks) {
  const double low = 0.95 * expected, high = 1.05 * expected;
  const stability::Growth a = swing(low, ticks), b = swing(high, ticks);
  CAPTURE(ticks, expected, a.rate_1_s, b.rate_1_s, a.swings, b.swings);
  CHECK(a.swings >= 6);
  CHECK(a.rate_1_s < 0);
  CHECK(b.rate_1_s > 0);
  return low - (high - low) * a.rate_1_s / (b.rate_1_s - a.rate_1_s);
}

/// What the velocity's delay takes off the lever's damping: the back-EMF that is fed forward is an
/// old one, and the loop leaves its change, s/(2 pi f R), as a current.
double undamped(const stability::LoopModel& lever, const plant::Parameters& p, double rad_s) {
  const std::complex<double> s(0, rad_s);
  const double window_s = lever.m1 * lever.tick_s;
  const std::complex<double> velocity =
      (1.0 - std::exp(-s * window_s)) / (s * window_s) * (500.0 / (500.0 + s));
  const double share = p.motor.torque_constant_nm_a * p.motor.back_emf_constant_v_s_rad /
                       (plant::kTwoPi * 2000 * p.motor.resistance_ohm);
  return (s * share * (velocity - 1.0)).real();
}

}  // namespace

TEST_CASE("stability: figures of the core with a current loop") {
  std::string figures =
      "| the whole core of `lever_current` | measured | beside |\n|---|---|---|\n";
  const auto row = [&](const std::string& what, const std::string& value, const std::string& that) {
    figures += fmt::format("| {} | {} | {} |\n", what, value, that);
  };
  const plant::Parameters p24 = plant_named("p24");

  const LoopDevice<LeverCurrent> quarter = at_stall<LeverCurrent>(p24, 0.25);
  double before_hz = 0, before_db = 0, before_deg = 0, down_hz = 0, back_hz = 0;
  for (const double hz : {2400.0, 2700.0, 3000.0, 4600.0, 4900.0, 5200.0, 5500.0}) {
    const std::complex<double> r = response(quarter, 0.25, hz);
    const auto crossed = [&](double now, double before, double level) {
      return before_hz + (hz - before_hz) * (level - before) / (now - before);
    };
    if (before_hz > 0 && down_hz == 0 && db(r) < -3.01) down_hz = crossed(db(r), before_db, -3.01);
    if (before_hz > 0 && back_hz == 0 && degrees(r) < -90)
      back_hz = crossed(degrees(r), before_deg, -90);
    before_hz = hz, before_db = db(r), before_deg = degrees(r);
  }
  const double delay_us = -degrees(response(quarter, 0.25, 200)) / 360 / 200 * 1e6;
  const std::string ti = "TI, PWM of 10 kHz: about 5 (quoted)";
  row("tau_ref to torque: -3 dB, kHz", fmt::format("{:.2f}", down_hz / 1e3), ti);
  row("-90°, kHz", fmt::format("{:.2f}", back_hz / 1e3), ti);
  row("delay at 200 Hz, µs", fmt::format("{:.1f}", delay_us),
      "110 in `stability`'s small loop; 71.7: 1/(2πf) less 397 clocks");
  CHECK(std::abs(delay_us - 71.7) < 1);
  CHECK(down_hz > 2500);
  CHECK(back_hz > 4500);

  LoopDevice<LeverCurrent> half = at_stall<LeverCurrent>(p24, 0.5);
  double least = 1, most = 0, swing_nm = 0;
  for (int ms = 0; ms < 20; ++ms) {
    double sum = 0, low = 1, high = 0;
    half.run(1e-3, [&] {
      const double now = half.seen().motor_torque_nm;
      sum += half.seen().motor_torque_mean_nm;
      low = std::min(low, now), high = std::max(high, now);
    });
    const double mean = sum * kStep_s / 1e-3;
    least = std::min(least, mean), most = std::max(most, mean), swing_nm = high - low;
  }
  const double duty = (0.5 / kKt * p24.motor.resistance_ohm + p24.motor.dead_voltage_v) / 24;
  const double ripple_nm = kKt * 24 * duty * (1 - duty) / (p24.motor.inductance_h * 50e3);
  row("0.5 Nm at stall, means over 1 ms, peak to peak, mNm",
      fmt::format("{:.2f}", 1e3 * (most - least)), "at most 1");
  row("the same within a period, peak to peak, mNm", fmt::format("{:.1f}", 1e3 * swing_nm),
      fmt::format("{:.1f}: Kt·V·D(1 - D)/(L·f)", 1e3 * ripple_nm));
  CHECK(most - least < 1e-3);
  CHECK(std::abs(swing_nm / ripple_nm - 1) < 0.05);

  plant::Parameters warm = p24;
  warm.motor.resistance_ohm *= 1.2;
  const auto seen = [](auto device) {
    double sum = 0;
    device.run(0.02);
    device.run(1e-3, [&] { sum += device.seen().motor_torque_mean_nm * kStep_s / 1e-3; });
    return std::pair{sum, device.nm(device.last().tau_hat)};
  };
  const auto [torque, observed] = seen(at_stall<LeverCurrent>(warm, 0.2));
  const auto [torque_without, observed_without] = seen(at_stall<Lever>(warm, 0.2));
  const auto told = [](double t, double o) {
    return fmt::format("{:.4f} Nm, tau_hat {:.4f} ({:+.1f} %)", t, o, 100 * (o / t - 1));
  };
  row("0.2 Nm at stall, R +20 %: torque, and tau_hat", told(torque, observed),
      "`lever`: " + told(torque_without, observed_without));
  CHECK(std::abs(torque / 0.2 - 1) < 0.01);
  CHECK(std::abs(observed / torque - 1) < 0.005);
  CHECK(observed_without / torque_without > 1.1);

  figures +=
      "\n| wall, b = 1e-3, B = 0 | `lever_current`, Nm/rad | small loop with the core's delay | "
      "with "
      "110 µs | `lever`, eigenvalues | Z-width with the loop | without |\n"
      "|---|---|---|---|---|---|---|\n";
  plant::Parameters linear = plant_named("linear");
  linear.effects.viscous = true;
  const design::Elaborated lever = elaborate(design::read_design(kRoot + "/rtl/designs/lever.toml"),
                                             design::read_registers(kRoot + "/rtl/registers.toml"));
  const stability::LoopModel model = stability::make_model(lever, linear);
  const design::Elaborated with =
      elaborate(design::read_design(kRoot + "/rtl/designs/lever_current.toml"),
                design::read_registers(kRoot + "/rtl/registers.toml"));
  CHECK_THROWS_AS(stability::make_model(with, linear), std::invalid_argument);
  const double rad_s = 20 * plant::kTwoPi / 2;  // 10 Hz
  const double free_nm_rad =
      rad_s * std::hypot(rad_s * linear.lever.inertia_kg_m2, linear.lever.viscous_nm_s_rad);
  for (const auto& [hz, name] :
       {std::pair{490.0, "490 Hz"}, {1e3, "1 kHz"}, {40e3, "40 kHz"}, {1e6, "1 MHz"}}) {
    MassLoop loop{linear.lever.inertia_kg_m2, 1e-3, 1 / hz, 1 / (plant::kTwoPi * 2000), 30e-6};
    const double assumed = stiffest(loop);
    const int ticks = stability::scene_ticks(lever.design, hz);
    loop.actuator_s = (delay_us + 1) * 1e-6;  // half a tick to sample, half to hold
    loop.dead_time_s = ticks > 1 ? stability::host_ticks * 1e-6 : 0;
    loop.friction -= undamped(model, linear, std::sqrt(stiffest(loop) / loop.mass));
    const double predicted = stiffest(loop);
    const double measured = border(predicted, ticks);
    const double without = stability::border(model, 0, ticks).stiffness_nm_rad;
    figures += fmt::format(
        "| {} | {:.3f} | {:.3f} ({:+.1f} %) | {:.3f} ({:+.1f} %) | {:.3f} | {:.1f} | {:.1f} |\n",
        name, measured, predicted, 100 * (measured / predicted - 1), assumed,
        100 * (measured / assumed - 1), without, measured / free_nm_rad,
        without / stability::free_impedance_nm_rad(model, rad_s));
    CAPTURE(name, measured, predicted, assumed);
    CHECK(std::abs(measured / predicted - 1) < 0.05);
    CHECK(measured > 0.95 * assumed);
  }
  test::check_figures("core_loop", figures);
}
