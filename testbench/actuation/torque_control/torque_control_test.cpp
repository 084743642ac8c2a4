// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// torque_control: RTL against twin on every clock, its law by hand, and its distance from quad
// precision. The loops through the observer come first. docs/blocks/torque_control.md
#include <Vtorque_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "../../estimators/lowpass/exact.hpp"
#include "../../wave/mult/mult_twin.hpp"
#include "../limiter/limiter_twin.hpp"
#include "catch.hpp"
#include "feltgate/dob.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/generated/reader.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/torque_control.hpp"
#include "feltgate/words.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

// Twin of rtl/core/actuation/torque_control.sv, clock by clock, by the law of the chain; the limits
// are the limiter's.

namespace feltgate {

/// Clocked twin.
template <class D>
class TorqueControl {
 public:
  using Law = TorqueControlLaw<D, Fixed>;

  struct In {
    bool armed = false;
    Mode mode = Mode::closed_loop;
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
    std::int64_t product = 0;
    std::int64_t tau_ref = 0;
    std::int64_t limited = 0;
    bool over_limit = false;
  };
  struct Out {
    std::int64_t early_term = 0;  ///< value for the limiter, a clock before the limit's word
    std::int64_t late_term = 0;   ///< value for the limiter, in the clock of the limit's word
    std::int64_t addend = 0;      ///< difference `applied` - `limited`
    bool region_high = false;
    std::int64_t current_ref = 0;
    std::int64_t voltage = 0;
    std::int64_t duty = 0;
    ControlLimits limit;
  };

  void reset() { *this = TorqueControl{}; }

  void clock(const In& in) {
    using T = Map::T;
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    const bool direct = in.mode == Mode::voltage;
    const bool follows = !direct && in.armed, ramps = direct && in.armed;
    const std::int64_t applied = in.limited + out_.addend;
    out_.early_term = out_.late_term = out_.addend = 0;
    if (at(T::set_error) && ramps) {
      out_.late_term = (word<D::P::voltage_setpoint.key()>(in.param) - voltage_).raw();
    }
    if (at(T::set_step) && ramps) out_.addend = voltage_.raw();
    if (at(T::dead_voltage) && D::emf_in_law == 0 && !direct) out_.addend = -emf_.raw();
    if (at(T::voltage_limited) && in.armed) out_.addend = emf_.raw();
    if (at(T::voltage_part)) emf_ = Law::emf(product<P::velocity, P::emf>(in));
    if (at(T::current_part)) {
      kept_ = in.mode == Mode::open_loop ? CurrentPart{}
                                         : Law::current_part(product<P::torque, P::observer>(in));
    }
    if (at(T::border) || at(T::hold_size)) out_.early_term = in.tau_ref;
    if (at(T::region)) out_.region_high = in.over_limit;
    if (at(T::direct_current) && direct && in.armed) {
      out_.early_term = Law::current_sum(product<P::voltage, P::direct>(in)).raw();
    }
    if (at(T::current_sum) && follows) {
      const auto by_ref = Law::current_part(product<P::torque, P::torque_gain>(in));
      out_.late_term = Law::current_sum(by_ref + kept_).raw();
    }
    if (at(T::dead_sum) && !direct) {
      out_.early_term = Law::voltage_part(product<P::torque, P::slope>(in)).raw();
    }
    if (at(T::current)) {
      out_.current_ref = shown<D::f.current.width()>(in.limited);
      out_.limit.current = in.over_limit && in.armed;
    }
    if (direct ? at(T::direct_voltage) : at(T::voltage_offset)) {
      fixed_ = VoltageSum::from_raw(raw<VoltageSum>(applied));
    }
    if (at(T::voltage_sum) && follows) {
      const auto resistive = Law::voltage_part(product<P::current, P::gain>(in));
      out_.late_term = Law::voltage_sum(resistive + fixed_).raw();
    }
    if (at(T::voltage_sum) && ramps) out_.late_term = Law::voltage_sum(fixed_ - emf_).raw();
    if (at(T::voltage)) {
      voltage_ = Law::port_voltage(Applied::from_raw(raw<Applied>(applied)));
      out_.limit.voltage = in.over_limit && in.armed;
    }
    if (at(T::duty_sum)) {
      out_.late_term = Law::duty_sum(product<D::f.applied.key(), P::duty>(in)).raw();
    }
    if (at(T::duty)) {
      out_.duty = shown<D::f.duty.width()>(in.limited);
      out_.limit.duty = in.over_limit;
    }
    out_.voltage = voltage_.raw();
  }

  const Out& out() const { return out_; }

 private:
  using CurrentPart = typename Law::CurrentPart;
  using Applied = typename Law::Applied;
  using VoltageSum = typename Law::VoltageSum;

