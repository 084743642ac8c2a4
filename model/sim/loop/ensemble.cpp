// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core with its riders: register writes, riders' ticks, errors. Documentation:
// docs/architecture.md
#include "sim/loop/ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace feltgate {

Ensemble::Ensemble(const std::string& design, const BackendChoice& choice, std::uint64_t seed,
                   EncoderPins pins, const Waveform& waveform)
    : RunHost(make_backend(design, choice.lead)),
      choice_(choice),
      lead_(static_cast<Backend*>(&backend())) {
  const auto last_bit = [](Format f) { return std::ldexp(1.0, -f.fraction); };
  const DesignInfo& d = RunHost::design();
  unit_ = {last_bit(d.velocity), last_bit(d.torque), last_bit(d.current), last_bit(d.voltage)};
  if (!waveform.path.empty()) lead_->trace(waveform.path, waveform.from, waveform.to);
  lead_->reset(seed, pins);
  for (const std::string& kind : choice.riders) {
    Rider r;
    r.chain = make_real_chain(design, kind);
    r.chain->reset();
    r.figures.name = kind;
    riders_.push_back(std::move(r));
  }
  for (const Rider& r : riders_) {
    if (r.figures.name == choice.reference()) reference_ = r.chain.get();
  }
  lead_figures_.compared = reference_ != nullptr && !choice.rider_drives;
}

void Ensemble::write(const HostWrite& w) {
  if (log_ != nullptr) {
    log_->push_back(w);
    log_->back().clock = lead_->now();
  }
  RunHost::write(w);
}

void Ensemble::run_law(SceneLaw& law) {
  require_runs_of_law(choice_);
  load(law);
  for (Rider& r : riders_) r.law = law.rider(r.figures.name);
}

void Ensemble::ride(const Snapshot& s) {
  const ChainIn in = chain_inputs(&s, [this](std::size_t, const HostWrite& w) {
    for (Rider& r : riders_) r.chain->set_parameter(w.address, w.value);
    if (passenger_ != nullptr) passenger_->set_parameter(w.address, w.value);
  })[0];
  lead_figures_.saturations += (s.limits & ~(limit::ramp | limits_of_core)) != 0 ? 1 : 0;
  if (riders_.empty() && passenger_ == nullptr && watch_ == nullptr) return;
  watch_velocity(s.travel);
  if (passenger_ != nullptr) passenger_->tick(s);
  const bool in_law = RunHost::in_law(s);
  if (in_law && !law_entered_) {
    for (Rider& r : riders_) r.law->enter();
    if (watch_ != nullptr) watch_->enter();
  }
  law_entered_ = in_law;
  for (Rider& r : riders_) {
    r.watch.time([&] {
      if (r.law != nullptr) {
        const LawRider::Torques* torque_nm = r.law->in_force(s);
        r.chain->program(torque_nm == nullptr ? 0 : torque_nm->front());
      }
      r.chain->tick(in);
      if (r.law != nullptr) follow_law(r, s);
    });
  }
  if (watch_ != nullptr) {
    for (std::int64_t n = law_changes_; n < s.law_changes; ++n) watch_->change();
    if (s.law_begins) watch_->run(s);
  }
  law_changes_ = std::max(law_changes_, s.law_changes);
  if (reference_ == nullptr) return;
  if (covers_) check_coverage(s);
  if (lead_figures_.compared) {
    compare(lead_figures_, velocity_rad_s(s), torque_nm(s.tau_hat), current_a(s));
  }
  for (Rider& r : riders_) {
    if (r.chain.get() == reference_) continue;
    const ChainOut& o = r.chain->out();
    compare(r.figures, o.velocity_rad_s, o.tau_hat_nm, o.current_a);
    r.figures.compared = true;
  }
}

void Ensemble::follow_law(Rider& r, const Snapshot& s) const {
  for (std::int64_t n = law_changes_; n < s.law_changes; ++n) r.law->change();
  const ChainOut& o = r.chain->out();
  LawSample own{o.velocity_rad_s, o.tau_hat_nm};
  if (const ChainRaw* raw = r.chain->raw()) {
    own.velocity = raw->velocity;
    own.tau_hat = raw->tau_hat;
  }
  r.law->follow(&s, &own);
}

