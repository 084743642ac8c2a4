// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// current_sense: adapter, random streams, and the block once more from a
// list of all bits, by a convolution of three boxes. Documentation: docs/blocks/current.md
#pragma once

#include <Vcurrent_sense.h>

#include <cmath>
#include <vector>

#include "feltgate/current_sense.hpp"
#include "feltgate/largest.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "sim/plant/sigma_delta.hpp"

#ifndef FELTGATE_SENSE
#define FELTGATE_SENSE 4, 6, 3, 3, 256, 8, 4096
#endif

namespace feltgate::test {

inline constexpr CurrentSense::Parameters kSense{FELTGATE_SENSE};

struct Adapter {
  static void drive(Vcurrent_sense& rtl, const CurrentSense::In& in) {
    FELTGATE_DRIVE(rtl, in, data, strobe, armed, clear);
    using Threshold = std::conditional_t<kSense.fast_log2 == 3, std::uint8_t, std::uint16_t>;
    rtl.threshold_i = static_cast<Threshold>(in.threshold);
  }
  template <class Check>
  static void compare(Check& check, const Vcurrent_sense& rtl, const CurrentSense::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, modulator_clock, valid, aligned, overcurrent, calibrated,
                     offset_fault, stuck, saturated);
    check("current", sign_extend<3 * kSense.decimation_log2 + 1>(rtl.current_o), out.current);
  }
};

using Bench = LockStep<Vcurrent_sense, CurrentSense, Adapter>;

/// The plant's modulator, with its quantiser's error.
struct Modulator {
  plant::SigmaDelta modulator{};
  double largest_error = 0, squares = 0;
  std::int64_t bits = 0;
  double rms_error() const { return std::sqrt(squares / static_cast<double>(bits)); }
  bool next(double x) {
    const bool bit = modulator.next(x);
    const double error = modulator.error();
    largest_error = larger(largest_error, std::fabs(error));
    squares += error * error;
    ++bits;
    return bit;
  }
};

/// The twin with bits from a function of the modulator clocks since the reset.
struct Fed {
  CurrentSense twin;
  CurrentSense::In in{};
  std::int64_t clock = 0, bits = 0;
  bool was_high = false;

  explicit Fed(const CurrentSense::Parameters& parameters = kSense) : twin(parameters) {}

  /// One clock; true if it launched a bit.
  template <class Bit>
  bool step(const Bit& bit) {
    twin.clock(in);
    ++clock;
    const bool rose = twin.out().modulator_clock && !was_high;
    was_high = twin.out().modulator_clock;
    if (rose) in.data = bit(bits++);
    return rose;
  }
};

/// The impulse response of a sinc3: a box of `decimation` ones, convolved with itself twice.
inline std::vector<std::int64_t> sinc3_response(int decimation) {
  const std::vector<std::int64_t> box(static_cast<std::size_t>(decimation), 1);
  std::vector<std::int64_t> response = box;
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<std::int64_t> wider(response.size() + box.size() - 1, 0);
    for (std::size_t k = 0; k < response.size(); ++k) {
      for (std::size_t j = 0; j < box.size(); ++j) wider[k + j] += response[k] * box[j];
    }
    response = wider;
  }
  return response;
}

/// Streams of all kinds, each for a while. The bit is right in the one clock in which it must be
/// taken, and anything in the others.
struct RandomStreams {
  Random random;
  std::int64_t scale;  // mean clocks of a kind of stream
  CurrentSense::In in{};
  Modulator modulator{};
  enum Kind { constant, wave, noise, ones, zeros, alternating, overrange, kinds } kind = constant;
  double level = 0, speed = 0;
  std::int64_t bits = 0, since_rise = 0, strobe_every = 1000, strobe_at = 0;
  bool was_high = false, bit = false;

  CurrentSense::In operator()(std::int64_t clock, const CurrentSense::Out& out) {
    if (random.one_in(static_cast<std::uint64_t>(scale))) change();
    // Disarmed, most often with a small offset for as long as averages take.
    const std::int64_t average = std::int64_t{1} << (kSense.offset_log2 + kSense.decimation_log2);
    if (random.one_in(static_cast<std::uint64_t>((in.armed ? 2 : 5) * average * kSense.divider))) {
      in.armed = !in.armed;
    }
    ++since_rise;
    if (out.modulator_clock && !was_high) {
      since_rise = 1;
      ++bits;
      bit = next();
    }
    was_high = out.modulator_clock;
    in.data = since_rise == kSense.divider - 1 ? bit : random.coin();
    in.strobe = strobe_every > 0 ? clock >= strobe_at : random.one_in(300);
    if (in.strobe) strobe_at = clock + strobe_every;
    in.clear = random.one_in(60);
    return in;
  }

