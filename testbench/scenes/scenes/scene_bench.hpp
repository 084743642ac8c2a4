// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A scene block in lock-step with its twin over waves, in reset too: not every register of it has a
// reset, and all of them have a clock then. Documentation: docs/blocks/scenes.md
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "feltgate/scene_part.hpp"
#include "feltgate/words.hpp"
#include "lock_step.hpp"

namespace feltgate::test {

#ifdef FELTGATE_ROUNDING
/// The design with another rounding.
struct Design : FELTGATE_DESIGN {
  static constexpr Round rounding = FELTGATE_ROUNDING;
};
#else
using Design = FELTGATE_DESIGN;
#endif
using A = Design::A;
using S = Design::S;
constexpr Format kTorque = Design::f.torque;
constexpr int kPartWidth = Design::f.scene_part.width();
constexpr std::int32_t kEnd = 131071;  ///< of the positions

constexpr bool is_charge(int scene) {
  return scene == S::charge_attract || scene == S::charge_repel;
}

/// The parameter RAM: the words as they are and as a law takes them.
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
  /// The content of the bus in clock t of a wave.
  std::uint32_t slot(int scene, int t) const {
    if (t < 0 || t >= Map::wave_length) return 0;
    return word(((Map::scene_slots >> t) & 1u) != 0 ? scene * 32 + t : t);
  }
  /// A coefficient of the scene, without sign.
  std::int64_t factor(int scene, int t) const {
    return slot(scene, t) & ((std::uint32_t{1} << Design::coefficient_bits) - 1);
  }
  /// The scene's reference, in 1/256 count.
  std::int64_t reference(int scene) const {
    return decode_word(Design::f.scene_offset, slot(scene, Map::T::scene_distance));
  }
  const Words<Design, Fixed>& words() const { return words_; }

 private:
  std::array<std::uint32_t, 512> ram_{};
  Words<Design, Fixed> words_;
};

/// The inputs at the start of a wave.
struct Wave {
  bool armed = true;
  int scene = 0;
  std::int32_t position = 0;             ///< 18 bits
  std::int64_t velocity = 0;             ///< raw
  int length = kShortest;                ///< clocks
  int disarmed_from = Map::wave_length;  ///< the clock in which a fault takes the arming away
  std::int64_t law_torque = 0;           ///< of a program, raw
  bool law_late = false;

  static constexpr int kShortest = Map::T::torque_limited + 2;
};

/// The data that stimulus and observer share.
struct Probe {
  Memory memory;
  Wave wave;
  int t = -1;  ///< clock of the wave; -1 in reset
};

/// The inputs of a scene block in one clock.
struct Bus {
  bool armed = false;
  std::uint64_t wave = 0;
  std::uint32_t param = 0;
  std::int64_t product = 0;
  std::int64_t face_gap = 0;  ///< whole counts of what is on the parameter bus, less the position
  std::int64_t gap = 0;       ///< the same of the reference, held
  std::int64_t distance = 0;  ///< of the reference with its fraction, in the clock after its word
  bool over_limit = false;    ///< from the limiter
  std::int64_t law_torque = 0;
  bool law_late = false;
};

/// reference - position, in 1/256 count; a charge's centre has no fraction that counts.
inline std::int64_t distance_of(const Memory& memory, const Wave& wave) {
  const std::int64_t reference = memory.reference(wave.scene);
  return (is_charge(wave.scene) ? reference & ~std::int64_t{255} : reference) -
         std::int64_t{256} * wave.position;
}

/// Waves from next(memory, wave_number), which may write the memory. Block turns a wave and a bus
/// into inputs: static In in(const Wave&, const Bus&). On average every `reset_distance` clocks the
/// block is reset, if that is not 0; a wave that this breaks begins anew.
template <class Block, class Next>
class Waves {
 public:
  Waves(std::uint64_t seed, Next next, std::shared_ptr<Probe> probe, std::uint32_t reset_distance)
      : random_(seed), next_(std::move(next)), probe_(std::move(probe)), resets_(reset_distance) {}

