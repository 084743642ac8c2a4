// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/safety/supervisor.sv: arming, seven of the fifteen causes of fault, and the
// gate enable. A fault is latched, and the gate enable falls, one clock after its cause is seen.
// Estimated current [1,8,8] A, I2t sum [0,31,2] A^2 tick. Documentation: docs/blocks/supervisor.md
#pragma once

#include <cstdint>

#include "feltgate/generated/causes.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/numbers.hpp"
#include "feltgate/runaway.hpp"

namespace feltgate {

/// The arithmetic of the supervisor in a number policy N, for a design D.
template <class N, class D>
struct SupervisorLaw {
  template <int Key>
  using Num = typename N::template num<Key>;
  static constexpr int part_key = D::f.current_estimate_part.key();
  static constexpr int squared_key = D::f.current_squared.key();
  static constexpr int sum_key =
      Format{0, D::f.i2t.integer + 1, D::f.i2t.fraction}.key();  // one bit more than the budget

  /// (V - Ke*w)/R [A] from its two products; each is truncated, their difference is exact.
  template <class X, class Y>
  static auto current_estimate(X v_over_r, Y emf_w_over_r) {
    return quantise<N, part_key, Round::truncate, Overflow::wrap>(v_over_r) -
           quantise<N, part_key, Round::truncate, Overflow::wrap>(emf_w_over_r);
  }
  /// I^2 [A^2], truncated.
  template <class X>
  static Num<squared_key> squared(X square) {
    return quantise<N, squared_key, Round::truncate, Overflow::wrap>(square);
  }
  /// max(sum - Inom^2, 0) [A^2 tick]: the sum that is left after a tick.
  template <class X>
  static Num<sum_key> cooled(Num<sum_key> sum, X nominal) {
    if (sum < nominal) return Num<sum_key>{};
    return quantise<N, sum_key, Round::truncate, Overflow::wrap>(sum - nominal);
  }
  /// sum + I^2; the caller must keep the sum below half of its range.
  static Num<sum_key> heated(Num<sum_key> sum, Num<squared_key> square) {
    return quantise<N, sum_key, Round::truncate, Overflow::wrap>(sum + square);
  }
};

/// The supervisor of design D, clock by clock or in the steps of a tick.
template <class D>
class Supervisor {
 public:
  using Law = SupervisorLaw<Fixed, D>;
  using T = Map::T;
  /// Clocks of the tick after which a cause may have closed the gates.
  static constexpr int speed_clock = Map::first_wave_clock + T::speed;
  static constexpr int heat_clock = Map::first_wave_clock + T::heat;
  static constexpr int polarity_clock = Map::first_wave_clock + T::polarity;
  static constexpr int watchdog_clock = Map::first_wave_clock + T::watchdog;
  static constexpr std::uint32_t wait_ticks =  // of a request to arm, at most
      D::clock_hz / 1000 * Map::arm_wait_ms / D::clocks_per_tick - 1;

  struct In {
    bool tick = false;  ///< last clock of a tick
    /// Start of a PWM period; not set where ticks cannot stop, as in the core's twin.
    bool period_start = false;
    bool host = false;          ///< the host has control, not the panel
    bool host_arm = false;      ///< the host's request
    bool arm = false;           ///< the panel's request
    bool disarm = false;        ///< requests do not count in this tick
    bool stop = false;          ///< the input was active since the last clock, however shortly
    bool clear_faults = false;  ///< only in the clock of tick
    bool kick = false;          ///< only in the clock of tick
    bool encoder_error = false;
    std::int32_t velocity = 0;     ///< raw, rad/s
    std::int32_t current_ref = 0;  ///< raw, A
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
    std::int64_t product = 0;
    std::uint16_t trips = 0;    ///< faults that other blocks found, one bit per cause
    bool axis_silent = false;   ///< another axis does not request arming, or a sensor starts
    bool axis_blocked = false;  ///< another axis, or a sensor, is not ready
    /// The request of the host or the panel, whichever has control.
    bool arm_request() const { return (host ? host_arm : arm) && !disarm; }
  };
  struct Out {
    std::int32_t current_estimate = 0;  ///< raw, A
    bool armed = false;
    bool gates_enable = false;
    bool unkicked = D::require_watchdog != 0;  ///< arming waits for the watchdog's first kick
    std::uint16_t faults = 0;
    std::uint8_t first_fault = 0;
  };

  /// The inputs of a whole tick: words of the parameter RAM, and the signals as raw integers
  /// (Tick).
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

