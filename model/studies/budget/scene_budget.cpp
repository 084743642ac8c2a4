// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error budget of a scene. Documentation: docs/error-bounds.md
#include "studies/budget/scene_budget.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "sim/axes_loop/axes_run.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/scenario_bounds.hpp"

namespace feltgate::bounds {

namespace {

/// The chains of all axes beside a run, and the law on the measurements of each.
class Beside : public Passenger {
 public:
  Beside(const design::Elaborated& e, const Scenario& scenario, SceneLaw* law, std::size_t axes)
      : law_scene_(law == nullptr ? -1 : e.registers.scene_number("law")) {
    for (std::size_t n = 0; n < axes; ++n) {
      const RunBounds strict = scenario_bounds(e, scenario, hardly_any_rad_s, law, n);
      coverage_.emplace_back(strict.worst(), chain_numbers(e));
      axes_.push_back(make_budget(e.design.name));
    }
    if (law == nullptr) return;
    for (std::size_t chain = 0; chain < Budget::chains; ++chain) {
      const bool fixed = Budget::law_in_fixed(chain);
      // From the position alone a law gives all chains in real numbers the same torques.
      const auto same = std::find_if(riders_.begin(), riders_.end(), [&](const Rider& r) {
        return law->of_position_alone() && Budget::law_in_fixed(r.chains.front()) == fixed;
      });
      if (same != riders_.end()) {
        same->chains.push_back(chain);
      } else {
        riders_.push_back({law->rider(fixed ? "fixed" : "quad"), {chain}});
      }
    }
  }

  void begin() override {
    for (std::size_t n = 0; n < axes_.size(); ++n) axes_[n]->cover(coverage_[n]);
    apart_ = 0;
  }
  void set_parameter(std::size_t axis, int address, double value) override {
    axes_[axis]->set_parameter(address, value);
  }
  void tick(const Snapshot* axes, const ChainIn* in) override {
    const bool in_law = axes[0].armed && axes[0].scene == law_scene_;
    for (Rider& r : riders_) {
      if (in_law && !entered_) r.law->enter();
      const LawRider::Torques* nm = r.law->in_force(axes[0]);
      for (const std::size_t chain : r.chains) {
        for (std::size_t n = 0; n < axes_.size(); ++n) {
          axes_[n]->program(chain, nm == nullptr ? 0 : (*nm)[n]);
        }
      }
    }
    entered_ = in_law;
    for (std::size_t n = 0; n < axes_.size(); ++n) {
      axes_[n]->tick(in[n]);
      const ChainRaw& raw = *axes_[n]->raw();
      apart_ += raw.velocity != axes[n].velocity || raw.tau_hat != axes[n].tau_hat ||
                raw.tau_ref != axes[n].tau_ref || raw.current_ref != axes[n].current_ref;
    }
    for (Rider& r : riders_) {
      for (std::int64_t n = changes_; n < axes[0].law_changes; ++n) r.law->change();
      if (!axes[0].law_begins) continue;
      std::array<LawSample, most_axes> own;
      for (std::size_t n = 0; n < axes_.size(); ++n) own[n] = axes_[n]->sample(r.chains.front());
      r.law->follow(axes, own.data());
    }
    changes_ = std::max(changes_, axes[0].law_changes);
  }

  const Budget& axis(std::size_t n) const { return *axes_[n]; }
  /// Ticks in which the chains in fixed point were not the core.
  std::int64_t apart() const { return apart_; }

 private:
  /// The law in the numbers of these chains, on the measurements of the first.
  struct Rider {
    std::unique_ptr<LawRider> law;
    std::vector<std::size_t> chains;
  };

