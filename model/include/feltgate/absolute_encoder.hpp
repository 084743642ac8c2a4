// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/absolute_encoder.sv with serial_frame.sv: an absolute encoder over SPI with
// parity or SSI with CRC-6, with checks and a count of whole turns. A frame is judged as a whole
// here, and bit by bit in the RTL. Documentation: docs/blocks/absolute_encoder.md
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Bit-exact and clock-exact with the RTL.
class AbsoluteEncoder {
 public:
  enum Framing : int { kSpi = 0, kSsi = 1 };
  /// Bits of Out::faults.
  enum Fault : int {
    kMissing = 1,
    kCheck = 2,
    kSensor = 4,
    kJump = 1 << Map::absolute_jump_bit,
    kFrozen = 16
  };
  /// Those of the RTL, with its defaults.
  struct Parameters {
    int framing = kSpi;
    int bits = 14;              ///< of a turn, 12 to 22; SPI: 14
    int half_clocks = 5;        ///< half a serial clock, from 4
    int gap_clocks = 20;        ///< before the serial clock and between two readings, from 4
    int errors = 4;             ///< wrong readings in a row that are a fault
    int frozen_step = 4;        ///< counts between two readings that are a motion
    int frozen_reads = 16;      ///< equal readings after a motion that are a fault
    int jump_step = 160;        ///< counts of the fastest motion from one reading to the next
    int diag_address = 0x3ffc;  ///< SPI: register of the diagnosis
    int diag_log2 = 4;          ///< SPI: it is read once in 2^diag_log2 readings
    /// Bits that a sensor sends.
    constexpr int frame_bits() const { return framing == kSpi ? 16 : bits + 10; }
    /// Clocks from a sample that begins a reading to valid.
    constexpr int reading_clocks() const { return gap_clocks + 2 * half_clocks * frame_bits() + 5; }
  };
  struct In {
    bool sample = false;  ///< begins a reading; ignored in one
    bool data = false;    ///< of the sensor
  };
  struct Out {
    bool select_n = true;
    bool serial_clock = false;
    bool command = false;
    std::int32_t position = 0;  ///< counts of 2^-bits turn; wraps
    bool valid = false;
    bool starts = true;     ///< no reading was wrong since the reset
    int faults = kMissing;  ///< nothing is known before the first reading
  };

  AbsoluteEncoder() : AbsoluteEncoder(Parameters{}) {}
  explicit AbsoluteEncoder(const Parameters& parameters)
      : p_(parameters), errors_(parameters.errors) {}

  void reset() { *this = AbsoluteEncoder(p_); }

  void clock(const In& in) {
    out_.valid = false;
    if (ends_) judge();
    ends_ = false;
    const bool reads = state_ == State::read;
    out_.select_n = !(reads || state_ == State::lead);
    const bool clocks = reads && period_ < p_.frame_bits();
    out_.serial_clock = clocks && wait_ < p_.half_clocks;
    if (clocks && wait_ == 0 && period_ != 0) command_ = (command_ << 1) & 0xffff;
    step(in.sample);
    out_.command = p_.framing == kSpi && (command_ & 0x8000) != 0;
    bit_ = captured_;
    captured_ = in.data;
  }

  const Out& out() const { return out_; }

 private:
  enum class State { idle, lead, read, gap };
  enum class Kind { nothing, angle, diagnosis, flags };

  void step(bool sample) {
    switch (state_) {
      case State::idle:
        wait_ = 0;
        if (!sample) break;
        state_ = State::lead;
        ask();
        break;
      case State::lead:
        if (++wait_ < p_.gap_clocks) break;
        wait_ = period_ = taken_ = 0;
        frame_ = 0;
        state_ = State::read;
        break;
      case State::read:
        read();
        break;
      case State::gap:
        if (++wait_ == p_.gap_clocks) state_ = State::idle;
        break;
    }
  }

  void read() {
    constexpr int take_at =
        2;  // clocks after the serial clock's edge: two flip-flops after the pin
    if (wait_ == take_at && period_ != 0) {
      frame_ = frame_ << 1 | (bit_ ? 1U : 0U);
      if (++taken_ == p_.frame_bits()) {
        ends_ = true;
        wait_ = 0;
        state_ = State::gap;
        return;
      }
    }
    if (++wait_ < 2 * p_.half_clocks) return;
    wait_ = 0;
    ++period_;
  }

  void ask() {
    if (p_.framing != kSpi) return;
    answer_ = asked_;
    const bool diagnose = readings_ == 0 || ill_ == 1;
    asked_ = flagged_ ? Kind::flags : diagnose ? Kind::diagnosis : Kind::angle;
    readings_ = (readings_ + 1) % (1 << p_.diag_log2);
    const int address = asked_ == Kind::flags   ? 1
                        : asked_ == Kind::angle ? 0x3fff
                                                : p_.diag_address;
    command_ = 0x4000 | (address & 0x3fff);
    if (ones(command_) % 2 != 0) command_ |= 0x8000;
  }

