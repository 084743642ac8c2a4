// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A scene block in lock-step with its twin over waves, in reset too: not every register of it has a
// reset, and all of them have a clock then. Documentation: docs/blocks/scenes.md
#pragma once

#include <string>

#include "feltgate/scene_part.hpp"
#include "scene_wave.hpp"

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
