// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Sparklines, lines, Teleplot, CSV. Documentation: docs/host.md
#include "apps/commands/host/live.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace feltgate::host {

namespace {

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

}  // namespace

std::string unit_suffix(const std::string& unit) {
  if (unit == "rad/s") return "_rad_s";
  if (unit == "rad" || unit == "s") return "_" + unit;
  if (unit == "Nm") return "_nm";
  if (unit == "A") return "_a";
  return unit == "V" ? "_v" : "";
}

std::string csv_head(const std::vector<const Quantity*>& columns) {
  std::string text = "time_s";
  for (const Quantity* q : columns) text += "," + q->name + unit_suffix(q->unit);
  return text + "\n";
}

std::string csv_row(const std::vector<const Quantity*>& columns, const Tick& tick) {
  std::string text = fmt::format("{:.9g}", tick.time_s);
  for (const Quantity* q : columns) text += fmt::format(",{:.12g}", tick.value(*q));
  return text + "\n";
}

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

std::vector<LiveColumn> live_columns(const std::vector<const Quantity*>& quantities) {
  std::vector<LiveColumn> columns;
  for (const Quantity* q : quantities) {
    columns.push_back(
        {q->name, q->unit == "1" ? "" : q->unit, [q](const Tick& tick) { return tick.value(*q); }});
  }
  return columns;
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
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void Live::as_line(const Tick& tick) {
  std::string text = fmt::format("{:.3f} s", tick.time_s);
  for (const LiveColumn& q : columns_) {
    text += fmt::format("  {} {} {}", q.name, shown(q.value(tick)), q.unit);
    if (q.unit.empty()) text.pop_back();
  }
  text += "  " + status(tick);
  if (device_.board().simulated) text += "  (simulated)";
  std::fputs((text + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void Live::as_teleplot(const Tick& tick) {
  std::string text;
  for (const LiveColumn& q : columns_) {
    if (!std::isfinite(q.value(tick))) continue;
    text += fmt::format(">{}:{:.3f}:{:.9g}{}\n", q.name, 1e3 * tick.time_s, q.value(tick),
                        q.unit.empty() ? "" : "§" + q.unit);
  }
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void Live::finish() {
  if (form_ == Form::terminal && lost_ > 0) {
    std::fputs(fmt::format("{} frames lost on the way\n", lost_).c_str(), stdout);
  }
}

}  // namespace feltgate::host