  int law_scene_;
  std::vector<Coverage> coverage_;
  std::vector<std::unique_ptr<Budget>> axes_;
  std::vector<Rider> riders_;
  bool entered_ = false;
  std::int64_t changes_ = 1;  ///< parameter sets that the riders know; loading is the first
  std::int64_t apart_ = 0;
};

BudgetLine line(const BudgetRow& r, const SourceBound& bound) {
  return {
      {r.name, r.velocity_rad_s.max(), r.tau_hat_nm.max(), r.tau_ref_nm.max(), r.current_a.max()},
      {r.name, r.velocity_rad_s.rms(), r.tau_hat_nm.rms(), r.tau_ref_nm.rms(), r.current_a.rms()},
      bound};
}

void add(SourceBound& to, const SourceBound& x) {
  to.velocity_rad_s += x.velocity_rad_s;
  to.tau_hat_nm += x.tau_hat_nm;
  to.tau_ref_nm += x.tau_ref_nm;
  to.current_a += x.current_a;
}

}  // namespace

bool BudgetLine::holds() const {
  return max.velocity_rad_s <= bound.velocity_rad_s && max.tau_hat_nm <= bound.tau_hat_nm &&
         max.tau_ref_nm <= bound.tau_ref_nm && max.current_a <= bound.current_a;
}

bool SceneBudget::within_bounds() const {
  return whole.holds() && gain.holds() &&
         std::all_of(sources.begin(), sources.end(), [](const BudgetLine& l) { return l.holds(); });
}

namespace {

/// The budget of one axis after a run.
SceneBudget axis_budget(const design::Elaborated& e, const Scenario& scenario, const SceneLaw* law,
                        const Budget& budget, std::size_t axis) {
  SceneBudget out;
  out.ticks = budget.coverage().ticks();
  out.ticks_out_of_bounds = budget.coverage().outside();
  out.largest_velocity_rad_s = budget.largest_velocity_rad_s();
  const double velocity_rad_s = std::max(out.largest_velocity_rad_s, hardly_any_rad_s);
  const RunBounds run = scenario_bounds(e, scenario, velocity_rad_s, law, axis);
  const ErrorBounds& w = run.worst();
  const SourceBound whole{"whole", w.velocity_rad_s.against_reference,
                          w.tau_hat_nm.against_reference, w.tau_ref_nm.against_reference,
                          w.current_a.against_reference};
  out.sum.max.name = out.sum.bound.name = "sum";
  for (const BudgetRow& r : budget.rows()) {
    if (r.name == "whole") {
      out.whole = line(r, whole);
      continue;
    }
    const auto bound = std::find_if(run.sources().begin(), run.sources().end(),
                                    [&](const SourceBound& s) { return s.name == r.name; });
    BudgetLine l = line(r, *bound);
    if (r.name == "gain") {
      out.gain = l;
      continue;
    }
    if (law != nullptr && r.name == "scenes") l.max.name = l.rms.name = l.bound.name = "law";
    add(out.sum.max, l.max);
    add(out.sum.bound, l.bound);
    out.sources.push_back(l);
  }
  return out;
}

std::vector<SceneBudget> budgets(const design::Elaborated& e, const Scenario& scenario,
                                 const BudgetOptions& options, std::size_t axes,
                                 SessionOptions& run, const std::function<void()>& run_it) {
  e.design.needs_n_method("the error budget");
  Beside beside(e, scenario, options.law, axes);
  run.design = e.design.name;
  run.engine = "twin";
  run.seed = options.seed;
  run.law = options.law;
  run.passenger = &beside;
  run.progress = options.progress;
  run_it();
  std::vector<SceneBudget> all;
  for (std::size_t n = 0; n < axes; ++n) {
    all.push_back(axis_budget(e, scenario, options.law, beside.axis(n), n));
    all.back().ticks_apart = beside.apart();
  }
  return all;
}

}  // namespace

SceneBudget scene_budget(const design::Elaborated& e, const Scenario& scenario,
                         const plant::Parameters& plant, const BudgetOptions& options) {
  RunOptions run;
  return budgets(e, scenario, options, 1, run, [&] { run_scenario(scenario, plant, run); }).front();
}

std::vector<SceneBudget> scene_budgets(const design::Elaborated& e, const AxesScene& scene,
                                       const BudgetOptions& options) {
  AxesRunOptions run;
  return budgets(e, scene.scenario, options, static_cast<std::size_t>(axes_of(scene)), run,
                 [&] { run_axes(scene, run); });
}

}  // namespace feltgate::bounds
