// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board's stream, and the view that shows words of several axes to stream and capture.
// Documentation: docs/host.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "feltgate/generated/link.hpp"
#include "feltgate/link_view.hpp"
#include "host/host_device.hpp"

namespace feltgate::host {

namespace {

using M = LinkMap;

constexpr int wire_bits_per_byte = 10;
constexpr double most_of_wire = 0.8;

}  // namespace

std::uint16_t Device::show(WordMask words) {
  if (view_.empty()) return static_cast<std::uint16_t>(words);
  const int room = quantities_.words(), tick = quantities_.find("tick").word;
  unsigned mask = 0;
  int slot = 0;
  for (int word = 0; word < room * axes(); ++word) {
    if ((words >> word & 1) == 0) continue;
    if (word == tick) {  // it has its own place
      mask |= 1u << tick;
      continue;
    }
    slot += slot == tick;
    if (slot >= room) {
      throw std::invalid_argument(
          fmt::format("{} words of {} axes are asked for, beside the tick {} have room; leave some "
                      "out",
                      words_in(words), axes(), room - 1));
    }
    view_[static_cast<std::size_t>(slot)] = word;
    link_.write(LinkViewMap::first + slot, LinkViewMap::choice(word / room, word % room));
    mask |= 1u << slot++;
  }
  return static_cast<std::uint16_t>(mask);
}

int Device::slot_of(int word) const {
  const auto found = std::find(view_.begin(), view_.end(), word);
  return found == view_.end() ? word : static_cast<int>(found - view_.begin());
}

Tick Device::shown(std::uint16_t mask, const std::vector<std::uint32_t>& words) const {
  Tick t;
  std::map<int, std::uint32_t> by_word;
  auto next = words.begin();
  for (int slot = 0; slot < quantities_.words() && next != words.end(); ++slot) {
    if ((mask >> slot & 1) == 0) continue;
    by_word[view_.empty() ? slot : view_[static_cast<std::size_t>(slot)]] = *next++;
  }
  for (const auto& [word, value] : by_word) {
    t.mask |= WordMask{1} << word;
    t.words.push_back(value);
  }
  return t;
}

void Device::stream(WordMask mask, std::uint32_t period) {
  if (!board_.has_stream) {
    throw Refused("this board's link is built without a stream; only get, set and capture work");
  }
  link_.write(M::A::stream_period, 0);
  if (period == 0) return;
  const std::uint16_t slots = show(mask);
  while (link_.stream(HostClock::now())) {
  }
  stream_tick_.reset();
  stream_time_s_ = 0;
  link_.write(M::A::stream_words, slots);
  link_.write(M::A::stream_period, period);
}

std::optional<Tick> Device::streamed(Deadline deadline) {
  auto frame = link_.stream(deadline);
  if (!frame) return {};
  Tick t = shown(frame->mask, frame->words);
  t.lost = frame->lost;
  const std::uint32_t now = t.word(quantities_.find("tick"));
  // The counter wraps, its difference does not.
  if (stream_tick_) stream_time_s_ += (now - *stream_tick_) / board_.tick_hz();
  stream_tick_ = now;
  t.time_s = stream_time_s_;
  return t;
}

std::uint32_t Device::stream_dropped() { return link_.read(M::A::stream_dropped); }

std::uint32_t Device::shortest_period(WordMask mask, int baud) const {
  const WordMask with_tick = mask | Quantities::bit(quantities_.find("tick"));
  const int bytes = 4 + 4 * words_in(with_tick) + 4 + 2;
  const double seconds = bytes * wire_bits_per_byte / (most_of_wire * baud);
  return static_cast<std::uint32_t>(std::ceil(seconds * board_.tick_hz()));
}

}  // namespace feltgate::host
