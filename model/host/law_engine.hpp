// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine of a board: loads laws, sets their parameters by name, takes their events.
// Documentation: docs/host.md, docs/laws.md
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/host_device.hpp"
#include "law/image.hpp"
#include "law/load.hpp"

namespace feltgate::host {

/// Status of the engine.
struct EngineStatus {
  bool committing = false;  ///< a commit is in progress, or a run still uses the old set
  bool refused = false;     ///< the last commit was refused: a word was out of range
  bool crc_busy = false, crc_good = false;  ///< of the last check, at an arming
  bool late = false;                        ///< no new torque within max_age
  bool mailbox_late = false;  ///< the law's mailbox was not fed in time: no torque until it is
  bool overrun = false;       ///< since the load, a start found its thread still running
  int bank = 0;               ///< the bank in force
  bool dropped = false;       ///< a write during a commit or while locked was lost
  int refused_word = 0;       ///< word 0 to 31 that caused the last refusal
};

/// An event of a law.
struct LawEvent {
  std::uint32_t tick = 0;  ///< tick counter of the snapshot when it occurred
  int number = 0;
  std::string name;  ///< "event 3" if the law is unknown
  double value = 0;  ///< in SI units; the raw word if the law is unknown
};

/// Result of a load.
struct LoadReport {
  int words = 0;    ///< words of the image, which the board now holds
  int written = 0;  ///< words that it did not hold before
  int rounds = 0;   ///< write attempts: more than one if the line lost words
};

/// The engine of one board. Use it from one thread, one request at a time.
class LawEngine {
 public:
  /// `device` must outlive this object. Errors: Refused if the board has no engine.
  explicit LawEngine(Device& device);

  EngineStatus status();

  /// Writes the image, verifies all of it by reading it back, and starts its threads. Before the
  /// last word the board has a wrong CRC, so a partial image is never armed. `progress` is called
  /// with 0..1. Errors: Refused while the motor is armed or asked to arm, for an image of another
  /// design, or if words do not read back; LinkLost.
  LoadReport load(
      const law::Image& image, const std::function<void(double)>& progress = [](double) {});

  /// Whether the board holds this image's program, ranges and constants.
  bool holds(const law::Image& image);
  /// Uses the names of `image` and the values of the board from now on. Errors: Refused if the
  /// board holds something else.
  void attach(const law::Image& image);
  /// Attaches the image in `folder` that the board holds; of several, the one loaded last. Returns
  /// false if there is none.
  bool recognise(const std::string& folder);
  /// nullptr before load(), attach() or recognise().
  const law::Image* image() const { return image_.get(); }

  /// The parameter with this name, or nullptr; "law.NAME" means NAME.
  const law::ImageWord* find(const std::string& name) const;
  /// All parameters that can be set.
  std::vector<const law::ImageWord*> parameters() const;
  /// Converts a number with an optional unit to the parameter's unit in its file. Errors:
  /// std::invalid_argument for no number, a wrong unit, or a value out of range.
  double value_in(const law::ImageWord& of, const std::string& text) const;
  /// Value on the board, in the parameter's unit. Errors: std::invalid_argument for an unknown
  /// name.
  double get(const std::string& name);
  /// Sets several parameters, which come into force with one commit; returns them as rounded to
  /// their words. Errors: std::invalid_argument, with nothing written, for an unknown name or a
  /// value out of range; Refused if the board refuses the set.
  std::vector<double> set(const std::vector<std::pair<std::string, double>>& values);

  /// The writes that set these values with one commit, for Link::post(). Errors:
  /// std::invalid_argument for an unknown name or a value out of range.
  std::vector<HostWrite> update(const std::map<std::string, double>& values);

  /// Takes the oldest waiting event, if any.
  std::optional<LawEvent> event();
  /// Events lost since the reset, because no place was free; stops at 255.
  unsigned events_lost() const { return events_lost_; }

 private:
  using Memory = std::vector<std::uint64_t>;

  std::vector<std::uint32_t> read(int address, int words);
  void write(int address, std::uint32_t word);
  Memory read_long(int low, int high, int words);
  void refuse_while_armed();
  /// Writes the words that differ from `image` until they read back; returns how many.
  int bring(const law::Image& image, LoadReport* report,
            const std::function<void(double)>& progress);
  void commit(const std::vector<law::HostWord>& writes);
  void refresh();
  std::string bare(const std::string& name) const;

  Device& device_;
  std::unique_ptr<law::Image> image_;
  std::unique_ptr<law::LoadedParameters> parameters_;
  unsigned events_lost_ = 0;
};

/// Folder of the images that were loaded, so that names are known when the port is opened again:
/// $XDG_CACHE_HOME/feltgate/laws, or ~/.cache/feltgate/laws; empty if neither is known.
std::string laws_folder();
/// Stores an image there; does nothing if it cannot be written, as names are only a convenience.
void keep_law(const std::string& folder, const law::Image& image);

/// What became of the updates.
struct BurstCounts {
  std::uint64_t sent = 0;         ///< updates that went to the line
  std::uint64_t late = 0;         ///< updates that were not sent, because their time had passed
  std::uint64_t lost_frames = 0;  ///< frames that the board did not take, of all words
  std::uint64_t dropped = 0;      ///< checks that found a word dropped by a busy engine
};

/// Sends updates without waiting for answers, and looks now and then what arrived. An update that
/// is lost leaves the one before in force; if none arrives in time, the law's age ends the torque.
class MailboxBurst {
 public:
  /// `device` and `engine` must outlive this object; the engine's law must be known.
  MailboxBurst(Device& device, LawEngine& engine);

  /// Sets these values with one commit, unless `deadline` has passed. Errors: those of
  /// LawEngine::update(); LinkLost.
  bool send(const std::map<std::string, double>& values, Deadline deadline = Deadline::max());
  /// Asks the board what it took of the updates so far.
  const BurstCounts& check();
  const BurstCounts& counts() const { return counts_; }

 private:
  Device& device_;
  LawEngine& engine_;
  BurstCounts counts_;
  std::uint64_t unchecked_ = 0;  ///< frames since the last check
};

}  // namespace feltgate::host
