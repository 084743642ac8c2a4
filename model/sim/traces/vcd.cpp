// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Value change dumps: the stream of values after the header. Documentation: docs/traces.md
#include "sim/traces/vcd.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/traces/error.hpp"

namespace feltgate::traces {
namespace {

constexpr std::size_t kLongestToken = 65536;

}  // namespace

VcdCapture::VcdCapture(const std::filesystem::path& path, std::int64_t sample_hz) : in_(path) {
  read_header();
  if (sample_hz > 0) {
    const int128_t units = static_cast<int128_t>(base_.den) / (int128_t{base_.num} * sample_hz);
    width_ = static_cast<std::int64_t>(std::max<int128_t>(units, 1));
  }
}

bool VcdCapture::token() {
  int c = in_.get();
  while (c == ' ' || c == '\t' || c == '\r' || c == '\n') c = in_.get();
  token_.clear();
  for (; c >= 0 && c != ' ' && c != '\t' && c != '\r' && c != '\n'; c = in_.get()) {
    if (token_.size() == kLongestToken) in_.fail("a word is longer than 64 KiB", "give a VCD file");
    token_ += static_cast<char>(c);
  }
  return !token_.empty();
}

void VcdCapture::need_token(const std::string& what) {
  if (!token()) in_.fail("the file ends inside " + what, "it is truncated; fetch it again");
}

void VcdCapture::skip_to_end() {
  do need_token("a command without $end");
  while (token_ != "$end");
}

std::uint32_t VcdCapture::start(const std::vector<std::size_t>& chosen) {
  for (const std::string& id : ids_) bits_of_[id] |= 0U;
  for (std::size_t i = 0; i < chosen.size(); ++i) bits_of_[ids_.at(chosen[i])] |= 1U << i;
  read_moment();
  if (!valued_ && ended_) in_.fail("the recording holds no values", "record something");
  given_ = levels_;
  return given_;
}

std::optional<Change> VcdCapture::next() {
  while (read_moment()) {
    if (levels_ == given_) continue;
    given_ = levels_;
    const std::int64_t begin = moment_ - origin_;
    return Change{begin, begin + width_, given_};
  }
  return std::nullopt;
}

// One call reads all values of a time stamp, up to the next later stamp or the end of the file.
bool VcdCapture::read_moment() {
  if (ended_) return false;
  moment_ = time_;
  while (token()) {
    const char first = token_.front();
    switch (first) {
      case '#':
        read_time();
        if (time_ != moment_) return true;
        break;
      case '0':
      case '1':
      case 'x':
      case 'X':
      case 'z':
      case 'Z':
        token_.erase(0, 1);
        if (token_.empty()) need_token("a value");
        read_value(first);
        break;
      case 'b':
      case 'B':
      case 'r':
      case 'R': {
        const char level = token_.back();
        need_token("a value");
        read_value(level);
        break;
      }
      case '$':
        if (token_ == "$comment") skip_to_end();
        break;
      default:
        in_.fail(shown(token_) + " is not a VCD value", "the file is damaged; fetch it again");
    }
  }
  ended_ = true;
  return true;
}

void VcdCapture::read_time() {
  const auto t = parse_count(std::string_view(token_).substr(1));
  if (!t) in_.fail(shown(token_) + " is not a time", "times are whole numbers from 0 to 2^62");
  if (!timed_) {
    timed_ = true;
    origin_ = moment_ = *t;
  } else if (*t < time_) {
    in_.fail(fmt::format("time goes backwards from {} to {}", time_, *t),
             "sort the recording or cut it");
  }
  time_ = *t;
}

void VcdCapture::read_value(char level) {
  const auto found = bits_of_.find(token_);
  if (found == bits_of_.end()) {
    in_.fail("a value of " + shown(token_) + ", which no $var declares",
             "the file is damaged; fetch it again");
  }
  valued_ = true;
  if (level == '1') levels_ |= found->second;
  if (level == '0') levels_ &= ~found->second;
}

}  // namespace feltgate::traces
