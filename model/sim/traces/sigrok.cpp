// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// sigrok session files through libarchive: order of the chunks and streaming of the samples.
// Documentation: docs/traces.md
#include "sim/traces/sigrok.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "sim/traces/text.hpp"

namespace feltgate::traces {
namespace {

constexpr std::size_t kBlock = 65536;
constexpr std::size_t kMostMetadata = 1U << 20U;

}  // namespace

struct SigrokCapture::Entry {
  std::string name;
};

void SigrokCapture::Closer::operator()(archive* a) const { archive_read_free(a); }

SigrokCapture::SigrokCapture(const std::filesystem::path& path, std::int64_t sample_hz)
    : path_(path.string()) {
  scan_archive(sample_hz);
}

void SigrokCapture::fail_archive(const std::string& doing) const {
  const char* reason = archive_ ? archive_error_string(archive_.get()) : nullptr;
  fail(where(), doing + " failed (" + (reason != nullptr ? reason : "damaged zip") + ")",
       "the file is truncated or damaged, or no sigrok session; fetch it again");
}

void SigrokCapture::reopen() {
  archive_.reset(archive_read_new());
  // Only with the zip's directory at the end of the file: without it the file is cut off.
  if (!archive_ || archive_read_support_format_zip_seekable(archive_.get()) != ARCHIVE_OK ||
      archive_read_open_filename(archive_.get(), path_.c_str(), kBlock) != ARCHIVE_OK) {
    fail_archive("opening the zip");
  }
}

bool SigrokCapture::next_entry(Entry& entry) {
  archive_entry* header = nullptr;
  const int result = archive_read_next_header(archive_.get(), &header);
  if (result == ARCHIVE_EOF) return false;
  if (result != ARCHIVE_OK && result != ARCHIVE_WARN) fail_archive("reading the zip");
  const char* name = archive_entry_pathname(header);
  entry.name = name != nullptr ? name : "";
  return true;
}

void SigrokCapture::scan_archive(std::int64_t given_hz) {
  std::vector<std::string> entries;
  std::string metadata;
  bool found = false;
  reopen();
  for (Entry entry; next_entry(entry);) {
    if (entry.name == "metadata" && !found) {
      found = true;
      std::vector<char> buffer(kBlock);
      for (;;) {
        const auto size = archive_read_data(archive_.get(), buffer.data(), buffer.size());
        if (size < 0) fail_archive("reading 'metadata'");
        if (size == 0) break;
        metadata.append(buffer.data(), static_cast<std::size_t>(size));
        if (metadata.size() > kMostMetadata) fail_archive("reading 'metadata' (over 1 MiB)");
      }
    } else if (entry.name.compare(0, 5, "logic") == 0) {
      entries.push_back(entry.name);
    }
  }
  if (!found) fail(path_, "the zip holds no 'metadata'", "give a sigrok session file (.sr)");
  parse_metadata(metadata, given_hz);

  std::map<std::int64_t, std::string> numbered;
  for (const std::string& name : entries) {
    if (name == capture_file_) {
      chunks_.assign(1, name);
      return;
    }
    if (name.compare(0, capture_file_.size() + 1, capture_file_ + "-") != 0) continue;
    const auto number = parse_count(std::string_view(name).substr(capture_file_.size() + 1));
    if (number) numbered[*number] = name;
  }
  for (const auto& [number, name] : numbered) {
    const auto expected = static_cast<std::int64_t>(chunks_.size()) + 1;
    if (number != expected) {
      fail(path_, fmt::format("chunk {}-{} is missing", capture_file_, expected),
           "fetch the file again");
    }
    chunks_.push_back(name);
  }
  if (chunks_.empty()) {
    fail(path_, "the zip holds no samples " + shown(capture_file_), "give a logic recording");
  }
}

void SigrokCapture::open_chunk() {
  const std::string& name = chunks_[chunk_++];
  // Chunks mostly lie in order, so go on from here first and from the start second.
  for (int pass = 0; pass < 2; ++pass) {
    if (pass == 1 || chunk_ == 1) reopen();
    for (Entry entry; next_entry(entry);) {
      if (entry.name == name) return;
    }
  }
  fail_archive("finding " + shown(name) + " again");
}

bool SigrokCapture::refill() {
  for (;;) {
    const void* block = nullptr;
    std::size_t size = 0;
    la_int64_t offset = 0;
    const int result =
        chunk_ == 0 ? ARCHIVE_EOF : archive_read_data_block(archive_.get(), &block, &size, &offset);
    if (result == ARCHIVE_EOF) {
      if (chunk_ == chunks_.size()) return false;
      open_chunk();
      continue;
    }
    // A warning is a checksum or size that does not match: the samples are not what they were.
    if (result != ARCHIVE_OK) fail_archive("unpacking");
    if (size == 0) continue;
    at_ = static_cast<const unsigned char*>(block);
    stop_ = at_ + size;
    return true;
  }
}

const unsigned char* SigrokCapture::sample() {
  if (static_cast<std::size_t>(stop_ - at_) >= unit_size_) {
    const unsigned char* const bytes = at_;
    at_ += unit_size_;
    return bytes;
  }
  split_.assign(at_, stop_);
  at_ = stop_;
  while (split_.size() < unit_size_) {
    if (at_ == stop_ && !refill()) {
      if (split_.empty()) return nullptr;
      fail(where(), "the recording ends inside a sample", "check unitsize in the metadata");
    }
    const auto missing = static_cast<std::ptrdiff_t>(unit_size_ - split_.size());
    const auto* const until = at_ + std::min(missing, stop_ - at_);
    split_.insert(split_.end(), at_, until);
    at_ = until;
  }
  return split_.data();
}

std::uint32_t SigrokCapture::levels_of(const unsigned char* bytes) const {
  std::uint32_t levels = 0;
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const unsigned bit = bytes[chosen_[i] / 8] >> (chosen_[i] % 8);
    levels |= static_cast<std::uint32_t>(bit & 1U) << i;
  }
  return levels;
}

