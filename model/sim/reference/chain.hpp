// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain of one design behind the interface RealChain, in a number policy N: Fixed, or Real<T>
// with T float, double or 113 bits. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "control_chain.hpp"
#include "feltgate/quad.hpp"

namespace feltgate {

/// Integer of a parameter for a value in its unit, rounded to nearest.
/// Throws std::invalid_argument when it does not fit, with the range.
std::int64_t quantise_parameter(const ParameterInfo& info, double value);

/// C: what computes a tick, with the interface of ControlChain.
template <class D, class N, class C = ControlChain<D, N>>
class Chain : public RealChain {
 public:
  explicit Chain(const char* name) : name_(name) { reset(); }
  const char* name() const override { return name_; }
  C& control() { return chain_; }

  void reset() override {
    chain_.reset();
    made_ = false;
    raw_ = {};
  }

  void set_parameter(int address, double value) override {
    if constexpr (N::is_fixed) {
      chain_.words().set_raw(address, quantise_parameter(info(address), value));
    } else {
      chain_.words().set_value(address, static_cast<Stored>(value));
    }
  }

  void set_word(int address, std::uint32_t written) override {
    const Format f = info(address).format;
    const std::uint32_t word = fitted(f, written);
    if constexpr (N::is_fixed) {
      chain_.words().set_raw(address, word);
    } else {
      const auto integer = static_cast<double>(decode_word(f, word));
      chain_.words().set_value(address, static_cast<Stored>(std::ldexp(integer, -f.fraction)));
    }
  }

  void program(double torque_nm) override {
    using Torque = typename C::Torque;
    if constexpr (N::is_fixed) {
      chain_.program(Torque::from_raw(std::llround(std::ldexp(torque_nm, D::f.torque.fraction))));
    } else {
      chain_.program(static_cast<Torque>(torque_nm));
    }
  }

  void tick(const ChainIn& in) override {
    chain_.tick(in);
    made_ = false;
    if constexpr (N::is_fixed) {
      raw_.velocity = N::raw(chain_.velocity());
      raw_.tau_hat = static_cast<std::int32_t>(N::raw(chain_.tau_hat()));
      raw_.tau_ref = static_cast<std::int32_t>(N::raw(chain_.tau_ref()));
      raw_.current_ref = static_cast<std::int32_t>(N::raw(chain_.control().current));
      raw_.voltage = static_cast<std::int32_t>(N::raw(chain_.control().voltage));
      raw_.duty = static_cast<std::int16_t>(N::raw(chain_.control().duty));
      raw_.limits = chain_.limits();
    }
  }

  const ChainOut& out() const override {
    if (made_) return out_;
    made_ = true;
    out_.velocity_rad_s = number(chain_.velocity());
    out_.tau_hat_nm = number(chain_.tau_hat());
    out_.tau_ref_nm = number(chain_.tau_ref());
    out_.current_a = number(chain_.control().current);
    out_.voltage_v = number(chain_.control().voltage);
    out_.duty_clocks = number(chain_.control().duty);
    return out_;
  }

  bool ramping() const override { return chain_.limit_ramp(); }
  const ChainRaw* raw() const override { return N::is_fixed ? &raw_ : nullptr; }

 private:
  using Stored = typename Words<D, N>::Stored;

  template <class X>
  static double number(X x) {
    if constexpr (N::is_fixed) {
      return x.to_double();
    } else {
      return static_cast<double>(x);
    }
  }
  static const ParameterInfo& info(int address) {
    for (const ParameterInfo& p : D::parameters) {
      if (p.address == address) return p;
    }
    throw std::invalid_argument("design " + std::string(D::name) + " has no parameter at address " +
                                std::to_string(address) + "; docs/registers.md lists them");
  }

  const char* name_;
  C chain_;
  mutable ChainOut out_;  // made from the chain when first asked for after a tick
  mutable bool made_ = false;
  ChainRaw raw_;
};

}  // namespace feltgate
