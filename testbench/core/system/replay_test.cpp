// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Encoder traces through the whole core, RTL and twin in lock-step, double and quad beside:
// synthetic ones here, recordings where they lie. Of a recording a usual run takes 0.4 s from the
// first step on through the RTL and the whole through the twin; FELTGATE_WHOLE the whole through
// both. Documentation: docs/testing.md, docs/traces.md
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "feltgate/random.hpp"
#include "mismatch.hpp"
#include "moves.hpp"
#include "sim/loop/replay.hpp"
#include "sim/traces/capture.hpp"
#include "sim/traces/open.hpp"

namespace {

namespace fs = std::filesystem;
using namespace feltgate;
using test::Moves;

constexpr Clock kShare = 20'000'000;  // clocks: 0.4 s of the lever

Moves constant_speed(double counts_per_s, std::int64_t counts) {
  Moves m;
  Clock last = 0;
  for (std::int64_t k = 1; k <= counts; ++k) {
    const Clock at = std::llround(static_cast<double>(k) * 50e6 / std::fabs(counts_per_s));
    m.move(at - std::exchange(last, at), counts_per_s > 0 ? 1 : -1);
  }
  return m;
}

/// A sine of growing frequency, at most a count a clock.
Moves chirp(double amplitude, double f0_hz, double f1_hz, double duration_s) {
  constexpr Clock grid = 50;
  Moves m;
  std::int64_t position = 0;
  Clock last = 0;
  for (Clock at = grid; static_cast<double>(at) * 20e-9 < duration_s; at += grid) {
    const double t = static_cast<double>(at) * 20e-9;
    const double turns = f0_hz * t + (f1_hz - f0_hz) * t * t / (2 * duration_s);
    const std::int64_t target = std::llround(amplitude * std::sin(2 * 3.14159265358979 * turns));
    for (Clock now = at; position != target; ++now) {
      const int turn = target > position ? 1 : -1;
      m.move(now - std::exchange(last, now), turn);
      position += turn;
    }
  }
  return m;
}

/// Steps either way at random; of a thousand so many are illegal.
Moves random_walk(std::uint64_t seed, int moves, int per_thousand, Clock least, Clock most) {
  Moves m;
  SplitMix64 random(seed);
  for (int k = 0; k < moves; ++k) {
    const Clock wait = least + random.below(most - least + 1);
    const int legal = random.below(2) == 0 ? 1 : -1;
    m.move(wait, random.below(1000) < per_thousand ? 2 : legal);
  }
  return m;
}

/// A recording from just before its first step on.
class FromFirstStep : public EncoderSource {
 public:
  explicit FromFirstStep(EncoderSource& inner) : inner_(inner), first_(inner.next()) {
    if (first_) skipped_ = std::max<Clock>(0, first_->clock - kShare / 40);
  }
  EncoderPins initial() const override { return inner_.initial(); }
  std::optional<EncoderEvent> next() override {
    std::optional<EncoderEvent> event = first_ ? std::exchange(first_, {}) : inner_.next();
    if (event) event->clock -= skipped_;
    return event;
  }
  Clock length() const override { return inner_.length() - skipped_; }

 private:
  EncoderSource& inner_;
  std::optional<EncoderEvent> first_;
  Clock skipped_ = 0;
};

/// Replays and checks what every trace must fulfil: no mismatch, and the core's own position is the
/// one that an independent count finds.
RunResult replayed(EncoderSource& source, const std::string& name, Clock most_clocks = 0,
                   const std::string& engine = "all") {
  ReplayOptions options;
  options.engine = engine;
  options.most_clocks = most_clocks;
  std::int32_t last = 0;
  const double count_rad = design_named("lever").count_rad;
  options.row = [&](const Row& r) {
    last = static_cast<std::int32_t>(std::lround(r.position_rad / count_rad));
  };
  const RunResult r = run_replay(source, name, options);
  INFO(name << ": " << r.clocks << " clocks, " << r.position.steps << " steps; "
            << r.first_mismatch);
  CHECK(r.mismatches == 0);
  CHECK(last == r.last_position);
  std::cout << name << ": " << r.clocks << (r.lock_step ? " clocks in lock-step, " : " clocks, ")
            << r.mismatches << " mismatches\n";
  return r;
}

/// A recording, opened anew for each run.
RunResult recorded(const std::string& name, const fs::path& file, const traces::Options& how) {
  const auto whole = traces::open(file, how);
  if (feltgate::test::whole_run()) return replayed(*whole, name);
  const auto again = traces::open(file, how);
  FromFirstStep part(*again);
  const RunResult r = replayed(part, name + ", 0.4 s of it", kShare);
  CHECK(r.lock_step);
  CHECK(r.position.steps > 0);
  return replayed(*whole, name, 0, "twin,double,quad");
}

fs::path recordings() {
  const char* folder = std::getenv("FELTGATE_TRACES");
  return folder != nullptr ? fs::path(folder) : fs::path(FELTGATE_ROOT) / "../shared/traces";
}

/// False, and says so, where the recordings are not on this machine.
bool there(const fs::path& file) {
  if (fs::exists(file)) return true;
  std::cout << "SKIPPED: " << file << " is not there; see docs/traces.md for where to get it\n";
  return false;
}

}  // namespace

