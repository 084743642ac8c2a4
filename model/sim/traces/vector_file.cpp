// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate's own recordings of encoder pins: the reader. Documentation: docs/traces.md
#include "sim/traces/vector_file.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sim/traces/options.hpp"
#include "sim/traces/text.hpp"

namespace feltgate::traces {
namespace {

constexpr std::size_t kMostSignals = 32;
constexpr std::int64_t kMostClockHz = 1'000'000'000'000;

}  // namespace

VectorCapture::VectorCapture(const std::filesystem::path& path) : in_(path) { read_header(); }

std::vector<std::string_view> VectorCapture::words() {
  std::vector<std::string_view> found;
  std::string_view rest = trim(line_);
  while (!rest.empty()) {
    const std::size_t end = rest.find(' ');
    found.push_back(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view{} : trim(rest.substr(end + 1));
  }
  return found;
}

void VectorCapture::read_header() {
  in_.line(line_);
  const auto fields = words();
  if (fields.size() < 2 || fields[0] != "feltgate-vector") {
    in_.fail("the first line is not that of a feltgate vector", "convert it with feltgate import");
  }
  if (parse_count(fields[1]) != VectorHeader::kSchema) {
    in_.fail("schema " + shown(fields[1]) + " is not known", "this program reads schema 1");
  }
  header_.signals.clear();
  header_.clock_hz = 0;
  for (std::size_t i = 2; i < fields.size(); ++i) {
    const std::size_t equals = fields[i].find('=');
    const std::string key(fields[i].substr(0, equals));
    const std::string_view value =
        equals == std::string_view::npos ? std::string_view{} : fields[i].substr(equals + 1);
    if (key == "design") header_.design = value;
    if (key == "signals") header_.signals = split_names(std::string(value));
    if (key != "clock_hz") continue;
    header_.clock_hz = parse_count(value).value_or(0);
    if (header_.clock_hz > kMostClockHz) header_.clock_hz = 0;
  }
  if (header_.clock_hz < 1) in_.fail("no clock_hz from 1 to 1e12", "correct the first line");
  if (header_.signals.empty() || header_.signals.size() > kMostSignals) {
    in_.fail("no signals, or more than 32", "correct the first line, such as signals=A,B,Z");
  }
}

std::int64_t VectorCapture::clock_of(std::string_view word) const {
  const auto clock = parse_count(word);
  if (!clock) in_.fail(shown(word) + " is not a clock", "clocks are whole numbers up to 2^62");
  if (*clock <= clock_) {
    in_.fail(fmt::format("time goes backwards or stands still at clock {}", *clock),
             "every line is later than the one before");
  }
  return *clock;
}

// Reads one line into clock_ and levels_; false once the line `end LENGTH` was read.
bool VectorCapture::read_change() {
  do {
    if (!in_.line(line_)) {
      in_.fail("the line `end LENGTH` is missing", "the file is truncated; make it again");
    }
  } while (!line_.empty() && line_.front() == '#');
  const auto fields = words();
  if (fields.size() == 2 && fields[0] == "end") {
    clock_ = clock_of(fields[1]);
    if (in_.get() >= 0) in_.fail("text after the line `end LENGTH`", "cut it off");
    ended_ = true;
    return false;
  }
  if (fields.size() != header_.signals.size() + 1) {
    in_.fail(fmt::format("the line has {} of {} fields", fields.size(), header_.signals.size() + 1),
             "the file is damaged; make it again");
  }
  clock_ = clock_of(fields[0]);
  std::uint32_t all = 0;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    if (fields[i] != "0" && fields[i] != "1") {
      in_.fail("level " + shown(fields[i]) + " is not 0 or 1", "make the file again");
    }
    if (fields[i] == "1") all |= 1U << (i - 1);
  }
  levels_ = 0;
  for (std::size_t i = 0; i < chosen_.size(); ++i) levels_ |= ((all >> chosen_[i]) & 1U) << i;
  return true;
}

std::uint32_t VectorCapture::start(const std::vector<std::size_t>& chosen) {
  chosen_ = chosen;
  if (!read_change() || clock_ != 0) {
    in_.fail("no levels at clock 0", "the second line holds them, such as `0 0 0 0`");
  }
  return levels_;
}

std::optional<Change> VectorCapture::next() {
  const std::uint32_t before = levels_;
  while (!ended_ && read_change()) {
    if (levels_ != before) return Change{clock_, clock_ + 1, levels_};
  }
  return std::nullopt;
}

// feltgate's own recordings of encoder pins: the writer.

namespace {

bool is_name(const std::string& text) {
  constexpr std::string_view kOthers = "_-.";
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           kOthers.find(c) != std::string_view::npos;
  });
}

}  // namespace

VectorWriter::VectorWriter(std::FILE* to, std::string name, const VectorHeader& header,
                           EncoderPins initial)
    : to_(to), name_(std::move(name)) {
  if (!is_name(header.design) || header.clock_hz < 1 || header.signals.size() != 3) {
    fail(name_, "the header has no design, no clock or not three signals", "fill in the header");
  }
  put(fmt::format("feltgate-vector {} design={} clock_hz={} signals={},{},{}\n",
                  VectorHeader::kSchema, header.design, header.clock_hz, header.signals[0],
                  header.signals[1], header.signals[2]));
  write(0, initial);
}

void VectorWriter::put(const std::string& text) { std::fputs(text.c_str(), to_); }

void VectorWriter::write(Clock clock, const EncoderPins& pins) {
  put(fmt::format("{} {:d} {:d} {:d}\n", clock, pins.a, pins.b, pins.z));
}

void VectorWriter::add(const EncoderEvent& event) {
  if (event.clock <= last_) {
    fail(name_, fmt::format("an event at clock {} is not later", event.clock),
         "give events in order of time");
  }
  last_ = event.clock;
  write(event.clock, event.pins);
}

void VectorWriter::finish(Clock length) {
  if (length <= last_) {
    fail(name_, "the length is not later than the last event", "give the whole length");
  }
  put(fmt::format("end {}\n", length));
}

Clock write_vector(std::FILE* to, const std::string& name, const std::string& design,
                   std::int64_t clock_hz, EncoderSource& source) {
  VectorHeader header;
  header.design = design;
  header.clock_hz = clock_hz;
  VectorWriter writer(to, name, header, source.initial());
  while (const auto event = source.next()) writer.add(*event);
  writer.finish(source.length());
  return source.length();
}

}  // namespace feltgate::traces
