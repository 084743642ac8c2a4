// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT watch. Documentation: docs/host.md
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "apps/commands/commands.hpp"
#include "apps/commands/host/live.hpp"
#include "apps/commands/host/streaming.hpp"
#include "apps/commands/host/verbs.hpp"
#include "sim/plant/pantograph/linkage.hpp"
#include "sim/plant/pantograph/pantograph_parameters.hpp"

namespace feltgate::host {

namespace {

struct WatchArguments : StreamArguments {
  bool teleplot = false, pen = false;
};

/// Position of the pen and force of the motors on it, from the joints of a pantograph: x, y in m,
/// Fx, Fy in N; NaN where the joints are none of a pantograph's. A board tells its design and no
/// more, so the design's name says whether there is one.
std::vector<LiveColumn> pen_columns(Device& device) {
  if (device.axes() != 2) {
    throw std::invalid_argument(fmt::format(
        "--pen: is for a board with two axes, a pantograph; this one has {}", device.axes()));
  }
  const std::string& design = device.design().design.name;
  if (design.find("pantograph") == std::string::npos) {
    throw std::invalid_argument(fmt::format(
        "--pen: is for a design whose name has \"pantograph\" in it; the board has {}, leave --pen "
        "out or rename the design's file",
        design));
  }
  const auto parameters = plant::read_pantograph_file(find_file("pantograph", "vectors/devices"));
  const plant::Linkage linkage(parameters.linkage);
  const auto joints = [&device](const char* name) {
    const Quantities& all = device.quantities();
    const Quantity *one = &all.find(name), *five = &all.find(name + Quantities::suffix(1));
    return [one, five](const Tick& t) { return plant::Joints{t.value(*one), t.value(*five)}; };
  };
  const auto theta = joints("angle"), torque = joints("tau_ref");
  const auto pen = [=](const Tick& t) { return linkage.pose(theta(t)).pen; };
  const auto force = [=](const Tick& t) { return linkage.pose(theta(t)).force(torque(t)); };
  return {{"x", "m", [=](const Tick& t) { return pen(t).x; }},
          {"y", "m", [=](const Tick& t) { return pen(t).y; }},
          {"Fx", "N", [=](const Tick& t) { return force(t).x; }},
          {"Fy", "N", [=](const Tick& t) { return force(t).y; }}};
}

int watch(Session& session, WatchArguments a) {
  Device& device = session.device();
  std::vector<LiveColumn> columns;
  if (a.pen) {
    columns = pen_columns(device);
    a.names = {"angle", "angle.1", "tau_ref", "tau_ref.1"};
  } else {
    columns = live_columns(stream_columns(device, a));
  }
  const std::uint32_t fastest =
      device.shortest_period(stream_mask(device, a), session.options.baud);
  const double asked = std::round(a.every_s * device.board().tick_hz());
  const auto period = static_cast<std::uint32_t>(std::clamp(asked, 1.0, 4e9));
  if (period < fastest) {
    throw std::invalid_argument(
        fmt::format("--every {:g}: the wire carries these words every {:.3g} s at most; leave "
                    "words out, or use capture, which sees every tick",
                    a.every_s, fastest / device.board().tick_hz()));
  }
  const bool terminal = ::isatty(STDOUT_FILENO) == 1;
  const Live::Form form = a.teleplot ? Live::Form::teleplot
                          : terminal ? Live::Form::terminal
                                     : Live::Form::lines;
  std::fputs(simulated_banner(device.board()).c_str(), a.teleplot ? stderr : stdout);
  Live live(device, columns, form);
  follow_stream(device, a, period, [&live](const Tick& tick) { live.show(tick); });
  live.finish();
  std::fputs(link_troubles(session.link().counts()).c_str(), stderr);
  return exit_ok;
}

}  // namespace

Run add_watch(CLI::App& sub) {
  auto a = std::make_shared<WatchArguments>();
  a->names = {"angle", "velocity", "tau_ref", "tau_hat", "current_ref", "voltage"};
  a->every_s = 0.1;
  sub.footer(
      "  feltgate host /dev/ttyUSB0 watch                      until Ctrl-C\n"
      "  feltgate host /dev/ttyUSB0 watch angle tau_ref --arm wall --for 10\n"
      "  feltgate host /dev/ttyUSB0 watch --teleplot --every 0.01 | nc -u -w1 127.0.0.1 47269\n"
      "On a terminal a sparkline each, else a line for each tick. A motor that the host has armed "
      "is\n"
      "kept alive meanwhile and disarmed at the end; one that the panel has armed is only "
      "watched.\n"
      "Exit code: 0 ended, 1 a fault ended an armed motor, 2 unusable input or port, 3 the link "
      "broke down.");
  add_stream_options(sub, *a);
  sub.add_flag("--teleplot", a->teleplot, "lines '>name:milliseconds:value§unit' for Teleplot");
  sub.add_flag("--pen", a->pen, "x, y, Fx, Fy at the pen of a pantograph, in place of NAME");
  return [a](Session& session) { return watch(session, *a); };
}

}  // namespace feltgate::host
