// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The back-ends of a Verilated core: alone, and in lock-step with the twin. Documentation:
// docs/architecture.md
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "clocked_backend.hpp"
#include "lock_step_backend.hpp"
#include "rtl_core.hpp"

namespace feltgate {

/// The Verilated core as a back-end, clock by clock.
template <class Rtl>
class RtlBackend : public ClockedBackend {
 public:
  explicit RtlBackend(const DesignInfo& design) : ClockedBackend(design), core_(info_.data) {}
  const char* name() const override { return "rtl"; }
  void trace(const std::string& path, Clock from, Clock to) override {
    core_.trace(path, from, to);
  }
  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) override {
    run(clocks, first, last, [this](const CoreIn& in) {
      core_.clock(in);
      note(core_.out());
      if (last_.snapshot_valid) keep(last_, 0, 0);
      if (const auto e = core_.law_event())
        told_.push_back({e->number, e->value, last_.tick_count});
    });
  }
  std::vector<LawEvent> law_events() override { return told_; }

 private:
  void reset_core(std::uint64_t seed, EncoderPins pins) override {
    core_.power_up(seed, pins);
    told_.clear();
  }
  RtlCore<Rtl> core_;
  std::vector<LawEvent> told_;
};

/// Makes the back-end "rtl" or "lockstep" of the design whose Verilated class is Rtl.
template <class Rtl>
std::unique_ptr<Backend> make_rtl(const DesignInfo& design, bool lock_step) {
  if (lock_step) return std::make_unique<LockStepBackend<Rtl>>(design);
  return std::make_unique<RtlBackend<Rtl>>(design);
}

}  // namespace feltgate