 private:
  void change() {
    kind = static_cast<Kind>(random.one_in(3) ? random.below(kinds) : random.below(2));
    const double span = in.armed
                            ? (random.one_in(2) ? 0.9 : 0.5)
                            : 3.0 * kSense.offset_limit / static_cast<double>(kSense.full_scale());
    level = span * static_cast<double>(random.between(-1000, 1000)) / 1000;
    speed = static_cast<double>(random.between(1, 1000)) * 1e-4;
    in.threshold = static_cast<std::int32_t>(
        random.one_in(8) ? kSense.fast_full_scale() - 1
                         : random.below(static_cast<std::uint64_t>(kSense.fast_full_scale())));
    const std::int64_t window = std::int64_t{kSense.divider} << kSense.decimation_log2;
    constexpr std::int64_t none = 1'000'000'000;
    const std::int64_t every[] = {
        0, none, 1000, window, 2 * window, 3 * window + 1, 4 * window, 3 * window + kSense.divider};
    strobe_every = every[random.below(8)];
    strobe_at = 0;
  }
  bool next() {
    switch (kind) {
      case constant:
        return modulator.next(level);
      case wave:
        return modulator.next(level * std::sin(speed * static_cast<double>(bits)));
      case noise:
        return random.coin();
      case ones:
        return true;
      case zeros:
        return false;
      case alternating:
        return bits % 2 != 0;
      // A modulator beyond its range, which shows by one bit in 128 that it lives.
      default:
        return (bits % 128 == 0) != (level > 0);
    }
  }
};

/// The block from the list of all bits. It sees the ports of the RTL alone.
class Reference {
 public:
  const char* operator()(const CurrentSense::In& in, const Vcurrent_sense& rtl, const CurrentSense&,
                         bool in_reset) {
    if (in_reset) {
      *this = Reference{};
      return nullptr;
    }
    const char* broken = nullptr;
    // A rising edge in this clock launches the bit that is there in clock divider - 1 after it.
    if (rtl.modulator_clock_o != 0 && !was_high_) {
      if (since_rise_ != 0 && since_rise_ != kSense.divider)
        broken = "the modulator's clock has its period";
      since_rise_ = 0;
    } else if (rtl.modulator_clock_o == 0 && was_high_ && since_rise_ != kSense.divider / 2) {
      broken = "the modulator's clock is high for half of it";
    }
    was_high_ = rtl.modulator_clock_o != 0;
    if (since_rise_ == kSense.divider - 1) bits_.push_back(in.data);
    ++since_rise_;
    // Two clocks later it is added, and a strobe before that clock counts.
    if (++clock_ % kSense.divider == 2) add(bits_.size() - 1);
    strobe_ = strobe_ || in.strobe;
    const char* other = outputs(in, rtl);
    return broken != nullptr ? broken : other;
  }

 private:
  static constexpr std::int64_t kM = std::int64_t{1} << kSense.decimation_log2;
  static constexpr std::int64_t kF = std::int64_t{1} << kSense.fast_log2;

  std::int64_t sum(const std::vector<std::int64_t>& response, std::int64_t newest) const {
    std::int64_t total = 0;
    for (std::size_t j = 0; j < response.size(); ++j) {
      const std::int64_t n = newest - static_cast<std::int64_t>(j);
      if (n >= 0 && bits_[static_cast<std::size_t>(n)]) total += response[j];
    }
    return total;
  }

