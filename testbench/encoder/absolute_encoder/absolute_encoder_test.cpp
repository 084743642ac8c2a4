// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// absolute_encoder: RTL against twin in every clock, with sensors at the pins, and against the
// frames that these sent. Documentation: docs/blocks/absolute_encoder.md
#include <Vabsolute_encoder.h>
#include <fmt/format.h>

#include <cmath>

#include "catch.hpp"
#include "feltgate/absolute_position.hpp"
#include "feltgate/generated/gimbal_current.hpp"
#include "feltgate/generated/gimbal_motor.hpp"
#include "feltgate/generated/lever_absolute.hpp"
#include "figures_record.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "sensors.hpp"

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
  bench.run(stimulus, scaled_clocks(6'000'000), {biss ? 0U : 200'000U}, Reference(&log));
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
