// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Summary of what a run felt like. Documentation: docs/json.md
#include "sim/loop/felt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/backends/backend.hpp"

namespace feltgate {

void BitTimes::settle() {
  for (std::size_t bit = 0; bit < ticks_.size(); ++bit) {
    if (run_ == 0 || ((word_ >> bit) & 1u) == 0) continue;
    if (ticks_[bit] == 0) first_[bit] = ticks_so_far_;
    ticks_[bit] += run_;
  }
  ticks_so_far_ += run_;
  run_ = 0;
}

std::string Expected::wanted() const {
  if (std::isinf(low)) return fmt::format("at most {:.6g}", high);
  if (std::isinf(high)) return fmt::format("at least {:.6g}", low);
  return fmt::format("{:.6g} to {:.6g}", low, high);
}

FeltMeter::FeltMeter(double tick_s, bool measures)
    : tick_s_(tick_s),
      measures_(measures),
      window_ticks_(std::max<std::int64_t>(1, std::llround(felt_window_s / tick_s))),
      window_left_(window_ticks_) {}

bool FeltMeter::tau_hat_void(unsigned limits) const {
  return !measures_ && (limits & (limit::voltage | limit::duty)) != 0;
}

void FeltMeter::end_window() {
  const double ticks = static_cast<double>(window_ticks_);
  const std::int64_t begin = ticks_ - window_ticks_;
  motor_.add(motor_sum_nm_ / ticks, begin);
  window_hand_nm_ = hand_nm_s_ / (ticks * tick_s_);
  hand_.add(window_hand_nm_, begin);
  motor_error_.add((motor_sum_nm_ - asked_sum_nm_) / ticks);
  hand_nm_s_ = motor_sum_nm_ = asked_sum_nm_ = 0;
  window_left_ = window_ticks_;
}

Felt FeltMeter::felt() {
  Felt f;
  f.torque = {peak(asked_), peak(commanded_), peak(motor_), peak(hand_), motor_error_};
  f.energy = {taken_j_, 0.0 - returned_j_, highest_j_, 0.0 - lowest_j_};
  f.limits = limits_.times(limit::names, tick_s_);
  f.tau_hat_void = void_.times(std::array{"tau_hat"}, tick_s_)["tau_hat"];
  f.faults = faults_.times(fault_names, tick_s_);
  return f;
}

std::string first_fault(const std::map<std::string, Acted>& faults) {
  const Acted* first = nullptr;
  std::string text;
  for (const auto& [name, acted] : faults) {
    if (first != nullptr && acted.first_s >= first->first_s) continue;
    first = &acted;
    text = fmt::format("{} at {:.3g} s", name, acted.first_s);
  }
  return text;
}

}  // namespace feltgate
