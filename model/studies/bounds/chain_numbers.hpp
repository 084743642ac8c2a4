// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The properties of a design that an error bound needs: formats, rounding, and each coefficient
// both as the core's integer and as the design's value. Documentation: docs/error-bounds.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "feltgate/fixed.hpp"

namespace feltgate::bounds {

/// A parameter: the core's integer and the design's value.
struct Number {
  std::string name;
  Format format{};
  double si = 0;         ///< the design's value
  std::int64_t raw = 0;  ///< the core's integer

  double used() const;  ///< exact: the integer times 2^-fraction
};

struct ChainNumbers {
  std::string design;
  Formats formats{};
  Round rounding = Round::half_up;
  /// rad/s per count of the N-method: in the core, in the reference chain (2^n, or the exact factor
  /// where a quantised gain stands for it), and by 2*pi/(Er*Tp*m1).
  double used_gain = 0, reference_gain = 0, exact_gain = 0;
  bool quantised_gain = false;  ///< the core multiplies by used_gain and truncates
  int gain_fraction = 0;
  std::vector<Number> numbers;
  std::vector<std::string> scenes;  ///< those built in

  /// The parameter of this name. Throws std::out_of_range when there is none.
  const Number& at(const std::string& name) const;
  bool built(const std::string& scene) const;
  /// Sets a value, rounded to the parameter's word. Throws std::out_of_range as above.
  void set(const std::string& name, double value);
};

ChainNumbers chain_numbers(const design::Elaborated& e);

}  // namespace feltgate::bounds