  auto operator()(std::int64_t clock) {
    Probe& p = *probe_;
    if (clock == 0) p = Probe{};  // a run starts: from the design's words
    if (clock > kIdle && left_ == 0 && resets_ != 0 && random_.one_in(resets_)) {
      left_ = 1 + static_cast<int>(random_.below(8));
    }
    const bool reset = clock < kIdle || left_ > 0;
    if (left_ > 0) --left_;
    if (reset) {
      p.t = -1;
    } else if (p.t < 0 || ++p.t >= p.wave.length) {
      p.wave = next_(p.memory, number_++);
      p.t = 0;
    }
    return typename Block::Clocked::In{Block::in(p.wave, bus(p)), reset};
  }

 private:
  static constexpr std::int64_t kIdle = 6;  // in reset at power-up

  Bus bus(const Probe& p) {
    const Wave& w = p.wave;
    Bus bus;
    bus.armed = w.armed && p.t < w.disarmed_from;
    bus.wave = p.t < 0 ? 0 : std::uint64_t{1} << p.t;
    bus.param = p.memory.slot(w.scene, p.t);
    bus.product = product(p);
    bus.face_gap = (decode_word(Design::f.scene_offset, bus.param) >> 8) - w.position;
    bus.gap = gap_;
    bus.distance = p.t == Map::T::scene_distance + 1 ? distance_of(p.memory, w) : bus.product;
    bus.law_torque = w.law_torque;
    bus.law_late = w.law_late;
    if (p.t != Map::T::law_torque) {  // nobody looks
      bus.law_torque = decode_word(kTorque, static_cast<std::uint32_t>(bus.product));
      bus.law_late = (bus.product & 1) != 0;
    }
    if (p.t == Map::T::scene_distance) gap_ = bus.face_gap;
    bus.over_limit = p.t == Map::T::charge_core ? beyond_ : random_.coin();
    if (p.t == Map::T::charge_width_limited) {
      constexpr Format width{1, Design::f.limiter.width() - 1, 0};
      const std::int64_t limit = decode_word(width, bus.param);
      beyond_ = gap_ > limit || gap_ < -limit;
    }
    return bus;
  }
  /// The multiplier's result; noise in clocks in which no block reads it.
  std::int64_t product(const Probe& p) {
    const Wave& w = p.wave;
    const std::int64_t distance = distance_of(p.memory, w);
    if (p.t == Map::M::charge_square && is_charge(w.scene)) {
      return distance * decode_word({1, 17, 0}, static_cast<std::uint32_t>(distance >> 8));
    }
    if (p.t == Map::M::scene_stiffness) {
      return distance * p.memory.factor(w.scene, Map::W::scene_stiffness);
    }
    if (p.t == Map::M::charge_slope) {
      return distance * p.memory.factor(w.scene, Map::W::charge_slope);
    }
    if (p.t == Map::M::scene_damping) {
      return w.velocity * p.memory.factor(w.scene, Map::W::scene_damping);
    }
    return static_cast<std::int64_t>(random_.bits()) / 2048;
  }

  Random random_;
  Next next_;
  std::shared_ptr<Probe> probe_;
  std::uint32_t resets_;
  std::int64_t number_ = 0, gap_ = 0;
  int left_ = 0;
  bool beyond_ = false;
};

/// Waves that a test lists by number.
template <class F>
struct Listed {
  F f;
  Wave operator()(Memory& memory, std::int64_t number) { return f(memory, number); }
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
  if (random.one_in(16)) return random.coin() ? kEnd : -kEnd - 1;
  if (random.one_in(8)) return static_cast<std::int32_t>(random.between(-kEnd - 1, kEnd));
  const int slot = static_cast<int>(Map::T::scene_distance + random.below(2));
  const std::int64_t face =
      decode_word(Design::f.scene_offset, memory.word(scene * 32 + slot)) >> 8;
  const std::int64_t spread = std::int64_t{1} << random.below(12);
  const std::int64_t p = face + random.between(-spread, spread);
  return static_cast<std::int32_t>(p > kEnd ? kEnd : p < -kEnd - 1 ? -kEnd - 1 : p);
}

