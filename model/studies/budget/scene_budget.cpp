// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error budget of a scene, and the registry of the designs' budgets. Documentation:
// docs/error-bounds.md
#include "studies/budget/scene_budget.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>

#include "sim/axes_loop/axes_run.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/scenario_bounds.hpp"

namespace feltgate::bounds {

namespace {

std::map<std::string, BudgetMaker>& further_budgets() {
  static std::map<std::string, BudgetMaker> list;
  return list;
}

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

void add_budget(const std::string& design, BudgetMaker make) { further_budgets()[design] = make; }

#define FELTGATE_DESIGN(name) std::unique_ptr<Budget> make_##name##_budget();
#include "designs.inc"
#undef FELTGATE_DESIGN

std::unique_ptr<Budget> make_budget(const std::string& design) {
#define FELTGATE_DESIGN(name) \
  if (design == #name) return make_##name##_budget();
#include "designs.inc"
#undef FELTGATE_DESIGN
  const auto further = further_budgets().find(design);
  if (further != further_budgets().end()) return further->second();
  throw std::invalid_argument("design \"" + design + "\" is not built in; run `feltgate generate`");
}

bool BudgetLine::holds() const {
  return max.velocity_rad_s <= bound.velocity_rad_s && max.tau_hat_nm <= bound.tau_hat_nm &&
         max.tau_ref_nm <= bound.tau_ref_nm && max.current_a <= bound.current_a;
}

bool SceneBudget::within_bounds() const {
  return whole.holds() && gain.holds() &&
         std::all_of(sources.begin(), sources.end(), [](const BudgetLine& l) { return l.holds(); });
}

BudgetRun::BudgetRun(const design::Elaborated& e, const Scenario& scenario, SceneLaw* law,
                     std::size_t axes)
    : e_(e),
      scenario_(scenario),
      law_(law),
      law_scene_(law == nullptr ? -1 : e.registers.scene_number("law")) {
  e.design.needs_n_method("the error budget");
  for (std::size_t n = 0; n < axes; ++n) {
    const RunBounds strict = scenario_bounds(e, scenario, hardly_any_rad_s, law, n);
    coverage_.emplace_back(strict.worst(), chain_numbers(e));
    axes_.push_back(make_budget(e.design.name));
  }
  for (std::size_t chain = 0; law != nullptr && chain < Budget::chains; ++chain) {
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

void BudgetRun::begin() {
  for (std::size_t n = 0; n < axes_.size(); ++n) axes_[n]->cover(coverage_[n]);
  apart_ = 0;
}

void BudgetRun::set_parameter(std::size_t axis, int address, double value) {
  axes_[axis]->set_parameter(address, value);
}

void BudgetRun::tick(const Snapshot* axes, const ChainIn* in) {
  const bool in_law = axes[0].armed && axes[0].scene == law_scene_;
  for (Rider& r : riders_) {
    if (in_law && !entered_) r.law->enter();
    const LawRider::Torques* nm = r.law->in_force(axes[0]);
    for (const std::size_t chain : r.chains) {
      for (std::size_t n = 0; n < axes_.size(); ++n) {
        axes_[n]->program_chain(chain, nm == nullptr ? 0 : (*nm)[n]);
      }
    }
  }
  entered_ = in_law;
  bool apart = false;
  for (std::size_t n = 0; n < axes_.size(); ++n) {
    axes_[n]->tick(in[n]);
    const ChainRaw& raw = *axes_[n]->raw();
    apart = apart || raw.velocity != axes[n].velocity || raw.tau_hat != axes[n].tau_hat ||
            raw.tau_ref != axes[n].tau_ref || raw.current_ref != axes[n].current_ref;
  }
  apart_ += apart ? 1 : 0;
  for (Rider& r : riders_) {
    for (std::int64_t n = changes_; n < axes[0].law_changes; ++n) r.law->change();
    if (!axes[0].law_begins) continue;
    std::array<LawSample, most_axes> own;
    for (std::size_t n = 0; n < axes_.size(); ++n) own[n] = axes_[n]->sample(r.chains.front());
    r.law->follow(axes, own.data());
  }
  changes_ = std::max(changes_, axes[0].law_changes);
}

SceneBudget BudgetRun::budget(std::size_t axis) const {
  const Budget& budget = *axes_[axis];
  SceneBudget out;
  out.ticks_apart = apart_;
  out.ticks = budget.coverage().ticks();
  out.ticks_out_of_bounds = budget.coverage().outside();
  out.ticks_out_of_coefficients = budget.outside_coefficients();
  out.largest_velocity_rad_s = budget.largest_velocity_rad_s();
  const double velocity_rad_s = std::max(out.largest_velocity_rad_s, hardly_any_rad_s);
  const RunBounds run = scenario_bounds(e_, scenario_, velocity_rad_s, law_, axis);
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
    if (law_ != nullptr && r.name == "scenes") l.max.name = l.rms.name = l.bound.name = "law";
    add(out.sum.max, l.max);
    add(out.sum.bound, l.bound);
    out.sources.push_back(l);
  }
  return out;
}

namespace {

std::vector<SceneBudget> budgets(const design::Elaborated& e, const Scenario& scenario,
                                 const BudgetOptions& options, std::size_t axes,
                                 SessionOptions& run, const std::function<void()>& run_it) {
  BudgetRun beside(e, scenario, options.law, axes);
  run.design = e.design.name;
  run.engine = "twin";
  run.seed = options.seed;
  run.law = options.law;
  run.passenger = &beside;
  run.progress = options.progress;
  run_it();
  std::vector<SceneBudget> all;
  for (std::size_t n = 0; n < axes; ++n) all.push_back(beside.budget(n));
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
