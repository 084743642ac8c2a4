// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The whole core, RTL against twin, every output on every clock: all scenes and modes, register
// writes and resets at random times, random state before reset. Documentation: docs/testing.md
#include "feltgate/feltgate_core.hpp"

#include <array>

#include "catch.hpp"
#include "core_adapter.hpp"
#include "core_stimulus.hpp"
#include "random.hpp"
#include "sim/backends/rtl_model.hpp"
#include "twins.hpp"

using feltgate::CoreIn;
using D = feltgate::test::Design;
using Twin = feltgate::test::CoreTwin;
using feltgate::test::defects_run;
using feltgate::test::kPrograms;
using feltgate::test::scaled_clocks;

namespace {

using Bench = feltgate::test::CoreBench;
using feltgate::test::CoreStimulus;
using feltgate::test::Coverage;

constexpr bool kLoop = D::current_loop != 0;  // it cannot be armed in the first 10 ms
constexpr bool kEdges = D::absolute_encoder == 0;

/// Seeds and clocks with which a run comes to all that is asked of it below.
struct Lives {
  std::uint64_t first, number;
  std::int64_t clocks;
};
constexpr Lives kLives = D::hall != 0                ? Lives{9, 3, 1'200'000}
                         : kLoop && D::phases == 3   ? Lives{17, 2, 2'000'000}
                         : kLoop                     ? Lives{0, 2, 2'000'000}
                         : !kEdges && D::phases == 3 ? Lives{4, 2, 1'500'000}
                         : !kEdges                   ? Lives{13, 3, 1'000'000}
                         : D::clocks_per_tick > 50   ? Lives{9, 4, 3'000'000}
                                                     : Lives{9, kPrograms ? 6 : 4, 1'500'000};

/// The gates of each leg, in every clock.
class GateWatch {
 public:
  const char* operator()(const CoreIn& in, const feltgate::CoreOut& out) {
    ++clock_;
    for (std::size_t g = 0; g < 6; ++g) {
      const bool was = (gates_ >> g & 1) != 0, is = (out.gates >> g & 1) != 0;
      if (was && !is) off_at_[g] = clock_;
      const std::size_t other = g ^ 1u;
      if (is && (out.gates >> other & 1) != 0) return "both switches of a leg are on";
      if (is && !was && clock_ - off_at_[other] < D::dead_clocks) return "no dead time";
    }
    if (!enabled_ && out.gates != 0) return "a gate is on while disabled";
    if (in.stop && out.gates != 0) return "a gate is on at a stop";
    gates_ = out.gates;
    enabled_ = out.gates_enable;
    return nullptr;
  }

 private:
  unsigned gates_ = 0;
  bool enabled_ = false;
  std::int64_t clock_ = 0;
  std::array<std::int64_t, 6> off_at_{};
};

/// Compares the signals from a core to other axes.
const char* differs_to_axes(const CoreIn& in, const Vfeltgate_core& rtl, const Twin& twin) {
  if ((rtl.arm_request_o != 0) != twin.arm_request(in)) return "arm_request_o is not the twin's";
  if ((rtl.ready_o != 0) != twin.ready()) return "ready_o is not the twin's";
  if ((rtl.measured_o != 0) != twin.measured()) return "measured_o is not the twin's";
  if ((rtl.zeroed_o != 0) != twin.zeroed()) return "zeroed_o is not the twin's";
  // Within a tick the twin shows the end of a test one clock later.
  if (!twin.out().snapshot_valid) return nullptr;
  return (rtl.testing_o != 0) == twin.testing() ? nullptr : "testing_o is not the twin's";
}

}  // namespace