  /// Resets all but the heat: a reset does not cool the motor.
  void reset() {
    const Sum heat = sum_;
    *this = Supervisor();
    sum_ = heat;
  }
  const Out& out() const { return out_; }
  /// Whether nothing refuses a request of the side that has control.
  bool ready(bool host) const { return able() && counts(host); }
  /// Whether that side asks for arming, and its request counts.
  bool asks(const In& in) const { return in.arm_request() && counts(in.host); }

  void clock(const In& in) {
    const bool live = out_.gates_enable;
    std::uint16_t trip = in.trips;
    if (in.encoder_error && errors_ == kBorne) trip |= fault_bit(Fault::encoder);
    const bool stopped_now = stopped(in.stop);
    const bool dealt_with = stop_2_ && !live && out_.first_fault == 0;
    if (in.period_start && tickless_ == kTickPeriods) trip |= fault_bit(Fault::tick);
    if (stop_2_ && live) trip |= fault_bit(Fault::stop);
    if ((in.wave & kWaveClocks) != 0) wave_clock(in, &trip);
    if (in.encoder_error) errors_ = errors_ == kBorne ? 0 : errors_ + 1;
    if (in.tick) {
      forgive(!in.encoder_error);
      end_tick(in, trip);
    } else if (trip != 0) {
      latch(trip);
      out_.gates_enable = false;
    }
    if (!in.tick) stop_seen_ |= stop_2_;
    stop_2_ = stop_1_;
    stop_1_ = stopped_now;
    stopped_ = stopped_now && !dealt_with;
    if (in.tick && !tick_before_) {
      tickless_ = 0;
    } else if (in.period_start && tickless_ < kTickPeriods) {
      ++tickless_;
    }
    tick_before_ = in.tick;
  }

  /// Whether the gates are cleared before the next clock edge, while the stop input is `stop`.
  bool stopped(bool stop) const { return stop || stopped_; }

  /// Whether the stop has settled at this level of its input; tick() may be used while it stays
  /// there. That a fault keeps the latch of a held stop is left to clock(): no output shows it.
  bool steady(bool stop) const {
    const bool latched = stopped(stop);
    if (stop_1_ != latched || stop_2_ != latched) return false;
    return !stopped_ || out_.gates_enable || out_.first_fault != 0;
  }

  /// Latches a cause, of this or another block, before the last clock of a tick; returns whether it
  /// closed the gates.
  bool trip(Fault cause) {
    const bool live = out_.gates_enable;
    latch(fault_bit(cause));
    out_.gates_enable = false;
    return live;
  }

  // A tick without encoder errors and with steady(stop), from its first to its last clock, in five
  // steps; each step stands for all clocks up to its own. The first four return whether the gates
  // closed in it.

  /// Clock speed_clock; the products use voltage and velocity of the tick before.
  bool at_speed(const Words& words, std::int64_t v_product, std::int64_t w_product,
                std::int32_t velocity) {
    out_.current_estimate = static_cast<std::int32_t>(estimate_of(v_product, w_product));
    return over(velocity, words.overspeed) && trip(Fault::speed);
  }
  /// Clock heat_clock.
  bool at_heat(const Words& words) {
    const bool too_hot = sum_.raw() >= std::int64_t{words.i2t_budget};
    const std::int64_t estimate = out_.current_estimate;
    sum_ = Law::heated(Law::cooled(sum_, nominal_of(words.nominal_current_squared)),
                       square_of(estimate * estimate));
    return too_hot && trip(Fault::i2t);
  }
  /// Clock polarity_clock; the current is that of the tick before.
  bool at_polarity(const Words& words, std::int32_t velocity, std::int32_t current_ref) {
    runaway_.compare_growth(runaway_.gain(velocity), velocity, words.polarity_speed);
    runaway_.compare_current(current_ref, words.polarity_current);
    runaway_.turn(velocity, current_ref, words.polarity_ticks, out_.gates_enable);
    return out_.gates_enable && runaway_.due() && trip(Fault::polarity);
  }
  /// Clock watchdog_clock; does nothing where that is the last clock of the tick.
  bool at_watchdog(const Words& words) {
    return !kWatchdogLast && silent(words) && trip(Fault::watchdog);
  }
  /// The last clock; returns whether the watchdog closed the gates.
  bool at_end(const Words& words, const In& in) {
    const bool trips = kWatchdogLast && silent(words);
    forgive(true);
    end_tick(in, trips ? fault_bit(Fault::watchdog) : std::uint16_t{0});
    return trips;
  }

  /// Whether too much heat or a wrong polarity might trip in the next wave.
  bool near_trip(const Words& words) const {
    return sum_.raw() >= std::int64_t{words.i2t_budget} || runaway_.near(words.polarity_ticks);
  }

