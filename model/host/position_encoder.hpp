// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Converts positions of ticks back to an encoder's edges, for recordings that `replay` reads.
// Documentation: docs/host.md
#pragma once

#include <cstdint>
#include <vector>

#include "feltgate/encoder_source.hpp"
#include "host/host_device.hpp"

namespace feltgate::host {

/// The position of a tick.
struct PositionAt {
  std::int64_t tick = 0;  ///< ticks since the first one, ascending
  std::int32_t count = 0;
};

/// An encoder that gives these positions: edges of A and B at clocks of the board, such that the
/// core sees each position in its tick again; the first position becomes 0. Edges between two
/// positions are evenly spaced, since their real times are unknown. Z stays low: it is not among
/// the words of a tick.
class PositionEncoder final : public EncoderSource {
 public:
  /// `design` gives the clocks of a tick, the glitch filter and the encoder's polarity. Errors:
  /// std::invalid_argument if ticks do not rise, or if the position moves by more counts than a
  /// decoder can see in that time.
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
