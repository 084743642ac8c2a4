// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT events. Documentation: docs/host.md
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "apps/commands/checks.hpp"
#include "apps/commands/commands.hpp"
#include "apps/commands/host/line_server.hpp"
#include "apps/commands/host/session.hpp"
#include "apps/commands/host/verbs.hpp"

namespace feltgate::host {

namespace {

constexpr double rest_s = 0.002, look_s = 0.2;

struct EventsArguments {
  std::string arm;
  double seconds = 0;
  int count = 0;
  std::optional<int> tcp;
};

void check_armed(Device& device) {
  const Tick tick = device.tick();
  if (device.armed(tick)) return;
  std::string why;
  for (const std::string& words : device.in_words(tick)) {
    if (words.rfind("fault", 0) == 0) why += "\n  " + words;
  }
  throw Refused("the motor is off" + why);
}

int events(Session& session, const EventsArguments& a) {
  Device& device = session.device();
  LawEngine& laws = session.laws();
  std::optional<LineServer> server;
  if (a.tcp) server.emplace(*a.tcp);
  const std::string banner = simulated_banner(device.board());
  std::fputs(banner.c_str(), stderr);
  if (server) {
    std::fputs(fmt::format("lines also at 127.0.0.1:{}\n", server->port()).c_str(), stderr);
  }
  const Interruptible interruptible;
  Hold hold(device);
  if (a.arm.empty()) {
    hold.take_over();
  } else {
    hold.arm(a.arm);
  }
  const Deadline end = within(a.seconds > 0 ? a.seconds : 1e9);
  Deadline look = within(look_s);
  int told = 0;
  std::optional<unsigned> lost_before;
  while (!Interruptible::interrupted() && HostClock::now() < end &&
         (a.count == 0 || told < a.count)) {
    hold.poll();
    if (server) server->poll();
    const auto event = laws.event();
    if (!lost_before) lost_before = laws.events_lost();
    if (event) {
      const std::string line =
          fmt::format("{} {} {:.9g}\n", event->tick, event->name, event->value);
      std::fputs(line.c_str(), stdout);
      std::fflush(stdout);
      if (server) server->send(line);
      ++told;
      continue;
    }
    if (hold.holds() && HostClock::now() > look) {
      check_armed(device);
      look = within(look_s);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(hold.next_in_s(), rest_s)));
  }
  hold.release();
  const unsigned lost = laws.events_lost() - lost_before.value_or(laws.events_lost());
  if (lost > 0 || laws.events_lost() == 255) {
    std::fputs(fmt::format("{}{} events found no place on the board meanwhile and are lost\n",
                           laws.events_lost() == 255 ? "at least " : "", lost)
                   .c_str(),
               stderr);
  }
  return exit_ok;
}

}  // namespace

Run add_events(CLI::App& sub) {
  auto a = std::make_shared<EventsArguments>();
  sub.footer(
      "  feltgate host /dev/ttyUSB0 events --arm law           arm, hold, tell; Ctrl-C disarms\n"
      "  feltgate host /dev/ttyUSB0 events --arm law --tcp 4711\n"
      "  nc 127.0.0.1 4711                                     in another window\n"
      "A line each: the tick, the name in the law, the value in SI units. The board keeps 16 "
      "events "
      "until\n"
      "the host takes them; those beyond are counted and told. One host at a time has the port.\n"
      "Exit code: 0 done, 1 no engine, or the motor went off, 2 unusable input or port, 3 the link "
      "broke\n"
      "down.");
  sub.add_option("--arm", a->arm, "arm this scene, kick the watchdog, disarm at the end")
      ->type_name("SCENE");
  sub.add_option("--for", a->seconds, "end after so long; default: Ctrl-C")
      ->type_name("SECONDS")
      ->transform(checks::seconds());
  sub.add_option("--count", a->count, "end after so many events")
      ->type_name("EVENTS")
      ->transform(checks::whole(1, 1'000'000'000));
  sub.add_option("--tcp", a->tcp,
                 "send the lines to those who connect to this port of 127.0.0.1 too; 0: any")
      ->type_name("PORT")
      ->transform(checks::whole(0, 65535));
  return [a](Session& session) { return events(session, *a); };
}

}  // namespace feltgate::host
