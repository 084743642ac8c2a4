// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/quad_decoder.sv: incremental encoder to position [1,31,0] counts, which
// wraps. Latency from pin to travel 3 clocks, to position 4 clocks, plus the filter length.
// Documentation: docs/blocks/encoder.md
#pragma once

#include <array>
#include <cstdint>

#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Bit-exact and clock-exact with the RTL; a member x_q_ is the register x_q there.
class QuadDecoder {
 public:
  struct In {
    bool a = false;
    bool b = false;
    bool z = false;
    std::uint8_t filter = 0;   ///< 0..15: pulses of up to so many clocks are rejected
    bool polarity = false;     ///< true: counts the other way
    bool set_zero = false;     ///< position counts from here; it shows this two clocks later
    bool clear_error = false;  ///< clears error, both counters and index_seen
    bool operator==(const In& o) const {
      return a == o.a && b == o.b && z == o.z && filter == o.filter && polarity == o.polarity &&
             set_zero == o.set_zero && clear_error == o.clear_error;
    }
  };
  struct Out {
    std::int32_t position = 0;         ///< counts since zero, modulo 2^32
    std::uint16_t travel = 0;          ///< counts since reset, modulo 2^16
    std::int8_t step = 0;              ///< change of travel in this clock: -1, 0 or +1
    bool error = false;                ///< sticky: both channels changed in one clock
    bool illegal = false;              ///< both channels changed in the clock before
    std::uint16_t error_count = 0;     ///< number of such clocks, saturates at 65535
    std::uint16_t rejected_count = 0;  ///< clocks in which the filter rejected, saturates at 65535
    std::int32_t index_position = 0;   ///< position at the last rising edge of Z
    bool index_seen = false;
    bool index_wrong = false;  ///< sticky: the count at an index does not fit
    std::uint8_t levels = 0;   ///< accepted levels: A in bit 0, B in bit 1
    std::uint32_t count = 0;   ///< counts since reset
    std::uint32_t zero = 0;    ///< value of `count` at position 0
    bool operator==(const Out& o) const {
      return position == o.position && travel == o.travel && step == o.step && error == o.error &&
             illegal == o.illegal && error_count == o.error_count &&
             rejected_count == o.rejected_count && index_position == o.index_position &&
             index_seen == o.index_seen && index_wrong == o.index_wrong && levels == o.levels &&
             count == o.count && zero == o.zero;
    }
  };

  /// `reset_position` is the RTL parameter ResetPosition (for tests of the wrap). `index_counts` is
  /// IndexCounts: counts per revolution, a power of two, or 0.
  explicit QuadDecoder(std::int32_t reset_position = 0, std::uint32_t index_counts = 0)
      : reset_position_(reset_position), index_counts_(index_counts) {
    reset();
  }

  void reset() {
    meta_q_ = sync_q_ = previous_q_ = level_q_ = 0;
    wait_q_ = {};
    fill_q_ = 0;
    primed_q_ = false;
    index_q_ = false;
    error_wait_q_ = false;
    rejected_wait_q_ = false;
    out_ = Out{};
    out_.count = static_cast<std::uint32_t>(reset_position_);
    out_.position = reset_position_;
    out_.travel = static_cast<std::uint16_t>(out_.count);
  }

  void clock(const In& in) {
    const bool ab_differ = ((level_q_ ^ (level_q_ >> 1)) & 1U) != 0;
    const bool index_level = (sync_q_ & kZ) != 0;
    const bool rejected = primed_q_ && (~(sync_q_ ^ level_q_) & (previous_q_ ^ sync_q_)) != 0;
    const std::uint32_t changed = filter(in.filter);
    previous_q_ = sync_q_;
    sync_q_ = meta_q_;
    meta_q_ = pins(in);
    primed_q_ = fill_q_ >= 2;
    fill_q_ = static_cast<std::uint8_t>(fill_q_ < 2 ? fill_q_ + 1 : 2);

    const auto position = static_cast<std::int32_t>(out_.count - out_.zero);
    serve_counters(in.clear_error);
    rejected_wait_q_ |= rejected;
    const bool wrong = index_q_ && out_.index_seen && slipped();
    if (index_q_ && !out_.index_seen) first_ = out_.count;
    out_.index_wrong = wrong || (out_.index_wrong && !in.clear_error);
    out_.index_seen = index_q_ || (out_.index_seen && !in.clear_error);
    if (index_q_) out_.index_position = position;
    index_q_ = (changed & kZ) != 0 && index_level;
    out_.position = position;
    if (in.set_zero) out_.zero = out_.count;

    const bool changed_a = (changed & kA) != 0;
    const bool changed_b = (changed & kB) != 0;
    const bool illegal = changed_a && changed_b;
    out_.error = illegal || (out_.error && !in.clear_error);
    out_.illegal = illegal;
    error_wait_q_ |= illegal;
    out_.step = 0;
    out_.levels = static_cast<std::uint8_t>(level_q_ & (kA | kB));
    if (changed_a != changed_b) {
      // Gray code: (A,B) in the order 00 01 11 10 counts up.
      const bool down = changed_a != (ab_differ != in.polarity);
      out_.step = down ? -1 : 1;
      out_.count += down ? 0xffffffffU : 1U;
      out_.travel = static_cast<std::uint16_t>(out_.count);
    }
  }