  /// Formats of the factors.
  struct P {
    static constexpr int torque = D::f.torque.key(), velocity = D::f.velocity.key();
    static constexpr int voltage = D::f.voltage.key(), current = D::f.current.key();
    static constexpr int emf = D::P::emf_constant.key(), observer = D::P::observer_gain.key();
    static constexpr int direct = D::P::voltage_to_current.key();
    static constexpr int torque_gain = D::P::torque_gain.key();
    static constexpr int slope = D::P::dead_voltage_slope.key();
    static constexpr int gain = D::P::voltage_gain.key(), duty = D::P::duty_gain.key();
  };

  template <int Key>
  static fixed_of<Key> word(std::uint32_t raw) {
    return Fixed::from_raw<Key>(decode_word(Format::from_key(Key), raw));
  }
  /// The product on the bus as the number it is: a signal times a coefficient.
  template <int SignalKey, int CoefficientKey>
  static auto product(const In& in) {
    return decltype(fixed_of<SignalKey>{} * fixed_of<CoefficientKey>{})::from_raw(in.product);
  }
  template <class Number>
  static typename Number::raw_type raw(std::int64_t value) {
    return static_cast<typename Number::raw_type>(value);
  }
  /// Cuts a value to the width of a port.
  template <int Width>
  static std::int64_t shown(std::int64_t value) {
    return feltgate::detail::wrapped<std::int64_t>(value, 1, Width);
  }

  typename Law::Voltage voltage_{};
  CurrentPart kept_{};
  typename Law::Emf emf_{};
  VoltageSum fixed_{};
  Out out_;
};

}  // namespace feltgate

// The environment of torque_control in the core: the words of a wave on the parameter bus, the
// shared multiplier, the shared limiter, and the adapter.

