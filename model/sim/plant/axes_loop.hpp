// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A plant with several axes and the device that drives its motors, from event to event. A plant has
// `axes`, advance(bridges, clocks), events(axis), next_corner(), now().
// docs/devices/pantograph.md
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "bridge.hpp"
#include "feltgate/encoder_source.hpp"

namespace feltgate::plant {

/// What a device may read. A core reads its pins: `events` are all changes since it was asked last.
template <class Plant>
struct AxesSense {
  Clock now;
  const std::array<std::vector<EncoderEvent>, Plant::axes>& events;
};

/// The device in the loop: the cores of several axes.
template <class Plant>
class AxesDevice {
 public:
  virtual ~AxesDevice() = default;
  /// Computes everything up to sense.now; its bridges hold from there.
  virtual std::array<Bridge, Plant::axes> act(const AxesSense<Plant>& sense) = 0;
  /// The first clock after `now` at which its outputs may change or it needs its inputs.
  virtual Clock next(Clock now) const = 0;
};

/// Advances plant and device together.
template <class Plant>
class AxesLoop {
 public:
  /// A step of the plant has at most `longest` clocks.
  AxesLoop(Plant& plant, AxesDevice<Plant>& device, Clock longest = 250)
      : plant_(plant), device_(device), longest_(longest) {}

  /// Runs to the clock `end`; calls `seen(plant)` after every step of the plant.
  template <class Observer>
  void run(Clock end, Observer&& seen) {
    while (plant_.now() < end) {
      if (plant_.now() >= next_) {
        bridges_ = device_.act({plant_.now(), events_});
        for (auto& events : events_) events.clear();
        next_ = std::max(device_.next(plant_.now()), plant_.now() + 1);
      }
      const Clock corner = std::min({end, next_, plant_.next_corner(), plant_.now() + longest_});
      plant_.advance(bridges_, corner - plant_.now());
      for (std::size_t axis = 0; axis < Plant::axes; ++axis) {
        const auto& fresh = plant_.events(axis);
        events_[axis].insert(events_[axis].end(), fresh.begin(), fresh.end());
      }
      seen(plant_);
    }
  }

 private:
  Plant& plant_;
  AxesDevice<Plant>& device_;
  Clock longest_;
  Clock next_ = 0;
  std::array<Bridge, Plant::axes> bridges_;
  std::array<std::vector<EncoderEvent>, Plant::axes> events_;
};

}  // namespace feltgate::plant
