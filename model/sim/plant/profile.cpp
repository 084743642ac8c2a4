// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A value over time made of segments. Documentation: docs/plant.md
#include "sim/plant/profile.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "sim/plant/parameters.hpp"

namespace feltgate::plant {
namespace {

// The value and rate of a segment at t. A sine is centred on `start - amplitude*sin(phase)`, so
// that it begins at `start`. `per_s` is 1/duration.
ProfileSample sample(const Segment& segment, double per_s, double start, double t) {
  const double way = segment.to - start;
  switch (segment.kind) {
    case Segment::Kind::kHold:
      return {start, 0.0};
    case Segment::Kind::kStep:
      return {segment.to, 0.0};
    case Segment::Kind::kRamp: {
      if (segment.ease_s == 0) return {start + way * t * per_s, way * per_s};
      const double rate = way / (segment.duration_s - segment.ease_s), ease = segment.ease_s;
      const double left = segment.duration_s - t;
      if (t < ease) return {start + 0.5 * rate * t * t / ease, rate * t / ease};
      if (left < ease) return {segment.to - 0.5 * rate * left * left / ease, rate * left / ease};
      return {start + rate * (t - 0.5 * ease), rate};
    }
    case Segment::Kind::kMinimumJerk: {
      // Flash and Hogan, J. Neurosci. 1985: zero velocity and acceleration at both ends.
      const double x = t * per_s;
      const double rate = 30.0 * x * x * (1.0 - x) * (1.0 - x) * per_s;
      return {start + way * x * x * x * (10.0 - x * (15.0 - 6.0 * x)), way * rate};
    }
    case Segment::Kind::kSine: {
      const double w = kTwoPi * segment.frequency_hz;
      const double angle = w * t + segment.phase_rad;
      return {start + segment.amplitude * (std::sin(angle) - std::sin(segment.phase_rad)),
              segment.amplitude * w * std::cos(angle)};
    }
  }
  return {start, 0.0};
}

}  // namespace

double duration_s(const Profile& profile) {
  double sum = 0.0;
  for (const Segment& segment : profile) sum += segment.duration_s;
  return sum;
}

ProfileRun::ProfileRun(Profile profile, double start)
    : profile_(std::move(profile)), start_(start) {}

ProfileSample ProfileRun::at(double time_s) {
  while (index_ < profile_.size()) {
    const Segment& segment = profile_[index_];
    if (time_s - begin_s_ < segment.duration_s) {
      if (timed_ != index_) {
        timed_ = index_;
        per_s_ = 1.0 / segment.duration_s;
      }
      return sample(segment, per_s_, start_, time_s - begin_s_);
    }
    start_ = sample(segment, 1.0 / segment.duration_s, start_, segment.duration_s).value;
    begin_s_ += segment.duration_s;
    ++index_;
  }
  return {start_, 0.0};
}

double ProfileRun::next_corner_s(double time_s) const {
  double end_s = begin_s_;
  for (std::size_t i = index_; i < profile_.size(); ++i) {
    end_s += profile_[i].duration_s;
    if (end_s > time_s) return end_s;
  }
  return std::numeric_limits<double>::infinity();
}

double TraceRun::slope(std::size_t i) const {
  if (i == 0 || i + 1 == trace_.time_s.size()) return 0.0;
  return (trace_.theta_rad[i + 1] - trace_.theta_rad[i - 1]) /
         (trace_.time_s[i + 1] - trace_.time_s[i - 1]);
}

ProfileSample TraceRun::at(double time_s) {
  const std::size_t size = trace_.time_s.size();
  if (size == 0) return {};
  if (time_s < trace_.time_s.front()) return {trace_.theta_rad.front(), 0.0};
  while (index_ + 1 < size && time_s >= trace_.time_s[index_ + 1]) ++index_;
  if (index_ + 1 >= size) return {trace_.theta_rad.back(), 0.0};
  const double width = trace_.time_s[index_ + 1] - trace_.time_s[index_];
  const double x = (time_s - trace_.time_s[index_]) / width;
  const double way = trace_.theta_rad[index_ + 1] - trace_.theta_rad[index_];
  const double from = slope(index_) * width;
  const double into = slope(index_ + 1) * width;
  // Hermite polynomial in powers of x: theta + from*x + c2*x^2 + c3*x^3.
  const double c2 = 3.0 * way - 2.0 * from - into;
  const double c3 = from + into - 2.0 * way;
  return {trace_.theta_rad[index_] + x * (from + x * (c2 + x * c3)),
          (from + x * (2.0 * c2 + 3.0 * x * c3)) / width};
}

}  // namespace feltgate::plant
