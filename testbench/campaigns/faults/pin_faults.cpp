// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Faults at the pins and at the register port. Documentation: docs/testing.md
#include "campaigns/faults/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "campaigns/faults/world.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "random.hpp"
#include "sim/plant/hand.hpp"
#include "twins.hpp"

namespace feltgate::faults {

namespace {

using test::Random;
using D = Lever;

constexpr int kTick = D::clocks_per_tick;

/// A level that is wrong for a while: A, B, Z by bit.
struct Pulse {
  Clock from, to;
  unsigned channels;
};

/// What is done to the pins, from a clock on.
struct Break {
  enum class Kind { none, levels, shorted_a, shorted_b, shorted_and, shorted_or, swapped };
  Kind kind = Kind::none;
  Clock from = 0;
  unsigned stuck = 0, high = 0;  ///< levels: channels that stand, and where
  bool held = false;             ///< they stand where they were
  std::vector<Pulse> pulses;     ///< in order
};

/// The pins as the core sees them, event by event.
class BrokenPins {
 public:
  BrokenPins(Break how, EncoderPins now) : how_(std::move(how)), true_(now) {}

  /// Events of the stretch (begin, end], from the true ones.
  const std::vector<EncoderEvent>& take(const std::vector<EncoderEvent>& events, Clock begin,
                                        Clock end) {
    out_.clear();
    std::size_t next = 0;
    for (Clock at = begin + 1; at <= end; ++at) {
      // Only clocks in which something changes.
      Clock soon = end + 1;
      if (next < events.size()) soon = std::min(soon, events[next].clock);
      for (std::size_t p = pulse_; p < how_.pulses.size() && how_.pulses[p].from <= soon; ++p) {
        if (how_.pulses[p].from >= at) soon = std::min(soon, how_.pulses[p].from);
        if (how_.pulses[p].to >= at) soon = std::min(soon, how_.pulses[p].to);
      }
      if (how_.from >= at) soon = std::min(soon, how_.from);
      at = soon;
      if (at > end) break;
      if (at == how_.from) held_ = true_;
      while (next < events.size() && events[next].clock <= at) true_ = events[next++].pins;
      while (pulse_ < how_.pulses.size() && how_.pulses[pulse_].to <= at) ++pulse_;
      out_.push_back({at, seen(at)});
    }
    return out_;
  }

 private:
  EncoderPins seen(Clock at) const {
    EncoderPins p = true_;
    if (at >= how_.from) {
      using K = Break::Kind;
      const auto level = [this](unsigned bit, bool now, bool before) {
        if ((how_.stuck & bit) == 0) return now;
        return how_.held ? before : (how_.high & bit) != 0;
      };
      if (how_.kind == K::levels) {
        p.a = level(1, p.a, held_.a);
        p.b = level(2, p.b, held_.b);
        p.z = level(4, p.z, held_.z);
      }
      if (how_.kind == K::shorted_a) p.b = p.a;
      if (how_.kind == K::shorted_b) p.a = p.b;
      if (how_.kind == K::shorted_and) p.a = p.b = p.a && p.b;
      if (how_.kind == K::shorted_or) p.a = p.b = p.a || p.b;
      if (how_.kind == K::swapped) std::swap(p.a, p.b);
    }
    for (std::size_t k = pulse_; k < how_.pulses.size() && how_.pulses[k].from <= at; ++k) {
      if (how_.pulses[k].to <= at) continue;
      p.a ^= (how_.pulses[k].channels & 1u) != 0;
      p.b ^= (how_.pulses[k].channels & 2u) != 0;
      p.z ^= (how_.pulses[k].channels & 4u) != 0;
    }
    return p;
  }

  Break how_;
  EncoderPins true_, held_{};
  std::size_t pulse_ = 0;
  std::vector<EncoderEvent> out_;
};

/// The core's twin with its pins, panel and host.
class Device {
 public:
  test::CoreOf<D> core;
  CoreIn in;

