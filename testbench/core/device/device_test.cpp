// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The facade: every clock is FeltgateCore's, a tick at a time is clock by clock, requests act
// without knowledge of edges, errors say what to do.
#include "feltgate/device.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "random.hpp"
#include "sim/backends/make_device.hpp"
#include "twins.hpp"

using namespace feltgate;
using feltgate::test::Random;

namespace {

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "done";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Lever angles that push into the wall and come back, one per tick.
double angle_rad(int tick) { return 0.7 * std::sin(tick / 20000.0); }

void set_up(Device& d) {
  d.select("wall");
  d.set("wall_stiffness", 0.004);
  d.set("wall_contact", d.counts(0.3));
  d.set("self_test_pulse", 0);
  d.set_control(Control::open_loop);
  d.arm();
}

template <class D>
void check_against_the_core() {
  TwinDevice d{design_info<D>()};
  test::CoreOf<D> core;
  set_up(d);
  Random random(7);
  EncoderPins pins;
  int snapshots = 0;
  bool armed = false;
  for (int clock = 0; clock < 400000; ++clock) {
    if (random.one_in(40)) (random.coin() ? pins.a : pins.b) ^= true;
    if (clock == 200000) d.disarm();
    if (clock == 250000) d.stop(true);
    if (clock == 260000) d.stop(false);
    if (clock == 270000) d.clear_faults();
    d.clock(pins);
    core.clock(d.inputs());
    if (!(d.out() == core.out())) FAIL("clock " << clock << " is not the core's");
    armed = armed || d.armed();
    if (!core.out().snapshot_valid) continue;
    ++snapshots;
    const CoreOut& o = core.out();
    const Reading& r = d.reading();
    REQUIRE(r.velocity_rad_s ==
            std::ldexp(static_cast<double>(o.velocity), -D::f.velocity.fraction));
    REQUIRE(r.torque_nm == std::ldexp(static_cast<double>(o.tau_ref), -D::f.torque.fraction));
    REQUIRE(r.tau_hat_nm == std::ldexp(static_cast<double>(o.tau_hat), -D::f.torque.fraction));
    REQUIRE(r.current_a == std::ldexp(static_cast<double>(o.current_ref), -D::f.current.fraction));
    REQUIRE(r.voltage_v == std::ldexp(static_cast<double>(o.voltage), -D::f.voltage.fraction));
    REQUIRE(r.angle_rad == o.position * D::count_rad);
    REQUIRE(r.duty * D::pwm_period == Approx(o.duty));
  }
  CHECK(armed);
  CHECK(snapshots == 400000 / D::clocks_per_tick);
}

}  // namespace

TEST_CASE("every clock of a device is the core's") {
  check_against_the_core<Lever>();
  check_against_the_core<Paper>();
}

TEST_CASE("what an armed core drops is refused or waits, and arming for it") {
  TwinDevice d{design_info<Lever>()};
  const auto at = [&](int ticks) {
    for (int k = 0; k < ticks; ++k) d.tick({});
  };
  set_up(d);  // asks to be armed while writes wait
  at(6);
  REQUIRE(d.armed());
  REQUIRE(d.pending() == 0);
  const std::string told = refusal([&] { d.set("current_limit", 1.0); });
  INFO(told);
  CHECK(has(told, "current_limit cannot change while armed"));
  CHECK(has(refusal([&] { d.set_control(Control::closed_loop); }), "disarm() first"));
  CHECK(refusal([&] { d.set("torque_limit", 0.1); }) == "done");
  at(2);
  d.disarm();
  CHECK(refusal([&] { d.set("current_limit", 1.0); }) == "done");
  d.arm();  // within one tick: after the write
  at(8);
  CHECK(d.armed());
  CHECK(d.pending() == 0);
}

TEST_CASE("a tick at a time is clock by clock") {
  TwinDevice ticks{design_info<Lever>()}, clocks{design_info<Lever>()};
  set_up(ticks);
  set_up(clocks);
  Random random(11);
  EncoderPins pins;
  for (int tick = 0; tick < 20000; ++tick) {
    if (random.one_in(8)) (random.coin() ? pins.a : pins.b) ^= true;
    if (tick == 9000) ticks.clear_faults(), clocks.clear_faults();
    if (tick == 9001) ticks.arm(), clocks.arm();
    ticks.tick(pins);
    for (int c = 0; c < Lever::clocks_per_tick; ++c) clocks.clock(pins);
    REQUIRE(ticks.out() == clocks.out());
    REQUIRE(ticks.inputs().arm == clocks.inputs().arm);
  }
}

