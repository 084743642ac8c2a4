// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board's values, arming and stream. Documentation: docs/host.md
#include "host/host_device.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "design/generate.hpp"
#include "feltgate/axes_ports.hpp"
#include "feltgate/generated/engine.hpp"
#include "feltgate/generated/link.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/link_view.hpp"
#include "feltgate/nearest.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::host {

namespace {

using M = LinkMap;

std::uint32_t field(std::uint32_t word, int bit, int width) {
  return word >> bit & ((1u << width) - 1);
}

}  // namespace

std::string BoardInfo::board_name() const {
  switch (board) {
    case 0:
      return "no board of this project";
    case 1:
      return "DE0-Nano";
    case 2:
      return "ULX3S";
    case 3:
      return "Tang Nano 9K";
    default:
      return fmt::format("board {}", board);
  }
}

BoardInfo read_board(Link& link) {
  const std::vector<std::uint32_t> w = link.read(M::A::identity, M::A::inputs - M::A::identity + 1);
  const auto at = [&w](int address) {
    return w[static_cast<std::size_t>(address - M::A::identity)];
  };
  if (at(M::A::identity) != M::identity) {
    throw std::runtime_error(
        fmt::format("{}: no feltgate; the board calls itself 0x{:08x} instead of 0x{:08x}",
                    link.name(), at(M::A::identity), M::identity));
  }
  BoardInfo b;
  b.major = static_cast<int>(at(M::A::version) >> 16);
  b.minor = static_cast<int>(at(M::A::version) & 0xffff);
  if (b.major != static_cast<int>(M::version >> 16)) {
    throw std::runtime_error(fmt::format(
        "{}: its link has version {}.{}, this host knows {}.x; build the board's file and the host "
        "from one version",
        link.name(), b.major, b.minor, M::version >> 16));
  }
  const std::uint32_t features = at(M::A::features);
  const auto has = [features](int bit) { return (features >> bit & 1u) != 0; };
  b.design_crc = at(M::A::design_crc);
  b.clock_hz = at(M::A::clock_hz);
  b.clocks_per_tick = std::max(1, static_cast<int>(at(M::A::clocks_per_tick)));
  b.simulated = has(M::B::features_simulated);
  b.has_capture = has(M::B::features_capture);
  b.has_stream = has(M::B::features_stream);
  b.has_engine = has(M::B::features_engine);
  b.capture_rows =
      1 << std::min(16u, field(features, M::B::features_rows_log2, M::B::features_rows_log2_width));
  b.capture_columns =
      static_cast<int>(field(features, M::B::features_columns, M::B::features_columns_width));
  b.frames_good = at(M::A::frames_good);
  b.frames_bad = at(M::A::frames_bad);
  b.board = static_cast<int>(at(M::A::board));
  b.inputs = at(M::A::inputs);
  return b;
}

KnownDesign read_known_design(const std::string& root, const std::string& path) {
  design::Design read = design::read_design(path);
  read.allow_coarse = true;  // the design is already in a board
  KnownDesign known;
  known.design = design::elaborate(read, design::read_registers(root + "/rtl/registers.toml"));
  known.crc = design::design_crc(known.design);
  return known;
}

std::optional<KnownDesign> design_by_crc(const std::string& root, std::uint32_t crc) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(root + "/rtl/designs")) {
    if (entry.path().extension() == ".toml") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  for (const std::string& path : paths) {
    try {
      KnownDesign known = read_known_design(root, path);
      if (known.crc == crc) return known;
    } catch (const config::ConfigError&) {
      // An unfinished file of somebody must not hide the board's design.
    }
  }
  return {};
}

