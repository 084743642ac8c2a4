// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// absolute_encoder: RTL against twin in every clock, with sensors at the pins, and against the
// frames that these sent. Documentation: docs/blocks/absolute_encoder.md
#include <Vabsolute_encoder.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <string>
#include <type_traits>
#include <vector>

#include "catch.hpp"
#include "feltgate/absolute_encoder.hpp"
#include "feltgate/axis/absolute.hpp"
#include "feltgate/generated/gimbal_current.hpp"
#include "feltgate/generated/gimbal_motor.hpp"
#include "feltgate/generated/lever_absolute.hpp"
#include "figures_record.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "random.hpp"
#include "sim/backends/absolute_sensor.hpp"

// Sensors at the pins of absolute_encoder: they see select, clock and command, and send frames of a
// moving magnet, some of them wrong. They check the clocks that they get.

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

using namespace feltgate;
using namespace feltgate::test;

namespace {

struct Adapter {
  static void drive(Vabsolute_encoder& rtl, const AbsoluteEncoder::In& in) {
    FELTGATE_DRIVE(rtl, in, sample, data);
  }
  template <class Check>
  static void compare(Check& check, const Vabsolute_encoder& rtl, const AbsoluteEncoder::Out& out) {
    check("select", rtl.select_no, out.select_n);
    FELTGATE_COMPARE(check, rtl, out, serial_clock, command, valid, busy, starts, faults);
    check("position", sign_extend<32>(rtl.position_o), std::int64_t{out.position});
  }
};

using Bench = LockStep<Vabsolute_encoder, AbsoluteEncoder, Adapter>;

/// Readings in any distance, also in a row and too early.
struct Stimulus {
  Sensor sensor;
  Random random;
  std::int64_t every = 0, next = 0;

