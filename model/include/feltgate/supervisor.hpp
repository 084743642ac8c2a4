// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/supervisor.sv: arming, six causes of fault, the gates. Estimated current [1,8,8] A,
// I2t sum [0,31,2] A^2 tick. Documentation: docs/blocks/supervisor.md
#pragma once

#include <cstdint>

#include "feltgate/generated/causes.hpp"
#include "feltgate/numbers.hpp"

namespace feltgate {

/// The arithmetic of the supervisor in a number policy N, for a design D.
template <class N, class D>
struct SupervisorLaw {
  template <int Key>
  using Num = typename N::template num<Key>;
  static constexpr int part_key = D::f.current_estimate_part.key();
  static constexpr int squared_key = D::f.current_squared.key();
  static constexpr int sum_key =
      Format{0, D::f.i2t.integer + 1, D::f.i2t.fraction}.key();  // a bit above the budget's

  /// (V - Ke*w)/R from its two products; each is truncated, their difference is exact. A
  template <class X, class Y>
  static auto current_estimate(X v_over_r, Y emf_w_over_r) {
    return quantise<N, part_key, Round::truncate, Overflow::wrap>(v_over_r) -
           quantise<N, part_key, Round::truncate, Overflow::wrap>(emf_w_over_r);
  }
  /// I^2, truncated. A^2
  template <class X>
  static Num<squared_key> squared(X square) {
    return quantise<N, squared_key, Round::truncate, Overflow::wrap>(square);
  }
  /// max(sum - Inom^2, 0): what is left of the sum after a tick. A^2 tick
  template <class X>
  static Num<sum_key> cooled(Num<sum_key> sum, X nominal) {
    if (sum < nominal) return Num<sum_key>{};
    return quantise<N, sum_key, Round::truncate, Overflow::wrap>(sum - nominal);
  }
  /// sum + I^2; the caller keeps the sum below half of its range.
  static Num<sum_key> heated(Num<sum_key> sum, Num<squared_key> square) {
    return quantise<N, sum_key, Round::truncate, Overflow::wrap>(sum + square);
  }
};

template <class D>
class Supervisor {
 public:
  using Law = SupervisorLaw<Fixed, D>;

  struct In {
    bool tick = false;  ///< last clock of a tick
    bool arm = false;
    bool stop = false;
    bool clear_faults = false;  ///< only in the clock of tick
    bool kick = false;          ///< only in the clock of tick
    bool encoder_error = false;
    std::int32_t velocity = 0;     ///< raw, rad/s
    std::int32_t current_ref = 0;  ///< raw, A
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
    std::int64_t product = 0;
  };
  struct Out {
    std::int32_t current_estimate = 0;  ///< raw, A
    bool armed = false;
    bool gates_enable = false;
    std::uint8_t faults = 0;
    std::uint8_t first_fault = 0;
  };

  /// What a whole tick needs: the words of the parameter RAM and the signals in their raw integers.
  struct Words {
    std::uint32_t inverse_resistance = 0;
    std::uint32_t emf_over_resistance = 0;
    std::uint32_t nominal_current_squared = 0;
    std::uint32_t overspeed = 0;
    std::uint32_t i2t_budget = 0;
    std::uint32_t polarity_speed = 0;
    std::uint32_t polarity_current = 0;
    std::uint32_t polarity_ticks = 0;
    std::uint32_t watchdog_ticks = 0;
  };
  struct Tick {
    std::int32_t voltage_before = 0;   ///< of the tick before
    std::int32_t velocity_before = 0;  ///< of the tick before
    std::int32_t velocity = 0;         ///< of this tick
    std::int32_t current_ref = 0;      ///< of the tick before
    bool arm = false;                  ///< these three at the end of the tick
    bool clear_faults = false;
    bool kick = false;
  };

  void reset() { *this = Supervisor(); }
  const Out& out() const { return out_; }

