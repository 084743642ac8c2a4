// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The scenes, motor, lever and hands for the fault campaign. Documentation: docs/testing.md
#include "campaigns/faults/world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "feltgate/generated/lever.hpp"
#include "sim/backends/backend.hpp"
#include "sim/plant/drive.hpp"
#include "sim/plant/hand.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::faults {

namespace {

using D = Lever;

const DesignInfo& design() {
  static const DesignInfo info = design_named("lever");
  return info;
}

const plant::Parameters& lever_plant(const std::string& root) {
  static const plant::Parameters p = plant::read_plant_file(root + "/vectors/plants/p24.toml");
  return p;
}

plant::Segment segment(plant::Segment::Kind kind, double duration_s, double to) {
  plant::Segment s;
  s.kind = kind;
  s.duration_s = duration_s;
  s.to = to;
  return s;
}

Word counts(const std::string& parameter, double rad) { return word(parameter, rad / count_rad()); }

}  // namespace

double count_rad() { return design().count_rad; }

Word word_of(const DesignInfo& design, const std::string& parameter, double value) {
  const ParameterInfo* info = design.find(parameter);
  if (info == nullptr) throw std::invalid_argument(design.unknown(parameter));
  return {info->address, static_cast<std::uint32_t>(quantise_parameter(*info, value))};
}
Word word(const std::string& parameter, double value) {
  return word_of(design(), parameter, value);
}

plant::Hand leaning_hand(double from_rad, double to_rad, double sway_rad, double sway_hz) {
  plant::HandPhase lean;
  lean.kind = plant::HandPhase::Kind::kImpedance;
  plant::Segment sway;
  sway.kind = plant::Segment::Kind::kSine;
  sway.duration_s = 3600;
  sway.amplitude = sway_rad;
  sway.frequency_hz = sway_hz;
  lean.profile = {segment(plant::Segment::Kind::kMinimumJerk, 0.08, to_rad), sway};
  plant::Hand hand;
  hand.start_rad = from_rad;
  hand.phases = {lean};
  return hand;
}

plant::Hand moving_hand(double from_rad, double rad_s) {
  plant::HandPhase move;
  move.kind = plant::HandPhase::Kind::kPrescribed;
  move.profile = {segment(plant::Segment::Kind::kRamp, 3600, from_rad + 3600 * rad_s)};
  plant::Hand hand;
  hand.start_rad = from_rad;
  hand.phases = {move};
  return hand;
}

plant::Plant make_plant(const std::string& root, const plant::Hand& hand) {
  const plant::Parameters& p = lever_plant(root);
  return {p, p.effects, plant::drive_of(design()), hand};
}

TorqueJudge::Motor motor_of_plant(const std::string& root) {
  const plant::Parameters& p = lever_plant(root);
  return {p.supply.voltage_v,     p.motor.torque_constant_nm_a, p.motor.back_emf_constant_v_s_rad,
          p.motor.resistance_ohm, D::clocks_per_tick,           D::pwm_period / D::clocks_per_tick};
}

plant::Bridge bridge_of(const GateTimes& g, int clocks) {
  const double n = clocks;
  const double a_hi = g.a_hi / n, b_hi = g.b_hi / n;
  // With both switches of a leg on, the supply is shorted. The plant does not model this; the case
  // is unsafe anyway.
  return plant::Bridge::gates(a_hi, std::min(g.a_lo / n, 1 - a_hi), b_hi,
                              std::min(g.b_lo / n, 1 - b_hi));
}

std::vector<Act> acts() {
  std::vector<Act> all;
  const auto add = [&all](const char* name, int scene, std::vector<Word> words, plant::Hand hand) {
    Act act;
    act.name = name;
    act.scene = scene;
    act.words = std::move(words);
    act.words.insert(act.words.begin(), word("self_test_pulse", 0));
    act.hand = std::move(hand);
    all.push_back(act);
  };
  // A hand presses against a wall, 0.1 to 0.12 rad into it.
  add("wall", D::S::wall, {counts("wall_contact", 0.1)}, leaning_hand(0.25, 0.75, 0.08, 5));
  add("spring", D::S::spring_tension, {}, leaning_hand(0.4, 0.8, 0.15, 6));
  add("damper", D::S::damper, {}, moving_hand(0, 9));
  add("membrane", D::S::membrane,
      {counts("membrane_lower", 0.1), counts("membrane_upper", 8.0), word("membrane_torque", 0.4)},
      moving_hand(0, 3));
  add("setpoint", D::S::setpoint, {word("setpoint_torque", 0.25)}, leaning_hand(0, 0.1, 0.1, 8));
  add("charge", D::S::charge_repel, {}, leaning_hand(0.4, 0.5, 0.1, 8));
  add("free", D::S::free, {}, leaning_hand(0.2, 0.5, 0.3, 6));
  add("disarmed", D::S::wall, {counts("wall_contact", 0.1)}, leaning_hand(0.25, 0.75, 0.08, 5));
  all.back().arm = false;
  return all;
}

}  // namespace feltgate::faults
