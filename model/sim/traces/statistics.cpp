// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Counts what a perfect x4 decoder must find. Documentation: docs/traces.md
#include "sim/traces/statistics.hpp"

namespace feltgate::traces {

void StepCounter::add(const EncoderEvent& event) {
  const EncoderPins was = pins_;
  pins_ = event.pins;
  const bool a_moved = was.a != pins_.a;
  const bool b_moved = was.b != pins_.b;
  if (!a_moved && !b_moved) return;
  ++result_.steps;
  const Clock spacing = event.clock - last_;
  if (moved_ && spacing < result_.shortest_edge_spacing.value_or(spacing + 1)) {
    result_.shortest_edge_spacing = spacing;
  }
  moved_ = true;
  last_ = event.clock;
  if (a_moved && b_moved) {
    ++result_.illegal;
    return;
  }
  // Counting up B leads: B moves away from A, or A follows B.
  const bool up = b_moved ? pins_.a != pins_.b : pins_.a == pins_.b;
  const int direction = up ? 1 : -1;
  if (direction_ == -direction) ++result_.reversals;
  direction_ = direction;
  result_.position += direction;
}

Statistics count_steps(EncoderSource& source) {
  StepCounter counter(source.initial());
  while (const auto event = source.next()) counter.add(*event);
  Statistics result = counter.result();
  result.length = source.length();
  return result;
}

}  // namespace feltgate::traces
