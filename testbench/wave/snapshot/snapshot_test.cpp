// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// snapshot: RTL against twin on every clock, and both against the list of words.
// Documentation: docs/architecture.md
#include <Vsnapshot.h>

#include <array>
#include <cstdint>
#include <set>

#include "catch.hpp"
#include "feltgate/generated/map.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

// Twin of rtl/core/wave/snapshot.sv, clock by clock.

namespace feltgate {

template <bool ReadBack>
class Snapshot {
 public:
  struct In {
    int slot_fetch = 0;  ///< 6 bits
    std::uint64_t wave = 0;
    std::uint32_t status = 0, faults = 0, position = 0, tick_count = 0, index_position = 0;
    std::uint16_t error_count = 0, rejected_count = 0;
    std::uint32_t operand = 0;  ///< the operand bus, 0 in the clocks of the words above
  };
  struct Out {
    bool valid = false;
    int slot = 0;  ///< these two stand until the next word
    std::uint32_t data = 0;
  };

  void reset() { out_ = Out(); }
  const Out& out() const { return out_; }

  void clock(const In& in) {
    if constexpr (!ReadBack) return;
    const auto now = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    out_.valid = false;
    for (const int t : {R::status, R::faults, R::position, R::tick, R::index, R::encoder,
                        R::velocity, R::tau_hat, R::tau_ref, R::current_ref, R::voltage, R::duty}) {
      out_.valid = out_.valid || now(t);
    }
    if (!out_.valid) return;
    out_.slot = (in.slot_fetch - Map::first_wave_clock) & 63;
    out_.data = in.operand;
    if (now(R::status)) out_.data |= in.status;
    if (now(R::faults)) out_.data |= in.faults;
    if (now(R::position)) out_.data |= in.position;
    if (now(R::tick)) out_.data |= in.tick_count;
    if (now(R::index)) out_.data |= in.index_position;
    if (now(R::encoder)) out_.data |= std::uint32_t{in.rejected_count} << 16 | in.error_count;
  }

 private:
  using R = Map::R;

  Out out_;
};

}  // namespace feltgate

using namespace feltgate;
using namespace feltgate::test;

namespace {

using R = Map::R;
using Twin = Snapshot<READ_BACK != 0>;

struct Adapter {
  static void drive(Vsnapshot& rtl, const Twin::In& in) {
    rtl.slot_fetch_i = static_cast<std::uint8_t>(in.slot_fetch);
    FELTGATE_DRIVE(rtl, in, status, faults, position, tick_count, index_position, error_count,
                   rejected_count, operand);
    FELTGATE_STROBES(rtl, in.wave, read, R, status, position, tick, velocity, index, encoder,
                     tau_hat, faults, tau_ref, current_ref, voltage, duty);
  }
  template <class Check>
  static void compare(Check& check, const Vsnapshot& rtl, const Twin::Out& out) {
    check("valid", rtl.valid_o, out.valid);
    check("slot", rtl.slot_o, out.slot);
    check("data", rtl.data_o, out.data);
  }
};

using Bench = LockStep<Vsnapshot, Twin, Adapter>;

/// Ticks of 50 clocks or more; words that are new in every clock.
struct Ticks {
  Random random;
  int clock = 0, period = Map::wave_length;

  Twin::In operator()(std::int64_t) {
    Twin::In in;
    in.slot_fetch = clock & 63;
    const int t = clock - Map::first_wave_clock;
    in.wave = t >= 0 && t < Map::wave_length ? std::uint64_t{1} << t : 0;
    in.status = static_cast<std::uint32_t>(random.bits());
    in.faults = static_cast<std::uint32_t>(random.bits());
    in.position = static_cast<std::uint32_t>(random.bits());
    in.tick_count = static_cast<std::uint32_t>(random.bits());
    in.index_position = static_cast<std::uint32_t>(random.bits());
    in.error_count = static_cast<std::uint16_t>(random.bits());
    in.rejected_count = static_cast<std::uint16_t>(random.bits());
    in.operand = static_cast<std::uint32_t>(random.bits());
    if (++clock >= period) {
      clock = 0;
      period = Map::wave_length + static_cast<int>(random.below(12));
    }
    return in;
  }
};

/// The words of a tick by their clocks.
struct Words {
  std::array<std::int64_t, Map::wave_length>* seen;

  const char* operator()(const Twin::In& in, const Vsnapshot& rtl, const Twin&, bool in_reset) {
    if (in_reset || in.wave == 0) return nullptr;
    int t = 0;
    while (((in.wave >> t) & 1u) == 0) ++t;
    static const std::set<int> own{R::status, R::faults, R::position,
                                   R::tick,   R::index,  R::encoder};
    static const std::set<int> operands{R::velocity,    R::tau_hat, R::tau_ref,
                                        R::current_ref, R::voltage, R::duty};
    const bool stored = READ_BACK != 0 && (own.count(t) + operands.count(t)) != 0;
    if ((rtl.valid_o != 0) != stored) return "valid in the clocks of the words";
    if (stored && rtl.slot_o != t) return "the slot is the clock of the wave";
    if (stored && operands.count(t) != 0 && rtl.data_o != in.operand)
      return "an operand as it passes by";
    if (stored) ++(*seen)[static_cast<std::size_t>(t)];
    return nullptr;
  }
};

}  // namespace

TEST_CASE("snapshot: the words in their clocks, and nothing between them") {
  std::array<std::int64_t, Map::wave_length> seen{};
  const std::int64_t clocks = scaled_clocks(400000);
  Bench bench("snapshot", 1);
  bench.run(Ticks{Random(2)}, clocks, {3000}, Words{&seen});
  int words = 0;
  for (const std::int64_t count : seen) words += count * 100 > clocks;
  REQUIRE(words == (READ_BACK != 0 ? 12 : 0));
}
