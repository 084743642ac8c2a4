// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A motor on the bench. Documentation: docs/calibration.md
#include "apps/commands/host/bench_motor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "feltgate/generated/map.hpp"

namespace feltgate::host {

void say(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

BenchMotor::BenchMotor(Device& device, Mode mode) : device_(device), hold_(device) {
  device_.disarm();
  set_mode(mode);
}

BenchMotor::~BenchMotor() {
  try {
    hold_.release();
    set_mode(Mode::closed_loop);
  } catch (const std::exception&) {
    // The link is lost; Hold reports the consequence.
  }
}

void BenchMotor::set_mode(Mode mode) {
  using C = Map::C;
  const std::uint32_t others = device_.link().read(C::control) & ~(3u << C::control_mode);
  device_.link().write(C::control, others | static_cast<std::uint32_t>(mode) << C::control_mode);
}

void BenchMotor::poll() {
  hold_.poll();
  const Tick now = device_.tick();
  if (!hold_.holds() || device_.armed(now)) return;
  std::string why;
  for (const std::string& line : device_.in_words(now)) {
    if (line.rfind("fault", 0) == 0) why += "\n  " + line;
  }
  throw Refused("the motor is off" + (why.empty() ? std::string("; was the stop pressed?") : why));
}

void BenchMotor::wait(double seconds) {
  const Deadline end = within(seconds);
  while (HostClock::now() < end && !Interruptible::interrupted()) {
    poll();
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(0.01, hold_.next_in_s())));
  }
}

void BenchMotor::wait_on_board(double seconds) {
  const Quantity& tick = device_.quantities().find("tick");
  const std::uint32_t begin = device_.tick().word(tick);
  const double ticks = seconds * device_.board().tick_hz();
  while (device_.tick().word(tick) - begin < ticks && !Interruptible::interrupted()) wait(0.002);
}

void BenchMotor::set(const std::string& name, double value) {
  const SetResult r = device_.set(name, value);
  if (r.refused || !r.kept) {
    throw Refused(
        fmt::format("the board did not take {} = {:g}; is the motor armed?", name, value));
  }
}

KeptWords::KeptWords(BenchMotor& motor, std::vector<std::string> names) : motor_(motor) {
  for (std::string& name : names) {
    const double value = motor.device().get(name);
    values_.emplace_back(std::move(name), value);
  }
}

KeptWords::~KeptWords() {
  try {
    motor_.disarm();
    for (const auto& [name, value] : values_) motor_.set(name, value);
  } catch (const std::exception&) {
    // The link is lost; Hold reports the consequence.
  }
}

}  // namespace feltgate::host
