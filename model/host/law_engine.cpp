// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Loads and controls laws in a board's engine. Documentation: docs/host.md
#include "host/law_engine.hpp"

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "feltgate/axes_ports.hpp"
#include "feltgate/crc32.hpp"
#include "feltgate/generated/engine.hpp"
#include "feltgate/generated/link.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/nearest.hpp"
#include "law/units.hpp"

namespace feltgate::host {

namespace {

using E = EngineMap;
using H = EngineMap::H;

constexpr double commit_patience_s = 1.0;
/// Most attempts to write words until they read back; a line that loses a tenth of all frames needs
/// four.
constexpr int most_rounds = 12;

/// Checks that the image drives no axis that the board does not have.
void require_axes(const law::Image& image, int axes) {
  for (const law::ImageOutput& o : image.outputs) {
    if (o.axis < axes) continue;
    throw std::invalid_argument(fmt::format(
        "law {}: a torque for axis {}, and this board has {}; choose a law of fewer "
        "axes, or a board of a design with more",
        image.name, o.axis, axes == 1 ? "one axis" : fmt::format("the axes 0 to {}", axes - 1)));
  }
}

bool bit(std::uint32_t word, int n) { return (word >> n & 1U) != 0; }

}  // namespace

LawEngine::LawEngine(Device& device) : device_(device) {
  if (device.board().has_engine) return;
  throw Refused(fmt::format(
      "this board's design {} has no engine for laws; build one that has, such as lever_law",
      device.design().design.name));
}

std::vector<std::uint32_t> LawEngine::read(int address, int words) {
  return device_.link().read(EngineMap::port_first + address, words);
}

void LawEngine::write(int address, std::uint32_t word) {
  device_.link().write(EngineMap::port_first + address, word);
}

EngineStatus LawEngine::status() {
  static_assert(H::refused_word == H::status + 1, "read together");
  const std::vector<std::uint32_t> words = read(H::status, 2);
  EngineStatus s;
  s.committing = bit(words[0], E::S::status_committing);
  s.refused = bit(words[0], E::S::status_refused);
  s.crc_busy = bit(words[0], E::S::status_crc_busy);
  s.crc_good = bit(words[0], E::S::status_crc_good);
  s.late = bit(words[0], E::S::status_late);
  s.mailbox_late = bit(words[0], E::S::status_mailbox_late);
  s.overrun = bit(words[0], E::S::status_overrun);
  s.dropped = bit(words[0], E::S::status_dropped);
  s.bank = bit(words[0], E::S::status_bank) ? 1 : 0;
  s.refused_word = static_cast<int>(words[1]);
  return s;
}

LawEngine::Memory LawEngine::read_long(int low, int high, int words) {
  Memory memory;
  const auto lower = read(low, words), upper = read(high, words);
  for (std::size_t n = 0; n < lower.size(); ++n) {
    memory.push_back(std::uint64_t{upper[n]} << 32 | lower[n]);
  }
  return memory;
}

void LawEngine::refuse_while_armed() {
  if (device_.armed(device_.tick())) {
    throw Refused("the motor is armed, and its law is locked: disarm first");
  }
  bool all_ask = true;
  for (int axis = 0; axis < device_.axes(); ++axis) {
    const std::uint32_t control = device_.link().read(Map::C::control + axis * axes_stride);
    all_ask = all_ask && bit(control, Map::C::control_host) && bit(control, Map::C::control_arm);
  }
  if (all_ask) throw Refused("the motor is asked to arm, and its law is locked: disarm first");
}

int LawEngine::bring(const law::Image& image, LoadReport* report,
                     const std::function<void(double)>& progress) {
  std::vector<HostWrite> writes;
  constexpr int base = EngineMap::port_first;
  const auto add_long = [&](const Memory& there, const std::array<std::uint64_t, 512>& wanted,
                            int address) {
    std::optional<std::uint32_t> high;
    for (std::size_t n = 0; n < wanted.size(); ++n) {
      if (there[n] == wanted[n]) continue;
      const auto upper = static_cast<std::uint32_t>(wanted[n] >> 32);
      if (high != upper) writes.push_back({base + H::high, upper});
      high = upper;
      writes.push_back(
          {base + address + static_cast<int>(n), static_cast<std::uint32_t>(wanted[n])});
      ++report->written;
    }
  };
  constexpr int words = 512, ranges = law::Image::lower_base;
  const Memory program = read_long(H::program, H::program_high, words);
  progress(0.15);
  const Memory table = read_long(H::table, H::table_high, words);
  progress(0.3);
  const auto data = read(H::data + ranges, E::data_words - ranges);
  add_long(program, image.program, H::program);
  add_long(table, image.table, H::table);
  for (std::size_t n = 0; n < data.size(); ++n) {
    const auto wanted =
        static_cast<std::uint32_t>(image.data[static_cast<std::size_t>(ranges) + n]);
    if (data[n] == wanted) continue;
    writes.push_back({base + H::data + ranges + static_cast<int>(n), wanted});
    ++report->written;
  }
  device_.link().write_all(writes, [&](double share) { progress(0.3 + 0.6 * share); });
  report->words = 2 * words + static_cast<int>(data.size());
  return static_cast<int>(writes.size());
}

LoadReport LawEngine::load(const law::Image& image, const std::function<void(double)>& progress) {
  if (image.design != device_.design().design.name) {
    throw std::invalid_argument(
        fmt::format("the law was compiled for design {0}, the board has {1}; compile it again: "
                    "`feltgate law {2} --design {1} -o {2}.img`",
                    image.design, device_.design().design.name, image.name));
  }
  require_axes(image, device_.axes());
  refuse_while_armed();
  image_.reset();
  parameters_.reset();
  write(H::run, 0);
  LoadReport report;
  int left = bring(image, &report, progress);
  const int first = left;
  for (; left > 0; left = bring(image, &report, progress)) {
    if (++report.rounds == most_rounds || (report.rounds == 2 && left >= first)) {
      throw Refused(fmt::format(
          "{} words of the law did not stay; does the panel ask to arm? The motor will not arm in "
          "the scene law until one is loaded whole",
          left));
    }
  }
  for (std::size_t t = 0; t < image.threads.size(); ++t) {
    if (!image.threads[t].used) continue;
    write(H::divider0 + static_cast<int>(t), static_cast<std::uint32_t>(image.threads[t].divider));
  }
  write(H::line_base, static_cast<std::uint32_t>(image.line_base));
  write(H::max_age, static_cast<std::uint32_t>(image.max_age_ticks));
  write(H::mailbox_first, static_cast<std::uint32_t>(image.mailbox_first));
  write(H::mailbox_age, static_cast<std::uint32_t>(image.mailbox_age));
  std::vector<law::HostWord> parameters;
  for (int n = 0; n < E::parameter_words; ++n) {
    const auto word = static_cast<std::size_t>(law::Image::parameter_base + n);
    parameters.push_back(
        {H::data + law::Image::parameter_base + n, static_cast<std::uint32_t>(image.data[word])});
  }
  image_ = std::make_unique<law::Image>(image);
  // Each commit fills one of two banks. In the other one a word of the law before may be out of
  // the ranges of this one, and the next set would be refused for it.
  commit(parameters);
  commit(parameters);
  // From here on the board may be armed.
  write(H::crc, law::crc(image));
  std::uint32_t run = 0;
  for (std::size_t t = 0; t < image.threads.size(); ++t) run |= image.threads[t].used << t;
  write(H::run, run);
  refresh();
  progress(1);
  return report;
}

bool LawEngine::holds(const law::Image& image) {
  const int ranges = law::Image::lower_base;
  const auto data = read(H::data + ranges, E::data_words - ranges);
  for (std::size_t n = 0; n < data.size(); ++n) {
    if (static_cast<std::int32_t>(data[n]) != image.data[static_cast<std::size_t>(ranges) + n]) {
      return false;
    }
  }
  for (std::size_t t = 0; t < image.threads.size(); ++t) {
    const int length = image.threads[t].used ? image.threads[t].length : 0;
    if (length == 0) continue;
    const int first = E::thread_words * static_cast<int>(t);
    const Memory there = read_long(H::program + first, H::program_high + first, length);
    if (!std::equal(there.begin(), there.end(), image.program.begin() + first)) return false;
  }
  return true;
}

void LawEngine::attach(const law::Image& image) {
  if (!holds(image)) {
    throw Refused(fmt::format("the board does not run the law {}; load it: law FILE", image.name));
  }
  image_ = std::make_unique<law::Image>(image);
  refresh();
}

void LawEngine::refresh() {
  parameters_ = std::make_unique<law::LoadedParameters>(*image_);
  const int bank = status().bank;
  const auto words =
      read(H::data + law::Image::parameter_base + bank * E::parameter_words, E::parameter_words);
  parameters_->take({words.begin(), words.end()});
}

std::string LawEngine::bare(const std::string& name) const {
  return name.rfind("law.", 0) == 0 ? name.substr(4) : name;
}

const law::ImageWord* LawEngine::find(const std::string& name) const {
  return parameters_ == nullptr ? nullptr : parameters_->find(bare(name));
}

std::vector<const law::ImageWord*> LawEngine::parameters() const {
  std::vector<const law::ImageWord*> all;
  if (image_ == nullptr) return all;
  for (const law::ImageWord& w : image_->words) {
    if (w.formula.empty()) all.push_back(&w);
  }
  return all;
}

double LawEngine::value_in(const law::ImageWord& of, const std::string& text) const {
  double number = 0;
  try {
    number = law::amount_in(text, of.unit);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", of.name, error.what()));
  }
  parameters_->check(of.name, number);
  return number;
}

double LawEngine::get(const std::string& name) {
  if (image_ == nullptr) throw std::invalid_argument("no law of this host is on the board");
  refresh();
  if (find(name) == nullptr) parameters_->check(bare(name), 0);  // its error names the choices
  return parameters_->value(bare(name));
}

std::vector<double> LawEngine::set(const std::vector<std::pair<std::string, double>>& values) {
  if (image_ == nullptr) throw std::invalid_argument("no law of this host is on the board");
  if (values.empty()) return {};
  std::map<std::string, double> all;
  for (const auto& [name, value] : values) all[bare(name)] = value;
  for (const auto& [name, value] : all) parameters_->check(name, value);
  refresh();
  std::vector<law::HostWord> writes = parameters_->set(all);
  writes.pop_back();  // commit() writes this one
  try {
    commit(writes);
  } catch (...) {
    refresh();
    throw;
  }
  std::vector<double> rounded;
  for (const auto& [name, value] : values) rounded.push_back(parameters_->value(bare(name)));
  return rounded;
}

std::vector<HostWrite> LawEngine::update(const std::map<std::string, double>& values) {
  if (image_ == nullptr) throw std::invalid_argument("no law of this host is on the board");
  std::map<std::string, double> all;
  for (const auto& [name, value] : values) all[bare(name)] = value;
  std::vector<HostWrite> writes;
  for (const law::HostWord& w : parameters_->set(all)) {
    writes.push_back({EngineMap::port_first + w.address, w.data});
  }
  return writes;
}

void LawEngine::commit(const std::vector<law::HostWord>& writes) {
  const Deadline end = within(commit_patience_s);
  const auto wait = [&](const char* what) {
    EngineStatus s = status();
    // A long run still uses the old set.
    while (s.committing) {
      if (HostClock::now() > end) throw Refused(what);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      s = status();
    }
    return s;
  };
  constexpr std::uint32_t commits = 1, forgets = 2;  // bits of H::commit
  const auto complete = [&](const EngineStatus& s) {
    if (!s.dropped) return;
    write(H::commit, forgets);
    throw Refused(
        "a word for the engine was dropped: another program commits sets of parameters, or loads a "
        "law, at the same time; end that one, and set the parameters again");
  };
  if (wait("the engine is still busy with the commit before; does the law run?").dropped) {
    write(H::commit, forgets);
  }
  for (const law::HostWord& w : writes) write(w.address, w.data);
  complete(status());
  write(H::commit, commits);
  const EngineStatus s = wait("the engine does not finish the commit");
  complete(s);
  if (!s.refused) return;
  std::string name = fmt::format("word {}", s.refused_word);
  for (const law::ImageWord& w : image_->words) {
    if (w.word == s.refused_word) name = w.name;
  }
  throw Refused(fmt::format("the board refused the set: {} is out of its range", name));
}

std::optional<LawEvent> LawEngine::event() {
  static_assert(H::events_lost == H::event_count + 4, "read together");
  const std::vector<std::uint32_t> words = read(H::event_count, 5);
  events_lost_ = words[4];
  if (words[0] == 0) return {};
  // A read has no effect, so that it can be repeated; this write removes the event.
  write(H::event_tick, 0);
  LawEvent e;
  e.number = static_cast<int>(words[1]);
  e.tick = words[3];
  e.name = fmt::format("event {}", e.number);
  e.value = static_cast<std::int32_t>(words[2]);
  if (image_ == nullptr) return e;
  for (const law::ImageEvent& known : image_->events) {
    if (known.number != e.number) continue;
    e.name = known.name;
    e.value *= known.scale;
  }
  return e;
}

// Images of laws that this host has loaded, found by the words that a board shows of them.

namespace {

namespace fs = std::filesystem;

/// Key from ranges and constants, which two requests read.
std::uint32_t key_of(const std::vector<std::uint32_t>& words) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint32_t w : words) {
    for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<std::uint8_t>(w >> 8 * k));
  }
  return crc32(bytes.data(), bytes.size());
}

}  // namespace

