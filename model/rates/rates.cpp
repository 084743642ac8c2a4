// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/rates.md
#include "rates/rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "feltgate/engine_ops.hpp"
#include "law/diagnostics.hpp"
#include "law_loop/scene_law.hpp"
#include "loop/loop.hpp"
#include "stability/experiments.hpp"

namespace feltgate::rates {

namespace {

/// The rate that the file gives; 0: none.
double own_rate_hz(const LawSource& source) {
  try {
    return read(source, 0).rate_hz;
  } catch (const law::LawError&) {
    return 0;  // only dt or a filter lacks it, or the compiler has told
  }
}

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

/// At another rate a parameter may have another step, and its range ends up to a step earlier: what
/// the scene sets there is moved to the end.
void fit(std::map<std::string, double>& set, const law::Image& image) {
  for (auto& [name, value] : set) {
    for (const law::ImageWord& w : image.words) {
      if (w.name != name || !w.formula.empty()) continue;
      const double step = w.scale / w.to_si;
      const auto [low, high] = std::minmax({w.lower * step, w.upper * step});
      const double inside = std::clamp(value, low, high);
      if (std::fabs(inside - value) <= std::fabs(step)) value = inside;
    }
  }
}

Scenario fitted(Scenario scene, const law::Image& image) {
  fit(scene.parameters, image);
  for (Event& e : scene.events) fit(e.set, image);
  return scene;
}

class Measurement {
 public:
  Measurement(const Scenario& scene, const LawSource& source, const plant::Parameters& plant,
              const design::Elaborated& e, const Options& options)
      : scene_(scene),
        source_(source),
        plant_(plant),
        e_(e),
        options_(options),
        block_(block_law(scene.scene)),
        design_(design_named(law_design)),
        target_(law::target_of(design_)) {
    require_one_law(scene);
    scene_.expectations.clear();
    of_law_ = block_ != nullptr ? as_law(scene_, *block_, design_named(block_design)) : scene_;
  }

  Report run() {
    const law::Compiled fast = fastest(source_, target_);
    require_one_axis(fast, source_);
    const double own_hz = own_rate_hz(source_);
    continuous_law_ = own_hz > 0 ? fast.law : read(source_, static_cast<double>(target_.tick_hz));
    every_ = own_hz > 0 ? fast.divider : 1;
    report_.scene = scene_.name;
    report_.title = scene_.title;
    report_.law = block_ != nullptr && block_->file.empty() ? block_->scene : fast.law.name;
    report_.plant = plant_.name;
    report_.simulated_s = scene_.duration_s;
    if (block_ != nullptr) report_.block_gates = block_->gates;
    std::set<int> slower;
    for (const double hz : options_.rates_hz) {
      const int ticks = stability::scene_ticks(e_.design, hz);
      if (ticks > fast.divider) slower.insert(ticks);
    }
    if (!fast.law.lines.empty()) {
      slower.clear();
      report_.notes.emplace_back(
          "the law has a delay line, which counts runs: at another rate it is another law");
    }
    all_ = slower.size() + (block_ != nullptr ? 2U : 1U);
    for (auto it = slower.rbegin(); it != slower.rend(); ++it) {
      // What is proven, and fits a word, at the law's own rate need not at another.
      try {
        run_law(at_rate(source_, target_, *it), *it);
      } catch (const law::LawError& error) {
        leave_out(*it, error.diagnostics().front().what);
      } catch (const std::invalid_argument& error) {
        leave_out(*it, error.what());
      }
    }
    run_law(fast, fast.divider);
    if (block_ != nullptr) run_block();
    if (keeps_time(source_)) {
      report_.notes.emplace_back(
          "no margin: the law's springs and masses are states, not its slope");
    } else {
      margins();
    }
    return report_;
  }

 private:
  void leave_out(int ticks, const std::string& reason) {
    --all_;
    report_.notes.push_back(fmt::format(
        "not at {}: {}", rate_text(static_cast<double>(target_.tick_hz) / ticks), reason));
  }

