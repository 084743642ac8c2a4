// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate's own recordings of encoder pins: a text of one line per change, exact in clocks.
// Documentation: docs/traces.md
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "feltgate/encoder_source.hpp"
#include "traces/capture.hpp"
#include "traces/text.hpp"

namespace feltgate::traces {

/// First line: `feltgate-vector 1 design=lever clock_hz=50000000 signals=A,B,Z`.
struct VectorHeader {
  static constexpr int kSchema = 1;
  std::string design;                  ///< letters, digits, `_`, `-`, `.`
  std::int64_t clock_hz = 50'000'000;  ///< 1 to 1e12
  std::vector<std::string> signals = {"A", "B", "Z"};
};

/// Reads lines `clock A B Z`, the first at clock 0, and the last line `end LENGTH`.
class VectorCapture final : public Capture {
 public:
  explicit VectorCapture(const std::filesystem::path& path);

  const VectorHeader& header() const { return header_; }
  const std::vector<std::string>& channels() const override { return header_.signals; }
  TimeBase time_base() const override { return {1, header_.clock_hz}; }
  std::uint32_t start(const std::vector<std::size_t>& chosen) override;
  std::optional<Change> next() override;
  std::int64_t end() const override { return clock_; }
  std::string where() const override { return in_.where(); }

 private:
  void read_header();
  std::vector<std::string_view> words();
  bool read_change();
  std::int64_t clock_of(std::string_view word) const;

  ByteReader in_;
  VectorHeader header_;
  std::string line_;
  std::vector<std::size_t> chosen_;
  std::int64_t clock_ = -1;
  std::uint32_t levels_ = 0;
  bool ended_ = false;
};

/// Writes such a file beside its final name and renames it in finish(): a reader never sees a part.
/// Every call throws TraceError when the disk or the caller (events out of order) is at fault.
class VectorWriter {
 public:
  VectorWriter(const std::filesystem::path& path, const VectorHeader& header, EncoderPins initial);
  /// Without finish() nothing is left behind.
  ~VectorWriter();
  VectorWriter(const VectorWriter&) = delete;
  VectorWriter& operator=(const VectorWriter&) = delete;

  /// Strictly later than the event before, and later than clock 0.
  void add(const EncoderEvent& event);
  /// Ends the file at this length in clocks, later than the last event, and gives it its name.
  void finish(Clock length);

 private:
  void write(Clock clock, const EncoderPins& pins);

  std::filesystem::path path_;
  std::filesystem::path part_;
  std::ofstream file_;
  Clock last_ = 0;
};

/// Writes a whole source with signals A, B, Z; returns its length in clocks.
Clock write_vector(const std::filesystem::path& path, const std::string& design,
                   std::int64_t clock_hz, EncoderSource& source);

}  // namespace feltgate::traces
