// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/feltgate_linked.sv: the core, or axes with their engine, together with the host
// link. It advances clock by clock, or with the host's bytes from event to event.
// Documentation: docs/link.md
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
#include "feltgate/link_view.hpp"
#include "feltgate/linked_axes.hpp"
#include "feltgate/linked_ports.hpp"
#include "feltgate/uart_line.hpp"
#include "feltgate/uart_rx.hpp"
#include "feltgate/uart_tx.hpp"

namespace feltgate {

/// Core and link, or N axes and their link; with an engine one axis is such a device, too.
template <int N = 1, bool WithEngine = false>
class LinkedCore {
 public:
  using Device = std::conditional_t<WithEngine || N != 1, LinkedAxes<N, WithEngine>, FeltgateCore>;
  using In = std::conditional_t<N == 1, LinkedIn, LinkedAxesIn<N>>;
  using Out = std::conditional_t<N == 1, LinkedOut, LinkedAxesOut<N>>;

  explicit LinkedCore(const axis::Design& d, LinkedOptions o = {})
      : core_(d),
        rx_(uart_step(d.wide("CLOCK_HZ"), o.baud)),
        receiver_(WithEngine),
        port_({o.simulated, o.board, kFeatures, static_cast<std::uint32_t>(d.wide("DESIGN_CRC")),
               static_cast<std::uint32_t>(d.wide("CLOCK_HZ")),
               static_cast<std::uint32_t>(d["CLOCKS_PER_TICK"]), WithEngine}),
        tx_(uart_step(d.wide("CLOCK_HZ"), o.baud)),
        line_(d.wide("CLOCK_HZ"), o.baud),
        tick_clocks_(d["CLOCKS_PER_TICK"]) {
    show();
  }

  void reset() {
    core_.reset();
    rx_.reset();
    receiver_.reset();
    port_.reset();
    stream_.reset();
    capture_.reset();
    view_.reset();
    transmitter_.reset();
    tx_.reset();
    show();
  }

  /// Advances one clock with these pins.
  void clock(const In& in) {
    const typename Port::In port = port_in(in);
    const typename Port::Out does = port_.peek(port);
    clock_link(in, port, does, words_out());
    core_.clock(core_in(in, does));
    show();
  }

  const Out& out() const { return out_; }
  const FeltgateCore& core() const { return core_of(core_); }
  FeltgateCore& core() { return core_of(core_); }
  /// The block at the register port: the core, or an axis with its engine.
  Device& device() { return core_; }

  /// Queues a byte for the board; run() sends it with the bit timing of the baud rate.
  void send(std::uint8_t byte) { line_.send(byte); }
  std::size_t unsent() const { return line_.unsent(); }
  /// Bytes from the board whose stop bits have ended; empties the list.
  std::vector<std::uint8_t> take_received() { return line_.take_received(); }

  /// Advances `clocks` clocks with the pins held, except uart_rx, which carries the bytes of
  /// send(). It is fast while nothing happens. `on_snapshot()` is called whenever out() holds a
  /// valid snapshot. out()'s `reg_rdata` is unspecified.
  void run(In in, std::int64_t clocks, Callback<> on_snapshot) {
    while (clocks > 0) {
      in.uart_rx = line_.level();
      const std::int64_t quiet = stretch(std::min(quiet_clocks(in), clocks));
      const std::int64_t rest =
          std::min<std::int64_t>(tick_clocks_ - core_.clock_of_tick(), clocks);
      if (quiet < rest && apart(in, rest)) {
        pass_apart(in, static_cast<int>(rest), on_snapshot);
        clocks -= rest;
        continue;
      }
      if (quiet <= 1) {
        line_.clock(out_.uart_tx);
        clock(in);
        if (linked::axis(out_, 0).snapshot_valid) on_snapshot();
        linked::end_pulses(in);
        --clocks;
        continue;
      }
      pass(in, port_.peek(port_in(in)), quiet, on_snapshot);
      skip(quiet);
      show();
      clocks -= quiet;
    }
  }

