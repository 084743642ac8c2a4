// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the host of a scene sends into the mailbox of its law without an event.
// Documentation: docs/scenes.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "../backends/backend.hpp"
#include "run_host.hpp"
#include "scenario.hpp"
#include "tracker.hpp"

namespace feltgate {

/// When the host sends the mailbox of its law again: at a constant rate from clock 0.
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

/// Regular sends of the mailbox, and the tracker if the scene has one.
class HostFeed {
 public:
  /// `law` is the law of the scene; scene and law must outlive this object.
  HostFeed(const Scenario& scenario, const SceneLaw* law, std::int64_t clock_hz)
      : scenario_(scenario), law_(law), feed_(scenario.feed_hz, clock_hz) {
    if (scenario.tracker) tracker_.emplace(*scenario.tracker, clock_hz);
  }

  /// The next clock at which act() has something to do.
  Clock next() const { return tracker_ ? std::min(feed_.next(), tracker_->next()) : feed_.next(); }
  /// Sends what is due at `now`; angle and position are those of `now`.
  void act(Clock now, double angle_rad, double encoder_rad, RunHost& host) {
    if (tracker_) track(now, angle_rad, encoder_rad, host);
    if (feed_.due(now)) host.feed_law({});
  }

 private:
  void track(Clock now, double angle_rad, double encoder_rad, RunHost& host) {
    tracker_->sample(now, angle_rad, encoder_rad);
    const std::optional<TrackerSample> seen = tracker_->take(now);
    if (!seen) return;
    const TrackerSettings& t = *scenario_.tracker;
    std::map<std::string, double> words{{t.mailbox, seen->angle_rad}};
    if (!t.encoder_mailbox.empty()) words[t.encoder_mailbox] = seen->encoder_rad;
    for (auto& [name, value] : words) value = law_->within(name, value);
    host.feed_law(words);
  }

  const Scenario& scenario_;
  const SceneLaw* law_;
  FeedClock feed_;
  std::optional<Tracker> tracker_;
};

}  // namespace feltgate
