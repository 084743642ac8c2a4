// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The 64-bit hash FNV-1a: equal input gives an equal hash on every machine. Documentation:
// docs/page.md
#pragma once

#include <cstdint>

namespace feltgate {

/// The running hash.
class Fnv1a {
 public:
  /// Adds the eight bytes of a number, low byte first.
  void add(std::int64_t value) {
    auto word = static_cast<std::uint64_t>(value);
    for (int byte = 0; byte < 8; ++byte, word >>= 8) add_at_once(word & 0xffu);
  }
  /// Adds a number in one round: eight times as fast, but not the hash of its bytes.
  void add_at_once(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3u; }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace feltgate
