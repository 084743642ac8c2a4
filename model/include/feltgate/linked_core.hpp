// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/feltgate_linked.sv: the core, or an axis with its engine, together with the host
// link. It advances clock by clock, or with the host's bytes from event to event.
// Documentation: docs/blocks/feltgate_linked.md
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "feltgate/feltgate_core.hpp"
#include "feltgate/link_capture.hpp"
#include "feltgate/link_port.hpp"
#include "feltgate/link_receiver.hpp"
#include "feltgate/link_stream.hpp"
#include "feltgate/link_transmitter.hpp"
#include "feltgate/linked_axis.hpp"
#include "feltgate/uart_line.hpp"
#include "feltgate/uart_rx.hpp"
#include "feltgate/uart_tx.hpp"

namespace feltgate {

/// Inputs in one clock.
struct LinkedIn {
  EncoderPins encoder;
  /// Of a design with these options, as in CoreIn; in others they are not used.
  bool encoder_data = false, current_data = false, driver_fault = false;
  bool arm = false, stop = false, set_zero = false;
  bool clear_faults = false;  ///< one clock, like set_zero
  std::uint8_t scene = 0;
  std::uint8_t inputs = 0;
  bool uart_rx = true;
};
/// Outputs after one clock.
struct LinkedOut {
  CoreOut core;
  bool uart_tx = true;
};
/// Parameters of the RTL, and the simulated line's baud rate.
struct LinkedOptions {
  std::int64_t baud = LinkMap::baud;
  bool simulated = false;
  int board = 0;
};

/// Core and link of design D.
template <class D>
class LinkedCore {
 public:
  using Device = std::conditional_t<D::engine != 0, LinkedAxis<D>, FeltgateCore<D>>;

  explicit LinkedCore(LinkedOptions o = {})
      : rx_(uart_step(D::clock_hz, o.baud)),
        receiver_(D::engine != 0),
        port_({o.simulated, o.board, kFeatures}),
        tx_(uart_step(D::clock_hz, o.baud)),
        line_(D::clock_hz, o.baud) {
    show();
  }

  void reset() {
    core_.reset();
    rx_.reset();
    receiver_.reset();
    port_.reset();
    stream_.reset();
    capture_.reset();
    transmitter_.reset();
    tx_.reset();
    show();
  }

  /// Advances one clock with these pins.
  void clock(const LinkedIn& in) {
    const typename LinkPort<D>::In port = port_in(in);
    const typename LinkPort<D>::Out does = port_.peek(port);
    const UartRx::Out byte = rx_.out();
    const LinkTransmitter::Out sent = transmitter_.out();
    const FrameByte offered = offer();
    const CoreOut& tap = core_.out();
    stream_.clock({tap.word_valid, tap.word_slot, tap.word_data, does.addr, does.wdata, does.write,
                   sent.stream_ready});
    typename Capture::In captures{tap.word_valid, tap.word_slot, tap.word_data, does.addr,
                                  does.wdata,     does.write,    false,         0};
    if constexpr (D::engine != 0) {
      captures.event_valid = core_.event_valid();
      captures.event_number = core_.event_number();
    }
    capture_.clock(captures);
    rx_.clock({in.uart_rx});
    receiver_.clock({byte.byte, byte.valid, byte.error, does.taken});
    port_.clock(port);
    transmitter_.clock({does.reply, offered, tx_.out().ready});
    tx_.clock({sent.byte, sent.valid});
    core_.clock(core_in(in, does));
    show();
  }

  const LinkedOut& out() const { return out_; }
  const FeltgateCore<D>& core() const { return core_of(core_); }
  FeltgateCore<D>& core() { return core_of(core_); }
  /// The block at the register port: the core, or an axis with its engine.
  Device& device() { return core_; }

  /// Queues a byte for the board; run() sends it with the bit timing of the baud rate.
  void send(std::uint8_t byte) { line_.send(byte); }
  std::size_t unsent() const { return line_.unsent(); }
  /// Bytes from the board whose stop bits have ended; empties the list.
  std::vector<std::uint8_t> take_received() { return line_.take_received(); }