namespace feltgate::test {

using A = Design::A;
using Control = TorqueControl<Design>;
using Step = TorqueControlStep<Design, Fixed>;
using Torque = fixed_of<Design::f.torque.key()>;
using Current = fixed_of<Design::f.current.key()>;
using Voltage = fixed_of<Design::f.voltage.key()>;
using Velocity = fixed_of<Design::f.velocity.key()>;

/// The parameter words of a wave as the 32-bit bus carries them, by address.
struct Words : ParameterReader<Design, Words> {
  Words() {
    for (std::size_t k = 0; k < raw.size(); ++k) {
      const ParameterInfo& p = parameter(static_cast<int>(k));
      if (p.address == static_cast<int>(k)) raw[k] = static_cast<std::int32_t>(p.raw);
    }
  }
  std::int64_t at(int address) const { return raw[static_cast<std::size_t>(address)]; }
  void set(int address, std::int64_t value) {
    raw[static_cast<std::size_t>(address)] = static_cast<std::int32_t>(value);
  }
  /// The low bits of the word, as a number of the format.
  template <int Key>
  fixed_of<Key> get(int address) const {
    return fixed_of<Key>::from_raw(feltgate::detail::wrapped(
        at(address), Format::from_key(Key).sign, Format::from_key(Key).width()));
  }
  std::array<std::int32_t, 51> raw{};
};

/// The inputs of one wave.
struct Wave {
  Words words;
  Mode mode = Mode::closed_loop;
  bool armed = true;
  std::int64_t tau_ref = 0, tau_hat = 0, velocity = 0;
};

/// Runs tick() with the wave.
inline void tick(Step& step, const Wave& w) {
  step.tick(w.words, w.armed, w.mode, Torque::from_raw(w.tau_ref), Torque::from_raw(w.tau_hat),
            Velocity::from_raw(w.velocity));
}

/// The parts that torque_control shares, with the values on them when other blocks use them.
struct Shared {
  explicit Shared(std::uint64_t seed) : mult(seed), limiter(seed + 1), garbage(seed + 2) {}
  SharedMult mult;
  SharedLimiter<Design> limiter;
  Random garbage;
};

/// The inputs of clock `clock` of a wave, given the outputs; to be called once per clock. In the
/// clocks of others, and after the last of the wave, the buses carry garbage.
inline Control::In wave_inputs(const Wave& w, int clock, const Control::Out& out, Shared& shared) {
  using W = Map::W;
  const auto is_one_of = [clock](std::initializer_list<int> slots) {
    return std::find(slots.begin(), slots.end(), clock) != slots.end();
  };
  const auto ahead_of = [clock](std::initializer_list<int> slots) {
    return std::find(slots.begin(), slots.end(), clock + 1) != slots.end();
  };
  Control::In in;
  in.armed = w.armed;
  in.mode = w.mode;
  in.wave = clock < Map::wave_length ? std::uint64_t{1} << clock : 0;
  in.tau_ref = clock > Map::T::tau_ref ? w.tau_ref : shared.garbage.between(-1000000, 1000000);
  in.product = shared.mult.product();
  in.limited = shared.limiter.limited();
  in.over_limit = shared.limiter.beyond();
  in.param = static_cast<std::uint32_t>(shared.garbage.bits() >> 32);
  const bool limits = is_one_of(
      {W::current_limit, W::dead_voltage, W::voltage_step, W::voltage_window, W::duty_limit});
  const bool compares = clock == W::region_torque;
  if (limits || compares ||
      is_one_of({W::voltage_setpoint, W::emf_constant, W::observer_gain, W::voltage_to_current,
                 W::torque_gain, W::dead_voltage_slope, W::voltage_gain, W::duty_gain})) {
    const bool high = clock == W::voltage_gain && out.region_high;
    in.param = static_cast<std::uint32_t>(w.words.at(high ? A::voltage_gain_high : clock));
  }
  const bool valid = ahead_of(
      {W::current_limit, W::dead_voltage, W::voltage_step, W::voltage_window, W::duty_limit});
  shared.limiter.clock(limits || compares,
                       {valid, out.early_term, out.late_term, in.param, false,
                        clock == Map::W::voltage_window - 1, clock == Map::W::duty_limit - 1});

  const std::int64_t coefficient = in.param & ((1u << Design::coefficient_bits) - 1);
  SharedMult& mult = shared.mult;
  switch (clock) {
    case W::emf_constant:
      mult.operands(w.velocity, coefficient);
      break;
    case W::observer_gain:
      mult.operands(w.tau_hat, w.words.get<Design::P::observer_gain.key()>(clock).raw());
      break;
    case W::voltage_to_current:
      mult.operands(out.voltage, coefficient);
      break;
    case W::torque_gain:
    case W::dead_voltage_slope:
      mult.operands(w.tau_ref, coefficient);
      break;
    case W::voltage_gain:  // of a direct voltage there is none
      mult.operands(w.mode == Mode::voltage ? 0 : in.limited + out.addend, coefficient);
      break;
    case W::duty_gain:
      mult.operands(in.limited + out.addend, coefficient);
      break;
    default:
      mult.others();
  }
  return in;
}

struct Adapter {
  static constexpr int kSum = Design::f.with_addend.width();
  template <class In>
  static void drive(Vtorque_control& rtl, const In& in) {
    set_ports(rtl, in.port);
  }
  static void set_ports(Vtorque_control& rtl, const Control::In& in) {
    rtl.armed_i = in.armed;
    rtl.mode_i = static_cast<std::uint8_t>(in.mode);
    FELTGATE_STROBES(rtl, in.wave, at, T, border, region, direct_voltage, current, hold_size,
                     voltage_offset, voltage, duty);
    FELTGATE_STROBES(rtl, in.wave, param_is, W, voltage_setpoint, voltage_step, current_limit,
                     dead_voltage, voltage_window);
    FELTGATE_STROBES(rtl, in.wave, product_is, M, emf_constant, observer_gain, voltage_to_current,
                     torque_gain, dead_voltage_slope, voltage_gain, duty_gain);
    FELTGATE_STROBES(rtl, in.wave << 1, product_next, M, voltage_gain);
    rtl.param_i = in.param;
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
    rtl.tau_ref_i = port_bits<Torque::width>(in.tau_ref);
    rtl.limited_i = port_bits<kSum>(in.limited + sign_extend<kSum>(rtl.addend_o));
    rtl.over_limit_i = in.over_limit;
  }
  /// Converts the RTL's outputs to the twin's type.
  static Control::Out outputs(const Vtorque_control& rtl) {
    Control::Out out;
    out.region_high = rtl.region_high_o != 0;
    out.early_term = sign_extend<Design::f.limiter_input.width()>(rtl.early_term_o);
    out.late_term = sign_extend<Design::f.limiter_input.width()>(rtl.late_term_o) + rtl.late_up_o;
    out.addend = sign_extend<kSum>(rtl.addend_o);
    out.current_ref = sign_extend<Design::f.current.width()>(rtl.current_ref_o);
    out.voltage = sign_extend<Design::f.voltage.width()>(rtl.voltage_o);
    out.duty = sign_extend<Design::f.duty.width()>(rtl.duty_o);
    out.limit = {rtl.limit_current_o != 0, rtl.limit_voltage_o != 0, rtl.limit_duty_o != 0};
    return out;
  }
  template <class Check, class Out>
  static void compare(Check& check, const Vtorque_control& rtl, const Out& seen) {
    const Control::Out out = outputs(rtl);
    check("region_high", out.region_high, seen.port.region_high);
    if (seen.clocked) {
      check("early_term", out.early_term, seen.port.early_term);
      check("late_term", out.late_term, seen.port.late_term);
      check("addend", out.addend, seen.port.addend);
    }
    check("current_ref", out.current_ref, seen.port.current_ref);
    check("voltage", out.voltage, seen.port.voltage);
    check("duty", out.duty, seen.port.duty);
    check("limit_current", out.limit.current, seen.port.limit.current);
    check("limit_voltage", out.limit.voltage, seen.port.limit.voltage);
    check("limit_duty", out.limit.duty, seen.port.limit.duty);
  }
};

/// The RTL alone, wave by wave: for closed loops, in which its inputs depend on its outputs.
class RtlAlone {
 public:
  RtlAlone() : rtl_(&context_), shared_(41) {
    rtl_.rst_ni = 1;
    rtl_.eval();
    rtl_.rst_ni = 0;
    clock({});
    rtl_.rst_ni = 1;
  }
  ~RtlAlone() { rtl_.final(); }

