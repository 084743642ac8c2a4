// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Contents of the three memories of an engine: program, data, tables. Documentation:
// docs/engine-isa.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/generated/engine.hpp"

namespace feltgate {

/// The three memories; every word is 0 at first. Addresses are those of the hardware.
struct EngineMemory {
  template <class Word, int Words>
  using Words_of = std::array<Word, static_cast<std::size_t>(Words)>;

  Words_of<std::uint64_t, EngineMap::program_words> program{};  ///< 36 bits each
  Words_of<std::int32_t, EngineMap::data_words> data{};
  Words_of<std::uint64_t, EngineMap::table_words> table{};  ///< 36 bits each
  int line_base = EngineMap::table_words;  ///< first table word that TST may write; 512: none

  /// Access by word number, which must be below 512.
  std::uint64_t program_at(int n) const { return program[static_cast<std::size_t>(n)]; }
  std::int32_t data_at(int n) const { return data[static_cast<std::size_t>(n)]; }
  std::uint64_t table_at(int n) const { return table[static_cast<std::size_t>(n)]; }
  void set_program(int n, std::uint64_t word) { program[static_cast<std::size_t>(n)] = word; }
  void set_data(int n, std::int32_t word) { data[static_cast<std::size_t>(n)] = word; }
  void set_table(int n, std::uint64_t word) { table[static_cast<std::size_t>(n)] = word; }
};

}  // namespace feltgate
