// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Several equal levers, coupled only by the laws of a core with as many axes: two levers, or the
// three slides of a stylus. docs/devices/pantograph.md, docs/devices/three-axes.md
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "plant.hpp"
#include "rotation.hpp"

namespace feltgate::plant {

/// Constants of the levers.
struct LeverSetParameters {
  std::string name;
  Parameters lever;           ///< every lever; encoders have successive seeds
  EncoderParameters encoder;  ///< encoder of the first lever
  Effects effects;            ///< defaults of the file; a scene may override each
};

/// Values at the end of the last step; motor torques are means over it.
template <std::size_t N>
struct LeverSetSeen {
  std::array<double, N> theta_rad = {}, omega_rad_s = {};
  std::array<double, N> motor_nm = {};
  std::array<double, N> hand_nm = {};  ///< of the hand or object at each lever
  std::array<double, N> work_j = {};   ///< of the same, since the start
  double hand_work_j = 0.0;            ///< only of levers that the hand holds
};

/// N levers; a hand holds the first `Held`, the others touch an object.
template <std::size_t N, std::size_t Held>
class LeverSet {
 public:
  static constexpr std::size_t axes = N;

  /// Errors: those of Plant.
  LeverSet(const LeverSetParameters& parameters, const Effects& effects, const Drive& drive,
           const std::array<Hand, N>& hands)
      : LeverSet(parameters, effects, drive, hands, std::make_index_sequence<N>{}) {}

  /// Advances by `clocks` >= 1 with these bridges, at most 250 (5 us). Errors: MotionError.
  void advance(const std::array<Bridge, N>& bridges, Clock clocks) {
    const double dt_s = static_cast<double>(clocks) / clock_hz_;
    seen_.hand_work_j = 0.0;
    for (std::size_t n = 0; n < N; ++n) {
      const double before_rad = levers_[n].observables().theta_rad;
      levers_[n].advance(bridges[n], clocks);
      const Observables& o = levers_[n].observables();
      seen_.theta_rad[n] = o.theta_rad;
      seen_.omega_rad_s[n] = (o.theta_rad - before_rad) / dt_s;
      seen_.motor_nm[n] = o.motor_torque_mean_nm;
      seen_.hand_nm[n] = o.hand_torque_nm;
      seen_.work_j[n] += o.hand_torque_nm * (o.theta_rad - before_rad);
      if (n < Held) seen_.hand_work_j += seen_.work_j[n];
    }
  }

  Clock next_corner() {
    Clock corner = levers_[0].next_corner();
    for (std::size_t n = 1; n < N; ++n) corner = std::min(corner, levers_[n].next_corner());
    return corner;
  }
  Clock now() const { return levers_[0].now(); }
  double seconds() const { return static_cast<double>(now()) / clock_hz_; }
  double clock_hz() const { return clock_hz_; }
  const std::vector<EncoderEvent>& events(std::size_t axis) const { return levers_[axis].events(); }
  const Encoder& encoder(std::size_t axis) const { return levers_[axis].encoder(); }
  const LeverSetSeen<N>& seen() const { return seen_; }
  const LeverSetParameters& parameters() const { return p_; }

 private:
  template <std::size_t... I>
  LeverSet(const LeverSetParameters& parameters, const Effects& effects, const Drive& drive,
           const std::array<Hand, N>& hands, std::index_sequence<I...> /*all*/)
      : p_(parameters),
        clock_hz_(drive.clock_hz),
        levers_{Plant(seeded(p_.lever, I), effects, drive, hands[I])...} {
    for (std::size_t n = 0; n < N; ++n) seen_.theta_rad[n] = levers_[n].observables().theta_rad;
  }
  static Parameters seeded(Parameters lever, std::size_t axis) {
    lever.encoder.seed += axis;
    return lever;
  }

  LeverSetParameters p_;
  double clock_hz_;
  std::array<Plant, N> levers_;
  LeverSetSeen<N> seen_;
};

/// A lever that the hand leads, and one that meets an object.
using TwoLevers = LeverSet<2, 1>;

/// Three slides along x, y and z. Up to its capstan each is a lever; the capstan's radius is the
/// lever's. The pen belongs to all three.
class Stylus : public LeverSet<3, 3> {
 public:
  using LeverSet::LeverSet;

  double capstan_m() const { return parameters().lever.lever.radius_m; }
  /// Position of the pen for these angles of the capstans, m.
  Vec3 place_m(const std::array<double, 3>& theta_rad) const {
    return capstan_m() * Vec3{theta_rad[0], theta_rad[1], theta_rad[2]};
  }
  Vec3 pen_m() const { return place_m(seen().theta_rad); }
  /// Force of the hand on the pen, N.
  Vec3 hand_n() const {
    const auto& nm = seen().hand_nm;
    return 1.0 / capstan_m() * Vec3{nm[0], nm[1], nm[2]};
  }
};

}  // namespace feltgate::plant
