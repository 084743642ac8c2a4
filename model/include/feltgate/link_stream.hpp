// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/link_stream.sv: sends chosen words of a tick as a frame, once per period of
// ticks. All words of the tick are stored first. While a frame is stored or sent, further due
// frames are dropped and counted. Documentation: docs/link.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/generated/link.hpp"

namespace feltgate {

/// The stream of snapshot words.
class LinkStream {
 public:
  struct In {
    bool word_valid =
        false;  ///< word_data is the snapshot's word of this number; the status ends a tick
    std::uint8_t word_number = 0;
    std::uint32_t word_data = 0;
    std::uint16_t addr = 0;
    std::uint32_t wdata = 0;
    bool write = false;
    bool ready = false;  ///< out().byte is taken in this clock
  };
  struct Out {
    std::uint32_t rdata = 0;  ///< the word at addr, 3 clocks later
    bool valid = false;
    std::uint8_t byte = LinkMap::kind_stream;
    bool last = false;
  };

  /// The memory keeps its words.
  void reset() {
    const auto words = tick_;
    *this = LinkStream();
    tick_ = words;
  }
  const Out& out() const { return out_; }

  void clock(const In& in) {
    read_back(in.addr);
    const State before = state_;
    if (in.word_valid) word(in.word_number, in.word_data);
    if (in.write) write(in.addr, in.wdata);
    if (before == State::head || before == State::body) {
      if (in.ready) pass_byte();
    } else if (before == State::seek) {
      if ((left_ & 1u) != 0) {
        state_ = State::body;
      } else {
        next_word();
      }
    }
    show();
  }

  /// Whether words of coming ticks may matter.
  bool on() const { return period_ != 0 || state_ != State::idle; }
  /// Whether, while no byte is taken, only a word or a write makes clock() change anything.
  bool waits() const { return state_ != State::seek; }
  /// Whether a frame needs the words of this tick, or of the next tick if that begins now.
  bool keeps() const {
    return state_ == State::take || (state_ == State::idle && ticks_to_frame() == 0);
  }
  /// Whether no frame is stored or sent. Then none begins in the next ticks_to_frame() ticks.
  bool idle() const { return state_ == State::idle; }
  std::uint32_t ticks_to_frame() const { return period_ == 0 ? kNever : ticks_; }
  static constexpr std::uint32_t kNever = 0xffffffffu;
  /// Passes `ticks` ticks at once; only while idle, between two ticks.
  void pass_ticks(std::uint32_t ticks) { ticks_ = (ticks_ - ticks) & kLongest; }

 private:
  enum class State : std::uint8_t { idle, take, head, seek, body };
  static constexpr unsigned kWords = LinkMap::snapshot_words;
  static constexpr unsigned kAlways = 1u << LinkMap::N::tick;
  static constexpr std::uint32_t kLongest = (1u << 24) - 1;

  void word(std::uint8_t number, std::uint32_t data) {
    if (!within_) {
      const bool due = period_ != 0 && ticks_ == 0;
      if (due) {
        if (state_ == State::idle) {
          state_ = State::take;
          left_ = words_ | kAlways;
          frame_ = count_;
          at_ = index_ = 0;
        } else {
          ++dropped_;
        }
        ++count_;
      }
      ticks_ = ((due ? period_ : ticks_) - 1) & kLongest;
    }
    within_ = number != LinkMap::N::status;
    if (state_ == State::take) {
      tick_[number] = data;
      if (!within_) state_ = State::head;
    }
  }

  void write(std::uint16_t addr, std::uint32_t data) {
    if (addr == LinkMap::A::stream_words) words_ = data & ((1u << kWords) - 1);
    if (addr == LinkMap::A::stream_period) {
      period_ = data < kLongest ? data : kLongest;
      ticks_ = 0;
    }
  }

  void pass_byte() {
    const bool last = out_.last;
    if (++index_ < 4) return;
    index_ = 0;
    if (state_ == State::body) next_word();
    state_ = last ? State::idle : State::seek;
  }
  void next_word() {
    ++at_;
    left_ >>= 1;
  }

  void read_back(std::uint16_t addr) {
    switch (addr_2_) {
      case LinkMap::A::stream_words:
        out_.rdata = words_;
        break;
      case LinkMap::A::stream_period:
        out_.rdata = period_;
        break;
      case LinkMap::A::stream_dropped:
        out_.rdata = dropped_;
        break;
      default:
        out_.rdata = 0;
    }
    addr_2_ = addr_1_;
    addr_1_ = addr;
  }

  void show() {
    const bool body = state_ == State::body;
    out_.valid = body || state_ == State::head;
    out_.last = body && index_ == 3 && left_ >> 1 == 0;
    const std::uint8_t head[] = {static_cast<std::uint8_t>(LinkMap::kind_stream), frame_,
                                 static_cast<std::uint8_t>(left_),
                                 static_cast<std::uint8_t>(left_ >> 8)};
    out_.byte = body ? static_cast<std::uint8_t>(tick_[at_] >> 8 * index_) : head[index_];
  }

  State state_ = State::idle;
  std::array<std::uint32_t, 16> tick_{};
  bool within_ = false;  ///< amid the words of a tick
  unsigned words_ = 0, left_ = 0, at_ = 0, index_ = 0;
  std::uint32_t period_ = 0, ticks_ = 0, dropped_ = 0;
  std::uint8_t count_ = 0, frame_ = 0;
  std::uint16_t addr_1_ = 0, addr_2_ = 0;
  Out out_;
};

}  // namespace feltgate
