// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// When the host of a scene sends the mailbox of its law again. Documentation: docs/scenes.md
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "../backends/backend.hpp"

namespace feltgate {

/// The send times, at a constant rate from clock 0.
class FeedClock {
 public:
  /// `rate_hz`: sends per second; 0: never.
  FeedClock(double rate_hz, std::int64_t clock_hz)
      : rate_hz_(rate_hz),
        clock_hz_(static_cast<double>(clock_hz)),
        next_(rate_hz > 0 ? 0 : never) {}

  Clock next() const { return next_; }
  /// Whether a send is due at `now`; true only once for each send.
  bool due(Clock now) {
    if (now < next_) return false;
    next_ = std::llround(static_cast<double>(++sent_) * clock_hz_ / rate_hz_);
    return true;
  }

 private:
  static constexpr Clock never = std::numeric_limits<Clock>::max();

  double rate_hz_, clock_hz_;
  Clock next_;
  std::int64_t sent_ = 0;
};

}  // namespace feltgate
