// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// sigrok session files (.sr): a zip with `metadata` and the samples in `logic-1` or
// `logic-1-1`, `logic-1-2`, ... Documentation: docs/traces.md
#pragma once

#include <filesystem>
#include <memory>

#include "capture.hpp"

struct archive;

namespace feltgate::traces {

/// Streams the samples through libarchive, one block at a time, in the order of the chunks.
class SigrokCapture final : public Capture {
 public:
  /// sample_hz > 0 stands in for the samplerate of the metadata.
  SigrokCapture(const std::filesystem::path& path, std::int64_t sample_hz);

  const std::vector<std::string>& channels() const override { return names_; }
  TimeBase time_base() const override { return {1, sample_hz_}; }
  std::uint32_t start(const std::vector<std::size_t>& chosen) override;
  std::optional<Change> next() override;
  std::int64_t end() const override { return sample_; }
  std::string where() const override;

 private:
  struct Closer {
    void operator()(archive* a) const;
  };
  struct Entry;

  void reopen();
  bool next_entry(Entry& entry);
  void scan_archive(std::int64_t given_hz);
  void parse_metadata(const std::string& text, std::int64_t given_hz);
  void open_chunk();
  bool refill();
  const unsigned char* sample();
  std::uint32_t levels_of(const unsigned char* bytes) const;
  [[noreturn]] void fail_archive(const std::string& doing) const;

  std::string path_;
  std::unique_ptr<archive, Closer> archive_;
  std::string capture_file_ = "logic-1";
  std::int64_t sample_hz_ = 0;
  std::size_t unit_size_ = 0;
  std::vector<std::string> names_;
  std::vector<std::size_t> bits_;    // bit of the sample of each channel
  std::vector<std::size_t> chosen_;  // bit of the sample of each chosen channel
  std::vector<std::string> chunks_;  // entries with samples, in order of time
  std::size_t chunk_ = 0;            // how many of them are opened
  const unsigned char* at_ = nullptr;
  const unsigned char* stop_ = nullptr;
  std::vector<unsigned char> split_;  // a sample cut in two by the end of a block
  std::int64_t sample_ = 0;           // samples read so far
  std::uint32_t levels_ = 0;
};

}  // namespace feltgate::traces