 private:
  static constexpr bool kAxes = N > 1;
  static constexpr bool kCore = std::is_same_v<Device, FeltgateCore>;
  using Port = LinkPort<N>;
  using Capture = LinkCapture<1 << LinkMap::rows_log2, WithEngine>;
  struct NoView {
    void reset() {}
  };
  using View = std::conditional_t<kAxes, LinkView<N>, NoView>;
  using DeviceIn = std::conditional_t<kCore, CoreIn, AxesIn<N>>;
  struct Event {
    int clock, number;  ///< clock of the tick
  };
  /// What the device gives in a clock: a word of each axis, and an event.
  struct Words {
    std::array<bool, N> valid{};
    std::array<std::uint8_t, N> number{};
    std::array<std::uint32_t, N> data{};
    bool last = false;  ///< last clock of the tick
    bool event_valid = false;
    int event_number = 0;
  };
  /// What stream and capture see of it.
  struct Shown {
    bool valid = false;
    std::uint8_t number = 0;
    std::uint32_t data = 0;
    bool event_valid = false;
    int event_number = 0;
  };
  static constexpr std::uint32_t kFeatures = 1U << LinkMap::B::features_capture |
                                             1U << LinkMap::B::features_stream |
                                             (WithEngine ? 1U : 0U) << LinkMap::B::features_engine |
                                             LinkMap::rows_log2 << LinkMap::B::features_rows_log2 |
                                             LinkMap::columns << LinkMap::B::features_columns;

  typename Port::In port_in(const In& in) const {
    typename Port::In p;
    p.request = receiver_.out().request;
    p.good = receiver_.out().good;
    p.bad = receiver_.out().bad;
    p.clear_faults = in.clear_faults;
    p.inputs = in.inputs;
    p.tick = device_out(0).snapshot_valid;
    p.reg_rdata = core_.out().reg_rdata;
    p.rdata = stream_.out().rdata | capture_.out().rdata;
    if constexpr (kAxes) p.rdata |= view_.out().rdata;
    p.ready = transmitter_.out().reply_ready;
    if constexpr (kCore) {
      p.reg_busy = core_.out().reg_busy;
    } else {
      p.reg_busy = core_.busy(port_.peek(p).reg_addr);
    }
    return p;
  }
  static DeviceIn core_in(const In& in, const typename Port::Out& does) {
    DeviceIn c;
    linked::to_device(in, c);
    c.reg_addr = does.reg_addr;
    c.reg_wdata = does.reg_wdata;
    c.reg_write = does.reg_write;
    return c;
  }

  const CoreOut& device_out(std::size_t n) const {
    if constexpr (kCore) {
      return core_.out();
    } else {
      return core_.out().axis[n];
    }
  }
  std::uint32_t device_word(std::size_t n, int slot) const {
    if constexpr (kCore) {
      return core_.word(slot);
    } else {
      return core_.word(static_cast<int>(n), slot);
    }
  }
  Words words_out() const {
    Words w;
    for (std::size_t n = 0; n < N; ++n) {
      const CoreOut& o = device_out(n);
      w.valid[n] = o.word_valid;
      w.number[n] = linked::number_of(o.word_slot);
      w.data[n] = o.word_data;
    }
    w.last = core_.clock_of_tick() == tick_clocks_ - 1;
    if constexpr (WithEngine) {
      w.event_valid = core_.event_valid();
      w.event_number = core_.event_number();
    }
    return w;
  }
  /// One axis is seen as it is, several through the view.
  Shown shown_words(const Words& words) const {
    if constexpr (kAxes) {
      const auto& o = view_.out();
      return {o.word_valid, o.word_number, o.word_data, o.event_valid, o.event_number};
    } else {
      return {words.valid[0], words.number[0], words.data[0], words.event_valid,
              words.event_number};
    }
  }
  void view_clock(const Words& words, std::uint16_t addr, std::uint32_t wdata, bool write) {
    if constexpr (kAxes) {
      view_.clock({words.valid, words.number, words.data, words.last, words.event_valid,
                   words.event_number, addr, wdata, write});
    }
  }

  /// A clock of the link alone, with what the device gives in it.
  void clock_link(const In& in, const typename Port::In& port, const typename Port::Out& does,
                  const Words& words) {
    const UartRx::Out byte = rx_.out();
    const LinkTransmitter::Out sent = transmitter_.out();
    const FrameByte offered = offer();
    const Shown shown = shown_words(words);
    stream_.clock({shown.valid, shown.number, shown.data, does.addr, does.wdata, does.write,
                   sent.stream_ready});
    capture_.clock({shown.valid, shown.number, shown.data, does.addr, does.wdata, does.write,
                    shown.event_valid, shown.event_number});
    view_clock(words, does.addr, does.wdata, does.write);
    rx_.clock({in.uart_rx});
    receiver_.clock({byte.byte, byte.valid, byte.error, does.taken});
    port_.clock(port);
    transmitter_.clock({does.reply, offered, tx_.out().ready});
    tx_.clock({sent.byte, sent.valid});
  }
  void skip(std::int64_t quiet) {
    line_.skip(quiet);
    rx_.skip(quiet);
    tx_.skip(quiet);
  }

