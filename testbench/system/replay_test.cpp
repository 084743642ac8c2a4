// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Encoder traces through the whole core, RTL and twin in lock-step, double and quad beside:
// synthetic ones here, recordings where they lie. Documentation: docs/testing.md, docs/traces.md
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "catch.hpp"
#include "loop/replay.hpp"
#include "traces/open.hpp"
#include "traces/statistics.hpp"
#include "traces/synthetic.hpp"

namespace {

namespace fs = std::filesystem;
namespace synthetic = feltgate::traces::synthetic;
using namespace feltgate;

/// Replays and checks what every trace must fulfil: no mismatch, and the core's own position is the
/// one that an independent count finds.
RunResult replayed(EncoderSource& source, const std::string& name, Clock most_clocks = 0) {
  ReplayOptions options;
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
  std::cout << name << ": " << r.clocks << " clocks in lock-step, " << r.mismatches
            << " mismatches\n";
  return r;
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
  const double count_rad = 2 * 3.14159265358979 / 4096;
  for (const double rad_s : {0.1, 1.0, 10.0, 100.0, 600.0, -600.0}) {
    const double counts_per_s = rad_s / count_rad;
    // A fifth of a second each, a few counts at least.
    const auto counts = static_cast<std::int64_t>(std::fmax(4.0, std::fabs(counts_per_s) * 0.1));
    auto s = synthetic::constant_speed(counts_per_s, counts);
    replayed(*s, "constant speed " + std::to_string(rad_s) + " rad/s", 5'000'000);
  }
  auto reversals = synthetic::reversals(40, 7, 900);
  CHECK(replayed(*reversals, "reversals at every phase").position.reversals > 40);
  auto dither = synthetic::dither(400, 9'650);
  replayed(*dither, "dither on one edge");
  auto chirp = synthetic::chirp(300, 1.0, 200.0, 0.1);
  replayed(*chirp, "chirp");
  auto slow = synthetic::one_count_per_second(2);
  replayed(*slow, "one count per second", 3'000'000);
  auto steps = synthetic::steps(20, 50, 300, 60'000);
  replayed(*steps, "steps");
  auto walk = synthetic::random_walk(5, 20'000, 20, 400);
  replayed(*walk, "random walk");
  auto illegal = synthetic::illegal(6, 2'000, 20, 50, 2'000);
  CHECK(replayed(*illegal, "illegal transitions").position.illegal > 10);
  auto fast = synthetic::fast_run(140'000, 1, 1);
  replayed(*fast, "one state per clock, past the wrap of 16 bits");
}

// One test case per recording, so that they run side by side. The table of the recordings' page.
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
  const auto source = traces::open(file, how);
  const RunResult r = replayed(*source, std::string(expected.file) + " " + expected.probes);
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
  const auto source = traces::open(file, how);
  CHECK(replayed(*source, "smoothieware.sr").position.steps == 32000);
}

TEST_CASE("recording: QUBE", "[qube]") {
  const fs::path file = recordings() / "qube/qube_20230828T150615_434_696_394.csv";
  if (!there(file)) return;
  traces::Options how;
  how.time_column = "t";
  how.count_column = "theta";
  how.scale = 2048 / (2 * 3.14159265358979323846);
  const auto source = traces::open(file, how);
  const RunResult r = replayed(*source, "qube");
  CHECK(r.position.steps == 6586);
  CHECK(r.position.reversals == 99);
}
