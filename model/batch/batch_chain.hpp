// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs many chains of one design at once, tick by tick. The laws of the twin run in loops over
// lanes, which the compiler vectorises. Each lane has its own counts and parameter words; arming,
// scene and mode are common. Documentation: docs/engines.md
#pragma once

#include <array>
#include <cstdint>

#include "feltgate/chain_tick.hpp"

// One loop in two versions, chosen when the program starts: 64-bit products and arithmetic shifts
// of vectors came with AVX-512. Elsewhere the lanes run one after the other.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && \
    !defined(__SANITIZE_ADDRESS__)
#define FELTGATE_LANES __attribute__((flatten, target_clones("arch=x86-64-v4", "default")))
#else
#define FELTGATE_LANES
#endif

namespace feltgate {

/// A signal of every lane, as the integer of its format.
template <int Lanes>
using LaneWords = std::array<std::int64_t, Lanes>;

/// State, words and results of a batch, a row per signal.
template <class D, int Lanes>
struct BatchLanes {
  using Row = LaneWords<Lanes>;

  /// The parameters of one lane as the laws read them.
  struct Reader : ParameterReader<D, Reader> {
    Reader(const BatchLanes* of, std::size_t which) : batch(of), lane(which) {}
    const BatchLanes* batch;
    std::size_t lane;
    template <int Key>
    fixed_of<Key> get(int address) const {
      const std::int64_t word = batch->words[static_cast<std::size_t>(address)][lane];
      return Fixed::from_raw<Key>(
          decode_word(Format::from_key(Key), static_cast<std::uint32_t>(word)));
    }
  };

  alignas(64) std::array<Row, Words<D, Fixed>::count> words{};  ///< 32 bits each
  alignas(64) std::array<std::array<std::int16_t, Lanes>, D::m1> line{};
  std::size_t oldest = 0;
  int scene = 0;
  alignas(64) std::array<std::int32_t, Lanes> position{};
  alignas(64) std::array<std::int16_t, Lanes> travel{};
  alignas(64) Row velocity{}, observer{}, tau_hat{}, side{},
      scene_torque{}, ramping{}, reference{}, tau_ref{}, current{}, voltage{}, duty{};
  /// Of the last tick: 0 or 1.
  alignas(64) Row limit_torque{}, limit_ramp{}, limit_current{}, limit_voltage{}, limit_duty{},
      limit_velocity{}, limit_tau_hat{};
};

namespace batch {

template <int Key>
fixed_of<Key> number(std::int64_t raw) {
  return Fixed::from_raw<Key>(raw);
}

/// Velocity and observer.
template <bool Armed, class D, int Lanes>
FELTGATE_LANES void estimate(BatchLanes<D, Lanes>& b) {
  auto& line = b.line[b.oldest];
  for (std::size_t k = 0; k < Lanes; ++k) {
    const typename BatchLanes<D, Lanes>::Reader words(&b, k);
    EstimatorStep<D, FixedLanes> estimator;
    estimator.velocity = number<D::f.velocity.key()>(b.velocity[k]);
    estimator.tick(words, travel_difference(b.travel[k], line[k]));
    line[k] = b.travel[k];
    ObserverStep<D, FixedLanes> observer;
    observer.state = number<D::f.observer.key()>(b.observer[k]);
    observer.tick(words, Armed, number<D::f.current.key()>(b.current[k]), estimator.velocity);
    b.velocity[k] = estimator.velocity.raw();
    b.limit_velocity[k] = estimator.limit;
    b.observer[k] = static_cast<std::int64_t>(observer.state.raw());
    b.tau_hat[k] = observer.tau_hat.raw();
    b.limit_tau_hat[k] = observer.limit;
  }
}

/// The scene's torque.
template <int Scene, class D, int Lanes>
FELTGATE_LANES void render(BatchLanes<D, Lanes>& b) {
  for (std::size_t k = 0; k < Lanes; ++k) {
    const typename BatchLanes<D, Lanes>::Reader words(&b, k);
    auto side = static_cast<MembraneSide>(b.side[k]);
    b.scene_torque[k] =
        ScenesLaw<D, FixedLanes>::torque(words, Scene, scene_position<D, FixedLanes>(b.position[k]),
                                         number<D::f.velocity.key()>(b.velocity[k]), &side)
            .raw();
    b.side[k] = static_cast<std::int64_t>(side);
  }
}

/// Limit and ramp.
template <bool Armed, class D, int Lanes>
FELTGATE_LANES void limit(BatchLanes<D, Lanes>& b, int scene) {
  if (scene != b.scene) b.ramping.fill(1);  // what begin() would find, said once for all lanes
  b.scene = scene;
  for (std::size_t k = 0; k < Lanes; ++k) {
    const typename BatchLanes<D, Lanes>::Reader words(&b, k);
    using Ramp = RampLaw<D, FixedLanes>;
    Ramp ramp;
    ramp.resume(scene, b.ramping[k] != 0, number<D::f.ramp.key()>(b.reference[k]));
    ramp.begin(Armed, scene);
    ramp.limit(number<D::f.scene_torque.key()>(b.scene_torque[k]),
               words.template get<Ramp::kLimitKey>(D::A::torque_limit));
    ramp.move(words.ramp_step());
    b.ramping[k] = ramp.ramping();
    b.reference[k] = ramp.reference().raw();
    b.tau_ref[k] = ramp.tau_ref().raw();
    b.limit_torque[k] = ramp.limit_torque();
    b.limit_ramp[k] = ramp.limit_ramp();
  }
}

/// Current, voltage and duty.
template <bool Armed, Mode M, class D, int Lanes>
FELTGATE_LANES void drive(BatchLanes<D, Lanes>& b) {
  for (std::size_t k = 0; k < Lanes; ++k) {
    const typename BatchLanes<D, Lanes>::Reader words(&b, k);
    TorqueControlStep<D, FixedLanes> control;
    if constexpr (M == Mode::voltage) {
      control.voltage = number<D::f.voltage.key()>(b.voltage[k]);  // of the tick before
    }
    control.tick(words, Armed, M, number<D::f.torque.key()>(b.tau_ref[k]),
                 number<D::f.torque.key()>(b.tau_hat[k]),
                 number<D::f.velocity.key()>(b.velocity[k]));
    b.current[k] = control.current.raw();
    b.voltage[k] = control.voltage.raw();
    b.duty[k] = control.duty.raw();
    b.limit_current[k] = control.limit.current;
    b.limit_voltage[k] = control.limit.voltage;
    b.limit_duty[k] = control.limit.duty;
  }
}

}  // namespace batch

template <class D, int Lanes = 32>
class BatchChain {
 public:
  static constexpr int lanes = Lanes;
  static_assert(D::f.observer.width() <= 64, "a lane's signal is a 64-bit integer");

