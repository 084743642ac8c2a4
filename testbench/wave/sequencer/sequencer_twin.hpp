// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/wave/sequencer.sv: clocks of a tick, waves, slots to fetch. Clock c of a tick
// fetches slot c and is wave clock c - Map::first_wave_clock. Documentation:
// docs/architecture.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "lock_step.hpp"

namespace feltgate {

/// Counts ticks of ClocksPerTick clocks (at least Map::wave_length) from a reset on.
template <int ClocksPerTick, std::uint32_t ResetTicks = 0>
class Sequencer {
 public:
  struct In {};
  struct Out {
    bool tick = false;              ///< last clock of a tick
    int slot_fetch = 0;             ///< slot whose word is on the bus two clocks later, 0..63
    bool scene_slot_fetch = false;  ///< that slot lies in the scene's bank
    std::uint64_t wave = 0;         ///< one-hot: bit t in wave clock t
    std::uint32_t tick_count = 0;   ///< ticks since reset, wraps
  };

  /// Slots of the scene bank.
  static constexpr std::uint64_t kSceneSlots = Map::scene_slots;

  Sequencer() { reset(); }

  void reset() {
    clock_ = 0;
    out_ = Out();
    out_.tick_count = ResetTicks;
  }

  void clock(const In&) {
    if (out_.tick) ++out_.tick_count;
    out_.wave = ((out_.wave << 1) | (clock_ == kFirstWaveClock - 1 ? 1U : 0U)) & kWaveMask;
    clock_ = out_.tick ? 0 : clock_ + 1;
    out_.tick = clock_ == ClocksPerTick - 1;
    out_.slot_fetch = clock_ > 63 ? 63 : clock_;
    out_.scene_slot_fetch = ((kSceneSlots >> out_.slot_fetch) & 1U) != 0;
  }

  const Out& out() const { return out_; }

  /// The clock of the tick that is running, 0..ClocksPerTick-1.
  int clock_of_tick() const { return clock_; }

 private:
  static constexpr int kWaveLength = Map::wave_length;
  static_assert(ClocksPerTick >= kWaveLength, "a wave must end before the next one starts");
  static constexpr int kFirstWaveClock = Map::first_wave_clock;
  static constexpr std::uint64_t kWaveMask = (std::uint64_t{1} << kWaveLength) - 1;

  int clock_ = 0;
  Out out_;
};

}  // namespace feltgate

// The sequencer's outputs for the stimulus of a block that hangs on the wave: it restarts with each
// reset that LockStep<> makes, which it foresees from the same seed.

namespace feltgate::test {

template <int ClocksPerTick>
class RunningClock {
 public:
  /// Seed and plan of the run.
  RunningClock(std::uint64_t seed, ResetPlan plan) : resets_(seed ^ 0x7265736574U), plan_(plan) {}

  /// To be called first in every clock of the stimulus, the ones in reset included.
  const typename Sequencer<ClocksPerTick>::Out& next() {
    if (!in_reset_) sequencer_.clock({});
    if (left_ > 0) {
      --left_;
    } else if (plan_.mean_distance != 0 && resets_.one_in(plan_.mean_distance)) {
      left_ = 1 + resets_.below(8);
    }
    in_reset_ = left_ > 0;
    if (in_reset_) sequencer_.reset();
    return sequencer_.out();
  }
  /// Whether the block is held in reset in this clock.
  bool in_reset() const { return in_reset_; }

 private:
  Sequencer<ClocksPerTick> sequencer_;
  Random resets_;
  ResetPlan plan_;
  std::int64_t left_ = 4;  // as LockStep<>: three clocks of reset at the start
  bool in_reset_ = true;
};

}  // namespace feltgate::test
