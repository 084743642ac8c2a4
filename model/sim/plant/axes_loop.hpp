// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A plant with several axes and the device that drives its motors, from event to event. A plant has
// `axes`, advance(bridges or torques, clocks), events(axis), next_corner(), now().
// docs/devices/pantograph.md
#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "bridge.hpp"
#include "feltgate/encoder_source.hpp"

namespace feltgate::plant {

/// The command to the motors until the device is asked again: bridges, or ideal joint torques.
template <std::size_t N>
struct AxesCommand {
  bool ideal = false;
  std::array<Bridge, N> bridges;
  std::array<double, N> torque_nm = {};
};

/// What a device may read. A core reads its pins: `events` are all changes since it was asked last.
template <class Plant>
struct AxesSense {
  Clock now;
  const std::array<std::vector<EncoderEvent>, Plant::axes>& events;
  const Plant& plant;  ///< for models with ideal sensors
};

/// The device in the loop: a law in continuous time, or the twin of a core with several axes.
template <class Plant>
class AxesDevice {
 public:
  virtual ~AxesDevice() = default;
  /// Computes everything up to sense.now; the command holds from there.
  virtual AxesCommand<Plant::axes> act(const AxesSense<Plant>& sense) = 0;
  /// The first clock after `now` at which its outputs may change or it needs its inputs.
  virtual Clock next(Clock now) const = 0;
};

/// Whether a plant may have ideal motors instead of bridges.
template <class Plant, class = void>
constexpr bool takes_torques = false;
template <class Plant>
constexpr bool
    takes_torques<Plant, std::void_t<decltype(std::declval<Plant&>().advance(
                             std::declval<const std::array<double, Plant::axes>&>(), Clock{1}))>> =
        true;

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
        command_ = device_.act({plant_.now(), events_, plant_});
        for (auto& events : events_) events.clear();
        next_ = std::max(device_.next(plant_.now()), plant_.now() + 1);
      }
      const Clock corner = std::min({end, next_, plant_.next_corner(), plant_.now() + longest_});
      const Clock clocks = corner - plant_.now();
      advance(clocks);
      for (std::size_t axis = 0; axis < Plant::axes; ++axis) {
        const auto& fresh = plant_.events(axis);
        events_[axis].insert(events_[axis].end(), fresh.begin(), fresh.end());
      }
      seen(plant_);
    }
  }
  void run(Clock end) {
    run(end, [](const Plant&) {});
  }

 private:
  void advance(Clock clocks) {
    if constexpr (takes_torques<Plant>) {
      if (command_.ideal) return plant_.advance(command_.torque_nm, clocks);
    }
    if (command_.ideal) throw std::logic_error("this plant has no ideal motors");
    plant_.advance(command_.bridges, clocks);
  }

  Plant& plant_;
  AxesDevice<Plant>& device_;
  Clock longest_;
  Clock next_ = 0;
  AxesCommand<Plant::axes> command_;
  std::array<std::vector<EncoderEvent>, Plant::axes> events_;
};

}  // namespace feltgate::plant
