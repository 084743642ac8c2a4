// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extremes of the scenes: 1/x^2 through zero, its limit cycle with a hand, the linear core that
// ends this cycle, and the border in the published voltage gain. Documentation: docs/extremes.md
#include <cmath>

#include "campaigns/extremes/bench.hpp"
#include "feltgate/largest.hpp"

namespace feltgate::extremes {

namespace {

constexpr double count_rad = 6.283185307179586 / 4096;
constexpr double charge = 0.02;  // Nm rad^2

/// The law from the documentation; x in counts, width of the core in rad, 0 for none.
double law(bool attract, int x, double core_rad) {
  const double rad = x * count_rad;
  double pull;  // towards the charge, along -x
  if (core_rad > 0 && std::abs(rad) < core_rad) {
    pull = charge * rad / (core_rad * core_rad * core_rad);
  } else if (x == 0) {
    pull = 0.5;  // sgn(0) = +1
  } else {
    pull = std::min(0.5, charge / (rad * rad)) * (x > 0 ? 1 : -1);
  }
  return attract ? -pull : pull;
}

Outcome charge_through_zero(const Settings&) {
  Outcome o;
  for (const char* design : {"paper", "lever"}) {
    const bool raw = std::string(design) == "paper";
    for (const char* scene : {"charge_attract", "charge_repel"}) {
      const bool attract = std::string(scene) == "charge_attract";
      Bench b(design, Cores::lock_step);
      b.arm(scene);
      constexpr int reach = 260;
      for (int k = 1; k <= reach; ++k) b.move(b.now() + 40 * k, 1);
      b.run(reach + 4);
      double worst = 0, real_worst = 0, at_zero = 0, real_at_zero = 0, beside = 0, real_beside = 0;
      const Clock begin = b.now();
      for (int k = 1; k <= 2 * reach; ++k) b.move(begin + 50 * k, -1);
      b.run(2 * reach + 4, [&](const Sample& x) {
        const int at = x.raw.position;
        const double expected = law(attract, at, raw ? 0 : 0.2);
        worst = larger(worst, std::abs(x.core.tau_ref_nm - expected));
        real_worst = larger(real_worst, std::abs(x.real.tau_ref_nm - expected));
        if (at == 0) {
          at_zero = x.core.tau_ref_nm;
          real_at_zero = x.real.tau_ref_nm;
        }
        if (at == -1) {
          beside = x.core.tau_ref_nm;
          real_beside = x.real.tau_ref_nm;
        }
      });
      b.report(&o);
      const std::string in =
          std::string(" (") + design + ", " + (attract ? "attract" : "repel") + ")";
      o.add(Cores::lock_step, "worst distance from the law, x = 260 to -260" + in, "Nm",
            at_most(raw ? 1.0 / 65536 : 2.0 / 65536), worst, real_worst);
      o.add(Cores::lock_step, "torque at x = 0" + in, "Nm", exactly(law(attract, 0, raw ? 0 : 0.2)),
            at_zero, real_at_zero);
      const double step = law(attract, -1, raw ? 0 : 0.2);
      o.add(Cores::lock_step, "torque one count below" + in, "Nm", near(step, 1.0 / 65536), beside,
            real_beside);
    }
  }
  return o;
}

/// A hand rests on an attracting charge with a linear core of this width; measures the torque after
/// `seconds`.
void hold_on_charge(const Settings& s, double core_rad, double seconds, Finding* half, Finding* rms,
                    Driver driver, Outcome* o) {
  Scenario scene;
  scene.name = "charge";
  scene.duration_s = seconds;
  scene.arm_s = 1e-3;
  scene.scene = "charge_attract";
  const double counts = std::ceil(core_rad / count_rad);
  const double slope = core_rad > 0 ? charge / std::pow(core_rad, 3) * count_rad : 0;
  scene.parameters = {{"attract_core", counts}, {"ramp_step", 1}};
  // The slope's word has the range of a design with a core of 0.2 rad; a narrower core needs more.
  if (core_rad > 0) scene.parameters["attract_core_slope"] = slope;
  plant::HandPhase hand;
  hand.kind = plant::HandPhase::Kind::kImpedance;
  scene.hand.start_rad = 2.5 * count_rad;  // the hand also wants to stay here
  scene.hand.radius_m = 0.2;
  scene.hand.phases = {hand};
  Spread torque;
  run_loop(scene, shipped_plant(s, "p24"), "lever", driver, o, [&](const Row& r) {
    if (r.time_s > seconds / 2) torque.add(r.tau_ref_nm);
  });
  fill(half, driver, torque.range() / 2);
  fill(rms, driver, torque.rms());
}

Outcome charge_limit_cycle(const Settings& s) {
  Outcome o;
  Finding raw{"half the range of the torque, raw 1/x^2", "Nm", near(0.5, 1e-3), {}, {}, {}};
  Finding core{"half the range of the torque, core of 0.2 rad: under one count of 2.5 Nm/rad",
               "Nm",
               at_most(2.5 * count_rad),
               {},
               {},
               {}};
  // A square wave would have 0.5, a sine between the limits 0.35.
  Finding raw_rms{"root mean square of it", "Nm", between(0.35, 0.5), {}, {}, {}};
  Finding core_rms{"root mean square of it", "Nm", at_most(2.5 * count_rad * 3), {}, {}, {}};
  for (Finding* f : {&raw, &core, &raw_rms, &core_rms}) f->chaotic = true;
  for (const Driver d : {Driver::lock_step, Driver::real}) {
    hold_on_charge(s, 0.0, 0.2, &raw, &raw_rms, d, &o);
    hold_on_charge(s, 0.2, 0.2, &core, &core_rms, d, &o);
  }
  o.findings = {raw, raw_rms, core, core_rms};
  return o;
}

}  // namespace

std::vector<Case> scene_cases() {
  return {
      {"Scenes", "charge_through_zero",
       "A point charge from one side to the other, count by count: raw 1/x^2 in `paper`, with its "
       "linear core in `lever`.",
       charge_through_zero},
      {"Scenes", "charge_limit_cycle",
       "A hand held on an attracting charge: the raw law cycles at full torque, the core of 0.2 "
       "rad is quiet.",
       charge_limit_cycle},
  };
}

}  // namespace feltgate::extremes