  /// Whether the watchdog would trip; valid in any clock of the tick.
  bool watchdog_due(const Words& words) const { return silent(words); }
  /// Number of further encoder errors that are tolerated.
  int errors_left() const { return kBorne - errors_; }

  /// All five steps. Returns the clock of the tick after which the gates closed, or -1.
  int tick(const Words& words, const Tick& in) {
    const auto coefficient = [](std::uint32_t word) {
      return static_cast<std::int64_t>(word & ((1U << D::coefficient_bits) - 1));
    };
    int fell = -1;
    if (at_speed(words, in.voltage_before * coefficient(words.inverse_resistance),
                 in.velocity_before * coefficient(words.emf_over_resistance), in.velocity)) {
      fell = speed_clock;
    }
    if (at_heat(words)) fell = heat_clock;
    if (at_polarity(words, in.velocity, in.current_ref)) fell = polarity_clock;
    if (at_watchdog(words)) fell = watchdog_clock;
    In last;
    last.arm = in.arm;
    last.clear_faults = in.clear_faults;
    last.kick = in.kick;
    if (at_end(words, last)) fell = watchdog_clock;
    return fell;
  }

 private:
  using Sum = fixed_of<Law::sum_key>;
  using Squared = fixed_of<Law::squared_key>;
  using Nominal = fixed<0, 32 - D::f.i2t.fraction, D::f.i2t.fraction>;  ///< of its square
  static constexpr bool kWatchdogLast = watchdog_clock == D::clocks_per_tick - 1;
  /// PWM periods that contain at least one tick.
  static constexpr int kTickPeriods = (D::clocks_per_tick + D::pwm_period - 1) / D::pwm_period;
  static constexpr int kBorne = Map::errors_borne;  // encoder errors that are tolerated
  static constexpr std::uint32_t kForgiveTicks = 1u << Map::forgive_bits;
  static constexpr std::uint32_t kLongestKickless = 1u << Map::kickless_bits;
  static constexpr std::uint32_t kKicklessMask = 2 * kLongestKickless - 1;

  static constexpr std::uint64_t at(int t) { return std::uint64_t{1} << t; }
  /// Wave clocks in which a value is taken or compared.
  static constexpr std::uint64_t kWaveClocks =
      at(T::estimate_part) | at(T::current_estimate) | at(T::speed_size) | at(T::too_fast) |
      at(T::speed) | at(T::nominal) | at(T::cooled) | at(T::current_squared) | at(T::too_hot) |
      at(T::heat) | at(T::growth_size) | at(T::growth) | at(T::strong_size) | at(T::strong) |
      at(T::window_over) | at(T::polarity) | at(T::silent) | at(T::watchdog);

  /// A product of the multiplier, with F fraction bits.
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
  static Nominal nominal_of(std::uint32_t word) {
    return Nominal::from_raw(negative(word) ? 0 : word);
  }
  /// Whether a word is negative; a negative limit counts as 0.
  static bool negative(std::uint32_t word) { return (word >> 31) != 0; }
  /// I^2 of an armed tick; 0 where the sum is above every budget already.
  Squared square_of(std::int64_t square) const {
    if (!out_.armed || sum_.raw() > 0xffffffffLL) return {};
    return Law::squared(product<2 * D::f.current_estimate.fraction>(square));
  }
  static bool over(std::int32_t x, std::uint32_t limit) { return Runaway<D>::over(x, limit); }
  /// Whether a counter has reached its limit; `longest` is the largest limit.
  static bool expired(std::uint32_t ticks, std::uint32_t limit, std::uint32_t longest) {
    return ticks >= limit || ticks >= longest;
  }

  bool too_long(std::uint32_t limit) const {
    return negative(limit) || expired(kickless_ticks_, limit, kLongestKickless);
  }
  bool silent(const Words& words) const {
    return out_.gates_enable && awake_ && too_long(words.watchdog_ticks);
  }