  /// Advances `clocks` clocks with the pins held, except uart_rx, which carries the bytes of
  /// send(). It is fast while nothing happens. `on_snapshot()` is called whenever out() holds a
  /// valid snapshot.
  template <class OnSnapshot>
  void run(LinkedIn in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
    while (clocks > 0) {
      in.uart_rx = line_.level();
      const std::int64_t quiet = stretch(std::min(quiet_clocks(in), clocks));
      if (quiet <= 1) {
        line_.clock(out_.uart_tx);
        clock(in);
        if (out_.core.snapshot_valid) on_snapshot();
        in.set_zero = in.clear_faults = false;
        --clocks;
        continue;
      }
      pass(in, port_.peek(port_in(in)), quiet, on_snapshot);
      line_.skip(quiet);
      rx_.skip(quiet);
      tx_.skip(quiet);
      show();
      clocks -= quiet;
    }
  }

 private:
  using Capture = LinkCapture<1 << LinkMap::rows_log2, D::engine != 0>;
  struct Event {
    int clock, number;  ///< clock of the tick
  };
  static constexpr std::uint32_t kFeatures =
      1U << LinkMap::B::features_capture | 1U << LinkMap::B::features_stream |
      (D::engine != 0 ? 1U : 0U) << LinkMap::B::features_engine |
      LinkMap::rows_log2 << LinkMap::B::features_rows_log2 |
      LinkMap::columns << LinkMap::B::features_columns;

  typename LinkPort<D>::In port_in(const LinkedIn& in) const {
    typename LinkPort<D>::In p;
    p.request = receiver_.out().request;
    p.good = receiver_.out().good;
    p.bad = receiver_.out().bad;
    p.clear_faults = in.clear_faults;
    p.inputs = in.inputs;
    p.tick = core_.out().snapshot_valid;
    p.reg_rdata = core_.out().reg_rdata;
    p.rdata = stream_.out().rdata | capture_.out().rdata;
    p.ready = transmitter_.out().reply_ready;
    if constexpr (D::engine != 0) {
      p.reg_busy = core_.busy(port_.peek(p).reg_addr);
    } else {
      p.reg_busy = core_.out().reg_busy;
    }
    return p;
  }
  static CoreIn core_in(const LinkedIn& in, const typename LinkPort<D>::Out& does) {
    CoreIn c;
    c.encoder = in.encoder;
    c.encoder_data = in.encoder_data;
    c.current_data = in.current_data;
    c.driver_fault = in.driver_fault;
    c.arm = in.arm;
    c.stop = in.stop;
    c.set_zero = in.set_zero;
    c.scene = in.scene;
    c.reg_addr = does.reg_addr;
    c.reg_wdata = does.reg_wdata;
    c.reg_write = does.reg_write;
    return c;
  }

  /// Number of clocks in which the link only counts the phases of its bits.
  std::int64_t quiet_clocks(const LinkedIn& in) const {
    if (in.set_zero || in.clear_faults || !receiver_.idle() || !transmitter_.waits()) return 0;
    if (!port_.waits(port_in(in)) || !stream_.waits()) return 0;
    const bool offers = transmitter_.out().valid;
    if (transmitter_.idle() ? port_.reply().valid || stream_.out().valid
                            : offers && tx_.out().ready)
      return 0;
    return std::min({rx_.quiet(in.uart_rx), tx_.quiet(), line_.quiet(out_.uart_tx)});
  }

  FrameByte offer() const { return {stream_.out().valid, stream_.out().byte, stream_.out().last}; }

  /// Clock of the tick in which stream and capture see a word of the snapshot.
  static constexpr int seen_at(int k) { return LinkMap::slots[k] + Map::first_wave_clock + 1; }
  static constexpr int kTick = D::clocks_per_tick;
  static constexpr int kLastWord = seen_at(LinkMap::snapshot_words - 1);
  static_assert(kLastWord < kTick, "the words of a tick come within it");

