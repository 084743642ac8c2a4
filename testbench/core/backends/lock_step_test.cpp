// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The program's lock-step, in which the RTL follows in stretches, against RTL and twin compared
// clock by clock: the same mismatches, the first in the same clock. With FELTGATE_BROKEN the RTL
// has a seeded defect, which both must see. Documentation: docs/architecture.md
#include "sim/backends/lock_step_backend.hpp"

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "Vfeltgate_core.h"
#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "random.hpp"
#include "twins.hpp"

namespace feltgate {
namespace {

using Rtl = RtlCore<Vfeltgate_core>;
constexpr Clock clocks = 400'000;
constexpr std::uint64_t seed = 7;

/// Edges at random distances, to and fro.
std::vector<EncoderEvent> motion() {
  test::Random random(seed);
  std::vector<EncoderEvent> events;
  int phase = 0;
  for (Clock at = 100; at < clocks; at += 60 + static_cast<Clock>(random.below(400))) {
    phase += (at / 150'000) % 2 == 0 ? 1 : 3;
    events.push_back({at, {(((phase + 1) >> 1) & 1) != 0, ((phase >> 1) & 1) != 0, false}});
  }
  return events;
}

/// Armed by the host in the scene "charge_attract", without a self-test: a write a tick.
std::array<std::pair<int, std::uint32_t>, 2> host_writes() {
  const DesignInfo d = design_info<Lever>();
  const auto scene = static_cast<std::uint32_t>(d.scene_number("charge_attract"));
  const std::uint32_t control =
      d.control_reset | 1u << d.control.host | 1u << d.control.arm | scene << d.control.scene;
  return {{{Lever::A::self_test_pulse, 0}, {Lever::C::control, control}}};
}

struct Found {
  std::int64_t mismatches = 0;
  Clock first = -1;
};

/// Clock by clock, with the writes in the clocks in which an engine issues them.
Found clock_by_clock(const std::vector<EncoderEvent>& events) {
  const auto rtl = std::make_unique<Rtl>(design_of<Lever>());
  const auto twin = std::make_unique<test::CoreOf<Lever>>();
  rtl->power_up(seed, {});
  CoreIn in;
  Found found;
  auto next = events.begin();
  for (Clock now = 0; now < clocks; ++now) {
    for (; next != events.end() && next->clock <= now; ++next) in.encoder = next->pins;
    in.reg_write = false;
    for (std::size_t tick = 0; tick < 2; ++tick) {
      if (now != static_cast<Clock>(tick) * Lever::clocks_per_tick + host_write_clock) continue;
      in.reg_write = true;
      in.reg_addr = static_cast<std::uint16_t>(host_writes()[tick].first);
      in.reg_wdata = host_writes()[tick].second;
    }
    rtl->clock(in);
    twin->clock(in);
    if (rtl->out() == twin->out()) continue;
    if (found.mismatches++ == 0) found.first = now;
  }
  return found;
}

TEST_CASE("stretches of any length see the mismatches that a comparison clock by clock sees") {
  const std::vector<EncoderEvent> events = motion();
  const Found expected = clock_by_clock(events);
#ifdef FELTGATE_BROKEN
  REQUIRE(expected.mismatches > 0);
#else
  REQUIRE(expected.mismatches == 0);
#endif
  for (const Clock step : {Clock{25}, Clock{999}, Clock{50'000}}) {
    const auto engine = std::make_unique<LockStepBackend<Vfeltgate_core>>(design_info<Lever>());
    engine->reset(seed, {});
    for (const auto& [address, word] : host_writes()) engine->write(address, word);
    std::size_t snapshots = 0, sent = 0;
    while (engine->now() < clocks) {
      const Clock end = std::min(clocks, engine->now() + step);
      const std::size_t from = sent;
      while (sent < events.size() && events[sent].clock < end) ++sent;
      engine->advance(end - engine->now(), events.data() + from, events.data() + sent);
      snapshots += engine->snapshots().size();
    }
    INFO("steps of " << step << " clocks; " << engine->first_mismatch());
    CHECK(engine->mismatches() == expected.mismatches);
    CHECK(snapshots == static_cast<std::size_t>(clocks / Lever::clocks_per_tick));
    if (expected.mismatches == 0) continue;
    CHECK(engine->first_mismatch_clock() == expected.first);
    CHECK(engine->first_mismatch().find(": rtl ") != std::string::npos);
  }
}

}  // namespace
}  // namespace feltgate
