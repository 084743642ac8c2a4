// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A recording of named logic levels, independent of encoders and clocks; each file format of levels
// implements it. Documentation: docs/traces.md
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "place.hpp"

namespace feltgate::traces {

/// The chosen levels of a sample that differ from the sample before, bit n = n-th chosen channel.
/// The sample covers [begin, end) in units of the recording; begin may equal end (no width known).
struct Change {
  std::int64_t begin = 0;
  std::int64_t end = 0;
  std::uint32_t levels = 0;
};

/// A stream of level changes; memory does not grow with its length. Every call may throw
/// TraceError.
class Capture {
 public:
  virtual ~Capture() = default;
  virtual const std::vector<std::string>& channels() const = 0;
  virtual TimeBase time_base() const = 0;
  /// Chooses the channels that next() reports (at most 32) and returns their first sample; once.
  virtual std::uint32_t start(const std::vector<std::size_t>& chosen) = 0;
  /// The next change; `begin` never goes back.
  virtual std::optional<Change> next() = 0;
  /// Length in units, known once next() has returned nothing.
  virtual std::int64_t end() const = 0;
  /// File and position read last, for messages.
  virtual std::string where() const = 0;
};

/// Index of a name: exact, else without regard to case, else as the last part of a path of scopes.
/// Throws TraceError that lists the channels when there is none or more than one.
std::size_t find_channel(const std::vector<std::string>& channels, const std::string& name,
                         const std::string& where);

/// Pairs of channels named alike but for a last letter A and B (`A`,`B`; `enc_a`,`enc_b`;
/// `XA`,`XB`).
std::vector<std::vector<std::string>> quadrature_pairs(const std::vector<std::string>& channels);

/// The probes when none are named: the only quadrature pair, with a Z or index channel if there is
/// one; else all channels of a recording that has just two or three. Throws TraceError otherwise.
std::vector<std::string> guess_probes(const std::vector<std::string>& channels,
                                      const std::string& where);

}  // namespace feltgate::traces
