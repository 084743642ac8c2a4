// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates laws that no user would write.
#pragma once

#include "law_tree.hpp"

namespace feltgate::judge {

/// The main construct of a generated law. `wide`: a function over the whole range of an input;
/// `ends`: values that stay at an end and are compared there.
enum class Shape {
  formula,
  parameters_alone,
  whole_states,
  nested,
  arrays,
  tables,
  memory,
  axes,
  wide,
  ends
};
constexpr int shapes = 8;  ///< without `wide` and `ends`, whose laws have tests of their own

Law random_law(std::uint64_t seed, Shape shape);

/// Laws that were once compiled wrongly, and similar laws.
struct Directed {
  std::string name;
  Law law;
};
std::vector<Directed> directed_laws();
/// Laws whose errors come close to their bounds.
std::vector<Directed> tight_laws();

}  // namespace feltgate::judge
