// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a board has under names, in units: parameters, snapshot words, bits of control and status,
// words of the link. Documentation: docs/host.md, docs/registers.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "design/design.hpp"

namespace feltgate::host {

/// A number of the board: where it lies, and what it is in its unit.
struct Quantity {
  enum class Kind { parameter, snapshot, field, link };
  Kind kind = Kind::link;
  std::string name;  ///< torque_limit, velocity, status.armed, frames_bad
  std::string unit;  ///< empty for a word of bits
  std::string doc;
  int address = 0;          ///< word address on the link
  int bit = 0, width = 32;  ///< which bits of the word
  bool is_signed = false;
  double scale = 1;  ///< unit per step: value = integer * scale
  int word = -1;     ///< of the snapshot: number of its bit in a mask of words; else -1
  bool writable = false;
  Format format{};          ///< of a parameter
  std::string while_armed;  ///< of a parameter: what a write does while the motor is armed

  /// The value in the word that its address holds.
  double value_of(std::uint32_t word_there) const;
  /// The integer in it.
  std::int64_t raw_of(std::uint32_t word_there) const;
  /// "0.25 Nm", "3 count", "0x12": with as many digits as the format has.
  std::string text_of(std::uint32_t word_there) const;
  /// Smallest and largest value that the word can hold, in the unit.
  double low() const, high() const;
};

/// What a user asks of one parameter.
struct Setting {
  const Quantity* of = nullptr;
  double asked = 0;        ///< in the parameter's unit
  std::uint32_t word = 0;  ///< rounded to the nearest step of its format
  double value() const { return of->value_of(word); }
};

/// All quantities of a board with this design.
class Quantities {
 public:
  explicit Quantities(const design::Elaborated& design);

  const std::vector<Quantity>& all() const { return all_; }
  /// Throws std::invalid_argument with the nearest name for one that is not there.
  const Quantity& find(const std::string& name) const;
  /// nullptr instead.
  const Quantity* look(const std::string& name) const;
  /// Those that are words of the snapshot (the quantities of a stream or capture). Throws
  /// std::invalid_argument for what is none.
  const Quantity& streamed(const std::string& name) const;
  /// Number of words in a snapshot, and the number that a word has in masks.
  int words() const { return words_; }

  /// "NAME=VALUE" with an optional unit after the value (law/amount.hpp). Throws
  /// std::invalid_argument with the mend: no '=', unknown name, not to be written, no number, a
  /// unit of something else, out of range.
  Setting setting(const std::string& text) const;
  /// The same of a value in the parameter's unit.
  Setting setting(const Quantity& of, double value) const;
  /// A value with an optional unit in the unit of `of`.
  double value_in(const Quantity& of, const std::string& text) const;

 private:
  void add_parameters(const design::Elaborated& design);
  void add_snapshot(const design::Elaborated& design);
  void add_fields(const design::Elaborated& design);
  void add_link(const design::Elaborated& design);

  std::vector<Quantity> all_;
  int words_ = 0;
  double count_rad_ = 0, tick_hz_ = 0;
};

}  // namespace feltgate::host
