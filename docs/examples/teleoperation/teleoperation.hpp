// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two levers as leader and follower over two links, with a delay between them. Four channels:
// angle (with its velocity) and torque, in both directions. A time-domain passivity controller on
// each side lets no more energy out than has come in on the other side.
// Documentation: docs/devices.md#teleoperation
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "host/board/board_wire.hpp"
#include "host/host_device.hpp"
#include "host/link.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::examples {

/// Gains of the coupling, and the limits of the controller.
struct Coupling {
  double stiffness_nm_rad = 0.8, damping_nm_s_rad = 0.005;
  double torque_share = 0.2;            ///< of the other side's observed torque that is added here
  double most_nm = 0.4;                 ///< largest torque of a side
  bool passivity = true;                ///< whether the controller acts
  double most_damping_nm_s_rad = 0.03;  ///< of the controller: what a loop of 1 kHz bears
};

/// What one side tells the other.
struct Packet {
  double angle_rad = 0, velocity_rad_s = 0, torque_nm = 0;
  double energy_in_j = 0;  ///< that the coupling has taken from this side's lever until now
};

/// One side: the coupling's torque on its lever, and the energy that passes there.
class Side {
 public:
  explicit Side(const Coupling& of) : c_(of) {}

  /// The torque for the next period, Nm, from what this side measures and what the other one said.
  /// The board holds the torque, so that the energy of a period is exact: torque times way.
  double torque(const Packet& own, const Packet& other, double dt_s) {
    const double out_j = held_nm_ * (own.angle_rad - last_rad_);
    (out_j > 0 ? out_j_ : in_j_) += std::abs(out_j);
    last_rad_ = own.angle_rad;
    double nm = c_.stiffness_nm_rad * (other.angle_rad - own.angle_rad) +
                c_.damping_nm_s_rad * (other.velocity_rad_s - own.velocity_rad_s) +
                c_.torque_share * other.torque_nm;
    nm = std::clamp(nm, -c_.most_nm, c_.most_nm);
    if (c_.passivity) nm = passive(nm, own.velocity_rad_s, other.energy_in_j, dt_s);
    return held_nm_ = std::clamp(nm, -c_.most_nm, c_.most_nm);
  }
  double in_j() const { return in_j_; }
  double out_j() const { return out_j_; }

 private:
  /// Damps so that the energy that has gone out, with that of this period, stays below what the
  /// other side has reported as taken in.
  double passive(double nm, double velocity_rad_s, double other_in_j, double dt_s) const {
    const double way_rad = velocity_rad_s * dt_s;
    const double excess_j = out_j_ + std::max(nm * way_rad, 0.0) - other_in_j;
    if (excess_j <= 0 || way_rad == 0) return nm;
    const double damping =
        std::min(excess_j / (way_rad * velocity_rad_s), c_.most_damping_nm_s_rad);
    const double damped_nm = nm - damping * velocity_rad_s;
    // At most no push: a brake is what takes back what went out too much.
    return nm * way_rad > 0 && excess_j > nm * way_rad ? -damping * velocity_rad_s : damped_nm;
  }

  Coupling c_;
  double held_nm_ = 0, last_rad_ = 0, in_j_ = 0, out_j_ = 0;
};

/// A lever behind its link: the twin of a board with its motor, and a hand on the lever.
class Lever {
 public:
  Lever(const std::string& root, const std::string& name, const plant::Hand& hand)
      : wire_(board::make_core("lever", "twin", options()),
              plant::read_plant_file(root + "/vectors/plants/p24.toml"), hand, {}, name),
        link_(wire_),
        board_(host::read_board(link_)),
        device_(link_, board_, host::design_by_crc(root, board_.design_crc)->design) {
    device_.disarm();
    device_.set("setpoint_torque", 0.0);
    device_.set("self_test_pulse", 0.0);  // nobody is in its way
    device_.arm("setpoint", false);
    const unsigned mask = 1u << angle_.word | 1u << velocity_.word | 1u << torque_.word;
    device_.stream(static_cast<std::uint16_t>(mask), period_ticks);
  }
  /// Waits for the next tick of the stream: a torque that is pushed at once then acts from this
  /// tick to the next one, but for the time on the wire.
  Packet measured() {
    const auto tick = device_.streamed(host::within(1));
    if (!tick) throw host::LinkLost(link_.name() + ": the stream has ended");
    return {tick->value(angle_), tick->value(velocity_), tick->value(torque_), 0};
  }
  void push(double torque_nm) {
    link_.write(setpoint_.address, device_.quantities().setting(setpoint_, torque_nm).word);
  }
  /// What the coupling has taken from the lever since the last call, from the plant.
  double taken_j() {
    const plant::Observables& o = plant();
    const double j = -0.5 * (motor_nm_ + o.motor_torque_mean_nm) * (o.theta_rad - theta_rad_);
    motor_nm_ = o.motor_torque_mean_nm;
    theta_rad_ = o.theta_rad;
    return j;
  }
  const plant::Observables& plant() const { return wire_.board().plant(); }
  bool armed() { return device_.armed(device_.tick()); }

