// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/engine/engine.sv, clock by clock: runs force laws as programs of four threads, which
// start with ticks, and has a port for the host. Documentation: docs/blocks/engine.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/engine_barrel.hpp"
#include "feltgate/engine_parts.hpp"

namespace feltgate::law {

/// Clocked twin of an engine for AxisCount axes.
template <int AxisCount = 1>
class Engine {
 public:
  using Inputs = EngineInputs<AxisCount>;
  using Outputs = EngineOutputs<AxisCount>;

  struct In {
    bool armed = false;
    bool enter = false;   ///< one clock: the scene of laws was entered
    bool locked = false;  ///< only parameters and COMMIT can be written
    bool tick = false;    ///< one clock; the inputs belong to this tick and are held
    std::uint32_t tick_count = 0;
    typename Inputs::Axes position{}, velocity{}, tau_hat{};
    bool crc_start = false;  ///< one clock: starts a check of the memories
    unsigned addr = 0;       ///< 12 bits
    std::uint32_t wdata = 0;
    bool write = false;  ///< one clock, while not busy
    bool read = false;   ///< one clock: rdata was taken
  };
  struct Out {
    std::array<std::int32_t, AxisCount> torque{};  ///< raw
    /// fresh: one clock, torques of all axes have appeared since its last one. late: no such
    /// torques for more than max_age ticks. crc_done: one clock, a check has ended. crc_good: it
    /// fitted.
    bool fresh = false, late = false, crc_done = false, crc_good = false;
    bool changed = false;  ///< one clock: torques may jump from now on
    bool event_valid = false;
    int event_number = 0;          ///< valid with event_valid
    std::int32_t event_value = 0;  ///< valid with event_valid
    std::uint32_t rdata = 0;
    bool rdata_known = false;  ///< false for a few rounds after a reset
    bool busy = false;         ///< the port takes no write
  };

  /// `max_age` [tick]: its value after a reset where the configuration does not state one. The
  /// torques have `torque_bits`.
  explicit Engine(unsigned max_age = 0, int torque_bits = 21) : outputs_(torque_bits) {
    configure({}, EngineReset{}, max_age);
  }

  /// Contents of the memories after power-up; a reset keeps them.
  EngineMemory& memory() { return barrel_.memory; }

  /// Sets the state after power-up, with these contents and the words that a reset restores.
  void configure(const EngineMemory& memory, const EngineReset& words) {
    configure(memory, words, reset_.max_age);
  }

  void reset() {
    last_ = In{};
    barrel_.reset();
    barrel_.memory.line_base = static_cast<int>(reset_.line_base);
    inputs_.reset();
    outputs_.reset();
    commit_ = EngineCommit{};
    mailbox_ = EngineMailbox{};
    lines_ = EngineLines{};
    crc_.reset();
    events_.reset();
    registers_ = Registers{};
    registers_.run = reset_.run;
    registers_.max_age = reset_.max_age;
    registers_.mailbox_first = static_cast<int>(reset_.mailbox_first);
    registers_.mailbox_age = reset_.mailbox_age;
    registers_.crc = reset_.crc;
  }

  Out peek(const In& in) const {
    Out out;
    out.torque = outputs_.torque;
    out.fresh = outputs_.fresh;
    out.late = outputs_.late;
    out.changed = mailbox_.jumps;
    out.crc_done = crc_.done;
    out.crc_good = crc_.good;
    out.event_valid = barrel_.event();
    out.event_number = barrel_.number();
    out.event_value = barrel_.result();
    out.rdata_known = registers_.clocks == kKnown || in_registers(in.addr);
    out.rdata = in_registers(in.addr) ? register_word(in.addr) : registers_.read;
    out.busy = busy();
    return out;
  }

  /// Outputs after the last clock(), for the address held in it.
  Out out() const { return peek(last_); }

  /// Whether a thread is in a run, or about to start one: its inputs have been latched.
  bool running(int thread) const { return (inputs_.running >> thread & 1U) != 0; }
  /// All events since the reset, at most EngineEvents::most_told.
  const std::vector<EngineEvents::Event>& told() const { return events_.told; }