  void add(std::size_t size) {
    const auto n = static_cast<std::int64_t>(size);
    if (n > 0 && bits_[size] != bits_[size - 1]) last_change_ = n;
    if (n == 0 && bits_[0]) last_change_ = 0;
    bool now = strobe_;
    strobe_ = false;
    if (now && (n - begin_) % kM != 0) {
      now = n - begin_ >= 3 * kM;
      if (now) begin_ = n;
    }
    if (now) strobes_.push_back(n);
    if ((n - begin_) % kM == 0 && n - begin_ >= 3 * kM) {
      static const std::vector<std::int64_t> response = sinc3_response(kM);
      due_ = clock_ + 6;
      due_value_ = sum(response, n) - kSense.full_scale();
      due_aligned_ = false;
      for (const std::int64_t at : strobes_) due_aligned_ = due_aligned_ || at == n - 3 * kM;
      if (strobes_.size() > 8) strobes_.erase(strobes_.begin(), strobes_.end() - 4);
    }
    if ((n + 1) % kF == 0 && n >= 3 * kF - 1) {
      static const std::vector<std::int64_t> response = sinc3_response(kF);
      fast_due_ = clock_ + 6;
      fast_value_ = sum(response, n) - kSense.fast_full_scale();
    }
  }

  const char* outputs(const CurrentSense::In& in, const Vcurrent_sense& rtl) {
    const char* broken = nullptr;
    const auto expect = [&broken](bool holds, const char* text) {
      if (!holds && broken == nullptr) broken = text;
    };
    const bool result = clock_ == due_;
    expect((rtl.valid_o != 0) == result, "a result for each whole window");
    expect((rtl.aligned_o != 0) == (result && due_aligned_), "aligned is a window from a strobe");
    if (result) {
      const auto current = sign_extend<3 * kSense.decimation_log2 + 1>(rtl.current_o);
      expect(current == due_value_ - offset_, "the current is the convolution without the offset");
      const std::int64_t end = kSense.full_scale() - kM * kM;
      saturated_ = due_value_ >= end || due_value_ <= -end;
    }
    expect((rtl.saturated_o != 0) == saturated_, "saturated is the last result");
    average(in.armed, result);
    expect((rtl.calibrated_o != 0) == calibrated_, "calibrated with the first offset");
    expect((rtl.offset_fault_o != 0) == offset_fault_, "an offset beyond the limit is a fault");
    fast(in, clock_ == fast_due_);
    expect((rtl.overcurrent_o != 0) == overcurrent_, "over-current after hits in a row");
    const std::int64_t newest = clock_ < 2 ? 0 : (clock_ - 2) / kSense.divider;  // that is added
    const bool stuck = newest - last_change_ >= kSense.stuck_clocks;
    expect((rtl.stuck_o != 0) == stuck, "stuck without a transition");
    return broken;
  }

  void average(bool armed, bool result) {
    if (armed) {
      values_.clear();
    } else if (result) {
      values_.push_back(due_value_);
      const std::size_t length = std::size_t{1} << kSense.offset_log2;
      if (values_.size() % length == 0 && values_.size() > length) {
        std::int64_t total = 0;
        for (std::size_t k = values_.size() - length; k < values_.size(); ++k) total += values_[k];
        // Nearest, a half up.
        const auto mean = static_cast<std::int64_t>(
            std::floor(static_cast<double>(total) / static_cast<double>(length) + 0.5));
        offset_fault_ = std::abs(mean) > kSense.offset_limit;
        if (!offset_fault_) {
          offset_ = mean;
          calibrated_ = true;
        }
      }
    }
  }

  void fast(const CurrentSense::In& in, bool result) {
    const bool hit = result && std::abs(fast_value_) >= in.threshold;
    if (result) in_a_row_ = hit ? in_a_row_ + 1 : 0;
    if (hit && in_a_row_ >= kSense.hits) {
      overcurrent_ = true;
    } else if (in.clear && overcurrent_) {
      overcurrent_ = hit || was_hit_;
    }
    if (result) was_hit_ = hit;
  }

  std::vector<bool> bits_{false};  // the first that is added after a reset has no edge of its own
  std::int64_t clock_ = 0, since_rise_ = 0, begin_ = -1, last_change_ = -1;
  std::int64_t due_ = -1, due_value_ = 0, fast_due_ = -1, fast_value_ = 0, offset_ = 0;
  std::vector<std::int64_t> strobes_, values_;
  int in_a_row_ = 0;
  bool was_high_ = false, strobe_ = false, due_aligned_ = false, saturated_ = false;
  bool calibrated_ = false, offset_fault_ = false, overcurrent_ = false, was_hit_ = false;
};

}  // namespace feltgate::test