TEST_CASE("synthetic traces", "[synthetic]") {
  const auto play = [](Moves m, const std::string& name, Clock most_clocks = 0) {
    return replayed(m, name, most_clocks);
  };
  const double count_rad = 2 * 3.14159265358979 / 4096;
  for (const double rad_s : {0.1, 1.0, 10.0, 100.0, 600.0, -600.0}) {
    const double counts_per_s = rad_s / count_rad;
    // A fifth of a second each, a few counts at least.
    const auto counts = static_cast<std::int64_t>(std::fmax(4.0, std::fabs(counts_per_s) * 0.1));
    play(constant_speed(counts_per_s, counts), "constant speed " + std::to_string(rad_s) + " rad/s",
         5'000'000);
  }
  play(constant_speed(1.0, 2), "one count per second", 3'000'000);
  Moves reversals, dither, steps, fast;
  for (int k = 0; k < 40 * 15; ++k) reversals.move(900, k % 15 < 7 || k % 15 == 14 ? 1 : -1);
  CHECK(play(reversals, "reversals at every phase").position.reversals > 40);
  for (int k = 0; k < 400; ++k) dither.move(9'650, k % 2 == 0 ? 1 : -1);
  play(dither, "dither on one edge");
  for (int k = 0; k < 20 * 50; ++k) {
    steps.move(k % 50 == 0 ? 60'000 : 300, k / 50 % 2 == 0 ? 1 : -1);
  }
  play(steps, "steps");
  for (int k = 0; k < 140'000; ++k) fast.move(1, 1);
  play(fast, "one state per clock, past the wrap of 16 bits");
  play(chirp(300, 1.0, 200.0, 0.1), "chirp");
  play(random_walk(5, 20'000, 0, 20, 400), "random walk");
  CHECK(play(random_walk(6, 2'000, 20, 50, 2'000), "illegal transitions").position.illegal > 10);
}

struct Recording {
  const char* file;
  const char* probes;
  std::int64_t steps, illegal, reversals;
};

void replay_mouse(const Recording& expected) {
  const fs::path file = recordings() / "sigrok-mouse" / expected.file;
  if (!there(file)) return;
  traces::Options how;
  how.probes = traces::split_names(expected.probes);
  const RunResult r = recorded(std::string(expected.file) + " " + expected.probes, file, how);
  CHECK(r.position.steps == expected.steps);
  CHECK(r.position.illegal == expected.illegal);
  CHECK(r.position.reversals == expected.reversals);
}

TEST_CASE("recording: mouse fast, Y", "[mouse-fast-y]") {
  replay_mouse({"avago_adns_2051_move_mouse_fast.sr", "YA,YB", 4154, 0, 72});
}
TEST_CASE("recording: mouse fast, X", "[mouse-fast-x]") {
  replay_mouse({"avago_adns_2051_move_mouse_fast.sr", "XA,XB", 560, 0, 73});
}
TEST_CASE("recording: mouse up and down, Y", "[mouse-up-down]") {
  replay_mouse({"avago_adns_2051_move_mouse_up_down.sr", "YA,YB", 629, 0, 5});
}
TEST_CASE("recording: mouse sleeps, then moves, Y", "[mouse-sleep]") {
  replay_mouse({"avago_adns_2051_sleep_then_move.sr", "YA,YB", 99, 0, 1});
}
TEST_CASE("recording: mouse unplugged, X", "[mouse-usb-x]") {
  replay_mouse({"avago_adns_2051_remove_and_readd_usb.sr", "XA,XB", 3, 1, 0});
}
TEST_CASE("recording: mouse unplugged, Y", "[mouse-usb-y]") {
  replay_mouse({"avago_adns_2051_remove_and_readd_usb.sr", "YA,YB", 3, 1, 0});
}

TEST_CASE("recording: stepper axis X", "[stepper]") {
  const fs::path file = recordings() / "stepdir/smoothieware.sr";
  if (!there(file)) return;
  traces::Options how;
  how.step = "5";
  how.dir = "6";
  CHECK(recorded("smoothieware.sr", file, how).position.steps == 32000);
}

TEST_CASE("recording: QUBE", "[qube]") {
  const fs::path file = recordings() / "qube/qube_20230828T150615_434_696_394.csv";
  if (!there(file)) return;
  traces::Options how;
  how.time_column = "t";
  how.count_column = "theta";
  how.scale = 2048 / (2 * 3.14159265358979323846);
  const RunResult r = recorded("qube", file, how);
  CHECK(r.position.steps == 6586);
  CHECK(r.position.reversals == 99);
}
