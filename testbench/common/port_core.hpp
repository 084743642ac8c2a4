// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's register port behind a bus: only the twin of the registers, with ticks; the rest of
// the core is absent. Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <cmath>

#include "feltgate/generated/lever.hpp"
#include "feltgate/registers.hpp"

namespace feltgate::test {

/// What a parameter keeps of a written word: the nearest that its format has.
template <class D = Lever>
std::uint32_t word_kept(int address, std::uint32_t word) {
  for (const auto& p : D::parameters) {
    if (p.address != address || p.format.width() - p.format.sign >= 31) continue;  // any word
    const double size = std::ldexp(1.0, p.format.width()), value = static_cast<std::int32_t>(word);
    const double least = p.format.sign != 0 ? -size / 2 : 0;
    return static_cast<std::uint32_t>(
        static_cast<std::int32_t>(std::clamp(value, least, least + size - 1)));
  }
  return word;
}

class PortCore {
 public:
  using Twin = Registers<Lever>;

  /// The read data of the port in this clock.
  std::uint32_t rdata() const { return twin_.out().reg_rdata; }
  bool busy() const { return twin_.out().reg_busy; }
  const Twin& twin() const { return twin_; }
  int clock_of_tick() const { return clock_; }

  /// Runs one clock with these signals at the port.
  template <class Out>
  void clock(const Out& port) {
    Twin::In in;
    in.tick = clock_ == Lever::clocks_per_tick - 1;
    in.reg_addr = port.reg_addr;
    in.reg_wdata = port.reg_wdata;
    in.reg_write = port.reg_write;
    taken_ += port.reg_write && !busy();
    twin_.clock(in);
    clock_ = in.tick ? 0 : clock_ + 1;
  }
  /// Number of writes that the port accepted.
  int taken() const { return taken_; }

 private:
  Twin twin_;
  int clock_ = 0, taken_ = 0;
};

}  // namespace feltgate::test