  /// Whether nothing of the link reaches the core in so many clocks: no request is there or comes.
  bool apart(const In& in, std::int64_t clocks) const {
    return !linked::pulses(in) && port_.rests(port_in(in)) && rx_.clocks_to_byte() > clocks;
  }
  /// Such clocks, within a tick: first the core, then the link with the core's words.
  void pass_apart(In in, int clocks, Callback<> on_snapshot) {
    const int from = core_.clock_of_tick(), end = from + clocks;
    run_device(in, port_.peek(port_in(in)), clocks, on_snapshot);
    auto event = events_.cbegin();
    for (int at = from; at < end;) {
      in.uart_rx = line_.level();
      const typename Port::In port = port_in(in);
      const typename Port::Out does = port_.peek(port);
      const auto quiet =
          static_cast<int>(std::min<std::int64_t>(within_tick(at, quiet_clocks(in)), end - at));
      if (quiet <= 1) {
        line_.clock(out_.uart_tx);
        clock_link(in, port, does, words_at(at, &event));
        ++at;
      } else {
        pass_words(does, at, at + quiet, &event);
        skip(quiet);
        at += quiet;
      }
      out_.uart_tx = tx_.out().tx;
    }
    show();
  }

  /// Number of clocks in which the link only counts the phases of its bits.
  std::int64_t quiet_clocks(const In& in) const {
    if (linked::pulses(in) || !receiver_.idle() || !transmitter_.waits()) return 0;
    if (!port_.waits(port_in(in)) || !stream_.waits()) return 0;
    const bool offers = transmitter_.out().valid;
    if (transmitter_.idle() ? port_.reply().valid || stream_.out().valid
                            : offers && tx_.out().ready)
      return 0;
    return std::min({rx_.quiet(in.uart_rx), tx_.quiet(), line_.quiet(out_.uart_tx)});
  }

  FrameByte offer() const { return {stream_.out().valid, stream_.out().byte, stream_.out().last}; }

  static constexpr int kWords = LinkMap::snapshot_words;
  /// Number of the word that each axis gives in a clock of this tick; -1: none.
  void note_words_by_clock() {
    for (std::size_t n = 0; n < N; ++n) {
      const int duty = core_of(core_, n).duty_clock();
      if (noted_[n] == duty) continue;
      noted_[n] = duty;
      given_[n].assign(static_cast<std::size_t>(tick_clocks_), -1);
      for (int k = 0; k < kWords; ++k) {
        const int number = linked::number_of(axis::Snapshot::places[k]);
        given_[n][static_cast<std::size_t>(given_at(n, k))] = static_cast<std::int8_t>(number);
      }
    }
  }
  /// Clock of the tick in which an axis gives its k-th word.
  int given_at(std::size_t n, int k) const {
    using axis::Snapshot;
    const int duty = core_of(core_, n).duty_clock();
    const int begin = duty - axis::TorqueLaw<axis::Fixed>::latency;
    return k < Snapshot::early ? begin + 2 + k : duty + 2 + k - Snapshot::early;
  }
  /// Clock in which stream and capture see the last word of a tick.
  int last_word() const {
    return kAxes ? (LinkView<N>::delay - 1) % tick_clocks_ : given_at(0, kWords - 1);
  }

  /// How many of `quiet` clocks can be passed at once: the rest of a tick, or whole ticks of which
  /// stream and capture need only the last; never past the last word of a frame.
  std::int64_t stretch(std::int64_t quiet) const {
    const int at = core_.clock_of_tick();
    if (!kAxes && at == 0 && quiet >= tick_clocks_ && !stream_.on() && !capture_.runs()) {
      return quiet / tick_clocks_ * tick_clocks_;
    }
    return within_tick(at, quiet);
  }
  /// Not past the tick's end, nor past the last word of a frame.
  std::int64_t within_tick(int at, std::int64_t quiet) const {
    const bool keeps = stream_.keeps() && at <= last_word();
    return std::min<std::int64_t>(quiet, keeps ? last_word() - at : tick_clocks_ - at);
  }

