// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Combines and changes sources: in sequence, cut off, with contact bounce, with an index pulse.
// Documentation: docs/traces.md
#pragma once

#include <cstdint>
#include <vector>

#include "synthetic.hpp"

namespace feltgate::traces::synthetic {

/// The given events, at clocks that rise strictly from 1 on; length past the last one.
Source from_events(EncoderPins initial, std::vector<EncoderEvent> events, Clock length);

/// One after the other; each later one goes on from the phase that the one before left, its Z as
/// it is. Throws std::invalid_argument for an empty list.
Source sequence(std::vector<Source> parts);

/// The first `clocks` clocks (at least 1) of a source.
Source cut(Source source, Clock clocks);

/// Each edge of A or B toggles up to `most_toggles` times there and back before it stays, 1 to
/// `most_spacing` clocks apart, as far as there is room before the next event. Counts and illegal
/// steps of the source are kept; its steps and reversals grow.
Source with_bounce(Source source, std::uint64_t seed, int most_toggles, Clock most_spacing);

/// Z is high wherever the position, 0 at the start, is a multiple of counts_per_turn (at least 1).
Source with_index(Source source, std::int64_t counts_per_turn);

}  // namespace feltgate::traces::synthetic
