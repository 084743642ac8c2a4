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

#include "design/design.hpp"
#include "host/link.hpp"

namespace feltgate::host {

/// The words of the link that describe the board.
struct BoardInfo {
  int major = 0, minor = 0;      ///< version of the link
  std::uint32_t design_crc = 0;  ///< identifies the design
  std::int64_t clock_hz = 0;
  int clocks_per_tick = 1;
  bool simulated = false, has_capture = false, has_stream = false;
  bool has_engine = false;  ///< it can run laws
  int capture_rows = 0, capture_columns = 0;
  std::uint32_t frames_good = 0, frames_bad = 0;  ///< as counted by the board
  int board = 0;
  std::uint32_t inputs = 0;  ///< board inputs; see the board's page

  double tick_hz() const { return static_cast<double>(clock_hz) / clocks_per_tick; }
  /// Names such as "DE0-Nano", "board 7".
  std::string board_name() const;
};

/// Reads them. Errors: std::runtime_error if something other than a feltgate answers, or with a
/// version that this host does not know; LinkLost if nothing answers.
BoardInfo read_board(Link& link);

/// A design with all values derived from it, and its CRC.
struct KnownDesign {
  design::Elaborated design;
  std::uint32_t crc = 0;
  const std::string& name() const { return design.design.name; }
};

/// Reads the design file `path` with rtl/registers.toml of the folder `root`.
KnownDesign read_known_design(const std::string& root, const std::string& path);
/// The design in rtl/designs of `root` that has this CRC; skips files that cannot be read.
std::optional<KnownDesign> design_by_crc(const std::string& root, std::uint32_t crc);

/// A quantity of the board: its place, and its meaning in a unit.
struct Quantity {
  enum class Kind { parameter, snapshot, field, link };
  Kind kind = Kind::link;
  std::string name;  ///< torque_limit, velocity, status.armed, frames_bad
  std::string unit;  ///< empty for a word of bits
  std::string doc;
  int address = 0;          ///< word address on the link
  int bit = 0, width = 32;  ///< the bits of the word
  bool is_signed = false;
  double scale = 1;  ///< unit per step: value = integer * scale
  int word = -1;     ///< snapshot: number of its bit in a WordMask; else -1
  bool writable = false;
  Format format{};          ///< of a parameter
  std::string while_armed;  ///< parameter: effect of a write while the motor is armed

  /// The value, from the word at its address.
  double value_of(std::uint32_t word_there) const;
  /// The integer, from the word at its address.
  std::int64_t raw_of(std::uint32_t word_there) const;
  /// Text such as "0.25 Nm", "3 count", "0x12", with as many digits as the format has.
  std::string text_of(std::uint32_t word_there) const;
  /// Smallest and largest value that the word can hold, in the unit.
  double low() const, high() const;
};

/// A user's request for one parameter.
struct Setting {
  const Quantity* of = nullptr;
  double asked = 0;        ///< in the parameter's unit
  std::uint32_t word = 0;  ///< rounded to the nearest step of its format
  double value() const { return of->value_of(word); }
};

/// Words of the snapshots of all axes: those of axis n begin at bit n * Quantities::words().
using WordMask = std::uint64_t;

/// All quantities of a board with a given design. Those of axis 1 and above have its number behind
/// their name: position, position.1, status.armed.1. The name position.0 means position.
class Quantities {
 public:
  explicit Quantities(const design::Elaborated& design, int axes = 1);

  const std::vector<Quantity>& all() const { return all_; }
  /// Errors: std::invalid_argument with the nearest name, for an unknown one.
  const Quantity& find(const std::string& name) const;
  /// What is wrong with a name whose axis the board does not have; empty for any other name.
  std::string missing_axis(const std::string& name) const;
  /// The same; nullptr for an unknown name.
  const Quantity* look(const std::string& name) const;
  /// A quantity of a stream or capture: a word of the snapshot. Errors: std::invalid_argument for
  /// another quantity.
  const Quantity& streamed(const std::string& name) const;
  /// Number of words in the snapshot of an axis.
  int words() const { return words_; }
  int axes() const { return axes_; }
  static WordMask bit(const Quantity& q) { return WordMask{1} << q.word; }
  /// "" for axis 0, ".1" for axis 1.
  static std::string suffix(int axis);

  /// Parses "NAME=VALUE" with an optional unit after the value (law/units.hpp). Errors:
  /// std::invalid_argument with advice: no '=', unknown name, not writable, no number, a wrong
  /// unit, out of range.
  Setting setting(const std::string& text) const;
  /// The same for a value in the parameter's unit.
  Setting setting(const Quantity& of, double value) const;
  /// Converts a value with an optional unit to the unit of `of`.
  double value_in(const Quantity& of, const std::string& text) const;

 private:
  void add_parameters(const design::Elaborated& design);
  void add_snapshot(const design::Elaborated& design);
  void add_fields(const design::Elaborated& design);
  void add_axes();
  void add_link(const design::Elaborated& design);

  std::vector<Quantity> all_;
  int words_ = 0, axes_ = 1;
  double count_rad_ = 0, tick_hz_ = 0;
};

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

/// Arms a motor, or takes over an armed one, and kicks its watchdog four times as often as
/// necessary. Its owner must call release() on every way out.
class KeepAlive {
 public:
  explicit KeepAlive(Device& device) : device_(device) {}

  /// Arms with the watchdog enabled; `go_on` as in Device::arm(). Errors: those of Device::arm().
  /// After an error the motor is disarmed; only if the link broke down, release() must still be
  /// called.
  void arm(
      const std::string& scene, const std::function<bool()>& go_on = [] { return true; });
  /// Takes over a motor that the host has armed before, not one that the panel has armed.
  void take_over();
  bool holds() const { return holds_; }
  /// Kicks if it is time; call it at least every next_in_s() seconds.
  void poll();
  /// Time to the next kick, s, at most `idle_s`.
  double next_in_s() const;
  /// Disarms the motor that it holds. Errors: LinkLost if the request does not reach the board.
  void release();

  static constexpr double idle_s = 0.1;

 private:
  Device& device_;
  bool holds_ = false;
  Deadline next_{};
};

}  // namespace feltgate::host
