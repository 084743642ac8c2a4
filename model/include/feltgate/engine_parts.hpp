// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twins of the engine's parts around the barrel, clock by clock: starts and inputs, outputs and
// their age, CRC, events. Documentation: docs/blocks/engine.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "feltgate/engine_parameters.hpp"
#include "feltgate/generated/engine.hpp"

namespace feltgate {

/// Twin of rtl/engine/engine_inputs.sv: the dividers, the inputs and the starts of the threads.
template <int AxisCount>
class EngineInputs {
 public:
  using Axes = std::array<std::int32_t, AxisCount>;
  static constexpr int kWords = EngineMap::input_axis_words * AxisCount + 1;

  struct In {
    unsigned run = 0;  ///< enabled threads, one bit each
    bool tick = false;
    bool divide = false;                  ///< `divider` is written for the thread `divided`
    int divided = 0, divider = 0;         ///< the divider in ticks
    bool started = false, ended = false;  ///< a run of `thread`
    int thread = 0;
    bool taken = false;  ///< the word that is wanted is written
  };

  /// One bit per thread: inputs are complete and a start is requested; inputs are latched, or it
  /// runs.
  unsigned request = 0, running = 0;

  /// Dividers and their counters are memory: a reset keeps them.
  void reset() {
    request = running = due_ = 0;
    counting_ = loading_ = written_ = false;
    counted_ = loaded_ = word_ = 0;
  }

  /// Sets the state after power-up.
  void configure(const std::array<unsigned, 4>& dividers) {
    for (std::size_t t = 0; t < dividers.size(); ++t) dividers_[t] = static_cast<int>(dividers[t]);
    counts_ = {};
  }

  /// Whether a word of the inputs waits to be written; its address in data memory; the word.
  bool wanted() const { return loading_ && word_ != kWords; }
  int address() const {
    return loaded_ * EngineMap::private_words +
           (word_ == kWords - 1 ? EngineMap::input_tick : EngineMap::input_first + word_);
  }
  std::uint32_t word(std::uint32_t tick, const Axes& position, const Axes& velocity,
                     const Axes& tau_hat) const {
    if (word_ >= kWords - 1) return tick;
    const auto n = static_cast<std::size_t>(word_ / 3);
    const std::int32_t words[] = {position[n], velocity[n], tau_hat[n]};
    return static_cast<std::uint32_t>(words[word_ % 3]);
  }
  /// Whether a thread becomes due that is still waiting.
  bool due_again(unsigned run) const { return due(run) && (due_ >> counted_ & 1U) != 0; }

  void clock(const In& in) {
    const bool is_due = due(in.run);
    const unsigned ready = due_ & ~running;
    const auto counted = static_cast<std::size_t>(counted_);
    const int due_thread = counted_;
    const bool reload = counts_[counted] <= 1;
    if (counting_) {
      const bool runs = (in.run >> counted_ & 1U) != 0;
      counts_[counted] = !runs ? 0 : reload ? dividers_[counted] : counts_[counted] - 1;
    }
    if (in.divide) dividers_[static_cast<std::size_t>(in.divided)] = in.divider;
    const bool counting = counting_;
    if (in.tick) {
      counting_ = true;
    } else if (counted_ == 3) {
      counting_ = false;
    }
    if (counting) counted_ = (counted_ + 1) % 4;

    const bool all = word_ == kWords;
    const bool was_written = written_;
    const int loaded = loaded_;
    written_ = false;
    if (in.tick || !loading_) {
      word_ = 0;
    } else if (in.taken) {
      ++word_;
    }
    if (!loading_) {
      loading_ = ready != 0;
      loaded_ = (ready & 1U) != 0 ? 0 : (ready & 2U) != 0 ? 1 : (ready & 4U) != 0 ? 2 : 3;
    } else if (all && !in.tick) {
      loading_ = false;
      written_ = (in.run >> loaded & 1U) != 0;
      due_ &= ~(1U << loaded);
      running |= 1U << loaded;
    }
    if (was_written) request |= 1U << loaded;
    if (in.started) request &= ~(1U << in.thread);
    if (in.ended) running &= ~(1U << in.thread);
    if (is_due) due_ |= 1U << due_thread;
    due_ &= in.run;
    request &= in.run;
    running &= in.run;
  }

