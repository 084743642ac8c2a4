// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The host's library and a board with two axes (the twin): names by axis, arming, one frame and one
// capture of both axes, a stop at either, and updates of a mailbox at the full rate of the line.
#include <cstdio>

#include "catch.hpp"
#include "feltgate/generated/pantograph_law.hpp"
#include "host/law_engine.hpp"
#include "law_on_board.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using D = PantographLaw;
const double pen_count_rad = design_info<D>().count_rad;

law::Image compiled_axes(const std::string& text) {
  return law::compile_text(text, "test", design::law_target(elaborated<D>())).image;
}

/// A spring at each joint.
const law::Image& springs() {
  static const law::Image image = compiled_axes(
      "param stiffness = 0.25 Nm/rad in 0 .. 1 Nm/rad\n"
      "event beyond(position[1]) when position[1] > 0.05\n"
      "out torque[0] = -stiffness * position[0]\n"
      "out torque[1] = -2 * stiffness * position[1]\n");
  return image;
}

struct Pantograph {
  std::unique_ptr<BoardInProcess<D, 2>> wire = std::make_unique<BoardInProcess<D, 2>>();
  host::Link link{*wire};
  host::Device device{link, host::read_board(link), elaborated<D>()};
  host::LawEngine engine{device};

  const CoreOut& out(std::size_t n) const { return wire->board.out().axis[n]; }
  void settle() { wire->run(std::int64_t{60} * D::clocks_per_tick); }
  /// Meanwhile the board's time goes on.
  void ask() {
    device.arm("law", false, [this] {
      wire->run(100'000);
      return true;
    });
  }
  void arm() {
    for (const char* name : {"self_test_pulse", "self_test_pulse.1"}) device.set(name, 0);
    for (const char* name : {"ramp_step", "ramp_step.1"}) {
      device.set(name, device.quantities().find(name).high());
    }
    ask();
    settle();
  }
};

}  // namespace

TEST_CASE("host axes: names, and a clear word about an axis that is not there") {
  Pantograph b;
  CHECK(b.device.axes() == 2);
  for (int k = 0; k < 12; ++k) b.wire->step(true, 0);
  for (int k = 0; k < 7; ++k) b.wire->step(false, 1);
  CHECK(b.device.get("position") == 12);
  CHECK(b.device.get("position.0") == 12);
  CHECK(b.device.get("position.1") == -7);
  CHECK(std::abs(b.device.get("angle.1") + 7 * pen_count_rad) < 1e-9);
  CHECK(told([&] { (void)b.device.get("position.2"); }) ==
        "\"position.2\": there is no axis 2; this board has the axes 0 to 1");
  CHECK(told([&] { (void)b.device.quantities().streamed("angle.7"); }) ==
        "\"angle.7\": there is no axis 7; this board has the axes 0 to 1");
  CHECK(b.device.set("torque_limit.1", 0.1).kept);
  CHECK(b.device.get("torque_limit.1") < 0.11);
  CHECK(b.device.get("torque_limit") > 0.11);
  // A whole tick has the words of both.
  const host::Tick tick = b.device.tick();
  CHECK(tick.value(b.device.quantities().find("position")) == 12);
  CHECK(tick.value(b.device.quantities().find("position.1")) == -7);
}

