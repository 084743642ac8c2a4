// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Figures of step responses. Documentation: docs/json.md
#include "sim/loop/figures.hpp"

#include <algorithm>

#include "feltgate/largest.hpp"

namespace feltgate {

void StepSamples::add(double value) {
  const std::int64_t within = samples_++ % per_block_;
  if (within == 0) {
    blocks_.push_back({value, value, value, 0});
  } else {
    Block& b = blocks_.back();
    const double off = value - b.mean;
    b.low = smaller(b.low, value);
    b.high = larger(b.high, value);
    b.mean += off / static_cast<double>(within + 1);
    b.squares += off * (value - b.mean);
  }
  if (blocks_.size() == most && samples_ % per_block_ == 0) halve();
}

void StepSamples::halve() {
  for (std::size_t i = 0; i < most / 2; ++i) {
    const Block &a = blocks_[2 * i], &b = blocks_[2 * i + 1];
    const double apart = b.mean - a.mean;
    blocks_[i] = {std::min(a.low, b.low), std::max(a.high, b.high), (a.mean + b.mean) / 2,
                  a.squares + b.squares + apart * apart * static_cast<double>(per_block_) / 2};
  }
  blocks_.resize(most / 2);
  per_block_ *= 2;
}

StepResponse StepSamples::response(double sample_s, double tau_ref_nm) const {
  StepResponse r;
  r.tau_ref_nm = tau_ref_nm;
  if (samples_ == 0) return r;
  const auto samples_of = [this](std::size_t block) {
    return std::min(per_block_, samples_ - static_cast<std::int64_t>(block) * per_block_);
  };
  const std::int64_t tail = std::max<std::int64_t>(1, samples_ / 10);
  const auto first_of_tail = static_cast<std::size_t>((samples_ - tail) / per_block_);
  double sum = 0, squares = 0, count = 0;
  for (std::size_t i = first_of_tail; i < blocks_.size(); ++i) {
    const auto n = static_cast<double>(samples_of(i));
    sum += blocks_[i].mean * n;
    count += n;
  }
  r.final_value_nm = sum / count;
  for (std::size_t i = first_of_tail; i < blocks_.size(); ++i) {
    const double off = blocks_[i].mean - r.final_value_nm;
    squares += off * off * static_cast<double>(samples_of(i)) + blocks_[i].squares;
  }
  r.ripple_nm = std::sqrt(squares / count);
  const double step = r.final_value_nm - before_nm_;
  const double band = 0.02 * std::abs(step);
  std::int64_t settled = 0;
  double beyond = 0;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const double above = blocks_[i].high - r.final_value_nm;
    const double below = r.final_value_nm - blocks_[i].low;
    if (above > band || below > band) {
      settled = static_cast<std::int64_t>(i) * per_block_ + samples_of(i);
    }
    beyond = larger(beyond, step >= 0 ? above : below);
  }
  r.settling_ms = 1e3 * sample_s * static_cast<double>(settled);
  r.overshoot_pct = step == 0 ? 0.0 : 100.0 * beyond / std::abs(step);
  r.final_error_pct = tau_ref_nm == 0 ? 0.0 : 100.0 * (r.final_value_nm / tau_ref_nm - 1.0);
  return r;
}

}  // namespace feltgate
