// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/link_transmitter.sv: sends the frames of two sources as bytes on the line (SLIP,
// CRC-32). If both have a frame, the reply goes first. A byte passes the CRC in 8 clocks.
// Documentation: docs/link.md
#pragma once

#include <cstdint>

#include "feltgate/crc32.hpp"
#include "feltgate/generated/link.hpp"

namespace feltgate {

/// A byte of a frame; the source holds it until it is taken.
struct FrameByte {
  bool valid = false;
  std::uint8_t byte = 0;
  bool last = false;
};

/// The transmitter.
class LinkTransmitter {
 public:
  struct In {
    FrameByte reply, stream;
    bool ready = false;  ///< the UART takes out().byte in this clock
  };
  struct Out {
    bool reply_ready = false, stream_ready = false;  ///< takes a byte of that source if valid
    bool valid = false;                              ///< `byte` is offered to the UART
    std::uint8_t byte = LinkMap::frame_end;
  };

  void reset() { *this = LinkTransmitter(); }
  const Out& out() const { return out_; }
  /// Whether no frame is being sent.
  bool idle() const { return state_ == State::idle; }
  /// Whether clock() changes nothing while the UART takes no byte. While idle() a new frame still
  /// does.
  bool waits() const { return idle() || out_.valid; }

  void clock(const In& in) {
    const FrameByte& source = stream_ ? in.stream : in.reply;
    switch (state_) {
      case State::idle:
        stream_ = !in.reply.valid;
        tail_ = false;
        at_ = 0;
        crc_ = crc32_start;
        if (in.reply.valid || in.stream.valid) state_ = State::open;
        break;
      case State::open:
        if (in.ready) state_ = State::fetch;
        break;
      case State::fetch:
        byte_ = source.byte;
        last_ = source.last;
        if (source.valid) state_ = State::shift;
        break;
      case State::shift:
        shift();
        break;
      case State::send:
        if (in.ready) special() ? void(state_ = State::second) : next();
        break;
      case State::second:
        if (in.ready) next();
        break;
      case State::close:
        if (in.ready) state_ = State::idle;
        break;
    }
    show();
  }

 private:
  enum class State : std::uint8_t { idle, open, fetch, shift, send, second, close };

  bool special() const { return byte_ == LinkMap::frame_end || byte_ == LinkMap::frame_escape; }

  void shift() {
    const bool low = (crc_ & 1U) != 0, bit = (byte_ & 1U) != 0;
    byte_ = static_cast<std::uint8_t>(byte_ >> 1 | ((tail_ ? !low : bit) ? 0x80U : 0U));
    crc_ = tail_ ? crc_ >> 1 : crc32_shift(crc_, bit);
    if (++bit_ < 8) return;
    bit_ = 0;
    state_ = State::send;
  }

  void next() {
    const bool over = tail_ && at_ == 3;
    if (tail_) at_ = (at_ + 1) & 3;
    tail_ = last_;
    state_ = !last_ ? State::fetch : over ? State::close : State::shift;
  }

  void show() {
    out_.reply_ready = state_ == State::fetch && !stream_;
    out_.stream_ready = state_ == State::fetch && stream_;
    out_.valid = state_ == State::open || state_ == State::send || state_ == State::second ||
                 state_ == State::close;
    const bool end = byte_ == LinkMap::frame_end;
    std::uint32_t byte = LinkMap::frame_end;
    if (state_ == State::send) byte = special() ? LinkMap::frame_escape : byte_;
    if (state_ == State::second) byte = end ? LinkMap::escaped_end : LinkMap::escaped_escape;
    out_.byte = static_cast<std::uint8_t>(byte);
  }

  State state_ = State::idle;
  bool stream_ = false, last_ = false, tail_ = false;
  int at_ = 0, bit_ = 0;
  std::uint8_t byte_ = 0;
  std::uint32_t crc_ = crc32_start;
  Out out_;
};

}  // namespace feltgate
