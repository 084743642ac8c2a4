// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Sensors at the pins of absolute_encoder: they see select, clock and command, and send frames of a
// moving magnet, some of them wrong. They check the clocks that they get. Documentation:
// docs/blocks/absolute_encoder.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <string>
#include <type_traits>
#include <vector>

#include "feltgate/absolute_encoder.hpp"
#include "random.hpp"
#include "sim/backends/absolute_sensor.hpp"

#ifndef FELTGATE_ENCODER
#define FELTGATE_ENCODER 0
#endif

namespace feltgate::test {

inline constexpr AbsoluteEncoder::Parameters kEncoder{FELTGATE_ENCODER};
inline constexpr std::int64_t kTurn = std::int64_t{1} << kEncoder.bits;
inline constexpr int kFrameBits = kEncoder.frame_bits();

/// A reading as a sensor has it. `command` is the one that an SPI frame answers.
struct Frame {
  std::uint64_t word = 0;
  int command = -1;
  bool missing = false;
};

/// What sensors tell a reference, and what was wrong with the clocks that they got.
struct Log {
  std::vector<Frame> frames;
  std::string wrong;
  void refuse(const char* text) {
    if (wrong.empty()) wrong = text;
  }
};

/// The magnet, in counts; moves between readings.
struct Magnet {
  Random random;
  std::int64_t count = 0, away = 0;
  int mode = 0, left = 0;

  std::int64_t next() {
    if (--left <= 0) {
      mode = static_cast<int>(random.below(8));
      away = 0;
      left = static_cast<int>(random.between(1, 3 * kEncoder.frozen_reads));
    }
    // A jump begins beyond 2 to 5 of the fastest readings, by how many were left out.
    const std::int64_t few = kEncoder.frozen_step;
    const std::int64_t edge = std::min(kTurn / 8, random.between(2, 5) * kEncoder.jump_step);
    const std::int64_t sign = random.coin() ? 1 : -1;
    switch (mode) {
      case 0:
        break;
      case 1:
        count += random.between(-2, 2);
        break;
      case 2:
        count += random.between(few - 1, few + 1);
        break;
      case 3:
        count -= random.between(few - 1, few + 1);
        break;
      case 4:
        away = away != 0 ? -away : sign * random.between(edge, edge + 1);  // and back
        count += away;
        break;
      case 5:
        count += random.between(-edge, edge);
        break;
      case 7:  // from rest, and back
        if (left % 3 == 0) {
          const std::int64_t third = (kEncoder.jump_step + 2) / 3;
          const std::int64_t rest =
              2 * kEncoder.jump_step + static_cast<std::int64_t>(random.below(3)) * third;
          away = away != 0 ? -away : sign * (rest + (random.coin() ? 1 : 0));
          count += away;
        }
        break;
      default:
        if (random.one_in(3)) count += random.between(-kTurn, kTurn);
        if (random.one_in(2)) count = random.between(-few, few);
        mode = 0;
    }
    return (count % kTurn + kTurn) % kTurn;
  }
};

/// A frame of the framing in use, with parity or CRC and, by `random`, with errors.
inline std::uint64_t frame_of(std::int64_t angle, int command, bool flag, Random& random) {
  const auto position = static_cast<std::uint64_t>(angle);
  const bool ill = random.one_in(40);
  std::uint64_t word = 0;
  if (kEncoder.framing == AbsoluteEncoder::kSpi) {
    std::uint64_t data = position;
    if (command == kEncoder.diag_address) {
      data = random.below(256) | (random.one_in(4) ? random.below(16) : 1U) << 8 |
             random.below(4) << 12;
    } else if (command != 0x3fff) {
      data = random.below(1 << 14);
    }
    word = closed(kEncoder, data | (flag ? 0x4000U : 0U));
  } else if (kEncoder.framing == AbsoluteEncoder::kSsi) {
    const std::uint64_t button = random.coin() ? 4 : 0;
    word = closed(kEncoder, position << 4 | button | (ill ? random.below(16) : 0U));
  } else {
    const std::uint64_t error = ill ? random.below(2) << 1 : 2U;
    word = closed(kEncoder, position << 2 | error | random.below(2));
    if (random.one_in(8))
      word |= std::uint64_t{1} << (kEncoder.bits + 8);  // of the register channel
  }
  if (random.one_in(30)) word ^= std::uint64_t{1} << random.below(kFrameBits);
  if (random.one_in(90)) word ^= std::uint64_t{3} << random.below(kFrameBits - 1);
  if (random.one_in(90)) word = (random.coin() ? ~std::uint64_t{0} : 0U);
  return word & ((std::uint64_t{1} << kFrameBits) - 1);
}

/// SPI and SSI: selected, it sends a bit with each rising edge of the clock. The pin is right in
/// the one clock in which it must be taken, and anything in the others.
class SelectedSensor {
 public:
  SelectedSensor(std::uint64_t seed, Log* log)
      : random_(seed), magnet_{Random(seed + 1)}, log_(log) {}