  void clock(const In& in) {
    last_ = in;
    Registers& r = registers_;
    using H = EngineMap::H;
    const bool write = in.write && !busy();
    const bool open = write && in_registers(in.addr) && !in.locked;
    const auto addr = static_cast<int>(in.addr);
    const bool write_run = open && addr == H::run;
    const bool enter = in.enter || (in.armed && !r.armed) || write_run;

    // Values in this clock, before anything changes.
    const int thread = barrel_.thread5();
    const bool clearing = lines_.clearing;
    const unsigned run = clearing ? 0 : r.run;
    const bool started = barrel_.starts(inputs_.request), ended = barrel_.ended(run);
    const bool free = barrel_.free(), beat = barrel_.beat();
    const bool input_taken = inputs_.wanted() && free;
    const bool host_taken = r.waits && free && !inputs_.wanted();
    const bool line_free = free && !inputs_.wanted() && !r.waits;
    const int line_base = barrel_.memory.line_base;
    const bool program_read = beat && reads_program(in);
    const EngineBarrel::In to = barrel_inputs(in, run);

    // The barrel sees a write that starts now in the next clock.
    Written next = written(input_taken, host_taken);
    if (lines_.taken(line_base, line_free)) next.table = true;
    if (clearing && !inputs_.wanted() && !r.waits) next.address = lines_.address;
    next.word = input_taken  ? inputs_.word(in.tick_count, in.position, in.velocity, in.tau_hat)
                : host_taken ? r.data
                             : r.program;
    outputs_.clock({write_run || clearing, mailbox_late(), r.run != 0, enter || clearing || r.young,
                    in.tick, r.max_age, barrel_.result(), barrel_.output(), barrel_.last(),
                    barrel_.thread7(), barrel_.number() & 3});
    events_.clock(barrel_.event(), {barrel_.number(), barrel_.result(), in.tick_count},
                  in.read && addr == H::event_tick);
    const bool was_committing = commit_.committing();
    const bool was_checking = commit_.checking, was_crc_busy = crc_.busy();
    const int bank = commit_.bank;
    const bool asks = write && addr == H::commit && (in.wdata & 1U) != 0;
    const bool step = in.tick_count % EngineMap::mailbox_step == 0;
    mailbox_.clock(
        {in.tick, step, watches_mailbox(), r.mailbox_age, commit_.taken(in.tick), commit_.differs});
    commit_.clock({asks, was_crc_busy || r.lands != 0, in.tick, beat, barrel_.result() < 0,
                   inputs_.running, r.mailbox_first});
    const unsigned high = crc_.reads_program() ? r.program_high : r.table_high;
    const std::uint32_t result = static_cast<std::uint32_t>(barrel_.result());
    crc_.clock({in.crc_start, was_checking || r.waits, beat, std::uint64_t{high} << 32 | result,
                barrel_.memory.line_base, r.crc});
    const bool overrun = inputs_.due_again(run);
    lines_.clock(enter, line_base, line_free);
    inputs_.clock({run, in.tick, open && addr >= H::divider0 && addr <= H::divider3,
                   (addr - H::divider0) & 3, static_cast<int>(in.wdata & 0xfffU), started, ended,
                   thread, input_taken});

    if (beat) {
      r.read = in.addr >= H::program_high
                   ? (in.addr >= H::table_high ? r.table_high : r.program_high)
                   : result;
    }
    if (barrel_.high_read()) r.table_high = barrel_.table_high();
    r.program = program_read ? static_cast<std::uint32_t>(barrel_.program_word()) : 0;
    if (beat) r.program_high = static_cast<unsigned>(barrel_.program_word() >> 32);
    barrel_.clock(to);
    r.written = next;

    r.lands = (r.lands << 1 & 7U) | (host_taken ? 1U : 0U);
    if (host_taken) r.waits = false;
    if (write) take(in, bank, was_committing);
    if (write && addr == H::commit && (in.wdata & 2U) != 0) r.dropped = false;
    if (write && was_committing && (asks || of_parameters(in.addr))) r.dropped = true;
    if (write && in.locked && !of_parameters(in.addr) && in.addr >> 9 <= 2) r.dropped = true;
    r.overrun = (r.overrun || overrun) && !write_run;
    if (started) r.first &= ~(1U << thread);
    if (enter) r.first = 15;
    r.armed = in.armed;
    r.young = false;
    if (open) set_register(addr, in.wdata);
    r.clocks = std::min(r.clocks + 1, kKnown);
  }

 private:
  template <int Axes>
  friend class EngineRuns;

  static constexpr int kKnown = 40;
  static constexpr int kZero = EngineMap::private_words - 1;

  struct Written {
    bool data = false, program = false, table = false;
    int address = 0;
    unsigned high = 0;
    std::uint32_t word = 0;
  };
  struct Registers {
    unsigned high = 0, run = 0, max_age = 0, first = 15, mailbox_age = 0;
    int mailbox_first = EngineMap::parameter_words;
    std::uint32_t crc = 0;
    bool armed = false, overrun = false, dropped = false;
    bool young = true;  ///< the first clock after a reset
    bool waits = false, waits_program = false, waits_table = false;
    int address = 0;
    std::uint32_t data = 0;
    unsigned lands = 0;  ///< a word on its way to its memory
    std::uint32_t program = 0, read = 0;
    unsigned program_high = 0, table_high = 0;
    Written written;
    int clocks = 0;
  };

  void configure(const EngineMemory& memory, const EngineReset& words, unsigned max_age) {
    reset_ = words;
    if (words.max_age == 0) reset_.max_age = max_age;
    barrel_.memory = memory;
    inputs_.configure({words.divider0, words.divider1, words.divider2, words.divider3});
    reset();
  }
  static bool in_registers(unsigned addr) { return addr >> 9 == EngineMap::H::high >> 9; }
  static bool of_parameters(unsigned addr) { return addr / 64 == EngineMap::D::parameter / 64; }
  bool watches_mailbox() const {
    return (registers_.mailbox_first & EngineMap::parameter_words) == 0;
  }
  bool mailbox_late() const { return mailbox_.late(watches_mailbox()); }
  bool busy() const {
    return registers_.waits || commit_.checking || crc_.busy() || lines_.clearing;
  }
  bool reads_program(const In& in) const {
    return !commit_.checking && (crc_.reads ? crc_.reads_program() : (in.addr >> 9 & 1U) != 0);
  }
  bool reads_table(const In& in) const {
    if (commit_.checking) return false;
    return crc_.reads ? crc_.reads_table() : in.addr >> 10 != 0 && (in.addr >> 9 & 1U) == 0;
  }

