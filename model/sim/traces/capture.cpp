// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finding channels by name in a recording of logic levels. Documentation: docs/traces.md
#include "sim/traces/capture.hpp"

#include "feltgate/nearest.hpp"
#include "sim/traces/text.hpp"

namespace feltgate::traces {
namespace {

template <class Matches>
std::vector<std::size_t> all_that(const std::vector<std::string>& channels, Matches matches) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (matches(channels[i])) found.push_back(i);
  }
  return found;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::size_t find_channel(const std::vector<std::string>& channels, const std::string& name,
                         const std::string& where) {
  auto found = all_that(channels, [&](const std::string& c) { return c == name; });
  if (found.empty()) {
    found = all_that(channels, [&](const std::string& c) { return lower(c) == lower(name); });
  }
  if (found.empty()) {
    found = all_that(channels, [&](const std::string& c) { return ends_with(c, "." + name); });
  }
  if (found.size() == 1) return found.front();
  fail(where, found.empty() ? "no probe " + shown(name) : "more than one probe " + shown(name),
       (found.empty() ? config::did_you_mean(name, channels) : "") +
           "there are: " + list_names(channels));
}

std::vector<std::vector<std::string>> quadrature_pairs(const std::vector<std::string>& channels) {
  std::vector<std::vector<std::string>> pairs;
  for (const std::string& a : channels) {
    const std::string low = lower(a);
    if (low.empty() || low.back() != 'a') continue;
    for (const std::string& b : channels) {
      if (lower(b) == low.substr(0, low.size() - 1) + "b") pairs.push_back({a, b});
    }
  }
  return pairs;
}

std::vector<std::string> guess_probes(const std::vector<std::string>& channels,
                                      const std::string& where) {
  const auto pairs = quadrature_pairs(channels);
  if (pairs.size() == 1) {
    std::vector<std::string> probes = pairs.front();
    const std::string stem = lower(probes[0]).substr(0, probes[0].size() - 1);
    for (const std::string& name : channels) {
      const std::string low = lower(name);
      if (low == stem + "z" || low == stem + "i" || low == stem + "index") {
        probes.push_back(name);
        break;
      }
    }
    return probes;
  }
  if (pairs.empty() && (channels.size() == 2 || channels.size() == 3)) return channels;
  std::string choices;
  for (const auto& pair : pairs)
    choices += (choices.empty() ? "" : " or ") + pair[0] + "," + pair[1];
  fail(where, "cannot tell which channels are the encoder's A and B",
       "name the probes" +
           (choices.empty() ? ", there are: " + list_names(channels) : ": " + choices));
}

// Counts what a perfect x4 decoder must find.

void StepCounter::add(const EncoderEvent& event) {
  const EncoderPins was = pins_;
  pins_ = event.pins;
  const bool a_moved = was.a != pins_.a;
  const bool b_moved = was.b != pins_.b;
  if (!a_moved && !b_moved) return;
  ++result_.steps;
  const Clock spacing = event.clock - last_;
  if (moved_ && spacing < result_.shortest_edge_spacing.value_or(spacing + 1)) {
    result_.shortest_edge_spacing = spacing;
  }
  moved_ = true;
  last_ = event.clock;
  if (a_moved && b_moved) {
    ++result_.illegal;
    return;
  }
  // Counting up B leads: B moves away from A, or A follows B.
  const bool up = b_moved ? pins_.a != pins_.b : pins_.a == pins_.b;
  const int direction = up ? 1 : -1;
  if (direction_ == -direction) ++result_.reversals;
  direction_ = direction;
  result_.position += direction;
}

Statistics count_steps(EncoderSource& source) {
  StepCounter counter(source.initial());
  while (const auto event = source.next()) counter.add(*event);
  Statistics result = counter.result();
  result.length = source.length();
  return result;
}

}  // namespace feltgate::traces
