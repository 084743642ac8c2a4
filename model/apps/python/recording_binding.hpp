// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Python interface of encoder edges in memory. Documentation: docs/python.md
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "apps/python/arrays.hpp"
#include "feltgate/encoder_source.hpp"

namespace feltgate::traces {

/// The pins before the first edge, the edges in order of time, and where it ends.
struct Edges {
  EncoderPins initial;
  std::vector<EncoderEvent> events;
  Clock length = 0;  ///< clocks
};

/// Reads `edges`, which must outlive it, from the start.
class MemorySource final : public EncoderSource {
 public:
  explicit MemorySource(const Edges& edges) : edges_(edges) {}
  EncoderPins initial() const override { return edges_.initial; }
  std::optional<EncoderEvent> next() override {
    if (next_ == edges_.events.size()) return std::nullopt;
    return edges_.events[next_++];
  }
  Clock length() const override { return edges_.length; }

 private:
  const Edges& edges_;
  std::size_t next_ = 0;
};

/// `source` to its end.
inline Edges read_all(EncoderSource& source) {
  Edges edges;
  edges.initial = source.initial();
  while (const auto event = source.next()) edges.events.push_back(*event);
  edges.length = source.length();
  return edges;
}

}  // namespace feltgate::traces

namespace feltgate::python {

struct PyRecording {
  std::string name;
  std::int64_t clock_hz = 0;
  traces::Edges edges;
  std::vector<std::string> warnings;
};

}  // namespace feltgate::python