  AbsoluteEncoder::In operator()(std::int64_t clock, const AbsoluteEncoder::Out& out) {
    if (random.one_in(20'000)) every = random.one_in(3) ? 0 : random.between(1, 1500);
    AbsoluteEncoder::In in;
    in.sample = clock >= next;
    if (in.sample) next = clock + (every == 0 ? 1 : random.between(every / 2, every));
    in.data = sensor.pin(clock, out);
    return in;
  }
};

/// The block from the frames that the sensor sent, in plain numbers, once each reading is over.
class Reference {
 public:
  explicit Reference(Log* log) : log_(log) {}

  const char* operator()(const AbsoluteEncoder::In& in, const Vabsolute_encoder& rtl,
                         const AbsoluteEncoder&, bool in_reset) {
    ++clock_;
    if (!log_->wrong.empty()) return log_->wrong.c_str();
    if (in_reset) {
      Reference fresh(log_);
      fresh.used_ = log_->frames.size();
      *this = fresh;
    } else if (!busy_ && in.sample) {
      began_ = clock_;
      valids_ = 0;
    }
    const auto position = sign_extend<32>(rtl.position_o);
    if (rtl.valid_o != 0) {
      ++valids_;
      if (!kBiss && clock_ - began_ != kEncoder.reading_clocks() - 1) return "valid in its clock";
    } else if (position != last_position_) {
      return "the position changes with valid only";
    }
    last_position_ = position;
    const bool ends = busy_ && rtl.busy_o == 0;
    busy_ = rtl.busy_o != 0;
    if (ends) {
      if (log_->frames.size() > used_ + 1) return "one frame in a reading";
      const bool sent = log_->frames.size() > used_;
      Frame missing;
      missing.missing = true;
      const bool good = judge(sent ? log_->frames.back() : missing);
      used_ = log_->frames.size();
      if (valids_ != (good ? 1 : 0)) return "a good reading is valid once, and no other";
    }
    if (busy_) return nullptr;
    const int faults = (lost() ? kind_ : 0) | (unwell_ ? AbsoluteEncoder::kSensor : 0) |
                       (frozen_ ? AbsoluteEncoder::kFrozen : 0);
    if (rtl.faults_o != faults) return "the faults are those of the frames sent";
    if (static_cast<std::int32_t>(position) != static_cast<std::int32_t>(position_)) {
      return "the position is that of the magnet";
    }
    return nullptr;
  }

 private:
  static constexpr bool kBiss = kEncoder.framing == AbsoluteEncoder::kBiss;
  static constexpr bool kSpi = kEncoder.framing == AbsoluteEncoder::kSpi;

  bool lost() const { return wrong_ >= kEncoder.errors; }
  static std::uint64_t bits(std::uint64_t word, int low, int width) {
    return word >> low & ((std::uint64_t{1} << width) - 1);
  }

  int kind(const Frame& frame, int command) const {
    const std::uint64_t word = frame.word;
    if (frame.missing) return AbsoluteEncoder::kMissing;
    if (kBiss) {
      if (bits(word, 0, 6) != (63 ^ crc6(word, kEncoder.bits + 8))) return AbsoluteEncoder::kCheck;
      return bits(word, 7, 1) == 0 ? AbsoluteEncoder::kSensor : 0;
    }
    if (!kSpi) {
      if (bits(word, 0, 6) != crc6(word, kFrameBits)) return AbsoluteEncoder::kCheck;
      return (bits(word, 6, 4) & 0xb) != 0 ? AbsoluteEncoder::kSensor : 0;
    }
    if (odd(word)) return AbsoluteEncoder::kCheck;
    return bits(word, 14, 1) != 0 && command != 1 ? AbsoluteEncoder::kSensor : 0;
  }

  /// True if the frame gives a new position.
  bool judge(const Frame& frame) {
    const int command = first_ ? -1 : frame.command;
    first_ = false;
    int wrong = kind(frame, command);
    const bool is_angle = !kSpi || command == 0x3fff;
    const auto angle = static_cast<double>(bits(frame.word,
                                                kSpi    ? 0
                                                : kBiss ? 8
                                                        : 10,
                                                kEncoder.bits));
    const double turns = std::floor((angle - angle_) / kTurn + 0.5);
    const double step = angle - angle_ - turns * kTurn;
    // Two of the fastest readings, for an angle is up to a reading old, and for each left out the
    // speed of the last two steps and a third of the fastest.
    const bool left_out = wrong != 0 || !is_angle;
    if (left_out) left_out_ += 1;
    const double fastest = kEncoder.jump_step, size = std::fabs(step);
    const double speed = std::fmin(fastest, speed_ + std::ceil(fastest / 3));
    const double most = std::fmin(2 * fastest + left_out_ * speed, kTurn / 8.0);
    if (!left_out && size > most && !lost()) wrong = AbsoluteEncoder::kJump;
    if (wrong != 0) {
      kind_ = wrong;
      ++wrong_;
      return false;
    }
    if (!is_angle) {
      if (command == kEncoder.diag_address) diagnosed(bits(frame.word, 8, 4) == 1);
      return false;
    }
    left_out_ = 0;
    const double moved = lost() ? INFINITY : size;
    speed_ = std::fmax(moved, last_size_);
    last_size_ = moved;
    const bool was_lost = lost();
    wrong_ = 0;
    angle_ = angle;
    position_ += static_cast<std::int64_t>(step);
    steps_.push_back(was_lost ? NAN : step);
    freeze();
    return true;
  }

  /// Unwell: from two bad diagnoses in a row to the next good one.
  void diagnosed(bool well) {
    unwell_ = !well && (unwell_ || !last_well_);
    last_well_ = well;
  }
  /// Frozen: the last readings are equal, and just before them one differed by a motion.
  void freeze() {
    const auto reads = static_cast<std::size_t>(kEncoder.frozen_reads);
    if (steps_.back() != 0) {
      frozen_ = false;
    } else if (steps_.size() > reads) {
      bool equal = true;
      for (std::size_t k = 0; k < reads; ++k) equal = equal && steps_[steps_.size() - 1 - k] == 0;
      const double before = std::fabs(steps_[steps_.size() - 1 - reads]);
      frozen_ = frozen_ || (equal && before >= kEncoder.frozen_step);
    }
  }

  Log* log_;
  std::size_t used_ = 0;
  std::int64_t clock_ = 0, began_ = 0, position_ = 0, last_position_ = 0;
  bool busy_ = false, first_ = true, frozen_ = false, last_well_ = true, unwell_ = false;
  int valids_ = 0, wrong_ = kEncoder.errors, kind_ = AbsoluteEncoder::kMissing;
  double angle_ = 0, left_out_ = 0, speed_ = 0, last_size_ = 0;
  std::vector<double> steps_;
};

}  // namespace

TEST_CASE("absolute_encoder: all frames, errors and motions of a sensor") {
  Log log;
  Bench bench("absolute_encoder", 1, AbsoluteEncoder(kEncoder));
  const Stimulus stimulus{Sensor(2, &log), Random(3)};
  // After a reset the line of BiSS-C still holds what was sent before it: see the case below.
  const bool biss = kEncoder.framing == AbsoluteEncoder::kBiss;
  std::int64_t good = 0, lost = 0, frozen = 0;
  int was = 0;
  const auto watch = [&, reference = Reference(&log)](
                         const AbsoluteEncoder::In& in, const Vabsolute_encoder& rtl,
                         const AbsoluteEncoder& twin, bool in_reset) mutable {
    constexpr int kLost = AbsoluteEncoder::kCheck | AbsoluteEncoder::kJump;
    const int is = rtl.faults_o;
    good += rtl.valid_o;
    lost += (is & kLost) != 0 && (was & kLost) == 0;
    frozen += (is & ~was & AbsoluteEncoder::kFrozen) != 0;
    was = is;
    return reference(in, rtl, twin, in_reset);
  };
  bench.run(stimulus, scaled_clocks(6'000'000), {biss ? 0U : 200'000U}, watch);
  REQUIRE(good > 3000);
  REQUIRE(lost > 20);
  REQUIRE(frozen > 20);
}

TEST_CASE("absolute_encoder: any pin, with resets at any time") {
  Random random(5);
  bool level = true;
  std::int64_t mean = 100;
  const auto stimulus = [=](std::int64_t, const AbsoluteEncoder::Out&) mutable {
    if (random.one_in(5000)) mean = random.between(1, 200);
    if (random.one_in(static_cast<std::uint64_t>(mean))) level = !level;
    AbsoluteEncoder::In in;
    in.sample = random.one_in(50);
    in.data = level;
    return in;
  };
  Bench bench("absolute_encoder", 4, AbsoluteEncoder(kEncoder));
  bench.run(stimulus, scaled_clocks(1'000'000), {3'000});
}

TEST_CASE("absolute_encoder: a fault is named within 2 ms at 10 000 readings a second") {
  if (kEncoder.framing != AbsoluteEncoder::kSpi) return;  // the twin alone: once is enough
  using Defect = AbsoluteSensor::Defect;
  const struct {
    const char* text;
    Defect defect;
    bool moves;
  } events[] = {{"cable cut, the pin pulled up", Defect::cut, false},
                {"pin shorted to ground, at rest", Defect::grounded, false},
                {"magnet lost", Defect::magnet_lost, false},
                {"a bit wrong in each frame", Defect::wrong_bit, false},
                {"the angle stays as it is, in a motion", Defect::held, true},
                {"the angle is half a turn off", Defect::half_a_turn_off, true}};
  const char* const names[] = {"missing", "check", "sensor", "jump", "frozen"};
  std::string figures = "| event | SPI, ms | SSI, ms | BiSS-C, ms |\n|---|---|---|---|\n";
  for (const auto& [text, defect, moves] : events) {
    figures += fmt::format("| {} ", text);
    for (const int framing :
         {AbsoluteEncoder::kSpi, AbsoluteEncoder::kSsi, AbsoluteEncoder::kBiss}) {
      const Named found = Detection(framing, 5000, moves).longest(defect);
      INFO(text << ", framing " << framing);
      CHECK(found.clocks > 0);
      CHECK(found.clocks <= 100'000);
      for (int k = 0; k < 5; ++k) {
        if (found.faults == 1 << k) {
          figures +=
              fmt::format("| {:.2f} {} ", static_cast<double>(found.clocks) / 50e3, names[k]);
        }
      }
    }
    figures += "|\n";
  }
  check_figures("absolute_encoder", figures);
}

namespace {

/// A shaft at a constant speed beside the twin with a design's parameters. Its sensor samples by
/// itself each `own` of a reading's period, so an angle is up to so old, and has a count of noise.
/// Now and then `errors` - 1 readings in a row are wrong. True if a jump is named.
template <class D>
bool jumps(double rad_s, std::uint64_t seed, double own, double leap_counts = 0) {
  using Defect = AbsoluteSensor::Defect;
  const AbsoluteEncoder::Parameters p = absolute_parameters<D>();
  constexpr std::int64_t every = std::int64_t{D::absolute_period} * D::clocks_per_tick;
  constexpr Defect defects[] = {Defect::cut, Defect::wrong_bit, Defect::magnet_lost};
  AbsoluteEncoder twin(p);
  AbsoluteSensor sensor(p);
  Random random(seed);
  const double phase = 1e-6 * static_cast<double>(random.below(1'000'000));
  int wrong = 0;
  for (std::int64_t reading = 0; reading < 400; ++reading) {
    const double at = std::floor((static_cast<double>(reading) + phase) / own) * own;
    double rad = rad_s * at * static_cast<double>(every) / D::clock_hz;
    if (leap_counts == 0) rad += D::count_rad * static_cast<double>(random.between(-1, 1));
    if (leap_counts != 0 && reading >= 200) rad += leap_counts * D::count_rad;
    if (wrong > 0) --wrong;
    if (twin.out().position != 0 && leap_counts == 0 && wrong == 0 && random.one_in(8)) {
      wrong = p.errors;  // the last one is good
    }
    sensor.set(wrong > 1 ? defects[random.below(3)] : Defect::none);
    for (std::int64_t clock = 0; clock < every; ++clock) {
      const std::int64_t now = reading * every + clock;
      sensor.turn(rad, rad, now, 1);
      const AbsoluteEncoder::Out& o = twin.out();
      const unsigned lines =
          (o.select_n ? 1u : 0u) | (o.serial_clock ? 2u : 0u) | (o.command ? 4u : 0u);
      twin.clock({clock == 0, sensor.pin(now, lines)});
      if ((twin.out().faults & AbsoluteEncoder::kJump) != 0) return true;
    }
  }
  return false;
}

/// `overspeed_rad_s`: of the design's file.
template <class D>
void check_limit(double overspeed_rad_s) {
  const double fastest = overspeed_rad_s * D::absolute_period * D::clocks_per_tick / D::clock_hz;
  std::uint64_t seed = 1;
  for (const double own : {1.0, 0.999, 0.927, 0.7, 0.667, 0.51, 0.34, 0.01}) {
    INFO(own);
    CHECK_FALSE(jumps<D>(overspeed_rad_s, ++seed, own));
    CHECK_FALSE(jumps<D>(-overspeed_rad_s, ++seed, own));
    CHECK(jumps<D>(2.2 * overspeed_rad_s, ++seed, own));
  }
  // At rest, beyond two such readings and their noise.
  const double reach = 2 * fastest / D::count_rad;
  CHECK_FALSE(jumps<D>(0, 1, 1, std::floor(reach)));
  CHECK(jumps<D>(0, 1, 1, std::ceil(reach) + 6));
  CHECK(jumps<D>(0, 1, 1, -std::ceil(reach) - 6));
}

}  // namespace

TEST_CASE("absolute_encoder: a motion up to the over-speed is no jump, a little larger leap is") {
  if (kEncoder.framing != AbsoluteEncoder::kSpi) return;  // the twin alone: once is enough
  check_limit<LeverAbsolute>(613.6);
  check_limit<GimbalMotor>(100);
  check_limit<GimbalCurrent>(100);
}