 private:
  template <int Axes>
  friend class law::EngineRuns;

  bool due(unsigned run) const {
    return counting_ && counts_[static_cast<std::size_t>(counted_)] <= 1 &&
           (run >> counted_ & 1U) != 0;
  }

  std::array<int, 4> dividers_{}, counts_{};
  unsigned due_ = 0;
  bool counting_ = false, loading_ = false, written_ = false;
  int counted_ = 0, loaded_ = 0, word_ = 0;
};

/// Twin of rtl/engine/engine_outputs.sv: the torques, limited to their format, and their age.
template <int AxisCount>
class EngineOutputs {
 public:
  struct In {
    /// clear: torques become 0, waiting ones are lost. zero: they become 0. watched: their age
    /// counts.
    bool clear = false, zero = false, watched = false, enter = false, tick = false;
    unsigned max_age = 0;  ///< ticks
    /// The instruction at the last stage: result, whether it is an output or the last of a run.
    std::int32_t result = 0;
    bool output = false, last = false;
    int thread = 0, number = 0;
  };

  /// The torques have so many bits.
  explicit EngineOutputs(int torque_bits = 21) : top_((1 << (torque_bits - 1)) - 1) {}

  std::array<std::int32_t, AxisCount> torque{};
  /// fresh: one clock, torques of all axes have appeared since its last one. late: they are too
  /// old.
  bool fresh = false, late = false;

  void reset() {
    const std::int32_t top = top_;
    *this = EngineOutputs{};
    top_ = top;
  }
  /// The nearest torque.
  std::int32_t limited(std::int32_t result) const { return std::clamp(result, -top_ - 1, top_); }

  void clock(const In& in) {
    unsigned appears = 0;
    for (int n = 0; n < AxisCount; ++n) {
      Axis& a = axes_[static_cast<std::size_t>(n)];
      if (ends_ && a.waits && a.by == thread_) appears |= 1U << n;
      if (in.clear || in.zero) {
        torque[static_cast<std::size_t>(n)] = 0;
      } else if ((appears >> n & 1U) != 0) {
        torque[static_cast<std::size_t>(n)] = a.next;
      }
      const bool written = in.output && in.number == n;
      if (in.clear) {
        a.waits = false;
      } else if (written) {
        a.waits = true;
      } else if ((appears >> n & 1U) != 0) {
        a.waits = false;
      }
      if (!written) continue;
      a.next = limited(in.result);
      a.by = in.thread;
    }
    constexpr unsigned all = (1U << AxisCount) - 1;
    const bool renewed = (renewed_ | appears) == all;
    renewed_ = in.clear || renewed ? 0 : renewed_ | appears;
    fresh = renewed && !in.clear;
    if (in.enter || !in.watched) {
      late = false;
    } else if (in.tick && !renewed && age_ >= in.max_age) {
      late = true;
    }
    if (renewed || in.enter || !in.watched) {
      age_ = 0;
    } else if (in.tick) {
      age_ = (age_ + 1) & 0xffffU;
    }
    ends_ = in.last;
    thread_ = in.thread;
  }

 private:
  template <int Axes>
  friend class law::EngineRuns;

  struct Axis {
    std::int32_t next = 0;
    int by = 0;
    bool waits = false;
  };
  std::int32_t top_;
  std::array<Axis, AxisCount> axes_{};
  bool ends_ = false;
  int thread_ = 0;
  unsigned renewed_ = 0, age_ = 0;
};

/// Twin of rtl/engine/engine_crc.sv: the CRC-32 of the memories' contents.
class EngineCrc {
 public:
  struct In {
    bool start = false, wait = false, beat = false;  ///< beat: `word` has been read
    std::uint64_t word = 0;
    int line_base = 0;         ///< first table word that the CRC leaves out
    std::uint32_t wanted = 0;  ///< the expected CRC
  };

