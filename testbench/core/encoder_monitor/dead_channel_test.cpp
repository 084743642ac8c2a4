// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Dead channels and healthy chatter in closed loop: the core's twin, motor, lever and hand.
// Documentation: docs/blocks/encoder.md
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "catch.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/causes.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "feltgate/largest.hpp"
#include "random.hpp"
#include "sim/plant/drive.hpp"
#include "sim/plant/hand.hpp"
#include "sim/plant/plant.hpp"
#include "sim/plant/plant_file.hpp"
#include "twins.hpp"

// The core's twin closed over motor, lever and hand, with an encoder whose channels may fail.

namespace feltgate::test {

/// The defect of the channels A and B.
enum class Break {
  none,
  a_low,
  a_high,
  a_held,
  b_low,
  b_high,
  b_held,
  both_a,  ///< shorted, A the stronger
  both_b,
  both_and,
  both_or,
};
inline constexpr int kBreaks = 11;

inline EncoderPins broken(Break how, EncoderPins now, EncoderPins held) {
  switch (how) {
    case Break::none:
      break;
    case Break::a_low:
      now.a = false;
      break;
    case Break::a_high:
      now.a = true;
      break;
    case Break::a_held:
      now.a = held.a;
      break;
    case Break::b_low:
      now.b = false;
      break;
    case Break::b_high:
      now.b = true;
      break;
    case Break::b_held:
      now.b = held.b;
      break;
    case Break::both_a:
      now.b = now.a;
      break;
    case Break::both_b:
      now.a = now.b;
      break;
    case Break::both_and:
      now.a = now.b = now.a && now.b;
      break;
    case Break::both_or:
      now.a = now.b = now.a || now.b;
      break;
  }
  return now;
}

/// One run.
struct Press {
  std::string scene = "wall";
  std::vector<std::pair<std::string, double>> parameters;  ///< in their units; angles in counts
  plant::Hand hand;
  double seconds = 1.0;
  Break how = Break::none;
  double broken_s = 1e9;   ///< when
  double limit_rad = 1e9;  ///< true travel after the break at which the run ends
  int filter = 0;          ///< the decoder's
  int bounce_clocks = 0;   ///< after each edge the channel goes back and comes again, each so long
};

/// The result of a run. Values "after the break" end when the gates close.
struct Pressed {
  unsigned faults = 0;
  double travel_rad = 0;   ///< since the break
  std::int64_t steps = 0;  ///< of the count, after the break
  int chatter = 0;         ///< times that the torque was frozen
  double longest_s = 0;    ///< the longest of these times
};

/// Runs it on the twin of design D.
template <class D>
Pressed press(const plant::Parameters& parameters, const Press& what) {
  const DesignInfo info = design_info<D>();
  plant::Plant lever(parameters, parameters.effects, plant::drive_of(info), what.hand);
  test::CoreOf<D, false> core;
  CoreIn in;
  constexpr Clock kStep = 25;
  in.encoder = lever.encoder().pins();
  const auto write = [&](int address, std::uint32_t data) {
    in.reg_write = true;
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = data;
    core.clock(in);
    in.reg_write = false;
    while (core.out().reg_busy || core.clock_of_tick() != 0) core.clock(in);
  };
  for (int k = 0; k < 4 * D::clocks_per_tick; ++k) core.clock(in);
  for (const auto& [name, value] : what.parameters) {
    const ParameterInfo* p = info.find(name);
    write(p->address, static_cast<std::uint32_t>(*quantised(*p, value)));
  }
  in.scene = static_cast<std::uint8_t>(info.scene_number(what.scene));
  using C = typename D::C;
  const std::uint32_t control = static_cast<std::uint32_t>(D::control_reset) |
                                1u << C::control_host |
                                std::uint32_t{in.scene} << C::control_scene |
                                static_cast<std::uint32_t>(what.filter) << C::control_filter;
  write(C::control, control);
  write(C::control, control | 1u << C::control_arm);
  Pressed seen;
  const double step_s = kStep / static_cast<double>(D::clock_hz);
  bool is_broken = false;
  EncoderPins pins = in.encoder, held = pins;
  double before_rad = lever.observables().theta_rad, frozen_s = 0;
  std::int32_t position = core.out().position;
  Clock at = 0;
  // The core runs one step behind the lever, so that bounce may last longer than the step.
  const auto until = [&](Clock clock) {
    if (clock > at) core.run(in, clock - at, [] {});
    at = std::max(at, clock);
  };
  for (std::int64_t k = 0; static_cast<double>(k) * step_s < what.seconds; ++k) {
    const CoreOut& o = core.out();
    const bool gates = o.gates_enable;
    lever.advance(
        plant::Bridge::averaged(o.duty_active / static_cast<double>(D::pwm_period), gates), kStep);
    if (!is_broken && static_cast<double>(k) * step_s >= what.broken_s) {
      is_broken = true;
      held = pins;
      in.encoder = broken(what.how, pins, held);
    }
    for (const EncoderEvent& e : lever.events()) {
      const EncoderPins before = in.encoder;
      pins = e.pins;
      until(e.clock - 1);
      in.encoder = is_broken ? broken(what.how, pins, held) : pins;
      if (what.bounce_clocks == 0) continue;
      const EncoderPins after = in.encoder;
      until(at + what.bounce_clocks);
      in.encoder = before;
      until(at + what.bounce_clocks);
      in.encoder = after;
    }
    until(lever.now());
    const auto& s = lever.observables();
    if (is_broken) {
      seen.steps += o.position != position;
      seen.travel_rad += std::abs(s.theta_rad - before_rad);
    }
    position = o.position;
    before_rad = s.theta_rad;
    const bool frozen = (o.limits & limit::chatter) != 0;
    seen.chatter += frozen && frozen_s == 0;
    frozen_s = frozen ? frozen_s + step_s : 0;
    seen.longest_s = std::max(seen.longest_s, frozen_s);
    if (o.faults != 0) {
      seen.faults = o.faults;
      break;
    }
    if (seen.travel_rad > what.limit_rad) break;
  }
  return seen;
}

}  // namespace feltgate::test

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr double kFoundRad = 0.08;
constexpr double kArmed_s = 0.11;  ///< the ramp after arming is over

