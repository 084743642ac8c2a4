// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extremes of the loop: nominal against true inertia and Kp, the pole at stall, the border of the
// published voltage gain, a wall at the edge of stability. Documentation: docs/extremes.md
#include <fmt/format.h>

#include <cmath>

#include "campaigns/extremes/bench.hpp"
#include "feltgate/largest.hpp"
#include "studies/stability/bit_loop.hpp"
#include "studies/stability/linear_loop.hpp"
#include "studies/stability/loop_poles.hpp"

namespace feltgate::extremes {

namespace {

constexpr double count_rad = 6.283185307179586 / 4096;
constexpr double g = 500, jn = 4.896e-4, ktn = 0.0605;
constexpr double torque_lsb = 1.0 / 65536;

/// Registers of `wide` for one Kp.
std::map<std::string, double> gains(double kp) {
  return {{"torque_gain", jn * kp / ktn}, {"observer_gain", (1 - jn * kp) / ktn}};
}

Outcome stall_pole(const Settings&) {
  use_wide_design();
  Outcome o;
  for (const double kp : {0.0, 800.0, 1600.0, 3000.0, 4000.0}) {
    Bench b(FELTGATE_WIDE_DESIGN, Cores::lock_step);
    for (const auto& [name, value] : gains(kp)) b.set(name, value);
    b.set("current_limit", 31);
    b.set("setpoint_torque", 0);
    b.arm("setpoint");
    b.set("setpoint_torque", 0.2);
    const double pole = g * jn * kp;
    const double settle = kp > 0 ? std::log(50) / pole : 0;
    std::int64_t begin = -1;
    double at = 0, real_at = 0, last = 0, real_last = 0;
    b.run(b.ticks(kp > 0 ? 2.6 * settle + 1e-3 : 10e-3), [&](const Sample& x) {
      if (begin < 0 && x.core.tau_ref_nm != 0) begin = x.tick;
      const double t = static_cast<double>(x.tick - begin) * 1e-6;
      if (std::abs(x.core.tau_hat_nm - 0.2) > 0.004) at = t;
      if (std::abs(x.real.tau_hat_nm - 0.2) > 0.004) real_at = t;
      last = x.core.tau_hat_nm;
      real_last = x.real.tau_hat_nm;
    });
    b.report(&o);
    const std::string in = ", Kp = " + number(kp);
    if (kp > 0) {
      o.add(Cores::lock_step, "2 % settling: ln 50/(g Jn Kp)" + in, "ms",
            near(1e3 * settle, 4e-3 * 1e3 * settle), 1e3 * at, 1e3 * real_at);
    }
    const double rest = kp > 0 ? 0.2 * (1 - std::exp(-2.6 * std::log(50))) : 0;
    o.add(Cores::lock_step, "tau_hat at the end" + in, "Nm",
          near(rest, kp > 0 ? 4 * torque_lsb : 0), last, real_last);
  }
  o.note = "Test-only design `wide`: JnKp from 0 to 1.96, so beyond Kp = 1/Jn = 2042 too.";
  return o;
}

/// Returns the design with this Kp, for the pole finder.
design::Elaborated wide_at(double kp, const Settings& s) {
  design::Design d = design::read_design(FELTGATE_WIDE_DESIGN);
  d.kp_1_kg_m2 = kp;
  return elaborate(d, design::read_registers(s.root + "/rtl/registers.toml"));
}

plant::Parameters plant_at(const Settings& s, double inertia, double ratio) {
  plant::Parameters p = linear_plant(s, 0);
  p.lever.inertia_kg_m2 = inertia / ratio;
  return p;
}

double first_unstable_ratio(double kp, double about, const Settings& s) {
  const design::Elaborated e = wide_at(kp, s);
  double low = 0.9 * about, high = 1.1 * about;
  for (int i = 0; i < 8; ++i) {
    const double middle = (low + high) / 2;
    (stability::closed_loop(e, plant_at(s, jn, middle)).stable() ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Result after the hand lets go of a lever at 20 rad/s.
struct LetGo {
  double late_share = 0;   ///< largest current of the last 20 ms over its limit; a trip counts as 1
  double speed_ratio = 0;  ///< speed at the end divided by the speed at release
};
LetGo let_go(const std::string& design, const plant::Parameters& plant,
             const std::map<std::string, double>& parameters, Driver driver, Outcome* o) {
  constexpr double seconds = 0.2, limit_a = 30;
  Scenario scene;
  scene.name = "let_go";
  scene.duration_s = seconds;
  scene.arm_s = 1e-3;
  scene.parameters = parameters;
  scene.parameters["overspeed"] = 1000;
  scene.parameters["current_limit"] = limit_a;
  scene.parameters["voltage_window"] = 24;
  scene.parameters["i2t_budget"] = 1e9;
  plant::HandPhase hand;
  hand.kind = plant::HandPhase::Kind::kPrescribed;
  hand.duration_s = 0.02;
  hand.profile = {{plant::Segment::Kind::kRamp, 0.04, 0.8, 0, 0, 0}};
  scene.hand.phases = {hand, plant::HandPhase{}};
  LetGo out;
  double at_release = 0;
  run_loop(scene, plant, design, driver, o, [&](const Row& r) {
    if (r.time_s < 0.0199) at_release = r.omega_rad_s;
    out.speed_ratio = at_release != 0 ? r.omega_rad_s / at_release : 1;
    if (r.time_s > seconds - 0.02) {
      out.late_share = larger(out.late_share, std::abs(r.current_a) / limit_a);
    }
    if (r.faults != 0) out.late_share = 1;
  });
  return out;
}

Outcome inertia_ratio(const Settings& s) {
  use_wide_design();
  Outcome o;
  const struct {
    double kp, ratio;
    bool rtl;
  } published[] = {{0, 4.78, true},
                   {800, 11.5, false},
                   {1600, 47.5, false},
                   {3000, 2.7, false},
                   {4000, 1.75, true}};
  for (const auto& p : published) {
    const double limit = first_unstable_ratio(p.kp, p.ratio, s);
    const std::string in = ", Kp = " + number(p.kp);
    Finding pole{
        "first unstable Jn/J, by the poles" + in, "", near(p.ratio, 0.02 * p.ratio), {}, {}, limit};
    o.findings.push_back(pole);
    for (const double share : {0.8, 1.25}) {
      Finding f{"share of the current's limit, " + number(share) + " of that ratio" + in,
                "",
                share < 1 ? at_most(0.12) : at_least(0.5),
                {},
                {},
                {}};
      f.chaotic = true;
      for (const Driver d : {p.rtl ? Driver::lock_step : Driver::twin, Driver::real}) {
        const auto plant = plant_at(s, jn, share * limit);
        fill(&f, d, let_go(FELTGATE_WIDE_DESIGN, plant, gains(p.kp), d, &o).late_share);
      }
      o.findings.push_back(f);
    }
  }
  o.note =
      "The hand lets go at 20 rad/s; linear plant without friction, one voltage gain of 1 ohm, "
      "current limit 30 A. Largest current in the last 20 of 200 ms; a trip counts as 1. Expected "
      "in the first rows of each Kp: the published study.";
  return o;
}

Outcome lever_inertia(const Settings& s) {
  Outcome o;
  const auto e = elaborate(design::read_design(s.root + "/rtl/designs/lever.toml"),
                           design::read_registers(s.root + "/rtl/registers.toml"));
  for (const double ratio : {0.5, 1.0, 4.0, 10.0, 50.0}) {
    const plant::Parameters plant = plant_at(s, 1.22e-4, ratio);
    const std::string in = ", Jn/J = " + number(ratio);
    int unstable = 0;
    for (const auto& region : stability::closed_loop(e, plant).regions) unstable += region.unstable;
    Finding poles{"unstable poles" + in, "", exactly(0), {}, {}, static_cast<double>(unstable)};
    o.findings.push_back(poles);
    Finding speed{
        "speed 180 ms after release over that at release" + in, "", between(0.5, 1.02), {}, {}, {}};
    Finding current{"share of the current's limit" + in, "", exactly(0), {}, {}, {}};
    for (const Driver d : {ratio == 50 ? Driver::lock_step : Driver::twin, Driver::real}) {
      const LetGo l = let_go("lever", plant, {}, d, &o);
      fill(&speed, d, l.speed_ratio);
      fill(&current, d, l.late_share);
    }
    speed.chaotic = true;
    o.findings.push_back(speed);
    o.findings.push_back(current);
  }
  o.note =
      "`lever` holds Kp at 1/Jn, so its observer is not in the loop and Kp has no other value; the "
      "free lever runs on, because the core compensates its back-EMF. RTL: Jn/J = 50.";
  return o;
}

/// Returns the voltage at stall for a constant reference, after the observer has settled.
double stall_voltage(Bench& b, double tau, double* real) {
  double core = 0;
  b.set("setpoint_torque", tau);
  b.run(b.ticks(20e-3), [&](const Sample& x) {
    core = x.core.voltage_v;
    *real = x.real.voltage_v;
  });
  return core;
}

Outcome border_015(const Settings&) {
  Outcome o;
  Bench b("paper", Cores::lock_step);
  b.set("dead_voltage", 0);
  b.set("dead_voltage_slope", 0);
  b.set("setpoint_torque", 0);
  b.arm("setpoint");
  double real_below = 0, real_above = 0;
  const double below = stall_voltage(b, 9830 * torque_lsb, &real_below);
  const double above = stall_voltage(b, 9831 * torque_lsb, &real_above);
  b.report(&o);
  const double v_below = 1.25 * 0.15 / ktn, v_above = 0.95 * 0.15 / ktn;
  const double nm_per_v = 0.0302 / 0.42;
  o.add(Cores::lock_step, "voltage at 0.15 Nm: 1.25 tau/Ktn", "V", near(v_below, 2e-3), below,
        real_below);
  o.add(Cores::lock_step, "voltage one step above: 0.95 tau/Ktn", "V", near(v_above, 2e-3), above,
        real_above);
  o.add(Cores::lock_step, "motor torque across the border", "mNm",
        near(1e3 * nm_per_v * (v_above - v_below), 0.1), 1e3 * nm_per_v * (above - below),
        1e3 * nm_per_v * (real_above - real_below));
  o.note = fmt::format(
      "Blocked lever, dead-time compensation off: a user who pushes deeper feels {:.1f} mNm less. "
      "Motor torque: Kt/R of the 24 V winding times the voltage.",
      1e3 * nm_per_v * (v_below - v_above));
  return o;
}

Outcome lever_monotone(const Settings&) {
  Outcome o;
  Bench b("lever", Cores::lock_step);
  b.set("setpoint_torque", 0);
  b.arm("setpoint");
  // A step of the reference per tick, from one limit to the other; no state lies in between.
  double before = 1e9, least = 1e9, real_before = 1e9, real_least = 1e9;
  for (int raw = -32768; raw <= 32768; raw += 61) {
    b.set("setpoint_torque", raw * torque_lsb);
  }
  bool begun = false;
  b.run(1090, [&](const Sample& x) {
    if (x.core.tau_ref_nm < -0.4999) begun = true;
    if (!begun) return;
    if (before < 1e8) least = std::min(least, x.core.voltage_v - before);
    if (real_before < 1e8) real_least = std::min(real_least, x.real.voltage_v - real_before);
    before = x.core.voltage_v;
    real_before = x.real.voltage_v;
  });
  b.report(&o);
  o.add(Cores::lock_step, "least step of the voltage from -0.5 to 0.5 Nm", "V", at_least(0), least,
        real_least);
  o.add(Cores::lock_step, "voltage at 0.5 Nm: R tau/Ktn + Vd", "V",
        near(0.42 * 0.5 / 0.0302 + 0.34 + 25.4 * 25 / 1000, 2e-2), before, real_before);
  return o;
}

/// A constant torque presses a lever into a wall; the lever is released away from its resting
/// depth. Returns the slope of the logarithm of the swing's size over its half periods.
double growth(const Settings& s, double stiffness, double damping, double seconds, Driver driver,
              Outcome* o) {
  constexpr double press_nm = 0.45;
  const double depth = press_nm / stiffness;
  Scenario scene;
  scene.name = "wall_edge";
  scene.duration_s = seconds;
  scene.arm_s = 0;
  scene.scene = "wall";
  // The voltage law has only its gains, as in the eigenvalues.
  scene.parameters = {{"ramp_step", 1},          {"wall_contact", 0},
                      {"wall_damping", damping}, {"wall_stiffness", stiffness * count_rad},
                      {"dead_voltage", 0},       {"dead_voltage_slope", 0},
                      {"torque_limit", 0.95},    {"current_limit", 31.5},
                      {"voltage_window", 24},    {"i2t_budget", 1e9}};
  plant::HandPhase hand;
  hand.kind = plant::HandPhase::Kind::kTorque;
  hand.profile = {{plant::Segment::Kind::kStep, 1.0, press_nm, 0, 0, 0}};
  scene.hand.start_rad = 0.5 * depth;
  scene.hand.phases = {hand};
  double extreme = 0, before = 0, n = 0, t = 0, y = 0, tt = 0, ty = 0;
  int seen = 0;
  run_loop(scene, linear_plant(s, 1e-3), "lever", driver, o, [&](const Row& r) {
    if (before * r.omega_rad_s < 0) {
      const double size = std::log(std::abs(r.theta_rad - extreme) / 2);
      extreme = r.theta_rad;
      if (++seen > 3) {
        n += 1;
        t += r.time_s;
        y += size;
        tt += r.time_s * r.time_s;
        ty += r.time_s * size;
      }
    }
    if (r.omega_rad_s != 0) before = r.omega_rad_s;
  });
  return (ty - t * y / n) / (tt - t * t / n);
}

Outcome wall_edge(const Settings& s) {
  Outcome o;
  constexpr double damping = 0.001;
  const auto e = elaborate(design::read_design(s.root + "/rtl/designs/lever.toml"),
                           design::read_registers(s.root + "/rtl/registers.toml"));
  const plant::Parameters plant = linear_plant(s, 1e-3);
  const stability::LoopModel model = stability::make_model(e, plant);
  const stability::Border edge = stability::border(model, damping, 1);
  const double closed = stability::closed_form_with_estimator(model, damping, 1);
  Finding border{"largest stable stiffness by eigenvalues; expected (b + B)/(T/2 + td)",
                 "Nm/rad",
                 near(closed, 0.08 * closed),
                 {},
                 {},
                 edge.stiffness_nm_rad};
  o.findings.push_back(border);
  for (const double share : {0.95, 1.05}) {
    const double k = share * edge.stiffness_nm_rad;
    const stability::Wall wall{k, damping, 1};
    const double sigma = stability::poles(model, wall).front().real();
    Finding f{"growth of the swing at " + number(share) + " of it; expected the eigenvalue's",
              "rad/s",
              near(sigma, 0.2 * std::abs(sigma)),
              {},
              {},
              {}};
    f.chaotic = true;
    fill(&f, Driver::lock_step, growth(s, k, damping, 0.25, Driver::lock_step, &o));
    f.real = stability::swing(e, plant, wall, "double", edge.rad_s).rate_1_s;
    o.findings.push_back(f);
  }
  o.note =
      "Wall of the core with B = 1e-3 Nm s/rad, linear plant with b = 1e-3 Nm s/rad, nothing in "
      "the voltage law but gains; slope of the logarithm of the swing over 0.25 s. Double: the "
      "chain with the ticks and PWM periods of `feltgate stability`.";
  return o;
}

}  // namespace

std::vector<Case> loop_cases() {
  return {
      {"Loop", "stall_pole", "A blocked lever: tau_hat follows with the pole g Jn Kp, whatever Kp.",
       stall_pole},
      {"Loop", "inertia_ratio",
       "Nominal over true inertia, for five Kp: below the ratio of the poles the free lever is "
       "stable, above it runs away.",
       inertia_ratio},
      {"Loop", "lever_inertia", "`lever` around any inertia: no unstable pole, nothing grows.",
       lever_inertia},
      {"Loop", "border_015",
       "The published voltage gain changes at 0.15 Nm: the torque falls while the reference rises.",
       border_015},
      {"Loop", "lever_monotone", "`lever` over the whole range: the voltage never falls.",
       lever_monotone},
      {"Loop", "wall_edge",
       "A wall at 0.95 and 1.05 of the largest stable stiffness: the swing decays and grows.",
       wall_edge},
  };
}

}  // namespace feltgate::extremes
