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

#include "feltgate/encoder_source.hpp"
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

// Computes the counts that a perfect x4 decoder must find in a stream of pins. The program is
// independent of the decoder.

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
