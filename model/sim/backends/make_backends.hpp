// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The back-ends of one design: RTL, twin, and both in lock-step. Needs the Verilated core; without
// it use twin_backend.hpp. Documentation: docs/architecture.md
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "clocked_backend.hpp"
#include "lock_step_backend.hpp"
#include "rtl_core.hpp"
#include "twin_backend.hpp"

namespace feltgate {

/// The Verilated core as a back-end, clock by clock.
template <class Rtl, class D>
class RtlBackend : public ClockedBackend {
 public:
  RtlBackend() : ClockedBackend(design_info<D>()) {}
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
  RtlCore<Rtl, D> core_;
  std::vector<LawEvent> told_;
};

/// Makes the back-end "rtl", "twin" or "lockstep". Errors: std::invalid_argument for another kind.
template <class Rtl, class D>
std::unique_ptr<Backend> make_design_backend(const std::string& kind) {
  if (kind == "rtl") return std::make_unique<RtlBackend<Rtl, D>>();
  if (kind == "twin") return std::make_unique<TwinBackend<D>>();
  if (kind == "lockstep") return std::make_unique<LockStepBackend<Rtl, D>>();
  throw std::invalid_argument("engine \"" + kind + "\" is unknown; choose rtl, twin or lockstep");
}

}  // namespace feltgate
