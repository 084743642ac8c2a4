// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A device with several axes at several rates. Documentation: docs/speed-for-accuracy.md
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <utility>

#include "sim/axes_loop/axes_run.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "studies/rates/device_joints.hpp"
#include "studies/rates/sweep.hpp"

namespace feltgate::rates {

namespace {

class AxesSweep : public Sweep {
 public:
  AxesSweep(const AxesScene& scene, const LawSource& source, const design::Elaborated& e,
            const Options& options)
      : Sweep(source, design_named(own_design(scene)), e, options), scene_(scene) {}

  Report run() {
    law::Compiled fast = fastest(source_, target_);
    report_.scene = scene_.scenario.name;
    report_.title = scene_.scenario.title;
    report_.law = fast.law.name;
    report_.plant = device_of(scene_);
    report_.axes = axes_of(scene_);
    report_.simulated_s = scene_.scenario.duration_s;
    sweep(std::move(fast), 0);
    if (whole_torque()) {
      margins_by_states(
          [this](const Place& p, const design::Elaborated&) { return around(p.at_rad); }, places_,
          link(), words());
      if (options_.gains && report_.place) judge();
    } else {
      margins();
    }
    return report_;
  }

 private:
  void run_law(law::Compiled law, RateRow row) override {
    AxesScene scene = scene_;
    scene.scenario = fitted(std::move(scene.scenario), law.image);
    const std::unique_ptr<SceneLaw> loaded =
        make_axes_law(std::move(law), source_.path, design_, report_.axes);
    Continuous::Setting set = setting(scene.scenario);
    set.axes = static_cast<std::size_t>(report_.axes);
    set.slope = set.floor = last();
    set.places = last() && (options_.whole_torque || scene_.plane || keeps_time(source_) ||
                            !continuous_law_.lines.empty());
    set.words = words();
    set.inertia = [&](const Eigen::VectorXd& at) { return inertia_kg_m2(scene_.device, at); };
    Continuous continuous(continuous_law_, {}, set);
    tell_all(continuous, *loaded);
    loaded->tell_values(
        [&](const std::string& name, double value) { tell(continuous, name, value); });
    AxesRunOptions o;
    o.design = design_.name;
    o.engine = options_.lock_step ? "rtl" : "twin";
    o.law = loaded.get();
    o.axes = [&](const std::vector<Row>& axes) { continuous.tick(axes); };
    o.progress = progress();
    const AxesResult result = run_axes(scene, o);
    loaded->tell_values({});
    row.mismatches = result.mismatches;
    row.clocks_compared = result.lock_step ? result.clocks : 0;
    row.first_mismatch = result.first_mismatch;
    for (std::size_t n = 0; n < result.axes.size(); ++n) {
      row.swing_nm =
          std::max(row.swing_nm, result.figures.at(fmt::format("tau_ref_nm.{}.swing", n)));
      if (!row.fault.empty()) continue;
      row.fault = first_fault(result.axes[n].faults);
      if (!row.fault.empty()) row.fault = fmt::format("axis {}, {}", n, row.fault);
    }
    row.expected = static_cast<int>(result.expectations.size());
    for (const Expected& x : result.expectations) {
      if (x.kept()) continue;
      row.broken.push_back(fmt::format("{} = {:.4g}, expected {}", x.figure, x.value, x.wanted()));
    }
    if (set.places) places_ = continuous.places();
    row.cpu_s_per_s = cpu_s(scene, *loaded) / result.simulated_s;
    add(std::move(row), continuous, set);
  }

  bool whole_torque() const {
    return options_.whole_torque || !continuous_law_.lines.empty() || keeps_time(source_) ||
           places_.any_host();
  }
  stability::AxesLoopModel around(const Eigen::VectorXd& at_rad) const {
    const plant::Parameters joint = joint_of(scene_.device, scene_.scenario.effects);
    return stability::make_axes_model(e_, joint, inertia_kg_m2(scene_.device, at_rad));
  }