  EngineBarrel::In barrel_inputs(const In& in, unsigned run) const {
    const Registers& r = registers_;
    EngineBarrel::In to;
    to.run = run;
    to.request = inputs_.request;
    to.first = r.first;
    to.bank = commit_.bank;
    to.write_data = r.written.data;
    to.write_program = r.written.program;
    to.write_table = r.written.table;
    to.write_address = r.written.address;
    to.write_word = r.written.word;
    to.write_high = r.written.high;
    to.keeps = commit_.minus();
    to.read_op = reads_program(in) ? EngineOp::nop
                 : reads_table(in) ? EngineOp::tab
                 : commit_.minus() ? EngineOp::sub
                                   : EngineOp::add;
    to.read_address = crc_.reads ? crc_.address : static_cast<int>(in.addr & 0x1ffU);
    to.read_data = commit_.checking ? commit_.address() : reads_table(in) ? kZero : to.read_address;
    return to;
  }

  Written written(bool input_taken, bool host_taken) const {
    const Registers& r = registers_;
    Written w;
    w.data = input_taken || (host_taken && !r.waits_program && !r.waits_table);
    w.program = host_taken && r.waits_program;
    w.table = host_taken && r.waits_table;
    w.address = inputs_.wanted() ? inputs_.address() : r.address;
    w.high = w.program || w.table ? r.high : 0;
    return w;
  }

  /// Takes a word of the host for a memory.
  void take(const In& in, int bank, bool committing) {
    Registers& r = registers_;
    const unsigned region = in.addr >> 9;
    const bool parameter = of_parameters(in.addr);
    const bool input = in.addr < EngineMap::D::exchange &&
                       in.addr % EngineMap::private_words >= EngineMap::input_first;
    r.waits_program = (in.addr & EngineMap::H::program) != 0;
    r.waits_table = (in.addr & EngineMap::H::table) != 0;
    const int word = static_cast<int>(in.addr) % EngineMap::data_words;
    const int other = bank != 0 ? EngineMap::D::parameter : EngineMap::D::parameter_bank;
    r.address = parameter ? other + word % EngineMap::parameter_words : word;
    r.data = in.wdata;
    if (parameter ? !committing : !in.locked && region <= 2 && !input) r.waits = true;
  }

  void set_register(int addr, std::uint32_t word) {
    using H = EngineMap::H;
    Registers& r = registers_;
    if (addr == H::high) r.high = word & 0xfU;
    if (addr == H::run) r.run = word & 0xfU;
    if (addr == H::line_base) barrel_.memory.line_base = static_cast<int>(word & 0x3ffU);
    if (addr == H::max_age) r.max_age = word & 0xffffU;
    if (addr == H::mailbox_first) r.mailbox_first = static_cast<int>(word & 0x3fU);
    if (addr == H::mailbox_age) r.mailbox_age = word & 0xffffU;
    if (addr == H::crc) r.crc = word;
  }

  std::uint32_t register_word(unsigned addr) const {
    using H = EngineMap::H;
    switch (H::high + static_cast<int>(addr % 32)) {
      case H::status:
        return status();
      case H::refused_word:
        return static_cast<std::uint32_t>(commit_.refused_word);
      case H::event_count:
        return static_cast<std::uint32_t>(events_.count);
      case H::event_number:
        return static_cast<std::uint32_t>(events_.oldest().number);
      case H::event_value:
        return static_cast<std::uint32_t>(events_.oldest().value);
      case H::event_tick:
        return events_.oldest().tick;
      case H::events_lost:
        return static_cast<std::uint32_t>(events_.lost);
      default:
        return 0;
    }
  }
  std::uint32_t status() const {
    using S = EngineMap::S;
    const auto at = [](bool on, int bit) { return static_cast<std::uint32_t>(on) << bit; };
    return at(commit_.committing(), S::status_committing) | at(commit_.refused, S::status_refused) |
           at(crc_.busy(), S::status_crc_busy) | at(crc_.good, S::status_crc_good) |
           at(outputs_.late, S::status_late) | at(commit_.bank != 0, S::status_bank) |
           at(registers_.overrun, S::status_overrun) | at(mailbox_late(), S::status_mailbox_late) |
           inputs_.running << S::status_running | at(registers_.dropped, S::status_dropped);
  }

  In last_;
  EngineBarrel barrel_;
  Inputs inputs_;
  Outputs outputs_;
  EngineCommit commit_;
  EngineMailbox mailbox_;
  EngineLines lines_;
  EngineCrc crc_;
  EngineEvents events_;
  Registers registers_;
  EngineReset reset_;
};

}  // namespace feltgate::law
