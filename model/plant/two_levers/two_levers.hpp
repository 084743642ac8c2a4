// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two levers with nothing between them but what a core with two axes makes: a hand on the first,
// and what the second meets. Documentation: docs/devices/coupled_levers.md
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "../plant.hpp"

namespace feltgate::plant {

struct TwoLeversParameters {
  std::string name;
  Parameters lever;           ///< of each; the second has the next seed of its encoder
  EncoderParameters encoder;  ///< that of the first
  Effects effects;            ///< defaults of the file; a scene may override each
};

/// At the end of the last step, motor torques as means over it. First the led lever.
struct TwoLeversSeen {
  std::array<double, 2> theta_rad = {}, omega_rad_s = {};
  std::array<double, 2> motor_nm = {};
  std::array<double, 2> hand_nm = {};  ///< of the hand, and of what the second lever meets
  double hand_work_j = 0.0;            ///< of the hand on the first lever since the start
  double met_work_j = 0.0;             ///< likewise of what the second one meets
};

class TwoLevers {
 public:
  static constexpr std::size_t axes = 2;

  /// Errors: as of Plant.
  TwoLevers(const TwoLeversParameters& parameters, const Effects& effects, const Drive& drive,
            const std::array<Hand, 2>& hands)
      : p_(parameters),
        clock_hz_(drive.clock_hz),
        levers_{Plant(p_.lever, effects, drive, hands[0]),
                Plant(second(p_.lever), effects, drive, hands[1])} {
    for (std::size_t n = 0; n < axes; ++n) {
      seen_.theta_rad[n] = levers_[n].observables().theta_rad;
    }
  }

  /// Advances by `clocks` >= 1 with both bridges as given, at most 250 (5 us). Errors: MotionError.
  void advance(const std::array<Bridge, 2>& bridges, Clock clocks) {
    const double dt_s = static_cast<double>(clocks) / clock_hz_;
    for (std::size_t n = 0; n < axes; ++n) {
      const double before_rad = levers_[n].observables().theta_rad;
      levers_[n].advance(bridges[n], clocks);
      const Observables& o = levers_[n].observables();
      seen_.theta_rad[n] = o.theta_rad;
      seen_.omega_rad_s[n] = (o.theta_rad - before_rad) / dt_s;
      seen_.motor_nm[n] = o.motor_torque_mean_nm;
      seen_.hand_nm[n] = o.hand_torque_nm;
      (n == 0 ? seen_.hand_work_j : seen_.met_work_j) +=
          o.hand_torque_nm * (o.theta_rad - before_rad);
    }
  }

  Clock next_corner() { return std::min(levers_[0].next_corner(), levers_[1].next_corner()); }
  Clock now() const { return levers_[0].now(); }
  double seconds() const { return static_cast<double>(now()) / clock_hz_; }
  double clock_hz() const { return clock_hz_; }
  const std::vector<EncoderEvent>& events(std::size_t axis) const { return levers_[axis].events(); }
  const Encoder& encoder(std::size_t axis) const { return levers_[axis].encoder(); }
  const TwoLeversSeen& seen() const { return seen_; }
  const TwoLeversParameters& parameters() const { return p_; }

 private:
  static Parameters second(Parameters lever) {
    ++lever.encoder.seed;
    return lever;
  }

  TwoLeversParameters p_;
  double clock_hz_;
  std::array<Plant, axes> levers_;
  TwoLeversSeen seen_;
};

}  // namespace feltgate::plant
