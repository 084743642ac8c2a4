// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Interpreter of the engine's program words: one whole run of one thread at a time, bit by bit like
// the hardware. Documentation: docs/engine-isa.md
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "feltgate/engine_memory.hpp"
#include "feltgate/engine_ops.hpp"

namespace feltgate::law {

/// An event of a run; numbers 0 to 511.
struct MachineEvent {
  int number = 0;
  std::int32_t value = 0;
};

/// Words 48 to 63 of the thread: the inputs, as the hardware writes them before a run. Axis n:
/// position [count] at 3n, velocity at 3n + 1 and tau_hat at 3n + 2 in the design's formats. Word
/// 9: the tick's number. The rest is 0.
using MachineInputs = std::array<std::int32_t, 16>;

/// Results of a run.
struct MachineRun {
  /// Outputs 0 to 3 with their last written values, from this run or an earlier one.
  std::array<std::int32_t, 4> outputs{};
  unsigned written = 0;              ///< bit n: this run wrote output n
  std::vector<MachineEvent> events;  ///< of this run, in order
  int instructions = 0;
  bool ended = false;  ///< false: the limit of instructions stopped it
};

/// Four threads over one set of memories. Runs are executed as a whole: where threads exchange
/// words while both run, the order in hardware may differ.
class Machine {
 public:
  explicit Machine(const EngineMemory& memory = {}) : memory_(memory) {}

  /// The next run of each thread starts with flag 1, as after a load, an arming or an entry into
  /// the scene. Clears the delay lines to 0.
  void enter() {
    first_ = {true, true, true, true};
    for (int n = memory_.line_base; n < EngineMap::table_words; ++n) memory_.set_table(n, 0);
  }

  /// Sets parameter `word` (0 to 31) of the bank that is not in force; commit() puts it in force.
  void set_parameter(int word, std::int32_t value) {
    memory_.set_data(engine_read_address(EngineMap::D::parameter + word, 0, 1 - bank_), value);
  }
  void commit() { bank_ = 1 - bank_; }
  int bank() const { return bank_; }

  EngineMemory& memory() { return memory_; }
  const EngineMemory& memory() const { return memory_; }

  /// One run of `thread` (0 to 3) from its start. It stops after `limit` instructions, with
  /// MachineRun::ended = false. The reference is valid until the next run.
  const MachineRun& run(int thread, const MachineInputs& inputs, int limit = 100000) {
    return run_seen(thread, inputs, limit, [](int, std::int32_t, std::int32_t) {});
  }

  /// The same; before each instruction, `seen` gets its address and its operands x and y.
  template <class Seen>
  const MachineRun& run_seen(int thread, const MachineInputs& inputs, int limit, const Seen& seen) {
    const auto t = static_cast<std::size_t>(thread);
    for (int n = 0; n < 16; ++n) {
      memory_.set_data(thread * EngineMap::private_words + EngineMap::input_first + n,
                       inputs[static_cast<std::size_t>(n)]);
    }
    run_.written = 0;
    run_.events.clear();
    run_.instructions = 0;
    run_.ended = false;
    EngineState state{0, first_[t]};
    first_[t] = false;
    int pc = thread * EngineMap::thread_words;
    while (!run_.ended && run_.instructions < limit) {
      const EngineInstruction i = engine_decode(memory_.program_at(pc));
      const bool branch = engine_branches(i.op, i.mode, state.flag);
      state = step(i, thread, state, pc, seen);
      ++run_.instructions;
      run_.ended = i.last;
      pc = branch ? i.b : (pc + 1) % EngineMap::program_words;
    }
    return run_;
  }

 private:
  template <class Seen>
  EngineState step(const EngineInstruction& i, int thread, EngineState state, int pc,
                   const Seen& seen) {
    const std::int32_t x = memory_.data_at(engine_read_address(i.a, thread, bank_));
    const std::int32_t y = memory_.data_at(engine_read_address(i.b, thread, bank_));
    seen(pc, x, y);
    const int word = engine_table_address(x, i.b);
    state = engine_step(i.op, i.mode, state, x, y, memory_.table_at(word));
    if (i.op == EngineOp::tst && word >= memory_.line_base) {
      memory_.set_table(word, static_cast<std::uint32_t>(state.acc));
    }
    switch (static_cast<EngineTarget>(i.dst)) {
      case EngineTarget::none:
        break;
      case EngineTarget::data:
        if (const int to = engine_write_address(i.d, thread); to >= 0) {
          memory_.set_data(to, state.acc);
        }
        break;
      case EngineTarget::output:
        run_.outputs[static_cast<std::size_t>(i.d & 3)] = state.acc;
        run_.written |= 1U << (i.d & 3);
        break;
      case EngineTarget::event:
        run_.events.push_back({i.d, state.acc});
        break;
    }
    return state;
  }

  EngineMemory memory_;
  MachineRun run_;
  std::array<bool, 4> first_{true, true, true, true};
  int bank_ = 0;
};

}  // namespace feltgate::law
