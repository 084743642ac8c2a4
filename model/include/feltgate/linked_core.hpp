// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/feltgate_linked.sv: the core with its host's link, clock by clock, or with the
// host's bytes from event to event. Documentation: docs/blocks/feltgate_linked.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "feltgate/feltgate_core.hpp"
#include "feltgate/link_capture.hpp"
#include "feltgate/link_port.hpp"
#include "feltgate/link_receiver.hpp"
#include "feltgate/link_stream.hpp"
#include "feltgate/link_transmitter.hpp"
#include "feltgate/uart_line.hpp"
#include "feltgate/uart_rx.hpp"
#include "feltgate/uart_tx.hpp"

namespace feltgate {

struct LinkedIn {
  EncoderPins encoder;
  bool arm = false, stop = false, set_zero = false;
  bool clear_faults = false;  ///< one clock, as set_zero
  std::uint8_t scene = 0;
  std::uint8_t inputs = 0;
  bool uart_rx = true;
};
struct LinkedOut {
  CoreOut core;
  bool uart_tx = true;
};
struct LinkedOptions {
  std::int64_t baud = LinkMap::baud;
  bool simulated = false;
  int board = 0;
};

template <class D>
class LinkedCore {
 public:
  explicit LinkedCore(LinkedOptions o = {})
      : rx_(uart_step(D::clock_hz, o.baud)),
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
    transmitter_.reset();
    stream_.reset();
    capture_.reset();
    tx_.reset();
    show();
  }

  /// One clock with the pins as they are.
  void clock(const LinkedIn& in) {
    const typename LinkPort<D>::In port = port_in(in);
    const typename LinkPort<D>::Out does = port_.peek(port);
    const UartRx::Out byte = rx_.out();
    const LinkTransmitter::Out sent = transmitter_.out();
    rx_.clock({in.uart_rx});
    receiver_.clock({byte.byte, byte.valid, byte.error, does.taken});
    port_.clock(port);
    const LinkStream::Out& frame = stream_.out();
    transmitter_.clock({does.reply, {frame.valid, frame.byte, frame.last}, tx_.out().ready});
    const CoreOut& core = core_.out();
    stream_.clock({core.word_valid, core.word_slot, core.word_data, does.addr, does.wdata,
                   does.write, sent.stream_ready});
    capture_.clock(
        {core.word_valid, core.word_slot, core.word_data, does.addr, does.wdata, does.write});
    tx_.clock({sent.byte, sent.valid});
    core_.clock(core_in(in, does));
    show();
  }

  const LinkedOut& out() const { return out_; }
  const FeltgateCore<D>& core() const { return core_; }
  FeltgateCore<D>& core() { return core_; }

  /// To the board, at the bit timing of the baud rate, as run() goes on.
  void send(std::uint8_t byte) { line_.send(byte); }
  std::size_t unsent() const { return line_.unsent(); }
  /// Of the board, as their stop bits end.
  std::vector<std::uint8_t> take_received() { return line_.take_received(); }

  /// `clocks` clocks with the pins held but for uart_rx, which carries the bytes of send(); fast
  /// while nothing happens. `on_snapshot()` is called whenever out() holds a valid snapshot.
  template <class OnSnapshot>
  void run(LinkedIn in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
    while (clocks > 0) {
      in.uart_rx = line_.level();
      const std::int64_t quiet = whole_ticks(std::min(quiet_clocks(in), clocks));
      if (quiet <= 1) {
        line_.clock(out_.uart_tx);
        clock(in);
        if (out_.core.snapshot_valid) on_snapshot();
        in.set_zero = in.clear_faults = false;
        --clocks;
        continue;
      }
      const bool captures = this->captures();
      core_.keep_words(captures);
      core_.run(core_in(in, port_.peek(port_in(in))), quiet, [&] {
        show();
        if (captures) capture_.tick(words());
        on_snapshot();
      });
      if (streams()) stream_.pass_ticks(static_cast<std::uint32_t>(quiet / D::clocks_per_tick));
      line_.skip(quiet);
      rx_.skip(quiet);
      tx_.skip(quiet);
      show();
      clocks -= quiet;
    }
  }

 private:
  typename LinkPort<D>::In port_in(const LinkedIn& in) const {
    typename LinkPort<D>::In p;
    p.request = receiver_.out().request;
    p.good = receiver_.out().good;
    p.bad = receiver_.out().bad;
    p.clear_faults = in.clear_faults;
    p.inputs = in.inputs;
    p.tick = core_.out().snapshot_valid;
    p.reg_busy = core_.out().reg_busy;
    p.reg_rdata = core_.out().reg_rdata;
    p.rdata = stream_.out().rdata | capture_.out().rdata;
    p.ready = transmitter_.out().reply_ready;
    return p;
  }
  static CoreIn core_in(const LinkedIn& in, const typename LinkPort<D>::Out& does) {
    CoreIn c;
    c.encoder = in.encoder;
    c.arm = in.arm;
    c.stop = in.stop;
    c.set_zero = in.set_zero;
    c.scene = in.scene;
    c.reg_addr = does.reg_addr;
    c.reg_wdata = does.reg_wdata;
    c.reg_write = does.reg_write;
    return c;
  }

  /// Clocks in which the link does nothing but count the phases of its bits.
  std::int64_t quiet_clocks(const LinkedIn& in) const {
    if (in.set_zero || in.clear_faults || !receiver_.idle() || !transmitter_.waits()) return 0;
    if (!port_.waits(port_in(in))) return 0;
    const bool offers = transmitter_.out().valid;
    if (transmitter_.idle() ? port_.reply().valid : offers && tx_.out().ready) return 0;
    if (!stream_.idle()) return 0;
    return std::min({rx_.quiet(in.uart_rx), tx_.quiet(), line_.quiet(out_.uart_tx)});
  }

  bool captures() const {
    using State = LinkCapture<>::State;
    return capture_.state() != State::idle && capture_.state() != State::done;
  }
  bool streams() const { return stream_.ticks_to_frame() != LinkStream::kNever; }
  /// So many of the quiet clocks at most as can be taken at once: where words are looked at, whole
  /// ticks from the clock on in which the last word of the tick before is done with.
  std::int64_t whole_ticks(std::int64_t quiet) const {
    if (!captures() && !streams()) return quiet;
    if (core_.clock_of_tick() != 1) return 0;
    std::int64_t ticks = quiet / D::clocks_per_tick;
    if (streams()) ticks = std::min<std::int64_t>(ticks, stream_.ticks_to_frame());
    return ticks * D::clocks_per_tick;
  }
  std::array<std::uint32_t, LinkMap::snapshot_words> words() const {
    std::array<std::uint32_t, LinkMap::snapshot_words> all{};
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = core_.word(LinkMap::slots[k]);
    return all;
  }

  void show() {
    out_.core = core_.out();
    out_.uart_tx = tx_.out().tx;
  }

  static constexpr std::uint32_t kFeatures = 1U << LinkMap::B::features_capture |
                                             1U << LinkMap::B::features_stream |
                                             LinkMap::rows_log2 << LinkMap::B::features_rows_log2 |
                                             LinkMap::columns << LinkMap::B::features_columns;

  FeltgateCore<D> core_;
  UartRx rx_;
  LinkReceiver receiver_;
  LinkPort<D> port_;
  LinkTransmitter transmitter_;
  LinkStream stream_;
  LinkCapture<> capture_;
  UartTx tx_;
  UartLine line_;
  LinkedOut out_;
};

}  // namespace feltgate