  /// The takings and comparisons in one clock of the wave; signals are taken one clock before.
  void wave_clock(const In& in, std::uint16_t* trip) {
    const auto now = [&in](int t) { return (in.wave & at(t)) != 0; };
    if (now(T::estimate_part)) v_product_ = in.product;
    if (now(T::current_estimate)) {
      out_.current_estimate = static_cast<std::int32_t>(estimate_of(v_product_, in.product));
    }
    if (now(T::speed) && too_fast_) *trip |= fault_bit(Fault::speed);
    if (now(T::too_fast)) too_fast_ = over(signal_, in.param);

    if (now(T::heat)) {
      if (too_hot_) *trip |= fault_bit(Fault::i2t);
      sum_ = Law::heated(cooled_, square_);
    }
    if (now(T::cooled)) cooled_ = Law::cooled(sum_, nominal_);
    if (now(T::nominal)) nominal_ = nominal_of(in.param);
    if (now(T::current_squared)) square_ = square_of(in.product);
    if (now(T::too_hot)) too_hot_ = sum_.raw() >= std::int64_t{in.param};

    if (now(T::polarity)) {
      runaway_.turn(in.velocity, in.current_ref, window_ticks_, out_.gates_enable);
      if (runaway_.due()) *trip |= fault_bit(Fault::polarity);
    }
    if (now(T::window_over)) window_ticks_ = in.param;
    if (now(T::growth)) runaway_.compare_growth(signal_, in.velocity, in.param);
    if (now(T::strong)) runaway_.compare_current(signal_, in.param);

    if (now(T::watchdog) && out_.gates_enable && awake_ && silent_)
      *trip |= fault_bit(Fault::watchdog);
    if (now(T::silent)) silent_ = too_long(in.param);

    if (now(T::speed_size)) signal_ = in.velocity;
    if (now(T::growth_size)) signal_ = runaway_.gain(in.velocity);
    if (now(T::strong_size)) signal_ = in.current_ref;
  }

  /// End of a tick: every kForgiveTicks ticks, one encoder error is forgiven if `undisturbed`.
  void forgive(bool undisturbed) {
    forgive_ticks_ = (forgive_ticks_ + 1) % kForgiveTicks;
    if (forgive_ticks_ == 0 && undisturbed && errors_ > 0) --errors_;
  }
  void latch(std::uint16_t trip) {
    if (out_.first_fault == 0) {
      while (((trip >> out_.first_fault) & 1U) == 0) ++out_.first_fault;
    }
    out_.faults |= trip;
  }
  /// Whether there is no fault, no stop and no missing first kick.
  bool able() const { return out_.first_fault == 0 && !stop_2_ && !stop_seen_ && !out_.unkicked; }
  /// Whether a request of this side counts; a change of control refuses one that holds the gates.
  bool counts(bool host) const {
    return (host ? host_counts_ : panel_counts_) && !(out_.gates_enable && host != host_);
  }
  /// End of a tick: commands, arming and disarming. `trip`: faults of the same clock.
  void end_tick(const In& in, std::uint16_t trip) {
    const bool live = out_.gates_enable;
    const bool handed = in.host != host_;
    const bool in_time = handed || kickless_ticks_ < wait_ticks;
    const bool may_arm =
        in.arm_request() && ready(in.host) && trip == 0 && (live || (!in.axis_blocked && in_time));
    const bool arms = may_arm && !in.axis_silent;
    const bool waits = may_arm && in.axis_silent && !live;
    host_ = in.host, stop_seen_ = false;
    host_counts_ = !in.host_arm || (in.host && (arms || waits));
    panel_counts_ = !in.arm || (!in.host && (arms || waits));
    const bool counted = live ? arms && !in.kick : waits && !handed;
    kickless_ticks_ = counted ? (kickless_ticks_ + 1) & kKicklessMask : 0;
    if (in.clear_faults && !in.arm_request()) out_.faults = 0, out_.first_fault = 0;
    if (trip != 0) latch(trip);
    out_.gates_enable = out_.armed = arms;
    if (in.kick) awake_ = true, out_.unkicked = false;
  }

  Out out_;
  bool stopped_ = false;  ///< latch of the stop; the clocks of a reset release it
  bool stop_1_ = true, stop_2_ = true;
  bool stop_seen_ = false;  ///< in this tick
  bool tick_before_ = false;
  int tickless_ = 0;                                 ///< PWM periods that began since the last tick
  bool host_ = false;                                ///< the host had control in the tick before
  bool host_counts_ = false, panel_counts_ = false;  ///< it was low, and was not refused since
  bool awake_ = false;                               ///< the watchdog has been kicked
  int errors_ = 0;                                   ///< encoder errors that are not forgiven yet
  std::uint32_t forgive_ticks_ = 0;
  std::int32_t signal_ = 0;  ///< value to compare in the next clock
  bool too_fast_ = false;
  Runaway<D> runaway_;
  std::uint32_t window_ticks_ = 0;  ///< polarity_ticks from the bus; the RTL keeps the comparison
  std::int64_t v_product_ = 0;
  Sum sum_ = Sum::from_raw(D::i2t_start);
  Nominal nominal_;
  Sum cooled_;
  Squared square_;
  bool too_hot_ = false, silent_ = false;
  std::uint32_t kickless_ticks_ = 0;  ///< with closed gates: ticks for which a request has waited
};

}  // namespace feltgate
