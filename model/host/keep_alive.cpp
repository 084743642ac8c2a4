// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Kicks the watchdog of an armed motor. Documentation: docs/host.md
#include "host/keep_alive.hpp"

#include <algorithm>

namespace feltgate::host {

namespace {

constexpr double kicks_a_watch = 4;

}  // namespace

void KeepAlive::arm(const std::string& scene, const std::function<bool()>& go_on) {
  holds_ = true;  // from the first write on: after an error in between it must disarm
  try {
    device_.arm(scene, true, go_on);
  } catch (const LinkLost&) {
    throw;
  } catch (...) {
    holds_ = false;
    throw;
  }
  next_ = HostClock::now();
  poll();
}

void KeepAlive::take_over() {
  if (!device_.host_has_the_say() || !device_.armed(device_.tick())) return;
  holds_ = true;
  next_ = HostClock::now();
  poll();
}

void KeepAlive::poll() {
  if (!holds_ || HostClock::now() < next_) return;
  device_.kick();
  next_ = within(device_.watchdog_s() / kicks_a_watch);
}

double KeepAlive::next_in_s() const {
  if (!holds_) return idle_s;
  const std::chrono::duration<double> left = next_ - HostClock::now();
  return std::clamp(left.count(), 0.0, idle_s);
}

void KeepAlive::release() {
  if (!holds_) return;
  device_.disarm();
  holds_ = false;
}

}  // namespace feltgate::host
