// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A triggered capture at tick rate: its setup, its progress, its result.
// Documentation: docs/host.md
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "feltgate/encoder_source.hpp"
#include "feltgate/generated/link.hpp"
#include "host/host_device.hpp"
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
  int word = 0;             ///< number of the word in a WordMask
  std::uint32_t level = 0;  ///< in steps of the word; or a mask of bits; or the event's number
  std::string text;         ///< as the user wrote it
};

/// Parses a trigger. "velocity>5", "angle<-0.2", "angle>10deg": the value rises to the limit or
/// above, or falls below it; in the quantity's unit. "fault", "fault:speed,stop": one of the faults
/// occurs. "limit:current": the limit begins to act. "armed": the motor is armed. "now": at once.
/// "event": any event of a law; "event:right": that event of the law in `laws`, which is needed for
/// events only and is nullptr for a board without an engine. Errors: std::invalid_argument; Refused
/// for events without an engine, or for a named event if the law is not known.
Trigger parse_trigger(const Device& device, const LawEngine* laws, const std::string& text);
/// Whether the text of a trigger means an event of a law.
bool means_event(const std::string& text);

/// Setup of a capture. Rows are `period` ticks apart; the board has BoardInfo::capture_rows rows.
struct CaptureSetup {
  std::vector<std::string> quantities;  ///< words of the snapshot, or fields in them
  int rows_before = 0;                  ///< rows before the trigger
  std::uint32_t period = 1;             ///< ticks from row to row
  Trigger trigger;
};

/// Result of a capture; the first row is the oldest.
struct Captured {
  std::vector<const Quantity*> columns;
  std::vector<Tick> rows;  ///< time_s is relative to the trigger
  int trigger_row = 0;     ///< the row of the trigger; -1 if there was none
  double row_s = 0;        ///< time from row to row
  bool simulated = false;
};

/// Mask of the words that contain these quantities. Errors: std::invalid_argument for a quantity
/// that is not in a tick.
WordMask mask_of(const Quantities& quantities, const std::vector<std::string>& names);

/// Writes the setup and starts the capture. Errors: std::invalid_argument for more words than
/// columns, or rows or period out of range; Refused if the link has no capture.
void start_capture(Device& device, const CaptureSetup& setup);
/// 0 idle, 1 fills the rows before the trigger, 2 waits, 3 fills the rest, 4 done.
int capture_state(Device& device);
/// Triggers now, whatever the mode, as with Trigger::Mode::by_hand.
void trigger_now(Device& device);
/// Ends a capture without a result.
void abort_capture(Device& device);
/// Time that all rows cover, s.
double capture_span_s(const Device& device, const CaptureSetup& setup);
/// Waits until a started capture is done; for its trigger at most `wait_s`. A setup without a
/// trigger is triggered as soon as the rows before it are full. `each` is called repeatedly with
/// the state; it returns the time to rest, s, or a negative number to end the wait. Returns false,
/// with the capture aborted, if the trigger did not come.
bool wait_for_capture(Device& device, const CaptureSetup& setup, double wait_s,
                      const std::function<double(int)>& each);
/// Reads the rows of a finished capture, or as many as there are. `progress` is called with 0..1.
Captured read_capture(
    Device& device, const CaptureSetup& setup,
    const std::function<void(double)>& progress = [](double) {});

/// The position of a tick.
struct PositionAt {
  std::int64_t tick = 0;  ///< ticks since the first one, ascending
  std::int32_t count = 0;
};

/// An encoder that gives these positions: edges of A and B at clocks of the board, such that the
/// core sees each position in its tick again; the first position becomes 0. Edges between two
/// positions are evenly spaced, since their real times are unknown. Z stays low: it is not among
/// the words of a tick.
class PositionEncoder final : public EncoderSource {
 public:
  /// `design` gives the clocks of a tick, the glitch filter and the encoder's polarity. Errors:
  /// std::invalid_argument if ticks do not rise, or if the position moves by more counts than a
  /// decoder can see in that time.
  PositionEncoder(const design::Design& design, const std::vector<PositionAt>& positions);
  EncoderPins initial() const override { return initial_; }
  std::optional<EncoderEvent> next() override;
  Clock length() const override { return length_; }

 private:
  std::vector<EncoderEvent> events_;
  std::size_t given_ = 0;
  EncoderPins initial_;
  Clock length_ = 0;
};

}  // namespace feltgate::host
