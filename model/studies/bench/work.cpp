// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Recording of the benchmark's work. Documentation: docs/speed-for-accuracy.md
#include "studies/bench/work.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "feltgate/while_armed.hpp"
#include "sim/loop/scenario_bounds.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/bench/runner.hpp"

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

// The proven bounds for the motion of a work.

namespace {

/// Largest |N-method velocity| before its low-pass, rad/s.
double largest_velocity_rad_s(const design::Elaborated& e, const std::vector<ChainIn>& ticks) {
  const auto m1 = static_cast<std::size_t>(e.design.m1);
  int counts = 0;
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const int before = k < m1 ? 0 : ticks[k - m1].travel;
    counts = std::max(counts, std::abs(static_cast<std::int16_t>(ticks[k].travel - before)));
  }
  return counts * e.rad_s_per_count();
}

std::string scene_name(const design::Elaborated& e, int number) {
  for (const design::Scene& s : e.registers.scenes) {
    if (s.number == number) return s.name;
  }
  return "free";
}

}  // namespace

bounds::ErrorBounds work_bounds(const design::Elaborated& e, const Work& work) {
  RunBounds run(e, std::max(largest_velocity_rad_s(e, work.ticks), hardly_any_rad_s));
  auto write = work.writes.begin();
  int scene = -1, mode = -1;
  for (std::size_t k = 0; k < work.ticks.size(); ++k) {
    for (; write != work.writes.end() && write->tick <= k; ++write) {
      for (const design::Word& w : e.words) {
        if (w.parameter.address == write->address) run.set(w.parameter.name, write->value, k > 0);
      }
    }
    const ChainIn& in = work.ticks[k];
    if (in.scene == scene && in.mode == mode) continue;
    scene = in.scene;
    mode = in.mode;
    run.render(scene_name(e, scene), mode);
  }
  return run.worst();
}

}  // namespace feltgate::bench
