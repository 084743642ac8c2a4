// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The motion of an encoder that a test makes move by move. Documentation: docs/traces.md
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "feltgate/encoder_source.hpp"
#include "sim/traces/options.hpp"

namespace feltgate::test {

/// A motion that begins at A = B = 0, move by move: +1 or -1 count; 2: both channels at once, which
/// is illegal.
class Moves : public EncoderSource {
 public:
  void move(Clock wait, int turn) {
    clock_ += wait;
    phase_ += static_cast<unsigned>(turn);
    events_.push_back({clock_, traces::pins_at(phase_)});
  }
  EncoderPins initial() const override { return {}; }
  std::optional<EncoderEvent> next() override {
    if (at_ == events_.size()) return std::nullopt;
    return events_[at_++];
  }
  Clock length() const override { return clock_ + 1; }

 private:
  std::vector<EncoderEvent> events_;
  std::size_t at_ = 0;
  Clock clock_ = 0;
  unsigned phase_ = 0;
};

}  // namespace feltgate::test
