// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/engine/engine_barrel.sv, clock by clock: the memories, and four threads that take
// turns. Documentation: docs/blocks/engine.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/engine_memory.hpp"
#include "feltgate/engine_ops.hpp"

namespace feltgate::law {
template <int AxisCount>
class EngineRuns;
}  // namespace feltgate::law

namespace feltgate {

/// Clocked twin of the engine's processor.
class EngineBarrel {
 public:
  struct In {
    /// One bit per thread: it is enabled; it requests a start; its next run starts with flag 1.
    unsigned run = 0, request = 0, first = 0;
    int bank = 0;  ///< of the parameters in force
    bool write_data = false, write_program = false, write_table = false;  ///< a word of the system
    int write_address = 0;
    std::uint32_t write_word = 0;
    unsigned write_high = 0;           ///< bits 32 to 35 of the word
    EngineOp read_op = EngineOp::add;  ///< operation of the system's turn
    bool keeps = false;
    int read_data = 0, read_address = 0;  ///< what the system reads: of data; of program or table
  };

  static constexpr int kSystem = 5;  ///< the turn in which the system reads

  /// Contents of the memories; a reset keeps them.
  EngineMemory memory;

  void reset() {
    constexpr int turns[] = {0, 3, 2, 5, 1, 4, 0, 3};
    for (std::size_t n = 0; n < at_.size(); ++n) {
      at_[n] = Turn{};
      at_[n].turn = turns[n];
    }
    acc_ = {};
  }

  // Values during a clock, before it ends. A number in a name is a stage of the pipeline.
  int thread5() const { return at_[5].turn & 3; }
  /// Whether a run of thread5() starts with this clock.
  bool starts(unsigned run_request) const {
    return at_[5].turn < 4 && !at_[5].valid && (run_request >> thread5() & 1U) != 0;
  }
  /// Whether the run of thread5() ends with this clock.
  bool ended(unsigned run) const { return at_[5].valid && !goes_on(run); }
  /// Whether a word of the system may be written in the next clock.
  bool free() const { return !at_[2].valid && at_[2].turn != kSystem; }
  bool beat() const { return at_[1].turn == kSystem; }
  bool high_read() const { return at_[3].turn == kSystem; }
  std::uint64_t program_word() const { return at_[1].word; }
  unsigned table_high() const { return static_cast<unsigned>(at_[3].table >> 32); }
  /// Result of the instruction at the last stage; where it goes: an output, an event.
  std::int32_t result() const { return at_[7].result; }
  bool output() const { return at_[7].valid && at_[7].i.dst == 2; }
  bool event() const { return at_[7].valid && at_[7].i.dst == 3; }
  bool last() const { return at_[7].valid && at_[7].i.last; }
  int thread7() const { return at_[7].turn & 3; }
  /// Number of that output or event.
  int number() const { return at_[7].i.d; }

  void clock(const In& in) {
    const Turn next = next_turn(in);
    write(in);
    at_[7] = at_[6];
    at_[6] = at_[5];
    finish(at_[6]);
    at_[5] = at_[4];
    decide(at_[5]);
    at_[4] = at_[3];
    join(at_[4], in);
    at_[3] = at_[2];
    at_[3].table_address = engine_table_address(at_[3].x, at_[3].b);
    at_[3].table = memory_before_.table(memory, at_[3].table_address);
    at_[2] = at_[1];
    decode(at_[2], in);
    at_[1] = at_[0];
    at_[1].word = memory_before_.program(memory, at_[1].pc);
    at_[0] = next;
    memory_before_ = {};
  }

 private:
  template <int AxisCount>
  friend class law::EngineRuns;

  /// An instruction in the pipeline, or a turn without one.
  struct Turn {
    int turn = 0;
    bool valid = false;
    bool flag = false, next_flag = false;  ///< before and after the instruction
    int bank = 0, pc = 0, b = 0;
    std::uint64_t word = 0, table = 0;
    EngineInstruction i;
    std::int32_t x = 0, y = 0, result = 0;
    int table_address = 0;
    bool writes_data = false, writes_program = false, writes_table = false;
    int address = 0;  ///< address in data or program memory
    unsigned high = 0;
    std::uint32_t extra = 0;
  };

