// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What waits for its clock in front of a back-end: register writes and pin events.
// Documentation: docs/architecture.md
#pragma once

#include <cstdint>
#include <deque>
#include <utility>

#include "feltgate/core_ports.hpp"
#include "feltgate/encoder_source.hpp"

namespace feltgate {

/// Queue of register writes; one is issued in an early clock of each tick.
class WriteQueue {
 public:
  void clear() { writes_.clear(); }
  void push(int address, std::uint32_t data) {
    writes_.emplace_back(static_cast<std::uint16_t>(address), data);
  }
  bool empty() const { return writes_.empty(); }
  std::pair<std::uint16_t, std::uint32_t> pop() {
    const auto w = writes_.front();
    writes_.pop_front();
    return w;
  }

 private:
  std::deque<std::pair<std::uint16_t, std::uint32_t>> writes_;
};

/// Queue of future encoder events.
class EventQueue {
 public:
  void reset(EncoderPins pins) {
    pins_ = pins;
    events_.clear();
  }
  void push(const EncoderEvent* first, const EncoderEvent* last) {
    events_.insert(events_.end(), first, last);
  }
  /// Pins in the clock `now`.
  const EncoderPins& at(Clock now) {
    while (!events_.empty() && events_.front().clock <= now) {
      pins_ = events_.front().pins;
      events_.pop_front();
    }
    return pins_;
  }
  const EncoderPins& pins() const { return pins_; }
  /// Clock of the next event; `none` if there is none.
  Clock next(Clock none) const { return events_.empty() ? none : events_.front().clock; }

 private:
  EncoderPins pins_;
  std::deque<EncoderEvent> events_;
};

}  // namespace feltgate
