// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin that lets quiet clocks wait against the one that does not: after every step of a loop
// the same duty, enable of the gates and snapshots. Documentation: docs/speed-for-accuracy.md
#include <array>
#include <memory>
#include <vector>

#include "catch.hpp"
#include "mismatch.hpp"
#include "random.hpp"
#include "sim/backends/backend.hpp"

namespace {

using namespace feltgate;

/// A lever that rests, creeps and races.
class Lever {
 public:
  explicit Lever(std::uint64_t seed) : random_(seed) {}
  EncoderPins pins() const {
    const bool a = (phase_ & 2u) != 0;
    return {a, ((phase_ & 1u) != 0) != a, (phase_ & 0xfffu) == 0};
  }
  std::vector<EncoderEvent> step(Clock now, Clock clocks) {
    std::vector<EncoderEvent> events;
    for (Clock c = now + 1; c <= now + clocks; ++c) {
      if (left_-- <= 0) {
        left_ = 2'000 + static_cast<Clock>(random_.below(100'000));
        const std::uint32_t kind = random_.below(8);
        spacing_ = kind < 2 ? 0 : kind < 7 ? 300 + random_.below(20'000) : 20 + random_.below(80);
        up_ = random_.coin();
      }
      if (spacing_ == 0 || !random_.one_in(spacing_)) continue;
      phase_ += random_.one_in(100) ? 2u : up_ ? 1u : 3u;  // seldom an illegal step
      events.push_back({c, pins()});
    }
    return events;
  }

 private:
  test::Random random_;
  Clock left_ = 0;
  std::uint32_t spacing_ = 0, phase_ = 0;
  bool up_ = true;
};

using Faults = std::array<int, 8>;

void compare(const char* design, std::uint64_t seed, int steps, Faults& faults) {
  const auto exact = make_backend(design, "twin"), waiting = make_backend(design, "twin");
  const DesignInfo& d = exact->design();
  test::Random random(seed);
  Lever lever(seed + 1);
  for (Backend* e : {exact.get(), waiting.get()}) e->reset(1, lever.pins());
  waiting->keep_gate_times(false);
  const ParameterInfo& nominal = *d.find("nominal_current_squared");
  for (const std::uint32_t word : {(1u << 31) - 1, static_cast<std::uint32_t>(nominal.raw)}) {
    for (Backend* e : {exact.get(), waiting.get()}) {  // removes the heat of power-up
      e->write(nominal.address, word);
      e->advance(10 * d.clocks_per_tick, nullptr, nullptr);
    }
  }
  int changes = 0, duties = 0;
  bool enabled = false;
  Panel panel;
  for (int k = 0; k < steps; ++k) {
    std::vector<std::pair<int, std::uint32_t>> writes;
    if (random.one_in(300)) {
      std::uint32_t word = d.control_reset | 1u << d.control.host;
      if (!random.one_in(3)) word |= 1u << d.control.arm;
      word |= random.below(9) << d.control.scene | random.below(3) << d.control.mode;
      writes.emplace_back(d.control_address, word);
    }
    if (random.one_in(200)) {
      const char* names[] = {"overspeed",      "i2t_budget", "polarity_ticks",  "polarity_speed",
                             "watchdog_ticks", "ramp_step",  "setpoint_torque", "polarity_current"};
      const ParameterInfo& p = *d.find(names[random.below(8)]);
      const auto raw = static_cast<std::uint32_t>(p.raw);
      writes.emplace_back(p.address, random.one_in(3) ? raw : raw >> random.below(16));
    }
    if (random.one_in(500)) writes.emplace_back(d.command_address, random.below(32));
    for (const auto& [address, word] : writes) {
      exact->write(address, word);
      waiting->write(address, word);
    }
    // Not told in every step: an engine that is told anything runs what waits.
    if (random.one_in(panel.stop ? 20 : 5'000)) {
      panel.stop = !panel.stop;
      for (Backend* e : {exact.get(), waiting.get()}) e->set_panel(panel);
    }
    const Clock clocks = random.one_in(20) ? 1 + random.below(120) : 25;
    const auto events = lever.step(exact->now(), clocks);
    for (Backend* e : {exact.get(), waiting.get()}) {
      e->advance(clocks, events.data(), events.data() + events.size());
    }
    changes += exact->gates_enabled() != enabled;
    enabled = exact->gates_enabled();
    duties += exact->duty() != 0;
    for (const Snapshot& s : exact->snapshots()) ++faults[s.first_fault & 7];
    INFO(design << ", seed " << seed << ", step " << k << " of " << clocks << " clocks");
    REQUIRE(exact->now() == waiting->now());
    REQUIRE(exact->duty() == waiting->duty());
    REQUIRE(exact->gates_enabled() == waiting->gates_enabled());
    REQUIRE(exact->snapshots() == waiting->snapshots());
  }
  INFO(design << " " << seed);
  CHECK(changes > 20);
  CHECK(duties > steps / 100);
}

}  // namespace

