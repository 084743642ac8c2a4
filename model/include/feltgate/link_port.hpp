// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/link_port.sv: executes the link's requests. Documentation:
// docs/link.md
#pragma once

#include <cstdint>

#include "feltgate/generated/link.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/link_receiver.hpp"
#include "feltgate/link_transmitter.hpp"

namespace feltgate {

/// Properties of the device around a linked core.
struct LinkBuilt {
  bool simulated = false;      ///< sets the bit `features_simulated`
  int board = 0;               ///< the word `board`
  std::uint32_t features = 0;  ///< further bits of the word `features`
  // Of the design.
  std::uint32_t design_crc = 0, clock_hz = 0, clocks_per_tick = 0;
  bool engine = false;
};

/// The link's port with N axes at its register port.
template <int N = 1>
class LinkPort {
 public:
  struct In {
    LinkRequest request;
    bool good = false, bad = false;  ///< one clock each: frames to count
    bool clear_faults = false;       ///< one clock: the panel's request
    std::uint8_t inputs = 0;         ///< the word `inputs`
    bool tick = false;               ///< one clock: the snapshot is valid
    bool reg_busy = false;
    std::uint32_t reg_rdata = 0, rdata = 0;  ///< of the register port; of stream and capture
    bool ready = false;                      ///< the byte of the reply is taken
  };
  struct Out {
    bool taken = false;
    std::uint16_t reg_addr = 0;
    std::uint32_t reg_wdata = 0;
    bool reg_write = false;
    std::uint16_t addr = 0;
    std::uint32_t wdata = 0;
    bool write = false;
    FrameByte reply;
  };

  explicit LinkPort(LinkBuilt built = {})
      : built_(built),
        engine_(built.engine ? 1 : 0),
        port_(static_cast<std::uint16_t>(engine_ << LinkMap::map_bits | (LinkMap::words - 1))) {}
  void reset() { *this = LinkPort(built_); }

  /// Outputs in a clock with these inputs; some outputs depend on them directly.
  Out peek(const In& in) const {
    const Does d = does(in.request);
    Out o;
    o.taken = state_ == State::idle && in.request.valid && (!in.request.write || done_);
    const std::uint16_t reading = read_address();
    o.reg_addr =
        (d.host_write    ? in.request.address
         : d.panel_write ? static_cast<std::uint16_t>(Map::C::command | clear_axis_ << kAxisBit)
                         : reading) &
        port_;
    o.reg_write = d.host_write || d.panel_write;
    constexpr std::uint32_t bits = (1U << Map::C::command_width) - 1;
    o.reg_wdata = d.host_write ? in.request.data
                               : (in.request.data & ~bits) | 1U << Map::C::command_clear_faults;
    o.write = d.link_write;
    o.addr = d.link_write ? in.request.address : reading;
    o.wdata = in.request.data;
    o.reply = reply();
    return o;
  }
  /// The byte of a reply; depends on registers only.
  FrameByte reply() const {
    return {state_ == State::bytes, static_cast<std::uint8_t>(word_), byte_ == 3 && left_ == 0};
  }

  void clock(const In& in) {
    const Does d = does(in.request);
    const LinkRequest& r = in.request;
    const bool taken = state_ == State::idle && r.valid && (!r.write || done_);
    const std::uint32_t word = read_word(in);
    if (in.good) good_ = (good_ + 1) & 0xffffU;
    if (in.bad) bad_ = (bad_ + 1) & 0xffffU;
    const bool acts = d.link_write || (d.host_write && !in.reg_busy);
    done_ = r.valid && !taken && (done_ || (r.write && (d.repeats || acts)));
    if (acts) sequence_ = r.sequence;
    const bool clears = d.panel_write && !in.reg_busy;
    clear_ = in.clear_faults || (clear_ && !(clears && clear_axis_ == N - 1));
    if (in.clear_faults || N == 1) {
      clear_axis_ = 0;
    } else if (clears) {
      clear_axis_ = (clear_axis_ + 1) & 3;
    }

    switch (state_) {
      case State::idle:
        status_ = r.write;
        address_ = r.address;
        left_ = r.write ? 1 : static_cast<int>(r.data & 127U);
        word_ = std::uint32_t{r.address} << 16 | std::uint32_t{r.sequence} << 8 |
                LinkMap::kind_reply | (r.write ? LinkMap::kind_write : LinkMap::kind_read);
        ticks_ = 3;
        if (taken) state_ = r.write ? State::wait : State::bytes;
        break;
      case State::wait:
        if (ticks_ == 0) state_ = State::bytes;
        if (in.tick) ticks_ = (ticks_ - 1) & 3;
        break;
      case State::read:
        word_ = word;
        if (clocks_ == (of_engine(read_address()) ? kEngineClocks : 3)) {
          state_ = State::bytes;
          address_ = (address_ + 1U) & ((window << engine_) - 1);
          left_ = (left_ - 1) & 127;
          clocks_ = 0;
        } else {
          const bool waits = of_engine(read_address()) && in.reg_busy;
          clocks_ = d.host_write || d.panel_write || d.link_write || waits ? 0 : clocks_ + 1;
        }
        break;
      case State::bytes:
        if (!in.ready) break;
        word_ >>= 8;
        if (byte_ == 3) state_ = left_ == 0 ? State::idle : State::read;
        byte_ = (byte_ + 1) & 3;
        break;
    }
  }