  /// A tick's clocks; a write is taken in its fifth.
  GateTimes tick(const std::vector<EncoderEvent>& events, Clock begin, std::optional<Word> write,
                 bool stop) {
    const auto before = core.gate_clocks();
    Clock at = begin;
    std::size_t next = 0;
    const auto to = [&](Clock end) {
      while (at < end) {
        while (next < events.size() && events[next].clock <= at) in.encoder = events[next++].pins;
        const Clock until = next < events.size() ? std::min(end, events[next].clock) : end;
        core.run(in, until - at, [] {});
        at = until;
      }
    };
    if (write || stop) {
      to(begin + host_write_clock);
      while (next < events.size() && events[next].clock <= at) in.encoder = events[next++].pins;
      if (write) {
        in.reg_addr = static_cast<std::uint16_t>(write->address);
        in.reg_wdata = write->data;
        in.reg_write = true;
      }
      in.stop = stop;
      core.clock(in);
      in.reg_write = in.stop = false;
      ++at;
    }
    to(begin + kTick);
    while (next < events.size())
      in.encoder = events[next++].pins;  // of the next tick's first clock
    const auto after = core.gate_clocks();
    GateTimes g{static_cast<int>(after[0] - before[0]), static_cast<int>(after[1] - before[1]),
                static_cast<int>(after[2] - before[2]), static_cast<int>(after[3] - before[3]), 0};
    // More on-time than there are clocks: both were on. Less would not show; the legs are proven.
    g.both = std::max({0, g.a_hi + g.a_lo - kTick, g.b_hi + g.b_lo - kTick});
    return g;
  }
};

struct Case {
  std::string what;
  int scene = 0, filter = 0;
  std::vector<Word> words;
  plant::Hand hand;
  double warm_s = 0.1;       ///< time before the fault
  double seconds = 0.06;     ///< time after the fault
  double from_s = 0;         ///< moment of the fault, counted from the end of the warm-up
  Break pins;                ///< its times are clocks from the start of the fault's tick
  std::vector<Word> writes;  ///< writes of the host, one per tick from the fault on; the sound core
                             ///< gets none of them
  bool stop = false;
  bool swapped_from_the_start = false;
  bool position_matters = true;
  bool alone = false;  ///< the lever itself is wrong: the sound core trips as well
};

constexpr std::array moving_scenes{"wall", "membrane", "spring_tension", "damper", "free"};

const DesignInfo& info() {
  static const DesignInfo all = design_info<D>();
  return all;
}

/// A hand moves the lever at this speed through a scene that acts.
Case moving(Random* r, double rad_s) {
  Case c;
  const char* scene = moving_scenes[r->below(moving_scenes.size())];
  c.scene = info().scene_number(scene);
  const double way = sign(r);
  c.words = {word("wall_contact", 20), word("membrane_lower", 20), word("membrane_upper", 2000)};
  c.hand = moving_hand(0, way * rad_s);
  c.warm_s = std::clamp(0.4 / rad_s, 0.02, 0.25);
  c.what = fmt::format("{}, {:.3g} rad/s", scene, way * rad_s);
  return c;
}

/// One of the acts: a hand leans, sways or moves in a scene that acts.
Case acting(Random* r) {
  static const std::vector<Act> all = acts();
  const Act& a = all[r->below(all.size() - 1)];  // the last is disarmed
  Case c;
  c.scene = a.scene;
  c.words = a.words;
  c.hand = a.hand;
  c.warm_s = a.warm_s;
  c.what = a.name;
  return c;
}

/// One of the acts in which the hand leans and stays.
Case leaning(Random* r) {
  using Kind = plant::Segment::Kind;
  Case c = acting(r);
  while (c.hand.phases[0].profile.back().kind != Kind::kSine) c = acting(r);
  c.hand.phases[0].profile.back().amplitude = 0;
  c.warm_s = std::max(c.warm_s, 0.2);  // the lever is at rest by then
  return c;
}

void break_channels(Random* r, bool shorted, double rad_s, Case* c) {
  using K = Break::Kind;
  Break& b = c->pins;
  const char* name = "";
  if (shorted) {
    constexpr std::array kinds{K::shorted_a, K::shorted_b, K::shorted_and, K::shorted_or};
    constexpr std::array names{"short, A stronger", "short, B stronger", "short, and", "short, or"};
    const auto k = r->below(kinds.size());
    b.kind = kinds[k];
    name = names[k];
  } else {
    b.kind = K::levels;
    b.stuck = r->coin() ? 1 : 2;
    const auto k = r->below(3);
    b.held = k == 0;
    b.high = k == 1 ? 3 : 0;
    name = k == 0 ? "open" : k == 1 ? "high" : "low";
  }
  c->what += fmt::format(", {}{}", shorted ? "" : b.stuck == 1 ? "A " : "B ", name);
  c->seconds = 0.1 / rad_s + 0.006;
}

void glitches(Random* r, int shortest, int longest, double per_clock, Clock last, Case* c) {
  for (double at = 50;;) {
    at += -std::log(share(r)) / per_clock;
    if (at > static_cast<double>(last)) break;
    const auto from = static_cast<Clock>(at);
    const Clock to = from + r->between(shortest, longest);
    const unsigned channels = r->below(8) == 0 ? 3u : r->below(6) == 0 ? 4u : 1u << r->below(2);
    c->pins.pulses.push_back({from, to, channels});
    at = static_cast<double>(to + longest + 4);  // a gap, so that the filter sees separate pulses
  }
}

plant::Hand spun_hand(double to_rad_s) {
  plant::HandPhase spin;
  spin.kind = plant::HandPhase::Kind::kPrescribed;
  plant::Hand hand;
  double rad = 0;
  for (int k = 1; k <= 40; ++k) {  // in 40 steps of speed, so that the acceleration is bounded
    plant::Segment s;
    s.kind = plant::Segment::Kind::kRamp;
    s.duration_s = 0.004;
    rad += 0.004 * to_rad_s * k / 40;
    s.to = rad;
    spin.profile.push_back(s);
  }
  plant::Segment on = spin.profile.back();
  on.duration_s = 3600;
  on.to = rad + 3600 * to_rad_s;
  spin.profile.push_back(on);
  hand.phases = {spin};
  return hand;
}

Case make(std::size_t kind, Random* r) {
  const std::string name = pin_kinds()[kind].name;
  using K = Break::Kind;
  Case c;
  if (name == "glitch within the filter") {
    c = acting(r);
    c.filter = static_cast<int>(r->between(2, 15));
    glitches(r, 1, c.filter, std::pow(10.0, -2 - 3 * share(r)), 20'000 * kTick, &c);
    c.seconds = 0.024;
  } else if (name == "glitch") {
    c = acting(r);
    c.filter = static_cast<int>(r->between(0, 6));
    glitches(r, c.filter + 1, 2 * c.filter + 3, std::pow(10.0, -2 - 3 * share(r)), 20'000 * kTick,
             &c);
    c.seconds = 0.024;
  } else if (name == "channel dead" || name == "channels shorted") {
    const double rad_s = 3 * std::pow(40.0, share(r));
    c = moving(r, rad_s);
    break_channels(r, name == "channels shorted", rad_s, &c);
  } else if (name == "the same, slower") {
    const double rad_s = 0.5 + 2 * share(r);
    c = moving(r, rad_s);
    break_channels(r, r->coin(), rad_s, &c);
    c.seconds = 0.06;
  } else if (name == "cable cut, moving" || name == "cable cut, at rest") {
    const bool moves = name == "cable cut, moving";
    c = moves ? moving(r, 3 * std::pow(40.0, share(r))) : leaning(r);
    c.pins.kind = K::levels;
    c.pins.stuck = 7;
    const auto how = r->below(3);
    c.pins.held = how == 0;
    c.pins.high = how == 1 ? 7 : 0;
    c.what += how == 0 ? ", open" : how == 1 ? ", high" : ", low";
  } else if (name == "swapped, free lever") {
    c.scene = D::S::setpoint;
    const double nm = (r->coin() ? 1 : -1) * (0.3 + 0.2 * share(r));
    c.words = {word("setpoint_torque", 0)};
    c.writes = {word("setpoint_torque", nm)};
    c.swapped_from_the_start = true;
    c.what = fmt::format("{:.3f} Nm", nm);
    c.warm_s = 0.05;
    c.seconds = 0.06;
    c.position_matters = false;
  } else if (name == "swapped, in a hand") {
    c = acting(r);
    c.pins.kind = K::swapped;
  } else if (name == "swapped, self-test") {
    c.scene = D::S::free;
    c.swapped_from_the_start = true;
    c.words = {word("self_test_torque", 0.05), word("self_test_pulse", 39),
               word("self_test_quiet", 156)};
    c.hand = plant::Hand{};
    c.warm_s = 0.012 + 0.02 * share(r);  // the fault exists already: it begins when the core arms
    c.seconds = 0.06;
    c.position_matters = false;
    c.what = "free lever at rest";
  } else if (name == "over-speed") {
    const double rad_s = 640 + 300 * share(r);
    c.scene = r->coin() ? D::S::free : D::S::damper;
    c.hand = spun_hand(r->coin() ? rad_s : -rad_s);
    c.warm_s = 0.02;
    c.seconds = 0.22;
    c.what = fmt::format("to {:.0f} rad/s", rad_s);
    c.alone = true;
  } else if (name == "index lost" || name == "index false") {
    const double rad_s = 30 + 60 * share(r);
    c = moving(r, rad_s);
    c.scene = D::S::free;
    c.warm_s = 0.02;
    c.seconds = 14 / rad_s;
    if (name == "index lost") {
      c.pins.kind = K::levels;
      c.pins.stuck = 4;
      c.pins.high = r->coin() ? 4 : 0;
    } else {
      const auto at = static_cast<Clock>(share(r) * c.seconds * 0.5 * 50e6);
      c.pins.pulses.push_back({at, at + r->between(1, 3000), 4});
    }
  } else if (name == "stop") {
    c = acting(r);
    c.stop = true;
    c.seconds = 0.01;
  } else if (name == "bit of a word") {
    c = acting(r);
    const auto& p = D::parameters[r->below(std::size(D::parameters))];
    c.writes = {{p.address, static_cast<std::uint32_t>(p.raw) ^ (1u << r->below(32))}};
    c.what += std::string(", ") + p.name;
    c.seconds = 0.02;
  } else {  // garbage
    c = acting(r);
    for (int k = 0; k < 20; ++k) {
      Word w{static_cast<int>(r->below(4096)), static_cast<std::uint32_t>(r->bits())};
      if (r->coin()) w.address = static_cast<int>(r->below(320));
      c.writes.push_back(w);
    }
    c.seconds = 0.02;
  }
  c.from_s = 0.02 * share(r);
  return c;
}

}  // namespace

const std::vector<PinKind>& pin_kinds(const std::string& design) {
  if (design != D::name) return option_kinds(design);
  static const std::vector<PinKind> kinds{
      {"glitch within the filter", "pins", 10, Promise::none},
      {"glitch", "pins", 10, Promise::none},
      {"channel dead", "pins", 20, Promise::flagged},
      {"channels shorted", "pins", 10, Promise::flagged},
      {"the same, slower", "pins", 4, Promise::none},
      {"swapped, free lever", "pins", 5, Promise::flagged},
      {"swapped, self-test", "pins", 5, Promise::flagged},
      {"swapped, in a hand", "pins", 4, Promise::none},
      {"over-speed", "pins", 4, Promise::flagged},
      {"index lost", "pins", 3, Promise::none},
      {"index false", "pins", 3, Promise::none},
      {"stop", "pins", 4, Promise::flagged},
      {"bit of a word", "words", 9, Promise::none},
      {"garbage", "words", 9, Promise::none},
      {"cable cut, moving", "pins", 10, Promise::unseen},
      {"cable cut, at rest", "pins", 4, Promise::unseen},
  };
  return kinds;
}

PinResult run_pin_fault(const std::string& root, std::size_t kind, std::uint64_t seed,
                        const std::string& design) {
  if (design != D::name) return run_option_fault(root, design, kind, seed);
  Random random(seed * 64 + kind);
  Case c = make(kind, &random);
  PinResult result{kind, seed, c.what, {}, D::name};
  Outcome& o = result.outcome;
  const bool self_test = std::string(pin_kinds()[kind].name) == "swapped, self-test";
  plant::Plant lever = make_plant(root, c.hand);
  Device faulty, sound;
  faulty.in.encoder = sound.in.encoder = lever.encoder().pins();
  const auto warm = static_cast<std::int64_t>((c.warm_s + c.from_s) * 1e6);
  const std::int64_t ticks = static_cast<std::int64_t>(c.seconds * 1e6);
  // The fault begins with a tick; its clocks are counted from the start of that tick.
  c.pins.from = warm * kTick + 1 + random.below(kTick);
  for (Pulse& p : c.pins.pulses) p.from += warm * kTick, p.to += warm * kTick;
  if (c.swapped_from_the_start) c.pins.kind = Break::Kind::swapped, c.pins.from = 1;
  BrokenPins pins(c.pins, faulty.in.encoder);
  if (c.swapped_from_the_start) std::swap(faulty.in.encoder.a, faulty.in.encoder.b);
  const std::uint32_t control = static_cast<std::uint32_t>(D::control_reset) |
                                1u << D::C::control_host |
                                static_cast<std::uint32_t>(c.scene) << D::C::control_scene |
                                static_cast<std::uint32_t>(c.filter) << D::C::control_filter;
  std::vector<Word> setup = c.words;
  if (!self_test) setup.insert(setup.begin(), {D::A::self_test_pulse, 0});
  setup.push_back({D::C::control, control});
  const std::size_t arm_at = self_test ? static_cast<std::size_t>(warm) : setup.size() + 1;
  const TorqueJudge::Motor motor = motor_of_plant(root);
  const Limits limits;
  TorqueJudge judge(motor, limits);
  GateTimes gates;
  int off_for = 0;
  bool differed = false, position_wrong = false;
  double at_fault_rad = 0;
  std::int32_t first_position = 0;
  for (std::int64_t t = 0; t < warm + ticks; ++t) {
    lever.advance(bridge_of(gates, kTick), kTick);
    const Clock begin = t * kTick;
    const auto& events = pins.take(lever.events(), begin, begin + kTick);
    std::optional<Word> both, one;
    const auto n = static_cast<std::size_t>(t - 4);
    if (t >= 4 && n < setup.size()) both = setup[n];
    if (t >= 4 && n == arm_at) both = Word{D::C::control, control | 1u << D::C::control_arm};
    const bool broken = t >= warm;
    const auto k = static_cast<std::size_t>(t - warm);
    if (broken && k < c.writes.size()) one = c.writes[k];
    // These writes are no fault: both cores get them.
    if (c.swapped_from_the_start && one) both = one;
    gates = faulty.tick(events, begin, both ? both : one, c.stop && k == 0 && broken);
    // A swapped encoder of a lever at rest, or wrong words: a sound core runs beside the faulty
    // one.
    const GateTimes other = sound.tick(lever.events(), begin, both, false);
    if (!broken) {
      if (t >= warm - motor.period_ticks)
        judge.before(gates, lever.observables().motor_torque_mean_nm);
      at_fault_rad = lever.observables().theta_rad;
      first_position = faulty.core.out().position;
      continue;
    }
    const CoreOut &f = faulty.core.out(), &s = sound.core.out();
    if (std::abs(f.position - first_position) > 1) o.count_changed = true;
    const bool off = closed(f, c.alone ? 0u : s.faults, s.gates_enable, t - warm,
                            std::abs(lever.observables().theta_rad - at_fault_rad), &o);
    judge.tick(gates, other, lever.observables().omega_rad_s,
               lever.observables().motor_torque_mean_nm, off, &o);
    position_wrong = c.position_matters && f.position != s.position;
    differed = differed || !(gates == other) || f.position != s.position || f.tau_ref != s.tau_ref;
    if (judge.unsafe(o)) break;
    off_for = off && !gates.on() ? off_for + 1 : 0;
    if (off_for > 60) break;
  }
  settle({judge.unsafe(o), off_for > 0, judge.torque_wrong(), position_wrong, differed}, limits,
         &o);
  return result;
}

}  // namespace feltgate::faults
