// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/rates.md
#include "studies/rates/rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/loop.hpp"
#include "studies/rates/sweep.hpp"
#include "studies/stability/experiments.hpp"

namespace feltgate::rates {

namespace {

void require_one_axis(const law::Compiled& law, const LawSource& source) {
  int axes = 0;
  for (const law::Output& o : law.law.outputs) axes = std::max(axes, o.axis);
  for (const law::Input& i : law.law.inputs) axes = std::max(axes, i.axis);
  if (axes == 0) return;
  throw std::invalid_argument(
      fmt::format("{}: a law of {} axes, and rates runs one lever; choose "
                  "a scene whose law has one axis",
                  source.path, axes + 1));
}

class LeverSweep : public Sweep {
 public:
  LeverSweep(const Scenario& scene, const LawSource& source, const plant::Parameters& plant,
             const design::Elaborated& e, const Options& options)
      : Sweep(source, design_named(law_design), e, options),
        scene_(scene),
        plant_(plant),
        block_(block_law(scene.scene)) {
    require_one_law(scene);
    scene_.expectations.clear();
    of_law_ = block_ != nullptr ? as_law(scene_, *block_, design_named(block_design)) : scene_;
  }

  Report run() {
    law::Compiled fast = fastest(source_, target_);
    require_one_axis(fast, source_);
    report_.scene = scene_.name;
    report_.title = scene_.title;
    report_.law = block_ != nullptr && block_->file.empty() ? block_->scene : fast.law.name;
    report_.plant = plant_.name;
    report_.simulated_s = scene_.duration_s;
    if (block_ != nullptr) report_.block_gates = block_->gates;
    sweep(std::move(fast), block_ != nullptr ? 1 : 0);
    if (block_ != nullptr) run_block();
    if (!continuous_law_.lines.empty()) {
      report_.notes.emplace_back("no margin: the law has a delay line");
    } else if (scene_.tracker) {
      report_.notes.emplace_back("no margin: the tracker, its noise and its delay are in the loop");
    } else if (places_.any_states() || keeps_time(source_)) {
      margins_by_states();
    } else {
      margins();
    }
    return report_;
  }

 private:
  void run_law(law::Compiled law, RateRow row) override {
    const Scenario scene = fitted(of_law_, law.image);
    const std::unique_ptr<SceneLaw> loaded = make_scene_law(std::move(law), design_);
    run(scene, law_design, loaded.get(), row);
  }

  void run_block() {
    RateRow row;
    row.block = true;
    run(scene_, block_design, nullptr, row);
  }

  void run(const Scenario& scene, const std::string& design, SceneLaw* law, RateRow row) {
    Continuous::Setting set = setting(scene);
    set.slope = set.floor = row.block || (block_ == nullptr && last());
    set.places = set.floor;
    // A law's parameter is what its word says, so its rounding is no error.
    Continuous continuous(
        continuous_law_,
        law == nullptr ? changes_of(of_law_, continuous_law_) : std::vector<Change>{}, set);
    RunOptions o;
    o.design = design;
    o.engine = options_.lock_step ? "rtl,twin" : "twin";
    if (law != nullptr) {
      tell_all(continuous, *law);
      law->tell_values(
          [&](const std::string& name, double value) { tell(continuous, name, value); });
      o.law = law;
    }
    o.row_every = 1;
    o.row = [&](const Row& r) { continuous.tick(r); };
    o.progress = progress();
    const RunResult result = run_scenario(scene, plant_, o);
    if (law != nullptr) law->tell_values({});
    row.mismatches = result.mismatches;
    row.clocks_compared = result.lock_step ? result.clocks : 0;
    row.first_mismatch = result.first_mismatch;
    row.fault = first_fault(result.felt.faults);
    if (row.fault.empty()) note_stale(result.law_stale);
    row.cpu_s_per_s = cpu_s(scene, design, law) / result.simulated_s;
    if (set.places) places_ = continuous.places();
    add(std::move(row), continuous, set);
  }

  /// CPU time of the closed loop alone, without observers.
  double cpu_s(const Scenario& scene, const std::string& design, SceneLaw* law) const {
    RunOptions o;
    o.design = design;
    o.engine = "twin";
    o.law = law;
    const std::clock_t begin = std::clock();
    run_scenario(scene, plant_, o);
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }

  /// Enables the lever's linear friction, which plant files contain for such studies.
  stability::LoopModel linear_loop() {
    plant::Parameters plant = plant_;
    plant.effects = scene_.effects;
    plant.effects.viscous = true;
    const stability::LoopModel model = stability::make_model(e_, plant);
    report_.damping_nm_s_rad = model.damping_nm_s_rad;
    return model;
  }

  /// Of a law whose springs and masses are states, as it runs at each rate.
  void margins_by_states() {
    const Place* place = places_.steepest();
    if (place == nullptr) {
      report_.notes.emplace_back("no margin: the motion met no place where the law has a slope");
      return;
    }
    const stability::LoopModel model = linear_loop();
    for (RateRow& r : report_.rows) {
      const law::Law law = read(source_, static_cast<double>(target_.tick_hz) / r.ticks);
      const auto linear = linearised(law, *place, design_.count_rad);
      if (!linear) continue;
      const Margin m = margin(model, *linear, place->most_nm_rad, r.ticks, delay_of(r));
      if (m.ratio > 0) {
        r.margin = m;
      } else {
        note_once(
            "where there is a - for the margin, no torque is stable at that place, not even a "
            "ten-thousandth: the law pushes away there, or the rate is far too low");
      }
    }
    report_.notes.emplace_back(
        "the margin is that of the law's whole torque with its states, at the place of the motion "
        "where it is the stiffest spring at 50 Hz; the border is the torque per angle there, the "
        "largest at 5, 50 and 500 Hz, times the margin");
  }

  void margins() {
    const stability::LoopModel model = linear_loop();
    for (RateRow& r : report_.rows) r.margin = margin(model, report_.slope, r.ticks, delay_of(r));
  }

  Scenario scene_, of_law_;
  const plant::Parameters& plant_;
  const BlockLaw* block_;
  Places places_;
};

}  // namespace

Report measure(const Scenario& scene, const LawSource& source, const plant::Parameters& plant,
               const design::Elaborated& e, const Options& options) {
  return LeverSweep(scene, source, plant, e, options).run();
}

}  // namespace feltgate::rates
