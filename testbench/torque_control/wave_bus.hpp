// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// torque_control of a design as it sits in the core: the words of a wave on the parameter bus, its
// operands on the shared multiplier, and the adapter. Documentation: docs/blocks/torque_control.md
#pragma once

#include <Vtorque_control.h>

#include <array>

#include "../lowpass/exact.hpp"
#include "../mult/shared_mult.hpp"
#include "feltgate/generated/reader.hpp"
#include "feltgate/torque_control.hpp"
#include "lock_step.hpp"

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

/// What one wave works on.
struct Wave {
  Words words;
  Mode mode = Mode::closed_loop;
  bool armed = true;
  std::int64_t tau_ref = 0, tau_hat = 0, velocity = 0;
};

/// The wave as tick() takes it.
inline void tick(Step& step, const Wave& w) {
  step.tick(w.words, w.armed, w.mode, Torque::from_raw(w.tau_ref), Torque::from_raw(w.tau_hat),
            Velocity::from_raw(w.velocity));
}

/// The inputs of clock `clock` of a wave, given the outputs; to be called once per clock. After the
/// wave's last clock (49) the bus carries garbage.
inline Control::In wave_inputs(const Wave& w, int clock, const Control::Out& out, SharedMult& mult,
                               Random& garbage) {
  Control::In in;
  in.armed = w.armed;
  in.mode = w.mode;
  in.wave = clock < 50 ? clock : -1;
  in.tau_ref = w.tau_ref;
  in.product = mult.product();
  in.param = static_cast<std::int32_t>(garbage.bits() >> 32);
  const bool has_word = (clock >= 22 && clock <= 30) || clock == 33 || clock == 34 || clock == 35 ||
                        clock == 39 || clock == 40 || clock == 45;
  if (has_word) {
    in.param =
        w.words.at(clock == A::voltage_gain && out.region_high ? A::voltage_gain_high : clock);
  }
  const std::int64_t unsigned_word = in.param & 0x1ffff;
  switch (clock) {
    case A::emf_constant:
      mult.operands(w.velocity, unsigned_word);
      break;
    case A::observer_gain:
      mult.operands(w.tau_hat, w.words.get<Design::P::observer_gain.key()>(clock).raw());
      break;
    case A::voltage_to_current:
      mult.operands(out.voltage, unsigned_word);
      break;
    case A::torque_gain:
    case A::dead_voltage_slope:
      mult.operands(w.tau_ref, unsigned_word);
      break;
    case A::voltage_gain:
    case A::duty_gain:
      mult.operands(out.operand, unsigned_word);
      break;
    default:
      mult.others();
  }
  return in;
}

struct Adapter {
  template <class In>
  static void drive(Vtorque_control& rtl, const In& in) {
    set_ports(rtl, in.port);
  }
  static void set_ports(Vtorque_control& rtl, const Control::In& in) {
    rtl.armed_i = in.armed;
    rtl.mode_i = static_cast<std::uint8_t>(in.mode);
    rtl.wave_i = in.wave < 0 ? 0 : std::uint64_t{1} << in.wave;
    rtl.param_i = static_cast<std::uint32_t>(in.param & 0xffffffff);
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
    rtl.tau_ref_i = port_bits<21>(in.tau_ref);
  }
  /// The RTL's outputs as the twin's.
  static Control::Out outputs(const Vtorque_control& rtl) {
    Control::Out out;
    out.region_high = rtl.region_high_o != 0;
    out.operand = sign_extend<Design::f.current.width()>(rtl.operand_o);
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
    check("operand", out.operand, seen.port.operand);
    check("current_ref", out.current_ref, seen.port.current_ref);
    check("voltage", out.voltage, seen.port.voltage);
    check("duty", out.duty, seen.port.duty);
    check("limit_current", out.limit.current, seen.port.limit.current);
    check("limit_voltage", out.limit.voltage, seen.port.limit.voltage);
    check("limit_duty", out.limit.duty, seen.port.limit.duty);
  }
};

/// The RTL alone, wave by wave: for closed loops, in which its outputs come back.
class RtlAlone {
 public:
  RtlAlone() : rtl_(&context_), mult_(41), garbage_(42) {
    rtl_.rst_ni = 1;
    rtl_.eval();
    rtl_.rst_ni = 0;
    clock({});
    rtl_.rst_ni = 1;
  }
  ~RtlAlone() { rtl_.final(); }

  Control::Out run(const Wave& wave) {
    for (int k = 22; k < 47; ++k) {
      clock(wave_inputs(wave, k, Adapter::outputs(rtl_), mult_, garbage_));
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
  SharedMult mult_;
  Random garbage_;
};

}  // namespace feltgate::test
