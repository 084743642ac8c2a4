// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extremes of the observer: no wind-up for any time of a blocked lever, the I2t trip, and rest.
// Documentation: docs/extremes.md
#include <cmath>
#include <set>
#include <tuple>

#include "campaigns/extremes/bench.hpp"
#include "feltgate/largest.hpp"

namespace feltgate::extremes {

namespace {

// The published constants; tests of the generator hold the design file to them.
constexpr double g = 500, jn = 4.896e-4, kp = 1600, ktn = 0.0605;
constexpr double beta = 1 - jn * kp;
constexpr double torque_lsb = 1.0 / 65536;

/// `paper`, lever blocked, the current at its limit for a while, then the reference turns round.
struct Release {
  double settling_s = 0, excess_nm = 0;
  std::int64_t sign_ticks = -1;
  int faults = 0;
};

struct Releases {
  Release core, real;
  double tau_hat_before_nm = 0;
  std::int64_t last_change_ticks = 0;  ///< the last tick with a change while blocked
};

Releases blocked(double seconds, Cores cores, Outcome* o) {
  constexpr double limit_a = 1.8, pull_nm = 0.3, release_nm = -0.05;
  Bench b("paper", cores);
  b.set("current_limit", limit_a);
  b.set("setpoint_torque", 0);
  b.set("hold_time", 8192);  // never: the torque must stay
  b.arm("setpoint");
  b.set("setpoint_torque", pull_nm);
  Releases r;
  double core_before = 0, real_before = 0;
  std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t> held{};
  std::int64_t k = 0;
  b.run(b.ticks(seconds), [&](const Sample& x) {
    core_before = x.core.tau_hat_nm;
    real_before = x.real.tau_hat_nm;
    const auto now = std::make_tuple(x.raw.tau_hat, x.raw.current_ref, x.raw.voltage, x.raw.duty);
    if (now != held) r.last_change_ticks = k;
    held = now;
    ++k;
  });
  r.tau_hat_before_nm = core_before;
  b.set("setpoint_torque", release_nm);
  std::int64_t since = -1;
  const double tau = 1 / (g * jn * kp);
  const auto note = [&](Release& e, double tau_hat, double current, double before) {
    const double step = before - release_nm;
    const double error = tau_hat - release_nm, t = static_cast<double>(since) * 1e-6;
    // The observer sees the current of the tick before.
    const double moving = std::max(0.0, t - 1e-6);
    e.excess_nm = larger(e.excess_nm, std::abs(error) - std::abs(step) * std::exp(-moving / tau));
    if (std::abs(error) > 0.02 * std::abs(step)) e.settling_s = t;
    if (e.sign_ticks < 0 && current < 0) e.sign_ticks = since;
  };
  b.run(b.ticks(25e-3), [&](const Sample& x) {
    if (since < 0 && std::abs(x.core.tau_ref_nm - release_nm) > torque_lsb) {
      core_before = x.core.tau_hat_nm;
      real_before = x.real.tau_hat_nm;
      return;
    }
    ++since;
    note(r.core, x.core.tau_hat_nm, x.core.current_a, core_before);
    note(r.real, x.real.tau_hat_nm, x.real.current_a, real_before);
    r.core.faults |= x.raw.faults;
  });
  b.report(o);
  return r;
}

void add_release(Outcome* o, const std::string& after, Cores cores, const Releases& r) {
  const double tau_ms = 1e3 / (g * jn * kp);
  o->add(cores, "2 % settling of tau_hat" + after + ": ln 50/(g Jn Kp)", "ms",
         near(std::log(50) * tau_ms, 0.02), 1e3 * r.core.settling_s, 1e3 * r.real.settling_s);
  o->add(cores, "error above exp(-t/2.553 ms)" + after, "Nm", at_most(3 * torque_lsb),
         r.core.excess_nm, r.real.excess_nm);
  o->add(cores, "ticks until the current turns" + after, "tick", exactly(0), r.core.sign_ticks,
         r.real.sign_ticks);
  o->add(cores, "faults" + after, "", exactly(0), r.core.faults);
}

Outcome windup_1_ms(const Settings&) {
  Outcome o;
  add_release(&o, " after 1 ms", Cores::lock_step, blocked(1e-3, Cores::lock_step, &o));
  return o;
}

Outcome windup_1_s(const Settings&) {
  Outcome o;
  const Releases all = blocked(1.0, Cores::twin, &o);
  add_release(&o, " after 1 s", Cores::twin, all);
  // The RTL reaches the same state in a fraction of that time; afterwards no signal changes.
  const Releases part = blocked(60e-3, Cores::lock_step, &o);
  add_release(&o, " after 60 ms", Cores::lock_step, part);
  o.add(Cores::twin, "last change of any signal while blocked", "ms", at_most(60),
        1e-3 * static_cast<double>(all.last_change_ticks));
  o.add(Cores::twin, "tau_hat after 1 s less that after 60 ms", "Nm", exactly(0),
        all.tau_hat_before_nm - part.tau_hat_before_nm);
  o.note = "RTL: blocked for 60 ms, after which torque, current, voltage and duty stand still.";
  return o;
}

Outcome windup_60_s(const Settings&) {
  Outcome o;
  const Releases r = blocked(60.0, Cores::twin, &o);
  add_release(&o, " after 60 s", Cores::twin, r);
  o.add(Cores::twin, "last change of any signal while blocked", "ms", at_most(60),
        1e-3 * static_cast<double>(r.last_change_ticks));
  o.note =
      "The twin, whole. The estimated current of 4.7 A stays below the nominal 5.77 A. The RTL's "
      "60 ms of windup_1_s hold for this case as well.";
  return o;
}

/// Returns the time at which the sum of I^2 - Inom^2 reaches the budget; the estimate follows the
/// closed form at stall.
double trip_time(double budget_a2_s, double tau_ref) {
  constexpr double r = 0.42, kv = 0.95, nominal = 5.77, limit = 8.264463;
  constexpr double dead = (24 + 2 * 0.7) * 25 / 2500;  // compensation of the dead time
  double sum = 0;
  std::int64_t k = 0;
  for (; sum < budget_a2_s * 1e6; ++k) {
    const double tau_hat = tau_ref * -std::expm1(-g * jn * kp * static_cast<double>(k) * 1e-6);
    const double i = std::min(limit, (jn * kp * tau_ref + beta * tau_hat) / ktn);
    const double estimate = (kv * i + dead) / r;
    sum += estimate * estimate - nominal * nominal;
  }
  return static_cast<double>(k) * 1e-6;
}

Outcome windup_trip(const Settings&) {
  Outcome o;
  for (const double share : {1.0, 0.005}) {
    const Cores cores = share < 1 ? Cores::lock_step : Cores::twin;
    const double budget = 730 * share;
    Bench b("paper", cores);
    b.set("setpoint_torque", 0);
    b.set("nominal_current_squared", 1e5);  // removes the heat of power-up
    b.run(b.ticks(6e-3));
    b.set("nominal_current_squared", 5.77 * 5.77);
    b.set("i2t_budget", budget * 1e6);
    b.arm("setpoint");
    b.set("setpoint_torque", 0.5);
    const double expected = trip_time(budget, 0.5);
    std::int64_t begin = -1, trip = -1;
    double tau_hat = 1, current = 1;
    int faults = 0, duty = 0;
    bool open = true;
    const double seconds = share < 1 ? 0.03 : 60.0;
    b.run(b.ticks(seconds), [&](const Sample& x) {
      if (begin < 0 && x.core.tau_ref_nm != 0) begin = x.tick;
      if (trip < 0 && x.raw.faults != 0) trip = x.tick;
      tau_hat = x.core.tau_hat_nm;
      current = x.core.current_a;
      faults = x.raw.faults;
      duty = static_cast<int>(x.raw.duty);
      open = (x.raw.limits & limit::gates_closed) == 0;
    });
    b.report(&o);
    const std::string in = ", budget " + number(budget) + " A^2 s";
    o.add(cores, "I2t trip at 19.3 A" + in, "s", near(expected, 2e-3 * expected + 3e-6),
          static_cast<double>(trip - begin) * 1e-6);
    o.add(cores, "faults: bit 4 is I2t" + in, "", exactly(16), faults);
    o.add(cores, "gates open, duty, current and tau_hat at the end" + in, "", exactly(0),
          std::abs(tau_hat) + std::abs(current) + std::abs(duty) + open);
  }
  o.note =
      "The twin, 60 s of 0.5 Nm against a blocked lever with the design's budget; RTL and twin, "
      "30 ms with a budget 200 times smaller in the register. Expected: the sum of the estimate's "
      "closed form.";
  return o;
}

Outcome rest(const Settings& s) {
  Outcome o;
  {
    Bench b("paper", Cores::lock_step);
    b.arm("free");
    double tau_hat = 0, duty = 0, real = 0;
    b.run(b.ticks(20e-3), [&](const Sample& x) {
      tau_hat = larger(tau_hat, std::abs(x.core.tau_hat_nm));
      real = larger(real, std::abs(x.real.tau_hat_nm));
      duty = larger(duty, std::abs(static_cast<double>(x.raw.duty)));
    });
    o.add(Cores::lock_step, "largest tau_hat, armed, never moved", "Nm", exactly(0), tau_hat, real);
    o.add(Cores::lock_step, "largest duty, never moved", "clock", exactly(0), duty);
    // A motion, then rest: the filters stop within their dead bands and stay there.
    b.turn(b.now(), 3000, 90);
    b.run(b.ticks(80e-3));
    std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>> states;
    double velocity = 0;
    tau_hat = real = 0;
    b.run(b.ticks(20e-3), [&](const Sample& x) {
      states.insert({x.raw.velocity, x.raw.tau_hat, x.raw.current_ref, x.raw.duty});
      velocity = larger(velocity, std::abs(x.core.velocity_rad_s));
      tau_hat = larger(tau_hat, std::abs(x.core.tau_hat_nm));
      real = larger(real, std::abs(x.real.tau_hat_nm));
    });
    b.report(&o);
    const double band = 0.5 / -std::expm1(-500e-6) * std::exp2(-21);
    o.add(Cores::lock_step, "states of the last 20 ms, 80 ms after a motion", "", exactly(1),
          states.size());
    o.add(Cores::lock_step, "velocity that stays: half an LSB over a1", "rad/s", at_most(band),
          velocity);
    o.add(Cores::lock_step, "tau_hat that stays", "Nm", at_most(torque_lsb), tau_hat, real);
  }
  // With motor and friction: the hand lets go of a moving lever.
  Finding edges{"counts in the last 60 ms of a free lever", "count", exactly(0), {}, {}, {}};
  Finding duties{"range of the duty there", "clock", at_most(1), {}, {}, {}};
  for (const Driver driver : {Driver::lock_step, Driver::real}) {
    Scenario scene;
    scene.name = "rest";
    scene.duration_s = 0.2;
    scene.arm_s = 1e-3;
    plant::HandPhase push;
    push.kind = plant::HandPhase::Kind::kPrescribed;
    push.duration_s = 0.03;
    push.profile = {{plant::Segment::Kind::kRamp, 0.03, 0.03, 0, 0, 0}};
    scene.hand.phases = {push, plant::HandPhase{}};
    Spread position, duty;
    run_loop(scene, shipped_plant(s, "p24"), "paper", driver, &o, [&](const Row& r) {
      if (r.time_s < 0.14) return;
      position.add(r.position_rad);
      duty.add(r.duty * 2500);
    });
    fill(&edges, driver, std::round(position.range() / (6.283185307179586 / 4096)));
    fill(&duties, driver, duty.range());
  }
  o.findings.push_back(edges);
  o.findings.push_back(duties);
  return o;
}

}  // namespace

std::vector<Case> observer_cases() {
  return {
      {"Observer", "windup_1_ms",
       "A blocked lever, current at its limit for 1 ms, then the reference turns round: nothing "
       "has wound up.",
       windup_1_ms},
      {"Observer", "windup_1_s", "The same after 1 s.", windup_1_s},
      {"Observer", "windup_60_s", "The same after 60 s, below the I2t limit.", windup_60_s},
      {"Observer", "windup_trip", "60 s above the I2t limit: when the supervisor ends it.",
       windup_trip},
      {"Observer", "rest",
       "At a torque reference of 0 the published observer shows 0 and nothing cycles.", rest},
  };
}

}  // namespace feltgate::extremes
