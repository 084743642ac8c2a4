// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The encoder's pins as a broken wire or a pulse makes them, and the core's twin behind them.
// Documentation: docs/testing.md
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "campaigns/faults/outcome.hpp"
#include "campaigns/faults/world.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"

namespace feltgate::faults {

using D = Lever;

inline constexpr int kTick = D::clocks_per_tick;

/// A level that is wrong for a while: A, B, Z by bit.
struct Pulse {
  Clock from, to;
  unsigned channels;
};

/// What is done to the pins, from a clock on.
struct Break {
  enum class Kind { none, levels, shorted_a, shorted_b, shorted_and, shorted_or, swapped, index };
  Kind kind = Kind::none;
  Clock from = 0;
  unsigned stuck = 0, high = 0;  ///< levels: channels that stand, and where
  bool held = false;             ///< they stand where they were
  int index_shift = 0;           ///< index: clocks that Z comes late; 0: never
  std::vector<Pulse> pulses;     ///< in order
};

/// The pins as the core sees them, event by event.
class BrokenPins {
 public:
  BrokenPins(Break how, EncoderPins now) : how_(std::move(how)), true_(now) {}

  /// Events of the stretch (begin, end], from the true ones.
  const std::vector<EncoderEvent>& take(const std::vector<EncoderEvent>& events, Clock begin,
                                        Clock end) {
    out_.clear();
    std::size_t next = 0;
    for (Clock at = begin + 1; at <= end; ++at) {
      // Only clocks in which something changes.
      Clock soon = end + 1;
      if (next < events.size()) soon = std::min(soon, events[next].clock);
      for (std::size_t p = pulse_; p < how_.pulses.size() && how_.pulses[p].from <= soon; ++p) {
        if (how_.pulses[p].from >= at) soon = std::min(soon, how_.pulses[p].from);
        if (how_.pulses[p].to >= at) soon = std::min(soon, how_.pulses[p].to);
      }
      if (how_.from >= at) soon = std::min(soon, how_.from);
      at = soon;
      if (at > end) break;
      if (at == how_.from) held_ = true_;
      while (next < events.size() && events[next].clock <= at) true_ = events[next++].pins;
      while (pulse_ < how_.pulses.size() && how_.pulses[pulse_].to <= at) ++pulse_;
      out_.push_back({at, seen(at)});
    }
    return out_;
  }

 private:
  EncoderPins seen(Clock at) const {
    EncoderPins p = true_;
    if (at >= how_.from) {
      using K = Break::Kind;
      const auto level = [this](unsigned bit, bool now, bool before) {
        if ((how_.stuck & bit) == 0) return now;
        return how_.held ? before : (how_.high & bit) != 0;
      };
      if (how_.kind == K::levels) {
        p.a = level(1, p.a, held_.a);
        p.b = level(2, p.b, held_.b);
        p.z = level(4, p.z, held_.z);
      }
      if (how_.kind == K::shorted_a) p.b = p.a;
      if (how_.kind == K::shorted_b) p.a = p.b;
      if (how_.kind == K::shorted_and) p.a = p.b = p.a && p.b;
      if (how_.kind == K::shorted_or) p.a = p.b = p.a || p.b;
      if (how_.kind == K::swapped) std::swap(p.a, p.b);
    }
    for (std::size_t k = pulse_; k < how_.pulses.size() && how_.pulses[k].from <= at; ++k) {
      if (how_.pulses[k].to <= at) continue;
      p.a ^= (how_.pulses[k].channels & 1u) != 0;
      p.b ^= (how_.pulses[k].channels & 2u) != 0;
      p.z ^= (how_.pulses[k].channels & 4u) != 0;
    }
    return p;
  }

  Break how_;
  EncoderPins true_, held_{};
  std::size_t pulse_ = 0;
  std::vector<EncoderEvent> out_;
};

/// The core's twin with its pins, panel and host.
class Device {
 public:
  FeltgateCore<D> core;
  CoreIn in;

  /// A tick's clocks; a write is taken in its fifth.
  GateTimes tick(const std::vector<EncoderEvent>& events, Clock begin, std::optional<Word> write,
                 bool stop) {
    const auto before = core.gate_clocks();
    Clock at = begin;
    std::size_t next = 0;
    const auto to = [&](Clock end) {
      while (at < end) {
        while (next < events.size() && events[next].clock <= at) in.encoder = events[next++].pins;
        const Clock until = next < events.size() ? std::min(end, events[next].clock) : end;
        core.run(in, until - at, [] {});
        at = until;
      }
    };
    if (write || stop) {
      to(begin + host_write_clock);
      while (next < events.size() && events[next].clock <= at) in.encoder = events[next++].pins;
      if (write) {
        in.reg_addr = static_cast<std::uint16_t>(write->address);
        in.reg_wdata = write->data;
        in.reg_write = true;
      }
      in.stop = stop;
      core.clock(in);
      in.reg_write = in.stop = false;
      ++at;
    }
    to(begin + kTick);
    while (next < events.size())
      in.encoder = events[next++].pins;  // of the next tick's first clock
    const auto after = core.gate_clocks();
    GateTimes g{static_cast<int>(after[0] - before[0]), static_cast<int>(after[1] - before[1]),
                static_cast<int>(after[2] - before[2]), static_cast<int>(after[3] - before[3]), 0};
    // More on-time than there are clocks: both were on. Less would not show; the legs are proven.
    g.both = std::max({0, g.a_hi + g.a_lo - kTick, g.b_hi + g.b_lo - kTick});
    return g;
  }
};

}  // namespace feltgate::faults