 private:
  static constexpr std::uint32_t period_ticks = 1000;
  static board::BoardOptions options() {
    board::BoardOptions o;
    o.baud = 3'000'000;
    return o;
  }
  board::BoardWire wire_;
  host::Link link_;
  host::BoardInfo board_;
  host::Device device_;
  const host::Quantity& angle_ = device_.quantities().find("angle");
  const host::Quantity& velocity_ = device_.quantities().find("velocity");
  const host::Quantity& torque_ = device_.quantities().find("tau_hat");
  const host::Quantity& setpoint_ = device_.quantities().find("setpoint_torque");
  double motor_nm_ = 0, theta_rad_ = 0;
};

/// What came of a session.
struct Teleoperated {
  double least_energy_j = 0;    ///< least of what the coupling has taken in and not given out
  double least_of_plant_j = 0;  ///< the same from the motors' torques and the levers' angles
  double fastest_rad_s = 0;     ///< of both levers in the last third
  double apart_rad = 0;         ///< largest distance of the levers in the last third
  double follower_rad = 0;      ///< where the follower ended
  bool armed = false;           ///< both at the end
};

/// The leader's hand carries its lever to 0.6 rad and lets go: then nothing but the coupling and
/// friction acts on both.
inline Teleoperated teleoperate(const std::string& root, double delay_s, const Coupling& coupling,
                                double run_s = 1.2) {
  constexpr double dt_s = 1e-3, to_rad = 0.6;
  plant::Segment wait, go;
  wait.duration_s = 0.05;
  go.kind = plant::Segment::Kind::kMinimumJerk;
  go.duration_s = 0.25;
  go.to = to_rad;
  plant::HandPhase arm;
  arm.kind = plant::HandPhase::Kind::kImpedance;
  arm.profile = {wait, go};
  arm.duration_s = wait.duration_s + go.duration_s;
  plant::Hand hand;
  hand.phases = {arm, {}};
  Lever leader(root, "leader", hand), follower(root, "follower", {});
  Side at_leader(coupling), at_follower(coupling);

  const auto late = static_cast<std::size_t>(std::llround(delay_s / dt_s));
  std::deque<Packet> to_follower(late + 1), to_leader(late + 1);
  Teleoperated out;
  double of_plant_j = 0;
  for (int n = 1; n * dt_s < run_s; ++n) {
    Packet l = leader.measured(), f = follower.measured();
    l.energy_in_j = at_leader.in_j();
    f.energy_in_j = at_follower.in_j();
    to_follower.push_back(l);
    to_leader.push_back(f);
    to_follower.pop_front();
    to_leader.pop_front();
    leader.push(at_leader.torque(l, to_leader.front(), dt_s));
    follower.push(at_follower.torque(f, to_follower.front(), dt_s));
    const double kept_j =
        at_leader.in_j() + at_follower.in_j() - at_leader.out_j() - at_follower.out_j();
    out.least_energy_j = std::min(out.least_energy_j, kept_j);
    of_plant_j += leader.taken_j() + follower.taken_j();
    out.least_of_plant_j = std::min(out.least_of_plant_j, of_plant_j);
    if (n * dt_s < run_s * 2 / 3) continue;
    const plant::Observables &a = leader.plant(), &b = follower.plant();
    out.fastest_rad_s =
        std::max({out.fastest_rad_s, std::abs(a.omega_rad_s), std::abs(b.omega_rad_s)});
    out.apart_rad = std::max(out.apart_rad, std::abs(a.theta_rad - b.theta_rad));
  }
  out.follower_rad = follower.plant().theta_rad;
  out.armed = leader.armed() && follower.armed();
  return out;
}

}  // namespace feltgate::examples