  Control::Out run(const Wave& wave) {
    for (int k = Map::W::emf_constant; k <= Map::T::duty; ++k) {
      clock(wave_inputs(wave, k, Adapter::outputs(rtl_), shared_));
    }
    return Adapter::outputs(rtl_);
  }

 private:
  void clock(const Control::In& in) {
    Adapter::set_ports(rtl_, in);
    rtl_.clk_i = 0;
    rtl_.eval();
    rtl_.clk_i = 1;
    rtl_.eval();
  }
  VerilatedContext context_;
  Vtorque_control rtl_;
  Shared shared_;
};

}  // namespace feltgate::test

// Random waves for torque_control, their coverage, and tick() against clock().

namespace feltgate::test {

/// Torques of every size and on the border; the design's words, legal ones, or any 32 bits.
struct RandomWaves {
  Random random;

  template <class Number>
  std::int64_t any() {
    if (random.one_in(20)) return random.coin() ? Number::max_raw() : Number::min_raw();
    const auto word = static_cast<std::int64_t>(random.bits()) >> (64 - Number::width);
    return word >> random.below(Number::width);
  }
  /// A limit: zero, small, or up to the format's end.
  template <class Number>
  std::int64_t limit() {
    return random.one_in(10) ? 0 : Number::max_raw() >> random.below(Number::width - 3);
  }
  Wave operator()() {
    Wave w;
    const std::uint32_t kind = random.below(4);
    if (kind >= 2) {
      for (const int a :
           {A::emf_constant, A::voltage_to_current, A::torque_gain, A::dead_voltage_slope,
            A::voltage_gain, A::voltage_gain_high, A::duty_gain}) {
        w.words.set(a, random.between(0, 131071) >> random.below(10));
      }
      w.words.set(A::observer_gain, random.between(-131072, 131071) >> random.below(10));
      w.words.set(A::region_torque, limit<Torque>());
      w.words.set(A::dead_voltage, limit<Voltage>());
    }
    if (kind >= 1) {
      w.words.set(A::current_limit, limit<Current>());
      w.words.set(A::voltage_window, limit<Voltage>());
      w.words.set(A::duty_limit, random.between(0, 4095) >> random.below(12));
    }
    w.words.set(A::voltage_setpoint, any<Voltage>());
    w.words.set(A::voltage_step, limit<Voltage>());
    if (kind == 3 && random.one_in(4)) {
      for (auto& word : w.words.raw) word = static_cast<std::int32_t>(random.bits() >> 32);
    }
    w.mode = static_cast<Mode>(random.below(4));
    w.armed = !random.one_in(5);
    w.tau_ref = random.coin() ? any<Torque>() : random.between(-40000, 40000);
    w.tau_hat = random.coin() ? any<Torque>() : random.between(-40000, 40000);
    w.velocity = any<Velocity>();
    if (random.one_in(4)) {
      const std::int64_t border = w.words.get<Step::Law::kBorderKey>(A::region_torque).raw();
      w.tau_ref = (random.coin() ? border : -border) + random.between(-1, 1);
      if (w.tau_ref > Torque::max_raw()) w.tau_ref = Torque::max_raw();
      if (w.tau_ref < Torque::min_raw()) w.tau_ref = Torque::min_raw();
    }
    return w;
  }
};

using Twin = Watched<Control, Wave>;
using Bench = LockStep<Vtorque_control, Twin, Adapter>;

/// A wave, then up to `spread` - 1 clocks of rest. The wave after a reset is disarmed, as in the
/// core, because the sums have no reset.
struct Waves {
  Waves(std::uint64_t seed, std::uint32_t more_clocks)
      : next{Random(seed)}, shared(seed + 1), spread(more_clocks) {}

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    const bool first = out.resets != resets;
    if (first) {
      resets = out.resets;
      clock = 0;
    }
    if (clock == 0) {
      in.aside = next();
      if (first) in.aside.armed = false;
      period = kShortest + static_cast<int>(shared.garbage.below(spread));
    }
    in.port = wave_inputs(in.aside, clock, out.port, shared);
    clock = clock + 1 == period ? 0 : clock + 1;
    return in;
  }

