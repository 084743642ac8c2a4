// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/link_view.sv: shows twelve words of several axes as those of one core, to stream
// and capture. Documentation: docs/link.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/generated/link.hpp"

namespace feltgate {

/// Addresses of the view and the form of a choice, for hosts.
struct LinkViewMap {
  static constexpr std::uint16_t first = 0x1030;  ///< word k of the view is chosen at first + k
  static constexpr std::uint16_t axes = 0x103f;   ///< number of axes; 0 without a view
  static constexpr std::uint32_t choice(int axis, int word) {
    return static_cast<std::uint32_t>(axis << 4 | word);
  }
};

/// The view of N axes.
template <int N>
class LinkView {
 public:
  static constexpr int words = LinkMap::snapshot_words;
  static constexpr int delay =
      words + 1;  ///< clocks from a tick's last clock to the view's last word
  struct In {
    std::array<bool, N> word_valid{};  ///< word_data is the axis' word of this number
    std::array<std::uint8_t, N> word_number{};
    std::array<std::uint32_t, N> word_data{};
    bool last = false;  ///< last clock of a tick
    bool event_valid = false;
    int event_number = 0;
    std::uint16_t addr = 0;
    std::uint32_t wdata = 0;
    bool write = false;
  };
  struct Out {
    std::uint32_t rdata = 0;  ///< the word at addr, 3 clocks later
    bool word_valid = false;
    std::uint8_t word_number = 0;
    std::uint32_t word_data = 0;  ///< valid with word_valid
    bool event_valid = false;
    int event_number = 0;
  };

  LinkView() { reset(); }
  void reset() {
    for (std::size_t k = 0; k < choices_.size(); ++k) choices_[k] = static_cast<std::uint32_t>(k);
    half_ = 0;
    at_ = 0;
    plays_ = false;
    events_ = {};
    event_ = 0;
    addr_1_ = addr_2_ = 0;
    out_ = {};
  }
  const Out& out() const { return out_; }

  void clock(const In& in) {
    read_back(in.addr);
    show();
    for (std::size_t n = 0; n < N; ++n) {
      if (in.word_valid[n]) ticks_[half_][n][in.word_number[n]] = in.word_data[n];
    }
    play(in.last);
    events_[event_] = {in.event_valid, in.event_number};
    event_ = (event_ + 1) % events_.size();
    out_.event_valid = events_[event_].valid;
    out_.event_number = events_[event_].number;
    if (in.write) write(in.addr, in.wdata);
  }

 private:
  struct Event {
    bool valid = false;
    int number = 0;
  };
  using Tick = std::array<std::array<std::uint32_t, 16>, N>;
  static constexpr std::size_t kStatus = LinkMap::N::status;

  /// The word of the clock that follows.
  void show() {
    out_.word_valid = plays_;
    out_.word_number = static_cast<std::uint8_t>(at_);
    const std::uint32_t choice = choices_[at_];
    out_.word_data = ticks_[1 - half_][choice >> 4][choice & 15];
  }
  /// The status is the last word of a tick.
  void play(bool ends) {
    const std::size_t shown = at_;
    if (ends) {
      at_ = kStatus + 1;
    } else if (plays_) {
      at_ = (at_ + 1) % words;
    }
    plays_ = ends || (plays_ && shown != kStatus);
    if (ends) half_ = 1 - half_;
  }
  void write(std::uint16_t addr, std::uint32_t data) {
    const unsigned k = static_cast<unsigned>(addr) - LinkViewMap::first;
    if (k >= words || k == LinkMap::N::tick) return;
    if (data >> 4 < N && (data & 15) < words) choices_[k] = data;
  }
  void read_back(std::uint16_t addr) {
    const unsigned k = static_cast<unsigned>(addr_2_) - LinkViewMap::first;
    out_.rdata = k < words ? choices_[k] : addr_2_ == LinkViewMap::axes ? N : 0;
    addr_2_ = addr_1_;
    addr_1_ = addr;
  }

  std::array<std::uint32_t, words> choices_{};  ///< axis above bit 4, number of the word below
  std::array<Tick, 2> ticks_{};                 ///< one is taken, the other shown
  std::size_t half_ = 0, at_ = 0;
  bool plays_ = false;
  std::array<Event, delay> events_{};
  std::size_t event_ = 0;  ///< the oldest of events_, in whose place the next one goes
  std::uint16_t addr_1_ = 0, addr_2_ = 0;
  Out out_;
};

}  // namespace feltgate
