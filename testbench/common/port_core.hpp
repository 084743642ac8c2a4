// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core behind a bus: its twin, of which only the register port is used. Documentation:
// docs/architecture.md
#pragma once

#include <algorithm>
#include <cmath>

#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "twins.hpp"

namespace feltgate::test {

/// What a parameter keeps of a written word: the nearest that its format has.
template <class D = Lever>
std::uint32_t word_kept(int address, std::uint32_t word) {
  for (const auto& p : D::parameters) {
    if (p.address != address || p.field.width() - p.field.sign >= 32) continue;  // any word
    const double size = std::ldexp(1.0, p.field.width()), value = static_cast<std::int32_t>(word);
    const double least = p.field.sign != 0 ? -size / 2 : 0;
    return static_cast<std::uint32_t>(
        static_cast<std::int32_t>(std::clamp(value, least, least + size - 1)));
  }
  return word;
}

class PortCore {
 public:
  /// The read data of the port in this clock.
  std::uint32_t rdata() const { return core_.out().reg_rdata; }
  bool busy() const { return core_.out().reg_busy; }
  std::uint32_t parameter(int address) const { return core_.axis().parameter(address); }
  std::uint32_t control() const { return core_.axis().control().word; }
  bool disarm() const { return core_.axis().blocks().host.registers.disarm(); }
  int clock_of_tick() const { return core_.clock_of_tick(); }

  /// Runs one clock with these signals at the port.
  template <class Out>
  void clock(const Out& port) {
    CoreIn in;
    in.reg_addr = port.reg_addr;
    in.reg_wdata = port.reg_wdata;
    in.reg_write = port.reg_write;
    taken_ += port.reg_write && !busy();
    core_.clock(in);
  }
  /// Number of writes that the port accepted.
  int taken() const { return taken_; }

 private:
  test::CoreOf<Lever> core_;
  int taken_ = 0;
};

}  // namespace feltgate::test