  static constexpr int kShortest = Map::T::duty + 2;
  RandomWaves next;
  Shared shared;
  std::uint32_t spread;
  Twin::In in;
  std::int64_t resets = 0;
  int clock = 0, period = kShortest;
};

/// Runs tick() at the clock at which the duty is ready.
struct TickBeside {
  Step step{};  // the ramp starts from the voltage of the tick before

  const char* operator()(const Twin::In& in, const Vtorque_control& rtl, const Twin&,
                         bool in_reset) {
    if (in_reset) step = {};
    if (in_reset || ((in.port.wave >> Map::T::duty) & 1u) == 0) return nullptr;
    tick(step, in.aside);
    const Control::Out out = Adapter::outputs(rtl);
    if (out.region_high != step.region_high) return "region of tick() is that of clock()";
    if (out.current_ref != step.current.raw()) return "current of tick() is that of clock()";
    if (out.voltage != step.voltage.raw()) return "voltage of tick() is that of clock()";
    if (out.duty != step.duty.raw()) return "duty of tick() is that of clock()";
    if (out.limit.current != step.limit.current || out.limit.voltage != step.limit.voltage ||
        out.limit.duty != step.limit.duty) {
      return "limits of tick() are those of clock()";
    }
    // For all words the voltage is within the window; the port's format ends at +-32 V.
    const Words& words = in.aside.words;
    const auto window =
        std::max<std::int64_t>(0, words.get<Step::Law::kVoltageKey>(A::voltage_window).raw());
    const auto emf = (in.aside.velocity * (words.at(A::emf_constant) & 0x1ffff)) >>
                     (Design::f.velocity.fraction + Design::P::emf_constant.fraction -
                      Design::f.voltage.fraction);
    const std::int64_t low = emf - window, high = emf + window;
    const auto port = [](std::int64_t v) {
      return std::clamp<std::int64_t>(v, Voltage::min_raw(), Voltage::max_raw());
    };
    if (in.port.armed && (out.voltage < port(low) || out.voltage > port(high))) {
      return "the voltage is within the window around the back-EMF";
    }
    if (!in.port.armed && (out.current_ref != 0 || out.voltage != 0)) return "disarmed is silent";
    return nullptr;
  }
};

}  // namespace feltgate::test

// torque_control and dob in a closed loop with a blocked lever, and torque_control against quad
// precision.

namespace feltgate::test {

inline std::int64_t torque_raw(double newton_metres) {
  return std::llround(std::ldexp(newton_metres, 16));
}

/// tick() with the interface of RtlAlone.
struct TwinAlone {
  Step step;
  Control::Out run(const Wave& w) {
    tick(step, w);
    Control::Out out;
    out.current_ref = step.current.raw();
    out.voltage = step.voltage.raw();
    out.duty = step.duty.raw();
    return out;
  }
};

/// A common mistake: the observer gets the current before its limit.
struct Unlimited {
  TwinAlone twin, without;
  Control::Out run(const Wave& w) {
    Control::Out out = twin.run(w);
    Wave free = w;
    free.words.set(A::current_limit, Current::max_raw());
    out.current_ref = without.run(free).current_ref;
    return out;
  }
};

/// A blocked lever: the observer gets the current of the tick before; the control gets tau_hat of
/// the observer.
template <class Driven>
class Loop {
 public:
  /// tau_hat in Nm after each tick.
  std::vector<double> run(Wave w, int ticks) {
    std::vector<double> tau_hat;
    for (int k = 0; k < ticks; ++k) {
      observer_.tick(words_, w.armed, Current::from_raw(out_.current_ref), Velocity{});
      w.tau_hat = observer_.tau_hat.raw();
      tau_hat.push_back(observer_.tau_hat.to_double());
      out_ = driven_.run(w);
    }
    return tau_hat;
  }
  std::int64_t current() const { return out_.current_ref; }
  std::int64_t voltage() const { return out_.voltage; }

 private:
  Driven driven_;
  feltgate::Words<Design, Fixed> words_;
  ObserverStep<Design, Fixed> observer_;
  Control::Out out_;
};

/// Exact parameters for the law in quad precision; the voltage set-point is an input, not a gain.
struct ExactWords : ParameterReader<Design, ExactWords> {
  explicit ExactWords(const Words& words)
      : setpoint(static_cast<quad>(words.at(A::voltage_setpoint)) * lsb(14)) {}
  template <int Key>
  quad get(int address) const {
    return address == A::voltage_setpoint ? setpoint : static_cast<quad>(parameter(address).si);
  }
  quad setpoint;
};

/// Largest errors of a tick against quad precision, in LSB of 2^-16 A, of 2^-14 V and of a clock,
/// and the largest bounds that hold for them.
struct Worst {
  double current = 0, current_bound = 0, voltage = 0, voltage_bound = 0, duty = 0, duty_bound = 0;

