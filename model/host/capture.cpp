// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Sets up a capture and reads it. Documentation: docs/host.md
#include "host/capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "feltgate/generated/engine.hpp"
#include "feltgate/generated/link.hpp"
#include "feltgate/nearest.hpp"
#include "sim/traces/options.hpp"

namespace feltgate::host {

namespace {

using M = LinkMap;

constexpr int memory_row = M::columns;
static_assert(M::any_event == 1u << EngineMap::event_bits, "above every event's number");

/// Bits of the causes in a list such as "speed,stop"; all causes for an empty list.
std::uint32_t bits_of(const std::vector<design::Cause>& causes, std::string list,
                      const std::string& what) {
  std::uint32_t bits = 0;
  std::vector<std::string> names;
  for (const design::Cause& c : causes) names.push_back(c.name);
  if (list.empty()) {
    for (const design::Cause& c : causes) bits |= 1u << c.number;
    return bits;
  }
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const std::string name = list.substr(0, comma);
    list.erase(0, comma + 1);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw std::invalid_argument(fmt::format("{} \"{}\" is unknown; {}choose from {}", what, name,
                                              config::did_you_mean(name, names),
                                              fmt::join(names, ", ")));
    }
    bits |= 1u << causes[static_cast<std::size_t>(found - names.begin())].number;
  }
  return bits;
}

Trigger event_trigger(const Device& device, const LawEngine* laws, const std::string& name,
                      const std::string& text) {
  if (laws == nullptr) {
    throw Refused(
        fmt::format("this board's design {} has no engine, so no law tells events; "
                    "trigger on a word of the tick, such as velocity>5",
                    device.design().design.name));
  }
  if (name.empty()) return {Trigger::Mode::event, 0, M::any_event, text};
  if (laws->image() == nullptr) {
    throw Refused(
        fmt::format("the law that this board runs is not known here, so \"{}\" means no "
                    "event; give the file with --law, or trigger on any \"event\"",
                    name));
  }
  std::vector<std::string> names;
  for (const law::ImageEvent& e : laws->image()->events) names.push_back(e.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw std::invalid_argument(
        names.empty()
            ? fmt::format("the law {} tells no events; trigger on a word of the tick, such as "
                          "velocity>5",
                          laws->image()->name)
            : fmt::format("the law {} has no event \"{}\"; {}choose from {}", laws->image()->name,
                          name, config::did_you_mean(name, names), fmt::join(names, ", ")));
  }
  const law::ImageEvent& e = laws->image()->events[static_cast<std::size_t>(found - names.begin())];
  return {Trigger::Mode::event, 0, static_cast<std::uint32_t>(e.number), text};
}

Trigger bit_trigger(const Quantity& q, std::uint32_t bits, const std::string& text) {
  return {Trigger::Mode::bit, q.word, bits << q.bit, text};
}

void check_range(const char* what, std::int64_t value, std::int64_t low, std::int64_t high) {
  if (value < low || value > high) {
    throw std::invalid_argument(
        fmt::format("{} {} do not go; choose from {} to {}", value, what, low, high));
  }
}

}  // namespace

Trigger parse_trigger(const Device& device, const LawEngine* laws, const std::string& text) {
  const Quantities& q = device.quantities();
  const design::RegisterMap& map = device.design().registers;
  if (text == "now") return {Trigger::Mode::by_hand, 0, 0, text};
  if (text == "armed") return bit_trigger(q.find("status.armed"), 1, text);
  const std::string head = text.substr(0, text.find(':'));
  const std::string list = head.size() < text.size() ? text.substr(head.size() + 1) : "";
  if (head.size() < text.size() && list.empty()) {
    throw std::invalid_argument(
        fmt::format("\"{}\" has no name behind its colon; leave the colon away for any", text));
  }
  if (head == "fault") {
    return bit_trigger(q.find("faults.seen"), bits_of(map.faults, list, "fault"), text);
  }
  if (head == "limit") {
    return bit_trigger(q.find("status.limits"), bits_of(map.limits, list, "limit"), text);
  }
  if (means_event(text)) return event_trigger(device, laws, list, text);
  const std::size_t at = text.find_first_of("<>");
  if (at == std::string::npos || at == 0) {
    throw std::invalid_argument(
        fmt::format("\"{}\" is no trigger; write such as velocity>5, angle<-10deg, fault, "
                    "limit:current, armed, "
                    "event:NAME or now",
                    text));
  }
  const Quantity& of = q.streamed(text.substr(0, at));
  if (of.kind != Quantity::Kind::snapshot || of.unit.empty()) {
    throw std::invalid_argument(fmt::format(
        "{} is made of bits and has no level; trigger on fault, limit or armed", of.name));
  }
  const double level = std::round(q.value_in(of, text.substr(at + 1)) / of.scale);
  if (!(std::abs(level) < 2147483648.0)) {
    throw std::invalid_argument(
        fmt::format("{} never reaches that level; choose a smaller one", of.name));
  }
  return {text[at] == '>' ? Trigger::Mode::rises : Trigger::Mode::falls, of.word,
          static_cast<std::uint32_t>(static_cast<std::int64_t>(level) & 0xffffffff), text};
}