std::uint32_t SigrokCapture::start(const std::vector<std::size_t>& chosen) {
  for (const std::size_t channel : chosen) chosen_.push_back(bits_.at(channel));
  const unsigned char* const bytes = sample();
  if (bytes == nullptr) fail(where(), "the recording holds no samples", "record something");
  sample_ = 1;
  levels_ = levels_of(bytes);
  return levels_;
}

std::optional<Change> SigrokCapture::next() {
  while (const unsigned char* bytes = sample()) {
    ++sample_;
    if (unit_size_ == 1) {
      // A still encoder repeats one byte for long; skip the run without looking at single bits.
      const unsigned char* const run = at_;
      const unsigned char still = *bytes;
      if (levels_of(bytes) == levels_) {
        while (at_ != stop_ && *at_ == still) ++at_;
        sample_ += at_ - run;
        continue;
      }
    }
    const std::uint32_t levels = levels_of(bytes);
    if (levels == levels_) continue;
    levels_ = levels;
    return Change{sample_ - 1, sample_, levels};
  }
  return std::nullopt;
}

std::string SigrokCapture::where() const {
  if (chunk_ == 0) return path_;
  return fmt::format("{}:{}:sample {}", path_, chunks_[chunk_ - 1], sample_);
}

// sigrok session files: the `metadata` entry, an INI text with the rate and the probes.

namespace {

constexpr std::int64_t kMostUnitSize = 64;

/// Keys of the first [device ...] section, in small letters.
std::map<std::string, std::string> device_section(std::string_view text) {
  std::map<std::string, std::string> keys;
  bool inside = false;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trim(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    if (!line.empty() && line.front() == '[') {
      if (inside) break;
      inside = line.compare(0, 7, "[device") == 0;
      continue;
    }
    const std::size_t equals = line.find('=');
    if (!inside || equals == std::string_view::npos) continue;
    keys[lower(trim(line.substr(0, equals)))] = std::string(trim(line.substr(equals + 1)));
  }
  return keys;
}

}  // namespace

void SigrokCapture::parse_metadata(const std::string& text, std::int64_t given_hz) {
  const std::string at = path_ + ":metadata";
  const auto keys = device_section(text);
  const auto value = [&](const std::string& key) {
    const auto found = keys.find(key);
    return found == keys.end() ? std::string() : found->second;
  };

  // A rate that the caller gives stands in for one that is wrong, 0 or not there at all.
  const std::string rate = value("samplerate");
  sample_hz_ = given_hz > 0 ? given_hz : parse_rate(rate).value_or(0);
  if (sample_hz_ == 0) {
    fail(at,
         rate.empty() ? "the recording has no samplerate"
                      : "samplerate " + shown(rate) + " is not a rate",
         "give the rate of the samples in Hz (--sample-hz)");
  }

  const auto unit_size = parse_count(keys.count("unitsize") != 0 ? value("unitsize") : "1");
  if (!unit_size || *unit_size < 1 || *unit_size > kMostUnitSize) {
    fail(at, "unitsize " + shown(value("unitsize")) + " is not a size", "give 1 to 64 bytes");
  }
  unit_size_ = static_cast<std::size_t>(*unit_size);

  if (!value("capturefile").empty()) capture_file_ = value("capturefile");

  for (std::size_t bit = 0; bit < unit_size_ * 8; ++bit) {
    const std::string name = value(fmt::format("probe{}", bit + 1));
    if (name.empty()) continue;
    names_.push_back(name);
    bits_.push_back(bit);
  }
  if (names_.empty()) fail(at, "no probe of the recording has a name", "give a logic recording");
}

}  // namespace feltgate::traces
