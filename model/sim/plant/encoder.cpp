// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Incremental encoder. Documentation: docs/plant.md
#include "sim/plant/encoder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "feltgate/random.hpp"

namespace feltgate::plant {
namespace {

std::int64_t wrapped(std::int64_t value, std::int64_t modulus) {
  const std::int64_t rest = value % modulus;
  return rest < 0 ? rest + modulus : rest;
}

}  // namespace

Encoder::Encoder(const EncoderParameters& parameters, bool imperfect, double start_rad)
    : counts_per_rev_(4 * static_cast<std::int64_t>(parameters.lines)),
      count_rad_(kTwoPi / static_cast<double>(counts_per_rev_)),
      theta_rad_(start_rad) {
  if (imperfect) {
    SplitMix64 random(parameters.seed);
    for (int line = 0; line < parameters.lines; ++line) {
      const double jitter = parameters.line_jitter_counts_rms * random.gaussian();
      for (const double offset : parameters.edge_offset_counts) {
        offset_counts_.push_back(offset + jitter);
      }
    }
  }
  if (!(std::abs(start_rad / count_rad_) < 0x1p45)) {
    throw std::invalid_argument("encoder: the start is beyond 2^45 counts");
  }
  count_ = static_cast<std::int64_t>(std::floor(start_rad / count_rad_));
  settle();
  while (theta_rad_ >= high_rad_) ++count_, settle();
  while (theta_rad_ < low_rad_) --count_, settle();
}

double Encoder::edge_rad(std::int64_t edge) const {
  double counts = static_cast<double>(edge);
  if (!offset_counts_.empty()) {
    counts += offset_counts_[static_cast<std::size_t>(wrapped(edge, counts_per_rev_))];
  }
  return counts * count_rad_;
}

void Encoder::settle() {
  low_rad_ = edge_rad(count_);
  high_rad_ = edge_rad(count_ + 1);
}

EncoderPins Encoder::pins_of(std::int64_t count) const {
  const std::int64_t phase = wrapped(count, 4);
  return {phase == 2 || phase == 3, phase == 1 || phase == 2, wrapped(count, counts_per_rev_) == 0};
}

void Encoder::cross(double theta_rad, Clock begin, Clock clocks,
                    std::vector<EncoderEvent>& events) {
  const double way_rad = theta_rad - theta_rad_;
  if (!(std::abs(way_rad) <= count_rad_ * static_cast<double>(clocks))) {
    throw std::domain_error("encoder: more than one count per clock");
  }
  const std::size_t first = events.size();
  while (theta_rad >= high_rad_ || theta_rad < low_rad_) {
    const bool up = theta_rad >= high_rad_;
    const double edge = up ? high_rad_ : low_rad_;
    const double part = std::clamp((edge - theta_rad_) / way_rad, 0.0, 1.0);
    count_ += up ? 1 : -1;
    settle();
    const auto late = static_cast<Clock>(std::ceil(part * static_cast<double>(clocks)));
    const Clock clock = begin + std::max<Clock>(1, late);
    if (events.size() > first && events.back().clock >= clock) {
      events.back().pins = pins();
    } else {
      events.push_back({clock, pins()});
    }
  }
  theta_rad_ = theta_rad;
}

}  // namespace feltgate::plant