TEST_CASE("clocks that would close the gates do not wait", "[waiting]") {
  const auto exact = make_backend("lever", "twin"), waiting = make_backend("lever", "twin");
  const DesignInfo& d = exact->design();
  EncoderPins pins;
  for (Backend* e : {exact.get(), waiting.get()}) e->reset(1, pins);
  waiting->keep_gate_times(false);
  const auto write = [&](const char* name, std::uint32_t word) {
    for (Backend* e : {exact.get(), waiting.get()}) e->write(d.find(name)->address, word);
  };
  int settled = 0;  // steps at whose end both say the same
  /// Half ticks; whether the gates have fallen with the last.
  const auto step = [&](const std::vector<EncoderEvent>& events) {
    const bool open = exact->gates_enabled();
    for (Backend* e : {exact.get(), waiting.get()}) {
      e->advance(d.clocks_per_tick / 2, events.data(), events.data() + events.size());
    }
    REQUIRE(exact->duty() == waiting->duty());
    REQUIRE(exact->gates_enabled() == waiting->gates_enabled());
    ++settled;
    return open && !exact->gates_enabled();
  };
  const auto steps = [&](int n) {
    for (int k = 0; k < n; ++k) step({});
  };
  const auto control = [&](bool arm, const char* scene) {
    const auto number = static_cast<std::uint32_t>(d.scene_number(scene));
    for (Backend* e : {exact.get(), waiting.get()}) {
      e->write(d.control_address, d.control_reset | 1u << d.control.host |
                                      static_cast<std::uint32_t>(arm) << d.control.arm |
                                      number << d.control.scene);
    }
    steps(8);
  };
  write("self_test_pulse", 0);
  steps(4);
  write("nominal_current_squared", (1u << 31) - 1);
  steps(4);

  // A sum of 0 at a budget of 0.
  control(true, "free");
  REQUIRE(exact->gates_enabled());
  steps(20);
  write("i2t_budget", 0);
  int n = 0;
  while (!step({}) && n < 10) ++n;
  REQUIRE_FALSE(exact->gates_enabled());
  write("i2t_budget", 0xffffffff);
  steps(4);

  // A lever that gathers speed against the torque; windows end without an edge nearby.
  write("polarity_ticks", 5);
  steps(4);
  write("polarity_speed", 1);
  steps(4);
  write("polarity_current", 0);
  steps(4);
  write("ramp_step", 0x7ffffff);
  steps(4);
  write("setpoint_torque", 2'000);
  unsigned phase = 0;
  for (int life = 0; life < 20; ++life) {
    control(false, "setpoint");
    for (Backend* e : {exact.get(), waiting.get()}) {
      e->write(d.command_address, 1u << d.command.clear_faults);
    }
    steps(4000);  // at rest
    control(true, "setpoint");
    REQUIRE(exact->gates_enabled());
    bool fell = false;
    int left = 40 + life;
    for (n = 0; n < 4'000 && !fell; ++n) {
      std::vector<EncoderEvent> events;
      if (--left < 0) {
        left = 38 - n / 100;
        phase += 3u;
        const bool a = (phase & 2u) != 0;
        events.push_back({exact->now() + 1, {a, ((phase & 1u) != 0) != a, false}});
      }
      fell = step(events);
    }
    INFO("life " << life);
    REQUIRE(fell);
  }
  CHECK(settled > 80'000);
}

TEST_CASE("clocks that wait change nothing", "[waiting]") {
  const auto steps = static_cast<int>(test::scaled_clocks(400'000));
  Faults faults{};
  for (const std::uint64_t seed : {61u, 62u}) {
    compare("lever", seed, steps, faults);
    compare("paper", seed + 10, steps, faults);
  }
  for (const int fault : {1, 2, 3, 4, 6}) {
    INFO("fault " << fault);
    CHECK(faults[static_cast<std::size_t>(fault)] > 0);
  }
}