  static int ones(std::uint64_t word) {
    int count = 0;
    for (; word != 0; word &= word - 1) ++count;
    return count;
  }
  /// Remainder of the lowest `length` bits by x^6 + x + 1.
  static std::uint64_t remainder(std::uint64_t word, int length) {
    word &= (std::uint64_t{1} << length) - 1;
    for (int k = length - 1; k >= 6; --k) {
      if ((word >> k & 1) != 0) word ^= std::uint64_t{0x43} << (k - 6);
    }
    return word;
  }
  std::uint64_t field(int low, int width) const {
    return frame_ >> low & ((std::uint64_t{1} << width) - 1);
  }

  /// What is wrong with the frame itself, 0 if nothing.
  int wrong() const {
    if (p_.framing == kSsi) {
      if (remainder(frame_, p_.bits + 10) != 0) return kCheck;
      return field(9, 1) != 0 || field(6, 2) != 0 ? kSensor : 0;
    }
    if (ones(frame_) % 2 != 0) return kCheck;
    return field(14, 1) != 0 && answer_ != Kind::flags ? kSensor : 0;
  }

  void judge() {
    const bool is_lost = errors_ == p_.errors;
    const bool is_angle = p_.framing != kSpi || answer_ == Kind::angle;
    int kind = wrong();
    const auto turn = std::int32_t{1} << p_.bits;
    const auto angle = static_cast<std::int32_t>(field(p_.framing == kSpi ? 0 : 10, p_.bits));
    std::int32_t step = (angle - turn_ + turn) % turn;
    if (step >= turn / 2) step -= turn;
    if (kind != 0 || !is_angle) reach_ = std::min(turn / 8, reach_ + pace());
    if (kind == 0 && is_angle && !is_lost && std::abs(step) > reach_) kind = kJump;
    flagged_ = field(14, 1) != 0 && asked_ != Kind::flags;
    if (kind != 0) {
      kind_ = kind;
      out_.starts = false;
      if (!is_lost) ++errors_;
    } else if (is_angle) {
      accept(angle, step, is_lost);
    } else if (answer_ == Kind::diagnosis) {
      ill_ = field(8, 4) == 1 ? 0 : ill_ < 2 ? ill_ + 1 : 2;
    }
    out_.faults =
        (errors_ == p_.errors ? kind_ : 0) | (ill_ == 2 ? kSensor : 0) | (frozen_ ? kFrozen : 0);
  }

  /// What a reading that was left out adds to the reach: the larger of the last two steps and a
  /// third of the fastest, which is more than a shaft gains in a reading.
  int pace() const {
    const int gain = (p_.jump_step + 2) / 3;
    return std::min(p_.jump_step, std::max(last_step_, step_before_) + gain);
  }

  void accept(std::int32_t angle, std::int32_t step, bool was_lost) {
    out_.valid = true;
    // Two readings: a sensor that samples by itself gives an angle up to a reading old. A jump adds
    // nothing, so an angle that stays where it leapt is a fault.
    reach_ = std::min(1 << (p_.bits - 3), 2 * p_.jump_step);
    step_before_ = last_step_;
    last_step_ = was_lost ? p_.jump_step : std::min(std::abs(step), p_.jump_step);
    out_.position = static_cast<std::int32_t>(static_cast<std::uint32_t>(out_.position) +
                                              static_cast<std::uint32_t>(step));
    turn_ = angle;
    errors_ = 0;
    if (step != 0 || was_lost) {
      moved_ = !was_lost && (step < 0 ? -step : step) >= p_.frozen_step;
      equal_ = 0;
      frozen_ = false;
    } else if (moved_ && ++equal_ == p_.frozen_reads) {
      moved_ = false;
      frozen_ = true;
    }
  }

  Parameters p_;
  Out out_;
  bool captured_ = false, bit_ = false;  // the pin one and two clocks ago
  State state_ = State::idle;
  int wait_ = 0, period_ = 0, taken_ = 0;
  bool ends_ = false;
  std::uint64_t frame_ = 0;
  Kind asked_ = Kind::nothing, answer_ = Kind::nothing;
  std::uint32_t command_ = 0;
  int readings_ = 0;
  bool flagged_ = false;
  int ill_ = 0;  // diagnoses in a row that say the angle cannot be trusted
  std::int32_t turn_ = 0;
  int reach_ = 0;  // counts by which the next good reading may differ from the last one
  int last_step_ = 0, step_before_ = 0;  // of good readings, at most jump_step
  int errors_, kind_ = kMissing, equal_ = 0;
  bool moved_ = false, frozen_ = false;
};

}  // namespace feltgate
