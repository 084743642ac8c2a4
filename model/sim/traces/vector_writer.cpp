// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate's own recordings of encoder pins: the writer. Documentation: docs/traces.md
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/traces/error.hpp"
#include "sim/traces/vector_file.hpp"

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
