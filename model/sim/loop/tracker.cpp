// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A sensor of the host beside the core. Documentation: docs/scenes.md
#include "sim/loop/tracker.hpp"

#include <algorithm>
#include <cmath>

namespace feltgate {

Tracker::Tracker(const TrackerSettings& settings, std::int64_t clock_hz)
    : settings_(settings),
      clock_hz_(static_cast<double>(clock_hz)),
      latency_(std::llround(settings.latency_s * clock_hz_)),
      random_(settings.seed) {}

Clock Tracker::clock_of_sample(std::int64_t number) const {
  return std::llround(static_cast<double>(number) * clock_hz_ / settings_.rate_hz);
}

Clock Tracker::next() const {
  return under_way_.empty() ? next_sample_ : std::min(next_sample_, under_way_.front().at);
}

void Tracker::sample(Clock now, double angle_rad, double encoder_rad) {
  if (now < next_sample_) return;
  double x = settings_.of_encoder ? encoder_rad : angle_rad;
  if (settings_.noise_rad > 0) x += settings_.noise_rad * random_.gaussian();
  if (settings_.resolution_rad > 0) {
    x = settings_.resolution_rad * std::floor(x / settings_.resolution_rad);
  }
  smooth_rad_ = samples_ == 0 ? x : settings_.alpha * x + (1 - settings_.alpha) * smooth_rad_;
  under_way_.push_back({now + latency_, smooth_rad_, encoder_rad});
  next_sample_ = clock_of_sample(++samples_);
}

std::optional<TrackerSample> Tracker::take(Clock now) {
  std::optional<TrackerSample> latest;
  for (; !under_way_.empty() && under_way_.front().at <= now; under_way_.pop_front()) {
    latest = under_way_.front();
  }
  return latest;
}

}  // namespace feltgate
