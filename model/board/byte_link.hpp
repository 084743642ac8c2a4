// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The link of a board at the level of bytes: frames, the registers of the link, stream and capture,
// in the times that the wire takes; no pins, and not the RTL's clocks. Documentation: docs/board.md
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "feltgate/generated/link.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate::board {

/// Slots of the snapshot's words; the place in this list is the word's number in masks.
inline constexpr std::array<int, 12> word_slots = {
    Map::R::status,  Map::R::position,    Map::R::tick,    Map::R::velocity,
    Map::R::index,   Map::R::encoder,     Map::R::tau_hat, Map::R::faults,
    Map::R::tau_ref, Map::R::current_ref, Map::R::voltage, Map::R::duty};
using TickWords = std::array<std::uint32_t, word_slots.size()>;
inline constexpr std::uint32_t all_words = (1u << word_slots.size()) - 1;

/// What the board says of itself.
struct LinkFacts {
  std::uint32_t design_crc = 0, clock_hz = 0, clocks_per_tick = 0;
  bool simulated = false;
  int board = 0;
  std::uint32_t inputs = 0;
};

/// Rows of a tick around a trigger.
class Capture {
 public:
  std::uint32_t read(std::uint16_t address) const;
  void write(std::uint16_t address, std::uint32_t value);
  void tick(const TickWords& words);
  bool busy() const { return state_ != State::idle && state_ != State::done; }

 private:
  enum class State : std::uint8_t { idle, before, waits, fills, done };
  static constexpr std::uint32_t kRows = 1u << LinkMap::rows_log2;

  void start();
  bool triggers(const TickWords& words) const;

  std::array<std::uint32_t, kRows * LinkMap::columns> memory_{};
  std::uint32_t words_ = 0, pre_ = 0, period_ = 1, word_ = 0, mode_ = 0, level_ = 0;
  State state_ = State::idle;
  std::uint32_t next_ = 0, rows_ = 0, left_ = 0, ticks_ = 0, before_ = 0;
  bool known_ = false, by_hand_ = false;
};

/// A request whose frame holds.
struct Request {
  bool write = false;
  std::uint8_t sequence = 0;
  std::uint16_t address = 0;
  std::uint32_t value = 0;  ///< or the number of words
};

/// Frames in and out, and the link's own words. The core's port is asked by who owns this.
class ByteLink {
 public:
  explicit ByteLink(const LinkFacts& facts) : facts_(facts) {}

  /// A byte whose stop bit has come. True: request() is new.
  bool receive(std::uint8_t byte);
  const Request& request() const { return request_; }
  /// Whether this write was done before, so that it is only to be answered.
  bool repeated() const { return repeated_; }

  /// Words of the link, 0x1000 and above.
  std::uint32_t read(std::uint16_t address) const;
  void write(std::uint16_t address, std::uint32_t value);

  void reply(const Request& to, const std::vector<std::uint32_t>& words);
  /// Whether the words of the ticks are wanted.
  bool listens() const { return period_ != 0 || capture_.busy(); }
  void tick(const TickWords& words);

  /// Bytes for the tx pin.
  bool has_byte() const { return !wire_.empty(); }
  std::uint8_t take_byte();

 private:
  bool whole_frame();
  void send(std::vector<std::uint8_t> frame);
  void stream(const TickWords& words);

  LinkFacts facts_;
  Capture capture_;
  std::vector<std::uint8_t> frame_;
  bool escaped_ = false, spoilt_ = false, repeated_ = false;
  Request request_;
  std::uint32_t good_ = 0, bad_ = 0, last_sequence_ = LinkMap::no_sequence;
  std::uint32_t stream_words_ = 0, period_ = 0, dropped_ = 0, ticks_ = 0;
  std::uint8_t count_ = 0;
  std::deque<std::uint8_t> wire_;
};

}  // namespace feltgate::board
