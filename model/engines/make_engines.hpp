// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engines of one design: RTL, twin, and both in lock-step. Needs the Verilated core; without it
// twin_engine.hpp. Documentation: docs/architecture.md
#pragma once

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "clocked_engine.hpp"
#include "rtl_core.hpp"
#include "twin_engine.hpp"

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

}  // namespace feltgate
