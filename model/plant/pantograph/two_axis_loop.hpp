// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A pantograph and what drives its motors, from event to event. Documentation: docs/pantograph.md
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "pantograph.hpp"

namespace feltgate::plant {

/// What both motors get until the device is asked again: bridges, or ideal torques at the cranks.
struct AxesCommand {
  bool ideal = false;
  std::array<Bridge, 2> bridges;
  Joints torque_nm = {};
};

/// What a device may see. A core sees its pins: `events` are all changes since it was asked last.
struct AxesSense {
  Clock now;
  const std::array<std::vector<EncoderEvent>, 2>& events;
  const Pantograph& plant;  ///< for models that are given ideal sensors
};

/// The device side of the loop: a law in continuous time, or the twin of a core with two axes.
class AxesDevice {
 public:
  virtual ~AxesDevice() = default;
  /// Everything up to sense.now; the command holds from there.
  virtual AxesCommand act(const AxesSense& sense) = 0;
  /// The first clock after `now` at which its outputs may change or it wants its inputs.
  virtual Clock next(Clock now) const = 0;
};

class TwoAxisLoop {
 public:
  /// Steps of the plant have at most `longest` clocks.
  TwoAxisLoop(Pantograph& plant, AxesDevice& device, Clock longest = 250)
      : plant_(plant), device_(device), longest_(longest) {}

  /// Runs until clock `end`; `seen(plant)` is called after every step of the plant.
  template <class Observer>
  void run(Clock end, Observer&& seen) {
    while (plant_.now() < end) {
      if (plant_.now() >= next_) {
        command_ = device_.act({plant_.now(), events_, plant_});
        for (auto& events : events_) events.clear();
        next_ = std::max(device_.next(plant_.now()), plant_.now() + 1);
      }
      const Clock corner = std::min({end, next_, plant_.next_corner(), plant_.now() + longest_});
      const Clock clocks = corner - plant_.now();
      if (command_.ideal) {
        plant_.advance(command_.torque_nm, clocks);
      } else {
        plant_.advance(command_.bridges, clocks);
      }
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto& fresh = plant_.events(axis);
        events_[axis].insert(events_[axis].end(), fresh.begin(), fresh.end());
      }
      seen(plant_);
    }
  }
  void run(Clock end) {
    run(end, [](const Pantograph&) {});
  }

 private:
  Pantograph& plant_;
  AxesDevice& device_;
  Clock longest_;
  Clock next_ = 0;
  AxesCommand command_;
  std::array<std::vector<EncoderEvent>, 2> events_;
};

}  // namespace feltgate::plant