  const Out& out() const { return out_; }
  /// The count, whatever its zero.
  std::int32_t count() const { return static_cast<std::int32_t>(out_.count); }

  /// Whether further clocks with these inputs change no register and no output, so that the clocks
  /// up to the next pin change may be skipped.
  bool settled(const In& in) const {
    if (!primed_q_ || in.set_zero || in.clear_error || error_wait_q_ || rejected_wait_q_ ||
        index_q_ || out_.step != 0 || out_.illegal ||
        out_.position != static_cast<std::int32_t>(out_.count - out_.zero)) {
      return false;
    }
    const std::uint32_t now = pins(in);
    const std::uint8_t wait = in.filter;
    return meta_q_ == now && sync_q_ == now && previous_q_ == now && level_q_ == now &&
           wait_q_[0] == wait && wait_q_[1] == wait && wait_q_[2] == wait;
  }
  /// Whether the index is low and stays low while these inputs hold.
  bool index_rests(const In& in) const {
    return ((pins(in) | meta_q_ | sync_q_ | previous_q_ | level_q_) & kZ) == 0 && !index_q_;
  }

 private:
  // Bit c of a word is channel c, as in the RTL.
  static constexpr std::uint32_t kA = 1;
  static constexpr std::uint32_t kB = 2;
  static constexpr std::uint32_t kZ = 4;

  static std::uint32_t pins(const In& in) {
    return (in.a ? kA : 0) | (in.b ? kB : 0) | (in.z ? kZ : 0);
  }

  // One clock of the three filters; returns the channels whose accepted level changes.
  std::uint32_t filter(std::uint8_t length) {
    const std::uint32_t differs = sync_q_ ^ level_q_;
    if (!primed_q_ || differs == 0) {
      wait_q_ = {length, length, length};
      level_q_ = sync_q_;  // the first sample makes no edge
      return 0;
    }
    std::uint32_t changed = 0;
    for (std::uint32_t c = 0; c < 3; ++c) {
      if ((differs >> c & 1U) == 0) {
        wait_q_[c] = length;
      } else if (wait_q_[c] == 0) {
        wait_q_[c] = length;
        changed |= 1U << c;
      } else {
        --wait_q_[c];
      }
    }
    level_q_ ^= changed;
    return changed;
  }

  // Both counters share one incrementer. A waiting event is counted, except in the clock of a
  // clear.
  void serve_counters(bool clear) {
    if (clear) {
      out_.error_count = 0;
      out_.rejected_count = 0;
    } else if (rejected_wait_q_) {
      rejected_wait_q_ = false;
      if (out_.rejected_count != 0xffff) ++out_.rejected_count;
    } else if (error_wait_q_) {
      error_wait_q_ = false;
      if (out_.error_count != 0xffff) ++out_.error_count;
    }
  }

  /// Whether the count at this index and the count at the first index differ by more than whole
  /// revolutions plus the width of an index.
  bool slipped() const {
    constexpr std::uint32_t near = 1u << Map::index_width_bits;
    return index_counts_ != 0 && ((out_.count - first_ + near) & (index_counts_ - 1)) >= 2 * near;
  }

  std::int32_t reset_position_;
  std::uint32_t index_counts_;
  std::uint32_t first_ = 0;  ///< count at the first index; a reset keeps it
  std::uint32_t meta_q_ = 0;
  std::uint32_t sync_q_ = 0;
  std::uint32_t previous_q_ = 0;
  std::uint32_t level_q_ = 0;
  std::array<std::uint8_t, 3> wait_q_{};
  std::uint8_t fill_q_ = 0;
  bool primed_q_ = false;
  bool index_q_ = false;
  bool error_wait_q_ = false;
  bool rejected_wait_q_ = false;
  Out out_;
};

}  // namespace feltgate
