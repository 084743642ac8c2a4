// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random but plausible stimulus of several axes. Each axis has a lever, as a single core has; one
// host mostly requests the same from all axes. Documentation: docs/architecture.md
#pragma once

#include <deque>

#include "../../core/feltgate_core/core_stimulus.hpp"
#include "feltgate/feltgate_axes.hpp"

namespace feltgate::test {

/// Inputs clock by clock. All state is inside, so that a copy repeats the run.
template <class D, int N>
class AxesStimulus {
 public:
  /// `patience`: for this many clocks after a request to arm, no other request is written.
  explicit AxesStimulus(std::uint64_t seed, std::int64_t patience = 0)
      : random_(seed), patience_(patience) {
    for (int n = 0; n < N; ++n) levers_.emplace_back(seed + 1000u * static_cast<unsigned>(n));
  }

  AxesIn<N> operator()(std::int64_t clock) {
    if (random_.one_in(30'000)) active_ = random_.below(N);
    in_.reg_write = false;
    if (wait_ > 0) --wait_;
    if (keeps_ > 0) --keeps_;
    for (std::size_t n = 0; n < N; ++n) {
      const CoreIn of = levers_[n](clock);
      auto& axis = in_.axis[n];
      axis.encoder = of.encoder;
      axis.set_zero = of.set_zero;
      axis.scene = of.scene;
      axis.law_torque = of.law_torque;
      if (n == active_) host(of);
      if (n != 0) continue;
      in_.stop = of.stop;
      in_.arm = of.arm;
      in_.law_late = of.law_late;
      in_.law_restart = of.law_restart;
    }
    if (wait_ == 0 && !writes_.empty()) {
      in_.reg_addr = writes_.front().address;
      in_.reg_wdata = writes_.front().word;
      in_.reg_write = true;
      writes_.pop_front();
      wait_ = D::clocks_per_tick + random_.below(20);
    }
    return in_;
  }

 private:
  struct Write {
    std::uint16_t address;
    std::uint32_t word;
  };
  using C = typename D::C;

  static std::uint16_t at(std::size_t n, unsigned address) {
    return static_cast<std::uint16_t>(n * axes_stride + address % axes_stride);
  }
  void host(const CoreIn& of) {
    if (!writes_.empty()) return;
    if (!of.reg_write) {
      in_.reg_addr = random_.one_in(5'000) ? static_cast<std::uint16_t>(random_.bits())
                                           : at(active_, of.reg_addr);
      return;
    }
    const bool control = of.reg_addr == C::control, command = of.reg_addr == C::command;
    if (control && keeps_ > 0) return;
    const bool all = (control && !random_.one_in(12)) || (command && !random_.one_in(4));
    const bool arms = control && (of.reg_wdata >> C::control_arm & 1u) != 0;
    // A request that was refused counts again once it was low.
    if (all && arms && (patience_ > 0 || random_.coin())) {
      for (std::size_t n = 0; n < N; ++n) {
        writes_.push_back({at(n, of.reg_addr), of.reg_wdata & ~(1u << C::control_arm)});
      }
    }
    for (std::size_t n = 0; n < N; ++n) {
      if (!all && n != active_) continue;
      std::uint32_t word = of.reg_wdata;
      if (control && random_.coin()) {
        word &= ~(15u << C::control_scene);
        word |= random_.below(11) << C::control_scene;
        word ^= random_.below(4) << C::control_motor_polarity;
      }
      if (control && patience_ > 0) word |= 1u << C::control_host;
      writes_.push_back({at(n, of.reg_addr), word});
    }
    if (all && arms) keeps_ = patience_;
  }

  Random random_;
  std::vector<CoreStimulus<D>> levers_;
  AxesIn<N> in_;
  std::deque<Write> writes_;
  std::size_t active_ = 0;
  std::uint64_t wait_ = 0;
  std::int64_t patience_, keeps_ = 0;
};

}  // namespace feltgate::test
