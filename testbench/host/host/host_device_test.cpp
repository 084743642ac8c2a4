// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Units, arming, capture and encoder traces of the host, against a software board.
#include "catch.hpp"

#include <cmath>
#include <string>

#include "board_on_pipe.hpp"
#include "feltgate/device.hpp"
#include "feltgate/generated/lever.hpp"
#include "host/capture.hpp"
#include "host/host_device.hpp"
#include "sim/traces/options.hpp"
#include "twins.hpp"

namespace {

using namespace feltgate;
using test::BoardOnPipe;

const design::Elaborated& lever() {
  static const host::KnownDesign known =
      host::read_known_design(FELTGATE_ROOT, FELTGATE_ROOT "/rtl/designs/lever.toml");
  return known.design;
}

struct OnBoard : BoardOnPipe {
  host::Device device{link, host::read_board(link), lever()};
};

std::string told(const std::function<void()>& run) {
  try {
    run();
    return "nothing";
  } catch (const std::exception& e) {
    return e.what();
  }
}

}  // namespace

TEST_CASE("host device: the board says what it is, and its design is found by its CRC") {
  OnBoard b;
  const host::BoardInfo& i = b.device.board();
  CHECK(i.simulated);
  CHECK(i.tick_hz() == 1e6);
  CHECK(i.capture_rows == 1024);
  CHECK(i.capture_columns == 8);
  CHECK(i.design_crc == Lever::design_crc);
  const auto found = host::design_by_crc(FELTGATE_ROOT, i.design_crc);
  REQUIRE(found);
  CHECK(found->name() == "lever");
  CHECK_FALSE(host::design_by_crc(FELTGATE_ROOT, 1));
  b.board.set_design_crc(1);
  CHECK(host::read_board(b.link).design_crc == 1);
}

TEST_CASE("host device: every parameter reads as the design's value") {
  OnBoard b;
  for (const ParameterInfo& p : Lever::parameters) {
    INFO(p.name);
    CHECK(b.device.get(p.name) == std::ldexp(static_cast<double>(p.raw), -p.format.fraction));
  }
}

TEST_CASE("host device: values are set in units") {
  OnBoard b;
  const auto set = [&](const std::string& text) {
    return b.device.set(b.device.quantities().setting(text));
  };
  CHECK(set("torque_limit=0.25").kept);
  CHECK(b.device.get("torque_limit") == 0.25);
  CHECK(set("torque_limit=0.1 Nm").setting.value() == Approx(0.1).margin(1e-5));
  CHECK(set("wall_contact=0.2rad").kept);
  CHECK(b.device.get("wall_contact") == Approx(0.2 / Lever::count_rad).margin(0.003));
  CHECK(set("wall_contact=-10deg").kept);
  CHECK(b.device.get("wall_contact") ==
        Approx(-10 * 3.14159265 / 180 / Lever::count_rad).margin(0.003));
  CHECK(set("watchdog_ticks=50ms").kept);
  CHECK(b.device.get("watchdog_ticks") == 50000);
  CHECK(b.device.watchdog_s() == Approx(0.05));
  CHECK(set("wall_stiffness=2Nm/rad").setting.value() ==
        Approx(2 * Lever::count_rad).epsilon(1e-3));
  CHECK(set("wall_stiffness=0.1Nm/deg").setting.value() ==
        Approx(0.1 * 180 / 3.14159265 * Lever::count_rad).epsilon(1e-4));
  CHECK(set("torque_limit=200mNm").setting.value() == Approx(0.2).margin(1e-5));
  const std::size_t before = b.board.writes().size();
  CHECK(told([&] { set("torque_limt=0.1"); }).find("did you mean \"torque_limit\"?") !=
        std::string::npos);
  CHECK(told([&] { set("torque_limit=20"); }).find("choose a value from -16 to 16") !=
        std::string::npos);
  CHECK(told([&] { set("torque_limit=nan"); }).find("is no number") != std::string::npos);
  CHECK(told([&] { set("torque_limit=1V"); }).find("1V is not in Nm; give it in Nm") !=
        std::string::npos);
  CHECK(told([&] { set("torque_limit"); }).find("NAME=VALUE") != std::string::npos);
  CHECK(told([&] { set("velocity=1"); }).find("can only be read") != std::string::npos);
  CHECK(b.board.writes().size() == before);
}

TEST_CASE("host device: arming, holding, faults, and what an armed motor refuses") {
  OnBoard b;
  b.device.arm("wall", true);
  CHECK(b.board.armed());
  CHECK(b.board.kicks() >= 1);
  CHECK(b.device.scene_name(b.device.tick()) == "wall");
  CHECK(b.device.set("voltage_gain", 0.3).refused);
  CHECK_FALSE(b.device.set("torque_limit", 0.3).refused);
  b.device.select("damper");
  CHECK(b.board.armed());
  CHECK(b.device.scene_name(b.device.tick()) == "damper");
  b.device.disarm();
  CHECK_FALSE(b.board.armed());
  CHECK(told([&] { b.device.arm("wal", false); }).find("did you mean \"wall\"?") !=
        std::string::npos);
  b.device.arm("", false);
  b.device.stop();
  CHECK_FALSE(b.board.armed());
  const host::Tick t = b.device.tick();
  CHECK(b.device.fault_names(t) == "stop");
  CHECK(b.device.first_fault(t) == "stop");
  CHECK(told([&] { b.device.arm("", false); }).find("fault stop is latched") != std::string::npos);
  b.device.clear_faults();
  CHECK(b.device.fault_names(b.device.tick()).empty());
  b.device.arm("", false);
  CHECK(b.board.armed());
}

