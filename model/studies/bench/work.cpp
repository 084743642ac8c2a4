// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Recording of the benchmark's work. Documentation: docs/speed-for-accuracy.md
#include "studies/bench/work.hpp"

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "feltgate/while_armed.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/bench/pin_runner.hpp"

namespace feltgate::bench {

namespace {

/// Fills the ticks from the pins: what the twin samples, and when it carries out each write.
void sample(Work* work, const std::string& design) {
  const auto backend = make_backend(design, "twin");
  const DesignInfo& d = backend->design();
  work->simulated_s = static_cast<double>(work->inputs.clocks) / static_cast<double>(d.clock_hz);
  std::size_t applied = 0;
  HostBeside host(d.control_reset);
  backend->reset(1, work->inputs.pins);
  play(*backend, work->inputs, [&](const Snapshot& s) {
    for (; applied < static_cast<std::size_t>(s.writes); ++applied) {
      const HostWrite& w = work->inputs.writes[applied];
      if (host.write(w.address, w.data, s.armed)) {
        work->writes.push_back({work->ticks.size(), w.address, w.data, w.value});
      }
    }
    const bool restart = host.restart(s.armed, s.scene);
    work->ticks.push_back(
        {s.position, s.travel, s.armed, s.scene, host.mode(), restart, relief_of(s.limits)});
  });
}

}  // namespace

Scene read_scene(const std::string& root, const std::string& name) {
  const auto file = [&root](const std::string& folder, const std::string& stem) {
    const std::string path = root + "/vectors/" + folder + "/" + stem + ".toml";
    if (!std::filesystem::exists(path)) {
      throw std::invalid_argument("\"" + stem + "\" is not in vectors/" + folder +
                                  "; give the name of a file there, without .toml");
    }
    return path;
  };
  Scene s;
  s.scenario = read_scenario(file("scenes", name));
  s.scenario.expectations.clear();
  s.plant = plant::read_plant_file(file("plants", s.scenario.plant));
  resolve_effects(s.scenario, s.plant.effects);
  return s;
}

Work record_scene(const Scene& scene, const std::string& design) {
  Work work;
  work.name = scene.scenario.name;
  RunOptions options;
  options.design = design;
  options.engine = "twin";
  options.inputs = &work.inputs;
  run_scenario(scene.scenario, scene.plant, options);
  sample(&work, design);
  return work;
}

Work slow_small_signals(const std::string& design, double seconds) {
  const DesignInfo d = design_named(design);
  const auto clock = [&d](double s) { return std::llround(s * static_cast<double>(d.clock_hz)); };
  Work work;
  work.name = "slow_small";
  work.inputs.clocks = clock(seconds);
  const auto control = [&d](bool arm, int scene) { return control_word(d, scene, 0, arm); };
  const int damper = d.scene_number("damper"), setpoint = d.scene_number("setpoint");
  work.inputs.writes.push_back({0, d.find("self_test_pulse")->address, 0, 0});
  work.inputs.writes.push_back({0, d.control_address, control(true, damper), 0});
  // Gray code of a count that goes one up, one down, two up, two down, 0.1 to 40 ms apart.
  int count = 0;
  double at_s = 0.001;
  for (int k = 0; at_s < seconds; ++k) {
    const int reach = 1 + k / 16 % 3;
    count += k / reach % 2 == 0 ? 1 : -1;
    const unsigned phase = static_cast<unsigned>(count) & 3u;
    work.inputs.edges.push_back({clock(at_s), {phase == 1 || phase == 2, phase >= 2, false}});
    at_s += 1e-4 * (1 + 57 * k % 400);
  }
  // Second half: constant torques of one to a few steps, after the ramp of the change of scene.
  const ParameterInfo& torque = *d.find("setpoint_torque");
  work.inputs.writes.push_back({clock(seconds / 2), d.control_address, control(true, setpoint), 0});
  for (int k = 0; k < 8; ++k) {
    const double value = std::ldexp(k % 2 == 0 ? 1.0 + k : -1.0 - k, -d.torque.fraction);
    work.inputs.writes.push_back({clock(seconds * (0.51 + 0.06 * k)), torque.address,
                                  static_cast<std::uint32_t>(quantise_parameter(torque, value)),
                                  value});
  }
  sample(&work, design);
  return work;
}

}  // namespace feltgate::bench
