// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Parts of EngineRuns: ticks, writes that can be undone, decoded instructions, outputs that appear
// later. Documentation: docs/blocks/engine.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "feltgate/engine_memory.hpp"
#include "feltgate/engine_ops.hpp"

namespace feltgate::law {

/// Timing of the device, in clocks. `clocks_per_tick`: length of a tick. `position_ahead`,
/// `velocity_ahead`: how long before the clock that latches the inputs the axes show the new tick's
/// position and velocity. `known_for`: a run that begins up to known_for + 1 clocks after that
/// clock still belongs to what is told of the tick.
struct RunTiming {
  int clocks_per_tick, position_ahead, velocity_ahead, known_for;
};

/// The measurements of the axes, tick by tick. Clocks count from begin().
template <class Axes>
class RunTicks {
 public:
  struct Tick {
    std::int64_t clock;
    Axes position, velocity, tau_hat;
  };

  explicit RunTicks(const RunTiming& timing) : timing_(timing) {}
  /// Starts anew; clock 0 is the clock `clock_of_tick` of the tick `count`.
  void begin(std::uint32_t count, int clock_of_tick) {
    ticks_.clear();
    count_ = count;
    zero_ = -clock_of_tick;
  }
  void add(const Tick& tick) { ticks_.push_back(tick); }
  /// Sets the values that the axes show now.
  void show(const Axes& position, const Axes& velocity) {
    position_ = position;
    velocity_ = velocity;
  }
  /// Drops what nobody needs any more: all before clock n.
  void forget(std::int64_t n) {
    const auto kept = std::partition_point(ticks_.begin(), ticks_.end(), [&](const Tick& t) {
      return t.clock < n - timing_.clocks_per_tick;
    });
    ticks_.erase(ticks_.begin(), kept);
  }

  std::size_t size() const { return ticks_.size(); }
  int known_for() const { return timing_.known_for; }
  /// Runs with at least so many instructions, whose inputs come later than known_for(), give no
  /// torque before the next tick: they start at least two clocks later, and outputs appear four
  /// clocks after the end.
  int long_run() const {
    return (timing_.clocks_per_tick - timing_.known_for - 8) / EngineMap::round_clocks + 1;
  }
  std::uint32_t count_at(std::int64_t n) const {
    return count_ + static_cast<std::uint32_t>((n - zero_) / timing_.clocks_per_tick);
  }
  /// The first tick at clock n or later, searched from index `k` on; size() if there is none.
  std::size_t at_or_after(std::int64_t n, std::size_t k) const {
    while (k < ticks_.size() && ticks_[k].clock < n) ++k;
    return k;
  }
  bool is_tick(std::int64_t n, std::size_t k) const {
    return k < ticks_.size() && ticks_[k].clock == n;
  }
  /// Whether clock n is more than known_for() after the last tick; k as from at_or_after().
  bool beyond(std::int64_t n, std::size_t k) const {
    return k > 0 && k == ticks_.size() && n > ticks_[k - 1].clock + timing_.known_for;
  }
  /// The thread whose divider counts in clock n; -1 for none.
  int counted(std::int64_t n) const {
    for (const Tick& t : ticks_) {
      if (n > t.clock && n - t.clock <= 4) return static_cast<int>(n - t.clock - 1);
    }
    return -1;
  }
  // The values that the axes show in clock n; k as from at_or_after().
  Axes position(std::int64_t n, std::size_t k) const {
    if (shows_next(n, k, timing_.position_ahead)) return position_;
    const Tick* t = shown(n, k, timing_.position_ahead);
    return t == nullptr ? Axes{} : t->position;
  }
  Axes velocity(std::int64_t n, std::size_t k) const {
    if (shows_next(n, k, timing_.velocity_ahead)) return velocity_;
    const Tick* t = shown(n, k, timing_.velocity_ahead);
    return t == nullptr ? Axes{} : t->velocity;
  }
  Axes tau_hat(std::int64_t n, std::size_t k) const {
    const Tick* t = shown(n, k, 0);
    return t == nullptr ? Axes{} : t->tau_hat;
  }

 private:
  const Tick* shown(std::int64_t n, std::size_t k, int ahead) const {
    if (k < ticks_.size() && n >= ticks_[k].clock - ahead) return &ticks_[k];
    return k > 0 ? &ticks_[k - 1] : nullptr;
  }
  /// Whether the next tick, which is not in the list yet, already shows its first values.
  bool shows_next(std::int64_t n, std::size_t k, int ahead) const {
    return k > 0 && k == ticks_.size() &&
           n >= ticks_[k - 1].clock + timing_.clocks_per_tick - ahead;
  }

