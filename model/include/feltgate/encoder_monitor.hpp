// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/encoder_monitor.sv: detects, tick by tick, an encoder whose edges come on
// one channel only. Documentation: docs/blocks/encoder.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"

namespace feltgate {

/// State of the monitor, advanced tick by tick.
class EncoderMonitorLaw {
 public:
  /// The RTL's parameters. `edge_bits`: bits of the ticks in which the time between edges is
  /// counted. `fast`: at the fastest motion several counts come in a tick.
  explicit EncoderMonitorLaw(int edge_bits = 6, bool fast = false)
      : edge_bits_(edge_bits), fast_(fast) {}

  /// One tick. `levels`: the channels, A in bit 0. `tick`: the tick count. `index_wrong`: stays
  /// true once the count at an index does not fit. `count`: of the decoder.
  void tick(unsigned levels, std::uint32_t tick, bool index_wrong = false,
            std::uint32_t count = 0) {
    index_trips_ = index_wrong && !index_wrong_;
    index_wrong_ = index_wrong;
    if (levels == levels_ && count == count_ && !chatters()) {  // no edge, and none is counted
      moved_ = trips_ = false;
      chatter_units_ = 0;
      if (edge_units_ != Map::edge_units && whole(tick, edge_bits_)) ++edge_units_;
      return;
    }
    const unsigned changed = levels ^ levels_;
    const bool far = fast_ && ((count - count_ + 1) & 63u) > 2;
    const bool both = changed == 3;
    const bool late = edge_units_ == Map::edge_units;
    const bool of_row = (both || changed == channel_) && !late && !far;
    const bool over = chatters() && chatter_units_ == Map::chatter_units;
    moved_ = changed != 0 || far;
    count_ = count;
    levels_ = levels;
    trips_ = over ? !late && (!moved_ || of_row)
                  : moved_ && of_row && row_ == Map::dead_channel_edges - 1;

    if (!chatters() || over) {
      chatter_units_ = 0;
    } else if (whole(tick, edge_bits_ + 2)) {
      ++chatter_units_;
    }
    if (over || trips_ || (moved_ && !of_row)) {
      row_ = 0;
    } else if (moved_) {
      ++row_;
    }
    if (moved_) {
      edge_units_ = 0;
    } else if (!late && whole(tick, edge_bits_)) {
      ++edge_units_;
    }
    if (moved_ && !both) channel_ = changed == 2 ? 2 : 1;
  }

  /// The count alternates on one edge; the torque must not grow.
  bool chatters() const { return row_ >= Map::one_channel_edges; }
  /// A channel is dead; true only in the tick that finds it.
  bool trips() const { return trips_; }
  /// The count at an index does not fit; true only in the tick that finds it.
  bool index_trips() const { return index_trips_; }
  bool index_wrong() const { return index_wrong_; }
  /// An edge came in this tick.
  bool moved() const { return moved_; }

 private:
  static bool whole(std::uint32_t tick, int bits) { return (tick & ((1u << bits) - 1)) == 0; }

  int edge_bits_;
  bool fast_;
  std::uint32_t count_ = 0;
  unsigned levels_ = 0, channel_ = 1;
  int row_ = 0;            ///< consecutive edges of one channel, without the first
  int edge_units_ = 0;     ///< time since the last edge
  int chatter_units_ = 0;  ///< time since chatters() became true
  bool moved_ = false, trips_ = false, index_wrong_ = false, index_trips_ = false;
};

}  // namespace feltgate