plant::Parameters motor() {
  return plant::read_plant_file(FELTGATE_ROOT "/vectors/plants/p24.toml");
}

plant::HandPhase prescribed(double rad_s, double to_rad) {
  plant::HandPhase hand;
  hand.kind = plant::HandPhase::Kind::kPrescribed;
  plant::Segment rest, go;
  rest.kind = plant::Segment::Kind::kHold;
  rest.duration_s = kArmed_s;
  go.kind = plant::Segment::Kind::kRamp;
  go.duration_s = std::abs(to_rad) / rad_s;
  go.to = to_rad;
  hand.profile = {rest, go};
  return hand;
}

/// Faults of the encoder at one speed.
struct Found {
  int faults = 0, changed = 0, missed_changed = 0;
  double worst_rad = 0;
};

template <class D>
void break_at(double rad_s, int runs, std::uint64_t seed, Found* found) {
  constexpr std::array scenes{"wall", "membrane", "spring_tension", "damper", "free"};
  Random random(seed);
  const plant::Parameters p24 = motor();
  for (int k = 0; k < runs; ++k) {
    plant::Parameters p = p24;
    p.effects.encoder_imperfect = random.coin();
    p.encoder.seed = random.bits();
    Press what;
    what.scene = scenes[random.below(scenes.size())];
    what.parameters = {{"wall_contact", 20.0}, {"membrane_lower", 20.0}, {"membrane_upper", 40.0}};
    const double sign = random.coin() ? 1 : -1;
    what.hand.phases = {prescribed(rad_s, sign * 0.3)};
    what.how = static_cast<Break>(1 + random.below(kBreaks - 1));
    what.broken_s = kArmed_s + (0.05 + 1e-6 * static_cast<double>(random.below(100000))) / rad_s;
    what.seconds = what.broken_s + 2 * kFoundRad / rad_s;
    what.limit_rad = kFoundRad;
    const Pressed r = press<D>(p, what);
    const bool changed = r.steps > 1;  // the first step may come from the break itself
    ++found->faults;
    found->changed += changed;
    found->missed_changed += changed && r.faults == 0;
    if (r.faults == 0) continue;
    found->worst_rad = feltgate::larger(found->worst_rad, r.travel_rad);
  }
}

/// Healthy levers that stay on an edge or near it.
struct Clean {
  int froze = 0, faults = 0;
  double longest_s = 0;
  void add(const Pressed& r) {
    froze += r.chatter;
    faults += (r.faults & 1u << static_cast<unsigned>(Fault::channel)) != 0;
    longest_s = std::max(longest_s, r.longest_s);
  }
};

enum class Kind { friction, bare, quick };  ///< quick: no inductance delays the torque

plant::Parameters lever_of(Kind kind) {
  plant::Parameters p = motor();
  p.effects.lugre = kind != Kind::bare;
  p.effects.viscous = kind == Kind::bare;
  p.effects.inductance = kind != Kind::quick;
  return p;
}

/// A lever that rests within a count of the face and is then pushed against it.
template <class D>
Pressed at_the_face(Kind kind, const char* scene, double push_nm, double damping, double seconds,
                    Random* random) {
  const auto share = [random] { return 1e-6 * (1 + static_cast<double>(random->below(999998))); };
  Press what;
  what.scene = scene;
  what.seconds = kArmed_s + seconds;
  what.parameters = {{"wall_contact", 1.0},
                     {"wall_damping", damping},
                     {"membrane_lower", 1.0},
                     {"membrane_upper", 200.0}};
  plant::HandPhase rest;
  rest.kind = plant::HandPhase::Kind::kLocked;
  rest.duration_s = kArmed_s;
  what.hand.phases = {rest, plant::pushing_hand(push_nm, 0.001 + 0.05 * share()).phases.front()};
  what.hand.start_rad = -D::count_rad * share() + 3 * D::count_rad;
  return press<D>(lever_of(kind), what);
}

