// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What every run of a scene has, of one axis or several: options, what its host does in time, and
// results up to its expectations. Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "../backends/backend.hpp"
#include "felt.hpp"
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

/// Options of every run, also of a replay.
struct BackendOptions {
  std::string design = "lever";
  std::string engine = "all";  ///< comma list, see choose_backends()
  std::uint64_t seed = 1;
  std::string fst;                  ///< waveform of the clocks fst_from to fst_to; empty: none
  Clock fst_from = 0, fst_to = -1;  ///< counted from reset; fst_to < 0: to the end
  int row_every = 1;                ///< a row of output for every row_every-th tick
};

/// Options of a scene's run.
struct SessionOptions : BackendOptions {
  SceneLaw* law = nullptr;  ///< run by the scene "law"; its parameters can be set by name
  std::function<void(double done)> progress;  ///< called from time to time with 0..1; may be empty
};

/// Results of every run.
struct SessionResult {
  std::string design, subject;  ///< subject: scene or trace
  Clock clocks = 0;             ///< without homing
  std::int64_t ticks = 0;
  bool lock_step = false;
  std::int64_t mismatches = 0;
  std::string first_mismatch;
  Clock first_mismatch_clock = 0;  ///< counted from reset
  std::string reference;  ///< back-end that the others are compared with: "quad", "double" or none
  double simulated_s = 0;
  Acted law_stale;  ///< armed, but no torque: a mailbox of the law was too old
  std::map<std::string, double> figures;  ///< the figures that a scene file can bound
  std::vector<Expected> expectations;     ///< of the scene
  std::vector<std::string> broken;        ///< broken expectations and bounds, one line each
  std::vector<std::string> large;         ///< those of `broken` by note_large_error()

  bool as_expected() const { return mismatches == 0 && broken.empty(); }
};

/// Breaks the run if a torque without a proven bound is off from the law by more than 10 % of the
/// largest asked, unless the scene expects something of that error's figure.
void note_large_error(SessionResult& out, const std::string& figure, double off_nm, double asked_nm,
                      double lsb_nm);

/// Notes in which clocks a back-end's halves differed.
void note_mismatches(SessionResult& out, const AnyBackend& backend);

/// A scene in time: arming, events, mailbox; ticks, faults; expectations. It knows no plant.
class Session {
 public:
  /// All must outlive this object. Errors: those of scene_number().
  Session(const Scenario& scenario, RunHost& host, const SessionOptions& options);

  /// Queues the scene's parameters and its first control word, not armed.
  void begin();
  Clock clock_of(double seconds) const {
    constexpr double never = 0x1p62;  // no sum with it overflows
    return std::llround(std::min(seconds * static_cast<double>(host_.design().clock_hz), never));
  }
  Clock end() const { return end_; }
  /// The next clock at which act() has something to do.
  Clock next() const { return next_; }
  /// Arms, applies events, sends mailboxes, all that is due at `now`; the lever's angle and its
  /// position by the core's count are those of `now`. Calls `after` with each event that it
  /// applied.
  template <class After>
  void act(Clock now, double angle_rad, double encoder_rad, After&& after) {
    if (now < next_) return;
    if (now >= arm_at_) arm();
    while (now >= event_at()) {
      apply(s_.events[event_]);
      after(s_.events[event_++]);
    }
    if (now >= feed_.next()) feed_.act(now, angle_rad, encoder_rad, host_);
    next_ = std::min({arm_at_, event_at(), feed_.next()});
  }
  /// Counts a tick, with the faults of all axes.
  void tick(const Snapshot& axis_0, unsigned faults) {
    if (host_.stale(axis_0) && stale_ticks_++ == 0) stale_from_ = ticks_;
    faults_ |= faults;
    ++ticks_;
  }
  /// Ticks so far.
  std::int64_t ticks() const { return ticks_; }
  /// Reports the progress, from time to time.
  void report_progress(Clock now) {
    if (!options_.progress || now < next_report_) return;
    options_.progress(static_cast<double>(now) / static_cast<double>(end_));
    next_report_ = now + host_.design().clock_hz / 100;
  }

  /// Fills in everything but reference and expectations; the run adds its own figures.
  void fill_result(SessionResult& out) const;
  /// Compares the figures with what the scene expects of this design. Errors: config::ConfigError
  /// for a figure that does not exist.
  void check_expectations(SessionResult& out) const;

 private:
  static constexpr Clock never = std::numeric_limits<Clock>::max();
  Clock event_at() const {
    return event_ < s_.events.size() ? clock_of(s_.events[event_].at_s) : never;
  }
  void arm();
  void apply(const Event& e);
  void control() { host_.set_control(scene_, mode_, armed_); }

  const Scenario& s_;
  RunHost& host_;
  const SessionOptions& options_;
  HostFeed feed_;
  Clock end_, arm_at_, next_ = 0, next_report_ = 0;
  std::size_t event_ = 0;  ///< the next one
  int scene_, mode_;
  bool armed_ = false;
  std::int64_t ticks_ = 0, stale_ticks_ = 0, stale_from_ = 0;
  unsigned faults_ = 0;
};

}  // namespace feltgate
