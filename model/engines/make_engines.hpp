// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engines of one design: RTL, twin, and both in lock-step. Documentation: docs/architecture.md
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "engines/clocked_engine.hpp"
#include "engines/rtl_core.hpp"
#include "reference/chain.hpp"
#include "reference/real_chain.hpp"

namespace feltgate {

template <class Rtl, class D>
class RtlEngine : public ClockedEngine {
 public:
  RtlEngine() : ClockedEngine(design_info<D>()) {}
  const char* name() const override { return "rtl"; }
  void trace(const std::string& path, Clock from, Clock to) override {
    core_.trace(path, from, to);
  }
  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) override {
    run(clocks, first, last, [this](const CoreIn& in) {
      core_.clock(in);
      note(core_.out());
      if (last_.snapshot_valid) keep(last_, 0, 0);
    });
  }

 private:
  void reset_core(std::uint64_t seed, EncoderPins pins) override { core_.power_up(seed, pins); }
  RtlCore<Rtl, D> core_;
};

template <class D>
class TwinEngine : public ClockedEngine {
 public:
  TwinEngine() : ClockedEngine(design_info<D>()) {}
  const char* name() const override { return "twin"; }

  /// From event to event: pins, register writes and the end of the stretch. Clocks in which nothing
  /// happens that could be asked for wait for those that follow. Flat: 7 % of the time are calls.
  [[gnu::flatten]] void advance(Clock clocks, const EncoderEvent* first,
                                const EncoderEvent* last) override {
    snapshots_.clear();
    if (first != last) events_.push(first, last);
    CoreIn in = inputs();
    const Clock end = now_ + clocks;
    if (!gate_times_ && writes_.empty() && events_.next(end) >= end) {
      in.encoder = events_.pins();
      if (core_.calm(in, waiting_ + clocks)) {
        waiting_ += clocks;
        now_ = end;
        return;
      }
    }
    if (gate_times_) gates_before_ = core_.gate_clocks();
    now_ -= waiting_;
    waiting_ = 0;
    const auto tell = [this] { keep(core_.out(), core_.sampled_travel(), core_.writes()); };
    while (now_ < end) {
      in.encoder = events_.at(now_);
      const int clock_of_tick = core_.clock_of_tick();
      if (!writes_.empty() && clock_of_tick == WriteQueue::issue_clock) {
        issue_write(&in);
        core_.clock(in);
        if (core_.out().snapshot_valid) tell();
        in.reg_write = false;
        ++now_;
        continue;
      }
      Clock until = std::min(end, events_.next(end));
      if (!writes_.empty()) {
        const int ahead = WriteQueue::issue_clock - clock_of_tick;
        until = std::min(until, now_ + (ahead > 0 ? ahead : ahead + D::clocks_per_tick));
      }
      core_.run(in, until - now_, tell);
      now_ = until;
    }
  }
  void set_panel(const Panel& panel) override {
    settle();
    ClockedEngine::set_panel(panel);
  }
  void write(int address, std::uint32_t data) override {
    settle();
    ClockedEngine::write(address, data);
  }
  void keep_gate_times(bool keep) override { gate_times_ = keep; }
  GateClocks gates() const override {
    const auto after = core_.gate_clocks();
    return {after[0] - gates_before_[0], after[1] - gates_before_[1], after[2] - gates_before_[2],
            after[3] - gates_before_[3]};
  }
  int duty() const override { return core_.out().duty_active; }
  bool gates_enabled() const override { return core_.out().gates_enable; }

 private:
  using Core = FeltgateCore<D, false>;  // nobody reads registers through an engine

  /// Before the inputs change: the clocks that wait.
  void settle() {
    CoreIn in = inputs();
    in.encoder = events_.pins();
    core_.run(in, waiting_, [] {});
    waiting_ = 0;
  }
  void reset_core(std::uint64_t, EncoderPins) override {
    core_ = Core();
    waiting_ = 0;
    gates_before_ = {};
  }
  Core core_;
  Clock waiting_ = 0;  ///< clocks before now() that the core has yet to run
  bool gate_times_ = true;
  std::array<std::int64_t, 4> gates_before_{};
};

