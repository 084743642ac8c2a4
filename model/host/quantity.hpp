// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The quantities of a board by name, in units: parameters, snapshot words, bits of control and
// status, words of the link. Documentation: docs/host.md, docs/registers.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "design/design.hpp"

namespace feltgate::host {

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

}  // namespace feltgate::host