  void clock(const In& in) {
    const bool live = out_.gates_enable;
    std::uint8_t trip = 0;
    if (in.encoder_error && bucket_ == kBucket) trip |= bit(Fault::encoder);
    if (stop_2_ && live) trip |= bit(Fault::stop);
    if ((in.wave & kWaveClocks) != 0) wave_clock(in, &trip);
    if (!warm_) sum_ = {};
    warm_ = true;
    if (in.encoder_error) bucket_ = bucket_ == kBucket ? 0 : bucket_ + 1;
    if (in.tick) {
      leak(!in.encoder_error);
      end_tick(in.arm, in.clear_faults, in.kick, trip);
    } else if (trip != 0) {
      latch(trip);
      out_.gates_enable = false;
    }
    if (!live) rest_timers();
    stop_2_ = stop_1_;
    stop_1_ = in.stop;
  }

  /// The stop input has been at this level for two clocks: tick() may be used while it stays there.
  bool steady(bool stop) const { return stop_1_ == stop && stop_2_ == stop; }

  // A tick from its first to its last clock without encoder errors and with steady(stop), in the
  // steps that change something; each stands for all clocks up to its own. The first four return
  // whether the gates fell with it.

  /// Wave clock 17; the products are those of voltage and velocity of the tick before.
  bool at_speed(const Words& words, std::int64_t v_product, std::int64_t w_product,
                std::int32_t velocity) {
    out_.current_estimate = static_cast<std::int32_t>(estimate_of(v_product, w_product));
    return magnitude_over(velocity, words.overspeed) && trip(Fault::speed);
  }
  /// Wave clock 19.
  bool at_heat(const Words& words) {
    const Sum before = sum_;
    const std::int64_t estimate = out_.current_estimate;
    sum_ = Law::heated(Law::cooled(before, nominal_of(words.nominal_current_squared)),
                       square_of(estimate * estimate, before));
    return before.raw() >= static_cast<std::int64_t>(words.i2t_budget) && trip(Fault::i2t);
  }
  /// Wave clock 22; the current is that of the tick before.
  bool at_polarity(const Words& words, std::int32_t velocity, std::int32_t current_ref) {
    runs_away_ = magnitude_over(velocity, words.polarity_speed) &&
                 magnitude_over(current_ref, words.polarity_current) &&
                 (velocity < 0) != (current_ref < 0);
    const bool trips = out_.gates_enable && runs_away_ &&
                       (polarity_ >= words.polarity_ticks || polarity_ > kLongestPolarity);
    polarity_ = runs_away_ ? polarity_ + 1 : 1;
    return trips && trip(Fault::polarity);
  }
  /// Wave clock 47, where that is not the last clock of the tick.
  bool at_watchdog(const Words& words) {
    return !kWatchdogLast && silent(words) && trip(Fault::watchdog);
  }
  /// The last clock; returns whether the watchdog closed the gates in it.
  bool at_end(const Words& words, bool arm, bool clear_faults = false, bool kick = false) {
    const bool live = out_.gates_enable;
    const bool trips = kWatchdogLast && silent(words);
    leak(true);
    end_tick(arm, clear_faults, kick, trips ? bit(Fault::watchdog) : std::uint8_t{0});
    if (!live) rest_timers();
    warm_ = true;
    return trips;
  }

  /// Whether too much heat or a wrong polarity might trip in the wave to come.
  bool near_trip(const Words& words) const {
    return sum_.raw() >= static_cast<std::int64_t>(words.i2t_budget) ||
           polarity_ >= words.polarity_ticks || polarity_ > kLongestPolarity;
  }

