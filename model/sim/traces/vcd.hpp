// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Value change dumps (.vcd, IEEE 1364): the wires of one bit. Documentation: docs/traces.md
#pragma once

#include <filesystem>
#include <unordered_map>

#include "capture.hpp"
#include "text.hpp"

namespace feltgate::traces {

/// A moment is one time stamp with all its changes. x and z keep the level before, low at the
/// start.
class VcdCapture final : public Capture {
 public:
  /// sample_hz > 0 is the width of a moment; 0 takes the file's timescale.
  VcdCapture(const std::filesystem::path& path, std::int64_t sample_hz);

  const std::vector<std::string>& channels() const override { return names_; }
  TimeBase time_base() const override { return base_; }
  std::uint32_t start(const std::vector<std::size_t>& chosen) override;
  std::optional<Change> next() override;
  std::int64_t end() const override { return time_ - origin_ + width_; }
  std::string where() const override { return in_.where(); }

 private:
  bool token();
  void need_token(const std::string& what);
  void skip_to_end();
  void read_header();
  void read_timescale();
  void read_variable(const std::vector<std::string>& scopes);
  void shorten_names();
  bool read_moment();
  void read_time();
  void read_value(char level);

  ByteReader in_;
  std::string token_;
  TimeBase base_;
  std::int64_t width_ = 1;
  std::vector<std::string> names_;
  std::vector<std::string> ids_;                            // identifier code of each channel
  std::unordered_map<std::string, std::uint32_t> bits_of_;  // code to chosen bits, 0 for the rest
  bool timed_ = false;                                      // a time stamp was seen
  bool ended_ = false;
  bool valued_ = false;      // a value was seen
  std::int64_t origin_ = 0;  // first time stamp
  std::int64_t time_ = 0;    // time stamp of the values that come now
  std::int64_t moment_ = 0;  // time stamp of the moment read last
  std::uint32_t levels_ = 0;
  std::uint32_t given_ = 0;
};

}  // namespace feltgate::traces
