// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/quadrature.sv, an encoder socket: an incremental encoder with index.
// docs/blocks/encoder.md
#pragma once

#include "feltgate/axis/design.hpp"
#include "feltgate/axis/signals.hpp"
#include "feltgate/axis/words.hpp"
#include "feltgate/encoder_monitor.hpp"
#include "feltgate/encoder_source.hpp"
#include "feltgate/quad_decoder.hpp"

namespace feltgate::axis {

class Quadrature {
 public:
  static constexpr bool whole_ticks = true;
  explicit Quadrature(const Design& d)
      : decoder_(0, static_cast<std::uint32_t>(d["INDEX_COUNTS"])),
        edge_bits_(d["EDGE_UNIT_BITS"]),
        fast_(d["FAST_EDGES"] != 0),
        monitor_(edge_bits_, fast_) {}

  Position out() const {
    const QuadDecoder::Out& o = decoder_.out();
    Position s;
    s.position = o.position;
    s.count = static_cast<std::int32_t>(o.count);
    s.travel = o.travel;
    s.moved = monitor_.moved();
    s.chatters = monitor_.chatters();
    s.illegal = o.illegal;
    s.error = o.error;
    s.error_count = o.error_count;
    s.rejected_count = o.rejected_count;
    s.index_position = o.index_position;
    s.trip_channel = sampled_ && monitor_.trips();
    s.trip_index = sampled_ && monitor_.index_trips();
    return s;
  }
  Rotor rotor() const { return {}; }
  unsigned lines() const { return 1; }  ///< of an absolute encoder: none is selected
  void clock(const Pins& pins, const Encoder& e, const Words<std::int64_t>&) {
    if (e.sample) sample(e.tick_count);
    sampled_ = e.sample;
    decoder_.clock(at(pins.encoder, e));
  }
  void reset() {
    decoder_.reset();
    monitor_ = EncoderMonitorLaw(edge_bits_, fast_);
    sampled_ = false;
  }

  /// The monitor's tick; whether it trips.
  bool sample(std::uint32_t tick_count) {
    const QuadDecoder::Out& o = decoder_.out();
    monitor_.tick(o.levels, tick_count, o.index_wrong, o.count);
    return monitor_.trips() || monitor_.index_trips();
  }
  /// Further clocks with these inputs change nothing but the monitor.
  bool rests(const Pins& pins, const Encoder& e) const {
    return decoder_.settled(at(pins.encoder, e));
  }
  /// A clock without a sample; whether it was an ordinary one: no index, no wrong edge.
  bool edge(const Pins& pins, const Encoder& e) {
    const QuadDecoder::Out before = decoder_.out();
    decoder_.clock(at(pins.encoder, e));
    const QuadDecoder::Out& now = decoder_.out();
    return !now.illegal && now.error_count == before.error_count &&
           now.rejected_count == before.rejected_count &&
           now.index_position == before.index_position && now.index_seen == before.index_seen &&
           now.index_wrong == before.index_wrong;
  }

 private:
  static QuadDecoder::In at(const EncoderPins& pins, const Encoder& e) {
    QuadDecoder::In in;
    in.a = pins.a;
    in.b = pins.b;
    in.z = pins.z;
    in.filter = static_cast<std::uint8_t>(e.filter);
    in.polarity = e.polarity;
    in.set_zero = e.set_zero;
    in.clear_error = e.clear;
    return in;
  }

  QuadDecoder decoder_;
  int edge_bits_;
  bool fast_;
  EncoderMonitorLaw monitor_;
  bool sampled_ = false;
};

}  // namespace feltgate::axis
