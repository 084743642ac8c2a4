// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board whose design is known: values in units by name, arming, stream. Documentation:
// docs/host.md
#pragma once

#include <bitset>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/board_info.hpp"
#include "host/link.hpp"
#include "host/quantity.hpp"

namespace feltgate::host {

/// Words of a capture whose mask this is: its set bits.
inline int words_in(unsigned mask) { return static_cast<int>(std::bitset<32>(mask).count()); }

/// The board refused: a fault stands, the motor is armed, arming did not happen. The text says why
/// and what to do.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Words of one tick, those of `mask`.
struct Tick {
  std::uint16_t mask = 0;
  std::vector<std::uint32_t> words;  ///< lowest bit of the mask first
  double time_s = 0;                 ///< of a stream: since its first tick
  unsigned lost = 0;                 ///< of a stream: frames missing before this one

  bool has(const Quantity& q) const;
  /// The word that the quantity lies in; 0 where the mask has it not.
  std::uint32_t word(const Quantity& q) const;
  double value(const Quantity& q) const { return q.value_of(word(q)); }
};

/// What became of a set().
struct SetResult {
  Setting setting;
  bool refused = false;  ///< the motor is armed, and the parameter holds while it is
  bool kept = false;     ///< read back as written
};

/// A board over a link. One thread, one request at a time.
class Device {
 public:
  /// `link` outlives this; `design` is the board's (BoardInfo::design_crc).
  Device(Link& link, const BoardInfo& board, design::Elaborated design);

  Link& link() { return link_; }
  const BoardInfo& board() const { return board_; }
  const design::Elaborated& design() const { return design_; }
  const Quantities& quantities() const { return quantities_; }

  // ---- values -------------------------------------------------------------------------------
  /// In the quantity's unit. Several reads are of several ticks; tick() is of one.
  double get(const std::string& name) { return get(quantities_.find(name)); }
  double get(const Quantity& q) { return q.value_of(word(q)); }
  /// The whole word at its address.
  std::uint32_t word(const Quantity& q) { return link_.read(q.address); }
  /// All words of the snapshot, of one tick.
  Tick tick();
  /// Writes a parameter and reads it back. What does not fit is refused by quantities().setting().
  SetResult set(const Setting& setting);
  SetResult set(const std::string& name, double value) {
    return set(quantities_.setting(quantities_.find(name), value));
  }

  // ---- what the motor does ------------------------------------------------------------------
  /// Takes the say from the panel and arms; with `watched` the watchdog is kicked before, so that
  /// kick() must follow within watchdog_s() from then on. `scene` empty: the one that is chosen.
  /// Waits for the self-test, as long as that takes, kicking meanwhile; `go_on` false ends the wait
  /// (and disarms). Throws Refused where a fault stands or comes, std::invalid_argument for a scene
  /// that the design has not.
  void arm(
      const std::string& scene, bool watched,
      const std::function<bool()>& go_on = [] { return true; });
  /// Takes the request to arm away; the motor is off at the end of the tick.
  void disarm();
  /// The fault stop: gates off within clocks, latched until clear_faults().
  void stop();
  /// Disarms where the host has the say, then forgets faults and encoder errors. Throws Refused
  /// where one stays or comes back at once.
  void clear_faults();
  /// The position becomes 0.
  void set_zero();
  /// Feeds the watchdog, and wakes it the first time; from then on an armed motor needs a kick
  /// every watchdog_s().
  void kick();
  /// Chooses the scene; an armed motor ramps over to it. Throws std::invalid_argument for an
  /// unknown one, Refused while the panel has armed the motor.
  void select(const std::string& scene);
  /// Longest time between two kicks, s; as set when this is first asked.
  double watchdog_s();

  // ---- what it says -------------------------------------------------------------------------
  bool armed(const Tick& tick) const;
  /// Whether arm and scene come from the host.
  bool host_has_the_say();
  std::string scene_name(const Tick& tick) const;
  /// "speed, stop"; nothing without.
  std::string fault_names(const Tick& tick) const;
  std::string first_fault(const Tick& tick) const;
  std::string limit_names(const Tick& tick) const;
  /// A line each: faults in words with what they mean, limits, why it does not arm.
  std::vector<std::string> in_words(const Tick& tick) const;

  // ---- stream -------------------------------------------------------------------------------
  /// From now on the words of `mask` (and the tick counter) every `period` ticks; 0 ends it.
  void stream(std::uint16_t mask, std::uint32_t period);
  /// The oldest tick of the stream that was not taken yet, waiting until `deadline`.
  std::optional<Tick> streamed(Deadline deadline);
  /// Frames that the board had no time on the wire for.
  std::uint32_t stream_dropped();
  /// Shortest period at which all frames of `mask` fit on a wire of `baud`, in ticks; a fifth of
  /// the wire is left for escapes and requests.
  std::uint32_t shortest_period(std::uint16_t mask, int baud) const;

 private:
  std::uint32_t bit_of(const std::string& control, const std::string& field) const;
  void command(const std::string& field);
  int scene_number(const std::string& scene) const;
  std::string cause(const std::vector<design::Cause>& causes, int number) const;
  [[noreturn]] void refuse_to_arm(const Tick& tick, const std::string& what);

  Link& link_;
  BoardInfo board_;
  design::Elaborated design_;
  Quantities quantities_;
  std::optional<std::uint32_t> stream_tick_;
  double stream_time_s_ = 0;
  double watchdog_s_ = 0;
};

}  // namespace feltgate::host
