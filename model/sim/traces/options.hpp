// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How to read a recording: which signals, which clock, which rule of time.
// Documentation: docs/traces.md
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "feltgate/encoder_source.hpp"

namespace feltgate::traces {

/// File formats; `detect` looks at the content first and at the suffix second.
enum class FileFormat { detect, sigrok, vcd, saleae, levels, columns, vector };

struct Options {
  /// Names of A, B and perhaps Z; empty: guessed (see guess_probes in traces/capture.hpp).
  std::vector<std::string> probes;
  /// Names of the STEP and DIR signals; both or none.
  std::string step;
  std::string dir;
  /// Names of the columns of a table; empty: guessed from usual names.
  std::string time_column;
  std::string count_column;
  /// Unit of the time column: s, ms, us or ns; empty: as its name says, else s.
  std::string time_unit;
  /// Counts per unit of the count column, not 0 (for radians lines * 4 / 2pi); absent: 1.
  std::optional<double> scale;
  /// The count column begins again after so many of its units: 360, 2pi, 65536; 0: its first jump
  /// tells; absent: it goes on.
  std::optional<double> wrap;
  /// Counts of a turn of the encoder, to tell a jump by one; 0: unknown.
  double turn_counts = 0;
  /// FPGA clock in Hz, 1 to 1e12.
  std::int64_t clock_hz = 50'000'000;
  /// Rate in Hz at which a .sr, a VCD or a table was sampled; 0: as the file itself says. The rows
  /// of a table without a time column are samples.
  std::int64_t sample_hz = 0;
  /// Edges at a seeded uniform offset inside their sample (true) or at its start (false).
  bool jitter = true;
  std::uint64_t seed = 1;
  FileFormat format = FileFormat::detect;
  /// Is told, once for each kind, what can be read and is hardly meant; absent: nobody is.
  std::function<void(const std::string&)> warn;
};

/// "A,B" or "A,B,Z" as a list of names; spaces round a name are dropped.
std::vector<std::string> split_names(const std::string& text);

/// A scale: a number, or a quotient such as `2048/2pi` (counts per radian) or `4096/360`.
/// Throws TraceError when it is not a finite number other than 0.
double parse_scale(const std::string& text);

/// A wrap: a number or a product such as `2pi`; empty: 0, which is told by the first jump. Throws
/// TraceError when it is not a finite number above 0.
double parse_wrap(const std::string& text);

/// The format's name on the command line and back; an unknown name throws TraceError.
const char* name_of(FileFormat format);
FileFormat parse_format(const std::string& name);

// The four states of a quadrature pair: counting up, B leads A (00, 01, 11, 10 as AB).

/// Pins at a phase; only its last two bits count, so that any position will do.
constexpr EncoderPins pins_at(unsigned phase) {
  const bool a = (phase & 2U) != 0;
  return {a, ((phase & 1U) != 0) != a, false};
}

}  // namespace feltgate::traces
