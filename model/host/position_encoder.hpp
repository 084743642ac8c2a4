// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Positions of ticks back into an encoder's edges, for recordings that `replay` takes.
// Documentation: docs/host.md
#pragma once

#include <cstdint>
#include <vector>

#include "feltgate/encoder_source.hpp"
#include "host/device.hpp"

namespace feltgate::host {

/// The position of a tick.
struct PositionAt {
  std::int64_t tick = 0;  ///< since the first one, rising
  std::int32_t count = 0;
};

/// The encoder that would have made these positions: A and B at clocks of the board, so that the
/// core sees each position in its tick again, the first one as 0. Between two positions the edges
/// are spread evenly: when they really came is not known. Z is not among the words of a tick: low.
class PositionEncoder final : public EncoderSource {
 public:
  /// `design` gives the clocks of a tick, the glitch filter and the encoder's polarity. Throws
  /// std::invalid_argument where ticks do not rise, or where the position moves by more counts
  /// than a decoder can see in that time.
  PositionEncoder(const design::Design& design, const std::vector<PositionAt>& positions);
  EncoderPins initial() const override { return initial_; }
  std::optional<EncoderEvent> next() override;
  Clock length() const override { return length_; }

 private:
  std::vector<EncoderEvent> events_;
  std::size_t given_ = 0;
  EncoderPins initial_;
  Clock length_ = 0;
};

}  // namespace feltgate::host
