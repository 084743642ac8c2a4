// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Value change dumps: the stream of values after the header. Documentation: docs/traces.md
#include "sim/traces/vcd.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "sim/traces/text.hpp"

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

// Value change dumps: timescale, scopes and variables.

namespace {

constexpr std::size_t kMostVariables = 1'000'000;
constexpr std::size_t kMostScopes = 1000;

}  // namespace

void VcdCapture::read_header() {
  std::vector<std::string> scopes;
  bool scaled = false;
  for (;;) {
    need_token("its header");
    if (token_ == "$timescale") {
      read_timescale();
      scaled = true;
    } else if (token_ == "$scope") {
      need_token("$scope");
      need_token("$scope");
      if (scopes.size() == kMostScopes) in_.fail("more than 1000 scopes", "give a VCD file");
      scopes.push_back(token_);
      skip_to_end();
    } else if (token_ == "$upscope") {
      if (!scopes.empty()) scopes.pop_back();
      skip_to_end();
    } else if (token_ == "$var") {
      read_variable(scopes);
    } else if (token_ == "$enddefinitions") {
      skip_to_end();
      break;
    } else if (token_.front() == '$') {
      skip_to_end();
    } else {
      in_.fail(shown(token_) + " stands outside every command of the header", "give a VCD file");
    }
  }
  if (!scaled) in_.fail("the header has no $timescale", "add one, such as $timescale 1 us $end");
  if (names_.empty()) in_.fail("no variable has one bit", "record A and B as single wires");
  shorten_names();
}

void VcdCapture::read_timescale() {
  std::string text;
  for (need_token("$timescale"); token_ != "$end"; need_token("$timescale")) text += token_;
  std::size_t digits = 0;
  while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9') ++digits;
  const std::string number = text.substr(0, digits);
  static const std::map<std::string, std::int64_t> kUnits = {{"s", 1},
                                                             {"ms", 1'000},
                                                             {"us", 1'000'000},
                                                             {"ns", 1'000'000'000},
                                                             {"ps", 1'000'000'000'000},
                                                             {"fs", 1'000'000'000'000'000}};
  const auto unit = kUnits.find(text.substr(digits));
  if ((number != "1" && number != "10" && number != "100") || unit == kUnits.end()) {
    in_.fail(shown(text) + " is not a timescale", "give 1, 10 or 100 of s, ms, us, ns, ps, fs");
  }
  base_ = {std::stoll(number), unit->second};
}

void VcdCapture::read_variable(const std::vector<std::string>& scopes) {
  need_token("$var");
  need_token("$var");
  const std::string size = token_;
  need_token("$var");
  const std::string id = token_;
  need_token("$var");
  const std::string name = token_;
  skip_to_end();
  if (bits_of_.size() == kMostVariables) in_.fail("more than 1000000 variables", "dump fewer");
  bits_of_.emplace(id, 0U);
  if (size != "1") return;
  std::string path;
  for (const std::string& scope : scopes) path += scope + ".";
  names_.push_back(path + name);
  ids_.push_back(id);
}

// A name that is the only one of its kind goes without its scopes.
void VcdCapture::shorten_names() {
  std::map<std::string, int> uses;
  const auto leaf = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
  for (const std::string& name : names_) ++uses[leaf(name)];
  for (std::string& name : names_) {
    if (uses[leaf(name)] == 1) name = leaf(name);
  }
}

}  // namespace feltgate::traces
