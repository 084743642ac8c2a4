// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/link_capture.sv: records words of consecutive ticks in a ring of rows, around a
// trigger. Documentation: docs/link.md
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "feltgate/generated/link.hpp"

namespace feltgate {

/// Rows: rows of the ring, a power of two. Events: whether an event of a law may trigger.
template <int Rows = 1 << LinkMap::rows_log2, bool Events = true>
class LinkCapture {
 public:
  struct In {
    bool word_valid =
        false;  ///< word_data is the snapshot's word of this number; the status ends a tick
    std::uint8_t word_number = 0;
    std::uint32_t word_data = 0;
    std::uint16_t addr = 0;
    std::uint32_t wdata = 0;
    bool write = false;
    bool event_valid = false;
    int event_number = 0;
  };
  struct Out {
    std::uint32_t rdata = 0;  ///< the word at addr, 3 clocks later
  };
  enum class State : std::uint8_t { idle, fill, wait, rest, done };

  /// Also removes all rows; the memory keeps its words.
  void reset() {
    std::vector<std::uint32_t> memory = std::move(memory_);
    *this = LinkCapture();
    memory_ = std::move(memory);
  }
  const Out& out() const { return out_; }
  State state() const { return state_; }
  /// Whether a capture is in progress.
  bool runs() const {
    return state_ == State::fill || state_ == State::wait || state_ == State::rest;
  }

  void clock(const In& in) {
    read_back(in.addr);
    if (ends_) end_of_tick();
    ends_ = false;
    if (in.event_valid) event(in.event_number);
    if (in.word_valid) word(in.word_number, in.word_data);
    if (in.write) write(in.addr, in.wdata);
  }

  /// Reports an event in the last clock, or in an earlier one after which nothing else came.
  void event(int number) {
    const auto word = static_cast<std::uint32_t>(number);
    event_ |= Events && mode_ == LinkMap::trigger_event &&
              ((level_ & LinkMap::any_event) != 0 || word == (level_ & (LinkMap::any_event - 1)));
  }

  /// A whole tick at once: its words by number, with no register access in between. Equals so many
  /// calls of clock(), up to the clock after the last word.
  void tick(const std::array<std::uint32_t, LinkMap::snapshot_words>& words) {
    for (std::size_t k = 0; k < words.size(); ++k) {
      if (k != LinkMap::N::status) word(static_cast<std::uint8_t>(k), words[k]);
    }
    word(LinkMap::N::status, words[LinkMap::N::status]);
    ends_ = false;
    end_of_tick();
  }

 private:
  using A = LinkMap::A;
  using B = LinkMap::B;
  static constexpr unsigned kNone = 15;
  static constexpr unsigned kWords = LinkMap::snapshot_words;
  static constexpr unsigned kColumns = LinkMap::columns;
  static constexpr std::uint32_t kRows = Rows;
  static constexpr std::uint32_t kLongest = 0xffff;
  static constexpr std::uint32_t kModes = (1u << LinkMap::trigger_mode_bits) - 1;
  static_assert(Rows >= 4 && Rows <= 1024 && (Rows & (Rows - 1)) == 0, "see link_capture.sv");

  static std::uint32_t at_most(std::uint32_t word, std::uint32_t limit) {
    return word < limit ? word : limit;
  }
  static bool at_or_above(std::uint32_t word, std::uint32_t level) {
    return static_cast<std::int32_t>(word) >= static_cast<std::int32_t>(level);
  }

  void word(std::uint8_t number, std::uint32_t data) {
    if (!within_) begin_tick();
    within_ = number != LinkMap::N::status;
    ends_ = !within_;
    if (number == trigger_word_) look(data);
    const bool wanted = (words_ >> number & 1u) != 0;
    const std::uint32_t column = chosen_below(number);
    if (runs() && taking_ && wanted && column < kColumns) {
      if (memory_.empty()) memory_.resize(kRows * kColumns);
      memory_[row_ * kColumns + column] = data;
    }
  }
  /// A row has the chosen words by number.
  std::uint32_t chosen_below(unsigned number) const {
    const std::bitset<kWords> chosen(words_ & ((1u << number) - 1));
    return static_cast<std::uint32_t>(chosen.count());
  }

  void begin_tick() {
    seen_ = true;
    taking_ = runs() && ticks_ == 0;
    if (taking_ && rows_ == kRows) --rows_;  // the oldest row is overwritten
    if (ticks_ != 0) {
      --ticks_;
    } else if (period_ != 0) {
      ticks_ = period_ - 1;
    }
  }