  /// Compares one wave. Returns the name of the bound that does not hold, or nullptr.
  const char* add(const Wave& w) {
    Step fixed;
    TorqueControlStep<Design, Real<quad>> real;
    if (w.mode == Mode::voltage) {  // the tick before has set the voltage to the set-point
      fixed.voltage = Voltage::from_raw(w.words.at(A::voltage_setpoint));
      real.voltage = static_cast<quad>(w.words.at(A::voltage_setpoint)) * lsb(14);
    }
    tick(fixed, w);
    const quad tau_ref = exact(Torque::from_raw(w.tau_ref));
    const quad tau_hat = exact(Torque::from_raw(w.tau_hat));
    const quad omega = exact(Velocity::from_raw(w.velocity));
    const ExactWords words(w.words);
    real.tick(words, w.armed, w.mode, tau_ref, tau_hat, omega);

    const auto off = [](int address) { return coefficient_error(parameter(address)); };
    const quad ampere = lsb(16), volt = lsb(14);
    const bool direct = w.mode == Mode::voltage;
    // A truncated product has an error of less than one LSB; a limit has only the error of its
    // quantisation.
    quad i = direct ? off(A::voltage_to_current) * magnitude(words.setpoint) + ampere
                    : off(A::torque_gain) * magnitude(tau_ref) +
                          off(A::observer_gain) * magnitude(tau_hat) + 2 * ampere;
    i = std::max(i, off(A::current_limit));
    const int gain = real.region_high ? A::voltage_gain_high : A::voltage_gain;
    const quad dead =
        std::max(off(A::dead_voltage_slope) * magnitude(tau_ref) + volt, off(A::dead_voltage));
    quad v = direct
                 ? quad{0}
                 : static_cast<quad>(parameter(gain).si) * i + off(gain) * magnitude(real.current) +
                       volt + off(A::emf_constant) * magnitude(omega) + volt + dead;
    // At the end of the window the errors are those of the window and of the back-EMF at its
    // centre.
    v = std::max(v, off(A::voltage_window) + off(A::emf_constant) * magnitude(omega) + volt);
    const quad d = static_cast<quad>(parameter(A::duty_gain).si) * v +
                   off(A::duty_gain) * magnitude(real.applied) + quad{0.5};

    const bool holds =
        raise(&current, &current_bound, exact(fixed.current) - real.current, i, ampere) &&
        raise(&voltage, &voltage_bound, exact(fixed.applied) - real.applied, v, volt) &&
        raise(&duty, &duty_bound, exact(fixed.duty) - real.duty, d, 1);
    if (fixed.region_high != real.region_high) return "region";
    return holds ? nullptr : "error above its bound";
  }

 private:
  static bool raise(double* worst, double* largest, quad error, quad bound, quad unit) {
    *worst = larger(*worst, static_cast<double>(magnitude(error) / unit));
    *largest = larger(*largest, static_cast<double>(bound / unit));
    return magnitude(error) <= bound;
  }
};

}  // namespace feltgate::test

using namespace feltgate;
using namespace feltgate::test;

namespace {

double si(int address) { return parameter(address).si; }
double volts(std::int64_t raw) { return std::ldexp(static_cast<double>(raw), -14); }
double amperes(std::int64_t raw) { return std::ldexp(static_cast<double>(raw), -16); }

Wave stall(double tau_ref) {
  Wave w;
  w.tau_ref = torque_raw(tau_ref);
  return w;
}

}  // namespace

TEST_CASE("torque_control: random waves, words, modes, arming and resets") {
  Bench bench("torque_control", 1);
  bench.run(Waves(2, 20), scaled_clocks(1000000), {20000}, TickBeside{});
  bench.run(Waves(3, 1), scaled_clocks(900000), {400}, TickBeside{});
}

TEST_CASE("torque_control: the region's border belongs to the low gain, one LSB above does not") {
  RtlAlone rtl;
  Wave w = stall(0);
  const std::int64_t border = w.words.at(A::region_torque);
  for (const std::int64_t sign : {1, -1}) {
    for (const std::int64_t off : {-1, 0, 1}) {
      w.tau_ref = sign * (border + off);
      REQUIRE(rtl.run(w).region_high == (off > 0));
    }
  }
}

