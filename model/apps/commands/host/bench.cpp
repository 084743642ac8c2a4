// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measurements on the bench. Documentation: docs/calibration.md
#include "apps/commands/host/bench.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "apps/commands/commands.hpp"
#include "feltgate/generated/map.hpp"
#include "files/table.hpp"

namespace feltgate::host {

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
  const std::string why = fault_lines(device_, now);
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

namespace {

std::string kept;  // of the line after the one that was asked for

std::optional<std::string> whole_line() {
  const std::size_t end = kept.find('\n');
  if (end == std::string::npos) return {};
  std::string line = kept.substr(0, end);
  kept.erase(0, end + 1);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

}  // namespace

std::optional<std::string> typed_line(const std::string& what, const std::function<bool()>& go_on,
                                      const std::function<void()>& meanwhile) {
  constexpr int wait_ms = 20;
  while (go_on()) {
    if (auto line = whole_line()) return line;
    pollfd p{STDIN_FILENO, POLLIN, 0};
    if (poll(&p, 1, wait_ms) > 0) {
      char text[256];
      const ssize_t size = read(STDIN_FILENO, text, sizeof text);
      if (size <= 0) {
        throw std::invalid_argument(
            fmt::format("the input ended where {} was asked for; type it", what));
      }
      kept.append(text, static_cast<std::size_t>(size));
    }
    meanwhile();
  }
  return {};
}

namespace {

design::Elaborated design_for(Session& session, const std::string& verb, bool of_file) {
  if (session.options.port != "-") return session.design().design;
  if (!of_file) {
    throw std::invalid_argument(fmt::format(
        "{} with PORT - has no board; give the port, or the readings with --from FILE", verb));
  }
  return elaborated_design(session.options.design.empty() ? "lever" : session.options.design);
}

}  // namespace

Bench::Bench(Session& session, const std::string& verb, const std::vector<std::string>& from,
             const std::string& write, const std::string& json)
    : design_(design_for(session, verb, !from.front().empty())), path_(write) {
  for (const std::string& file : from) {
    if (!file.empty() && file != "-") outputs_.reads(file);
  }
  json_ = outputs_.open("--json", json);
  write_ = outputs_.open("--write", write);
}

void Bench::finish(const std::string& text, nlohmann::ordered_json result,
                   const std::vector<Change>& changes) {
  result["changes"] = report_json(changes);
  outputs_.say(text + changes_told(changes));
  if (json_ != nullptr) json_->write(files::json_text(result));
  outputs_.commit();
}

std::string Bench::changes_told(const std::vector<Change>& changes) {
  if (changes.empty()) {
    if (write_ != nullptr) {
      throw std::invalid_argument(
          fmt::format("--write {}: nothing was found that design {} has a key for; see the notes",
                      path_, design_.design.name));
    }
    return "";
  }
  const std::string list = changes_text(changes);
  if (write_ == nullptr) return "for the design file (--write FILE writes it):\n" + list;
  const std::string name = std::filesystem::path(path_).stem().string();
  write_->write(changed_design(design_.design.path, name, changes,
                               design::read_registers(repository() + "/rtl/registers.toml")));
  return fmt::format(
      "{}: {} with\n{}`feltgate design {}` looks at it; to build it, put it into rtl/designs and "
      "run ./feltgate generate\n",
      path_, design_.design.name, list, path_);
}

}  // namespace feltgate::host