  bool pin(std::int64_t, const AbsoluteEncoder::Out& out) {
    ++since_edge_;
    ++since_select_;
    if (!out.select_n && !selected_) begin();
    if (out.select_n && selected_) end(out);
    if (!out.select_n && out.serial_clock != high_) edge(out);
    if (out.select_n && out.serial_clock) log_->refuse("a serial clock without a select");
    high_ = out.serial_clock;
    const bool now = !high_ && since_edge_ == kEncoder.half_clocks - 1;
    return now && edges_ > 0 ? (word_ >> (kFrameBits - edges_) & 1) != 0 : random_.coin();
  }

 private:
  void begin() {
    if (ended_ && since_select_ < kEncoder.gap_clocks) log_->refuse("a select too early");
    selected_ = true;
    since_select_ = edges_ = 0;
    command_ = 0;
    if (random_.one_in(random_.one_in(30) ? 2 : 200)) flag_ = true;
    trouble_ = trouble_ > 0 ? trouble_ - 1 : random_.one_in(150) ? 12 : 0;
    word_ = frame_of(magnet_.next(), answers_, flag_, random_);
    if (trouble_ > 0 && random_.one_in(2)) word_ = ~std::uint64_t{0};  // a cut cable
    word_ &= (std::uint64_t{1} << kFrameBits) - 1;
  }
  void edge(const AbsoluteEncoder::Out& out) {
    const bool first = out.serial_clock && edges_ == 0;
    if (first ? since_select_ < kEncoder.gap_clocks : since_edge_ != kEncoder.half_clocks) {
      log_->refuse("a serial clock that is not half high");
    }
    since_edge_ = 0;
    if (out.serial_clock) ++edges_;
    if (!out.serial_clock) command_ = command_ << 1 | (out.command ? 1 : 0);
  }
  void end(const AbsoluteEncoder::Out& out) {
    selected_ = false;
    since_select_ = 0;
    ended_ = out.busy;
    if (!ended_) return;  // a reset
    if (edges_ != kFrameBits || high_) log_->refuse("a select that ends in a bit");
    if (since_edge_ < kEncoder.half_clocks) log_->refuse("a select that ends too early");
    log_->frames.push_back({word_, answers_});
    if (kEncoder.framing != AbsoluteEncoder::kSpi) return;
    const int known[] = {
        0xffff, 0x4001,
        0x4000 | kEncoder.diag_address |
            (odd(0x4000U | static_cast<unsigned>(kEncoder.diag_address)) ? 0x8000 : 0)};
    if (std::find(std::begin(known), std::end(known), command_) == std::end(known)) {
      log_->refuse("an unknown command");
    }
    answers_ = command_ & 0x3fff;
    if (answers_ == 1 && !random_.one_in(4)) flag_ = false;
  }

  Random random_;
  Magnet magnet_;
  Log* log_;
  std::int64_t since_edge_ = 0, since_select_ = 0;
  bool selected_ = false, high_ = false, flag_ = false, ended_ = false;
  int edges_ = 0, command_ = 0, answers_ = -1, trouble_ = 0;
  std::uint64_t word_ = 0;
};

/// BiSS-C: it answers rising edges of the clock over a line of any length, with edges that come up
/// to a clock late.
class BissSensor {
 public:
  BissSensor(std::uint64_t seed, Log* log) : random_(seed), magnet_{Random(seed + 1)}, log_(log) {}

