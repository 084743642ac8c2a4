// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Back-ends with pins and a clock. Documentation: docs/speed-for-accuracy.md
#include "studies/bench/pin_runner.hpp"

#include <cmath>
#include <stdexcept>

#include "feltgate/generated/lever.hpp"
#include "sim/backends/clocked_backend.hpp"

namespace feltgate::bench {

namespace {

/// The twin in every clock, as lock-step runs it.
class ClockByClock : public ClockedBackend {
 public:
  ClockByClock() : ClockedBackend(design_info<Lever>()) {}
  const char* name() const override { return "twin_clock"; }
  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) override {
    ClockedBackend::run(clocks, first, last, [this](const CoreIn& in) {
      core_.clock(in);
      note(core_.out());
      if (last_.snapshot_valid) keep(last_, core_.sampled_travel(), core_.writes());
    });
  }

 private:
  void reset_core(std::uint64_t, EncoderPins) override { core_ = FeltgateCore<Lever>(); }
  FeltgateCore<Lever> core_;
};

}  // namespace

void PinRunner::inspect(const Work& work, const Inspector& each) {
  const DesignInfo& d = backend_->design();
  const auto si = [](std::int64_t raw, Format f) {
    return std::ldexp(static_cast<double>(raw), -f.fraction);
  };
  prepare(work);
  TickResult r;
  play(*backend_, work.inputs, [&](const Snapshot& s) {
    r.raw = {s.velocity,
             s.tau_hat,
             s.tau_ref,
             s.current_ref,
             s.voltage,
             s.duty,
             s.limits & ~limits_of_core};
    r.velocity_rad_s = si(s.velocity, d.velocity);
    r.tau_hat_nm = si(s.tau_hat, d.torque);
    r.torque_nm = d.torque_constant_nm_a * si(s.current_ref, d.current);
    each(r);
  });
}

std::unique_ptr<Runner> make_pin_runner(const std::string& name) {
  if (name == "rtl") return std::make_unique<PinRunner>("rtl", make_backend("lever", "rtl"));
  if (name == "twin_clock") {
    return std::make_unique<PinRunner>("twin_clock", std::make_unique<ClockByClock>());
  }
  if (name == "twin_event") {
    return std::make_unique<PinRunner>("twin_event", make_backend("lever", "twin"));
  }
  throw std::invalid_argument("there is no back-end with pins named " + name);
}

}  // namespace feltgate::bench
