// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A capture from setting to reading, in lock-step: ticks of 28 clocks, writes in any of them, then
// all is read back from the RTL. Documentation: docs/link.md
#pragma once

#include <Vlink_capture.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "../link/tick_words.hpp"
#include "catch.hpp"
#include "feltgate/link_capture.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

namespace feltgate::test {

constexpr int kRows = ROWS;
constexpr bool kEvents = EVENTS != 0;
constexpr int kTickClocks = 28;  ///< word k is in clock 2 k + 2
constexpr int kLastWordClock = 24;

using CaptureTwin = LinkCapture<kRows, kEvents>;
using A = LinkMap::A;
using N = LinkMap::N;
constexpr std::uint32_t kStart = 1u << LinkMap::B::capture_control_start;
constexpr std::uint32_t kAbort = 1u << LinkMap::B::capture_control_abort;
constexpr std::uint32_t kTrigger = 1u << LinkMap::B::capture_control_trigger;

struct CaptureAdapter {
  static void drive(Vlink_capture& rtl, const CaptureTwin::In& in) {
    FELTGATE_DRIVE(rtl, in, word_valid, word_slot, word_data, addr, wdata, write, event_valid);
    rtl.event_number_i = static_cast<std::uint16_t>(in.event_number);
  }
  template <class Check>
  static void compare(Check& check, const Vlink_capture& rtl, const CaptureTwin::Out& out) {
    check("rdata", rtl.rdata_o, out.rdata);
  }
};
using CaptureBench = LockStep<Vlink_capture, CaptureTwin, CaptureAdapter>;

using Content = std::function<std::uint32_t(std::uint32_t tick, int k)>;

/// What can be read when it is over.
struct Captured {
  std::uint32_t state = 0, first = 0, rows = 0;
  std::vector<std::array<std::uint32_t, 8>> ring;  ///< oldest first
};

class CaptureSession {
 public:
  explicit CaptureSession(std::size_t ticks, const Content& content = tick_word)
      : list_(kLead + ticks * kTickClocks), content_(content) {
    for (std::size_t t = 0; t < ticks; ++t) {
      for (int k = 0; k < LinkMap::snapshot_words; ++k) {
        auto& in = list_[kLead + t * kTickClocks + 2 * static_cast<std::size_t>(k) + 2];
        in.word_valid = true;
        in.word_slot = static_cast<std::uint8_t>(LinkMap::slots[k]);
        in.word_data = content(static_cast<std::uint32_t>(t), k);
      }
    }
  }

  /// Before the first tick.
  CaptureSession& set(std::uint16_t addr, std::uint32_t data) {
    write(list_.at(lead_++), addr, data);
    return *this;
  }
  CaptureSession& trigger(int word, int mode, std::uint32_t level) {
    return set(A::trigger_word, static_cast<std::uint32_t>(word))
        .set(A::trigger_mode, static_cast<std::uint32_t>(mode))
        .set(A::trigger_level, level);
  }
  CaptureSession& at(std::size_t tick, int clock, std::uint16_t addr, std::uint32_t data) {
    write(list_.at(kLead + tick * kTickClocks + static_cast<std::size_t>(clock)), addr, data);
    return *this;
  }
  CaptureSession& event(std::size_t tick, int clock, int number) {
    auto& in = list_.at(kLead + tick * kTickClocks + static_cast<std::size_t>(clock));
    in.event_valid = true;
    in.event_number = number;
    return *this;
  }