  RunTiming timing_;
  std::vector<Tick> ticks_;
  std::uint32_t count_ = 0;
  std::int64_t zero_ = 0;  ///< first clock of the tick `count_`
  Axes position_{}, velocity_{};
};

/// Writes into an engine's memory that can be undone: those since the last mark() but one.
class RunWrites {
 public:
  void mark() {
    std::swap(before_, after_);
    after_.clear();
  }
  void data(EngineMemory& m, int address, std::int32_t word) {
    after_.push_back({address, static_cast<std::uint32_t>(m.data_at(address))});
    m.set_data(address, word);
  }
  void table(EngineMemory& m, int address, std::uint32_t word) {
    after_.push_back({EngineMap::data_words + address, m.table_at(address)});
    m.set_table(address, word);
  }
  void take_back(EngineMemory& m) {
    take_back(m, after_);
    take_back(m, before_);
  }

 private:
  struct Old {
    int address;  ///< data memory; from data_words on, table memory
    std::uint64_t word;
  };
  static void take_back(EngineMemory& m, std::vector<Old>& writes) {
    for (auto w = writes.rbegin(); w != writes.rend(); ++w) {
      if (w->address < EngineMap::data_words) {
        m.set_data(w->address, static_cast<std::int32_t>(static_cast<std::uint32_t>(w->word)));
      } else {
        m.set_table(w->address - EngineMap::data_words, w->word);
      }
    }
    writes.clear();
  }
  std::vector<Old> before_, after_;
};

/// The instructions of a thread with their addresses resolved; each is decoded once.
class RunProgram {
 public:
  struct Step {
    EngineInstruction i;
    int x = 0, y = 0, to = -1;  ///< addresses in data memory
  };

  void begin(int thread, int bank) {
    thread_ = thread;
    bank_ = bank;
    known_.fill(false);
  }
  const Step& at(const EngineMemory& m, int pc) {
    const auto n = static_cast<std::size_t>(pc);
    Step& s = steps_[n];
    if (known_[n]) return s;
    s.i = engine_decode(m.program_at(pc));
    s.x = engine_read_address(s.i.a, thread_, bank_);
    s.y = engine_read_address(s.i.b, thread_, bank_);
    const bool data = s.i.dst == static_cast<int>(EngineTarget::data);
    s.to = data ? engine_write_address(s.i.d, thread_) : -1;
    known_[n] = true;
    return s;
  }
  /// Instructions that every run executes at least, up to its first event; at most `most`.
  int shortest(const EngineMemory& m, int most) {
    for (int n = 0; n < most; ++n) {
      const int pc = (thread_ * EngineMap::thread_words + n) % EngineMap::program_words;
      const EngineInstruction& i = at(m, pc).i;
      if (i.dst == static_cast<int>(EngineTarget::event)) return n;
      if (i.last || i.op == EngineOp::brf) return n + 1;
    }
    return most;
  }

 private:
  int thread_ = 0, bank_ = 0;
  std::array<Step, EngineMap::program_words> steps_{};
  std::array<bool, EngineMap::program_words> known_{};
};

/// The state that runs leave for the next run, just before the clock in which that one starts.
template <int AxisCount>
struct RunState {
  std::int64_t clock = 0;
  std::array<std::int32_t, AxisCount> torque{};
  unsigned renewed = 0, age = 0, first = 0;
  int count = 0;  ///< counter of the thread's divider, in ticks
  bool due = false, overrun = false, mail_late = false;
  unsigned mail_age = 0;
};

/// Outputs that appear in the clock after `clock`.
template <int AxisCount>
struct RunOutputs {
  std::int64_t clock = 0;
  unsigned mask = 0;
  std::array<std::int32_t, AxisCount> torque{};

  bool renews(unsigned renewed) const {
    return mask != 0 && (renewed | mask) == (1U << AxisCount) - 1;
  }
  /// Applies the outputs to `s`; `silent`: the torques stay 0.
  void appear(RunState<AxisCount>* s, bool silent) const {
    for (std::size_t n = 0; n < torque.size(); ++n) {
      if ((mask >> n & 1U) != 0) s->torque[n] = silent ? 0 : torque[n];
    }
    if (renews(s->renewed)) s->age = 0;
    s->renewed = renews(s->renewed) ? 0 : s->renewed | mask;
  }
};

}  // namespace feltgate::law
