// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws that nobody would write.
#pragma once

#include "law_tree.hpp"

namespace feltgate::judge {

/// What a law is made around.
enum class Shape { formula, parameters_alone, whole_states, nested, arrays, tables, memory, axes };
constexpr int shapes = 8;

Law random_law(std::uint64_t seed, Shape shape);

/// Laws that once were compiled wrongly, and their relatives.
struct Directed {
  std::string name;
  Law law;
};
std::vector<Directed> directed_laws();
/// Laws that come close to their bounds.
std::vector<Directed> tight_laws();

}  // namespace feltgate::judge
