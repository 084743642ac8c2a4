// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's input from the world: levels of the encoder pins on an integer clock.
// Documentation: docs/architecture.md
#pragma once

#include <cstdint>
#include <optional>

namespace feltgate {

/// Time in periods of the FPGA clock since reset; an integer, so that it does not drift.
using Clock = std::int64_t;

/// Levels at the three encoder pins.
struct EncoderPins {
  bool a = false;
  bool b = false;
  bool z = false;
  constexpr bool operator==(const EncoderPins& o) const { return a == o.a && b == o.b && z == o.z; }
  constexpr bool operator!=(const EncoderPins& o) const { return !(*this == o); }
};

/// A change at the pins: they take these levels at `clock` and keep them until the next event.
struct EncoderEvent {
  Clock clock = 0;
  EncoderPins pins;
};

/// A stream of pin changes in order of time; its memory use does not grow with its length.
class EncoderSource {
 public:
  virtual ~EncoderSource() = default;
  /// Levels before the first event (clock 0).
  virtual EncoderPins initial() const = 0;
  /// The next change, strictly later than the one before; nothing at the end.
  virtual std::optional<EncoderEvent> next() = 0;
  /// Length of the recording in clocks; known only after next() has returned nothing.
  virtual Clock length() const = 0;
};

}  // namespace feltgate