bool means_event(const std::string& text) { return text.substr(0, text.find(':')) == "event"; }

WordMask mask_of(const Quantities& quantities, const std::vector<std::string>& names) {
  WordMask mask = 0;
  for (const std::string& name : names) mask |= Quantities::bit(quantities.streamed(name));
  return mask;
}

void start_capture(Device& device, const CaptureSetup& setup) {
  const BoardInfo& board = device.board();
  if (!board.has_capture) {
    throw Refused("this board's link is built without a capture; only get, set and watch work");
  }
  const WordMask mask = mask_of(device.quantities(), setup.quantities);
  if (words_in(mask) > board.capture_columns || mask == 0) {
    throw std::invalid_argument(
        fmt::format("{} words are asked for, a row of this board has {}; "
                    "leave some out",
                    words_in(mask), board.capture_columns));
  }
  check_range("rows before the trigger", setup.rows_before, 0, board.capture_rows - 1);
  check_range("ticks from row to row", setup.period, 1, 0xffffffff);
  Link& link = device.link();
  link.write(M::A::capture_control, 1u << M::B::capture_control_abort);
  const int trigger = setup.trigger.word;
  const unsigned shown = device.show(mask | WordMask{1} << trigger);
  const bool only_trigger = (mask >> trigger & 1) == 0;
  const unsigned kept = only_trigger ? shown & ~(1u << device.slot_of(trigger)) : shown;
  link.write(M::A::capture_words, kept);
  link.write(M::A::capture_pre, static_cast<std::uint32_t>(setup.rows_before));
  link.write(M::A::capture_period, setup.period);
  link.write(M::A::trigger_word, static_cast<std::uint32_t>(device.slot_of(trigger)));
  link.write(M::A::trigger_mode, static_cast<std::uint32_t>(setup.trigger.mode));
  link.write(M::A::trigger_level, setup.trigger.level);
  link.write(M::A::capture_control, 1u << M::B::capture_control_start);
}

int capture_state(Device& device) {
  return static_cast<int>(device.link().read(M::A::capture_state));
}

void trigger_now(Device& device) {
  device.link().write(M::A::capture_control, 1u << M::B::capture_control_trigger);
}

void abort_capture(Device& device) {
  device.link().write(M::A::capture_control, 1u << M::B::capture_control_abort);
}

double capture_span_s(const Device& device, const CaptureSetup& setup) {
  return setup.period * device.board().capture_rows / device.board().tick_hz();
}

bool wait_for_capture(Device& device, const CaptureSetup& setup, double wait_s,
                      const std::function<double(int)>& each) {
  enum { idle = 0, waits = 2, fills_rest = 3, done = 4 };
  const double span_s = capture_span_s(device, setup);
  Deadline end = within(wait_s + span_s);
  bool by_hand = setup.trigger.mode == Trigger::Mode::by_hand, late = false;
  for (;;) {
    const int state = capture_state(device);
    if (state == done) return true;
    if (state == waits && by_hand) {
      trigger_now(device);
      by_hand = false;
    }
    if (state == fills_rest && !late) {
      late = true;  // triggered: only the remaining rows are missing
      end = within(span_s + 1);
    }
    const double rest_s = each(state);
    if (rest_s < 0 || state == idle || HostClock::now() > end) {
      abort_capture(device);
      return false;
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(rest_s));
  }
}

