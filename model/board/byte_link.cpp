// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The link at the level of bytes. Documentation: docs/board.md, docs/link.md
#include "board/byte_link.hpp"

#include <algorithm>

#include "feltgate/crc32.hpp"

namespace feltgate::board {

namespace {

using M = LinkMap;
using A = LinkMap::A;

std::uint32_t number(const std::vector<std::uint8_t>& bytes, std::size_t at, int size) {
  std::uint32_t value = 0;
  for (int k = 0; k < size; ++k) {
    value |= std::uint32_t{bytes[at + static_cast<std::size_t>(k)]} << 8 * k;
  }
  return value;
}

void append(std::vector<std::uint8_t>* bytes, std::uint32_t value, int size) {
  for (int k = 0; k < size; ++k) bytes->push_back(static_cast<std::uint8_t>(value >> 8 * k));
}

}  // namespace

std::uint32_t Capture::read(std::uint16_t address) const {
  if (address >= M::memory) {
    const std::uint32_t at = address - M::memory;
    return at < memory_.size() ? memory_[at] : 0;
  }
  switch (address) {
    case A::capture_state:
      return static_cast<std::uint32_t>(state_);
    case A::capture_words:
      return words_;
    case A::capture_pre:
      return pre_;
    case A::capture_period:
      return period_;
    case A::trigger_word:
      return word_;
    case A::trigger_mode:
      return mode_;
    case A::trigger_level:
      return level_;
    case A::capture_first:
      return rows_ == kRows ? next_ : 0;
    case A::capture_rows:
      return rows_;
    default:
      return 0;
  }
}

void Capture::write(std::uint16_t address, std::uint32_t value) {
  switch (address) {
    case A::capture_control:
      if ((value >> M::B::capture_control_abort & 1) != 0) state_ = State::idle;
      if ((value >> M::B::capture_control_start & 1) != 0) start();
      if ((value >> M::B::capture_control_trigger & 1) != 0) by_hand_ = true;
      break;
    case A::capture_words:
      words_ = value & all_words;
      break;
    case A::capture_pre:
      pre_ = std::min(value, kRows - 1);
      break;
    case A::capture_period:
      period_ = std::max(value, 1u);
      break;
    case A::trigger_word:
      word_ = value;
      break;
    case A::trigger_mode:
      mode_ = value;
      break;
    case A::trigger_level:
      level_ = value;
      break;
    default:
      break;
  }
}

void Capture::start() {
  state_ = pre_ == 0 ? State::waits : State::before;
  next_ = rows_ = ticks_ = 0;
  known_ = by_hand_ = false;
}

bool Capture::triggers(const TickWords& words) const {
  if (by_hand_) return true;
  if (word_ >= words.size() || !known_) return false;
  const std::uint32_t word = words[word_];
  const auto now = static_cast<std::int32_t>(word), was = static_cast<std::int32_t>(before_);
  const auto level = static_cast<std::int32_t>(level_);
  if (mode_ == 1) return was < level && now >= level;
  if (mode_ == 2) return was >= level && now < level;
  return mode_ == 3 && (word & ~before_ & level_) != 0;
}

void Capture::tick(const TickWords& words) {
  if (!busy()) return;
  if (state_ == State::waits && triggers(words)) {
    state_ = State::fills;
    left_ = kRows - pre_;
    ticks_ = 0;  // the trigger's tick has a row
  }
  if (word_ < words.size()) before_ = words[word_];
  known_ = true;
  if (ticks_ != 0) {
    --ticks_;
    return;
  }
  ticks_ = period_ - 1;
  std::uint32_t column = 0;
  for (std::size_t k = 0; k < words.size() && column < M::columns; ++k) {
    if ((words_ >> k & 1) != 0) memory_[next_ * M::columns + column++] = words[k];
  }
  for (; column < M::columns; ++column) memory_[next_ * M::columns + column] = 0;
  next_ = (next_ + 1) % kRows;
  rows_ = std::min(rows_ + 1, kRows);
  if (state_ == State::before && rows_ >= pre_) state_ = State::waits;
  if (state_ == State::fills && --left_ == 0) state_ = State::done;
}

bool ByteLink::receive(std::uint8_t byte) {
  if (byte == M::frame_end) {
    spoilt_ = spoilt_ || escaped_;
    const bool any = !frame_.empty() || spoilt_;
    const bool good = any && !spoilt_ && whole_frame();
    if (any) ++(good ? good_ : bad_);
    frame_.clear();
    escaped_ = spoilt_ = false;
    return good;
  }
  if (escaped_) {
    escaped_ = false;
    spoilt_ = spoilt_ || (byte != M::escaped_end && byte != M::escaped_escape);
    byte = byte == M::escaped_end ? M::frame_end : M::frame_escape;
  } else if (byte == M::frame_escape) {
    escaped_ = true;
    return false;
  }
  if (frame_.size() < M::request_bytes) {
    frame_.push_back(byte);
  } else {
    spoilt_ = true;
  }
  return false;
}

bool ByteLink::whole_frame() {
  if (frame_.size() != M::request_bytes) return false;
  if (crc32(frame_.data(), 8) != number(frame_, 8, 4)) return false;
  Request r;
  r.write = frame_[0] == M::kind_write;
  if (!r.write && frame_[0] != M::kind_read) return false;
  r.sequence = frame_[1];
  r.address = static_cast<std::uint16_t>(number(frame_, 2, 2));
  r.value = number(frame_, 4, 4);
  const std::uint32_t words = r.write ? 1 : r.value;
  if (words < 1 || words > M::read_words || r.address + words > 1u << M::map_bits) return false;
  repeated_ = r.write && last_sequence_ == r.sequence;
  if (r.write) last_sequence_ = r.sequence;
  request_ = r;
  return true;
}

std::uint32_t ByteLink::read(std::uint16_t address) const {
  using B = M::B;
  switch (address) {
    case A::identity:
      return M::identity;
    case A::version:
      return M::version;
    case A::design_crc:
      return facts_.design_crc;
    case A::clock_hz:
      return facts_.clock_hz;
    case A::clocks_per_tick:
      return facts_.clocks_per_tick;
    case A::features:
      return std::uint32_t{facts_.simulated} << B::features_simulated | 1u << B::features_capture |
             1u << B::features_stream | M::rows_log2 << B::features_rows_log2 |
             M::columns << B::features_columns;
    case A::frames_good:
      return good_;
    case A::frames_bad:
      return bad_;
    case A::last_write_sequence:
      return last_sequence_;
    case A::board:
      return static_cast<std::uint32_t>(facts_.board);
    case A::inputs:
      return facts_.inputs;
    case A::stream_words:
      return stream_words_;
    case A::stream_period:
      return period_;
    case A::stream_dropped:
      return dropped_;
    default:
      return capture_.read(address);
  }
}

void ByteLink::write(std::uint16_t address, std::uint32_t value) {
  switch (address) {
    case A::stream_words:
      stream_words_ = value & all_words;
      break;
    case A::stream_period:
      period_ = value;
      ticks_ = 0;
      break;
    default:
      capture_.write(address, value);
  }
}

void ByteLink::reply(const Request& to, const std::vector<std::uint32_t>& words) {
  const auto kind = to.write ? M::kind_write : M::kind_read;
  std::vector<std::uint8_t> frame{static_cast<std::uint8_t>(kind | M::kind_reply), to.sequence};
  append(&frame, to.address, 2);
  for (const std::uint32_t word : words) append(&frame, word, 4);
  send(std::move(frame));
}

void ByteLink::tick(const TickWords& words) {
  capture_.tick(words);
  if (period_ == 0) return;
  if (ticks_ != 0) {
    --ticks_;
    return;
  }
  ticks_ = period_ - 1;
  stream(words);
}

void ByteLink::stream(const TickWords& words) {
  const std::uint8_t count = count_++;
  if (!wire_.empty()) {
    ++dropped_;
    return;
  }
  constexpr std::uint32_t tick_bit = 1u << 2;
  static_assert(word_slots[2] == Map::R::tick, "its number in masks");
  const std::uint32_t mask = stream_words_ | tick_bit;
  std::vector<std::uint8_t> frame{M::kind_stream, count};
  append(&frame, mask, 2);
  for (std::size_t k = 0; k < words.size(); ++k) {
    if ((mask >> k & 1) != 0) append(&frame, words[k], 4);
  }
  send(std::move(frame));
}

void ByteLink::send(std::vector<std::uint8_t> frame) {
  append(&frame, crc32(frame.data(), frame.size()), 4);
  wire_.push_back(M::frame_end);
  for (const std::uint8_t byte : frame) {
    if (byte == M::frame_end || byte == M::frame_escape) {
      wire_.push_back(M::frame_escape);
      wire_.push_back(byte == M::frame_end ? M::escaped_end : M::escaped_escape);
    } else {
      wire_.push_back(byte);
    }
  }
  wire_.push_back(M::frame_end);
}

std::uint8_t ByteLink::take_byte() {
  const std::uint8_t byte = wire_.front();
  wire_.pop_front();
  return byte;
}

}  // namespace feltgate::board