/// Name of the first output in which two cores differ, with both values.
inline std::string difference(const CoreOut& rtl, const CoreOut& twin) {
  const auto text = [](const char* name, std::int64_t a, std::int64_t b) {
    return std::string(name) + ": rtl " + std::to_string(a) + ", twin " + std::to_string(b);
  };
#define FELTGATE_DIFFERS(field) \
  if (rtl.field != twin.field) return text(#field, rtl.field, twin.field)
  FELTGATE_DIFFERS(tick_count);
  FELTGATE_DIFFERS(position);
  FELTGATE_DIFFERS(velocity);
  FELTGATE_DIFFERS(tau_hat);
  FELTGATE_DIFFERS(tau_ref);
  FELTGATE_DIFFERS(current_ref);
  FELTGATE_DIFFERS(voltage);
  FELTGATE_DIFFERS(duty);
  FELTGATE_DIFFERS(duty_active);
  FELTGATE_DIFFERS(gates);
  FELTGATE_DIFFERS(scene);
  FELTGATE_DIFFERS(limits);
  FELTGATE_DIFFERS(faults);
  FELTGATE_DIFFERS(first_fault);
  FELTGATE_DIFFERS(armed);
  FELTGATE_DIFFERS(gates_enable);
  FELTGATE_DIFFERS(snapshot_valid);
  FELTGATE_DIFFERS(reg_busy);
  FELTGATE_DIFFERS(reg_rdata);
#undef FELTGATE_DIFFERS
  return {};
}

/// RTL and twin on the same inputs, every output compared on every clock. Each runs a stretch of an
/// advance() by itself, so that its time can be told from the other's.
template <class Rtl, class D>
class LockStepEngine : public ClockedEngine {
 public:
  LockStepEngine() : ClockedEngine(design_info<D>()) {}
  const char* name() const override { return "lockstep"; }
  void trace(const std::string& path, Clock from, Clock to) override { rtl_.trace(path, from, to); }
  std::int64_t mismatches() const override { return mismatches_; }
  std::string first_mismatch() const override { return first_; }
  Clock first_mismatch_clock() const override { return first_clock_; }
  double busy_s(const std::string& half) const override { return half == "rtl" ? rtl_s_ : twin_s_; }

  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) override {
    const Clock begin = now_;
    inputs_.clear();
    run(clocks, first, last, [this](const CoreIn& in) { inputs_.push_back(in); });
    for (std::size_t from = 0; from < inputs_.size(); from += stretch) {
      const std::size_t to = std::min(inputs_.size(), from + stretch);
      const double start = seconds();
      for (std::size_t k = from; k < to; ++k) {
        rtl_.clock(inputs_[k]);
        outputs_[k - from] = rtl_.out();
      }
      const double middle = seconds();
      for (std::size_t k = from; k < to; ++k) {
        twin_.clock(inputs_[k]);
        const CoreOut& out = twin_.out();
        if (!(outputs_[k - from] == out))
          miss(begin + static_cast<Clock>(k), outputs_[k - from], out);
        note(out);
        if (out.snapshot_valid) keep(out, twin_.sampled_travel(), twin_.writes());
      }
      rtl_s_ += middle - start;
      twin_s_ += seconds() - middle;
    }
  }

 private:
  static constexpr std::size_t stretch = 1000;
  static double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  void reset_core(std::uint64_t seed, EncoderPins pins) override {
    rtl_.power_up(seed, pins);
    twin_ = FeltgateCore<D>();
    mismatches_ = 0;
    first_.clear();
  }
  void miss(Clock clock, const CoreOut& rtl, const CoreOut& twin) {
    if (mismatches_++ > 0) return;
    first_clock_ = clock;
    first_ = "clock " + std::to_string(clock) + ", " + difference(rtl, twin);
  }

  RtlCore<Rtl, D> rtl_;
  FeltgateCore<D> twin_;
  std::vector<CoreIn> inputs_;
  CoreOut outputs_[stretch];
  std::int64_t mismatches_ = 0;
  Clock first_clock_ = 0;
  std::string first_;
  double rtl_s_ = 0, twin_s_ = 0;
};

template <class Rtl, class D>
std::unique_ptr<Engine> make_design_engine(const std::string& kind) {
  if (kind == "rtl") return std::make_unique<RtlEngine<Rtl, D>>();
  if (kind == "twin") return std::make_unique<TwinEngine<D>>();
  if (kind == "lockstep") return std::make_unique<LockStepEngine<Rtl, D>>();
  throw std::invalid_argument("engine \"" + kind + "\" is unknown; choose rtl, twin or lockstep");
}

template <class D>
std::unique_ptr<RealChain> make_design_chain(const std::string& kind) {
  if (kind == "fixed") return std::make_unique<Chain<D, Fixed>>("fixed");
  if (kind == "float") return std::make_unique<Chain<D, Real<float>>>("float");
  if (kind == "double") return std::make_unique<Chain<D, Real<double>>>("double");
  if (kind == "quad") return std::make_unique<Chain<D, Real<Quad>>>("quad");
  throw std::invalid_argument("chain \"" + kind +
                              "\" is unknown; choose fixed, float, double or quad");
}

}  // namespace feltgate
