// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT scene, arm, disarm, stop, clear, zero. Documentation: docs/host.md
#include <fmt/format.h>

#include <memory>
#include <thread>

#include "apps/commands/host/verbs.hpp"

namespace feltgate::host {

namespace {

struct ArmArguments {
  std::string scene;
  bool hold = false;
  double seconds = 0;
};

void tell(Device& device, const std::string& what) {
  say(simulated_banner(device.board()) + what + "\n");
}

/// The law's text for the message of arming; empty in another scene.
std::string of_law(Device& device) {
  if (!device.board().has_engine || device.scene_name(device.tick()) != "law") return "";
  return LawEngine(device).status().crc_good ? "; the CRC of the law holds" : "";
}

/// Kicks the watchdog until the user ends it or a fault occurs.
int hold_armed(Device& device, Hold& hold, double seconds) {
  const Deadline end = within(seconds > 0 ? seconds : 1e9);
  while (!Interruptible::interrupted() && HostClock::now() < end) {
    hold.poll();
    const Tick tick = device.tick();
    if (!device.armed(tick)) {
      const std::string why = fault_lines(device, tick);
      throw Refused("the motor is off" +
                    (why.empty() ? std::string("; the stop was pressed") : why));
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(hold.next_in_s(), 0.02)));
  }
  hold.release();
  say("disarmed\n");
  return exit_ok;
}

int arm(Session& session, const ArmArguments& a) {
  Device& device = session.device();
  if (a.seconds > 0 && !a.hold) {
    throw std::invalid_argument("--for ends a hold; add --hold");
  }
  if (!a.hold) {
    device.arm(a.scene, false);
    tell(device, fmt::format("armed, scene {}{}; nobody watches it: 'stop' or 'disarm' ends it",
                             device.scene_name(device.tick()), of_law(device)));
    return exit_ok;
  }
  const Interruptible interruptible;
  Hold hold(device);
  hold.arm(a.scene);
  tell(device,
       fmt::format("armed, scene {}, held{}; Ctrl-C disarms, and so does the watchdog {:g} s "
                   "after a last kick",
                   device.scene_name(device.tick()), of_law(device), device.watchdog_s()));
  return hold_armed(device, hold, a.seconds);
}

/// A verb without options.
Run simple(CLI::App& sub, const char* footer, void (Device::*does)(), const char* done) {
  sub.footer(footer);
  return [=](Session& session) {
    (session.device().*does)();
    tell(session.device(), done);
    return int{exit_ok};
  };
}

}  // namespace

Run add_arm(CLI::App& sub) {
  auto a = std::make_shared<ArmArguments>();
  sub.footer(R"(  feltgate host /dev/ttyUSB0 arm spring_tension --hold  until Ctrl-C, which disarms
With --hold the host kicks the core's watchdog; when host or cable fail, the core disarms by
itself. Without it the motor stays armed when this program has ended. Once the watchdog was
kicked it stays awake until a reset, so then only --hold keeps the motor armed.
Exit code: 0 armed (and disarmed again), 1 refused or ended by a fault, 2 unusable input or
port, 3 the link broke down.)");
  option(sub, "scene", a->scene, "SCENE", "what to render; default: the scene that is chosen");
  sub.add_flag("--hold", a->hold, "stay, kick the watchdog, disarm at the end");
  option(sub, "--for", a->seconds, "SECONDS", "with --hold: end after so long", checks::seconds());
  return [a](Session& session) { return arm(session, *a); };
}

Run add_disarm(CLI::App& sub) {
  return simple(sub, R"(  feltgate host /dev/ttyUSB0 disarm
The motor is off at the end of the tick. The host has the say from then on.
Exit code: 0 done, 2 unusable input or port, 3 the link broke down.)",
                &Device::disarm, "disarmed");
}

Run add_stop(CLI::App& sub) {
  return simple(sub, R"(  feltgate host /dev/ttyUSB0 stop
The same as the stop at the board, by wire: gates off within clocks, a fault that 'clear' forgets.
It is no substitute for a stop that cuts the supply.
Exit code: 0 done, 2 unusable input or port, 3 the link broke down.)",
                &Device::stop, "stopped; 'clear' before the motor can be armed again");
}

Run add_clear(CLI::App& sub) {
  return simple(sub, R"(  feltgate host /dev/ttyUSB0 clear
Exit code: 0 no fault is left, 1 a cause still stands, 2 unusable input or port, 3 the link broke down.)",
                &Device::clear_faults, "no fault; disarmed");
}

Run add_zero(CLI::App& sub) {
  return simple(sub, R"(  feltgate host /dev/ttyUSB0 zero
An armed motor ramps its torque again: the scene moves with the zero.
Exit code: 0 done, 2 unusable input or port, 3 the link broke down.)",
                &Device::set_zero, "the position is 0 here");
}

Run add_scene(CLI::App& sub) {
  auto scene = std::make_shared<std::string>();
  sub.footer(R"(  feltgate host /dev/ttyUSB0 scene membrane
An armed motor ramps over to it. The host has the say from then on, not the panel's switches.
Exit code: 0 done, 1 the panel has armed the motor, 2 unusable input or port, 3 the link broke down.)");
  option(sub, "scene", *scene, "SCENE", "a scene of the board's design")->required();
  return [scene](Session& session) {
    Device& device = session.device();
    device.select(*scene);
    tell(device, "scene " + *scene);
    return int{exit_ok};
  };
}

}  // namespace feltgate::host
