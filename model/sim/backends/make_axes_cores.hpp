// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The back-ends of a design with several axes: RTL and twin in lock-step. Needs the Verilated axes.
// Documentation: docs/architecture.md
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "lock_step_core.hpp"
#include "rtl_axes_ports.hpp"
#include "rtl_model.hpp"
#include "twin_axes.hpp"

namespace feltgate {

/// Compares the outputs of the device that do not belong to an axis.
template <int N>
std::string port_difference(const AxesOut<N>& rtl, const AxesOut<N>& twin) {
  const auto tell = [](const char* name, std::int64_t a, std::int64_t b) {
    return std::string(name) + ": rtl " + std::to_string(a) + ", twin " + std::to_string(b);
  };
  if (rtl.reg_busy != twin.reg_busy) return tell("reg_busy", rtl.reg_busy, twin.reg_busy);
  if (twin.rdata_known && rtl.reg_rdata != twin.reg_rdata) {
    return tell("reg_rdata", rtl.reg_rdata, twin.reg_rdata);
  }
  if (rtl.event_valid != twin.event_valid) {
    return tell("event_valid", rtl.event_valid, twin.event_valid);
  }
  if (!twin.event_valid) return {};
  if (rtl.event_number != twin.event_number) {
    return tell("event_number", rtl.event_number, twin.event_number);
  }
  if (rtl.event_value != twin.event_value) {
    return tell("event_value", rtl.event_value, twin.event_value);
  }
  return {};
}

/// Rtl is Verilator's class of feltgate_axes for this design. The twin leads and gives the results
/// of a run; the RTL follows in every clock.
template <class Rtl, int N>
class LockStepAxes : public TwinAxes<N> {
  using Base = TwinAxes<N>;
  using Base::in_, Base::twin_, Base::now_, Base::stop_, Base::mismatches_, Base::first_mismatch_,
      Base::first_mismatch_clock_;

 public:
  explicit LockStepAxes(const DesignInfo& design)
      : Base(design), bits_(design.data), half_clock_ps_(500'000'000'000 / design.clock_hz) {}
  void trace(const std::string& path, Clock from, Clock to) override {
    path_ = path;
    from_ = from;
    to_ = to;
  }

 private:
  void reset_beside(std::uint64_t seed) override {
    rtl_.emplace(seed);
    (*rtl_)->law_torque_i = 0;
    (*rtl_)->law_late_i = (*rtl_)->law_restart_i = 0;
    drive();
    rtl_->reset(4);
  }
  bool beside() const override { return true; }
  void drive() override { drive_axes<N>(**rtl_, in_); }

  void follow() override {
    const bool dumping = !path_.empty() && now_ >= from_ && (to_ < 0 || now_ <= to_);
    if (dumping && !rtl_->tracing()) rtl_->trace(path_, "1ps");
    (*rtl_)->stop_i = in_.stop;
    rtl_->low();
    if (dumping) rtl_->dump(static_cast<std::uint64_t>(2 * now_ * half_clock_ps_));
    (*rtl_)->stop_i = false;
    rtl_->high();
    if (dumping) rtl_->dump(static_cast<std::uint64_t>((2 * now_ + 1) * half_clock_ps_));
    const std::string wrong = compare();
    if (wrong.empty()) return;
    if (mismatches_++ > 0) return;
    first_mismatch_clock_ = now_;
    first_mismatch_ = "clock " + std::to_string(now_) + ", " + wrong;
  }

  /// The first output in which RTL and twin differ; empty if none.
  std::string compare() const {
    const Rtl& rtl = **rtl_;
    const AxesOut<N>& twin = twin_->out();
    for (std::size_t n = 0; n < N; ++n) {
      const CoreOut a = read_axis(rtl, bits_, static_cast<int>(n));
      CoreOut b = twin.axis[n];
      b.reg_rdata = 0;
      b.reg_busy = false;
      if (!(a == b)) return "axis " + std::to_string(n) + ", " + difference(a, b);
    }
    AxesOut<N> port;
    port.reg_busy = rtl.reg_busy_o != 0;
    port.reg_rdata = rtl.reg_rdata_o;
    port.event_valid = rtl.event_valid_o != 0;
    port.event_number = rtl.event_number_o;
    port.event_value = static_cast<std::int32_t>(rtl.event_value_o);
    return port_difference<N>(port, twin);
  }

  PortBits bits_;
  Clock half_clock_ps_;
  std::optional<RtlModel<Rtl>> rtl_;
  std::string path_;
  Clock from_ = 0, to_ = -1;
};

/// Makes the back-end "lockstep" of the design whose Verilated class is Rtl.
template <class Rtl, int N>
std::unique_ptr<AxesCores> make_rtl_axes(const DesignInfo& design) {
  return std::make_unique<LockStepAxes<Rtl, N>>(design);
}

}  // namespace feltgate
