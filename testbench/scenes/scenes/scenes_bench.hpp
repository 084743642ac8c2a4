// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Connects the ports of the Verilated scenes to the twin's, and checks the result of each wave.
// Documentation: docs/blocks/scenes.md
#pragma once

#include <Vscenes.h>

#include <array>

#include "scene_bench.hpp"
#include "scenes_twin.hpp"

namespace feltgate::test {

#ifdef FELTGATE_SCENE_MASK
/// The design with another set of scenes.
struct Built : Design {
  static constexpr int scene_mask = FELTGATE_SCENE_MASK;
};
#else
using Built = Design;
#endif

struct Block : BlockOf<Vscenes, Scenes<Built>> {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {bus.armed,   wave.scene,     bus.wave,       bus.param,   wave.position,
            bus.product, bus.over_limit, bus.law_torque, bus.law_late};
  }
  static void drive(Rtl& rtl, const Twin::In& in) {
    rtl.armed_i = in.armed;
    rtl.scene_i = static_cast<std::uint8_t>(in.scene);
    rtl.wave_i = in.wave;
    rtl.param_i = in.param;
    rtl.position_i = port_bits<18>(in.position);
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
    rtl.over_limit_i = in.over_limit;
    rtl.law_torque_i = port_bits<kTorque.width()>(in.law_torque);
    rtl.law_late_i = in.law_late;
  }
  /// As the limiter takes it: rounded.
  static std::int64_t early_term(const Rtl& rtl) {
    return sign_extend<Design::f.scene_torque.width()>(rtl.early_term_o) + rtl.early_up_o;
  }
  static std::int64_t late_term(const Rtl& rtl) {
    const std::int64_t term = sign_extend<kTorque.width()>(rtl.late_term_o);
    return (rtl.late_not_o ? ~term : term) + rtl.late_up_o;
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    check("distance", sign_extend<Design::f.scene_distance.width()>(rtl.distance_o), out.distance);
    check("square", rtl.square_o, out.square);
    check("early_term", early_term(rtl), out.early_term);
    check("late_term", late_term(rtl), out.late_term);
    check("law", rtl.law_o, out.law);
  }
};

struct Tally {
  std::int64_t waves = 0, disarmed = 0, halted = 0;
  std::array<std::int64_t, 16> up{}, down{};  ///< waves with a torque, by scene
};

/// The law of the scene; what holds of its torque whatever the law; each word in its clock alone.
struct LawBeside {
  using Law = ScenesLaw<Built, Fixed>;
  using T = Map::T;
  Tally* tally;
  MembraneSide side = MembraneSide::unknown;
  std::int64_t seen = 0;

  void forget() { side = MembraneSide::unknown; }
  const char* at(const Probe& p, const Vscenes& rtl, const Scenes<Built>&) {
    const Wave& w = p.wave;
    const std::int64_t distance = distance_of(p.memory, w);
    const bool shows = p.t == T::scene_distance || p.t == T::scene_distance + 1;
    const bool built = scene_built<Built>(w.scene);
    const std::int64_t wanted =
        is_charge(w.scene) && !built ? distance | (p.memory.reference(w.scene) & 255) : distance;
    if (sign_extend<Design::f.scene_distance.width()>(rtl.distance_o) != (shows ? wanted : 0)) {
      return "the distance, in two clocks alone";
    }
    if ((rtl.square_o != 0) != (is_charge(w.scene) && built)) return "the square is the charges'";
    const std::int64_t early_term = Block::early_term(rtl);
    if (p.t == T::scene_rounded) {
      seen = early_term;
    } else if (early_term != (p.t == T::charge_width ? distance >> 8 : 0)) {
      return "the distance in whole counts, and nothing in other clocks";
    }
    return p.t == kRendered ? whole(p, Block::late_term(rtl)) : nullptr;
  }

 private:
  const char* whole(const Probe& p, std::int64_t late_term) {
    const Wave& w = p.wave;
    const std::int64_t tau = seen + late_term;
    const auto velocity = Law::Velocity::from_raw(w.velocity);
    auto law = Law::torque(p.memory.words(), w.scene, w.position, velocity, &side).raw();
    if (w.scene == S::law && scene_built<Built>(w.scene) && !w.law_late) law = w.law_torque;
    const auto scene = static_cast<std::size_t>(w.scene);
    ++tally->waves;
    tally->up[scene] += tau > 0;
    tally->down[scene] += tau < 0;
    tally->disarmed += !w.armed;
    if (seen != 0 && late_term != 0) return "two torques at once";
    if (!w.armed) return tau == 0 ? nullptr : "a torque while disarmed";
    if (w.disarmed_from <= kRendered) {
      ++tally->halted;
      return late_term == 0 && (seen == 0 || w.disarmed_from == kRendered)
                 ? nullptr
                 : "a torque once disarmed";
    }
    if (tau != law) return "the law's torque";
    if (w.scene == S::wall && tau > 0) return "a wall pulls";
    if (w.scene == S::spring_compression && tau < 0) return "a compressed spring pulls";
    if (w.scene == S::damper && ((tau > 0 && w.velocity > 0) || (tau < 0 && w.velocity < 0))) {
      return "a damper drives";
    }
    return nullptr;
  }
};

}  // namespace feltgate::test
