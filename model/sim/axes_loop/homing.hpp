// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Homing: gives the counts of a device's joints their zero. Documentation: docs/devices.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "feltgate/encoder_source.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/plant/encoder.hpp"

namespace feltgate {

/// Clocks per count on the way from 0 to the device's position: slower than any overspeed limit.
constexpr Clock homing_clocks_per_count = 400;
/// Rest after the way, s: ten time constants of a velocity estimate of 500 rad/s; after it the core
/// no longer takes the device for moving.
constexpr double homing_rest_s = 0.02;

template <class Plant, std::size_t... I>
std::array<plant::Encoder, Plant::axes> zeroed(const Plant& device,
                                               std::index_sequence<I...> /*all*/) {
  const plant::EncoderParameters p = device.parameters().encoder;
  return {((void)I, plant::Encoder(p, false, 0.5 * device.encoder(I).count_rad()))...};
}

/// Resets the cores and lets them count from the joints' zeros: with the motors off, each joint
/// moves from its angle 0 to the device's position and rests there. Returns the clocks that this
/// took, a whole number of periods.
/// Cores: AxesCores, or anything with its reset(), edge(), advance() and design().
template <class Cores, class Plant>
Clock home(Cores& cores, const Plant& device, std::uint64_t seed, Clock period_clocks) {
  constexpr std::size_t axes = Plant::axes;
  AxesCores::Pins pins{};
  auto encoders = zeroed(device, std::make_index_sequence<axes>{});
  std::int64_t most = 0;
  for (std::size_t n = 0; n < axes; ++n) {
    pins[n] = encoders[n].pins();
    most = std::max(most, std::abs(device.encoder(n).count()));
  }
  cores.reset(seed, pins);
  if (most == 0) return 0;
  const Clock moving = most * homing_clocks_per_count;
  Clock clocks =
      moving + std::llround(homing_rest_s * static_cast<double>(cores.design().clock_hz));
  clocks += period_clocks - clocks % period_clocks;
  for (std::size_t n = 0; n < axes; ++n) {
    std::vector<EncoderEvent> edges;
    const double to_rad =
        (static_cast<double>(device.encoder(n).count()) + 0.5) * device.encoder(n).count_rad();
    encoders[n].advance(to_rad, 0, moving - 1, edges);
    for (const EncoderEvent& e : edges) cores.edge(n, e);
  }
  cores.advance(clocks);
  return clocks;
}

}  // namespace feltgate
