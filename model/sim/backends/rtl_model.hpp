// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A Verilated module with clk_i and rst_ni: power-up, clock edges, waveform. Classes on top of it
// set and compare the ports. Documentation: docs/testing.md
#pragma once

#include <verilated.h>
#include <verilated_fst_c.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace feltgate {

namespace detail {

/// Whether the module was Verilated with waveforms.
template <class Rtl, class = void>
struct HasTrace : std::false_type {};
template <class Rtl>
struct HasTrace<
    Rtl, std::void_t<decltype(std::declval<Rtl&>().trace(std::declval<VerilatedFstC*>(), 99))>>
    : std::true_type {};

}  // namespace detail

/// Rtl is Verilator's class of the module.
template <class Rtl>
class RtlModel {
 public:
  /// A new chip: its registers hold random bits from `seed`, reset is not active yet, the clock is
  /// low.
  explicit RtlModel(std::uint64_t seed) {
    context_.randReset(2);
    context_.randSeed(static_cast<int>(seed % 0x7ffffffeU) + 1);
    context_.traceEverOn(detail::HasTrace<Rtl>::value);
    rtl_ = std::make_unique<Rtl>(&context_);
    rtl_->rst_ni = 1;  // high, so that the first reset is an edge
    low();
  }
  ~RtlModel() {
    if (fst_) fst_->close();
    rtl_->final();
  }
  RtlModel(const RtlModel&) = delete;
  RtlModel& operator=(const RtlModel&) = delete;

  /// Access to the ports.
  Rtl& operator*() { return *rtl_; }
  const Rtl& operator*() const { return *rtl_; }
  Rtl* operator->() { return rtl_.get(); }
  const Rtl* operator->() const { return rtl_.get(); }

  void low() {
    rtl_->clk_i = 0;
    rtl_->eval();
  }
  void high() {
    rtl_->clk_i = 1;
    rtl_->eval();
  }
  void clock() {
    low();
    high();
  }
  /// Runs `clocks` clocks with reset active.
  void reset(int clocks) {
    rtl_->rst_ni = 0;
    for (int k = 0; k < clocks; ++k) clock();
    low();
    rtl_->rst_ni = 1;
  }

  /// From now on dump() writes to this file; `unit` is the unit of its times, such as "1ns".
  void trace(const std::string& path, const char* unit) {
    if constexpr (detail::HasTrace<Rtl>::value) {
      fst_ = std::make_unique<VerilatedFstC>();
      rtl_->trace(fst_.get(), 99);
      fst_->set_time_unit(unit);
      fst_->set_time_resolution(unit);
      fst_->open(path.c_str());
      if (fst_->isOpen()) return;
    }
    throw std::runtime_error(path + ": cannot be written; check the folder and the disk");
  }
  bool tracing() const { return fst_ != nullptr; }
  void dump(std::uint64_t time) { fst_->dump(time); }

 private:
  VerilatedContext context_;
  std::unique_ptr<Rtl> rtl_;
  std::unique_ptr<VerilatedFstC> fst_;
};

}  // namespace feltgate