/// Velocities of every size and sign, the ends among them.
inline std::int64_t any_velocity(Random& random) {
  if (random.one_in(8)) return random.coin() ? INT32_MAX : INT32_MIN;
  return static_cast<std::int32_t>(random.bits()) >> random.below(24);
}

}  // namespace feltgate::test

namespace feltgate::test {

/// A twin that is clocked in reset, too.
template <class Twin>
struct ClockedInReset {
  struct In {
    typename Twin::In port;
    bool reset = false;
  };
  using Out = typename Twin::Out;
  void reset() {}
  void clock(const In& in) {
    if (in.reset) twin.reset();
    twin.clock(in.port);
    if (in.reset) twin.reset();
  }
  const Out& out() const { return twin.out(); }
  Twin twin;
};

/// What each test's Block is made of: the Verilated class and the twin.
template <class V, class T>
struct BlockOf {
  using Rtl = V;
  using Twin = T;
  using Clocked = ClockedInReset<T>;
};

namespace detail {

template <class V, class = void>
struct HasReset : std::false_type {};
template <class V>
struct HasReset<V, std::void_t<decltype(std::declval<V&>().rst_ni)>> : std::true_type {};

/// The bench's reset stands beside the ports: the stimulus drives those. Unselected for two clocks,
/// a scene block shows 0.
template <class Block>
struct Idle : Block::Rtl {
  explicit Idle(VerilatedContext* context) : Block::Rtl(context) {
    Block::drive(*this, typename Block::Twin::In{});
    if constexpr (HasReset<typename Block::Rtl>::value) Block::Rtl::rst_ni = 0;
    for (const int clock : {0, 1, 0, 1}) {
      this->clk_i = clock & 1;
      this->eval();
    }
  }
  int rst_ni = 0;
};

template <class Block>
struct Ports {
  static void drive(Idle<Block>& rtl, const typename Block::Clocked::In& in) {
    typename Block::Rtl& ports = rtl;
    Block::drive(ports, in.port);
    if constexpr (HasReset<typename Block::Rtl>::value) ports.rst_ni = !in.reset;
  }
  template <class Check>
  static void compare(Check& check, const Idle<Block>& rtl, const typename Block::Twin::Out& out) {
    Block::compare(check, rtl, out);
  }
};

/// Calls check.at(probe, rtl, twin) in every clock of a wave, check.forget() in reset.
template <class Block, class Check>
class InWaves {
 public:
  InWaves(std::shared_ptr<Probe> probe, Check check)
      : probe_(std::move(probe)), check_(std::move(check)) {}

  const char* operator()(const typename Block::Clocked::In& in, const Idle<Block>& rtl,
                         const typename Block::Clocked& twin, bool in_reset) {
    if (in.reset || in_reset) {
      check_.forget();
      return nullptr;
    }
    return check_.at(*probe_, rtl, twin.twin);
  }

 private:
  std::shared_ptr<Probe> probe_;
  Check check_;
};

}  // namespace detail

/// Waves of next() in lock-step, each clock of them watched by `check`: forget() in reset, and
/// at(probe, rtl, twin) after the edge, which returns nullptr or the property that is broken.
template <class Block, class Next, class Check>
void run_waves(const char* block, std::uint64_t seed, Next next, Check check, std::int64_t clocks,
               std::uint32_t reset_distance = 0) {
  const auto probe = std::make_shared<Probe>();
  LockStep<detail::Idle<Block>, typename Block::Clocked, detail::Ports<Block>> bench(block, seed);
  bench.run(Waves<Block, Next>(seed + 1, std::move(next), probe, reset_distance), clocks, {},
            detail::InWaves<Block, Check>(probe, std::move(check)));
}

/// The clock after whose edge all that a scene renders stands.
constexpr int kRendered = Map::T::scene_torque;

/// A part as the torque that it is rounded to.
inline std::int64_t rounded(std::int64_t part) {
  using Law = ScenePartLaw<Design, Fixed>;
  return Law::rounded(Law::Part::from_raw(part)).raw();
}

}  // namespace feltgate::test
