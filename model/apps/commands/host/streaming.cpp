// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Following a stream. Documentation: docs/host.md
#include "apps/commands/host/streaming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/commands/commands.hpp"

namespace feltgate::host {

namespace {

/// Ends the stream, also after an error; over a lost link it cannot be ended.
class StreamOff {
 public:
  explicit StreamOff(Device& device) : device_(device) {}
  ~StreamOff() {
    try {
      device_.stream(0, 0);
    } catch (const std::exception&) {
    }
  }
  StreamOff(const StreamOff&) = delete;
  StreamOff& operator=(const StreamOff&) = delete;

 private:
  Device& device_;
};

/// The unit in the name of a column: "_rad_s" for rad/s; empty for counts and shares.
std::string unit_suffix(const std::string& unit) {
  if (unit == "rad/s") return "_rad_s";
  if (unit == "rad" || unit == "s") return "_" + unit;
  if (unit == "Nm") return "_nm";
  if (unit == "A") return "_a";
  return unit == "V" ? "_v" : "";
}

}  // namespace

void add_stream_options(CLI::App& sub, StreamArguments& a) {
  defaulted(sub, "names", a.names, "NAME", "words of a tick");
  option(sub, "--arm", a.arm, "SCENE", "arm this scene, kick the watchdog, disarm at the end");
  defaulted(sub, "--every", a.every_s, "SECONDS", "time from one tick shown to the next",
            checks::positive(3600, "s"));
  option(sub, "--for", a.seconds, "SECONDS", "end after so long; default: Ctrl-C",
         checks::seconds());
}

std::vector<const Quantity*> stream_columns(Device& device, const StreamArguments& a) {
  std::vector<const Quantity*> columns;
  for (const std::string& name : a.names) columns.push_back(&device.quantities().streamed(name));
  return columns;
}

WordMask stream_mask(Device& device, const StreamArguments& a) {
  WordMask mask = 0;
  for (const Quantity* q : stream_columns(device, a)) mask |= Quantities::bit(*q);
  for (const char* always : {"status", "faults", "tick"}) {
    mask |= Quantities::bit(device.quantities().find(always));
  }
  return mask;
}

std::uint32_t stream_period(Session& session, const StreamArguments& a) {
  Device& device = session.device();
  const std::uint32_t fastest =
      device.shortest_period(stream_mask(device, a), session.options.baud);
  if (a.every_s == 0) return fastest;
  const double asked = std::round(a.every_s * device.board().tick_hz());
  const auto period = static_cast<std::uint32_t>(std::clamp(asked, 1.0, 4e9));
  if (period < fastest) {
    throw std::invalid_argument(
        fmt::format("--every {:g}: the wire carries these words every {:.3g} s at most; leave "
                    "words out, or use capture, which sees every tick",
                    a.every_s, fastest / device.board().tick_hz()));
  }
  return period;
}

std::string csv_head(const std::vector<const Quantity*>& columns) {
  std::string text = "time_s";
  for (const Quantity* q : columns) text += "," + q->name + unit_suffix(q->unit);
  return text + "\n";
}

std::string csv_row(const std::vector<const Quantity*>& columns, const Tick& tick) {
  std::string text = fmt::format("{:.9g}", tick.time_s);
  for (const Quantity* q : columns) text += fmt::format(",{:.12g}", tick.value(*q));
  return text + "\n";
}

void follow_stream(Device& device, const StreamArguments& a, std::uint32_t period,
                   const std::function<void(const Tick&)>& show) {
  const Interruptible interruptible;
  Hold hold(device);
  hold.begin(a.arm);
  const WordMask mask = stream_mask(device, a);
  device.stream(mask, period);
  const StreamOff off(device);
  const double silent_s = 1.0 + 2 * period / device.board().tick_hz();
  const Deadline end = within(a.seconds > 0 ? a.seconds : 1e9);
  Deadline silent = within(silent_s);
  bool was_armed = false;
  while (!Interruptible::interrupted() && HostClock::now() < end) {
    const auto tick = device.streamed(std::min(end, within(hold.next_in_s())));
    hold.poll();
    if (tick) {
      silent = within(silent_s);
      show(*tick);
      was_armed = was_armed || device.armed(*tick);
      if (hold.holds() && was_armed && !device.armed(*tick)) {
        throw Refused("the motor is off" + fault_lines(device, *tick));
      }
    } else if (HostClock::now() > silent) {
      // Silence means a lost link (then this throws) or a board that was reset.
      (void)device.tick();
      device.stream(mask, period);
      silent = within(silent_s);
    }
  }
  hold.release();
}

}  // namespace feltgate::host