  /// Whether clock() changes nothing while the inputs hold and no byte of the reply is taken.
  bool waits(const In& in) const {
    const LinkRequest& r = in.request;
    if (in.good || in.bad || in.clear_faults || clear_) return false;
    if (r.valid != (done_ || (r.valid && !r.write))) return false;
    if (state_ == State::bytes) return true;
    return state_ == State::idle && !r.valid && status_ == r.write && address_ == r.address;
  }
  /// Whether the register port is not used for at least the time of a byte on the line, unless a
  /// request comes. A reply reads its next word after the four bytes of the last one.
  bool rests(const In& in) const {
    const bool reads =
        state_ != State::idle && (state_ != State::bytes || (left_ != 0 && byte_ == 3));
    return !reads && !in.request.valid && !in.clear_faults && !clear_;
  }

 private:
  enum class State : std::uint8_t { idle, wait, read, bytes };
  struct Does {
    bool repeats = false, host_write = false, link_write = false, panel_write = false;
  };

  static constexpr unsigned window = 1U << LinkMap::map_bits;
  static constexpr int kAxisBit = 10;       ///< of an address; the number of the axis is above
  static constexpr int kEngineClocks = 40;  ///< clocks to read a word of the engine
  static bool of_port(std::uint16_t address) { return address % window < LinkMap::words; }
  static bool of_engine(std::uint16_t address) { return address >= window && of_port(address); }

  Does does(const LinkRequest& r) const {
    Does d;
    d.repeats = sequence_ == r.sequence;
    const bool writes = r.valid && r.write && !done_ && !d.repeats;
    d.host_write = writes && of_port(r.address);
    d.link_write = writes && !of_port(r.address);
    d.panel_write = clear_ && !d.host_write;
    return d;
  }
  std::uint16_t read_address() const {
    return static_cast<std::uint16_t>(status_ ? Map::C::read_status | status_axis() << kAxisBit
                                              : address_);
  }
  /// Axis of the write that the reply answers; 0 for a write to something else.
  std::uint32_t status_axis() const {
    const std::uint32_t axis = address_ >> kAxisBit;
    return axis < N ? axis : 0;
  }
  std::uint32_t read_word(const In& in) const {
    const std::uint16_t address = read_address();
    if (of_port(address)) return in.reg_rdata;
    return own(address, in.inputs) | in.rdata;
  }
  std::uint32_t own(std::uint16_t address, std::uint8_t inputs) const {
    using A = LinkMap::A;
    switch (address) {
      case A::identity:
        return LinkMap::identity;
      case A::version:
        return LinkMap::version;
      case A::design_crc:
        return built_.design_crc;
      case A::clock_hz:
        return built_.clock_hz;
      case A::clocks_per_tick:
        return built_.clocks_per_tick;
      case A::features:
        return built_.features | (built_.simulated ? 1U << LinkMap::B::features_simulated : 0U);
      case A::frames_good:
        return good_;
      case A::frames_bad:
        return bad_;
      case A::last_write_sequence:
        return sequence_;
      case A::board:
        return static_cast<std::uint32_t>(built_.board);
      case A::inputs:
        return inputs;
      default:
        return 0;
    }
  }

  LinkBuilt built_;
  unsigned engine_;
  /// Bits of an address that reach the register port: the engine's words have the addresses of the
  /// core's words with one more bit in front.
  std::uint16_t port_;
  std::uint32_t sequence_ = LinkMap::no_sequence;
  bool done_ = false, clear_ = false, status_ = false;
  State state_ = State::idle;
  int clear_axis_ = 0;  ///< whose faults the panel clears next
  int ticks_ = 0, clocks_ = 0, byte_ = 0, left_ = 0;
  std::uint32_t address_ = 0, word_ = 0, good_ = 0, bad_ = 0;
};

}  // namespace feltgate
