// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine of a board: laws are loaded into it, their parameters set by name, their events taken.
// Documentation: docs/host.md, docs/laws.md
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/device.hpp"
#include "law/image.hpp"
#include "law/load.hpp"

namespace feltgate::host {

/// What the engine says of itself.
struct EngineStatus {
  bool committing = false;  ///< a commit is under way, or a run still has the set before
  bool refused = false;     ///< the last commit was refused: a word out of its range
  bool crc_busy = false, crc_good = false;  ///< of the last check, at an arming
  bool late = false;                        ///< no fresh torque within max_age
  bool mailbox_late = false;  ///< the law's mailbox was not fed in time: no torque until it is
  bool overrun = false;       ///< a start found its thread still running, since the load
  int bank = 0;               ///< that is in force
  bool dropped =
      false;  ///< a parameter or a commit came while a set was being committed: not taken
  int refused_word = 0;  ///< parameter word 0 to 31 that the last refused commit was refused for
};

/// An event of a law.
struct LawEvent {
  std::uint32_t tick = 0;  ///< in which it came; the counter of the snapshot
  int number = 0;
  std::string name;  ///< "event 3" where the law is not known
  double value = 0;  ///< in SI; the word itself where the law is not known
};

/// What a load did.
struct LoadReport {
  int words = 0;    ///< of the image, that the board holds now
  int written = 0;  ///< that it did not hold before
  int rounds = 0;   ///< of writing: more than one where the line lost some
};

/// The engine of one board. One thread, one request at a time.
class LawEngine {
 public:
  /// `device` outlives this. Throws Refused where the board has no engine.
  explicit LawEngine(Device& device);

  EngineStatus status();

  /// Brings the image in, verifies all of it by reading it back, and starts its threads. Until the
  /// last word the board has a CRC that does not hold, so half an image is never armed. Throws
  /// Refused while the motor is armed or is asked to arm, where the image is of another design, and
  /// where words do not stay; LinkLost. `progress` is called with 0..1.
  LoadReport load(
      const law::Image& image, const std::function<void(double)>& progress = [](double) {});

  /// Whether the board holds this image's program, ranges and constants.
  bool holds(const law::Image& image);
  /// From now on names are those of `image`, values those of the board. Throws Refused where the
  /// board holds something else.
  void attach(const law::Image& image);
  /// Attaches an image of `folder` that the board holds; the image that was loaded last wins.
  /// False where there is none.
  bool recognise(const std::string& folder);
  /// nullptr before load(), attach() or recognise().
  const law::Image* image() const { return image_.get(); }

  /// The parameter of this name, or nullptr; "law.NAME" is NAME.
  const law::ImageWord* find(const std::string& name) const;
  /// All parameters that can be set.
  std::vector<const law::ImageWord*> parameters() const;
  /// A number with an optional unit, in the parameter's unit as its file has it. Throws
  /// std::invalid_argument: no number, a unit of something else, out of its range.
  double value_in(const law::ImageWord& of, const std::string& text) const;
  /// In the parameter's unit, as the board has it. Throws std::invalid_argument for an unknown one.
  double get(const std::string& name);
  /// All of them together, in force with one commit; returns them as rounded to their words. Throws
  /// std::invalid_argument, nothing written, for an unknown name or a value out of its range;
  /// Refused where the board refuses the set.
  std::vector<double> set(const std::vector<std::pair<std::string, double>>& values);

  /// The oldest event that waits; it is taken away.
  std::optional<LawEvent> event();
  /// Events that found no place, since the reset; stays at 255.
  unsigned events_lost() const { return events_lost_; }

 private:
  using Memory = std::vector<std::uint64_t>;

  std::vector<std::uint32_t> read(int address, int words);
  void write(int address, std::uint32_t word);
  Memory read_long(int low, int high, int words);
  void refuse_while_armed();
  /// Writes what differs of `wanted` until it reads back; the words written.
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

/// Where images that were loaded are kept, so that names are known when the port is opened again:
/// $XDG_CACHE_HOME/feltgate/laws, or ~/.cache/feltgate/laws; empty where neither is known.
std::string laws_folder();
/// Keeps an image there; does nothing where it cannot be written, as names are only a convenience.
void keep_law(const std::string& folder, const law::Image& image);

}  // namespace feltgate::host