TEST_CASE("torque_control: current and voltage of the design, by hand") {
  RtlAlone rtl;
  for (const double tau_ref : {0.1, -0.1, 0.2, 0.4, -0.005}) {
    for (const double omega : {0.0, 20.0, -20.0}) {
      Wave w = stall(tau_ref);
      w.tau_hat = torque_raw(0.05);
      w.velocity = std::llround(std::ldexp(omega, 21));
      const Control::Out out = rtl.run(w);
      const double current = kIsPaper ? (0.78336 * tau_ref + 0.21664 * 0.05) / 0.0605  // reading A
                                      : tau_ref / 0.0302;
      REQUIRE(std::fabs(amperes(out.current_ref) - current) < 1e-3);
      const double kv = std::fabs(tau_ref) > 0.15 ? 0.95 : 1.25;
      // Brushes and dead time of the bridge: constant, but linear below 10 mNm.
      const double dead = si(A::dead_voltage) * std::fmax(-1, std::fmin(1, tau_ref / 0.01));
      const double voltage = (kIsPaper ? kv * current : 0.42 * current + 0.0302 * omega) + dead;
      REQUIRE(std::fabs(volts(out.voltage) - voltage) < 2e-3);
      const double duty = voltage / 24 * Design::pwm_period;
      REQUIRE(std::fabs(static_cast<double>(out.duty) - duty) < 0.8);
      REQUIRE_FALSE(out.limit.current);
    }
  }
}

TEST_CASE("torque_control: paper's border lets the voltage fall while the torque grows") {
  if (!kIsPaper) return;
  RtlAlone rtl;
  Wave below = stall(0), above = stall(0);
  below.tau_ref = below.words.at(A::region_torque);
  above.tau_ref = below.tau_ref + 1;
  below.tau_hat = above.tau_hat = below.tau_ref;  // the loop has settled
  const double fall = volts(rtl.run(below).voltage) - volts(rtl.run(above).voltage);
  REQUIRE(std::fabs(fall - 0.744) < 0.001);          // 3.10 V to 2.36 V
  REQUIRE(std::fabs(fall * 0.0725 - 0.054) < 5e-4);  // in torque of a 0.0302 Nm/A, 0.42 ohm motor
}

TEST_CASE("torque_control: voltage mode ramps to the set-point, within the window; disarming") {
  RtlAlone rtl;
  Wave w = stall(0.3);
  w.mode = Mode::voltage;
  w.tau_hat = torque_raw(0.2);
  const double step = si(A::voltage_step), window = si(A::voltage_window);
  REQUIRE(std::fabs(step * 1e6 / 2400 - 1) < 0.01);
  double before = 0;
  for (const double set : {3.0, -3.0, 24.0}) {
    w.words.set(A::voltage_setpoint, std::llround(std::ldexp(set, 14)));
    // Arming and a change of the set-point ramp the voltage; at stall it stays within the window.
    Control::Out out;
    for (int k = 0; k < 15000; ++k) {
      out = rtl.run(w);
      const double v = volts(out.voltage);
      const double end = std::fmin(window, std::fmax(-window, set));
      const double left = end - before;
      const double wanted = std::fabs(left) <= step ? end : before + std::copysign(step, left);
      REQUIRE(std::fabs(v - wanted) < 1e-4);
      REQUIRE(out.limit.voltage == (std::fabs(set) > window && std::fabs(left) < step));
      const double current = std::fmin(si(A::current_limit), before * si(A::voltage_to_current));
      REQUIRE((current < -si(A::current_limit) ||
               std::fabs(amperes(out.current_ref) - current) < 2e-3));
      before = v;
    }
  }
  // The window moves with the back-EMF, at once.
  for (const double omega : {100.0, -200.0, 500.0}) {
    w.velocity = std::llround(std::ldexp(omega, 21));
    w.words.set(A::voltage_setpoint, 0);
    const double emf = si(A::emf_constant) * omega;
    Control::Out out;
    for (int k = 0; k < 15000; ++k) out = rtl.run(w);
    const double wanted = std::copysign(std::fmax(0, std::fabs(emf) - window), emf);
    REQUIRE(std::fabs(volts(out.voltage) - wanted) < 2e-3);
  }
  w.armed = false;
  const Control::Out out = rtl.run(w);
  REQUIRE(out.voltage == 0);
  REQUIRE(out.current_ref == 0);
  REQUIRE(out.duty == 0);
  REQUIRE_FALSE(out.limit.voltage);
}

TEST_CASE("torque_control: a host's gain, current limit and dead voltage do not move the window") {
  RtlAlone rtl;
  Wave w;
  for (const int address : {A::voltage_gain, A::voltage_gain_high, A::torque_gain,
                            A::dead_voltage_slope, A::voltage_to_current}) {
    w.words.set(address, 0x1ffff);
  }
  for (const int address :
       {A::current_limit, A::dead_voltage, A::voltage_setpoint, A::voltage_step}) {
    w.words.set(address, 0x7fff0);
  }
  for (const Mode mode : {Mode::closed_loop, Mode::open_loop, Mode::voltage}) {
    w.mode = mode;
    for (const double omega : {0.0, 300.0, -300.0}) {
      w.velocity = std::llround(std::ldexp(omega, 21));
      for (const double tau_ref : {15.0, -15.0}) {
        w.tau_ref = torque_raw(tau_ref);
        const double current = (volts(rtl.run(w).voltage) - si(A::emf_constant) * omega) / 0.42;
        REQUIRE(std::fabs(current) <= (si(A::voltage_window) + 1e-3) / 0.42);
      }
    }
  }
}

