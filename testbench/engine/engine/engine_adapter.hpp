// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Connects the Verilated engine's ports to its twin's, and a host that writes and reads both.
// Documentation: docs/blocks/engine.md
#pragma once

#include <Vengine.h>

#include <deque>
#include <vector>

#include "feltgate/engine.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

namespace feltgate::test {

template <int Axes>
using EngineTwin = law::Engine<Axes>;

template <int Axes, class Rtl = Vengine>
struct EngineAdapter {
  using Twin = EngineTwin<Axes>;
  using In = typename Twin::In;
  using Out = typename Twin::Out;

  static void drive(Rtl& rtl, const In& in) {
    FELTGATE_DRIVE(rtl, in, armed, enter, locked, tick, tick_count);
    set(rtl.position_i, in.position);
    set(rtl.velocity_i, in.velocity);
    set(rtl.tau_hat_i, in.tau_hat);
    rtl.crc_start_i = in.crc_start;
    rtl.addr_i = static_cast<std::uint16_t>(in.addr);
    rtl.wdata_i = in.wdata;
    rtl.write_i = in.write;
    rtl.read_i = in.read;
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Out& out) {
    for (int n = 0; n < Axes; ++n) {
      check("torque", torque(rtl.torque_o, n), out.torque[static_cast<std::size_t>(n)]);
    }
    FELTGATE_COMPARE(check, rtl, out, fresh, late, changed, crc_done, crc_good, event_valid);
    if (out.event_valid) {
      check("event_number", rtl.event_number_o, out.event_number);
      check("event_value", static_cast<std::int32_t>(rtl.event_value_o), out.event_value);
    }
    if (out.rdata_known) check("rdata", rtl.rdata_o, out.rdata);
    check("busy", rtl.busy_o, out.busy);
  }

  template <class Port>
  static std::int32_t torque(const Port& port, int n) {
    constexpr int bits = 21;
    const std::uint64_t raw = std::uint64_t{port} >> (bits * n);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(raw << 11)) >> 11;
  }

 private:
  template <class Port>
  static void set(Port& port, const typename Twin::Inputs::Axes& words) {
    if constexpr (Axes == 1) {
      port = static_cast<std::uint32_t>(words[0]);
    } else {
      for (int n = 0; n < Axes; ++n) {
        port[n] = static_cast<std::uint32_t>(words[static_cast<std::size_t>(n)]);
      }
    }
  }
};

/// The next access of a host: a write, or a read that holds the address.
struct Access {
  unsigned addr = 0;
  std::uint32_t word = 0;
  bool write = false;
};

/// Does accesses one after another: a write as soon as the port is free, a read after some rounds
/// of the threads.
class EngineHost {
 public:
  std::deque<Access> queue;
  std::vector<std::uint32_t> read;  ///< words in the order of the reads

  void write(int addr, std::uint32_t word) {
    queue.push_back({static_cast<unsigned>(addr), word, true});
  }
  void ask(int addr) { queue.push_back({static_cast<unsigned>(addr), 0, false}); }

  template <class In, class Out>
  void drive(In& in, const Out& out) {
    in.write = in.read = false;
    if (queue.empty()) return;
    const Access& next = queue.front();
    in.addr = next.addr;
    if (next.write) {
      in.wdata = next.word;
      in.write = !out.busy;
      if (in.write) queue.pop_front();
      return;
    }
    held_ = out.busy ? 0 : held_ + 1;
    if (held_ < 32) return;
    held_ = 0;
    in.read = true;
    read.push_back(out.rdata);
    queue.pop_front();
  }

  /// Writes all words of an image that are not 0, with the settings that belong to them.
  void load(const EngineMemory& m) {
    using H = EngineMap::H;
    write(H::run, 0);
    for (int n = 0; n < 512; ++n) {
      if (m.program_at(n) != 0) word(H::program, n, m.program_at(n));
      if (m.table_at(n) != 0) word(H::table, n, m.table_at(n));
      if (m.data_at(n) != 0) write(H::data + n, static_cast<std::uint32_t>(m.data_at(n)));
    }
    write(H::line_base, static_cast<std::uint32_t>(m.line_base));
  }

 private:
  void word(int base, int n, std::uint64_t w) {
    write(EngineMap::H::high, static_cast<std::uint32_t>(w >> 32));
    write(base + n, static_cast<std::uint32_t>(w));
  }
  int held_ = 0;
};

}  // namespace feltgate::test