  /// What the host of [plane] sends of a pose.
  HostWords words() const {
    if (!scene_.plane) return {};
    return [this](const Eigen::VectorXd&, const Eigen::VectorXd& sampled,
                  law::Evaluation<double>& law) {
      for (const auto& [name, si] : plane_words(*scene_.plane, pen_m(scene_.device, sampled))) {
        for (std::size_t i = 0; i < continuous_law_.parameters.size(); ++i) {
          if (continuous_law_.parameters[i].name == name) law.set_parameter(i, si);
        }
      }
    };
  }
  /// A sample is half of the jitter late, on average.
  stability::HostLink link() const {
    if (!scene_.plane) return {};
    const PlaneHostSettings& p = *scene_.plane;
    return host_link(p.rate_hz, p.latency_s + p.jitter_s / 2, 1);
  }

  /// Around the steepest place; what a host holds there stays as it is.
  void margins() {
    if (report_.slope.coupled) {
      report_.notes.emplace_back(
          "in places the law's axes drive each other and no direction is stiff: no part of the "
          "margin");
    }
    if (report_.slope.at_rad.size() == 0) {
      report_.notes.emplace_back("no margin: the motion met the law nowhere stiff or damped");
      return;
    }
    const stability::AxesLoopModel model = around(report_.slope.at_rad);
    report_.damping_nm_s_rad = model.axis.damping_nm_s_rad;
    for (RateRow& r : report_.rows) r.margin = margin(model, report_.slope, r.ticks, delay_of(r));
    if (report_.rows.back().margin.of == Margin::Of::damping) {
      report_.notes.emplace_back("the margin is that of the law's damping: it is nowhere stiff");
    }
  }

  void judge() {
    report_.gains.push_back(judged("alone", around(report_.place->at_rad), link(), words(),
                                   [this](law::Compiled law, const Let& let, const auto& seen) {
                                     swing(std::move(law), let, seen);
                                   }));
  }

  void swing(law::Compiled law, const Let& let,
             const std::function<void(double, const Eigen::VectorXd&)>& seen) {
    AxesScene s = scene_;
    s.scenario.duration_s = let.end_s;
    s.scenario.arm_s = 0.01;
    s.scenario.events.clear();
    s.scenario.expectations.clear();
    s.scenario.parameters = linear_parameters(law.law, let.rest);
    s.scenario = fitted(std::move(s.scenario), law.image);
    plant::Effects& on = s.scenario.effects;
    on.viscous = true;
    on.lugre = on.dead_voltage = on.dead_time = on.supply_limit = on.encoder_imperfect = false;
    if (s.plane) {
      s.plane->latency_s += s.plane->jitter_s / 2;
      s.plane->jitter_s = s.plane->lost = 0;
    }
    hold_and_let_go(s.device, let.rest.inputs.head(report_.axes), let.offset_rad, let.hand_nm,
                    let.begin_s);
    const std::unique_ptr<SceneLaw> loaded =
        make_axes_law(std::move(law), source_.path, design_, report_.axes);
    AxesRunOptions o;
    o.design = design_.name;
    o.engine = "twin";
    o.law = loaded.get();
    std::int64_t tick = 0;
    o.axes = [&](const std::vector<Row>& rows) {
      if (tick++ % let.row_every != 0) return;
      Eigen::VectorXd at(static_cast<Eigen::Index>(rows.size()));
      for (std::size_t n = 0; n < rows.size(); ++n) {
        at[static_cast<Eigen::Index>(n)] = rows[n].theta_rad;
      }
      seen(rows[0].time_s, at);
    };
    run_axes(s, o);
  }

  /// CPU time of the closed loop alone, without observers.
  double cpu_s(const AxesScene& scene, SceneLaw& law) const {
    AxesRunOptions o;
    o.design = design_.name;
    o.engine = "twin";
    o.law = &law;
    const std::clock_t begin = std::clock();
    run_axes(scene, o);
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }

  const AxesScene& scene_;
  Places places_;
};

}  // namespace

Report measure(const AxesScene& scene, const LawSource& source, const design::Elaborated& e,
               const Options& options) {
  return AxesSweep(scene, source, e, options).run();
}

}  // namespace feltgate::rates