  /// All five. Returns the clock of the tick after which the gates fell, or -1.
  int tick(const Words& words, const Tick& in) {
    const auto coefficient = [](std::uint32_t word) {
      return static_cast<std::int64_t>(word & ((1U << D::coefficient_bits) - 1));
    };
    int fell = -1;
    if (at_speed(words, in.voltage_before * coefficient(words.inverse_resistance),
                 in.velocity_before * coefficient(words.emf_over_resistance), in.velocity)) {
      fell = 17 + kFirstWaveClock;
    }
    if (at_heat(words)) fell = 19 + kFirstWaveClock;
    if (at_polarity(words, in.velocity, in.current_ref)) fell = 22 + kFirstWaveClock;
    if (at_watchdog(words)) fell = kWatchdogClock;
    if (at_end(words, in.arm, in.clear_faults, in.kick)) fell = kWatchdogClock;
    return fell;
  }

 private:
  using Sum = fixed_of<Law::sum_key>;
  using Squared = fixed_of<Law::squared_key>;
  static constexpr int kFirstWaveClock = 2;  // clock of the tick that is wave clock 0
  static constexpr int kWatchdogClock = 47 + kFirstWaveClock;
  static constexpr bool kWatchdogLast = kWatchdogClock == D::clocks_per_tick - 1;
  static constexpr int kBucket = 7;  // encoder errors that are borne
  static constexpr std::uint32_t kLeakTicks = 1024;
  static constexpr std::uint32_t kLongestPolarity = 0xffff;    // ticks
  static constexpr std::uint32_t kLongestWatchdog = 0xffffff;  // ticks
  static constexpr std::uint32_t kWatchdogMask = 0x1ffffff;

  static constexpr std::uint64_t at(int t) { return std::uint64_t{1} << t; }
  /// Wave clocks 9, 11, 15 to 22 and 45 to 47.
  static constexpr std::uint64_t kWaveClocks =
      at(9) | at(11) | (at(23) - at(15)) | (at(48) - at(45));
  static constexpr std::uint8_t bit(Fault cause) {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(cause));
  }

  /// A product as it leaves the multiplier, with F fraction bits.
  template <int F>
  static constexpr auto product(std::int64_t raw) {
    return fixed<1, D::product_bits - 1 - F, F>::from_raw(raw);
  }
  static std::int64_t estimate_of(std::int64_t v_over_r, std::int64_t emf_w_over_r) {
    constexpr int v_fraction = D::f.voltage.fraction + D::P::inverse_resistance.fraction;
    constexpr int w_fraction = D::f.velocity.fraction + D::P::emf_over_resistance.fraction;
    return Law::current_estimate(product<v_fraction>(v_over_r), product<w_fraction>(emf_w_over_r))
        .raw();
  }
  static fixed<0, 32 - D::f.i2t.fraction, D::f.i2t.fraction> nominal_of(std::uint32_t word) {
    return fixed<0, 32 - D::f.i2t.fraction, D::f.i2t.fraction>::from_raw(word);
  }
  /// I^2 of an armed tick; nothing is added to a sum above every budget.
  Squared square_of(std::int64_t square, Sum sum) const {
    if (!out_.armed || sum.raw() > 0xffffffffLL) return {};
    return Law::squared(product<2 * D::f.current_estimate.fraction>(square));
  }
  /// |x| > limit, the limit a signed word: above a negative one everything is.
  static bool magnitude_over(std::int32_t x, std::uint32_t limit) {
    const std::int64_t wide = x;
    return (wide < 0 ? -wide : wide) > static_cast<std::int32_t>(limit);
  }

  /// A cause seen before the last clock of a tick; returns whether it closed the gates.
  bool trip(Fault cause) {
    const bool live = out_.gates_enable;
    latch(bit(cause));
    out_.gates_enable = false;
    return live;
  }
  bool silent(const Words& words) const {
    return out_.gates_enable && awake_ &&
           (watchdog_ >= words.watchdog_ticks || watchdog_ > kLongestWatchdog);
  }

