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
#include "feltgate/quad_decoder.hpp"

namespace feltgate::axis {

class Quadrature {
 public:
  explicit Quadrature(const Design& d)
      : decoder_(0, static_cast<std::uint32_t>(d["INDEX_COUNTS"])),
        edge_bits_(d["EDGE_UNIT_BITS"]),
        fast_(d["FAST_EDGES"] != 0),
        monitor_(edge_bits_, fast_) {}

  const Position& out() const { return out_; }
  Rotor rotor() const { return {}; }
  unsigned lines() const {
    return 1;
  }  ///< chip select of an absolute encoder: high, none is selected
  void clock(const Pins& pins, const Encoder& e, const Words<std::int64_t>&) { clock(pins, e); }
  void reset() {
    decoder_.reset();
    monitor_ = EncoderMonitorLaw(edge_bits_, fast_);
    out_ = {};
    still_ = false;
    show();
  }

  /// Up to `clocks` clocks without a sample. It stops after a clock that is out of the ordinary,
  /// with a wrong edge or an index, and returns the clocks passed; `ordinary`: there was none.
  int pass(const Pins& pins, const Encoder& e, int clocks, bool& ordinary) {
    if (still(pins.encoder)) return clocks;
    const QuadDecoder::In in = at(pins.encoder, e);
    int c = 0;
    while (c < clocks && !decoder_.settled(in) && ordinary) {
      ordinary = edge(in);
      ++c;
    }
    still_ = ordinary && decoder_.settled(in);
    still_pins_ = pins.encoder;
    show();
    return ordinary ? clocks : c;
  }
  /// The clock of the sample; whether it was an ordinary one, without a trip.
  bool take(const Pins& pins, const Encoder& e) {
    if (still(pins.encoder)) {
      sample(e.tick_count);
      out_.moved = monitor_.moved();
      out_.chatters = monitor_.chatters();
      out_.trip_channel = monitor_.trips();
      out_.trip_index = monitor_.index_trips();
    } else {
      const QuadDecoder::Out before = decoder_.out();
      clock(pins, e);
      if (!ordinary(before)) return false;
    }
    return !out_.trip_channel && !out_.trip_index;
  }
  /// In a tick in which nothing is written, with these pins nothing changes but the monitor.
  bool still(const EncoderPins& pins) const { return still_ && pins == still_pins_; }
  /// Ticks with these pins are as the last one, and do not trip.
  bool calm(const Pins& pins, const Encoder& e) const {
    return decoder_.settled(at(pins.encoder, e)) && !monitor_.chatters() &&
           decoder_.out().index_wrong == monitor_.index_wrong();
  }

 private:
  void clock(const Pins& pins, const Encoder& e) {
    if (e.sample) sample(e.tick_count);
    decoder_.clock(at(pins.encoder, e));
    still_ = false;
    show();
    out_.trip_channel = e.sample && monitor_.trips();
    out_.trip_index = e.sample && monitor_.index_trips();
  }
  void sample(std::uint32_t tick_count) {
    const QuadDecoder::Out& o = decoder_.out();
    monitor_.tick(o.levels, tick_count, o.index_wrong, o.count);
  }
  void show() {
    const QuadDecoder::Out& o = decoder_.out();
    out_.position = o.position;
    out_.count = static_cast<std::int32_t>(o.count);
    out_.travel = o.travel;
    out_.moved = monitor_.moved();
    out_.chatters = monitor_.chatters();
    out_.illegal = o.illegal;
    out_.error = o.error;
    out_.error_count = o.error_count;
    out_.rejected_count = o.rejected_count;
    out_.index_position = o.index_position;
  }
  /// A clock without a sample; whether it was an ordinary one: no index, no wrong edge.
  bool edge(const QuadDecoder::In& in) {
    const QuadDecoder::Out before = decoder_.out();
    decoder_.clock(in);
    return ordinary(before);
  }
  bool ordinary(const QuadDecoder::Out& before) const {
    const QuadDecoder::Out& now = decoder_.out();
    return !now.illegal && now.error_count == before.error_count &&
           now.rejected_count == before.rejected_count &&
           now.index_position == before.index_position && now.index_seen == before.index_seen &&
           now.index_wrong == before.index_wrong;
  }
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
  Position out_;
  EncoderPins still_pins_;  ///< see still()
  bool still_ = false;
};

}  // namespace feltgate::axis
