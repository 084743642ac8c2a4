// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The environment of torque_control in the core: the words of a wave on the parameter bus, the
// shared multiplier, the shared limiter, and the adapter. Documentation:
// docs/blocks/torque_control.md
#pragma once

#include <Vtorque_control.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "../../estimators/lowpass/exact.hpp"
#include "../../wave/mult/mult_twin.hpp"
#include "../limiter/limiter_twin.hpp"
#include "feltgate/generated/reader.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "torque_control_twin.hpp"

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
