// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// False alarms. Documentation: docs/testing.md
#include "campaigns/faults/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "campaigns/faults/option_rig.hpp"
#include "campaigns/faults/world.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "random.hpp"
#include "sim/traces/open.hpp"
#include "twins.hpp"

namespace feltgate::faults {

namespace {

using test::Random;
using Core = test::CoreOf<Lever, false>;

constexpr int kTick = Lever::clocks_per_tick;

/// Half a newton metre for longer heats the motor, and I2t says so: from power-up on 1.5 s at 16.6
/// A.
constexpr double longest_push_s = 1.0;

/// Between the two, evenly.
double within(Random* r, double low, double high) {
  return low + (high - low) * 1e-6 * static_cast<double>(r->below(1'000'001));
}

void look(const CoreOut& o, bool armed, const std::string& where, CleanResult* result) {
  if (o.faults == 0 && o.armed == armed) return;
  if (result->alarms++ == 0)
    result->first = fmt::format("{}: faults {:#x}, armed {}", where, o.faults, o.armed);
}

void arm(Core* core, CoreIn* in, const std::vector<Word>& words, int scene) {
  in->scene = static_cast<std::uint8_t>(scene);
  core->run(*in, 4 * kTick, [] {});
  for (const Word& w : words) {
    in->reg_addr = static_cast<std::uint16_t>(w.address);
    in->reg_wdata = w.data;
    in->reg_write = true;
    core->clock(*in);
    in->reg_write = false;
    core->run(*in, 2 * kTick - 1, [] {});
  }
  in->arm = true;
}

/// A scene in closed loop with a hand of some strength and quickness.
void scene(const std::string& root, Random* r, double seconds, CleanResult* result) {
  static const std::vector<Act> all = acts();
  Act a = all[r->below(all.size() - 1)];
  if (a.hand.phases.front().kind == plant::HandPhase::Kind::kImpedance) {
    auto& profile = a.hand.phases.front().profile;
    profile[0].to *= 0.4 + within(r, 0, 1);
    profile[1].amplitude *= 2 * within(r, 0, 1);
    profile[1].frequency_hz *= 0.2 + 1.3 * within(r, 0, 1);
  } else {
    auto& ramp = a.hand.phases.front().profile.front();
    ramp.to *= 0.05 + 0.95 * within(r, 0, 1);
  }
  plant::Plant lever = make_plant(root, a.hand);
  Core core;
  CoreIn in;
  in.encoder = lever.encoder().pins();
  arm(&core, &in, a.words, a.scene);
  constexpr Clock step = 125;
  const auto steps = static_cast<std::int64_t>(seconds * 50e6) / step;
  Clock at = 0;
  for (std::int64_t k = 0; k < steps; ++k) {
    const CoreOut& o = core.out();
    lever.advance(plant::Bridge::averaged(static_cast<double>(o.duty_active) / Lever::pwm_period,
                                          o.gates_enable),
                  step);
    for (const EncoderEvent& e : lever.events()) {
      if (e.clock > at) core.run(in, e.clock - at, [] {});
      at = std::max(at, e.clock);
      in.encoder = e.pins;
    }
    core.run(in, lever.now() - at, [] {});
    at = lever.now();
  }
  result->scenes_s += static_cast<double>(steps * step) / 50e6;
  look(core.out(), true, "scene " + a.name, result);
}

/// A recording from its beginning to its end.
void recording(const std::string& path, Random* r, CleanResult* result) {
  Core core;
  CoreIn in;
  traces::Options options;
  const auto source = traces::open(path, options);
  in.encoder = source->initial();
  // Not a spring: a recording that stays away from its rest for seconds would heat the motor.
  constexpr std::array scenes{Lever::S::free, Lever::S::damper};
  arm(&core, &in, {}, scenes[r->below(scenes.size())]);
  Clock at = 0;
  while (const auto e = source->next()) {
    if (e->clock > at) core.run(in, e->clock - at, [] {});
    at = std::max(at, e->clock);
    in.encoder = e->pins;
  }
  const Clock end = std::max(at + kTick, source->length());
  core.run(in, end - at, [] {});
  result->recordings_s += static_cast<double>(end) / 50e6;
  look(core.out(), true, path, result);
}

/// A lever that rests on an edge and dithers, strokes, and rests.
void dither(Random* r, double seconds, CleanResult* result) {
  Core core;
  CoreIn in;
  arm(&core, &in, {}, Lever::S::free);
  core.run(in, 10 * kTick, [] {});
  std::int64_t count = 0;
  Clock at = 0;
  const auto end = static_cast<Clock>(seconds * 50e6);
  const auto step = [&](int by, Clock wait) {
    count += by;
    const auto phase = static_cast<unsigned>(count) & 3u;
    in.encoder.a = phase == 2 || phase == 3;
    in.encoder.b = phase == 1 || phase == 2;
    core.run(in, wait, [] {});
    at += wait;
  };
  while (at < end) {
    const auto kind = r->below(4);
    if (kind == 0) {  // one edge, up to 400 Hz, as a hand does
      const Clock half = r->between(62'500, 2'500'000);
      for (int k = 0; k < 40; ++k) step(k % 2 == 0 ? 1 : -1, half);
    } else if (kind == 1) {  // two edges and more
      const Clock half = r->between(5'000, 500'000);
      const int counts = static_cast<int>(r->between(2, 9));
      for (int k = 0; k < 40; ++k) {
        for (int n = 0; n < counts; ++n) step(k % 2 == 0 ? 1 : -1, half / counts + 1);
      }
    } else if (kind == 2) {  // a stroke, up to 590 rad/s
      const Clock each = r->between(130, 100'000);
      const int way = r->coin() ? 1 : -1;
      // It speeds up and slows down: no lever changes its speed at once.
      for (int n = 0; n < 300; ++n) {
        const Clock slow = std::max<Clock>(0, 150 - std::min(n, 300 - n)) * 400;
        step(way, std::max<Clock>(each, slow));
      }
    } else {
      step(0, r->between(1'000'000, 100'000'000));
    }
  }
  result->dither_s += static_cast<double>(at) / 50e6;
  look(core.out(), true, "dither", result);
}

// The designs with a current loop, an absolute encoder or three phases: motors that differ from the
// design, hands, and torques that step.
constexpr double kLife_s = 0.5;  ///< of one motor, from power-up on

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
    rig.write(word_of(info, "setpoint_torque", within(r, -limit_nm, limit_nm)));
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

CleanResult run_clean(const std::string& root, double seconds, std::uint64_t seed,
                      const std::function<void(double)>& progress) {
  CleanResult result;
  Random random(seed);
  const std::vector<std::string> recordings{root + "/vectors/traces/damper.vec",
                                            root + "/vectors/traces/membrane.vec",
                                            root + "/vectors/traces/torque_step_cord.vec"};
  while (result.seconds() < seconds) {
    if (result.scenes_s * 12 <= result.seconds()) {
      scene(root, &random, std::min(longest_push_s, seconds / 12), &result);
    } else if (result.recordings_s <= result.dither_s) {
      recording(recordings[random.below(recordings.size())], &random, &result);
    } else {
      dither(&random, std::min(60.0, seconds / 2), &result);
    }
    progress(std::min(1.0, result.seconds() / seconds));
  }
  return result;
}

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
