// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures TwinDevice::tick_to, the call by which a program of one's own moves a lever.
// Documentation: docs/speed-for-accuracy.md
#pragma once

#include <cstddef>

namespace feltgate::bench {

/// CPU time of a tick, ns: an armed lever in the scene wall, angle by angle, 0.02 rad to and fro at
/// up to 2 rad/s, a third of the way in the wall.
double device_ns_per_tick(std::size_t ticks);

}  // namespace feltgate::bench
