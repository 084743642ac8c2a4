// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Converts positions of ticks back to encoder edges. Documentation: docs/host.md
#include "host/position_encoder.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

#include "sim/traces/options.hpp"

namespace feltgate::host {

namespace {

/// taken_after: clock of a tick after which the decoder's count certainly belongs to it.
/// decoder_clocks: most clocks from an edge at the pin to the position, without the filter's
/// samples.
constexpr Clock taken_after = 4, decoder_clocks = 5;

}  // namespace

PositionEncoder::PositionEncoder(const design::Design& design,
                                 const std::vector<PositionAt>& positions) {
  const Clock per_tick = design.clocks_per_tick();
  const Clock late = decoder_clocks + design.filter_samples;
  const int up = design.encoder_polarity == 0 ? 1 : -1;
  if (positions.empty()) throw std::invalid_argument("no positions were recorded");
  // The phase of the pins; an encoder with swapped channels counts the other way.
  std::int64_t phase = std::int64_t{positions.front().count} * up;
  initial_ = traces::pins_at(static_cast<unsigned>(phase & 3));
  for (std::size_t n = 1; n < positions.size(); ++n) {
    const PositionAt &from = positions[n - 1], &to = positions[n];
    if (to.tick <= from.tick) {
      throw std::invalid_argument(fmt::format(
          "the ticks of row {} and the one before do not rise; was the board reset?", n));
    }
    // The position wraps, a difference does not.
    const auto moved = static_cast<std::int32_t>(static_cast<std::uint32_t>(to.count) -
                                                 static_cast<std::uint32_t>(from.count));
    const std::int64_t edges = std::llabs(moved);
    const Clock begin = from.tick * per_tick + taken_after;
    const Clock room = to.tick * per_tick - late - begin;
    if (edges > room) {
      throw std::invalid_argument(
          fmt::format("row {}: {} counts in {} ticks are more than a decoder sees", n, edges,
                      to.tick - from.tick));
    }
    for (std::int64_t k = 0; k < edges; ++k) {
      phase += moved > 0 ? up : -up;
      events_.push_back(
          {begin + room * k / edges, traces::pins_at(static_cast<unsigned>(phase & 3))});
    }
  }
  length_ = (positions.back().tick + 1) * per_tick;
}

std::optional<EncoderEvent> PositionEncoder::next() {
  if (given_ == events_.size()) return {};
  return events_[given_++];
}

}  // namespace feltgate::host
