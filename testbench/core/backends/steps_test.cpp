// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The back-end of the twin in steps of a loop against the same one clock by clock: the same duty,
// enable of the gates, gate times and snapshots. skip_test judges the twin itself.
// docs/architecture.md
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
  const auto exact = make_backend(design, "twin"), stepped = make_backend(design, "twin");
  const DesignInfo& d = exact->design();
  test::Random random(seed);
  Lever lever(seed + 1);
  for (Backend* e : {exact.get(), stepped.get()}) e->reset(1, lever.pins());
  const ParameterInfo& nominal = *d.find("nominal_current_squared");
  for (const std::uint32_t word : {(1u << 31) - 1, static_cast<std::uint32_t>(nominal.raw)}) {
    for (Backend* e : {exact.get(), stepped.get()}) {  // removes the heat of power-up
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
      stepped->write(address, word);
    }
    if (random.one_in(panel.stop ? 20 : 5'000)) {
      panel.stop = !panel.stop;
      for (Backend* e : {exact.get(), stepped.get()}) e->set_panel(panel);
    }
    const Clock clocks = random.one_in(20) ? 1 + random.below(120) : 25;
    const auto events = lever.step(exact->now(), clocks);
    stepped->advance(clocks, events.data(), events.data() + events.size());
    std::vector<Snapshot> snapshots;
    GateClocks gates;
    const EncoderEvent* event = events.data();
    for (Clock c = 0; c < clocks; ++c) {
      const EncoderEvent* const next = event;
      while (event != events.data() + events.size() && event->clock <= exact->now() + 1) ++event;
      exact->advance(1, next, event);
      const auto& told = exact->snapshots();
      snapshots.insert(snapshots.end(), told.begin(), told.end());
      const GateClocks on = exact->gates();
      gates.a_hi += on.a_hi, gates.a_lo += on.a_lo, gates.b_hi += on.b_hi, gates.b_lo += on.b_lo;
    }
    changes += exact->gates_enabled() != enabled;
    enabled = exact->gates_enabled();
    duties += exact->duty() != 0;
    for (const Snapshot& s : snapshots) ++faults[s.first_fault & 7];
    INFO(design << ", seed " << seed << ", step " << k << " of " << clocks << " clocks");
    REQUIRE(exact->now() == stepped->now());
    REQUIRE(exact->duty() == stepped->duty());
    REQUIRE(exact->gates_enabled() == stepped->gates_enabled());
    REQUIRE(snapshots == stepped->snapshots());
    const GateClocks on = stepped->gates();
    REQUIRE(gates.a_hi == on.a_hi);
    REQUIRE(gates.a_lo == on.a_lo);
    REQUIRE(gates.b_hi == on.b_hi);
    REQUIRE(gates.b_lo == on.b_lo);
  }
  INFO(design << " " << seed);
  CHECK(changes > 20);
  CHECK(duties > steps / 100);
}

}  // namespace

TEST_CASE("the twin in steps of any length is the twin clock by clock", "[steps]") {
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