  bool pin(std::int64_t clock, const AbsoluteEncoder::Out& out) {
    if (out.serial_clock != high_) {
      if (reads_ && clock - edge_at_ < kEncoder.half_clocks)
        log_->refuse("a serial clock too short");
      edge_at_ = clock;
      high_ = out.serial_clock;
      if (!reads_) begin();
      if (high_) rise();
    }
    if (clock - edge_at_ > 2 * kEncoder.half_clocks + 2) reads_ = false;  // the time-out
    if (!reads_ && line_.empty() && clock - stuck_at_ > 200 &&
        random_.one_in(stuck_low_ ? 200 : 20'000)) {
      stuck_low_ = !stuck_low_;
      stuck_at_ = clock;
    }
    if (!reads_) level_ = !stuck_low_;
    if (level_ != sent_) line_.push_back({clock + delay_ + (random_.one_in(3) ? 1 : 0), level_});
    sent_ = level_;
    while (!line_.empty() && line_.front().at <= clock) {
      arrived_ = line_.front().level;
      line_.pop_front();
    }
    return arrived_;
  }

 private:
  struct Change {
    std::int64_t at;
    bool level;
  };
  void begin() {
    reads_ = true;
    rises_ = 0;
    if (line_.empty() && random_.one_in(50)) delay_ = random_.between(0, 60);
    const bool late = random_.one_in(60), mute = random_.one_in(60);
    wait_ = static_cast<int>(late ? kEncoder.ack_clocks + random_.between(2, 9)
                                  : random_.between(1, 4));
    answers_ = !mute && !stuck_low_;
    word_ = frame_of(magnet_.next(), -1, false, random_);
    log_->frames.push_back({word_, -1, late || !answers_});
  }
  /// Second edge: acknowledge. Then the start bit after `wait_` serial clocks, and the frame.
  void rise() {
    ++rises_;
    if (!answers_) return;
    const int bit = rises_ - 3 - wait_;
    if (rises_ == 2) level_ = false;
    if (bit == -1) level_ = true;
    if (bit >= 0) level_ = bit < kFrameBits && (word_ >> (kFrameBits - 1 - bit) & 1) != 0;
  }

  Random random_;
  Magnet magnet_;
  Log* log_;
  bool high_ = true, level_ = true, sent_ = true, arrived_ = true;
  bool stuck_low_ = false, reads_ = false, answers_ = true;
  std::int64_t edge_at_ = 0, delay_ = 7, stuck_at_ = 0;
  int rises_ = 0, wait_ = 1;
  std::uint64_t word_ = 0;
  std::deque<Change> line_;
};

using Sensor =
    std::conditional_t<kEncoder.framing == AbsoluteEncoder::kBiss, BissSensor, SelectedSensor>;

// How long the twin takes to name a fault: an ideal sensor of each framing, then a defect.

/// Clocks from the defect to the first fault, the longest of all moments, and its bits; -1: none in
/// 40 readings.
struct Named {
  std::int64_t clocks = -1;
  int faults = 0;
};

class Detection {
 public:
  Detection(int framing, std::int64_t every, bool moves) : every_(every), moves_(moves) {
    p_.framing = framing;
  }

  Named longest(AbsoluteSensor::Defect defect) const {
    Named found{0, 0};
    for (int reading = 40; reading < 40 + 2 * (1 << p_.diag_log2); ++reading) {
      const Named one = named(defect, reading);
      if (one.clocks < 0) return one;
      if (one.clocks > found.clocks) found = one;
    }
    return found;
  }

 private:
  /// The defect comes in a reading; the later ones are wrong.
  Named named(AbsoluteSensor::Defect defect, int reading) const {
    AbsoluteEncoder twin(p_);
    AbsoluteSensor sensor(p_);
    AbsoluteEncoder::In in;
    for (std::int64_t clock = 0; clock < (reading + 40) * every_; ++clock) {
      const auto now = static_cast<int>(clock / every_);
      const double counts = 1000.5 + (moves_ ? 40 * now : 0);
      const double rad = std::ldexp(counts * 6.283185307179586, -p_.bits);
      in.sample = clock % every_ == 0;
      if (in.sample && now == reading + 1) sensor.set(defect);
      if (!moves_ && now == reading && twin.out().position != 1000) return {};
      sensor.turn(rad, rad, clock, 1);
      const AbsoluteEncoder::Out& o = twin.out();
      in.data = sensor.pin(
          clock, (o.select_n ? 1u : 0u) | (o.serial_clock ? 2u : 0u) | (o.command ? 4u : 0u));
      twin.clock(in);
      const int faults = twin.out().faults;
      if (faults != 0 && now > 30) return {clock - reading * every_, faults};
    }
    return {};
  }

  AbsoluteEncoder::Parameters p_{};
  std::int64_t every_;
  bool moves_;
};

}  // namespace feltgate::test