  /// How many of `quiet` clocks can be passed at once: the rest of a tick, or whole ticks of which
  /// stream and capture need only the last; never past the last word of a frame.
  std::int64_t stretch(std::int64_t quiet) const {
    const int at = core_.clock_of_tick();
    if (at == 0 && quiet >= kTick && !stream_.on() && !capture_.runs()) {
      return quiet / kTick * kTick;
    }
    if (stream_.keeps() && at <= kLastWord) quiet = std::min<std::int64_t>(quiet, kLastWord - at);
    return std::min<std::int64_t>(quiet, kTick - at);
  }

  /// Passes a stretch of quiet clocks.
  template <class OnSnapshot>
  void pass(const LinkedIn& in, const typename LinkPort<D>::Out& port, std::int64_t clocks,
            OnSnapshot&& on_snapshot) {
    const int from = core_.clock_of_tick();
    const int to = static_cast<int>(from + std::min<std::int64_t>(clocks, kTick));
    const CoreOut before = core_.out();
    std::int64_t ticks = clocks / kTick;  // ticks before the one whose words count
    std::array<std::uint32_t, LinkMap::snapshot_words> words{};
    const auto take = [&] {
      for (std::size_t k = 0; k < words.size(); ++k) words[k] = core_.word(LinkMap::slots[k]);
    };
    bool all = false;
    const auto at_snapshot = [&] {
      if (--ticks <= 0) take(), all = true;
      show();
      on_snapshot();
    };
    events_.clear();
    if constexpr (D::engine != 0) {
      // Without a capture the stretch may hold many ticks, and no event is needed.
      core_.run(core_in(in, port), clocks, at_snapshot, [&](std::int64_t clock, int number) {
        if (capture_.runs()) events_.push_back({from + static_cast<int>(clock), number});
      });
    } else {
      core_.run(core_in(in, port), clocks, at_snapshot);
    }
    if (!all && to < kTick) take();
    feed(from, to, words, before, port.addr);
  }

  /// Gives stream and capture the words and the events_ of the clocks [from, to) of a tick.
  void feed(int from, int to, const std::array<std::uint32_t, LinkMap::snapshot_words>& words,
            const CoreOut& before, std::uint16_t addr) {
    const auto idle = [&](int clocks) {
      for (int k = 0; k < std::min(clocks, 3); ++k) {
        stream_.clock({false, 0, 0, addr, 0, false, false});
        capture_.clock({false, 0, 0, addr, 0, false, false, 0});
      }
    };
    std::size_t told = 0;
    const auto tell = [&](int before_clock) {
      for (; told < events_.size() && events_[told].clock < before_clock; ++told) {
        capture_.event(events_[told].number);
      }
    };
    int at = from;
    for (int k = 0; k < LinkMap::snapshot_words; ++k) {
      const int seen = seen_at(k);
      if (seen < from || seen >= to) continue;
      const auto slot = static_cast<std::uint8_t>(LinkMap::slots[k]);
      const std::uint32_t word =
          seen == from ? before.word_data : words[static_cast<std::size_t>(k)];
      idle(seen - at);
      tell(seen);
      stream_.clock({true, slot, word, addr, 0, false, false});
      capture_.clock({true, slot, word, addr, 0, false, false, 0});
      tell(seen + 1);
      at = seen + 1;
    }
    idle(to - at);
    tell(to);
  }

  static FeltgateCore<D>& core_of(FeltgateCore<D>& core) { return core; }
  static const FeltgateCore<D>& core_of(const FeltgateCore<D>& core) { return core; }
  template <class Axis>
  static auto& core_of(Axis& axis) {
    return axis.core();
  }

  void show() {
    out_.core = core_.out();
    out_.uart_tx = tx_.out().tx;
  }

  Device core_;
  UartRx rx_;
  LinkReceiver receiver_;
  LinkPort<D> port_;
  LinkStream stream_;
  Capture capture_;
  LinkTransmitter transmitter_;
  UartTx tx_;
  UartLine line_;
  LinkedOut out_;
  std::vector<Event> events_;  ///< of a stretch, while a capture runs
};

}  // namespace feltgate
