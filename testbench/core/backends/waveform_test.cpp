// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A waveform as its reader sees it: the first clocks are there, and clock n is at n periods of the
// design's clock. Documentation: docs/testing.md
#include <gtkwave/fstapi.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "Vcore_lever.h"
#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "sim/backends/backend.hpp"
#include "sim/backends/rtl_core.hpp"

namespace {

using namespace feltgate;

struct Change {
  std::uint64_t time;
  std::string value;
  bool operator==(const Change& o) const { return time == o.time && value == o.value; }
};

/// The ports of the core in an FST file, every change of each.
class Waveform {
 public:
  explicit Waveform(const std::string& path) : reader_(fstReaderOpen(path.c_str())) {
    REQUIRE(reader_ != nullptr);
    exponent = fstReaderGetTimescale(reader_);
    int depth = 0;
    while (const fstHier* h = fstReaderIterateHier(reader_)) {
      if (h->htyp == FST_HT_SCOPE) ++depth;
      if (h->htyp == FST_HT_UPSCOPE) --depth;
      if (h->htyp == FST_HT_VAR && depth == 1) names_[h->u.var.handle] = h->u.var.name;
    }
    fstReaderSetFacProcessMaskAll(reader_);
    fstReaderIterBlocks(reader_, &note, this, nullptr);
    fstReaderClose(reader_);
  }
  std::map<std::string, std::vector<Change>> changes;
  int exponent = 0;

 private:
  static void note(void* self, uint64_t time, fstHandle signal, const unsigned char* value) {
    auto* waveform = static_cast<Waveform*>(self);
    const auto name = waveform->names_.find(signal);
    if (name == waveform->names_.end()) return;
    const std::string text = reinterpret_cast<const char*>(value);
    waveform->changes[name->second].push_back({time, text});
  }
  void* reader_;
  std::map<fstHandle, std::string> names_;
};

std::string new_file(const char* name) {
  const auto path = std::filesystem::path(FELTGATE_BUILD_DIR) / name;
  std::filesystem::remove(path);
  return path.string();
}

/// The clocks [from, to]: low at n periods, high half of one later, to the nearest picosecond.
void check_clocks(const Waveform& w, double clock_hz, std::uint64_t from, std::uint64_t to) {
  CHECK(w.exponent == -12);
  std::vector<Change> expected;
  const auto ps = [clock_hz](double clocks) {
    return static_cast<std::uint64_t>(clocks * 1e12 / clock_hz + 0.5);
  };
  for (std::uint64_t n = from; n <= to; ++n) {
    expected.push_back({ps(static_cast<double>(n)), "0"});
    expected.push_back({ps(static_cast<double>(n) + 0.5), "1"});
  }
  REQUIRE(w.changes.count("clk_i") == 1);
  CHECK(w.changes.at("clk_i") == expected);
  CHECK(w.changes.at("rst_ni") == std::vector<Change>{{expected.front().time, "1"}});
}

}  // namespace

TEST_CASE("every clock of a run is in the waveform, from the first on") {
  for (const char* kind : {"rtl", "lockstep"}) {
    const std::string path = new_file("waveform_test.fst");
    {
      const auto engine = make_backend("lever", kind);
      engine->trace(path, 0, -1);
      engine->reset(1, {});
      const EncoderEvent events[] = {{0, {true, false, false}}, {2, {false, false, false}}};
      engine->advance(120, events, events + 2);
      engine->advance(3, nullptr, nullptr);
    }
    const Waveform w(path);
    check_clocks(w, 50e6, 0, 122);
    CHECK(w.changes.at("enc_a_i") == std::vector<Change>{{0, "1"}, {40'000, "0"}});
  }
}

TEST_CASE("a window of clocks, some of them before the first") {
  for (const auto& [from, to] : {std::pair<Clock, Clock>{-150, 20}, {100, 140}}) {
    const std::string path = new_file("waveform_test.fst");
    {
      const auto engine = make_backend("lever", "rtl");
      engine->trace(path, from, to);
      engine->reset(1, {});
      engine->advance(200, nullptr, nullptr);
    }
    check_clocks(Waveform(path), 50e6, from < 0 ? 0 : 100, static_cast<std::uint64_t>(to));
  }
}

TEST_CASE("the time axis is that of the design's clock") {
  const std::string path = new_file("waveform_test.fst");
  {
    axis::Design design = design_of<Lever>();
    design.constants["CLOCK_HZ"] = 48'000'000;
    RtlCore<Vcore_lever> core(design);
    core.trace(path, 0, -1);
    core.power_up(1, {});
    for (int k = 0; k < 1000; ++k) core.clock({});
  }
  check_clocks(Waveform(path), 48e6, 0, 999);
}

TEST_CASE("a waveform that cannot be written is an error") {
  const auto engine = make_backend("lever", "rtl");
  engine->trace(new_file("no_such_folder") + "/w.fst", 0, -1);
  engine->reset(1, {});
  CHECK_THROWS_AS(engine->advance(1, nullptr, nullptr), std::runtime_error);
}
