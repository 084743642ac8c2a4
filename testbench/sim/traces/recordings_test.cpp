// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The public recordings, whole, against the table of what a correct x4 decoder must find. They are
// looked for in FELTGATE_TRACES or ../shared/traces. Documentation: docs/traces.md
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "catch.hpp"
#include "recording_files.hpp"
#include "sim/traces/capture.hpp"

using namespace feltgate;
using namespace feltgate::traces;

namespace {

/// The folder of the recordings; empty, after the line by which CTest knows a skipped test, when
/// there is none.
std::filesystem::path recordings() {
  const char* const named = std::getenv("FELTGATE_TRACES");
  std::filesystem::path folder = named != nullptr
                                     ? std::filesystem::path(named)
                                     : std::filesystem::path(FELTGATE_ROOT) / "../shared/traces";
  if (std::filesystem::is_directory(folder)) return folder;
  std::cout << "SKIPPED: no recordings in " << folder.string() << "; set FELTGATE_TRACES\n";
  return {};
}

struct Row {
  const char* file;
  std::vector<std::string> probes;
  std::int64_t steps;
  std::int64_t illegal;
  std::int64_t reversals;
  Clock spacing_us;
};

const std::vector<Row> kMouse = {{"move_mouse_fast", {"YA", "YB"}, 4154, 0, 72, 134},
                                 {"move_mouse_fast", {"XA", "XB"}, 560, 0, 73, 1363},
                                 {"move_mouse_up_down", {"YA", "YB"}, 629, 0, 5, 1359},
                                 {"sleep_then_move", {"YA", "YB"}, 99, 0, 1, 945},
                                 {"remove_and_readd_usb", {"XA", "XB"}, 3, 1, 0, 118},
                                 {"remove_and_readd_usb", {"YA", "YB"}, 3, 1, 0, 14471}};

Statistics count(const std::filesystem::path& file, const Options& options) {
  const auto source = traces::open(file, options);
  return count_steps(*source);
}

/// Memory of this process that is in RAM now.
std::int64_t resident_bytes() {
  std::int64_t all = 0;
  std::int64_t resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

/// Plain hold, and jitter with three seeds.
std::vector<Options> modes(Options options) {
  std::vector<Options> all;
  options.jitter = false;
  all.push_back(options);
  options.jitter = true;
  for (const std::uint64_t seed : {1U, 2U, 12345U}) {
    options.seed = seed;
    all.push_back(options);
  }
  return all;
}

}  // namespace

TEST_CASE("the mouse recordings give their table", "[mouse]") {
  const auto folder = recordings();
  if (folder.empty()) return;
  for (const Row& row : kMouse) {
    Options base;
    base.probes = row.probes;
    for (const Options& options : modes(base)) {
      CAPTURE(row.file, row.probes[0], options.jitter, options.seed);
      const auto file =
          folder / "sigrok-mouse" / (std::string("avago_adns_2051_") + row.file + ".sr");
      const Statistics found = count(file, options);
      CHECK(found.steps == row.steps);
      CHECK(found.illegal == row.illegal);
      CHECK(found.reversals == row.reversals);
      REQUIRE(found.shortest_edge_spacing);
      if (options.jitter) {
        CHECK(std::llabs(*found.shortest_edge_spacing - row.spacing_us * 50) < 100);
      } else {
        CHECK(*found.shortest_edge_spacing == row.spacing_us * 50);
      }
      CHECK(found.length % 50'000'000 == 0);
    }
  }
}

TEST_CASE("both axes of the motion controller go out and back", "[stepper]") {
  const auto folder = recordings();
  if (folder.empty()) return;
  for (const auto& [step, dir] : {std::pair("3", "4"), std::pair("5", "6")}) {
    Options base;
    base.step = step;
    base.dir = dir;
    for (const Options& options : modes(base)) {
      CAPTURE(step, options.jitter, options.seed);
      const Statistics found = count(folder / "stepdir" / "smoothieware.sr", options);
      CHECK(found.steps == 32'000);
      CHECK(found.illegal == 0);
      CHECK(found.reversals == 1);
      CHECK(found.position == 0);
      CHECK(found.length == 416'666'667);  // 100 000 000 samples at 12 MHz
    }
  }
}

TEST_CASE("memory does not grow with the length of a recording", "[memory]") {
  const auto folder = recordings();
  if (folder.empty()) return;
  Options options;
  options.step = "3";
  options.dir = "4";
  const std::int64_t before = resident_bytes();
  const auto source = traces::open(folder / "stepdir" / "smoothieware.sr", options);
  std::int64_t most = 0;
  for (int i = 0; source->next(); ++i) {
    if (i % 1000 == 0) most = std::max(most, resident_bytes());
  }
  // 100 MB of samples went by.
  CHECK(most - before < 20'000'000);
}

TEST_CASE("the QUBE recording gives its table", "[qube]") {
  const auto folder = recordings();
  if (folder.empty()) return;
  Options base;
  base.count_column = "theta";
  base.scale = parse_scale("2048/2pi");
  for (const Options& options : modes(base)) {
    CAPTURE(options.jitter, options.seed);
    const Statistics found =
        count(folder / "qube" / "qube_20230828T150615_434_696_394.csv", options);
    CHECK(found.steps == 6586);
    CHECK(found.illegal == 0);
    CHECK(found.reversals == 99);
    CHECK(found.position == 248);
    CHECK(found.length == 999'900'001);  // 19.998 s and the clock of the last row
  }
}