  /// reads: a check is in progress. done: one clock, it has ended. good: the CRC was the expected.
  bool reads = false, done = false, good = false;
  int address = 0;  ///< of the next word

  /// A reset of the RTL does not touch the sum; each start sets it anew.
  void reset() { *this = EngineCrc{}; }
  bool busy() const { return waits_ || reads; }
  bool reads_program() const { return reads && part_ == 0; }
  bool reads_table() const { return reads && part_ == 2; }

  void clock(const In& in) {
    const bool ends = part_ == 2 && address == in.line_base;
    const bool loads = reads && in.beat && beats_ == 2 && left_ == 0 && !ends && part_ != 3;
    const bool finishes = reads && left_ == 0 && (ends || part_ == 3);
    const bool begins = !reads && !read_ && waits_ && !in.wait;
    const std::uint32_t sum = sum_;
    if (!read_) {
      sum_ = 0xffffffffU;
    } else if (left_ > 1) {
      const bool feeds = ((sum_ ^ word_) & 1U) != 0;
      sum_ = sum_ >> 1 ^ (feeds ? 0xedb88320U : 0);
    }
    word_ = loads ? in.word : word_ >> 1;
    done = finishes;
    read_ = reads;
    if (in.start) waits_ = true;
    if (left_ != 0) --left_;
    if (reads && in.beat && beats_ != 2) ++beats_;
    if (loads) {
      left_ = (part_ == 1 ? 32 : 40) + 1;  // a clock for each bit and one for the comparison
      beats_ = 0;
      const bool part_ends = address == 511;
      address = !part_ends ? address + 1 : part_ == 0 ? EngineMap::D::lower : 0;
      part_ += part_ends ? 1 : 0;
    }
    if (finishes) {
      reads = false;
      good = ~sum == in.wanted;
    }
    if (begins) {
      waits_ = false;
      reads = true;
      good = false;
      part_ = address = beats_ = 0;
    }
  }

 private:
  template <int AxisCount>
  friend class law::EngineRuns;

  bool waits_ = false, read_ = false;
  int part_ = 0, left_ = 0, beats_ = 0;
  std::uint64_t word_ = 0;
  std::uint32_t sum_ = 0;
};

/// Twin of rtl/engine/engine_events.sv: a queue of 16 events that wait for the host. An event is
/// counted a clock after it is kept.
class EngineEvents {
 public:
  struct Event {
    int number = 0;
    std::int32_t value = 0;
    std::uint32_t tick = 0;
  };

  /// Number of events that the simulation remembers in `told`, also those already taken; not in
  /// hardware.
  static constexpr std::size_t most_told = 65536;

  int count = 0, lost = 0;  ///< events that are counted; that found no place, at most 255
  std::vector<Event> told;

  /// The contents of the queue's places stay.
  void reset() {
    count_last();
    first_ = count = lost = 0;
    told.clear();
  }
  const Event& oldest() const { return events_[static_cast<std::size_t>(first_)]; }

  void clock(bool event, const Event& e, bool take) {
    const bool takes = take && count != 0;
    count_last();
    if (event && told.size() < most_told) told.push_back(e);
    if (event && count == 16) lost = std::min(lost + 1, 0xff);
    comes_ = event && count < 16;
    if (comes_) last_ = e;
    if (takes) first_ = (first_ + 1) % 16, --count;
  }

  /// The event of the clock before is counted and readable from now on.
  void count_last() {
    if (comes_) events_[static_cast<std::size_t>((first_ + count++) % 16)] = last_;
    comes_ = false;
  }

 private:
  std::array<Event, 16> events_{};
  Event last_;
  bool comes_ = false;
  int first_ = 0;
};

}  // namespace feltgate
