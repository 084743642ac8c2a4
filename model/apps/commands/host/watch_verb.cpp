// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT watch. Documentation: docs/host.md
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <memory>
#include <utility>

#include "apps/commands/host/streaming.hpp"
#include "apps/commands/host/verbs.hpp"
#include "sim/plant/pantograph/linkage.hpp"
#include "sim/plant/pantograph/pantograph.hpp"

namespace feltgate::host {

namespace {

/// A value from lowest to highest in eighths of a line: "▁▂▅█".
std::string sparkline(const std::deque<double>& values) {
  static const char* const bars[] = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  if (values.empty()) return "";
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  std::string text;
  for (const double v : values) {
    const double share = *high > *low ? (v - *low) / (*high - *low) : 0.0;
    text += bars[std::min(7, static_cast<int>(share * 8))];
  }
  return text;
}

/// What is shown of a tick.
struct LiveColumn {
  std::string name, unit;
  std::function<double(const Tick&)> value;
};
std::vector<LiveColumn> live_columns(const std::vector<const Quantity*>& quantities) {
  std::vector<LiveColumn> columns;
  for (const Quantity* q : quantities) {
    columns.push_back(
        {q->name, q->unit == "1" ? "" : q->unit, [q](const Tick& tick) { return tick.value(*q); }});
  }
  return columns;
}

/// The display of the verb watch.
class Live {
 public:
  enum class Form { terminal, lines, teleplot };
  Live(Device& device, std::vector<LiveColumn> columns, Form form);
  void show(const Tick& tick);
  /// Moves the cursor below the display.
  void finish();

 private:
  void on_terminal(const Tick& tick);
  void as_line(const Tick& tick);
  void as_teleplot(const Tick& tick);
  std::string status(const Tick& tick) const;

  Device& device_;
  std::vector<LiveColumn> columns_;
  Form form_;
  std::vector<std::deque<double>> history_;
  int lines_ = 0;
  unsigned lost_ = 0;
};

constexpr std::size_t most_history = 200;

std::size_t terminal_width() {
  winsize size{};
  const bool known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

/// "-" for a value that there is not, as of a pen where the rods do not reach each other.
std::string shown(double value) {
  return !std::isfinite(value) ? "-" : fmt::format("{:.5g}", value);
}

Live::Live(Device& device, std::vector<LiveColumn> columns, Form form)
    : device_(device), columns_(std::move(columns)), form_(form), history_(columns_.size()) {}

std::string Live::status(const Tick& tick) const {
  const std::string faults = device_.fault_names(tick), limits = device_.limit_names(tick);
  return fmt::format("{} {}{}{}{}", device_.armed(tick) ? "ARMED" : "disarmed",
                     device_.scene_name(tick), limits.empty() ? "" : ", limits: " + limits,
                     faults.empty() ? "" : ", FAULTS: " + faults,
                     lost_ > 0 ? fmt::format(", {} frames lost", lost_) : "");
}

void Live::show(const Tick& tick) {
  lost_ += tick.lost;
  switch (form_) {
    case Form::terminal:
      return on_terminal(tick);
    case Form::lines:
      return as_line(tick);
    case Form::teleplot:
      return as_teleplot(tick);
  }
}

void Live::on_terminal(const Tick& tick) {
  const std::size_t width = terminal_width();
  constexpr std::size_t before_bars = 58;
  std::string text = lines_ > 0 ? fmt::format("\x1b[{}A", lines_) : "";
  const std::string badge = device_.board().simulated ? "  *** SIMULATED ***" : "";
  text += fmt::format("\r\x1b[K{:10.2f} s{}\n", tick.time_s, badge);
  for (std::size_t n = 0; n < columns_.size(); ++n) {
    const LiveColumn& q = columns_[n];
    std::deque<double>& h = history_[n];
    const double value = q.value(tick);
    if (std::isfinite(value)) h.push_back(value);
    if (h.size() > most_history) h.pop_front();
    const std::size_t room = width > before_bars ? width - before_bars : 0;
    const std::deque<double> seen(
        h.size() > room ? h.end() - static_cast<std::ptrdiff_t>(room) : h.begin(), h.end());
    text += fmt::format("\r\x1b[K{:>14} {:>11} {:<7}", q.name, shown(value), q.unit);
    if (!h.empty()) {
      const auto [low, high] = std::minmax_element(h.begin(), h.end());
      text += fmt::format("{:>9.3g} to {:<9.3g} {}", *low, *high, sparkline(seen));
    }
    text += "\n";
  }
  text += fmt::format("\r\x1b[K{}\n", status(tick).substr(0, width - 1));
  lines_ = static_cast<int>(columns_.size()) + 2;
  say(text);
}

void Live::as_line(const Tick& tick) {
  std::string text = fmt::format("{:.3f} s", tick.time_s);
  for (const LiveColumn& q : columns_) {
    text += fmt::format("  {} {} {}", q.name, shown(q.value(tick)), q.unit);
    if (q.unit.empty()) text.pop_back();
  }
  text += "  " + status(tick);
  if (device_.board().simulated) text += "  (simulated)";
  say(text + "\n");
}

void Live::as_teleplot(const Tick& tick) {
  std::string text;
  for (const LiveColumn& q : columns_) {
    if (!std::isfinite(q.value(tick))) continue;
    text += fmt::format(">{}:{:.3f}:{:.9g}{}\n", q.name, 1e3 * tick.time_s, q.value(tick),
                        q.unit.empty() ? "" : "§" + q.unit);
  }
  say(text);
}

void Live::finish() {
  if (form_ == Form::terminal && lost_ > 0) {
    std::fputs(fmt::format("{} frames lost on the way\n", lost_).c_str(), stdout);
  }
}

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
  const std::uint32_t period = stream_period(session, a);
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
  sub.footer(R"(  feltgate host /dev/ttyUSB0 watch                      until Ctrl-C
  feltgate host /dev/ttyUSB0 watch angle tau_ref --arm wall --for 10
  feltgate host /dev/ttyUSB0 watch --teleplot --every 0.01 | nc -u -w1 127.0.0.1 47269
On a terminal a sparkline each, else a line for each tick. A motor that the host has armed is
kept alive meanwhile and disarmed at the end; one that the panel has armed is only watched.
Exit code: 0 ended, 1 a fault ended an armed motor, 2 unusable input or port, 3 the link broke down.)");
  add_stream_options(sub, *a);
  sub.add_flag("--teleplot", a->teleplot, "lines '>name:milliseconds:value§unit' for Teleplot");
  sub.add_flag("--pen", a->pen, "x, y, Fx, Fy at the pen of a pantograph, in place of NAME");
  return [a](Session& session) { return watch(session, *a); };
}

}  // namespace feltgate::host
