// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A scene of one lever. Documentation: docs/speed-for-accuracy.md
#include <algorithm>
#include <cmath>

#include "sim/loop/felt.hpp"
#include "studies/trim/subject.hpp"

namespace feltgate::trim {

namespace {

Course course(const Motion& motion, const Options& options, const LawMaker& law) {
  const auto feel_it = [motion, design = options.design, window_s = options.window_s,
                        law](const Model& model) {
    return feel(motion.scene, motion.plant, design, model, window_s, law);
  };
  return {motion.amplitude, motion.speed, feel_it};
}

}  // namespace

Felt feel(const Scenario& scene, const plant::Parameters& plant, const std::string& design,
          const Model& model, double window_s, const LawMaker& law) {
  Scenario s = scene;
  s.effects = model.effects;
  s.switched = model.gates;
  s.step_clocks = model.step_clocks;
  s.step_given = true;
  const Clock window = std::llround(window_s * static_cast<double>(design_named(design).clock_hz));
  Signal torque(window, least_torque_nm), position(window, least_position_rad),
      force(window, least_force_n);
  const double start_rad = s.hand.initial_rad();
  const std::unique_ptr<SceneLaw> own = law ? law() : nullptr;
  RunOptions options;
  options.design = design;
  options.engine = "twin";
  options.law = own.get();
  options.plant_step = [&](Clock clocks, const plant::Observables& o) {
    torque.add(clocks, o.motor_torque_mean_nm);
    position.add(clocks, o.theta_rad - start_rad);
    force.add(clocks, o.hand_force_n);
  };
  const double begin = thread_cpu_s();
  const RunResult run = run_scenario(s, plant, options);
  Felt felt;
  felt.cpu_s = thread_cpu_s() - begin;
  felt.torque = {std::move(torque)};
  felt.position = {std::move(position)};
  felt.force = {std::move(force)};
  felt.simulated_s = run.simulated_s;
  felt.states = run.plant_states;
  felt.broken = run.broken;
  felt.fault = first_fault(run.felt.faults);
  return felt;
}

Model full_model(Scenario scene, const plant::Effects& of_plant, int step_clocks) {
  plant::Effects everything = of_plant;
  for (const plant::EffectName& e : plant::effect_names) {
    if (e.flag != &plant::Effects::viscous) everything.*e.flag = true;
  }
  resolve_effects(scene, everything);
  return {scene.effects, true, step_clocks};
}

std::vector<std::string> parts_of(const Model& model, bool has_mass) {
  std::vector<std::string> parts;
  if (model.gates) parts.emplace_back(gates);
  for (const plant::EffectName& e : plant::effect_names) {
    // Gates that switch contain their dead time.
    if (e.flag == &plant::Effects::dead_time && model.gates) continue;
    if (e.flag == &plant::Effects::hand_dynamics && !has_mass) continue;
    if (model.effects.*e.flag) parts.emplace_back(e.name);
  }
  return parts;
}

void set_part(Model& model, const std::string& part, bool on) {
  if (part == gates) model.gates = on;
  for (const plant::EffectName& e : plant::effect_names) {
    if (part == e.name) model.effects.*e.flag = on;
  }
}

Subject lever_subject(const Scenario& scene, const plant::Parameters& plant, const Options& options,
                      const LawMaker& law) {
  const auto parts = [mass = has_mass(scene.hand)](const Model& m) { return parts_of(m, mass); };
  const auto other = [scene, plant, options, law](std::uint64_t seed) {
    return course(perturbed(scene, plant, seed), options, law);
  };
  return {full_model(scene, plant.effects, options.full_step_clocks), parts,
          course({scene, plant}, options, law), other};
}

}  // namespace feltgate::trim
