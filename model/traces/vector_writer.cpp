// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate's own recordings of encoder pins: the writer. Documentation: docs/traces.md
#include <algorithm>

#include "traces/error.hpp"
#include "traces/vector_file.hpp"

namespace feltgate::traces {
namespace {

bool is_name(const std::string& text) {
  constexpr std::string_view kOthers = "_-.";
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           kOthers.find(c) != std::string_view::npos;
  });
}

}  // namespace

VectorWriter::VectorWriter(const std::filesystem::path& path, const VectorHeader& header,
                           EncoderPins initial)
    : path_(path), part_(path) {
  part_ += ".part";
  if (!is_name(header.design) || header.clock_hz < 1 || header.signals.size() != 3) {
    fail(path_.string(), "the header has no design, no clock or not three signals", "fill in the header");
  }
  file_.open(part_, std::ios::binary | std::ios::trunc);
  file_ << "feltgate-vector " << VectorHeader::kSchema << " design=" << header.design
        << " clock_hz=" << header.clock_hz << " signals=" << header.signals[0] << ','
        << header.signals[1] << ',' << header.signals[2] << '\n';
  if (!file_) fail(part_.string(), "cannot be written", "check the folder, the rights, the disk");
  write(0, initial);
}

VectorWriter::~VectorWriter() {
  if (!file_.is_open()) return;
  file_.close();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void VectorWriter::write(Clock clock, const EncoderPins& pins) {
  file_ << clock << (pins.a ? " 1" : " 0") << (pins.b ? " 1" : " 0") << (pins.z ? " 1\n" : " 0\n");
}

void VectorWriter::add(const EncoderEvent& event) {
  if (event.clock <= last_) {
    fail(path_.string(), "an event at clock " + std::to_string(event.clock) + " is not later",
         "give events in order of time");
  }
  last_ = event.clock;
  write(event.clock, event.pins);
}

void VectorWriter::finish(Clock length) {
  if (length <= last_) {
    fail(path_.string(), "the length is not later than the last event", "give the whole length");
  }
  file_ << "end " << length << '\n';
  file_.flush();
  if (!file_) fail(part_.string(), "cannot be written", "check the disk");
  file_.close();
  std::error_code error;
  std::filesystem::rename(part_, path_, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  fail(path_.string(), "cannot be written", "check the folder and the rights");
}

Clock write_vector(const std::filesystem::path& path, const std::string& design,
                   std::int64_t clock_hz, EncoderSource& source) {
  VectorHeader header;
  header.design = design;
  header.clock_hz = clock_hz;
  VectorWriter writer(path, header, source.initial());
  while (const auto event = source.next()) writer.add(*event);
  writer.finish(source.length());
  return source.length();
}

}  // namespace feltgate::traces
