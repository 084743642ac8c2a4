// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the host of a scene writes, and when, on an engine that only notes it.
// Documentation: docs/architecture.md
#include <memory>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "feltgate/axes_ports.hpp"
#include "sim/loop/session.hpp"

namespace {

using namespace feltgate;

using Writes = std::vector<std::pair<int, std::uint32_t>>;

class Notes : public AnyBackend {
 public:
  explicit Notes(int axes) : axes_(axes) {}
  const char* name() const override { return "notes"; }
  const DesignInfo& design() const override { return design_; }
  int axes() const override { return axes_; }
  void write(int address, std::uint32_t data) override { writes.emplace_back(address, data); }
  void stop(bool pressed) override { stopped = pressed; }
  Clock now() const override { return 0; }

  Writes writes;
  bool stopped = false;

 private:
  int axes_;
  DesignInfo design_ = design_named("lever");
};

struct Stand {
  explicit Stand(const Scenario& of, int axes = 1)
      : scenario(of), host(std::make_unique<Notes>(axes)), session(scenario, host, options) {
    session.begin();
  }
  Notes& notes() { return static_cast<Notes&>(host.backend()); }
  /// The writes of the host up to a time, each with the clock at which it came.
  std::vector<std::pair<Clock, std::uint32_t>> until(double seconds) {
    std::vector<std::pair<Clock, std::uint32_t>> all;
    while (session.next() <= session.clock_of(seconds)) {
      const Clock now = session.next();
      notes().writes.clear();
      session.act(now, 0, 0, [](const Event&) {});
      for (const auto& w : notes().writes) all.emplace_back(now, w.second);
    }
    return all;
  }

  Scenario scenario;
  SessionOptions options;
  RunHost host;
  Session session;
};

Scenario scene() {
  Scenario s;
  s.duration_s = 1;
  s.arm_s = 0.25;
  return s;
}

Event at(double seconds) {
  Event e;
  e.at_s = seconds;
  return e;
}

}  // namespace

TEST_CASE("a host arms at arm_s and applies events in order") {
  Scenario s = scene();
  s.events = {at(0.125), at(0.5), at(0.5)};
  s.events[0].stop = true;
  s.events[1].scene = "wall";
  s.events[2].mode = 1;
  Stand stand(s);
  const DesignInfo& d = stand.host.design();
  const int free = d.scene_number("free"), wall = d.scene_number("wall");
  CHECK(stand.notes().writes == Writes{{d.control_address, control_word(d, free, 0, false)}});
  CHECK(stand.until(0.2).empty());
  CHECK(stand.notes().stopped);
  const Clock quarter = d.clock_hz / 4;
  CHECK(stand.until(1) == std::vector<std::pair<Clock, std::uint32_t>>{
                              {quarter, control_word(d, free, 0, true)},
                              {2 * quarter, control_word(d, wall, 0, true)},
                              {2 * quarter, control_word(d, wall, 1, true)}});
}

TEST_CASE("a scene that an event arms before arm_s is not armed again") {
  Scenario s = scene();
  s.events = {at(0.125), at(0.5)};
  s.events[0].arm = true;
  s.events[1].arm = false;
  Stand stand(s);
  const DesignInfo& d = stand.host.design();
  const int free = d.scene_number("free");
  CHECK(stand.until(1) == std::vector<std::pair<Clock, std::uint32_t>>{
                              {d.clock_hz / 8, control_word(d, free, 0, true)},
                              {d.clock_hz / 2, control_word(d, free, 0, false)}});
}

TEST_CASE("a host writes the words of a core to every axis") {
  Stand stand(scene(), 3);
  const int address = stand.host.design().control_address;
  REQUIRE(stand.notes().writes.size() == 3);
  for (int n = 0; n < 3; ++n) {
    CHECK(stand.notes().writes[static_cast<std::size_t>(n)].first == n * axes_stride + address);
  }
}
