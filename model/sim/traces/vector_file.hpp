// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate's own recordings of encoder pins: a text of one line per change, exact in clocks.
// Documentation: docs/traces.md
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "capture.hpp"
#include "feltgate/encoder_source.hpp"
#include "text.hpp"

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

/// Writes such a file. Every call throws TraceError when the caller is at fault (events out of
/// order); whether the disk took everything is for the file's owner to ask.
class VectorWriter {
 public:
  /// `name` is how errors call the file.
  VectorWriter(std::FILE* to, std::string name, const VectorHeader& header, EncoderPins initial);

  /// Strictly later than the event before, and later than clock 0.
  void add(const EncoderEvent& event);
  /// Ends the file at this length in clocks, later than the last event.
  void finish(Clock length);

 private:
  void put(const std::string& text);
  void write(Clock clock, const EncoderPins& pins);

  std::FILE* to_;
  std::string name_;
  Clock last_ = 0;
};

/// Writes a whole source with signals A, B, Z; returns its length in clocks.
Clock write_vector(std::FILE* to, const std::string& name, const std::string& design,
                   std::int64_t clock_hz, EncoderSource& source);

}  // namespace feltgate::traces