TEST_CASE("host device: the words of a tick are of one tick") {
  OnBoard b;
  for (int n = 0; n < 20; ++n) {
    const host::Tick t = b.device.tick();
    const std::uint32_t tick = t.word(b.device.quantities().find("tick"));
    CHECK(t.word(b.device.quantities().find("position")) == b.board.snapshot(1, tick));
    CHECK(t.word(b.device.quantities().find("velocity")) == b.board.snapshot(3, tick));
    CHECK(t.value(b.device.quantities().find("angle")) ==
          Lever::count_rad * static_cast<std::int32_t>(b.board.snapshot(1, tick)));
  }
}

TEST_CASE("host device: a stream in units, over the wrap of its frame counter") {
  OnBoard b;
  b.device.stream(host::mask_of(b.device.quantities(), {"velocity"}), 1000);
  double last = -1;
  unsigned lost = 0;
  for (int n = 0; n < 300; ++n) {
    const auto t = b.device.streamed(host::within(1));
    REQUIRE(t);
    CHECK(t->time_s > last);
    last = t->time_s;
    lost += t->lost;
    const std::uint32_t tick = t->word(b.device.quantities().find("tick"));
    CHECK(t->word(b.device.quantities().find("velocity")) == b.board.snapshot(3, tick));
  }
  CHECK(last == Approx(0.299 + 1e-3 * lost));
  b.device.stream(0, 0);
}

TEST_CASE("host device: a capture is triggered in units, and brings each row") {
  OnBoard b;
  host::CaptureSetup s;
  s.quantities = {"angle", "velocity", "tick"};
  s.rows_before = 200;
  s.period = 20;
  s.trigger = host::parse_trigger(b.device, nullptr, "angle>0.1rad");
  host::start_capture(b.device, s);
  const auto end = host::within(5);
  while (host::capture_state(b.device) != 4) REQUIRE(host::HostClock::now() < end);
  const host::Captured c = host::read_capture(b.device, s);
  REQUIRE(c.rows.size() == 1024);
  CHECK(c.trigger_row == 200);
  CHECK(c.simulated);
  const host::Quantity &angle = *c.columns[0], &tick = *c.columns[2];
  CHECK(c.rows[200].value(angle) >= 0.0995);
  CHECK(c.rows[199].value(angle) <= c.rows[200].value(angle));
  CHECK(c.rows[200].time_s == 0.0);
  CHECK(c.rows[0].time_s == Approx(-200 * 20e-6));
  for (std::size_t n = 1; n < c.rows.size(); ++n) {
    REQUIRE(c.rows[n].word(tick) - c.rows[n - 1].word(tick) == 20);
    REQUIRE(c.rows[n].word(angle) == b.board.snapshot(1, c.rows[n].word(tick)));
  }
}

TEST_CASE("host device: what a capture cannot do is said before it starts") {
  OnBoard b;
  host::CaptureSetup s;
  s.quantities = {"status",  "position", "tick",   "velocity", "index",
                  "encoder", "tau_hat",  "faults", "tau_ref"};
  CHECK(told([&] { host::start_capture(b.device, s); }).find("9 words are asked for") !=
        std::string::npos);
  s.quantities = {"torque_limit"};
  CHECK(told([&] { host::start_capture(b.device, s); }).find("is no word of a tick") !=
        std::string::npos);
  const auto trigger = [&](const char* text) {
    return told([&] { host::parse_trigger(b.device, nullptr, text); });
  };
  CHECK(trigger("velocty>5").find("did you mean \"velocity\"?") != std::string::npos);
  CHECK(trigger("velocity>5V").find("give it in rad/s") != std::string::npos);
  CHECK(trigger("fault:spead").find("did you mean \"speed\"?") != std::string::npos);
  CHECK(trigger("status>5").find("made of bits") != std::string::npos);
  CHECK(trigger("sometime").find("is no trigger") != std::string::npos);
  CHECK(trigger("event:hit").find("has no engine") != std::string::npos);
  CHECK(host::parse_trigger(b.device, nullptr, "fault:speed,stop").level == (1u << 2 | 1u << 6));
  CHECK(host::parse_trigger(b.device, nullptr, "limit:current").level == 1u << 2);
}

TEST_CASE("host device: positions become edges that give the core the same positions") {
  SplitMix64 random(5);
  for (const std::int64_t period : {1, 1, 7, 200}) {
    std::vector<host::PositionAt> positions{
        {0, static_cast<std::int32_t>(random.below(1000)) - 500}};
    for (int n = 1; n < 400; ++n) {
      const std::int64_t most = period == 1 ? 37 : 60;  // about one edge per clock
      positions.push_back(
          {n * period,
           positions.back().count + static_cast<std::int32_t>(random.below(2 * most + 1) - most)});
    }
    host::PositionEncoder encoder(lever().design, positions);
    std::vector<EncoderEvent> events;
    while (const auto e = encoder.next()) events.push_back(*e);
    TwinDevice twin{design_info<Lever>()};
    twin.clock(encoder.initial());  // the first sample is the reference
    std::size_t given = 0, row = 0;
    Clock now = 1;
    for (std::int64_t tick = 0; tick <= positions.back().tick; ++tick) {
      std::vector<EncoderEvent> of_tick;
      const Clock end = (tick + 1) * Lever::clocks_per_tick;
      while (given < events.size() && events[given].clock <= end)
        of_tick.push_back(events[given++]);
      twin.run(end - now, of_tick);
      now = end;
      if (tick != positions[row].tick) continue;
      REQUIRE(std::lround(twin.reading().angle_rad / Lever::count_rad) ==
              positions[row].count - positions[0].count);
      ++row;
    }
    CHECK(row == positions.size());
    CHECK(encoder.length() == now);
  }
  CHECK(told([] {
          host::PositionEncoder e(lever().design, {{0, 0}, {1, 60}});
        }).find("more than a decoder sees") != std::string::npos);
}
