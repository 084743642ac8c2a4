// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/link_receiver.sv: decodes bytes from the line into requests (SLIP, CRC-32, range
// checks). A byte passes the CRC in the 8 clocks after it. A request is valid in the clock after
// the frame's last byte, until it is taken or the next frame begins. Documentation:
// docs/link.md
#pragma once

#include <array>
#include <cstdint>

#include "feltgate/crc32.hpp"
#include "feltgate/generated/link.hpp"

namespace feltgate {

/// A request from a frame that passed all checks.
struct LinkRequest {
  bool valid = false;  ///< the other fields are valid
  bool write = false;
  std::uint8_t sequence = 0;
  std::uint16_t address = 0;
  std::uint32_t data = 0;  ///< write: the word; read: the number of words
};

/// The receiver.
class LinkReceiver {
 public:
  struct In {
    std::uint8_t byte = 0;
    bool valid = false, error = false;  ///< as from UartRx
    bool taken = false;                 ///< the request has been taken
  };
  struct Out {
    LinkRequest request;
    bool good = false, bad = false;  ///< one clock: a frame has passed or failed the checks
  };

  /// `engine`: the address map also contains the engine's words, above the others.
  explicit LinkReceiver(bool engine = false)
      : map_bits_(static_cast<int>(LinkMap::map_bits) + (engine ? 1 : 0)) {}
  void reset() { *this = LinkReceiver(map_bits_ > static_cast<int>(LinkMap::map_bits)); }
  const Out& out() const { return out_; }
  /// Whether clock() changes nothing without a byte.
  bool idle() const { return bits_ == 0 && !out_.good && !out_.bad; }

  void clock(const In& in) {
    out_.good = out_.bad = false;
    if (in.taken) out_.request.valid = false;
    if (bits_ > 0) shift();
    if (in.valid && in.byte == LinkMap::frame_end) {
      end();
    } else if (in.valid && in.byte == LinkMap::frame_escape) {
      spoiled_ = spoiled_ || escaped_;
      escaped_ = true;
    } else if (in.valid) {
      take(in.byte);
    }
    if (in.error) spoiled_ = true;
  }

 private:
  /// Shifts one bit of the byte into CRC and frame; frame_ keeps the first eight bytes of the
  /// frame.
  void shift() {
    const std::uint32_t bit = byte_ & 1U;
    crc_ = crc32_shift(crc_, bit != 0);
    if (count_ <= 8) frame_ = frame_ >> 1 | std::uint64_t{bit} << 63;
    byte_ = static_cast<std::uint8_t>(byte_ >> 1);
    --bits_;
    show();
  }

  void end() {
    if (count_ != 0 || escaped_ || spoiled_) {
      out_.good = sound();
      out_.bad = !out_.good;
      if (out_.good) out_.request.valid = true;
    }
    count_ = 0;
    escaped_ = spoiled_ = false;
    crc_ = crc32_start;
  }

  void take(std::uint8_t byte) {
    byte_ = byte;
    if (escaped_) {
      if (byte == LinkMap::escaped_end) {
        byte_ = LinkMap::frame_end;
      } else if (byte == LinkMap::escaped_escape) {
        byte_ = LinkMap::frame_escape;
      } else {
        spoiled_ = true;
      }
    }
    escaped_ = false;
    bits_ = 8;
    out_.request.valid = false;
    if (count_ <= static_cast<int>(LinkMap::request_bytes)) ++count_;
  }

  /// A read must not cross the end of the core, link and capture words, or of the engine's words.
  static constexpr unsigned window = 1U << LinkMap::map_bits;

  std::uint8_t kind() const { return static_cast<std::uint8_t>(frame_); }

  bool sound() const {
    const LinkRequest& r = out_.request;
    if (count_ != static_cast<int>(LinkMap::request_bytes) || escaped_ || spoiled_) return false;
    if (crc_ != crc32_good || (frame_ >> 16 & 0xffffU) >> map_bits_ != 0) return false;
    if (r.write) return true;
    return kind() == LinkMap::kind_read && r.data >= 1 && r.data <= LinkMap::read_words &&
           r.address % window + r.data <= window;
  }

  void show() {
    LinkRequest& r = out_.request;
    r.write = kind() == LinkMap::kind_write;
    r.sequence = static_cast<std::uint8_t>(frame_ >> 8);
    r.address = static_cast<std::uint16_t>(frame_ >> 16 & ((1U << map_bits_) - 1));
    r.data = static_cast<std::uint32_t>(frame_ >> 32);
  }

  int map_bits_;
  int count_ = 0, bits_ = 0;
  bool escaped_ = false, spoiled_ = false;
  std::uint8_t byte_ = 0;
  std::uint32_t crc_ = crc32_start;
  std::uint64_t frame_ = 0;
  Out out_;
};

}  // namespace feltgate
