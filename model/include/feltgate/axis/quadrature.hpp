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
  unsigned lines() const { return 1; }  ///< of an absolute encoder: none is selected
  void clock(const Pins& pins, const Encoder& e, const Words<std::int64_t>&) {
    if (e.sample) sample(e.tick_count);
    decoder_.clock(at(pins.encoder, e));
    still_ = false;
    show();
    out_.trip_channel = e.sample && monitor_.trips();
    out_.trip_index = e.sample && monitor_.index_trips();
  }
  void reset() {
    decoder_.reset();
    monitor_ = EncoderMonitorLaw(edge_bits_, fast_);
    out_ = {};
    still_ = false;
    show();
  }

  /// In a tick as a whole with these pins nothing changes but the monitor.
  bool still(const EncoderPins& pins) const { return still_ && pins == still_pins_; }
  const Position* tick(std::uint32_t tick_count) {
    monitor_before_ = monitor_;
    moved_ = false;
    sample(tick_count);
    out_.moved = monitor_.moved();
    out_.chatters = monitor_.chatters();
    return monitor_.trips() || monitor_.index_trips() ? nullptr : &out_;
  }
  /// A tick of `clocks` clocks as a whole, with these pins: the position that is sampled in it.
  /// Null where something out of the ordinary happens: a trip, an index, a wrong edge.
  const Position* tick(const Pins& pins, const Encoder& e, int sample_clock, int clocks) {
    const QuadDecoder::In in = at(pins.encoder, e);
    if (decoder_.settled(in)) {
      still_pins_ = pins.encoder;
      still_ = true;
      return tick(e.tick_count);
    }
    monitor_before_ = monitor_;
    decoder_before_ = decoder_;
    moved_ = true;
    still_ = false;
    int c = 0;
    while (c < sample_clock && !decoder_.settled(in)) {
      if (!edge(in)) return nullptr;
      ++c;
    }
    sample(e.tick_count);
    if (monitor_.trips() || monitor_.index_trips()) return nullptr;
    show();
    sampled_ = out_;
    while (c < clocks && !decoder_.settled(in)) {
      if (!edge(in)) return nullptr;
      ++c;
    }
    show();
    still_pins_ = pins.encoder;
    still_ = c < clocks;
    return &sampled_;
  }
  /// Takes a tick() back.
  void undo() {
    monitor_ = monitor_before_;
    if (moved_) {
      decoder_ = decoder_before_;
      still_ = false;
    }
    show();
  }
  /// Ticks with these pins are as the last one, and do not trip.
  bool calm(const Pins& pins, const Encoder& e) const {
    return decoder_.settled(at(pins.encoder, e)) && !monitor_.chatters() &&
           decoder_.out().index_wrong == monitor_.index_wrong();
  }

 private:
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
  Position out_, sampled_;
  // Of the tick that may be taken back; and with these pins nothing moves but the monitor.
  QuadDecoder decoder_before_ = decoder_;
  EncoderMonitorLaw monitor_before_ = monitor_;
  EncoderPins still_pins_;
  bool still_ = false, moved_ = false;
};

}  // namespace feltgate::axis
