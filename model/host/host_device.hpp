// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board whose design is known: values in units by name, arming, stream.
// Documentation: docs/host.md
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

/// Number of words in a capture with this mask: its set bits.
inline int words_in(WordMask mask) { return static_cast<int>(std::bitset<64>(mask).count()); }

/// The board refused: a fault is latched, the motor is armed, or arming failed. The text says why
/// and what to do.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Words of one tick: those in `mask`.
struct Tick {
  WordMask mask = 0;
  std::vector<std::uint32_t> words;  ///< lowest bit of the mask first
  double time_s = 0;                 ///< of a stream: time since its first tick
  unsigned lost = 0;                 ///< of a stream: frames missing before this one

  bool has(const Quantity& q) const;
  /// The word that contains the quantity; 0 if it is not in the mask.
  std::uint32_t word(const Quantity& q) const;
  double value(const Quantity& q) const { return q.value_of(word(q)); }
};

/// Result of a set().
struct SetResult {
  Setting setting;
  bool refused = false;  ///< the motor is armed, and this parameter cannot change then
  bool saturated =
      false;          ///< the word did not fit the board's format: it is now the nearest that does
  bool kept = false;  ///< it reads back as written
};

/// A board over a link. Use it from one thread, one request at a time.
class Device {
 public:
  /// `link` must outlive this object; `design` must be the board's (BoardInfo::design_crc).
  Device(Link& link, const BoardInfo& board, design::Elaborated design);

  Link& link() { return link_; }
  const BoardInfo& board() const { return board_; }
  const design::Elaborated& design() const { return design_; }
  const Quantities& quantities() const { return quantities_; }

  // ---- values -------------------------------------------------------------------------------
  /// A value in the quantity's unit. Several calls read several ticks; tick() reads one.
  double get(const std::string& name) { return get(quantities_.find(name)); }
  double get(const Quantity& q) { return q.value_of(word(q)); }
  /// The whole word at the quantity's address.
  std::uint32_t word(const Quantity& q) { return link_.read(q.address); }
  /// All words of the snapshot, from one tick. Of several axes, each from one tick of its own.
  Tick tick();
  /// Writes a parameter and reads it back. quantities().setting() refuses values that do not fit.
  SetResult set(const Setting& setting);
  SetResult set(const std::string& name, double value) {
    return set(quantities_.setting(quantities_.find(name), value));
  }

  int axes() const { return quantities_.axes(); }

  // ---- what the motors do ------------------------------------------------------------------
  /// Takes control from the panel and arms. With `watched` the watchdog is kicked first, and from
  /// then on kick() must follow within watchdog_s(). `scene` empty: the selected one. Waits for the
  /// self-test as long as it takes, and kicks meanwhile; `go_on` = false ends the wait and disarms.
  /// Errors: Refused if a fault is or becomes latched, or a sensor is not ready;
  /// std::invalid_argument for a scene that the design does not have.
  void arm(
      const std::string& scene, bool watched,
      const std::function<bool()>& go_on = [] { return true; });
  /// Withdraws the request to arm; the motor is off at the end of the tick.
  void disarm();
  /// Fault stop: the gates are off within clocks; latched until clear_faults().
  void stop();
  /// Disarms if the host has control, then clears faults and encoder errors. Errors: Refused if a
  /// fault stays or comes back at once.
  void clear_faults();
  /// Sets the present position to 0.
  void set_zero();
  /// Kicks the watchdog; the first kick enables it. From then on an armed motor needs a kick every
  /// watchdog_s().
  void kick();
  /// Selects the scene; an armed motor ramps to its torque. Errors: std::invalid_argument for an
  /// unknown scene; Refused while the panel has armed the motor.
  void select(const std::string& scene);
  /// Longest time between two kicks, s; read at the first call.
  double watchdog_s();

  // ---- what it says -------------------------------------------------------------------------
  bool armed(const Tick& tick) const;
  /// Whether the host, not the panel, controls arming and scene.
  bool host_has_the_say();
  std::string scene_name(const Tick& tick) const;
  /// Names as in "speed, stop"; empty without a fault.
  std::string fault_names(const Tick& tick) const;
  std::string first_fault(const Tick& tick) const;
  std::string limit_names(const Tick& tick) const;
  /// One line each: faults with their meaning, limits, and why the motor does not arm.
  std::vector<std::string> in_words(const Tick& tick) const;

  // ---- stream -------------------------------------------------------------------------------
  /// Shows these words of any axes to stream and capture. Returns them as their mask of words; the
  /// bit of each is slot_of() it. Errors: std::invalid_argument for more than the view has room
  /// for.
  std::uint16_t show(WordMask words);
  int slot_of(int word) const;
  /// A tick from the words of a mask that show() returned.
  Tick shown(std::uint16_t mask, const std::vector<std::uint32_t>& words) const;

  /// Streams the words of `mask` and the tick counter every `period` ticks from now on; 0 ends the
  /// stream.
  void stream(WordMask mask, std::uint32_t period);
  /// The oldest tick of the stream that was not taken yet; waits for one until `deadline`.
  std::optional<Tick> streamed(Deadline deadline);
  /// Number of frames that the board could not send in time.
  std::uint32_t stream_dropped();
  /// Shortest period, in ticks, at which all frames of `mask` fit on a line of `baud`; a fifth of
  /// the line is left for escapes and requests.
  std::uint32_t shortest_period(WordMask mask, int baud) const;

 private:
  std::uint32_t bit_of(const std::string& control, const std::string& field) const;
  void command(const std::string& field);
  void command(const std::string& field, int axis);
  /// Each axis has a control word of its own; the host writes all of them.
  std::uint32_t control(int axis);
  void control(int axis, std::uint32_t word);
  int scene_number(const std::string& scene) const;
  std::vector<std::string> words_of_axis(const Tick& tick, int axis) const;
  std::string cause(const std::vector<design::Cause>& causes, int number) const;
  bool sensors_ready(const Tick& tick) const;
  [[noreturn]] void refuse_to_arm(const Tick& tick, const std::string& what);

  Link& link_;
  BoardInfo board_;
  design::Elaborated design_;
  Quantities quantities_;
  std::vector<int> view_;  ///< word in each slot of the view; empty with one axis
  std::optional<std::uint32_t> stream_tick_;
  double stream_time_s_ = 0;
  double watchdog_s_ = 0;
};

}  // namespace feltgate::host