TEST_CASE("host axes: a law is loaded, armed and felt at both axes; streamed and captured") {
  Pantograph b;
  b.engine.load(springs());
  b.arm();
  REQUIRE(b.out(0).armed);
  REQUIRE(b.out(1).armed);
  for (int k = 0; k < 30; ++k) b.wire->step(true, 0);
  for (int k = 0; k < 10; ++k) b.wire->step(false, 1);
  b.settle();
  const auto& q = b.device.quantities();
  const auto mask = host::mask_of(q, {"angle", "tau_ref.1", "angle.1", "tau_ref"});
  b.device.stream(mask, 10'000);  // longer than a read waits
  const auto frame = b.device.streamed(host::within(5));
  b.device.stream(0, 0);
  REQUIRE(frame);
  const auto seen = [&](const char* name) { return frame->value(q.find(name)); };
  CHECK(std::abs(seen("angle") - 30 * pen_count_rad) < 1e-9);
  CHECK(std::abs(seen("angle.1") + 10 * pen_count_rad) < 1e-9);
  CHECK(std::abs(seen("tau_ref") + 0.25 * 30 * pen_count_rad) < 3e-4);
  CHECK(std::abs(seen("tau_ref.1") - 0.5 * 10 * pen_count_rad) < 3e-4);
  CHECK(frame->has(q.find("tick")));
  CHECK_FALSE(frame->has(q.find("voltage.1")));
  std::vector<std::string> many;
  for (const char* name : {"status", "position", "velocity", "tau_hat", "tau_ref", "voltage"}) {
    many.push_back(name);
    many.push_back(std::string(name) + ".1");
  }
  CHECK(told([&] { b.device.show(host::mask_of(q, many)); }).find("leave some out") !=
        std::string::npos);

  // A capture that axis 1 triggers.
  host::CaptureSetup setup;
  setup.quantities = {"tick", "position.1", "position"};
  setup.rows_before = 4;
  setup.trigger = host::parse_trigger(b.device, &b.engine, "angle.1>0.02");
  host::start_capture(b.device, setup);
  for (int k = 0; k < 40; ++k) b.wire->step(true, 1);
  b.wire->run(std::int64_t{1200} * D::clocks_per_tick);
  REQUIRE(host::capture_state(b.device) == 4);
  const host::Captured c = host::read_capture(b.device, setup);
  REQUIRE(c.rows.size() == 1024);
  const auto at = [&](int row, const char* name) {
    return c.rows[static_cast<std::size_t>(row)].value(q.find(name));
  };
  // 0.02 rad are 13.04 counts; the level is rounded to a count.
  CHECK(at(c.trigger_row, "position.1") == 13);
  CHECK(at(c.trigger_row - 1, "position.1") == 12);
  CHECK(at(c.trigger_row, "position") == 30);
  CHECK(at(c.trigger_row, "tick") - at(c.trigger_row - 1, "tick") == 1);

  b.device.disarm();
  b.settle();
  CHECK_FALSE(b.out(0).gates_enable);
  CHECK_FALSE(b.out(1).gates_enable);
}

TEST_CASE("host axes: a fault of either axis stops both, is told with its axis, and is cleared") {
  for (const int axis : {0, 1}) {
    Pantograph b;
    b.engine.load(springs());
    b.arm();
    REQUIRE(b.out(1).armed);
    b.device.set("overspeed" + host::Quantities::suffix(axis), 0);
    for (int k = 0; k < 40; ++k) b.wire->step(true, static_cast<std::size_t>(axis));
    b.settle();
    CHECK_FALSE(b.out(0).gates_enable);
    CHECK_FALSE(b.out(1).gates_enable);
    const host::Tick tick = b.device.tick();
    CHECK(b.device.first_fault(tick) == "speed");
    CHECK(b.device.fault_names(tick).find(axis == 0 ? "speed of axis 0" : "speed of axis 1") !=
          std::string::npos);
    b.device.set("overspeed" + host::Quantities::suffix(axis), 100);
    b.wire->run(std::int64_t{10'000} * D::clocks_per_tick);
    b.device.clear_faults();
    CHECK(b.device.fault_names(b.device.tick()).empty());
    b.ask();
    CHECK(b.out(axis == 0 ? 1 : 0).armed);
  }
}

TEST_CASE("host axes: mailbox updates of 64 bytes at 3 Mbaud; lost and late ones are counted") {
  std::string text;
  for (int k = 0; k < 16; ++k) {
    text += fmt::format("mailbox m{} = 0 Nm in -0.01 .. 0.01 Nm max_age 40 ms\n", k);
  }
  const char* sum = "m{} + m{} + m{} + m{} + m{} + m{} + m{} + m{}\n";
  text += "out torque[0] = " + fmt::format(sum, 0, 1, 2, 3, 4, 5, 6, 7);
  text += "out torque[1] = " + fmt::format(sum, 8, 9, 10, 11, 12, 13, 14, 15);
  const law::Image image = compiled_axes(text);
  Pantograph b;
  b.engine.load(image);
  b.arm();
  const auto values = [](double each) {
    std::map<std::string, double> all;
    for (int k = 0; k < 16; ++k) all[fmt::format("m{}", k)] = k < 8 ? each : -each / 2;
    return all;
  };
  host::MailboxBurst burst(b.device, b.engine);
  constexpr int updates = 100;
  const std::int64_t from = b.wire->now;
  for (int k = 0; k <= updates; ++k) REQUIRE(burst.send(values(0.005 * k / updates)));
  while (b.wire->board.unsent() > 0) b.wire->run(100);
  const double seconds = static_cast<double>(b.wire->now - from) / D::clock_hz;
  std::printf("%.0f updates of 64 bytes a second at 3 Mbaud\n", updates / seconds);
  CHECK(updates / seconds > 1000);
  CHECK(burst.check().sent == updates + 1);
  CHECK(burst.counts().lost_frames == 0);
  CHECK(burst.counts().dropped == 0);
  CHECK(burst.counts().late == 0);
  b.settle();
  const auto nm = [&](std::size_t n) {
    return std::ldexp(static_cast<double>(b.out(n).tau_ref), -D::f.torque.fraction);
  };
  CHECK(std::abs(nm(0) - 0.04) < 1e-3);
  CHECK(std::abs(nm(1) + 0.02) < 1e-3);

  // Late ones are not sent; lost ones are missing in the board's count.
  CHECK_FALSE(burst.send(values(0), host::HostClock::now() - std::chrono::milliseconds(1)));
  CHECK(burst.counts().late == 1);
  b.settle();
  CHECK(std::abs(nm(0) - 0.04) < 1e-3);
  b.wire->lost = 0.001;
  for (int k = 0; k < updates; ++k) REQUIRE(burst.send(values(0.005)));
  while (b.wire->board.unsent() > 0) b.wire->run(100);
  b.wire->lost = 0;
  const auto lost = burst.check().lost_frames;
  std::printf("%llu of %d frames lost\n", static_cast<unsigned long long>(lost), 17 * updates);
  CHECK(lost > 8);
  CHECK(lost < 80);
  // Without updates the torque ends with the age of the words.
  CHECK(std::abs(nm(0)) > 0.01);
  b.wire->run(D::clock_hz / 20);
  CHECK(nm(0) == 0);
  CHECK(nm(1) == 0);

  // Both banks of the next law have its own words: none of this one's is refused for it.
  b.device.disarm();
  b.settle();
  b.engine.load(springs());
  for (const double stiffness : {0.5, 0.75, 0.9}) {
    // A step of its word is 5.3 mNm/rad.
    CHECK(std::abs(b.engine.set({{"stiffness", stiffness}}).front() - stiffness) < 5.3e-3);
  }
}
