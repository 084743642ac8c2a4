// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Following a stream. Documentation: docs/host.md
#include "apps/commands/host/streaming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "apps/commands/checks.hpp"

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

}  // namespace

void add_stream_options(CLI::App& sub, StreamArguments& a) {
  sub.add_option("names", a.names, "words of a tick")->type_name("NAME")->capture_default_str();
  sub.add_option("--arm", a.arm, "arm this scene, kick the watchdog, disarm at the end")
      ->type_name("SCENE");
  sub.add_option("--every", a.every_s, "time from one tick shown to the next")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->transform(checks::positive(3600, "s"));
  sub.add_option("--for", a.seconds, "end after so long; default: Ctrl-C")
      ->type_name("SECONDS")
      ->transform(checks::seconds());
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

void follow_stream(Device& device, const StreamArguments& a, std::uint32_t period,
                   const std::function<void(const Tick&)>& show) {
  const Interruptible interruptible;
  Hold hold(device);
  if (a.arm.empty()) {
    hold.take_over();
  } else {
    hold.arm(a.arm);
  }
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
        std::string why;
        for (const std::string& words : device.in_words(*tick)) {
          if (words.rfind("fault", 0) == 0) why += "\n  " + words;
        }
        throw Refused("the motor is off" + why);
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
