// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Waves for a scene block: what sequencer, parameter RAM and multiplier show it, clock by clock,
// and a second twin that runs the same waves by tick(). Documentation: docs/blocks/scenes.md
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "feltgate/words.hpp"
#include "lock_step.hpp"

namespace feltgate::test {

using Design = FELTGATE_DESIGN;
constexpr Format kTorque = Design::f.torque;

/// The parameter RAM: the words as they are and as tick() takes them.
class Memory {
 public:
  Memory() {
    for (const ParameterInfo& p : Design::parameters) write(p.address, p.raw);
  }
  void write(int address, std::int64_t word) {
    ram_[static_cast<std::size_t>(address)] = static_cast<std::uint32_t>(word & 0xffffffff);
    words_.set_raw(address, word);
  }
  std::uint32_t word(int address) const { return ram_[static_cast<std::size_t>(address)]; }
  /// What is on the bus in clock t of a wave.
  std::uint32_t slot(int scene, int t) const {
    constexpr std::uint64_t scene_slots = 0x5c4e;
    if (t < 0 || t > 62) return 0;
    return word(((scene_slots >> t) & 1u) != 0 ? scene * 32 + t : t);
  }
  const Words<Design, Fixed>& words() const { return words_; }

 private:
  std::array<std::uint32_t, 512> ram_{};
  Words<Design, Fixed> words_;
};

/// What one wave starts from.
struct Wave {
  bool armed = true;
  int scene = 0;
  std::int32_t position = 0;  ///< 18 bits
  std::int64_t velocity = 0;  ///< raw
  int length = 32;            ///< clocks, at least 30
};

/// What the stimulus shares with the observer.
struct Probe {
  Memory memory;
  Wave wave;  ///< before the first one an idle one, while the block is reset
  int t = -1;
};

/// Buses of one clock.
struct Bus {
  bool start = false;
  std::uint32_t param = 0;
  std::int64_t product = 0;
};

/// Waves from next(memory, wave_number), which may write the memory. Block turns a wave and a bus
/// into inputs: In in(const Wave&, const Bus&); and shows an operand: operand(const Out&).
template <class Block, class Next>
class Waves {
 public:
  Waves(std::uint64_t seed, Next next, std::shared_ptr<Probe> probe)
      : random_(seed), next_(std::move(next)), probe_(std::move(probe)) {}

  template <class Out>
  auto operator()(std::int64_t clock, const Out& out) {
    Probe& p = *probe_;
    if (clock == 0) p = Probe{};  // a run starts: from the design's words
    if (++p.t >= p.wave.length) {
      p.wave = next_(p.memory, number_++);
      p.t = 0;
    }
    const int scene = p.wave.scene;
    if (p.t == 3) operand_ = Block::operand(out);
    if (p.t == 6) slope_operand_ = Block::operand(out);
    Bus bus;
    bus.start = p.t == 1;
    bus.param = p.memory.slot(scene, p.t);
    bus.product = product(p);
    return Block::in(p.wave, bus);
  }

 private:
  static std::int64_t factor(std::uint32_t word) { return word & 0x1ffffu; }
  /// The multiplier's result, four clocks after its operands; noise where nobody listens.
  std::int64_t product(const Probe& p) {
    const int scene = p.wave.scene;
    const bool charge = scene == Design::S::charge_attract || scene == Design::S::charge_repel;
    if (p.t == 7 && charge) return (operand_ / 256) * (operand_ / 256);
    if (p.t == 7) return operand_ * factor(p.memory.slot(scene, 3));
    if (p.t == 10) return slope_operand_ * factor(p.memory.slot(scene, 6));
    if (p.t == 14) return p.wave.velocity * factor(p.memory.slot(scene, 10));
    return static_cast<std::int64_t>(random_.bits()) / 2048;
  }

  Random random_;
  Next next_;
  std::shared_ptr<Probe> probe_;
  std::int64_t number_ = 0, operand_ = 0, slope_operand_ = 0;
};

/// Observer: at the end of every wave that no reset broke, calls check(probe, rtl, twin), which
/// returns nullptr or the property that is broken; forget() at every reset.
template <class Check>
class AfterWave {
 public:
  AfterWave(std::shared_ptr<Probe> probe, Check check)
      : probe_(std::move(probe)), check_(std::move(check)) {}

  template <class In, class Rtl, class Twin>
  const char* operator()(const In&, const Rtl& rtl, const Twin& twin, bool in_reset) {
    if (in_reset) {
      whole_ = false;
      check_.forget();
    } else if (probe_->t == 1) {
      whole_ = true;
    }
    return whole_ && probe_->t == 28 ? check_(*probe_, rtl, twin) : nullptr;
  }

 private:
  std::shared_ptr<Probe> probe_;
  Check check_;
  bool whole_ = false;
};

/// A number with the low bits of `low` and, now and then, an extreme one.
inline std::int64_t any_word(Random& random) {
  switch (random.below(8)) {
    case 0:
      return 0;
    case 1:
      return static_cast<std::int64_t>(random.bits() & 0xffffffff);
    case 2:
      return 0xffffffff;
    case 3:
      return std::int64_t{1} << random.below(32);
    case 4:
      return (std::int64_t{1} << random.below(32)) - 1;
    default:
      return static_cast<std::int64_t>(random.bits() & 0xffffffff) >> random.below(32);
  }
}

/// Positions: anywhere, at the ends, or near one of the scene's own counts.
inline std::int32_t any_position(Random& random, const Memory& memory, int scene) {
  constexpr std::int32_t end = 131071;
  if (random.one_in(16)) return random.coin() ? end : -end - 1;
  if (random.one_in(8)) return static_cast<std::int32_t>(random.between(-end - 1, end));
  const int slot = static_cast<int>(1 + random.below(2));
  const std::int64_t face =
      decode_word(Design::f.scene_offset, memory.word(scene * 32 + slot)) >> 8;
  const std::int64_t spread = std::int64_t{1} << random.below(12);
  std::int64_t p = face + random.between(-spread, spread);
  p = p > end ? end : p < -end - 1 ? -end - 1 : p;
  return static_cast<std::int32_t>(p);
}

}  // namespace feltgate::test
