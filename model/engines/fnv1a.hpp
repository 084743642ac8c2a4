// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The hash FNV-1a of 64 bits: equal bits, equal hash, on any machine. Documentation: docs/page.md
#pragma once

#include <cstdint>

namespace feltgate {

class Fnv1a {
 public:
  /// The eight bytes of a number, little end first.
  void add(std::int64_t value) {
    auto word = static_cast<std::uint64_t>(value);
    for (int byte = 0; byte < 8; ++byte, word >>= 8) add_at_once(word & 0xffu);
  }
  /// A number in one round: eight times as fast, and not the hash of its bytes.
  void add_at_once(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3u; }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace feltgate