TEST_CASE("core: random motion, scenes, modes and register traffic") {
  Coverage total;
  const auto lives = static_cast<std::uint64_t>(scaled_clocks(kLives.number));
  for (std::uint64_t seed = kLives.first; seed < kLives.first + lives; ++seed) {
    Bench bench("feltgate_core", seed);
    Coverage seen;
    const auto watch = [&seen, gates = GateWatch()](const CoreIn& in, const Vfeltgate_core& rtl,
                                                    const Twin& twin, bool) mutable {
      seen.add(in, twin.out(), twin.clock_of_tick());
      const char* broken = gates(in, twin.out());
      return broken != nullptr ? broken : differs_to_axes(in, rtl, twin);
    };
    bench.run(CoreStimulus<D>(seed), kLives.clocks, {}, watch);
    total.merge(seen);
  }
  if (defects_run()) return;
  INFO(total.text());
  // A design with slow ticks runs too few ticks for these checks.
  if (scaled_clocks(1'500'000) / D::clocks_per_tick < 10'000) return;
  // A stimulus that never arms, or that keeps an output at its limit, would hide every error.
  CHECK(total.armed_share() >
        (kPrograms || kLoop || D::hall != 0 ? 0.2 : 0.3));  // with programs all axes must request
  CHECK(total.duty_pinned_share() < 0.35);  // the back-EMF of a fast lever exceeds the supply
  CHECK(total.tau_ref_pinned_share() < 0.5);
  // Of the eleven numbers, 1 is reserved, and 10 has no scene without programs.
  CHECK(total.scenes_seen(kPrograms ? 11 : 10) == (kPrograms ? 10 : 9));
  CHECK(total.gaps(2, kPrograms, kLoop, kEdges, D::fast_edges != 0) == "");
  CHECK(total.eased_share() > 0.005);
  if (kEdges) CHECK(total.frozen_share() > 0.0005);
}

TEST_CASE("core: resets at random times, random state before them") {
  const auto lives = static_cast<std::uint64_t>(scaled_clocks(3));
  for (std::uint64_t seed = 1; seed <= lives; ++seed) {
    Bench bench("feltgate_core", ~seed);
    bench.run(CoreStimulus<D>(~seed), 300'000, {20'000});
  }
}

TEST_CASE("core: at power-up the gates are off, whatever the other registers hold") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const feltgate::RtlModel<Vfeltgate_core> rtl(seed);
    REQUIRE(feltgate::read_outputs(*rtl, feltgate::test::port_bits<D>()).gates == 0);
  }
}

TEST_CASE("core: sampled position to duty register in the clocks that the schedule says") {
  if (!feltgate::test::scene_built<D>(D::S::spring_tension) || kLoop || !kEdges) return;
  // The encoder makes one step against a stiff spring; wave clock 0 is the clock of the sample.
  Twin twin;
  CoreStimulus<D> host(1);
  CoreIn in;
  in.hall = feltgate::hall_code(0);
  const auto write = [&](int address, std::uint32_t data) {
    while (twin.clock_of_tick() != 5) twin.clock(in);
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = data;
    in.reg_write = true;
    twin.clock(in);
    in.reg_write = false;
    while (twin.clock_of_tick() != 0) twin.clock(in);
  };
  write(D::A::self_test_pulse, 0);
  write(D::A::tension_stiffness, 0x1ffff);
  write(D::A::ramp_step, 0x7ffffff);
  write(D::C::control, static_cast<std::uint32_t>(D::control_reset) | 1u << D::C::control_host |
                           static_cast<std::uint32_t>(D::S::spring_tension) << D::C::control_scene);
  write(D::C::control, static_cast<std::uint32_t>(D::control_reset) | 1u << D::C::control_host |
                           1u << D::C::control_arm |
                           static_cast<std::uint32_t>(D::S::spring_tension) << D::C::control_scene);
  for (int k = 0; k < 500; ++k) twin.clock(in);
  constexpr int sample = feltgate::axis::TickCounter::sample_clock;
  while (twin.clock_of_tick() != sample + 1) twin.clock(in);
  // The step is decoded in this tick and sampled by the next tick.
  for (int step = 0; step < 40; ++step) {
    in.encoder.b = (step & 1) == 0 ? !in.encoder.a : in.encoder.a;
    if ((step & 1) == 1) in.encoder.a = !in.encoder.a, in.encoder.b = in.encoder.a;
    twin.clock(in);
  }
  const auto before = twin.out().duty;
  while (twin.clock_of_tick() != sample) twin.clock(in);
  int clocks = 0;
  while (twin.out().duty == before && clocks < 100) {
    twin.clock(in);
    ++clocks;
  }
  CHECK(clocks == twin.duty_clock() - sample);
}