  void run_law(law::Compiled law, int ticks) {
    RateRow row;
    row.ticks = ticks;
    row.runs = ticks / law.divider;
    row.instructions = static_cast<int>(law.assembled.instructions.size());
    row.clocks_used = engine_period(row.instructions, law.target.axes);
    row.clocks_available = law.divider * target_.clocks_per_tick;
    const Scenario scene = fitted(of_law_, law.image);
    // A parameter is what its word says, so its rounding is no error.
    const std::vector<Change> changes = changes_of(scene, continuous_law_, &law.image);
    const std::unique_ptr<SceneLaw> loaded = make_scene_law(std::move(law), design_);
    run(scene, law_design, loaded.get(), changes, row);
  }

  void run_block() {
    RateRow row;
    row.block = true;
    run(scene_, block_design, nullptr, changes_of(of_law_, continuous_law_), row);
  }

  void run(const Scenario& scene, const std::string& design, SceneLaw* law,
           const std::vector<Change>& changes, RateRow& row) {
    const auto limit = scene.parameters.find("torque_limit");
    Continuous::Setting setting;
    setting.count_rad = design_.count_rad;
    setting.limit_nm =
        limit != scene.parameters.end() ? limit->second : design_.find("torque_limit")->si;
    setting.every = every_;
    setting.slope = row.block || (block_ == nullptr && report_.rows.size() + 1 == all_);
    Continuous continuous(continuous_law_, changes, setting);
    RunOptions o;
    o.design = design;
    o.engine = options_.lock_step ? "rtl,twin" : "twin";
    o.law = law;
    o.row_every = 1;
    o.row = [&](const Row& r) { continuous.tick(r); };
    const double done = static_cast<double>(report_.rows.size());
    o.progress = [&](double share) {
      if (options_.progress) options_.progress((done + share) / static_cast<double>(all_));
    };
    const RunResult result = run_scenario(scene, plant_, o);
    row.rate_hz = static_cast<double>(target_.tick_hz) / row.ticks;
    row.error = continuous.error();
    row.mean_error_nm = continuous.mean_error_nm();
    row.mismatches = result.mismatches;
    row.clocks_compared = result.lock_step ? result.clocks : 0;
    row.first_mismatch = result.first_mismatch;
    const Acted* first = nullptr;
    for (const auto& [name, acted] : result.felt.faults) {
      if (first != nullptr && acted.first_s >= first->first_s) continue;
      first = &acted;
      row.fault = fmt::format("{} at {:.3g} s", name, acted.first_s);
    }
    row.cpu_s_per_s = cpu_s(scene, design, law) / result.simulated_s;
    if (setting.slope) {
      report_.slope = continuous.slope();
      report_.floor = continuous.floor();
      report_.largest_nm = continuous.largest_nm();
    }
    report_.rows.push_back(row);
  }

  /// Of the closed loop alone: nobody looks at it.
  double cpu_s(const Scenario& scene, const std::string& design, SceneLaw* law) const {
    RunOptions o;
    o.design = design;
    o.engine = "twin";
    o.law = law;
    const std::clock_t begin = std::clock();
    run_scenario(scene, plant_, o);
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }

  /// The lever's linear friction is on, which plant files keep for such studies.
  void margins() {
    plant::Parameters plant = plant_;
    plant.effects = scene_.effects;
    plant.effects.viscous = true;
    const stability::LoopModel model = stability::make_model(e_, plant);
    report_.damping_nm_s_rad = model.damping_nm_s_rad;
    for (RateRow& r : report_.rows) {
      const int run = (r.clocks_used + target_.clocks_per_tick - 1) / target_.clocks_per_tick;
      r.margin = margin(model, report_.slope, r.ticks, std::min(run, r.ticks));
    }
  }

  Scenario scene_, of_law_;
  LawSource source_;
  const plant::Parameters& plant_;
  const design::Elaborated& e_;
  const Options& options_;
  const BlockLaw* block_;
  DesignInfo design_;
  law::Target target_;
  law::Law continuous_law_;
  int every_ = 1;
  std::size_t all_ = 0;
  Report report_;
};

}  // namespace

Report measure(const Scenario& scene, const LawSource& source, const plant::Parameters& plant,
               const design::Elaborated& e, const Options& options) {
  return Measurement(scene, source, plant, e, options).run();
}

}  // namespace feltgate::rates
