// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A triggered capture at tick rate: what it is told, how it runs, what it brings. Documentation:
// docs/host.md
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "feltgate/generated/link.hpp"
#include "host/device.hpp"
#include "host/law_engine.hpp"

namespace feltgate::host {

/// When the capture is triggered.
struct Trigger {
  enum class Mode : std::uint32_t {
    by_hand = 0,
    rises = LinkMap::trigger_rises,
    falls = LinkMap::trigger_falls,
    bit = LinkMap::trigger_bit,
    event = LinkMap::trigger_event
  };
  Mode mode = Mode::by_hand;
  int word = 0;             ///< number of the word in masks
  std::uint32_t level = 0;  ///< in steps of the word, the mask of bits, or the event's number
  std::string text;         ///< as it was asked for
};

/// "velocity>5", "angle<-0.2", "angle>10deg": rises to the value or above, falls below it, in the
/// quantity's unit. "fault", "fault:speed,stop": one of the faults comes. "limit:current": the
/// limit begins to hold. "armed": the motor is armed. "now": at once. "event": any event of a law,
/// "event:right": that of the law of `laws`, which is for events alone and nullptr on a board
/// without an engine. Throws std::invalid_argument; Refused for events without an engine, or by
/// name where the law is not known.
Trigger parse_trigger(const Device& device, const LawEngine* laws, const std::string& text);
/// Whether such a text means an event of a law.
bool means_event(const std::string& text);

/// What is captured. Rows are period ticks apart; the board has BoardInfo::capture_rows of them.
struct CaptureSetup {
  std::vector<std::string> quantities;  ///< words of the snapshot, or what lies in them
  int rows_before = 0;                  ///< of the trigger
  std::uint32_t period = 1;             ///< ticks from row to row
  Trigger trigger;
};

/// What was captured; the first row is the oldest.
struct Captured {
  std::vector<const Quantity*> columns;
  std::vector<Tick> rows;  ///< time_s is relative to the trigger
  int trigger_row = 0;     ///< the row of the trigger; -1 where there was none
  double row_s = 0;        ///< time from row to row
  bool simulated = false;
};

/// Mask of the words that these quantities lie in. Throws std::invalid_argument for one that is no
/// word of a tick.
std::uint16_t mask_of(const Quantities& quantities, const std::vector<std::string>& names);

/// Sets the capture up and starts it. Throws std::invalid_argument: more words than columns, rows
/// or period out of range; Refused where the link has no capture.
void start_capture(Device& device, const CaptureSetup& setup);
/// 0 idle, 1 fills the rows before the trigger, 2 waits, 3 fills the rest, 4 done.
int capture_state(Device& device);
/// As Trigger::Mode::by_hand, whatever the mode.
void trigger_now(Device& device);
void abort_capture(Device& device);
/// Time that all rows cover, s.
double capture_span_s(const Device& device, const CaptureSetup& setup);
/// Waits until a started capture is done, `wait_s` at most for its trigger; a setup without one is
/// triggered as soon as the rows before it are full. `each` is called all along with the state,
/// gives how long to rest, s, and ends the wait with less than 0. Returns false, the capture
/// aborted, where the trigger did not come.
bool wait_for_capture(Device& device, const CaptureSetup& setup, double wait_s,
                      const std::function<double(int)>& each);
/// Reads the rows of a capture that is done, or as many as there are. `progress` is called with
/// 0..1.
Captured read_capture(
    Device& device, const CaptureSetup& setup,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace feltgate::host
