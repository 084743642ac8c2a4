// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// False alarms of the designs with a current loop, an absolute encoder or three phases: motors that
// differ from the design, hands, and torques that step. Documentation: docs/testing.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "campaigns/faults/clean.hpp"
#include "campaigns/faults/option_rig.hpp"

namespace feltgate::faults {

namespace {

using test::Random;

constexpr double kLife_s = 0.5;  ///< of one motor, from power-up on

/// Between the two, evenly.
double within(Random* r, double low, double high) {
  return low + (high - low) * 1e-6 * static_cast<double>(r->below(1'000'001));
}

/// A motor of `warm` times the resistance, a supply and a brush drop that are not quite those of
/// the design.
plant::Parameters another(plant::Parameters p, double warm, Random* r) {
  const double iron = within(r, 0.8, 1.25), magnet = within(r, 0.95, 1.05);
  p.motor.resistance_ohm *= warm;
  p.motor.inductance_h *= iron;
  p.motor.torque_constant_nm_a *= magnet;
  p.motor.back_emf_constant_v_s_rad *= magnet;
  p.motor.dead_voltage_v *= within(r, 0, 1.3);
  if (p.phases) {
    p.phases->resistance_ohm *= warm;
    p.phases->inductance_h *= iron;
    p.phases->back_emf_v_s_rad *= magnet;
  }
  p.supply.voltage_v *= within(r, 0.95, 1.1);
  return p;
}

template <class D>
void life(const char* plant_name, const std::string& root, Random* r, double most_rad_s,
          double seconds, CleanResult* result) {
  const DesignInfo& info = Rig<D>::info();
  const auto word = [&info](const char* name, double value) {
    const ParameterInfo* p = info.find(name);
    return Word{p->address, static_cast<std::uint32_t>(quantise_parameter(*p, value))};
  };
  const double warm = within(r, 0.8, 1.2);
  const auto plant =
      another(plant::read_plant_file(root + "/vectors/plants/" + plant_name + ".toml"), warm, r);
  // Held in a hand that sways, or moved by one; not let go, for a torque would make it too fast.
  const double from_rad = within(r, -1, 1);
  const bool moved = r->coin();
  const double rad_s = within(r, -most_rad_s, most_rad_s);
  const plant::Hand hand = moved ? moving_hand(from_rad, rad_s)
                                 : leaning_hand(from_rad, from_rad + within(r, -0.5, 0.5),
                                                within(r, 0, 0.3), within(r, 0.5, 8));
  static constexpr std::array scenes{"setpoint", "setpoint",       "wall",
                                     "damper",   "spring_tension", "free"};
  const char* scene = scenes[r->below(scenes.size())];
  const auto control = static_cast<std::uint32_t>(D::control_reset) | 1U << D::C::control_host |
                       static_cast<std::uint32_t>(info.scene_number(scene)) << D::C::control_scene;
  Rig<D> rig(plant, hand);
  // Without it the steps are ramps of a tenth of a second.
  if (r->coin()) rig.write({D::A::ramp_step, (1U << (D::P::ramp_step.width() - 1)) - 1});
  rig.write({D::C::control, control});
  const auto run_to = [&](double s) {
    while (rig.now() < static_cast<Clock>(s * D::clock_hz)) rig.step();
  };
  run_to(0.011);  // the offset of a current takes 512 PWM periods
  rig.write({D::C::control, control | 1U << D::C::control_arm});
  const double limit_nm = info.find("torque_limit")->si;
  run_to(0.012);
  for (double now_s = 0.012; now_s < seconds; run_to(now_s)) {
    rig.write(word("setpoint_torque", within(r, -limit_nm, limit_nm)));
    now_s = std::min(seconds, now_s + within(r, 0.002, 0.06));
  }
  result->scenes_s += seconds;
  const CoreOut& o = rig.out();
  if (o.faults == 0 && o.armed) return;
  if (result->alarms++ == 0) {
    result->first = fmt::format(
        "{}, {} at {:.3g} rad/s, {:.2f} of the resistance, supply {:.1f} V: faults {:#x}, armed {}",
        scene, moved ? "moved" : "held", rad_s, warm, plant.supply.voltage_v, o.faults, o.armed);
  }
}

}  // namespace

CleanResult run_option_clean(const std::string& root, const std::string& design, double seconds,
                             std::uint64_t seed, const std::function<void(double)>& progress) {
  CleanResult result;
  Random random(seed);
  while (result.seconds() < seconds) {
    const double lasts_s = std::clamp(seconds - result.seconds(), 0.05, kLife_s);
    const bool found = with_option(design, [&](const auto& o) {
      using D = typename std::decay_t<decltype(o)>::Design;
      life<D>(o.plant, root, &random, o.most_rad_s, lasts_s, &result);
    });
    if (!found) {
      throw std::invalid_argument("no false alarms are looked for in the design " + design);
    }
    progress(std::min(1.0, result.seconds() / seconds));
  }
  return result;
}

}  // namespace feltgate::faults