  /// Passes a stretch of quiet clocks; of several ticks the last one's words count.
  void pass(const In& in, const typename Port::Out& port, std::int64_t clocks,
            Callback<> on_snapshot) {
    const int from = core_.clock_of_tick();
    run_device(in, port, clocks, on_snapshot);
    auto event = events_.cbegin();
    pass_words(port, from, static_cast<int>(from + std::min<std::int64_t>(clocks, tick_clocks_)),
               &event);
  }
  void run_device(const In& in, const typename Port::Out& port, std::int64_t clocks,
                  Callback<> on_snapshot) {
    const int from = core_.clock_of_tick();
    note_words_by_clock();
    const auto at_snapshot = [&] {
      show();
      on_snapshot();
    };
    events_.clear();
    if constexpr (kCore) {
      core_.run(core_in(in, port), clocks, at_snapshot);
    } else {
      DeviceIn pins = core_in(in, port);
      // Nobody takes the word at an idle port's address. An engine that is read goes clock by
      // clock.
      if (port_.rests(port_in(in))) pins.reg_addr = Map::C::read_status;
      core_.run(pins, clocks, at_snapshot, [&](std::int64_t clock, int number) {
        if (kAxes || capture_.runs()) events_.push_back({from + static_cast<int>(clock), number});
      });
    }
  }
  using NextEvent = typename std::vector<Event>::const_iterator;
  /// What the device has given in a clock of the tick that it has passed. `event` is the first that
  /// was not given before this clock.
  Words words_at(int at, NextEvent* event) const {
    Words words;
    for (std::size_t n = 0; n < N; ++n) {
      const int k = given_[n][static_cast<std::size_t>(at)];
      words.valid[n] = k >= 0;
      if (k < 0) continue;
      words.number[n] = static_cast<std::uint8_t>(k);
      words.data[n] = device_word(n, LinkMap::slots[k]);
    }
    words.last = at == tick_clocks_ - 1;
    if (*event != events_.cend() && (*event)->clock == at) {
      words.event_valid = true;
      words.event_number = (*event)++->number;
    }
    return words;
  }
  /// Quiet clocks of stream, capture and view.
  void pass_words(const typename Port::Out& port, int from, int to, NextEvent* event) {
    bool showed = true;
    for (int at = from; at < to; ++at) {
      const Words words = words_at(at, event);
      const Shown shown = shown_words(words);
      if (shown.valid || shown.event_valid || showed || at < from + 3 || at >= to - 3) {
        stream_.clock({shown.valid, shown.number, shown.data, port.addr, 0, false, false});
        capture_.clock({shown.valid, shown.number, shown.data, port.addr, 0, false,
                        shown.event_valid, shown.event_number});
      }
      showed = shown.valid;
      view_clock(words, port.addr, 0, false);
    }
  }

  static FeltgateCore& core_of(FeltgateCore& core, std::size_t = 0) { return core; }
  static const FeltgateCore& core_of(const FeltgateCore& core, std::size_t = 0) { return core; }
  template <class Axes>
  static auto& core_of(Axes& axes, std::size_t n = 0) {
    return axes.core(static_cast<int>(n));
  }

  void show() {
    if constexpr (kAxes) {
      out_.axis = core_.out().axis;
    } else {
      out_.core = device_out(0);
      out_.core.reg_rdata = core_.out().reg_rdata;
    }
    out_.uart_tx = tx_.out().tx;
  }

  Device core_;
  UartRx rx_;
  LinkReceiver receiver_;
  Port port_;
  LinkStream stream_;
  Capture capture_;
  View view_;  ///< of several axes
  LinkTransmitter transmitter_;
  UartTx tx_;
  UartLine line_;
  Out out_;
  int tick_clocks_;
  std::vector<Event> events_;  ///< of a stretch, while a capture runs
  std::array<std::vector<std::int8_t>, N> given_;
  std::array<int, N> noted_{};  ///< clock of the duty for which they hold
};

}  // namespace feltgate

#ifdef FELTGATE_COMPILED_TWIN
#include "feltgate/compiled_linked.hpp"  // IWYU pragma: export
#endif