namespace {

using C = Map::C;

constexpr double arm_patience_s = 0.5;   ///< without a self-test
constexpr double test_patience_s = 3.0;  ///< with one
constexpr int fewest_looks = 3;          ///< at the board, however long they take

void rest(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// Axes of the board: of the design, if its link serves them.
int axes_of(Link& link, const design::Elaborated& design) {
  if (design.design.axes == 1) return 1;
  return std::max(1, static_cast<int>(link.read(LinkViewMap::axes)));
}

}  // namespace

bool Tick::has(const Quantity& q) const { return q.word >= 0 && (mask >> q.word & 1) != 0; }

std::uint32_t Tick::word(const Quantity& q) const {
  if (!has(q)) return 0;
  const WordMask below = mask & (Quantities::bit(q) - 1);
  return words[static_cast<std::size_t>(words_in(below))];
}

Device::Device(Link& link, const BoardInfo& board, design::Elaborated design)
    : link_(link),
      board_(board),
      design_(std::move(design)),
      quantities_(design_, axes_of(link, design_)) {
  for (int k = 0; axes() > 1 && k < quantities_.words(); ++k) view_.push_back(k);
  command("thaw");  // a host that ended between freeze and thaw left the snapshot frozen
}

Tick Device::tick() {
  std::vector<std::uint32_t> port;
  for (int axis = 0; axis < axes(); ++axis) {
    command("freeze", axis);
    const auto of_axis = link_.read(design::snapshot_base + axis * axes_stride, M::read_words);
    command("thaw", axis);
    port.insert(port.end(), of_axis.begin(), of_axis.end());
  }
  Tick t;
  const int words = quantities_.words() * axes();
  t.mask = (WordMask{1} << words) - 1;
  t.words.resize(static_cast<std::size_t>(words));
  for (const Quantity& q : quantities_.all()) {
    if (q.kind != Quantity::Kind::snapshot) continue;
    const int axis = q.word / quantities_.words(),
              slot = q.address % axes_stride - design::snapshot_base;
    t.words[static_cast<std::size_t>(q.word)] =
        port.at(static_cast<std::size_t>(axis * static_cast<int>(M::read_words) + slot));
  }
  t.time_s = t.value(quantities_.find("time"));
  return t;
}

SetResult Device::set(const Setting& setting) {
  const Quantity& q = *setting.of;
  const std::uint32_t status = link_.write(q.address, setting.word);
  if (q.name.rfind("watchdog_ticks", 0) == 0) watchdog_s_ = 0;
  SetResult r;
  r.setting = setting;
  r.refused = quantities_.find("status.refused").raw_of(status) != 0;
  r.saturated = quantities_.find("status.saturated").raw_of(status) != 0;
  r.kept = q.raw_of(link_.read(q.address)) == q.raw_of(setting.word);
  return r;
}

std::uint32_t Device::bit_of(const std::string& control, const std::string& field) const {
  return 1u << design_.registers.control_bit(control, field);
}

void Device::command(const std::string& field) {
  for (int axis = 0; axis < axes(); ++axis) command(field, axis);
}

void Device::command(const std::string& field, int axis) {
  link_.write(C::command + axis * axes_stride, bit_of("command", field));
}

std::uint32_t Device::control(int axis) { return link_.read(C::control + axis * axes_stride); }

void Device::control(int axis, std::uint32_t word) {
  link_.write(C::control + axis * axes_stride, word);
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
  std::string text;
  for (int axis = 0; axis < axes(); ++axis) {
    const Quantity& of = quantities_.find("faults.seen" + Quantities::suffix(axis));
    const auto seen = static_cast<unsigned>(tick.value(of));
    for (int n = 1; n < 16; ++n) {
      if ((seen >> n & 1u) == 0) continue;
      text += (text.empty() ? "" : ", ") + cause(design_.registers.faults, n);
      if (axes() > 1) text += fmt::format(" of axis {}", axis);
    }
  }
  return text;
}

std::string Device::first_fault(const Tick& tick) const {
  std::string text;
  for (int axis = 0; axis < axes(); ++axis) {
    const auto first =
        static_cast<int>(tick.value(quantities_.find("faults.first" + Quantities::suffix(axis))));
    if (first == 0) continue;
    text = cause(design_.registers.faults, first);
    if (text != "axis") break;  // else another axis is the culprit
  }
  return text;
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
  std::vector<std::string> lines;
  for (int axis = 0; axis < axes(); ++axis) {
    for (const std::string& line : words_of_axis(tick, axis)) {
      lines.push_back(axes() == 1 ? line : fmt::format("{} (axis {})", line, axis));
    }
  }
  return lines;
}

std::vector<std::string> Device::words_of_axis(const Tick& tick, int axis) const {
  const auto value = [&](const char* name) {
    return static_cast<unsigned>(tick.value(quantities_.find(name + Quantities::suffix(axis))));
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
  for (const char* sensor : {"faults.current", "faults.absolute"}) {
    if (value(sensor) == 0) continue;
    lines.push_back(
        fmt::format("sensor: {} is {}: {}", sensor, value(sensor), quantities_.find(sensor).doc));
  }
  if (value("status.unkicked") != 0) {
    lines.emplace_back("arming waits for a host that kicks the watchdog: arm --hold");
  }
  if (value("status.encoder_error") != 0) {
    lines.push_back(fmt::format("encoder: {} illegal transitions, {} pulses rejected",
                                value("encoder") & 0xffff, value("encoder") >> 16));
  }
  const char* const answers[] = {"", "the lever answered the right way", "the lever was held",
                                 "the lever was moving"};
  if (value("status.self_test") != 0) {
    lines.push_back(fmt::format("self-test: {}", answers[value("status.self_test") & 3]));
  }
  return lines;
}

bool Device::sensors_ready(const Tick& t) const {
  double waits = 0;
  for (int axis = 0; axis < axes(); ++axis) {
    for (const char* name :
         {"faults.current", "faults.absolute", "status.driver_fault", "status.current_missing"}) {
      waits += t.value(quantities_.find(name + Quantities::suffix(axis)));
    }
  }
  return waits == 0;
}

void Device::refuse_to_arm(const Tick& t, const std::string& what) {
  if (host_has_the_say()) disarm();
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
  Tick before = tick();
  const int number = scene.empty()
                         ? static_cast<int>(before.value(quantities_.find("status.scene")))
                         : scene_number(scene);
  if (!fault_names(before).empty()) {
    throw Refused(
        fmt::format("cannot arm: fault {} is latched; see info, mend its cause, then clear",
                    fault_names(before)));
  }
  // A request waits 20 ms for a sensor that starts, and is refused by one that is not there.
  const Deadline started = within(arm_patience_s);
  for (int looks = 1; !sensors_ready(before); ++looks) {
    if (looks > fewest_looks && HostClock::now() > started) {
      refuse_to_arm(before,
                    "the motor was not asked to arm: a sensor is not ready; mend it, then clear");
    }
    if (!go_on()) return;
    rest(0.001);
    before = tick();
  }
  std::vector<HostWrite> requests;
  for (int axis = 0; axis < axes(); ++axis) {
    const std::uint32_t others =
        control(axis) & ~((1u << C::control_arm) | (0xfu << C::control_scene)) & 0x7fffu;
    const std::uint32_t low =
        others | 1u << C::control_host | static_cast<std::uint32_t>(number) << C::control_scene;
    control(axis, low);  // the request must rise
    requests.push_back({C::control + axis * axes_stride, low | 1u << C::control_arm});
  }
  if (watched) kick();
  link_.write_all(requests, [](double) {});  // the axes wait 20 ms for each other
  const double kick_every_s = watchdog_s() / 4;
  Deadline next_kick = within(kick_every_s);
  const Deadline ordinary = within(arm_patience_s), last = within(test_patience_s);
  for (int looks = 1;; ++looks) {
    const Tick now = tick();
    const bool testing = now.value(quantities_.find("status.testing")) != 0;
    if (!fault_names(now).empty()) refuse_to_arm(now, "arming ended in a fault; the motor is off");
    if (armed(now) && !testing) return;
    // On a slow simulated board a look alone may take longer than that.
    if (looks > fewest_looks && HostClock::now() > (testing ? last : ordinary)) {
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
  for (int axis = 0; axis < axes(); ++axis) {
    control(axis, (control(axis) | 1u << C::control_host) & ~(1u << C::control_arm));
  }
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
  const bool host = host_has_the_say();
  if (!host && armed(tick())) {
    throw Refused(
        "the panel has armed the motor and chooses the scene; disarm it there first, then the host "
        "can take the say");
  }
  for (int axis = 0; axis < axes(); ++axis) {
    const std::uint32_t now = control(axis), kept = host ? now : now & ~(1u << C::control_arm);
    control(axis, (kept & ~(0xfu << C::control_scene)) | 1u << C::control_host |
                      static_cast<std::uint32_t>(number) << C::control_scene);
  }
}

double Device::watchdog_s() {
  double least = 0;
  for (int axis = 0; watchdog_s_ == 0 && axis < axes(); ++axis) {
    const double ticks = get("watchdog_ticks" + Quantities::suffix(axis));
    least = axis == 0 ? ticks : std::min(least, ticks);
    if (axis + 1 == axes()) watchdog_s_ = least / board_.tick_hz();
  }
  return watchdog_s_;
}

// A board's stream, and the view that shows words of several axes to stream and capture.

namespace {

constexpr int wire_bits_per_byte = 10;
constexpr double most_of_wire = 0.8;

}  // namespace

std::uint16_t Device::show(WordMask words) {
  if (view_.empty()) return static_cast<std::uint16_t>(words);
  const int room = quantities_.words(), tick = quantities_.find("tick").word;
  unsigned mask = 0;
  int slot = 0;
  for (int word = 0; word < room * axes(); ++word) {
    if ((words >> word & 1) == 0) continue;
    if (word == tick) {  // it has its own place
      mask |= 1u << tick;
      continue;
    }
    slot += slot == tick;
    if (slot >= room) {
      throw std::invalid_argument(
          fmt::format("{} words of {} axes are asked for, beside the tick {} have room; leave some "
                      "out",
                      words_in(words), axes(), room - 1));
    }
    view_[static_cast<std::size_t>(slot)] = word;
    link_.write(LinkViewMap::first + slot, LinkViewMap::choice(word / room, word % room));
    mask |= 1u << slot++;
  }
  return static_cast<std::uint16_t>(mask);
}

int Device::slot_of(int word) const {
  const auto found = std::find(view_.begin(), view_.end(), word);
  return found == view_.end() ? word : static_cast<int>(found - view_.begin());
}

Tick Device::shown(std::uint16_t mask, const std::vector<std::uint32_t>& words) const {
  Tick t;
  std::map<int, std::uint32_t> by_word;
  auto next = words.begin();
  for (int slot = 0; slot < quantities_.words() && next != words.end(); ++slot) {
    if ((mask >> slot & 1) == 0) continue;
    by_word[view_.empty() ? slot : view_[static_cast<std::size_t>(slot)]] = *next++;
  }
  for (const auto& [word, value] : by_word) {
    t.mask |= WordMask{1} << word;
    t.words.push_back(value);
  }
  return t;
}

void Device::stream(WordMask mask, std::uint32_t period) {
  if (!board_.has_stream) {
    throw Refused("this board's link is built without a stream; only get, set and capture work");
  }
  link_.write(M::A::stream_period, 0);
  if (period == 0) return;
  const std::uint16_t slots = show(mask);
  while (link_.stream(HostClock::now())) {
  }
  stream_tick_.reset();
  stream_time_s_ = 0;
  link_.write(M::A::stream_words, slots);
  link_.write(M::A::stream_period, period);
}

std::optional<Tick> Device::streamed(Deadline deadline) {
  auto frame = link_.stream(deadline);
  if (!frame) return {};
  Tick t = shown(frame->mask, frame->words);
  t.lost = frame->lost;
  const std::uint32_t now = t.word(quantities_.find("tick"));
  // The counter wraps, its difference does not.
  if (stream_tick_) stream_time_s_ += (now - *stream_tick_) / board_.tick_hz();
  stream_tick_ = now;
  t.time_s = stream_time_s_;
  return t;
}

std::uint32_t Device::stream_dropped() { return link_.read(M::A::stream_dropped); }

std::uint32_t Device::shortest_period(WordMask mask, int baud) const {
  const WordMask with_tick = mask | Quantities::bit(quantities_.find("tick"));
  const int bytes = 4 + 4 * words_in(with_tick) + 4 + 2;
  const double seconds = bytes * wire_bits_per_byte / (most_of_wire * baud);
  return static_cast<std::uint32_t>(std::ceil(seconds * board_.tick_hz()));
}

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