  BatchChain() { reset(); }

  /// State after a reset, and the design's parameters in every lane.
  void reset() {
    lanes_ = {};
    lanes_.ramping.fill(1);
    for (const ParameterInfo& p : D::parameters) {
      for (int k = 0; k < Lanes; ++k) {
        set_word(k, p.address, static_cast<std::uint32_t>(p.raw & 0xffffffff));
      }
    }
  }

  /// A parameter word of one lane, as the host writes it.
  void set_word(int lane, int address, std::uint32_t word) {
    lanes_.words[static_cast<std::size_t>(address) % lanes_.words.size()]
                [static_cast<std::size_t>(lane)] = word;
  }
  /// What the next tick samples in one lane [count].
  void set_counts(int lane, std::int32_t position, std::int16_t travel) {
    lanes_.position[static_cast<std::size_t>(lane)] = position;
    lanes_.travel[static_cast<std::size_t>(lane)] = travel;
  }

  /// Before a tick whose torque may jump: it ramps, in every lane.
  void restart() { lanes_.ramping.fill(1); }

  /// One tick of every lane.
  void tick(bool armed, int scene, Mode mode) {
    if (armed) {
      batch::estimate<true>(lanes_);
    } else {
      batch::estimate<false>(lanes_);
    }
    lanes_.oldest = lanes_.oldest + 1 == lanes_.line.size() ? 0 : lanes_.oldest + 1;
    render<0>(scene);
    if (armed) {
      batch::limit<true>(lanes_, scene);
    } else {
      batch::limit<false>(lanes_, scene);
    }
    if (armed) {
      drive<true>(mode);
    } else {
      drive<false>(mode);
    }
  }

  /// Results of the last tick, a row per signal.
  const BatchLanes<D, Lanes>& results() const { return lanes_; }

 private:
  template <int Scene>
  void render(int scene) {
    if constexpr (Scene == 16) {
      batch::render<-1>(lanes_);
    } else if (scene == Scene) {
      batch::render<Scene>(lanes_);
    } else {
      render<Scene + 1>(scene);
    }
  }
  template <bool Armed>
  void drive(Mode mode) {
    switch (mode) {
      case Mode::voltage:
        return batch::drive<Armed, Mode::voltage>(lanes_);
      case Mode::open_loop:
        return batch::drive<Armed, Mode::open_loop>(lanes_);
      default:
        return batch::drive<Armed, Mode::closed_loop>(lanes_);
    }
  }

  BatchLanes<D, Lanes> lanes_;
};

}  // namespace feltgate