BackendSignals Ensemble::of_core(const Snapshot& s) const {
  const double current = current_a(s);
  return {velocity_rad_s(s),
          torque_nm(s.tau_ref),
          torque_nm(s.tau_hat),
          design().torque_constant_nm_a * current,
          current,
          voltage_v(s),
          static_cast<double>(s.duty) / design().pwm_period};
}

BackendSignals Ensemble::of_chain(const ChainOut& o) const {
  return {o.velocity_rad_s,
          o.tau_ref_nm,
          o.tau_hat_nm,
          design().torque_constant_nm_a * o.current_a,
          o.current_a,
          o.voltage_v,
          o.duty_clocks / design().pwm_period};
}

void Ensemble::fill(Row& row, const Snapshot& s) const {
  row.position_rad = s.position * design().count_rad;
  row.limits = s.limits;
  row.faults = s.faults;
  row.law_stale = stale(s);
  row.engines.clear();
  if (!choice_.rider_drives) row.engines.push_back(of_core(s));
  for (const Rider& r : riders_) row.engines.push_back(of_chain(r.chain->out()));
  static_cast<BackendSignals&>(row) = row.engines.front();
}

void Ensemble::watch_velocity(std::int16_t travel) {
  if (design().m1 == 0) return;  // M/T has no window
  const bool full = window_.size() == static_cast<std::size_t>(design().m1);
  const std::int16_t oldest = full ? window_.front() : std::int16_t{0};
  if (full) window_.pop_front();
  window_.push_back(travel);
  const int counts = static_cast<std::int16_t>(travel - oldest);
  largest_counts_ = std::max(largest_counts_, std::abs(counts));
}

void Ensemble::check_coverage(const Snapshot& s) {
  bounds::TickState t;
  t.velocity_saturated = (s.limits & limit::velocity) != 0;
  t.tau_hat_saturated = (s.limits & limit::tau_hat) != 0;
  t.ramping = (s.limits & limit::ramp) != 0 || reference_->ramping();
  t.tau_ref_error_nm = torque_nm(s.tau_ref) - reference_->out().tau_ref_nm;
  coverage_.tick(t);
}

void Ensemble::compare(BackendFigures& f, double velocity_rad_s, double tau_hat_nm,
                       double current_a) {
  const ChainOut& exact = reference_->out();
  const double velocity_error = velocity_rad_s - exact.velocity_rad_s;
  const double tau_hat_error = tau_hat_nm - exact.tau_hat_nm;
  const double torque_error = design().torque_constant_nm_a * (current_a - exact.current_a);
  const auto add = [](ErrorFigure& figure, double error, bool inside) {
    inside ? figure.add(error) : figure.add_outside(error);
  };
  add(f.velocity_rad_s, velocity_error, !covers_ || coverage_.velocity());
  add(f.tau_hat_nm, tau_hat_error, !covers_ || coverage_.torque());
  add(f.torque_nm, torque_error, !covers_ || coverage_.torque());
}

std::vector<BackendFigures> Ensemble::figures() const {
  std::vector<BackendFigures> all;
  if (choice_.lead == "lockstep") {
    // Both halves showed the same outputs; if not, the mismatches report it.
    for (const char* half : {"rtl", "twin"}) {
      BackendFigures f = lead_figures_;
      f.name = half;
      f.busy_s = lead_->busy_s(half);
      all.push_back(f);
    }
  } else if (!choice_.rider_drives) {
    BackendFigures f = lead_figures_;
    f.name = choice_.lead;
    f.busy_s = lead_watch_.seconds();
    all.push_back(f);
  }
  for (const Rider& r : riders_) {
    all.push_back(r.figures);
    all.back().busy_s = r.watch.seconds();
  }
  return all;
}

}  // namespace feltgate