Captured read_capture(Device& device, const CaptureSetup& setup,
                      const std::function<void(double)>& progress) {
  const std::vector<std::uint32_t> words =
      device.link().read(M::A::capture_state, M::A::capture_rows - M::A::capture_state + 1);
  const auto at = [&words](int address) {
    return static_cast<int>(words[static_cast<std::size_t>(address - M::A::capture_state)]);
  };
  const int all = device.board().capture_rows;
  const int rows = std::clamp(at(M::A::capture_rows), 0, all);
  Captured c;
  c.simulated = device.board().simulated;
  c.row_s = setup.period / device.board().tick_hz();
  const int state = at(M::A::capture_state);
  c.trigger_row = state == 4 ? std::min(setup.rows_before, rows - 1) : -1;
  const auto mask = static_cast<std::uint16_t>(device.link().read(M::A::capture_words));
  for (const std::string& name : setup.quantities) {
    c.columns.push_back(&device.quantities().streamed(name));
  }
  const auto used = static_cast<std::size_t>(words_in(mask));
  const int batch = static_cast<int>(M::read_words) / memory_row;
  for (int row = 0; row < rows;) {
    // The oldest row is at capture_first; a read must not cross the end of the ring.
    const int place = (at(M::A::capture_first) + row) % all;
    const int now = std::min({batch, rows - row, all - place});
    const std::vector<std::uint32_t> got =
        device.link().read(static_cast<int>(M::memory) + memory_row * place, memory_row * now);
    for (int n = 0; n < now; ++n, ++row) {
      const auto from = got.begin() + memory_row * n;
      Tick t = device.shown(mask, {from, from + static_cast<std::ptrdiff_t>(used)});
      t.time_s = (row - std::max(c.trigger_row, 0)) * c.row_s;
      c.rows.push_back(std::move(t));
    }
    progress(static_cast<double>(row) / rows);
  }
  return c;
}

namespace {

/// taken_after: clock of a tick after which the decoder's count certainly belongs to it.
/// decoder_clocks: most clocks from an edge at the pin to the position, without the filter's
/// samples.
constexpr Clock taken_after = 4, decoder_clocks = 5;

}  // namespace

PositionEncoder::PositionEncoder(const design::Design& design,
                                 const std::vector<PositionAt>& positions) {
  const Clock per_tick = design.clocks_per_tick();
  const Clock late = decoder_clocks + design.filter_samples;
  const int up = design.encoder_polarity == 0 ? 1 : -1;
  if (positions.empty()) throw std::invalid_argument("no positions were recorded");
  // The phase of the pins; an encoder with swapped channels counts the other way.
  std::int64_t phase = std::int64_t{positions.front().count} * up;
  initial_ = traces::pins_at(static_cast<unsigned>(phase & 3));
  for (std::size_t n = 1; n < positions.size(); ++n) {
    const PositionAt &from = positions[n - 1], &to = positions[n];
    if (to.tick <= from.tick) {
      throw std::invalid_argument(fmt::format(
          "the ticks of row {} and the one before do not rise; was the board reset?", n));
    }
    // The position wraps, a difference does not.
    const auto moved = static_cast<std::int32_t>(static_cast<std::uint32_t>(to.count) -
                                                 static_cast<std::uint32_t>(from.count));
    const std::int64_t edges = std::llabs(moved);
    const Clock begin = from.tick * per_tick + taken_after;
    const Clock room = to.tick * per_tick - late - begin;
    if (edges > room) {
      throw std::invalid_argument(
          fmt::format("row {}: {} counts in {} ticks are more than a decoder sees", n, edges,
                      to.tick - from.tick));
    }
    for (std::int64_t k = 0; k < edges; ++k) {
      phase += moved > 0 ? up : -up;
      events_.push_back(
          {begin + room * k / edges, traces::pins_at(static_cast<unsigned>(phase & 3))});
    }
  }
  length_ = (positions.back().tick + 1) * per_tick;
}

std::optional<EncoderEvent> PositionEncoder::next() {
  if (given_ == events_.size()) return {};
  return events_[given_++];
}

}  // namespace feltgate::host
