// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which words of the core's port a bus can write and read. Documentation: docs/architecture.md
#pragma once

#include "feltgate/generated/map.hpp"

namespace feltgate::test {

constexpr bool port_writes(int address) {
  return address < 512 || address == Map::C::control || address == Map::C::command;
}
constexpr bool port_reads(int address) {
  return port_writes(address) || (address >= Map::C::snapshot && address < Map::C::snapshot + 64);
}

}  // namespace feltgate::test
