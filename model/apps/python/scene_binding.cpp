// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene files and hands for Python. Documentation: docs/python.md
#include "apps/python/bindings.hpp"
#include "sim/loop/scenario.hpp"

namespace feltgate::python {
namespace {

using plant::Hand;
using plant::HandPhase;
using plant::Segment;

/// Straight lines through the points, after a hold up to the first; the value before is `start`.
plant::Profile straight_lines(const std::vector<double>& time_s, const std::vector<double>& value) {
  plant::Profile profile;
  if (time_s.front() > 0) profile.push_back({Segment::Kind::kHold, time_s.front()});
  Segment first;
  first.kind = Segment::Kind::kStep;
  first.to = value.front();
  profile.push_back(first);
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    Segment line;
    line.kind = Segment::Kind::kRamp;
    line.duration_s = time_s[i] - time_s[i - 1];
    line.to = value[i];
    profile.push_back(line);
  }
  return profile;
}

void check_times(const std::vector<double>& time_s, std::size_t values, const char* name) {
  if (time_s.size() != values || values < 2) {
    throw std::invalid_argument(
        fmt::format("time_s has {} values and {} has {}; give both the same number, at least 2",
                    time_s.size(), name, values));
  }
  if (time_s.front() < 0) {
    throw std::invalid_argument(
        fmt::format("time_s[0] is {} s; a run begins at 0, so begin there or later", time_s[0]));
  }
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (!(time_s[i] > time_s[i - 1])) {
      throw std::invalid_argument(
          fmt::format("time_s[{}] = {} s is not after time_s[{}] = {} s; sort the times", i,
                      time_s[i], i - 1, time_s[i - 1]));
    }
  }
}

Hand motion(const Doubles& times, const Doubles& angles) {
  HandPhase phase;
  phase.kind = HandPhase::Kind::kTrace;
  phase.trace = {to_vector(times, "time_s"), to_vector(angles, "angle_rad")};
  check_times(phase.trace.time_s, phase.trace.theta_rad.size(), "angle_rad");
  Hand hand;
  hand.phases.push_back(std::move(phase));
  return hand;
}

Hand torque(const Doubles& times, const Doubles& torques, double start_rad) {
  const auto time_s = to_vector(times, "time_s");
  const auto torque_nm = to_vector(torques, "torque_nm");
  check_times(time_s, torque_nm.size(), "torque_nm");
  HandPhase phase;
  phase.kind = HandPhase::Kind::kTorque;
  phase.profile = straight_lines(time_s, torque_nm);
  Hand hand;
  hand.start_rad = start_rad;
  hand.phases.push_back(std::move(phase));
  return hand;
}

void check_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw std::invalid_argument(fmt::format("{} is {}; give a positive number", name, value));
  }
}

Hand impedance(const Doubles& times, const Doubles& angles, const plant::Impedance& arm) {
  const auto time_s = to_vector(times, "time_s");
  const auto angle_rad = to_vector(angles, "angle_rad");
  check_times(time_s, angle_rad.size(), "angle_rad");
  check_positive(arm.mass_kg, "mass_kg");
  check_positive(arm.damping_ns_m, "damping_ns_m");
  check_positive(arm.stiffness_n_m, "stiffness_n_m");
  check_positive(arm.grip_stiffness_n_m, "grip_stiffness_n_m");
  check_positive(arm.grip_damping_ns_m, "grip_damping_ns_m");
  HandPhase phase;
  phase.kind = HandPhase::Kind::kImpedance;
  phase.profile = straight_lines(time_s, angle_rad);
  phase.impedance = arm;
  Hand hand;
  hand.start_rad = angle_rad.front();
  hand.phases.push_back(std::move(phase));
  return hand;
}

}  // namespace

void bind_scenes(py::module_& m) {
  py::class_<Scenario>(m, "Scene")
      .def(py::init(&read_scenario), "path"_a)
      .def_readonly("name", &Scenario::name)
      .def_readonly("title", &Scenario::title)
      .def_readonly("about", &Scenario::about)
      .def_readonly("duration_s", &Scenario::duration_s)
      .def_readonly("plant", &Scenario::plant)
      .def_property_readonly("renders", &scenes_used)
      .def_readonly("parameters", &Scenario::parameters);

  py::class_<Hand>(m, "Hand")
      .def(py::init<>())
      .def_static("motion", &motion, "time_s"_a, "angle_rad"_a)
      .def_static("torque", &torque, "time_s"_a, "torque_nm"_a, "start_rad"_a = 0.0)
      .def_static(
          "impedance",
          [](const Doubles& time_s, const Doubles& angle_rad, double mass, double damping,
             double stiffness, double grip_stiffness, double grip_damping) {
            return impedance(time_s, angle_rad,
                             {mass, damping, stiffness, grip_stiffness, grip_damping});
          },
          "time_s"_a, "angle_rad"_a, "mass_kg"_a = plant::Impedance{}.mass_kg,
          "damping_ns_m"_a = plant::Impedance{}.damping_ns_m,
          "stiffness_n_m"_a = plant::Impedance{}.stiffness_n_m,
          "grip_stiffness_n_m"_a = plant::Impedance{}.grip_stiffness_n_m,
          "grip_damping_ns_m"_a = plant::Impedance{}.grip_damping_ns_m);
}

}  // namespace feltgate::python
