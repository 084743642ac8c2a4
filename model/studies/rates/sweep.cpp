// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/rates/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "feltgate/engine_ops.hpp"
#include "law/diagnostics.hpp"
#include "sim/law_loop/scene_law.hpp"

namespace feltgate::rates {

namespace {

/// From a host's write to the first run with its words: a word a tick, and the engine's comparison.
constexpr double commit_ticks = 33;

/// The rate that the file gives; 0: none.
double own_rate_hz(const LawSource& source) {
  try {
    return read(source, 0).rate_hz;
  } catch (const law::LawError&) {
    return 0;  // only dt or a filter lacks it, or the compiler has told
  }
}

/// Whether a run more is another motion of the law, for all that it knows of time. A filter knows.
bool counts_runs(const law::Law& law) {
  const auto plain = [](const law::State& s) { return s.follows < 0; };
  return !law.lines.empty() || std::any_of(law.states.begin(), law.states.end(), plain);
}

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

}  // namespace

Scenario fitted(Scenario scene, const law::Image& image) {
  fit(scene.parameters, image);
  for (Event& e : scene.events) fit(e.set, image);
  return scene;
}

Sweep::Sweep(LawSource source, DesignInfo design, const design::Elaborated& e,
             const Options& options)
    : source_(std::move(source)),
      design_(std::move(design)),
      e_(e),
      options_(options),
      target_(law::target_of(design_)) {}

void Sweep::sweep(law::Compiled fast, std::size_t more) {
  const auto tick_hz = static_cast<double>(target_.tick_hz);
  const double own_hz = own_rate_hz(source_);
  const bool by_runs = own_hz > 0 && counts_runs(fast.law);
  continuous_law_ = by_runs ? fast.law : read(source_, tick_hz);
  every_ = by_runs ? fast.divider : 1;
  if (every_ > 1) {
    report_.notes.push_back(
        fmt::format("the continuous law runs at {} too, the rate of its file: its states may count "
                    "runs",
                    rate_text(tick_hz / every_)));
  }
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
  all_ = slower.size() + 1 + more;
  for (auto it = slower.rbegin(); it != slower.rend(); ++it) {
    // What is proven, and fits a word, at the law's own rate need not at another.
    try {
      law::Compiled law = at_rate(source_, target_, *it);
      const RateRow row = row_of(law, *it);
      run_law(std::move(law), row);
    } catch (const law::LawError& error) {
      leave_out(*it, error.diagnostics().front().what);
    } catch (const std::invalid_argument& error) {
      leave_out(*it, error.what());
    }
  }
  const RateRow row = row_of(fast, fast.divider);
  run_law(std::move(fast), row);
}

void Sweep::leave_out(int ticks, const std::string& reason) {
  --all_;
  report_.notes.push_back(fmt::format(
      "not at {}: {}", rate_text(static_cast<double>(target_.tick_hz) / ticks), reason));
}

int Sweep::delay_of(const RateRow& row) const {
  const int run = (row.clocks_used + target_.clocks_per_tick - 1) / target_.clocks_per_tick;
  return std::min(run, row.ticks);
}

stability::HostLink Sweep::host_link(double rate_hz, double latency_s, double alpha) const {
  const auto tick_hz = static_cast<double>(target_.tick_hz);
  return {tick_hz / rate_hz, latency_s * tick_hz + commit_ticks, alpha};
}

std::optional<std::pair<int, int>> Sweep::in_ticks_of(const design::Elaborated& e,
                                                      const RateRow& row) const {
  if (row.block) return std::pair(1, 0);
  const design::Design& d = e.design;
  if (row.rate_hz > 1.001 * static_cast<double>(d.tick_hz)) return std::nullopt;
  const int every = stability::scene_ticks(d, row.rate_hz);
  const int run = (row.clocks_used + d.clocks_per_tick() - 1) / d.clocks_per_tick();
  return std::pair(every, std::min(run, every));
}

void Sweep::margins_by_states(const Around& around, const Places& places,
                              const stability::HostLink& host, const HostWords& words) {
  const Place* place = places.steepest();
  if (place == nullptr) {
    report_.notes.emplace_back("no margin: the motion met no place where the law has a slope");
    return;
  }
  report_.place = *place;
  const stability::AxesLoopModel model = around(*place, e_);
  std::vector<stability::AxesLoopModel> others;
  for (const design::Elaborated& e : options_.beside) others.push_back(around(*place, e));
  report_.damping_nm_s_rad = model.axis.damping_nm_s_rad;
  for (RateRow& r : report_.rows) {
    const law::Law law = read(source_, static_cast<double>(target_.tick_hz) / r.ticks);
    auto linear = linearised(law, *place, design_.count_rad, words);
    if (!linear) {
      for (Beside& b : report_.beside) b.margins.emplace_back();
      continue;
    }
    linear->host = host;
    const Margin m = margin(model, *linear, place->most_nm_rad, r.ticks, delay_of(r));
    if (m.ratio > 0) {
      r.margin = m;
    } else {
      note_once(
          "where there is a - for the margin, no torque is stable at that place, not even a "
          "ten-thousandth: the law pushes away there, or the rate is far too low");
    }
    for (std::size_t n = 0; n < others.size(); ++n) {
      const design::Elaborated& e = options_.beside[n];
      const double ticks =
          static_cast<double>(e.design.tick_hz) / static_cast<double>(target_.tick_hz);
      linear->host.period_ticks = ticks * host.period_ticks;
      linear->host.age_ticks = ticks * host.age_ticks;
      Margin of;
      if (const auto in = in_ticks_of(e, r)) {
        of = margin(others[n], *linear, place->most_nm_rad, in->first, in->second);
      }
      report_.beside[n].margins.push_back(of.ratio > 0 ? of : Margin{});
    }
  }
  report_.notes.emplace_back(
      "the margin is that of the law's whole torque with its states, at the place of the motion "
      "where it is the stiffest spring at 50 Hz; the border is the torque per angle there, the "
      "largest at 5, 50 and 500 Hz, times the margin");
  if (report_.rows.back().margin.slides_1_s > least_slide_1_s) {
    report_.notes.push_back(fmt::format(
        "the plane turns with the pen: without a hand it slides off the body, by {:.3g} 1/s; the "
        "margin is that of the swing alone",
        report_.rows.back().margin.slides_1_s));
  }
  if (words) {
    report_.notes.emplace_back(
        "the host is in the loop of the margin: its samples, their age and its filter, without "
        "noise and lost words");
  }
}

void Sweep::note_once(const std::string& note) {
  const auto& all = report_.notes;
  if (std::find(all.begin(), all.end(), note) == all.end()) report_.notes.push_back(note);
}

void Sweep::note_stale(const Acted& stale) {
  if (stale.seconds == 0) return;
  note_once(fmt::format(
      "a mailbox of the law is stale for {:.4g} s, from {:.4g} s: no torque, not compared; add "
      "[feed] rate_hz (or raise it)",
      stale.seconds, stale.first_s));
}

RateRow Sweep::row_of(const law::Compiled& law, int ticks) const {
  RateRow row;
  row.ticks = ticks;
  row.runs = ticks / law.divider;
  row.instructions = static_cast<int>(law.assembled.instructions.size());
  row.clocks_used = engine_period(row.instructions, law.target.axes);
  row.clocks_available = law.divider * target_.clocks_per_tick;
  return row;
}

Continuous::Setting Sweep::setting(const Scenario& scene) const {
  const auto limit = scene.parameters.find("torque_limit");
  Continuous::Setting setting;
  setting.count_rad = design_.count_rad;
  setting.limit_nm =
      limit != scene.parameters.end() ? limit->second : design_.find("torque_limit")->si;
  setting.every = every_;
  setting.run_s = every_ / static_cast<double>(design_.tick_hz);
  return setting;
}

std::function<void(double)> Sweep::progress() const {
  const double done = static_cast<double>(report_.rows.size());
  return [this, done](double share) {
    if (options_.progress) options_.progress((done + share) / static_cast<double>(all_));
  };
}

void Sweep::tell(Continuous& continuous, const std::string& name, double value) const {
  for (std::size_t i = 0; i < continuous_law_.parameters.size(); ++i) {
    const law::Parameter& p = continuous_law_.parameters[i];
    if (p.name == name && p.derived < 0) continuous.set(i, value * p.to_si);
  }
}

void Sweep::tell_all(Continuous& continuous, const SceneLaw& law) const {
  for (const law::Parameter& p : continuous_law_.parameters) {
    if (p.derived < 0 && law.has(p.name)) tell(continuous, p.name, law.value(p.name));
  }
}

void Sweep::add(RateRow row, const Continuous& continuous, const Continuous::Setting& setting) {
  row.rate_hz = static_cast<double>(target_.tick_hz) / row.ticks;
  row.error = continuous.error();
  row.mean_error_nm = continuous.mean_error_nm();
  for (std::size_t n = 0; n < setting.axes; ++n) row.of_axes.push_back(continuous.error(n));
  if (setting.floor) {
    report_.slope = continuous.slope();
    report_.floor = continuous.floor();
    report_.largest_nm = continuous.largest_nm();
  }
  if (row.error.count() == 0 && row.fault.empty()) {
    note_once(
        "where there is a -, nothing was compared: in every tick the motor is disarmed, or its "
        "torque ramps, is relieved or none");
  }
  report_.rows.push_back(std::move(row));
}

}  // namespace feltgate::rates