/// A hand with mass, stiffness and damping that leans on the face.
template <class D>
Pressed leaning(const char* scene, double push_nm, double damping, double seconds) {
  Press what;
  what.scene = scene;
  what.seconds = seconds;
  what.parameters = {{"wall_contact", 5.0},
                     {"wall_damping", damping},
                     {"membrane_lower", 5.0},
                     {"membrane_upper", 200.0}};
  plant::HandPhase lean;
  lean.kind = plant::HandPhase::Kind::kImpedance;
  plant::Segment jerk;
  jerk.kind = plant::Segment::Kind::kMinimumJerk;
  jerk.duration_s = 0.3;
  jerk.to = push_nm / 1.35;  // 135 N/m at 0.1 m
  lean.profile = {jerk};
  what.hand.phases = {lean};
  return press<D>(motor(), what);
}

/// A hand that moves the lever back and forth over one edge.
template <class D>
Pressed dithers(double hz, double counts, int filter, int bounce_clocks) {
  Press what;
  what.scene = "wall";
  what.seconds = 0.4;
  what.filter = filter;
  what.bounce_clocks = bounce_clocks;
  what.parameters = {{"wall_contact", 0.0}};
  plant::HandPhase dither;
  dither.kind = plant::HandPhase::Kind::kPrescribed;
  plant::Segment sine;
  sine.kind = plant::Segment::Kind::kSine;
  sine.duration_s = 10;
  sine.amplitude = counts * D::count_rad;
  sine.frequency_hz = hz;
  dither.profile = {sine};
  what.hand.phases = {dither};
  what.hand.start_rad = 0.0;
  return press<D>(motor(), what);
}

/// Speeds of a hand on a healthy encoder: motion with bounce below the glitch filter.
template <class D>
Pressed moves(double rad_s, int filter, int bounce_clocks) {
  Press what;
  what.scene = "spring_tension";
  what.filter = filter;
  what.bounce_clocks = bounce_clocks;
  what.hand.phases = {prescribed(rad_s, 0.3)};
  what.seconds = kArmed_s + 0.3 / rad_s;
  return press<D>(motor(), what);
}

template <class D>
void expect_found(double rad_s, int runs, std::uint64_t seed) {
  Found found;
  break_at<D>(rad_s, runs, seed, &found);
  INFO(rad_s << " rad/s: " << found.faults << " faults, " << found.changed
             << " change the count, missed of these " << found.missed_changed << ", worst "
             << found.worst_rad << " rad");
  CHECK(found.changed * 4 > found.faults);
  CHECK(found.missed_changed * 100 <= found.changed);
  CHECK(found.worst_rad <= kFoundRad);
}

template <class D>
void expect_quiet(std::uint64_t seed) {
  Random random(seed);
  Clean clean, quick;
  for (const double push : {0.05, 0.25, 0.45}) {
    for (const char* scene : {"membrane", "wall"}) {
      const double damping = random.coin() ? 0.065 : 0.0;
      clean.add(at_the_face<D>(Kind::friction, scene, push, damping, 0.15, &random));
      clean.add(at_the_face<D>(Kind::bare, scene, push, damping, 0.15, &random));
      quick.add(at_the_face<D>(Kind::quick, scene, push, damping, 0.25, &random));
    }
  }
  clean.add(leaning<D>("membrane", 0.25, 0.0, 0.5));
  clean.add(dithers<D>(12, 0.5, 0, 0));
  clean.add(dithers<D>(300, 0.9, 0, 0));
  clean.add(moves<D>(3.0, 8, 5));
  CHECK(clean.faults == 0);
  CHECK(quick.faults == 0);
}

}  // namespace

TEST_CASE("encoder_monitor: a dead channel is found within 0.08 rad from 3 rad/s on") {
  for (const double rad_s : {3.0, 6.0, 40.0}) {
    expect_found<feltgate::Lever>(rad_s, 40, 1);
    expect_found<Paper>(rad_s, 40, 2);
  }
}

TEST_CASE("encoder_monitor: healthy levers on an edge have no fault") {
  expect_quiet<feltgate::Lever>(3);
  expect_quiet<Paper>(4);
}

TEST_CASE("encoder_monitor: chatter of a quick motor is frozen and ends") {
  Random random(5);
  Clean clean;
  for (int k = 0; k < 6; ++k) {
    clean.add(at_the_face<feltgate::Lever>(Kind::quick, "membrane", 0.25, 0, 0.3, &random));
  }
  CHECK(clean.faults == 0);
  CHECK(clean.froze > 0);
  CHECK(clean.longest_s < 0.005);
}