TEST_CASE("a lever that is moved by angles meets the wall") {
  const auto d = make_device("lever");
  set_up(*d);
  double deepest = 0, push = 0;
  for (int tick = 1; tick < 60000; ++tick) {
    const Reading& r = d->tick_to(angle_rad(tick));
    // The wave of a tick starts from the position that the tick before has left.
    REQUIRE(std::abs(r.angle_rad - angle_rad(tick - 1)) < 2 * d->design().count_rad);
    deepest = std::max(deepest, r.angle_rad);
    push = std::min(push, r.torque_nm);
  }
  CHECK(deepest == Approx(0.7).margin(2 * d->design().count_rad));
  CHECK(push == Approx(-0.5).margin(1e-9));  // torque_limit
  CHECK(d->armed());
  CHECK(d->reading().fault_names().empty());
}

TEST_CASE("arming knows nothing of edges") {
  TwinDevice d{design_info<Lever>()};
  d.arm();  // before the first clock: high from the start would never arm
  for (int k = 0; k < 3; ++k) d.tick({});
  CHECK(d.armed());
  d.disarm();
  d.arm();  // within one tick
  for (int k = 0; k < 3; ++k) d.tick({});
  CHECK(d.armed());

  d.stop(true);
  for (int k = 0; k < 3; ++k) d.tick({});
  CHECK_FALSE(d.armed());
  CHECK(d.reading().fault_names() == "stop");
  CHECK(has(refusal([&] { d.arm(); }), "the fault stop is latched; clear_faults()"));
  d.stop(false);
  for (int k = 0; k < 5; ++k) d.tick({});
  CHECK_FALSE(d.armed());  // not again by itself
  d.clear_faults();
  d.arm();  // at once: it waits until they are cleared
  for (int k = 0; k < 5; ++k) d.tick({});
  CHECK(d.armed());
  CHECK(d.reading().fault_names().empty());
  d.disarm();
  d.tick({});
  d.stop(true);
  CHECK(has(refusal([&] { d.arm(); }), "the stop is pressed"));
}

TEST_CASE("parameters go by name, in their units") {
  const auto d = make_device("lever");
  for (const Parameter& p : d->parameters()) {
    CAPTURE(std::string(p.name));
    for (const double value : {p.low, p.high}) {
      d->set(std::string(p.name), value);
      CHECK(d->parameter(std::string(p.name)).value == value);
    }
    CHECK(refusal([&] { d->set(std::string(p.name), p.high + p.step); }) != "done");
  }
  const std::string told = refusal([&] { d->set("wall_stiffness", 3); });
  CHECK(told ==
        "wall_stiffness = 3 Nm/count does not fit design lever; choose a value from 0 to "
        "0.124999 Nm/count");
  CHECK(refusal([&] { d->set("wall_stiffness", NAN); }) != "done");
  CHECK(has(refusal([&] { d->set("wall_stifness", 0.1); }), "did you mean \"wall_stiffness\"?"));
  CHECK(has(refusal([&] { d->select("wal"); }), "did you mean \"wall\"?"));
  CHECK(has(refusal([&] { d->tick_to(1.0); }), "move it in smaller steps"));
  CHECK(has(refusal([&] { d->run(10, {{11, {}}}); }), "after the end of the stretch"));
  CHECK(has(refusal([] { make_device("levre"); }),
            "design \"levre\" is unknown; did you mean \"lever\"?"));
}

TEST_CASE("every scene that a design builds can be chosen") {
  TwinDevice d{design_info<Lever>()};
  unsigned chosen = 2;  // bit 1: the scene that the map leaves out
  for (const std::string& scene : d.design().scenes) {
    d.select(scene);
    chosen |= 1u << d.inputs().scene;
  }
  CHECK((chosen & ~2u) == (static_cast<unsigned>(Lever::scene_mask) & ~2u));
}
