// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board's values, arming and stream. Documentation: docs/host.md
#include "host/host_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

#include "feltgate/generated/engine.hpp"
#include "feltgate/generated/link.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/nearest.hpp"

namespace feltgate::host {

namespace {

using C = Map::C;
using M = LinkMap;

constexpr double arm_patience_s = 0.5;   ///< without a self-test
constexpr double test_patience_s = 3.0;  ///< with one
constexpr int wire_bits_per_byte = 10;
constexpr double most_of_wire = 0.8;

void rest(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

}  // namespace

bool Tick::has(const Quantity& q) const { return q.word >= 0 && (mask >> q.word & 1) != 0; }

std::uint32_t Tick::word(const Quantity& q) const {
  if (!has(q)) return 0;
  const unsigned below = mask & ((1u << q.word) - 1u);
  return words[static_cast<std::size_t>(words_in(below))];
}

Device::Device(Link& link, const BoardInfo& board, design::Elaborated design)
    : link_(link), board_(board), design_(std::move(design)), quantities_(design_) {
  command("thaw");  // a host that ended between freeze and thaw left the snapshot frozen
}

Tick Device::tick() {
  command("freeze");
  const int words = M::read_words;
  const std::vector<std::uint32_t> port = link_.read(design::snapshot_base, words);
  command("thaw");
  Tick t;
  t.mask = static_cast<std::uint16_t>((1u << quantities_.words()) - 1);
  t.words.resize(static_cast<std::size_t>(quantities_.words()));
  for (const Quantity& q : quantities_.all()) {
    if (q.kind != Quantity::Kind::snapshot) continue;
    t.words[static_cast<std::size_t>(q.word)] =
        port.at(static_cast<std::size_t>(q.address - design::snapshot_base));
  }
  t.time_s = t.value(quantities_.find("time"));
  return t;
}

SetResult Device::set(const Setting& setting) {
  const Quantity& q = *setting.of;
  const std::uint32_t status = link_.write(q.address, setting.word);
  if (q.name == "watchdog_ticks") watchdog_s_ = 0;
  SetResult r;
  r.setting = setting;
  r.refused = quantities_.find("status.refused").raw_of(status) != 0;
  r.kept = q.raw_of(link_.read(q.address)) == q.raw_of(setting.word);
  return r;
}

std::uint32_t Device::bit_of(const std::string& control, const std::string& field) const {
  return 1u << design_.registers.control_bit(control, field);
}

void Device::command(const std::string& field) {
  link_.write(C::command, bit_of("command", field));
}

int Device::scene_number(const std::string& scene) const {
  const std::vector<std::string>& built = design_.design.scenes;
  if (std::find(built.begin(), built.end(), scene) != built.end()) {
    return design_.registers.scene_number(scene);
  }
  throw std::invalid_argument(
      fmt::format("scene \"{}\" is not built in design {}; {}choose one of {}", scene,
                  design_.design.name, config::did_you_mean(scene, built), fmt::join(built, ", ")));
}

bool Device::host_has_the_say() { return get("control.host") != 0; }

bool Device::armed(const Tick& tick) const {
  return tick.value(quantities_.find("status.armed")) != 0;
}

std::string Device::scene_name(const Tick& tick) const {
  const auto number = static_cast<int>(tick.value(quantities_.find("status.scene")));
  for (const design::Scene& s : design_.registers.scenes) {
    if (s.number == number) return s.name;
  }
  return fmt::format("scene {}", number);
}

std::string Device::cause(const std::vector<design::Cause>& causes, int number) const {
  for (const design::Cause& c : causes) {
    if (c.number == number) return c.name;
  }
  return fmt::format("number {}", number);
}

std::string Device::fault_names(const Tick& tick) const {
  const auto seen = static_cast<unsigned>(tick.value(quantities_.find("faults.seen")));
  std::string text;
  for (int n = 1; n < 16; ++n) {
    if ((seen >> n & 1u) == 0) continue;
    text += (text.empty() ? "" : ", ") + cause(design_.registers.faults, n);
  }
  return text;
}

std::string Device::first_fault(const Tick& tick) const {
  const auto first = static_cast<int>(tick.value(quantities_.find("faults.first")));
  return first == 0 ? "" : cause(design_.registers.faults, first);
}

std::string Device::limit_names(const Tick& tick) const {
  const auto limits = static_cast<unsigned>(tick.value(quantities_.find("status.limits")));
  std::string text;
  for (const design::Cause& c : design_.registers.limits) {
    if ((limits >> c.number & 1u) != 0) text += (text.empty() ? "" : ", ") + c.name;
  }
  return text;
}

std::vector<std::string> Device::in_words(const Tick& tick) const {
  const auto value = [&](const char* name) {
    return static_cast<unsigned>(tick.value(quantities_.find(name)));
  };
  std::vector<std::string> lines;
  const unsigned seen = value("faults.seen"), limits = value("status.limits");
  for (const design::Cause& c : design_.registers.faults) {
    if ((seen >> c.number & 1u) == 0) continue;
    const bool first = static_cast<int>(value("faults.first")) == c.number;
    lines.push_back(fmt::format("fault {}{}: {}", c.name, first ? " (the first)" : "", c.doc));
  }
  for (const design::Cause& c : design_.registers.limits) {
    if ((limits >> c.number & 1u) != 0) {
      lines.push_back(fmt::format("limit {}: {}", c.name, c.doc));
    }
  }
  if (value("status.unkicked") != 0) {
    lines.emplace_back("arming waits for a host that kicks the watchdog: arm --hold");
  }
  if (value("status.encoder_error") != 0) {
    lines.push_back(fmt::format("encoder: {} illegal transitions, {} pulses rejected",
                                tick.word(quantities_.find("encoder")) & 0xffff,
                                tick.word(quantities_.find("encoder")) >> 16));
  }
  const char* const answers[] = {"", "the lever answered the right way", "the lever was held",
                                 "the lever was moving"};
  if (value("status.self_test") != 0) {
    lines.push_back(fmt::format("self-test: {}", answers[value("status.self_test") & 3]));
  }
  return lines;
}

void Device::refuse_to_arm(const Tick& t, const std::string& what) {
  disarm();
  std::string why;
  for (const std::string& line : in_words(t)) {
    if (line.rfind("limit", 0) != 0) why += "\n  " + line;
  }
  if (board_.has_engine && scene_name(t) == "law") {
    const std::uint32_t status = link_.read(static_cast<int>(M::engine) + EngineMap::H::status);
    if ((status >> EngineMap::S::status_crc_good & 1u) == 0) {
      why += "\n  law: none was loaded whole, its CRC does not hold; load one: law FILE";
    }
  }
  throw Refused(what + why);
}

void Device::arm(const std::string& scene, bool watched, const std::function<bool()>& go_on) {
  const Tick before = tick();
  const int number = scene.empty()
                         ? static_cast<int>(before.value(quantities_.find("status.scene")))
                         : scene_number(scene);
  if (!fault_names(before).empty()) {
    throw Refused(
        fmt::format("cannot arm: fault {} is latched; see info, mend its cause, then clear",
                    fault_names(before)));
  }
  const std::uint32_t control = link_.read(C::control);
  const std::uint32_t others =
      control & ~((1u << C::control_arm) | (0xfu << C::control_scene)) & 0x7fffu;
  const std::uint32_t request =
      others | 1u << C::control_host | static_cast<std::uint32_t>(number) << C::control_scene;
  link_.write(C::control, request);  // the request must rise
  if (watched) kick();
  link_.write(C::control, request | 1u << C::control_arm);
  const double kick_every_s = watchdog_s() / 4;
  Deadline next_kick = within(kick_every_s);
  const Deadline ordinary = within(arm_patience_s), last = within(test_patience_s);
  for (;;) {
    const Tick now = tick();
    const bool testing = now.value(quantities_.find("status.testing")) != 0;
    if (!fault_names(now).empty()) refuse_to_arm(now, "arming ended in a fault; the motor is off");
    if (armed(now) && !testing) return;
    if (HostClock::now() > (testing ? last : ordinary)) {
      refuse_to_arm(now, fmt::format("the motor did not arm within {:g} s; is the stop pressed?",
                                     testing ? test_patience_s : arm_patience_s));
    }
    if (!go_on()) {
      disarm();
      return;
    }
    if (watched && HostClock::now() >= next_kick) {
      kick();
      next_kick = within(kick_every_s);
    }
    rest(0.001);
  }
}

void Device::disarm() {
  const std::uint32_t control = link_.read(C::control);
  link_.write(C::control, (control | 1u << C::control_host) & ~(1u << C::control_arm));
}

void Device::stop() { command("stop"); }

void Device::clear_faults() {
  if (host_has_the_say()) disarm();
  command("clear_faults");
  rest(2 / board_.tick_hz() + 0.001);
  const Tick now = tick();
  if (!fault_names(now).empty()) {
    std::string why;
    for (const std::string& line : in_words(now)) why += "\n  " + line;
    throw Refused(
        "the faults stay: the cause still stands, or the panel asks to arm; mend it first" + why);
  }
}

void Device::set_zero() { command("set_zero"); }

void Device::kick() { command("kick"); }

void Device::select(const std::string& scene) {
  const int number = scene_number(scene);
  const std::uint32_t control = link_.read(C::control);
  const bool host = (control >> C::control_host & 1u) != 0;
  if (!host && armed(tick())) {
    throw Refused(
        "the panel has armed the motor and chooses the scene; disarm it there first, then the host "
        "can take the say");
  }
  const std::uint32_t kept = host ? control : control & ~(1u << C::control_arm);
  link_.write(C::control, (kept & ~(0xfu << C::control_scene)) | 1u << C::control_host |
                              static_cast<std::uint32_t>(number) << C::control_scene);
}

double Device::watchdog_s() {
  if (watchdog_s_ == 0) watchdog_s_ = get("watchdog_ticks") / board_.tick_hz();
  return watchdog_s_;
}

void Device::stream(std::uint16_t mask, std::uint32_t period) {
  if (!board_.has_stream) {
    throw Refused("this board's link is built without a stream; only get, set and capture work");
  }
  link_.write(M::A::stream_period, 0);
  if (period == 0) return;
  while (link_.stream(HostClock::now())) {
  }
  stream_tick_.reset();
  stream_time_s_ = 0;
  link_.write(M::A::stream_words, mask);
  link_.write(M::A::stream_period, period);
}

std::optional<Tick> Device::streamed(Deadline deadline) {
  auto frame = link_.stream(deadline);
  if (!frame) return {};
  Tick t;
  t.mask = frame->mask;
  t.words = std::move(frame->words);
  t.lost = frame->lost;
  const std::uint32_t now = t.word(quantities_.find("tick"));
  // The counter wraps, its difference does not.
  if (stream_tick_) stream_time_s_ += (now - *stream_tick_) / board_.tick_hz();
  stream_tick_ = now;
  t.time_s = stream_time_s_;
  return t;
}

std::uint32_t Device::stream_dropped() { return link_.read(M::A::stream_dropped); }

std::uint32_t Device::shortest_period(std::uint16_t mask, int baud) const {
  const unsigned with_tick = mask | 1u << quantities_.find("tick").word;
  const int bytes = 4 + 4 * words_in(with_tick) + 4 + 2;
  const double seconds = bytes * wire_bits_per_byte / (most_of_wire * baud);
  return static_cast<std::uint32_t>(std::ceil(seconds * board_.tick_hz()));
}

}  // namespace feltgate::host
