// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The axes of one design: RTL, twin, and both in lock-step. Needs the Verilated axes.
// Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "axes_cores.hpp"
#include "feltgate/feltgate_axes.hpp"
#include "lock_step_core.hpp"
#include "rtl_axes_ports.hpp"
#include "rtl_model.hpp"

namespace feltgate {

/// Outputs of the device beside those of its axes.
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

/// Rtl is Verilator's class of feltgate_axes for design D. The twin leads and gives what a run asks
/// for; with `with_rtl` the RTL follows in every clock.
template <class Rtl, class D>
class DesignAxes : public AxesCores {
 public:
  static constexpr int N = D::axes;
  static_assert(N >= 2 && D::engine != 0, "several axes with an engine");

  explicit DesignAxes(bool with_rtl) : AxesCores(design_info<D>(), N), with_rtl_(with_rtl) {}

  void trace(const std::string& path, Clock from, Clock to) override {
    if (!with_rtl_) {
      throw std::invalid_argument(
          "--fst: the engine twin has no waveform; choose --engine rtl or all");
    }
    path_ = path;
    from_ = from;
    to_ = to;
  }

  void reset(std::uint64_t seed, const Pins& pins) override {
    pins_ = pins;
    for (auto& edges : edges_) edges.clear();
    writes_.clear();
    now_ = mismatches_ = 0;
    first_mismatch_.clear();
    in_ = {};
    twin_ = std::make_unique<Twin>();
    rtl_.reset();
    if (!with_rtl_) return;
    for (std::size_t n = 0; n < N; ++n) in_.axis[n].encoder = pins_[n];
    rtl_.emplace(seed);
    (*rtl_)->law_torque_i = 0;
    (*rtl_)->law_late_i = (*rtl_)->law_restart_i = 0;
    drive_axes<D, N>(**rtl_, in_);
    rtl_->reset(4);
  }

  void advance(Clock clocks) override {
    snapshots_.clear();
    for (const Clock end = now_ + clocks; now_ < end;) {
      in_.stop = stop_;
      Clock until = end;
      for (std::size_t n = 0; n < N; ++n) {
        auto& edges = edges_[n];
        for (; !edges.empty() && edges.front().clock <= now_; edges.pop_front()) {
          pins_[n] = edges.front().pins;
        }
        in_.axis[n].encoder = pins_[n];
        if (!edges.empty()) until = std::min(until, edges.front().clock);
      }
      bool writes = false;
      if (!writes_.empty()) {
        const int ahead = host_write_clock - twin_->clock_of_tick();
        writes = ahead == 0 && !twin_->glue().busy() && !twin_->out().reg_busy;
        until = std::min(until, now_ + (ahead == 0 ? 1 : ahead > 0 ? ahead : ahead + tick));
      }
      if (writes) issue_write();
      run(until - now_);
      in_.reg_write = false;
    }
  }

  int duty(std::size_t axis) const override { return twin_->out().axis[axis].duty_active; }
  bool gates_enabled(std::size_t axis) const override {
    return twin_->out().axis[axis].gates_enable;
  }

 private:
  using Twin = FeltgateAxes<D, N, true, true>;
  static constexpr int tick = D::clocks_per_tick;

  void issue_write() {
    in_.reg_addr = writes_.front().first;
    in_.reg_wdata = writes_.front().second;
    in_.reg_write = true;
    writes_.pop_front();
    ++writes_done_;
  }

  /// With the inputs held.
  void run(Clock clocks) {
    if (!with_rtl_ && !in_.reg_write) {
      // Without RTL nobody reads; an address of the engine would have it go clock by clock.
      if (writes_.empty()) in_.reg_addr = 0;
      twin_->run(in_, clocks, [this] { keep(); });
      now_ += clocks;
      return;
    }
    if (with_rtl_) drive_axes<D, N>(**rtl_, in_);
    for (Clock k = 0; k < clocks; ++k) {
      twin_->clock(in_);
      if (with_rtl_) follow();
      ++now_;
      if (twin_->out().axis[0].snapshot_valid) keep();
    }
  }

  void follow() {
    const bool dumping = !path_.empty() && now_ >= from_ && (to_ < 0 || now_ <= to_);
    if (dumping && !rtl_->tracing()) rtl_->trace(path_, "1ps");
    (*rtl_)->stop_i = in_.stop;
    rtl_->low();
    if (dumping) rtl_->dump(static_cast<std::uint64_t>(2 * now_ * half_clock_ps));
    (*rtl_)->stop_i = false;
    rtl_->high();
    if (dumping) rtl_->dump(static_cast<std::uint64_t>((2 * now_ + 1) * half_clock_ps));
    const std::string wrong = compare();
    if (wrong.empty()) return;
    if (mismatches_++ > 0) return;
    first_mismatch_clock_ = now_;
    first_mismatch_ = "clock " + std::to_string(now_) + ", " + wrong;
  }

  /// The first output in which RTL and twin differ; empty: none.
  std::string compare() const {
    const Rtl& rtl = **rtl_;
    const AxesOut<N>& twin = twin_->out();
    for (std::size_t n = 0; n < N; ++n) {
      const CoreOut a = read_axis<D>(rtl, static_cast<int>(n));
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

  void keep() {
    AxesSnapshot s;
    for (std::size_t n = 0; n < N; ++n) {
      s[n] = Snapshot(twin_->out().axis[n], twin_->core(static_cast<int>(n)).sampled_travel(),
                      writes_done_);
    }
    const EngineWatch& watch = twin_->glue().watch();
    s[0].law_begins = watch.begins;
    s[0].law_known = watch.in_force.has_value();
    s[0].law_tick = watch.in_force.value_or(0);
    s[0].law_changes = watch.changes_at_begin;
    snapshots_.push_back(s);
  }
  static constexpr Clock half_clock_ps = 500'000'000'000 / D::clock_hz;

  bool with_rtl_;
  std::unique_ptr<Twin> twin_;
  std::optional<RtlModel<Rtl>> rtl_;
  AxesIn<N> in_;
  std::int64_t writes_done_ = 0;
  std::string path_;
  Clock from_ = 0, to_ = -1;
};

template <class Rtl, class D>
std::unique_ptr<AxesCores> make_design_axes(const std::string& kind) {
  if (kind == "twin") return std::make_unique<DesignAxes<Rtl, D>>(false);
  if (kind == "lockstep") return std::make_unique<DesignAxes<Rtl, D>>(true);
  throw std::invalid_argument("engine \"" + kind + "\" is unknown; choose twin or lockstep");
}

}  // namespace feltgate
