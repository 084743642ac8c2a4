// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The real-arithmetic chain of one design: the laws of the twin, evaluated in double or in 113
// bits. Documentation: docs/architecture.md
#pragma once

#include "reference/control_chain.hpp"

namespace feltgate {

/// IEEE binary128 of the compiler: 113 bits of mantissa.
__extension__ typedef __float128 Quad;

template <class D, class T>
class Chain : public RealChain {
 public:
  explicit Chain(const char* name) : name_(name) { reset(); }
  const char* name() const override { return name_; }

  void reset() override {
    chain_.reset();
    out_ = {};
  }

  void set_parameter(int address, double value) override {
    chain_.words().set_value(address, static_cast<T>(value));
  }

  void tick(const ChainIn& in) override {
    chain_.tick(in);
    out_.velocity_rad_s = static_cast<double>(chain_.velocity());
    out_.tau_hat_nm = static_cast<double>(chain_.tau_hat());
    out_.tau_ref_nm = static_cast<double>(chain_.tau_ref());
    out_.current_a = static_cast<double>(chain_.control().current);
    out_.voltage_v = static_cast<double>(chain_.control().voltage);
    out_.duty_clocks = static_cast<double>(chain_.control().duty);
  }

  const ChainOut& out() const override { return out_; }

 private:
  const char* name_;
  ControlChain<D, Real<T>> chain_;
  ChainOut out_;
};

}  // namespace feltgate
