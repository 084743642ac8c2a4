// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine alone, RTL and twin in lock-step, with a host and ticks of 50 clocks.
// Documentation: docs/extremes.md
#pragma once

#include <cstdint>

#include "campaigns/extremes/case.hpp"
#include "engine/engine/engine_adapter.hpp"
#include "lock_step.hpp"

namespace feltgate::extremes {

/// One value from RTL and from twin.
struct Both {
  double rtl = 0, twin = 0;
};

inline void add(Outcome* o, const std::string& what, const std::string& unit,
                const Expected& expected, const Both& found) {
  o->add(what, unit, expected, found.rtl, found.twin);
}

/// Of one axis, or of three with another Verilated class.
template <int Axes = 1, class Rtl = Vengine>
class EnginePairOf {
 public:
  using Twin = test::EngineTwin<Axes>;
  using H = EngineMap::H;
  static constexpr int clocks_per_tick = 50;

  EnginePairOf() {
    rtl_.reset(3);
    twin_.reset();
  }
  /// Loads the image over the port, as a host does.
  explicit EnginePairOf(const EngineMemory& image) : EnginePairOf() {
    test::EngineHost host;
    host.load(image);
    for (const test::Access& a : host.queue) write(static_cast<int>(a.addr), a.word);
  }

  typename Twin::In in;  ///< inputs of the next clock; the pair makes the ticks itself

  void clock() {
    in.tick = ++since_ == clocks_per_tick;
    if (in.tick) since_ = 0, ++in.tick_count;
    Adapter::drive(*rtl_, in);
    rtl_.low();
    compare();
    rtl_.high();
    twin_.clock(in);
    compare();
    ++clocks_;
    in.enter = in.write = in.read = false;
  }
  void clock(std::int64_t n) {
    for (std::int64_t k = 0; k < n; ++k) clock();
  }

  void write(int addr, std::uint32_t word) {
    in.addr = static_cast<unsigned>(addr);
    in.wdata = word;
    in.write = true;
    do clock();
    while (twin_out().busy);
  }
  Both read(int addr) {
    in.addr = static_cast<unsigned>(addr);
    clock(40);
    const Both word{static_cast<double>(rtl_->rdata_o), static_cast<double>(twin_out().rdata)};
    in.read = true;
    clock();
    return word;
  }

  Both torque(int axis = 0) const {
    return {static_cast<double>(Adapter::torque(rtl_->torque_o, axis)),
            static_cast<double>(twin_out().torque[static_cast<std::size_t>(axis)])};
  }
  Both late() const { return {rtl_->late_o ? 1.0 : 0.0, twin_out().late ? 1.0 : 0.0}; }
  bool fresh() const { return twin_out().fresh; }
  bool rtl_fresh() const { return rtl_->fresh_o != 0; }
  bool event() const { return twin_out().event_valid; }

  void report(Outcome* outcome) const {
    outcome->rtl_s += static_cast<double>(clocks_) * 20e-9;
    outcome->twin_s += static_cast<double>(clocks_) * 20e-9;
    if (mismatches_ > 0 && outcome->mismatches == 0) outcome->first_mismatch = first_mismatch_;
    outcome->mismatches += mismatches_;
  }

 private:
  using Adapter = test::EngineAdapter<Axes, Rtl>;

  typename Twin::Out twin_out() const { return twin_.peek(in); }
  void compare() {
    test::Check check;
    Adapter::compare(check, *rtl_, twin_out());
    if (!check.failed()) return;
    if (mismatches_++ == 0) first_mismatch_ = std::string("engine: ") + check.first().signal;
  }

  RtlModel<Rtl> rtl_{1};
  Twin twin_;
  int since_ = 0;
  std::int64_t clocks_ = 0, mismatches_ = 0;
  std::string first_mismatch_;
};

using EnginePair = EnginePairOf<>;

}  // namespace feltgate::extremes
