// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the host of a scene sends into the mailbox of its law without an event.
// Documentation: docs/scenes.md
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "feed_clock.hpp"
#include "run_host.hpp"
#include "scenario.hpp"
#include "tracker.hpp"

namespace feltgate {

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
