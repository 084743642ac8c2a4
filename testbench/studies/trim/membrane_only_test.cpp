// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core of a design that builds the membrane alone, RTL against twin: every output, every clock.
// A scene that is not there renders nothing. Documentation: docs/designs.md
#include <string>

#include "Vmembrane_only.h"
#include "catch.hpp"
#include "core_stimulus.hpp"
#include "membrane_only.hpp"
#include "mismatch.hpp"
#include "sim/backends/make_backends.hpp"
#include "twins.hpp"

using namespace feltgate;
using D = MembraneOnly;

namespace {

/// Both cores on the same inputs.
class Pair {
 public:
  explicit Pair(std::uint64_t seed) { rtl_.power_up(seed, {}); }
  /// False, and the place noted, when an output differs.
  bool clock(const CoreIn& in) {
    rtl_.clock(in);
    twin_.clock(in);
    ++clocks_;
    if (rtl_.out() == twin_.out()) return true;
    where_ = "clock " + std::to_string(clocks_) + ", " + difference(rtl_.out(), twin_.out());
    return false;
  }
  const CoreOut& out() const { return twin_.out(); }
  const std::string& where() const { return where_; }
  test::CoreOf<D>& twin() { return twin_; }

 private:
  RtlCore<Vmembrane_only> rtl_{design_of<D>()};
  test::CoreOf<D> twin_;
  std::int64_t clocks_ = 0;
  std::string where_;
};

/// Armed by the host in scene `scene` with the fastest ramp, the lever going up: largest |tau_ref|.
std::int64_t largest_torque(int scene) {
  Pair pair(3);
  CoreIn in;
  const auto write = [&](int address, std::uint32_t data) {
    while (pair.twin().clock_of_tick() != 5) REQUIRE(pair.clock(in));
    in.reg_addr = static_cast<std::uint16_t>(address);
    in.reg_wdata = data;
    in.reg_write = true;
    REQUIRE(pair.clock(in));
    in.reg_write = false;
  };
  write(D::A::self_test_pulse, 0);
  write(D::A::ramp_step, 0x7ffffff);
  const std::uint32_t word = static_cast<std::uint32_t>(D::control_reset) |
                             1u << D::C::control_host |
                             static_cast<std::uint32_t>(scene) << D::C::control_scene;
  write(D::C::control, word);
  write(D::C::control, word | 1u << D::C::control_arm);
  std::int64_t largest = 0;
  for (int k = 0; k < 100'000; ++k) {
    const unsigned phase = static_cast<unsigned>(k / 200);  // 500 counts: through the membrane
    in.encoder.a = (phase & 2u) != 0;
    in.encoder.b = ((phase & 1u) != 0) != in.encoder.a;
    if (!pair.clock(in)) FAIL(pair.where());
    largest = std::max<std::int64_t>(largest, std::abs(std::int64_t{pair.out().tau_ref}));
  }
  CHECK(pair.out().armed);
  return largest;
}

}  // namespace

TEST_CASE("membrane only: the design says so") {
  STATIC_REQUIRE(D::scene_mask == (1 << D::S::free | 1 << D::S::membrane));
}

TEST_CASE("membrane only: RTL and twin on a random life") {
  test::Coverage seen;
  for (const std::uint64_t seed : {1u, 2u}) {
    Pair pair(seed);
    test::CoreStimulus<D> stimulus(seed);
    for (std::int64_t k = 0; k < test::scaled_clocks(1'000'000); ++k) {
      if (!pair.clock(stimulus(k))) FAIL(pair.where());
      seen.add(pair.out());
    }
  }
  INFO(seen.text());
  CHECK(seen.armed_share() > 0.3);
  CHECK(seen.scenes_seen(10) >= 7);
}

TEST_CASE("membrane only: what is not built renders nothing") {
  CHECK(largest_torque(D::S::membrane) > 0);
  for (const int scene : {D::S::setpoint, D::S::spring_tension, D::S::spring_compression,
                          D::S::damper, D::S::charge_attract, D::S::charge_repel, D::S::wall}) {
    INFO(scene);
    CHECK(largest_torque(scene) == 0);
  }
}
