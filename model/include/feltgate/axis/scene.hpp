// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/scene.sv: the torque of the scene, not yet limited. One product for each term,
// one rounding. A scene that the design does not build gives 0. docs/blocks/scene.md
//   set-point   tau = torque
//   membrane    tau = +-torque between two faces, back to the side of entry
//   spring      tau = k * (rest - position), on both sides or below the rest alone
//   damper      tau = -b * velocity
//   charge      tau = -+strength / x^2, within the core -+slope * x
//   wall        tau = k * (contact - position) - b * velocity above the contact, never pulling
#pragma once

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

/// Torque of a program, for the scene law.
template <class T>
struct Law {
  T torque = 0;  ///< Nm
  bool late = false;
  bool restart = false;
};

template <class N>
struct Scene {
  using T = typename N::T;
  using S = Map::S;
  struct State {
    bool seen = false;  ///< the lever came into the membrane
    bool from_above = false;
    T torque = 0;  ///< Nm
  };

  explicit Scene(const Design& d)
      : mask(static_cast<unsigned>(d["SCENE_MASK"])),
        part_f(d["SCENE_PART_F"]),
        part_w(d["SCENE_PART_W"]),
        sticky(d.rounding() == Rounding::half_to_even),
        guard(d["SCENE_GUARD_BITS"], d.rounding()),
        distance_f(d["SCENE_DISTANCE_F"]),
        wall_stiffness(part_f - distance_f - d["P_WALL_STIFFNESS_F"]),
        wall_damping(part_f - d["VELOCITY_F"] - d["P_WALL_DAMPING_F"]),
        damper(part_f - d["VELOCITY_F"] - d["P_DAMPER_DAMPING_F"]),
        spring(part_f - distance_f - d["P_COMPRESSION_STIFFNESS_F"]),
        slant(part_f - distance_f - d["P_ATTRACT_CORE_SLOPE_F"]),
        charge_scale(part_f - d["CHARGE_F"]) {}

  static bool is_charge(int scene) {
    return scene == S::charge_attract || scene == S::charge_repel;
  }
  bool has(int scene) const { return (mask >> scene & 1) != 0; }
  /// After the velocity: it takes the torque of a program, and its own is new. A charge's divider
  /// has started with the position.
  static constexpr int summed = 2, usual_latency = 4;
  int latency(int scene) const { return is_charge(scene) && has(scene) ? 22 : usual_latency; }

  /// A term with its guard bits; of what is dropped it keeps a trace, for rounding to even.
  T single(T product, const Exponent& to_part) const {
    return sticky ? N::scale_sticky(product, to_part.right) : N::scale(product, to_part);
  }
  /// The sum of a scene's terms, in its part's format.
  T rounded(T sum) const { return N::add_rounded(0, sum, guard); }

  [[gnu::always_inline]] State tick(const State& s, const Words<T>& p, bool armed, int scene,
                                    std::int64_t position, T velocity, const Law<T>& law) const {
    State next{false, s.from_above, 0};
    if (!has(scene)) return next;
    // Reference minus position. Of a charge's centre the fraction is ignored.
    const T at = N::integer(static_cast<T>(position), distance_f, distance_f);
    const T distance = p.first - at;
    T torque = 0;
    switch (scene) {
      case S::setpoint:
        torque = p.torque;
        break;
      case S::membrane: {
        const bool ahead = distance > 0, above = at > p.second;
        next.seen = s.seen || ahead || above;
        if (ahead || above) next.from_above = above && !ahead;
        if (next.seen && !ahead && !above) torque = next.from_above ? p.torque : -p.torque;
        break;
      }
      case S::spring_compression:
        if (!(distance < 0)) torque = rounded(single(distance * p.stiffness, spring));
        break;
      case S::spring_tension:
        torque = rounded(single(distance * p.stiffness, spring));
        break;
      case S::damper:
        torque = -rounded(single(velocity * p.damping, damper));
        break;
      case S::charge_attract:
      case S::charge_repel:
        torque = charge(p, scene == S::charge_attract, N::floor(p.first, distance_f) - at);
        break;
      case S::wall:
        if (distance < 0) {
          const T push = N::saturate(N::scale(distance * p.stiffness, wall_stiffness), part_w);
          const T sum = push - N::scale(velocity * p.damping, wall_damping);
          if (sum < 0) torque = rounded(sum);
        }
        break;
      case S::law:
        if (!law.late) torque = law.torque;
        break;
      default:
        break;
    }
    next.torque = armed ? torque : T{0};
    return next;
  }
  template <class At>
  static void show(const At&, const State&, State&) {}  // nothing is shown later
  T charge(const Words<T>& p, bool attract, T distance) const {
    const T whole = N::scale(distance, -distance_f);
    T torque = 0;
    if (p.core != 0 && !N::beyond(whole, p.core)) {
      torque = rounded(single(distance * p.slope, slant));
      return attract ? torque : -torque;
    }
    const T square = whole * whole;
    if constexpr (N::is_fixed) {  // the divider gives 16 bits; a square of more than 32 gives 0
      const T quotient = p.strength >> 16 >= square ? 0xffff : p.strength / square;
      if (square < T{1} << 32) torque = rounded(N::scale(quotient, charge_scale));
    } else {
      torque = square == 0 ? static_cast<T>(1e30) : p.strength / square;
    }
    return attract != (whole > 0) ? -torque : torque;
  }

  unsigned mask;
  int part_f;
  Bits part_w;
  bool sticky;
  Drop guard;
  int distance_f;
  Exponent wall_stiffness, wall_damping, damper, spring, slant, charge_scale;
};

}  // namespace feltgate::axis