  /// Compares the trigger's word with its value one tick ago.
  void look(std::uint32_t data) {
    const bool high = at_or_above(data, level_), was = at_or_above(before_, level_);
    hit_ = known_ && ((mode_ == LinkMap::trigger_rises && high && !was) ||
                      (mode_ == LinkMap::trigger_falls && !high && was) ||
                      (mode_ == LinkMap::trigger_bit && (data & ~before_ & level_) != 0));
    before_ = data;
    known_ = true;
  }

  void end_of_tick() {
    const bool event = event_;
    event_ = false;
    if (!runs()) return;
    const State before = state_;
    const bool fires = before == State::wait && seen_ && (hit_ || hand_ || event);
    const std::uint32_t rest = kRows - pre_ - (taking_ ? 1u : 0u);
    if (taking_) {
      taking_ = false;
      columns_ = at_most(chosen_below(kWords), kColumns);
      row_ = (row_ + 1) % kRows;
      ++rows_;
      --left_;
      if (left_ == 0 && before == State::fill) state_ = State::wait;
      if (left_ == 0 && before == State::rest) state_ = State::done;
    }
    if (!fires) return;
    hand_ = false;
    left_ = rest;
    state_ = rest == 0 ? State::done : State::rest;
  }

  void write(std::uint16_t addr, std::uint32_t data) {
    switch (addr) {
      case A::capture_control:
        return control(data);
      case A::capture_words:
        if (!ran_) words_ = data & ((1u << kWords) - 1);
        return;
      case A::capture_pre:
        if (!ran_) pre_ = at_most(data, kRows - 1);
        return;
      case A::capture_period:
        if (!ran_) period_ = at_most(data, kLongest);
        return;
      case A::trigger_word:
        trigger_word_ = at_most(data, kNone);
        break;
      case A::trigger_mode:
        mode_ = data & kModes & ~(Events ? 0u : LinkMap::trigger_event);
        break;
      case A::trigger_level:
        level_ = data;
        break;
      default:
        return;
    }
    known_ = hit_ = event_ = false;  // the earlier value was compared with another word or level
  }

  void control(std::uint32_t data) {
    const auto bit = [data](int n) { return (data >> n & 1u) != 0; };
    const bool trigger = bit(B::capture_control_trigger);
    if (trigger) hand_ = true;
    if (bit(B::capture_control_abort)) {
      if (ran_) state_ = State::idle;
      taking_ = false;
    } else if (bit(B::capture_control_start)) {
      state_ = pre_ == 0 ? State::wait : State::fill;
      seen_ = taking_ = event_ = false;
      hand_ = trigger;
      ticks_ = row_ = rows_ = 0;
      left_ = pre_;
    }
  }

  std::uint32_t first_row() const { return (row_ - rows_) % kRows; }
  std::uint32_t register_at(std::uint16_t addr) const {
    switch (addr) {
      case A::capture_state:
        return static_cast<std::uint32_t>(state_);
      case A::capture_words:
        return words_;
      case A::capture_pre:
        return pre_;
      case A::capture_period:
        return period_;
      case A::trigger_word:
        return trigger_word_;
      case A::trigger_mode:
        return mode_;
      case A::trigger_level:
        return level_;
      case A::capture_first:
        return first_row();
      case A::capture_rows:
        return rows_;
      default:
        return 0;
    }
  }
  void read_back(std::uint16_t addr) {
    const std::uint32_t word = register_at(addr_2_);
    out_.rdata = word != 0 ? word : memory_2_;
    // Only whole rows of the memory can be read, and only while no capture runs.
    const std::uint32_t at = addr_1_ - LinkMap::memory;
    const bool holds = addr_1_ >= LinkMap::memory && at < kRows * kColumns && !runs() &&
                       (at / kColumns - first_row()) % kRows < rows_ && at % kColumns < columns_;
    memory_2_ = holds ? memory_[at] : 0;
    addr_2_ = addr_1_;
    addr_1_ = addr;
    ran_ = runs();
  }

  State state_ = State::idle;
  std::vector<std::uint32_t> memory_;  ///< empty before the first word
  std::uint32_t words_ = 0, pre_ = 0, period_ = 0, trigger_word_ = 0, mode_ = 0, level_ = 0;
  std::uint32_t before_ = 0;            ///< the trigger's word, one tick ago
  std::uint32_t ticks_ = 0, left_ = 0;  ///< ticks before the next row; rows left in this state
  std::uint32_t row_ = 0, rows_ = 0, columns_ = 0;
  bool within_ = false;  ///< amid the words of a tick
  bool known_ = false, hit_ = false, hand_ = false, seen_ = false, taking_ = false, ends_ = false;
  bool event_ = false;  ///< since the end of the last tick
  bool ran_ = false;    ///< state before this clock
  std::uint16_t addr_1_ = 0, addr_2_ = 0;
  std::uint32_t memory_2_ = 0;
  Out out_;
};

}  // namespace feltgate
