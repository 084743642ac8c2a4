// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The values at which a law's values stay: clamp(x, 0, 3) is 3 over half of all positions. A word
// beside that 3 would be on the wrong side of a comparison with 3 in all of them. Documentation:
// docs/laws.md
#pragma once

#include <map>
#include <vector>

#include "law/law.hpp"

namespace feltgate::law {

class Stays {
 public:
  explicit Stays(const Law& law);

  /// Whether the node can keep this value while what it is made of moves.
  bool at(NodeId id, double value) const;
  /// Whether the node, or what it goes to unchanged, is compared with a value at which it stays.
  bool decides(NodeId id) const { return decides_[static_cast<std::size_t>(id)] != 0; }
  /// Whether the node can stay at a whole number.
  bool at_whole(NodeId id) const;

 private:
  const std::vector<double>& of(NodeId id);
  void decide(NodeId id, double value);

  const Law& law_;
  std::map<NodeId, std::vector<double>> values_;
  std::vector<char> decides_;
};

}  // namespace feltgate::law