  /// The words before this clock's writes: a read in the same clock gives the old word.
  struct Before {
    int data_at = -1, program_at = -1, table_at = -1;
    std::int32_t data_word = 0;
    std::uint64_t program_word = 0, table_word = 0;
    std::int32_t data(const EngineMemory& m, int n) const {
      return n == data_at ? data_word : m.data_at(n);
    }
    std::uint64_t program(const EngineMemory& m, int n) const {
      return n == program_at ? program_word : m.program_at(n);
    }
    std::uint64_t table(const EngineMemory& m, int n) const {
      return n == table_at ? table_word : m.table_at(n);
    }
  };

  bool goes_on(unsigned run) const {
    return at_[5].valid && !at_[5].i.last && (run >> thread5() & 1U) != 0;
  }

  Turn next_turn(const In& in) const {
    const Turn& t = at_[5];
    Turn next;
    next.turn = t.turn;
    const bool starts_now = starts(in.request);
    const bool on = t.valid || t.turn == kSystem;
    next.valid = starts_now || goes_on(in.run);
    next.flag = starts_now ? (in.first >> thread5() & 1U) != 0 : t.next_flag;
    next.bank = starts_now ? in.bank : t.bank;
    next.pc = on ? t.pc : thread5() * EngineMap::thread_words;
    return next;
  }

  void write(const In& in) {
    const Turn& t = at_[6];
    const auto wide =
        static_cast<std::uint64_t>(t.high) << 32 | static_cast<std::uint32_t>(t.result);
    if (t.writes_data) {
      memory_before_.data_at = t.address;
      memory_before_.data_word = memory.data_at(t.address);
      memory.set_data(t.address, t.result);
    }
    if (t.writes_program) {
      memory_before_.program_at = t.address;
      memory_before_.program_word = memory.program_at(t.address);
      memory.set_program(t.address, wide);
    }
    if (t.writes_table) {
      memory_before_.table_at = t.table_address;
      memory_before_.table_word = memory.table_at(t.table_address);
      memory.set_table(t.table_address, wide);
    }
    const bool keep = t.turn == kSystem ? in.keeps : t.valid && !t.i.last;
    acc_[static_cast<std::size_t>(t.turn)] = keep ? t.result : 0;
  }

  void decode(Turn& t, const In& in) const {
    t.i = engine_decode(t.word);
    const bool reads = t.turn == kSystem;
    const int thread = t.turn & 3;
    t.x = memory_before_.data(memory,
                              reads ? in.read_data : engine_read_address(t.i.a, thread, t.bank));
    t.y = memory_before_.data(memory, engine_read_address(t.i.b, thread, t.bank));
    t.b = reads ? in.read_address : t.i.b;
    if (t.valid) return;
    t.i.op = reads ? in.read_op : EngineOp::nop;
    t.i.mode = 2;
  }

  void join(Turn& t, const In& in) const {
    const int own = engine_write_address(t.i.d, t.turn & 3);
    t.writes_data = in.write_data || (t.valid && t.i.dst == 1 && own >= 0);
    t.writes_program = in.write_program;
    t.writes_table = in.write_table ||
                     (t.valid && t.i.op == EngineOp::tst && t.table_address >= memory.line_base);
    t.address = in.write_data || in.write_program ? in.write_address : own;
    if (in.write_table) t.table_address = in.write_address;
    t.high = in.write_high;
    t.extra = in.write_word;
  }

  static void decide(Turn& t) {
    const bool branch = engine_branches(t.i.op, t.i.mode, t.flag) || t.turn == kSystem;
    t.next_flag = t.i.op == EngineOp::cmp ? engine_compare(t.i.mode, t.flag, t.x, t.y) : t.flag;
    t.pc = branch ? t.b : (t.pc + 1) % EngineMap::program_words;
  }

  void finish(Turn& t) {
    const EngineState before{acc_[static_cast<std::size_t>(t.turn)], t.flag};
    const EngineState after = engine_step(t.i.op, t.i.mode, before, t.x, t.y, t.table);
    t.result = after.acc;
    if (!t.valid && (t.i.op == EngineOp::nop || t.i.op == EngineOp::tab)) {
      t.result |= static_cast<std::int32_t>(t.extra);
    }
  }

  std::array<Turn, 8> at_{};
  std::array<std::int32_t, 6> acc_{};
  Before memory_before_;
};

}  // namespace feltgate