std::string laws_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') return std::string(cache) + "/feltgate/laws";
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? std::string(home) + "/.cache/feltgate/laws" : "";
}

void keep_law(const std::string& folder, const law::Image& image) {
  if (folder.empty()) return;
  const std::vector<std::uint32_t> words(image.data.begin() + law::Image::lower_base,
                                         image.data.end());
  const fs::path path =
      fs::path(folder) / fmt::format("{:08x}-{:08x}.img", key_of(words), law::crc(image));
  const fs::path part = path.string() + fmt::format(".{}", getpid());
  std::error_code error;
  fs::create_directories(folder, error);
  {
    std::ofstream out(part);
    out << law::text(image);
    if (!out.flush()) {
      fs::remove(part, error);
      return;
    }
  }
  fs::rename(part, path, error);
}

bool LawEngine::recognise(const std::string& folder) {
  const int ranges = law::Image::lower_base;
  const std::string key = fmt::format(
      "{:08x}-", key_of(read(EngineMap::H::data + ranges, EngineMap::data_words - ranges)));
  std::error_code error;
  std::vector<fs::directory_entry> found;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.rfind(key, 0) == 0 && at->path().extension() == ".img") found.push_back(*at);
  }
  const auto newer = [](const fs::directory_entry& a, const fs::directory_entry& b) {
    std::error_code unread;
    return a.last_write_time(unread) > b.last_write_time(unread);
  };
  std::sort(found.begin(), found.end(), newer);
  for (const fs::directory_entry& entry : found) {
    try {
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      const law::Image image = law::read_image(text.str());
      if (image.design != device_.design().design.name || !holds(image)) continue;
      image_ = std::make_unique<law::Image>(image);
      refresh();
      return true;
    } catch (const std::invalid_argument&) {
      // The file is damaged or from another version of this program; another file may match.
    }
  }
  return false;
}

namespace {

/// The board's count of frames has 16 bits.
constexpr std::uint64_t most_unchecked = 8192;
constexpr std::uint32_t forgets = 2;  ///< bit of H::commit: the mark of a dropped word

}  // namespace

MailboxBurst::MailboxBurst(Device& device, LawEngine& engine) : device_(device), engine_(engine) {
  device_.link().taken();
}

bool MailboxBurst::send(const std::map<std::string, double>& values, Deadline deadline) {
  if (HostClock::now() > deadline) {
    ++counts_.late;
    return false;
  }
  const std::vector<HostWrite> writes = engine_.update(values);
  device_.link().post(writes);
  ++counts_.sent;
  unchecked_ += writes.size();
  if (unchecked_ >= most_unchecked) check();
  return true;
}

const BurstCounts& MailboxBurst::check() {
  const Link::Taken t = device_.link().taken();
  counts_.lost_frames += t.sent - std::min(t.sent, t.taken);
  unchecked_ = 0;
  if (engine_.status().dropped) {
    ++counts_.dropped;
    device_.link().write(EngineMap::port_first + EngineMap::H::commit, forgets);
  }
  return counts_;
}

}  // namespace feltgate::host
