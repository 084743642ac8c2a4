// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error budget of a scene. Documentation: docs/error-bounds.md
#include "studies/budget/scene_budget.hpp"

#include <algorithm>
#include <stdexcept>

namespace feltgate::bounds {

namespace {

/// Takes down what the chains of a run are given, to give it to others later.
class Recorder : public RealChain {
 public:
  const char* name() const override { return "recorder"; }
  void reset() override {}
  void set_parameter(int address, double value) override {
    writes_.push_back({ticks_.size(), address, value});
  }
  void set_word(int, std::uint32_t) override {
    throw std::logic_error("the loop writes parameters by value");
  }
  void tick(const ChainIn& in) override { ticks_.push_back(in); }
  const ChainOut& out() const override { return out_; }
  bool ramping() const override { return false; }

  std::size_t size() const { return ticks_.size(); }
  void replay(RealChain& to, const std::function<void(double)>& progress) const {
    auto write = writes_.begin();
    for (std::size_t k = 0; k < ticks_.size(); ++k) {
      for (; write != writes_.end() && write->tick == k; ++write) {
        to.set_parameter(write->address, write->value);
      }
      to.tick(ticks_[k]);
      if (progress && k % 10'000 == 0) {
        progress(static_cast<double>(k) / static_cast<double>(ticks_.size()));
      }
    }
  }

 private:
  struct Write {
    std::size_t tick;
    int address;
    double value;
  };
  std::vector<ChainIn> ticks_;
  std::vector<Write> writes_;
  ChainOut out_;
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

bool SceneBudget::holds() const {
  return whole.holds() && gain.holds() &&
         std::all_of(sources.begin(), sources.end(), [](const BudgetLine& l) { return l.holds(); });
}

SceneBudget scene_budget(const design::Elaborated& e, const Scenario& scenario,
                         const plant::Parameters& plant, std::uint64_t seed,
                         const std::function<void(double)>& progress) {
  e.design.needs_n_method("the error budget");
  // The replay takes about twice the time of the loop.
  constexpr double loop_share = 0.3;
  Recorder recorder;
  RunOptions options;
  options.design = e.design.name;
  options.engine = "twin";
  options.seed = seed;
  options.passenger = &recorder;
  if (progress) options.progress = [&](double done) { progress(loop_share * done); };
  run_scenario(scenario, plant, options);

  const auto budget = make_budget(e.design.name);
  const RunBounds strict = scenario_bounds(e, scenario, hardly_any_rad_s);
  budget->cover(Coverage(strict.worst(), chain_numbers(e)));
  recorder.replay(*budget, [&](double done) {
    if (progress) progress(loop_share + (1 - loop_share) * done);
  });

  SceneBudget out;
  out.ticks = budget->coverage().ticks();
  out.ticks_out_of_bounds = budget->coverage().outside();
  out.largest_velocity_rad_s = budget->largest_velocity_rad_s();
  const RunBounds run =
      scenario_bounds(e, scenario, std::max(out.largest_velocity_rad_s, hardly_any_rad_s));
  const ErrorBounds& w = run.worst();
  const SourceBound whole{"whole", w.velocity_rad_s.against_reference,
                          w.tau_hat_nm.against_reference, w.tau_ref_nm.against_reference,
                          w.current_a.against_reference};
  out.sum.max.name = out.sum.bound.name = "sum";
  for (const BudgetRow& r : budget->rows()) {
    if (r.name == "whole") {
      out.whole = line(r, whole);
      continue;
    }
    const auto bound = std::find_if(run.sources().begin(), run.sources().end(),
                                    [&](const SourceBound& s) { return s.name == r.name; });
    const BudgetLine l = line(r, *bound);
    if (r.name == "gain") {
      out.gain = l;
      continue;
    }
    add(out.sum.max, l.max);
    add(out.sum.bound, l.bound);
    out.sources.push_back(l);
  }
  return out;
}

}  // namespace feltgate::bounds