  /// Operands are taken over one clock before they are compared, the result is used one after.
  void wave_clock(const In& in, std::uint8_t* trip) {
    const std::int64_t operand = operand_;
    const bool over = over_;
    const std::uint64_t w = in.wave;
    if ((w & at(9)) != 0) v_product_ = in.product;
    if ((w & at(11)) != 0) {
      out_.current_estimate = static_cast<std::int32_t>(estimate_of(v_product_, in.product));
    }
    if ((w & (at(15) | at(18))) != 0) operand_ = in.velocity;
    if ((w & at(19)) != 0) operand_ = in.current_ref;
    if ((w & (at(16) | at(17))) != 0) operand_ = sum_.raw();
    if ((w & at(20)) != 0) operand_ = polarity_;
    if ((w & at(45)) != 0) operand_ = watchdog_;
    if ((w & (at(16) | at(19) | at(20))) != 0) {
      over_ = magnitude_over(static_cast<std::int32_t>(operand), in.param);
    }
    if ((w & (at(18) | at(21) | at(46))) != 0) over_ = operand >= std::int64_t{in.param};
    if ((w & at(17)) != 0) {
      if (over) *trip |= bit(Fault::speed);
      cooled_ = Law::cooled(Sum::from_raw(operand), nominal_of(in.param));
      square_ = square_of(in.product, sum_);
    }
    if ((w & at(19)) != 0) {
      if (over) *trip |= bit(Fault::i2t);
      sum_ = Law::heated(cooled_, square_);
    }
    if ((w & at(20)) != 0) fast_ = over;
    if ((w & at(21)) != 0) {
      runs_away_ = over && fast_ && (in.velocity < 0) != (in.current_ref < 0);
    }
    if ((w & at(22)) != 0) {
      const bool long_enough = over || polarity_ > kLongestPolarity;
      if (out_.gates_enable && runs_away_ && long_enough) *trip |= bit(Fault::polarity);
      polarity_ = runs_away_ ? polarity_ + 1 : 1;
    }
    if ((w & at(47)) != 0 && out_.gates_enable && awake_ &&
        (over || watchdog_ > kLongestWatchdog)) {
      *trip |= bit(Fault::watchdog);
    }
  }

  /// The end of a tick for the encoder errors.
  void leak(bool undisturbed) {
    leak_ticks_ = (leak_ticks_ + 1) % kLeakTicks;
    if (leak_ticks_ == 0 && undisturbed && bucket_ > 0) --bucket_;
  }
  void latch(std::uint8_t trip) {
    if (out_.first_fault == 0) {
      while (((trip >> out_.first_fault) & 1U) == 0) ++out_.first_fault;
    }
    out_.faults |= trip;
  }
  /// Commands, arming and disarming; `trip` are the faults of the same clock.
  void end_tick(bool arm, bool clear_faults, bool kick, std::uint8_t trip) {
    const bool arms = arm && !asked_ && out_.first_fault == 0 && !stop_2_;
    const bool armed = (arms || (arm && out_.gates_enable)) && trip == 0;
    if (clear_faults && !arm) out_.faults = out_.first_fault = 0;
    if (trip != 0) latch(trip);
    out_.gates_enable = out_.armed = armed;
    asked_ = arm;
    if (kick) awake_ = true;
    watchdog_ = kick ? 0 : (watchdog_ + 1) & kWatchdogMask;
  }
  /// While the gates are off.
  void rest_timers() {
    polarity_ = 1;
    watchdog_ = 0;
  }

  Out out_;
  bool stop_1_ = true;
  bool stop_2_ = true;
  bool asked_ = true;  ///< the request of the tick before: high after a reset
  bool warm_ = false;
  bool awake_ = false;  ///< the watchdog has been kicked
  int bucket_ = 0;
  std::uint32_t leak_ticks_ = 0;
  std::int64_t v_product_ = 0;
  Sum sum_;
  Sum cooled_;
  Squared square_;
  bool fast_ = false;
  bool runs_away_ = false;
  std::uint32_t polarity_ = 1;
  std::uint32_t watchdog_ = 0;
  std::int64_t operand_ = 0;
  bool over_ = false;
};

}  // namespace feltgate