TEST_CASE("torque_control: distance from quad precision") {
  Worst worst;
  RandomWaves random{Random(51)};
  for (std::int64_t k = 0; k < scaled_clocks(50000); ++k) {
    Wave w;  // the design's words
    w.mode = static_cast<Mode>(random.random.below(3));
    w.tau_ref = random.random.between(-32768, 32768);  // +-0.5 Nm
    w.tau_hat = random.random.between(-65536, 65536);
    w.velocity = random.any<Velocity>();
    w.words.set(A::voltage_setpoint, random.random.between(-393216, 393216));
    if (const char* broken = worst.add(w)) FAIL(broken << " at wave " << k);
  }
  INFO("worst and bound: current "
       << worst.current << " " << worst.current_bound << " LSB, voltage " << worst.voltage << " "
       << worst.voltage_bound << " LSB, duty " << worst.duty << " " << worst.duty_bound);
  REQUIRE(worst.current > worst.current_bound / 4);
  REQUIRE(worst.current_bound < 16);
  REQUIRE(worst.voltage > worst.voltage_bound / 8);
  REQUIRE(worst.voltage_bound < 16);
  REQUIRE(worst.duty > 0.4);
  REQUIRE(worst.duty_bound < 1.0);
}

TEST_CASE("torque_control: with the observer at stall, paper's loop has its pole at 391.68 rad/s") {
  if (!kIsPaper) return;
  for (const double tau_ref : {0.1, 0.2, 0.3}) {
    const Wave w = stall(tau_ref);
    Loop<TwinAlone> loop;
    const auto tau_hat = loop.run(w, 40000);
    const double target = std::ldexp(static_cast<double>(w.tau_ref), -16);
    // Time of 2 % settling: the last tick outside.
    std::size_t settled = tau_hat.size();
    while (std::fabs(tau_hat[settled - 1] / target - 1) <= 0.02) --settled;
    REQUIRE(std::fabs(static_cast<double>(settled) * 1e-3 / 9.988 - 1) < 0.01);
    // Pole from the decay between 1 and 5 ms.
    const double pole = std::log((target - tau_hat[999]) / (target - tau_hat[4999])) / 0.004;
    REQUIRE(std::fabs(pole / 391.68 - 1) < 0.002);
    REQUIRE(std::fabs(tau_hat.back() - target) <= std::ldexp(1.0, -16));
  }
}

TEST_CASE("torque_control: open loop leaves paper at 78.336 % of the torque, lever at all of it") {
  Wave w = stall(0.2);
  w.mode = Mode::open_loop;
  Loop<TwinAlone> loop;
  const auto tau_hat = loop.run(w, 40000);
  const double ratio = tau_hat.back() / std::ldexp(static_cast<double>(w.tau_ref), -16);
  REQUIRE(std::fabs(ratio - (kIsPaper ? 0.78336 : 1.0)) < 2e-4);
}

TEST_CASE("torque_control: no wind-up at the current limit") {
  // Blocked lever, current limit at 0.1 Nm, paper's gains: 0.5 Nm for long, then -0.05.
  if (!kIsPaper) return;
  Wave w = stall(0.5);
  w.words.set(A::current_limit, std::llround(std::ldexp(0.1 / 0.0605, 16)));
  const auto ticks_until_sign_changes = [&w](auto& loop, int long_ticks) {
    w.tau_ref = torque_raw(0.5);
    loop.run(w, long_ticks);
    REQUIRE(loop.current() > 0);
    w.tau_ref = torque_raw(-0.05);
    int ticks = 0;
    do {
      loop.run(w, 1);
      ++ticks;
    } while (loop.voltage() >= 0 && ticks < 10000);
    return ticks;
  };
  Loop<TwinAlone> twin;
  REQUIRE(ticks_until_sign_changes(twin, 1000000) == 1);
  Loop<RtlAlone> rtl;
  REQUIRE(ticks_until_sign_changes(rtl, 20000) == 1);
  // The same law, but the observer gets the current before the limit: about 2 ms.
  Loop<Unlimited> wrong;
  const int wrong_ticks = ticks_until_sign_changes(wrong, 20000);
  REQUIRE(wrong_ticks > 1500);
  REQUIRE(wrong_ticks < 3000);
}
