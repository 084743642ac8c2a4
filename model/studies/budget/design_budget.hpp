// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error budget of one design. Documentation: docs/error-bounds.md
#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>

#include "studies/budget/budget.hpp"
#include "studies/budget/mixed_chain.hpp"

namespace feltgate::bounds {

template <class D>
class DesignBudget : public Budget {
 public:
  DesignBudget() { reset(); }
  const char* name() const override { return "budget"; }

  void reset() override {
    quantised_ = Exactly{Coefficients::quantised};
    exact_ = Exactly{Coefficients::exact};
    exact_gain_ = Exactly{Coefficients::exact_gain};
    alone_ = {MixedChain<D, true, false, false, false>{Coefficients::quantised},
              MixedChain<D, false, true, false, false>{Coefficients::quantised},
              MixedChain<D, false, false, true, false>{Coefficients::quantised},
              MixedChain<D, false, false, false, true>{Coefficients::quantised}};
    whole_.reset();
    line_.reset();
    largest_counts_ = 0;
    cover({});
  }

  void set_parameter(int address, double value) override {
    for (const ParameterInfo& p : D::parameters) {
      if (p.address != address) continue;
      for (Exactly* real : {&quantised_, &exact_, &exact_gain_}) real->set_parameter(p, value);
      std::apply([&](auto&... chain) { (chain.set_parameter(p, value), ...); }, alone_);
    }
    whole_.set_parameter(address, value);
  }
  void set_word(int address, std::uint32_t word) override {
    for (const ParameterInfo& p : D::parameters) {
      if (p.address != address) continue;
      const auto integer = static_cast<double>(decode_word(p.format, fitted(p.format, word)));
      set_parameter(address, std::ldexp(integer, -p.format.fraction));
    }
  }

  void tick(const ChainIn& in) override {
    for (Exactly* real : {&quantised_, &exact_, &exact_gain_}) real->tick(in);
    std::apply([&](auto&... chain) { (chain.tick(in), ...); }, alone_);
    whole_.tick(in);
    const int counts = travel_difference(in.travel, line_.oldest());
    line_.push(in.travel);
    largest_counts_ = std::max(largest_counts_, std::abs(counts));
    follow();

    std::size_t row = 0;
    std::apply([&](const auto&... chain) { (add(row++, chain, quantised_), ...); }, alone_);
    if (coefficients_.torque()) add(row, quantised_, exact_);
    ++row;
    const ChainOut& w = whole_.out();
    add(row++, {w.velocity_rad_s, w.tau_hat_nm, w.tau_ref_nm, w.current_a}, signals(exact_));
    add(row++, exact_, exact_gain_);
  }

  const ChainOut& out() const override { return whole_.out(); }
  bool ramping() const override { return whole_.ramping(); }
  const ChainRaw* raw() const override { return whole_.raw(); }
  void program_chain(std::size_t chain, double torque_nm) override {
    if (chain == 7) whole_.program(torque_nm);
    visit(*this, chain, [&](auto& mixed) { mixed.program(torque_nm); });
  }
  LawSample sample(std::size_t chain) const override {
    LawSample s;
    if (chain == 7) {
      const ChainOut& o = whole_.out();
      s = {o.velocity_rad_s, o.tau_hat_nm, whole_.raw()->velocity, whole_.raw()->tau_hat};
    }
    visit(*this, chain, [&](const auto& mixed) { s = mixed.sample(); });
    return s;
  }
  void cover(const Coverage& coverage) override {
    coverage_ = coverage;
    coefficients_ = coverage.of_coefficients();
    rows_ = {{"velocity_n", {}, {}, {}, {}},   {"dob", {}, {}, {}, {}},
             {"scenes", {}, {}, {}, {}},       {"torque_control", {}, {}, {}, {}},
             {"coefficients", {}, {}, {}, {}}, {"whole", {}, {}, {}, {}},
             {"gain", {}, {}, {}, {}}};
  }
  const Coverage& coverage() const override { return coverage_; }
  std::int64_t outside_coefficients() const override { return coefficients_.outside(); }
  const std::vector<BudgetRow>& rows() const override { return rows_; }
  double largest_velocity_rad_s() const override {
    return largest_counts_ *
           (D::velocity_gain == 0
                ? std::ldexp(1.0, D::velocity_shift)
                : std::ldexp(static_cast<double>(D::velocity_gain), -D::velocity_gain_f));
  }

 private:
  using Exactly = MixedChain<D, false, false, false, false>;
  struct Signals {
    Quad velocity, tau_hat, tau_ref, current;
  };

  /// Calls `use` with the chain of this number; not with the core's own.
  template <class Self, class Use>
  static void visit(Self& self, std::size_t chain, Use&& use) {
    std::size_t n = 0;
    std::apply([&](auto&... mixed) { ((n++ == chain ? use(mixed) : void()), ...); }, self.alone_);
    for (auto* real : {&self.quantised_, &self.exact_, &self.exact_gain_}) {
      if (n++ == chain) use(*real);
    }
  }
  template <class Chain>
  static Signals signals(const Chain& c) {
    return {c.velocity(), c.tau_hat(), c.tau_ref(), c.current()};
  }
  template <class A, class B>
  void add(std::size_t row, const A& a, const B& b) {
    add(row, signals(a), signals(b));
  }
  void add(std::size_t row, const Signals& a, const Signals& b) {
    BudgetRow& r = rows_[row];
    if (coverage_.velocity()) {
      r.velocity_rad_s.add(static_cast<double>(a.velocity - b.velocity));
    }
    if (!coverage_.torque()) return;
    r.tau_hat_nm.add(static_cast<double>(a.tau_hat - b.tau_hat));
    r.tau_ref_nm.add(static_cast<double>(a.tau_ref - b.tau_ref));
    r.current_a.add(static_cast<double>(a.current - b.current));
  }
  void follow() {
    TickState t;
    const unsigned limits = whole_.raw()->limits;
    t.velocity_saturated = (limits & 32u) != 0;
    t.tau_hat_saturated = (limits & 64u) != 0;
    t.ramping = (limits & 2u) != 0 || exact_.ramping();
    t.tau_ref_error_nm =
        static_cast<double>(static_cast<Quad>(whole_.out().tau_ref_nm) - exact_.tau_ref());
    coverage_.tick(t);
    t.ramping = t.ramping || quantised_.ramping();
    t.tau_ref_error_nm = static_cast<double>(quantised_.tau_ref() - exact_.tau_ref());
    coefficients_.tick(t);
  }

  Exactly quantised_{Coefficients::quantised}, exact_{Coefficients::exact},
      exact_gain_{Coefficients::exact_gain};
  std::tuple<MixedChain<D, true, false, false, false>, MixedChain<D, false, true, false, false>,
             MixedChain<D, false, false, true, false>, MixedChain<D, false, false, false, true>>
      alone_{Coefficients::quantised, Coefficients::quantised, Coefficients::quantised,
             Coefficients::quantised};
  Chain<D, Fixed> whole_{"fixed"};
  DelayLine<D::m1> line_;
  int largest_counts_ = 0;
  Coverage coverage_, coefficients_;
  std::vector<BudgetRow> rows_;
};

/// Throws std::invalid_argument for a design whose velocity is not by the N-method.
template <class D>
std::unique_ptr<Budget> make_design_budget() {
  if constexpr (measures_spans<D>) {
    throw std::invalid_argument(std::string("design ") + D::name +
                                ": the error budget knows the N-method alone; take a design with "
                                "velocity.estimator = \"n_method\"");
  } else {
    return std::make_unique<DesignBudget<D>>();
  }
}

}  // namespace feltgate::bounds