  Captured play() {
    const std::size_t begin = list_.size();
    read(A::capture_state), read(A::capture_first), read(A::capture_rows);
    for (int at = 0; at < kRows * 8; ++at) {
      read(static_cast<std::uint16_t>(LinkMap::memory + static_cast<unsigned>(at)));
    }
    list_.resize(list_.size() + 4);
    std::vector<std::uint32_t> seen;
    const auto keep = [&seen](const CaptureTwin::In&, const Vlink_capture& rtl, const CaptureTwin&,
                              bool) -> const char* {
      seen.push_back(rtl.rdata_o);
      return nullptr;
    };
    const auto stimulus = [this](std::int64_t clock) {
      const std::int64_t k = clock - CaptureBench::kFirstReset;
      return k < 0 ? CaptureTwin::In{} : list_[static_cast<std::size_t>(k)];
    };
    CaptureBench bench("link_capture", 1);
    bench.run(stimulus, static_cast<std::int64_t>(list_.size()) + CaptureBench::kFirstReset, {},
              keep);
    // Three clocks from an address to its word; the observer sees what is there after the edge.
    const auto word = [&](std::size_t n) {
      return seen.at(begin + n + 2 + static_cast<std::size_t>(CaptureBench::kFirstReset));
    };
    Captured c{word(0), word(1), word(2), {}};
    for (std::uint32_t n = 0; n < kRows; ++n) {
      const std::size_t row = (c.first + n) % kRows;
      std::array<std::uint32_t, 8> words{};
      for (std::size_t k = 0; k < 8; ++k) words[k] = word(3 + row * 8 + k);
      if (n < c.rows) {
        c.ring.push_back(words);
      } else {
        for (const std::uint32_t w : words) REQUIRE(w == 0);
      }
    }
    return c;
  }

  /// The rows are those of the ticks from `first` on, `period` apart; what no word is in is 0.
  void check(const Captured& c, std::uint32_t mask, std::uint32_t first, std::uint32_t period = 1) {
    for (std::size_t n = 0; n < c.ring.size(); ++n) {
      const auto tick = first + static_cast<std::uint32_t>(n) * period;
      std::array<std::uint32_t, 8> wanted{};
      std::size_t column = 0;
      for (int k = 0; k < LinkMap::snapshot_words && column < 8; ++k) {
        if ((mask >> k & 1u) != 0) wanted[column++] = content_(tick, k);
      }
      INFO("row " << n << " of " << c.ring.size() << ", tick " << tick);
      REQUIRE(c.ring[n] == wanted);
    }
  }

 private:
  static constexpr std::size_t kLead = 12;
  static void write(CaptureTwin::In& in, std::uint16_t addr, std::uint32_t data) {
    in.addr = addr;
    in.wdata = data;
    in.write = true;
  }
  void read(std::uint16_t addr) {
    CaptureTwin::In in;
    in.addr = addr;
    list_.push_back(in);
  }
  std::vector<CaptureTwin::In> list_;
  std::size_t lead_ = 0;
  Content content_;
};

constexpr auto kDone = static_cast<std::uint32_t>(CaptureTwin::State::done);
constexpr auto kWaits = static_cast<std::uint32_t>(CaptureTwin::State::wait);
constexpr auto kIdle = static_cast<std::uint32_t>(CaptureTwin::State::idle);
constexpr std::uint32_t kTick = 1u << N::tick;

/// The word k is `value(tick)`, the others are as they are.
template <class Value>
Content with(int word, const Value& value) {
  return [word, value](std::uint32_t tick, int k) {
    return k == word ? static_cast<std::uint32_t>(value(tick)) : tick_word(tick, k);
  };
}
/// Below zero before the tick, above from it on.
inline Content rises_in(std::uint32_t tick, int word = N::position) {
  return with(
      word, [tick](std::uint32_t t) { return (static_cast<std::int32_t>(t - tick) + 1) * 5 - 3; });
}

struct Plan {
  std::uint32_t mask = kTick | 1u << N::position, pre = 3, period = 0;
};
inline CaptureSession session(const Plan& plan, std::size_t ticks, const Content& content) {
  CaptureSession s(ticks, content);
  s.set(A::capture_words, plan.mask)
      .set(A::capture_pre, plan.pre)
      .set(A::capture_period, plan.period);
  return s;
}

}  // namespace feltgate::test
