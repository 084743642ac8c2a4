// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the counts that a perfect x4 decoder must find in a stream of pins. The program is
// independent of the decoder. Documentation: docs/traces.md
#pragma once

#include <cstdint>
#include <optional>

#include "feltgate/encoder_source.hpp"

namespace feltgate::traces {

struct Statistics {
  std::int64_t steps = 0;      ///< changes of the state of A and B, illegal ones included
  std::int64_t illegal = 0;    ///< of these: both channels at the same clock
  std::int64_t reversals = 0;  ///< changes of direction from a legal step to the next legal one
  std::int64_t position = 0;   ///< counts from the start; illegal steps leave it
  std::optional<Clock> shortest_edge_spacing;  ///< clocks between two steps; absent below two steps
  Clock length = 0;                            ///< clocks
};

/// Fed event by event, for use beside a simulation.
class StepCounter {
 public:
  explicit StepCounter(const EncoderPins& initial) : pins_(initial) {}
  void add(const EncoderEvent& event);
  const Statistics& result() const { return result_; }

 private:
  EncoderPins pins_;
  Statistics result_;
  bool moved_ = false;
  Clock last_ = 0;  ///< clock of the last step, once there was one
  int direction_ = 0;
};

/// Reads the source to its end.
Statistics count_steps(EncoderSource& source);

}  // namespace feltgate::traces
